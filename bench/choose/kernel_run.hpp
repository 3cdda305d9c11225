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
    double noise = 0.0;            ///< largest, for |x| <= 1, in units of the derivative
    std::string fault;             ///< why the kernel refused; empty if it did not
};
/// \param most  samples that a run takes at most
[[nodiscard]] Held hold(const std::string& kernel, std::size_t taps, const glsum::design::DerivativeGoal& goal,
                        const glsum::design::FittedFilter& fitted, std::size_t most);

/// Errors of the outputs themselves.
[[nodiscard]] glsum::design::DerivativeError run(const std::string& kernel, std::size_t taps,
                                                 const glsum::design::DerivativeGoal& goal,
                                                 const glsum::design::FittedFilter& fitted);

}  // namespace choose
