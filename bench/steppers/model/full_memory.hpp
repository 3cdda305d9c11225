// A model's scheme in double with full memory: what its stepped form is held against, and how far it can swing.
#pragma once

#include <cstddef>
#include <vector>

#include "bench/steppers/model/model_spec.hpp"

namespace generate {

/// Whether its past has no end: orders other than whole ones.
[[nodiscard]] bool has_tail(const drive::Model& model);

/// More taps than whole orders up to 20 have; what is 0 is left out.
inline constexpr std::size_t whole_order_taps = 64;

/// y for an input, from rest.
[[nodiscard]] std::vector<double> full_memory(const ModelSpec& spec, const std::vector<double>& input);

/// What a disturbance of 1 of one increment makes in all: the sums of the magnitudes, over `spec.samples` samples.
struct Swing {
    double output;
    double increments;
};
[[nodiscard]] Swing swing_of(const ModelSpec& spec);

}  // namespace generate
