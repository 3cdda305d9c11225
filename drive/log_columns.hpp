// Which column of a log is the time, which the input, which the output: by the names of drive/log.hpp, by those that
// loggers usually write, by an option, or by number.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "drive/csv_dialect.hpp"
#include "drive/log.hpp"

namespace drive {

/// The first line of a log, or, where it holds data at once, the numbers of its columns.
struct LogHeader {
    std::string place;  ///< file and line, for messages
    std::vector<std::string> names;
    bool is_written = true;  ///< false: the names are 1, 2, 3, ...
};

/// A log has no header where its first line begins with a number or a date.
[[nodiscard]] LogHeader header_of(const std::vector<Field>& first_line, const std::string& place);

struct LogColumns {
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::size_t time = none;
    std::size_t input = none;
    std::size_t output = none;  ///< none: neither named nor needed
    std::size_t reference = none;
    std::size_t simulated = none;
    std::vector<std::size_t> more_inputs;
    std::vector<std::string> found;  ///< of names that are not those of drive/log.hpp, for people
};

/// \throws glsum::Failure (bad input) naming file and line: a column missing, with the nearest names; several that may
/// be meant; one that is asked for twice
[[nodiscard]] LogColumns find_columns(const LogHeader& header, const Columns& asked);

/// Whether a line below the header holds units: `s`, `ms`, ... for the time, or no number and at least one known unit.
[[nodiscard]] bool is_row_of_units(const std::vector<Field>& fields, std::size_t time);

}  // namespace drive
