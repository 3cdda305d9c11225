// A generated controller in its loop, held against the same sampled loop in double with full memory.
#pragma once

#include <cstddef>

#include "bench/steppers/controller/stepped.hpp"
#include "drive/model.hpp"

namespace generate {

/// Largest differences of the plant's output, as parts of its largest value.
struct LoopDeviation {
    double header;    ///< of the header's loop, plant in double with full memory in both
    double sampling;  ///< of the loop in double at half the step, at the same times: the sampling's own
};

/// The set point is 1 for the first half of the record and 0.4 for the other; plant and controller begin at rest, the
/// plant by the scheme of `drive/simulation`.
/// \throws glsum::Failure (bad input) for a plant with derivatives of its input, (check failed) for a loop that does
/// not stay finite
[[nodiscard]] LoopDeviation measure_loop(const ControllerSpec& spec, const drive::Model& plant, std::size_t samples);

}  // namespace generate
