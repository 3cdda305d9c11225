// A derivative as a kernel computes it, taken as a linear filter: what it makes of a sine and of a step.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "glsum/design/mode.hpp"

namespace glsum::design {

/// D_k = sum_{j<K} b_j x_(k-j) + sum_m w_m sum_{j>=K} (1-d_m)^(j-K) x_(k-j), the factor w_0 h^-v of a sum included.
struct Filter {
    std::vector<double> taps;  ///< b_0 ... b_(K-1), K >= 1
    std::vector<Mode> modes;   ///< decays in [0, 1]; 0: an integrator
};

/// What a kernel applies its taps and modes to.
enum class FilterKind {
    samples,
    integrator,  ///< samples; the slowest mode does not decay
    increments,  ///< x_k - x_(k-1), with x = 0 before k = 0
};

/// A filter of increments as one of samples: a tap more, and modes of d times the weight.
[[nodiscard]] Filter of_samples(const Filter& of_increments);

/// H(e^(i angle)). \param angle  w h in (0, pi]
[[nodiscard]] std::complex<double> frequency_response(const Filter& filter, double angle);

/// The part of one mode in it, for w = 1: z^-K / (1 - (1-d) z^-1).
[[nodiscard]] std::complex<double> mode_response(double decay, std::size_t near_taps, double angle);

/// The same where 1 - z^-1 and z^-K are known.
[[nodiscard]] inline std::complex<double> mode_response(double decay, const std::complex<double>& difference,
                                                        const std::complex<double>& delayed) {
    // 1 - (1-d) z^-1 = d + (1-d) (1 - z^-1): slow modes at low angles keep their digits.
    return delayed / (decay + (1.0 - decay) * difference);
}
/// 1 - z^-1
[[nodiscard]] std::complex<double> difference_response(double angle);

/// D_k for x_0 = x_1 = ... = x_k = 1, from rest.
[[nodiscard]] double step_response(const Filter& filter, std::size_t k);

/// The part of one mode in it, for w = 1: 1 + (1-d) + ... + (1-d)^(k-K); 0 before k = K.
[[nodiscard]] double mode_step_response(double decay, std::size_t near_taps, std::size_t k);

}  // namespace glsum::design
