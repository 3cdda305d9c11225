// What validation shows of a drive and training does not: there every candidate is extrapolated.
#pragma once

#include <string>
#include <vector>

#include "gap/drive/record.hpp"

namespace gap {

/// Directions of the output, levels of inputs and output, and frequencies of the output that the records of `validate`
/// have and those of `train` lack, in words: "falling output", "input above 0.6", "input between 0.2 and 0.8",
/// "input 2 above 50", "output below -1.2", "faster than 0.5 Hz". Empty: none.
///
/// A direction is there where the output goes a tenth of its span that way without a turn, and lacks where all of
/// training goes less than a quarter as far, noise and lost readings aside. A level lacks where a hundredth of the
/// validation lies more than a twentieth of the span beyond all training, or a tenth of it between two levels of
/// training that are more than a fifth of it apart. A half-decade of frequencies is there where it holds a fiftieth of
/// the output's variance, and lacks where training has a twentieth of that or less.
[[nodiscard]] std::vector<std::string> extrapolated(const std::vector<Record>& train,
                                                    const std::vector<Record>& validate);

/// The stretches of records that count, each as a record of its own; those of fewer than 32 samples are left out.
/// \param counts  by record and sample
[[nodiscard]] std::vector<Record> counted_stretches(const std::vector<Record>& records,
                                                    const std::vector<std::vector<char>>& counts);

}  // namespace gap
