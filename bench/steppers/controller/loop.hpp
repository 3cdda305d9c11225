// A generated controller in its loop, held against the same sampled loop in double with full memory.
#pragma once

#include <cstddef>

#include "bench/steppers/controller/controller_spec.hpp"
#include "drive/model.hpp"

namespace generate {

/// Largest differences of the plant's output, as parts of its largest value.
struct LoopDeviation {
    double header;    ///< of the header's loop, plant in double with full memory in both
    double sampling;  ///< of the loop in double at half the step, at the same times: the sampling's own
};

/// The set point of the first half of the record: 1; in q31 half of full scale, where that is less.
[[nodiscard]] double first_level(const ControllerSpec& spec);
/// And of the other half, times that.
inline constexpr double second_level = 0.4;

/// Plant and controller begin at rest, the plant by the scheme of `drive/simulation`.
/// \throws glsum::Failure (bad input) for a plant with derivatives of its input, and for an output beyond the input's
/// full scale; (check failed) for a loop that does not stay finite
[[nodiscard]] LoopDeviation measure_loop(const ControllerSpec& spec, const drive::Model& plant, std::size_t samples);

}  // namespace generate
