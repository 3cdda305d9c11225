#include "bench/steppers/controller/fixed_pid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/failure.hpp"
#include "bench/steppers/controller/controller_spec.hpp"
#include "glsum/format/fixed.hpp"

namespace generate {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw glsum::Failure(glsum::Exit::bad_input, what); }

constexpr int gain_bits = 28;   // a mantissa is in [2^28, 2^29)
constexpr int least_extra = 8;  // else what is rounded shows in the output

// 2^-bits is what a mantissa of 1 stands for, as output full scales an error's. A gain of 0 may become 1 of them.
int bits_of(double gain) {
    constexpr double largest = std::numeric_limits<double>::max();  // stands for what is infinite, or no number
    return gain_bits - (gain == 0.0 ? 0 : std::max(-40, std::ilogb(std::fmin(std::fabs(gain), largest))));
}

// What such a gain's product can reach whatever its mantissa, in full scales of the output.
double reach(int bits) { return std::ldexp(1.0, 31 - bits); }

}  // namespace

double FixedPid::error_unit(int exponent) const { return std::ldexp(2.0 * input_full_scale, exponent - 31); }
double FixedPid::output_unit() const { return std::ldexp(output_full_scale, -31); }

FixedPid fixed_pid(const drive::Fopid& controller, double input_full_scale, int integral, int derivative) {
    if (!(input_full_scale > 0.0 && std::isfinite(input_full_scale))) {
        refuse(fmt::format("--input-scale: expected a number above 0, found {}", input_full_scale));
    }
    FixedPid fixed;
    fixed.input_full_scale = input_full_scale;
    fixed.output_full_scale = std::max(std::fabs(controller.low), std::fabs(controller.high));
    if (!std::isfinite(fixed.output_full_scale)) {
        refuse("--format q31: expected low and high in the controller's file: the larger is the output's full scale");
    }
    const Factors factors = factors_of(controller);
    struct Part {
        FixedGain* gain;
        double value;
        double power;  // of h
        int exponent;  // of what it multiplies
        double scaled;
        int bits;
    };
    const auto part = [&](FixedGain& gain, double value, double power, int exponent) {
        const double scaled = value * power * fixed.error_unit(exponent) / fixed.output_unit();
        return Part{&gain, value, power, exponent, scaled, bits_of(scaled)};
    };
    const drive::Gains& gains = controller.gains;
    Part parts[] = {part(fixed.kp, gains.kp, 1.0, 0), part(fixed.ki, gains.ki, factors.integral, integral),
                    part(fixed.kd, gains.kd, factors.derivative, derivative)};
    double moves = 0.0;  // full scales of the output, by an error of full scale
    double most = 1.0;   // and at most, added to the integral's own
    for (const Part& one : parts) {
        moves += std::fabs(one.scaled);
        most += reach(one.bits);
    }
    fixed.extra = 29 - std::ilogb(most);  // most is four powers of two, and most 2^(31 + extra) <= 2^61 (1 - 1/16)
    if (fixed.extra < least_extra) {
        refuse(
            fmt::format("--format q31: expected gains by which an error of full scale moves the output by less than "
                        "{:.3g} of its full scales, found {:.3g}: wider limits or a smaller --input-scale may do",
                        std::ldexp(1.0, 29 - 3 - least_extra), moves));
    }
    for (Part& one : parts) {
        const double scale = one.power * fixed.error_unit(one.exponent) / fixed.output_unit();
        one.gain->unit = std::ldexp(1.0, -one.bits) / scale;
        one.gain->mantissa = glsum::round_to_integer<std::int32_t>(one.value / one.gain->unit);
        one.gain->shift = one.bits - fixed.extra;
    }
    fixed.weight = glsum::round_to_integer<std::int32_t>(std::ldexp(controller.setpoint_weight, 30));
    fixed.passes = glsum::to_fixed(factors.passes);
    fixed.low = glsum::round_to_integer<std::int32_t>(controller.low / fixed.output_unit());
    fixed.high = glsum::round_to_integer<std::int32_t>(controller.high / fixed.output_unit());
    return fixed;
}

}  // namespace generate
