// C text with places: @name@ stands for what a table gives for it.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace generate {

using Places = std::map<std::string, std::string, std::less<>>;

/// \throws std::out_of_range for a place that the table does not have.
[[nodiscard]] std::string fill(std::string_view text, const Places& places);

/// As macros are named.
[[nodiscard]] std::string upper(std::string word);

/// A function of a header's, with `body` of whole lines.
[[nodiscard]] std::string helper(const std::string& result, const std::string& name, const std::string& arguments,
                                 const std::string& body);

/// The name of sum + a x in a header, and what its comment says of a fused one.
[[nodiscard]] std::string accumulate(bool fused);
[[nodiscard]] std::string rounded_once(bool fused);

/// `text` with every `what` replaced.
[[nodiscard]] std::string replaced(std::string text, const std::string& what, const std::string& with);

/// "Licence: MIT.", as a line of a comment; nothing for nothing.
[[nodiscard]] std::string licence_line(const std::string& licence);

/// A C literal of single precision; what is larger than all of it is its largest.
[[nodiscard]] std::string float_literal(double value);

/// 16 digits that another text hardly has.
[[nodiscard]] std::string fingerprint(std::string_view text);

/// What a header begins with, which ends with #endif: another of this name that says something else is an error and not
/// left out in silence. \param design  on one line \param identity  its `fingerprint`
[[nodiscard]] std::string include_guard(const std::string& name, const std::string& design,
                                        const std::string& identity);

}  // namespace generate
