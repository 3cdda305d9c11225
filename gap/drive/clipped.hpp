// Readings that a sensor's end holds: noise and all, the same again and again at the highest, or at its opposite. The
// lowest alone may be where the plant rests.
#pragma once

#include <vector>

#include "gap/drive/record.hpp"

namespace gap {

/// Whether equal readings would be seen among the others: where most repeat the one before, coarse or held, or where
/// none differ, they tell nothing.
[[nodiscard]] bool ends_would_show(const Record& record);

/// By sample: whether it is one of ten or more equal ones in a row, at the record's highest reading or its opposite.
/// None where they would not be seen.
[[nodiscard]] std::vector<char> clipped_readings(const Record& record);

}  // namespace gap
