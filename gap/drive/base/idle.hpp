// What an input is counted from: a drive by pulses of 1000 to 2000 us stands still at 1000.
#pragma once

#include <vector>

#include "gap/drive/question.hpp"

namespace gap {

/// The level that no input of one sign goes below, where every training record begins with it and readings rest at 0
/// there, for it is off then. 0: there is none, or inputs go down to a twentieth of the greatest and need none.
[[nodiscard]] double idle_input_of(const std::vector<Record>& train, const std::vector<Record>& validate);

/// The question with inputs counted from there: beside a fitted base, whose offset takes the rest, dead zones,
/// thresholds and curves begin where the drive does.
[[nodiscard]] Question counted_from_idle(Question question);

/// The records as they were logged.
[[nodiscard]] std::vector<Record> as_logged(std::vector<Record> records, double idle_input);

}  // namespace gap
