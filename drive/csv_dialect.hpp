// How the fields of a CSV file are told apart: by commas, semicolons, tabs or runs of blanks, which its first lines
// show; and quotes, between which a separator is a letter like others.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace drive {

enum class Separator : char { comma = ',', semicolon = ';', tab = '\t', blank = ' ' };

struct Field {
    std::string_view text;  ///< without blanks around it and without its quotes
    bool quoted = false;
};

/// A field's text, quotes that were doubled between quotes written once.
[[nodiscard]] std::string text_of(const Field& field);

/// \return whether every quoted field ends, and ends the field; else `fields` is of no use
[[nodiscard]] bool split_fields(std::string_view line, Separator separator, std::vector<Field>& fields);

/// comma, semicolon, tab or blank. \throws glsum::Failure (bad input) for other words
[[nodiscard]] Separator separator_named(const std::string& word);

/// The separator under which the first lines have equally many fields, two or more; of several, the one under which
/// most fields are numbers or dates. Where none does, that of the first line: its rows are then refused by their lines.
/// \throws glsum::Failure (bad input): one column only, or two readings that are equally good, which it shows
[[nodiscard]] Separator find_separator(std::string_view text, const std::string& name);

}  // namespace drive
