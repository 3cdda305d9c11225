// A kernel, prepared for a fitted filter, run over what a derivative is judged by.
#pragma once

#include <complex>
#include <cstddef>
#include <string>

#include "glsum/design/band.hpp"

namespace choose {

/// What a kernel holds of a fitted filter, and how far its arithmetic strays from that.
struct Held {
    glsum::design::Filter filter;  ///< in units of the derivative
    double band_noise = 0.0;       ///< largest, of sines at full scale, relative to |w^v| of each one's frequency
    double step_noise = 0.0;       ///< largest, relative to the step's exact response at that time
    bool as_fitted = false;        ///< of a window: the filter is the design's own, rounding is in the noise
    std::string fault;             ///< why the kernel refused; empty if it did not

    /// With the filter's own errors, as they were found.
    [[nodiscard]] glsum::design::DerivativeError added_to(glsum::design::DerivativeError error) const {
        error.band += band_noise;
        error.step += step_noise;
        return error;
    }
};
/// Runs a kernel with averages over the whole step, and sines at both ends and in the middle of the band, each for four
/// periods of the lowest; of a window the noise is its promised bound.
[[nodiscard]] Held hold(const std::string& kernel, std::size_t taps, const glsum::design::DerivativeGoal& goal,
                        const glsum::design::FittedFilter& fitted);

/// Errors of the outputs themselves.
[[nodiscard]] glsum::design::DerivativeError run(const std::string& kernel, std::size_t taps,
                                                 const glsum::design::DerivativeGoal& goal,
                                                 const glsum::design::FittedFilter& fitted);

}  // namespace choose
