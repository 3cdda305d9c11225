// A fractional PID in q31: full scales, and gains as integers.
#pragma once

#include <cstdint>

#include "drive/controller_file.hpp"
#include "glsum/exponentials/fixed_decay.hpp"

namespace generate {

/// An integer of 29 bits at least, with two bits free for larger ones: gains may rise fourfold at run time.
struct FixedGain {
    std::int32_t mantissa = 0;
    double unit = 0.0;  ///< the gain, without its power of h, of mantissa 1
    int shift = 0;      ///< from its products to the integral's units, in [2, 60]
};

/// The numbers of kernels/glsum/model/pid_q31.h.
struct FixedPid {
    double input_full_scale = 0.0;   ///< of set point and measured value; errors have twice that
    double output_full_scale = 0.0;  ///< the larger magnitude of the limits
    int extra = 0;                   ///< bits of the integral behind the output's
    FixedGain kp;
    FixedGain ki;
    FixedGain kd;
    std::int32_t weight = 0;  ///< of the set point, times 2^30
    glsum::FixedDecay passes{};
    std::int32_t low = 0;
    std::int32_t high = 0;
    /// What one of an error is. \param exponent  integer bits of a sum over it
    [[nodiscard]] double error_unit(int exponent = 0) const;
    [[nodiscard]] double output_unit() const;
};

/// \param integral, derivative  integer bits of the two sums (`Scale::output_exponent`)
/// \throws glsum::Failure (bad input): a controller without limits, an input scale that is not above 0, gains that for
/// these scales leave the integral fewer than 8 bits behind the output's
[[nodiscard]] FixedPid fixed_pid(const drive::Fopid& controller, double input_full_scale, int integral, int derivative);

}  // namespace generate
