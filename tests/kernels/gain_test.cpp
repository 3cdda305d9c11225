// h^-v as mantissa and exponent against 50 digits.
#include "glsum/gain.hpp"

#include <gtest/gtest.h>

#include "reference/real.hpp"

namespace {

using reference::Real;

TEST(Gain, HoldsTheFactorTo31Bits) {
    for (const double factor :
         {1.0, 2.0, 31.622776601683793, 501.18723362727246, 939102.0, 1e-3, 0.999999999999, 1.5}) {
        const glsum::Gain gain = glsum::make_gain(factor);
        EXPECT_GE(gain.mantissa, 1 << 30);
        EXPECT_NEAR(std::ldexp(static_cast<double>(gain.mantissa), gain.exponent - 30) / factor, 1.0, 0x1p-31);
    }
    EXPECT_EQ(glsum::make_gain(1.0).mantissa, 1 << 30);
    EXPECT_EQ(glsum::make_gain(1.0).exponent, 0);
    // Rounding that carries into the next power of two.
    EXPECT_EQ(glsum::make_gain(std::nextafter(2.0, 1.0)).exponent, 1);
    EXPECT_EQ(glsum::make_gain(std::nextafter(2.0, 1.0)).mantissa, 1 << 30);
}

TEST(Gain, ResultIsRoundedOnceAndSaturates) {
    for (const double order : {0.5, 0.9, 1.9909, -0.5}) {
        const glsum::Gain gain = glsum::make_gain(glsum::step_factor(order, 1e-3));
        const Real exact_gain = ldexp(Real(gain.mantissa), gain.exponent - 30);
        for (const int result_exponent : {0, 1, 5, 20}) {
            for (const std::int32_t output : {0, 1, -1, 12345, -98765432, 2147483647, -2147483647 - 1}) {
                const Real exact = ldexp(Real(output), 1 - 31) * exact_gain;  // output exponent 1
                const Real limit = ldexp(Real(1), result_exponent);
                const glsum::Rounded found = glsum::apply_gain(output, 1, gain, result_exponent);
                const Real value = ldexp(Real(found.value), result_exponent - 31);
                const Real half_unit = ldexp(Real(1), result_exponent - 32);
                if (exact >= limit - half_unit || exact < -limit - half_unit) {
                    EXPECT_TRUE(found.saturated) << output << ", order " << order;
                    EXPECT_EQ(value, exact > 0 ? limit - 2 * half_unit : -limit);
                } else {
                    EXPECT_FALSE(found.saturated) << output << ", order " << order;
                    EXPECT_LE(abs(value - exact), half_unit) << output << ", order " << order;
                }
            }
        }
    }
}

}  // namespace
