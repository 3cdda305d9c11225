// Where a free motion begins.
#pragma once

#include <string>
#include <vector>

#include "gap/drive/record.hpp"

namespace gap {

/// Where a free motion comes to rest, in the output's unit: the mean of its last tenth, which is the nearest to it.
[[nodiscard]] double level_at_rest(const Record& record);

/// The samples before a free motion is let go: those up to its farthest reading before it first passes where it comes
/// to rest. A hand that still leads it out is no part of it; where it is let go at rest that is the first sample. 0:
/// the record does not pass there, or only in its last three quarters.
[[nodiscard]] std::size_t samples_held(const Record& record);

/// Counts of the records' samples without those before they are let go.
[[nodiscard]] std::vector<std::vector<char>> from_release(std::vector<std::vector<char>> counts,
                                                          const std::vector<Record>& records);

/// Adds a note of each record that does not count from its first sample on.
void say_releases(const std::vector<Record>& records, std::vector<std::string>& notes);

}  // namespace gap
