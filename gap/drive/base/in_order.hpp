// Which of the descriptions are the plant's own, and which of them goes farthest for its numbers.
#pragma once

#include <vector>

#include "gap/drive/base/find.hpp"

namespace gap {

/// Takes off the list what outlasts the records, unless all do, and what is no mode of the plant's; of each structure
/// the better one stays. In order: the one of fewest numbers first that no richer one beats by 8 % a number, or one
/// that integrates by 30 %, in the blocks kept aside and on the validation together. \param longest_s  of the records
/// that are fitted \param floor  a gap below it is noise: such go equally far
void keep_in_order(std::vector<Described>& found, double longest_s, double floor);

/// The form, whose lags and dead time stay within so many times what they are.
[[nodiscard]] drive::Form held_near(drive::Form form, double times);

}  // namespace gap
