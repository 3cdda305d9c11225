// C text with places: @name@ stands for what a table gives for it.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace generate {

using Places = std::map<std::string, std::string, std::less<>>;

/// \throws std::out_of_range for a place that the table does not have.
[[nodiscard]] std::string fill(std::string_view text, const Places& places);
/// The same with what `find` gives for a name.
[[nodiscard]] std::string fill(std::string_view text, const std::function<std::string(std::string_view)>& find);

/// As macros are named.
[[nodiscard]] std::string upper(std::string word);

/// `text` with every `what` replaced.
[[nodiscard]] std::string replaced(std::string text, const std::string& what, const std::string& with);

/// "Licence: MIT.", as a line of a comment; nothing for nothing.
[[nodiscard]] std::string licence_line(const std::string& licence);

/// A C literal of single precision; what is larger than all of it is its largest.
[[nodiscard]] std::string float_literal(double value);

/// 16 digits that another text hardly has.
[[nodiscard]] std::string fingerprint(std::string_view text);

/// Of C, of at most 60 letters, so that there is room behind it.
[[nodiscard]] bool is_identifier(const std::string& text);

/// What every header's identifiers begin with. \throws glsum::Failure (bad input) where it is no identifier
void check_prefix(const std::string& prefix);

/// The prefix of a header in this file: its name, so that two files of one program go together, and one that is made
/// again for another design keeps its callers.
[[nodiscard]] std::string prefix_of_file(const std::filesystem::path& file);

}  // namespace generate
