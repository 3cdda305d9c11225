// What a format holds of a cascade's sections: which poles are let in, what has room, how coefficients are rounded, and
// how far a section is scaled down.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "glsum/exponentials/modes.hpp"
#include "glsum/filter/section_rounding.hpp"
#include "glsum/format/fixed.hpp"
#include "glsum/format/floating.hpp"

namespace {

using namespace glsum;

HeldSection with_denominator(double a1, double a2) { return {1.0, 0.0, 0.0, a1, a2}; }

// (1 - p q)(1 - p' q): two poles that differ, both inside the circle, or one.
TEST(HeldSection, IsStableWithRealPolesInsideTheCircle) {
    const double poles[] = {-1.25, -1.0, -0.875, -0.5, 0.0, 0.5, 0.875, 1.0, 1.25};
    for (const double p : poles) {
        const bool inside = std::fabs(p) < 1.0;
        EXPECT_EQ(with_denominator(-p, 0.0).is_stable(true), inside) << p;
        for (const double other : poles) {
            EXPECT_EQ(with_denominator(-(p + other), p * other).is_stable(false),
                      inside && std::fabs(other) < 1.0 && p != other)
                << p << ' ' << other;
        }
    }
    EXPECT_FALSE(with_denominator(-1.0, 0.5).is_stable(false));  // 0.5 +- 0.5 i
}

// Two poles that both lie beyond the circle pass the sums' signs, their product alone shows them; two that nearly touch
// are real.
TEST(HeldSection, IsStableUpToTheCircle) {
    const auto stable = [](double p, double other) {
        return with_denominator(-(p + other), p * other).is_stable(false);
    };
    EXPECT_FALSE(stable(1.25, 1.5));
    EXPECT_FALSE(stable(-1.25, -1.5));
    EXPECT_FALSE(stable(1.0 + 0x1p-10, 1.0 + 0x1p-9));
    EXPECT_TRUE(stable(1.0 - 0x1p-10, 1.0 - 0x1p-9));
    EXPECT_TRUE(stable(0.5, 0.5 + 0x1p-10));
    EXPECT_TRUE(stable(-0.5, -0.5 - 0x1p-10));
}

// 32 bits of which 29 are a fraction: each coefficient of the numerator below 4, and all products, with what was
// dropped below a unit, within 64 bits. In floating point the output's feedback stays below 8.
TEST(HeldSection, FitsWhereTheFormatHasRoom) {
    constexpr double dropped = 0x1p-27;
    for (const double sign : {1.0, -1.0}) {
        const auto fixed = [&](double b0, double b1, double b2, double a1, double a2) {
            return fits_format<Q31>({b0, sign * b1, -sign * b2, -sign * a1, sign * a2});
        };
        EXPECT_FALSE(fixed(1.0, 3.5, 2.0, 1.0, 0.5 - dropped));
        EXPECT_TRUE(fixed(1.0, 3.5, 2.0, 1.0, 0.5 - 2.0 * dropped));
        EXPECT_FALSE(fixed(1.0, 3.5, 2.0, 1.25, 0.25));
        EXPECT_FALSE(fixed(0.0, 4.0, 0.0, 0.0, 0.0));
        EXPECT_FALSE(fixed(0.0, 0.0, 4.0, 0.0, 0.0));
        EXPECT_TRUE(fixed(0.0, 4.0 - 0x1p-29, 0.0, 1.0, 1.0));
        EXPECT_TRUE(fixed(0.0, 0.0, 4.0 - 0x1p-29, 1.0, 1.0));
        const auto floating = [&](double b1, double b2, double a1, double a2) {
            return fits_format<F32>({1.0, sign * b1, -sign * b2, -sign * a1, sign * a2});
        };
        constexpr double most = std::numeric_limits<float>::max();
        EXPECT_TRUE(floating(0.5 * most, 0.5 * most, 4.0, 3.75));
        EXPECT_FALSE(floating(0.5 * most, 0.75 * most, 4.0, 3.75));
        EXPECT_FALSE(floating(0.0, 0.0, 4.0, 4.0));
    }
}

// The second coefficient takes up what the first one's rounding left: their sum, which slow signals pass by, errs by
// half a unit; of one pole there is no second.
TEST(HeldSection, HoldsTheSumOfTwoCoefficientsToHalfAUnit) {
    constexpr double unit = 0.125;
    const auto round = [](double real) { return unit * std::round(real / unit); };
    for (int i = 0; i < 200; ++i) {
        const Section section{-1.9 + 0.0173 * i, 0.9 - 0.0091 * i, -1.8 + 0.0147 * i, 0.8 - 0.0067 * i, 1.0, 0.1, 0.2};
        const HeldSection held = hold_section(section, 0.5, false, round);
        EXPECT_EQ(held.b0, 0.5);
        EXPECT_EQ(held.b1, round(0.5 * section.b1));
        EXPECT_EQ(held.a1, round(section.a1));
        EXPECT_LE(std::fabs(held.b1 + held.b2 - 0.5 * (section.b1 + section.b2)), 0.5 * unit + 1e-12) << i;
        EXPECT_LE(std::fabs(held.a1 + held.a2 - (section.a1 + section.a2)), 0.5 * unit + 1e-12) << i;
        const HeldSection single = hold_section(section, 0.5, true, round);
        EXPECT_EQ(single.b1, held.b1);
        EXPECT_EQ(single.a1, held.a1);
        EXPECT_EQ(single.b2, 0.0);
        EXPECT_EQ(single.a2, 0.0);
    }
}

// Half a unit of 2^-29, away from zero, in fixed point; what a float holds in floating point.
TEST(HeldSection, RoundsToTheFormatsCoefficients) {
    constexpr double unit = 0x1p-29;
    const auto first = [](double a1) { return held_of<Q31>({0.0, 0.0, a1, 0.0, 1.0, 0.1, 1.0}, 1.0, true).a1; };
    for (const double sign : {1.0, -1.0}) {
        EXPECT_EQ(first(sign * (0.5 + 0.497 * unit)), sign * 0.5);
        EXPECT_EQ(first(sign * (0.5 + 0.5 * unit)), sign * (0.5 + unit));
        EXPECT_EQ(first(sign * (0.5 + 1.49 * unit)), sign * (0.5 + unit));
    }
    EXPECT_EQ((held_of<F32>({0.0, 0.0, -0.1, 0.0, 1.0, 0.1, 1.0}, 1.0, true).a1), static_cast<double>(-0.1F));
}

// A section whose answer to a constant is as large as 2^28 is scaled down by so much and no further: b0 would be less
// than two units.
TEST(Sections, AreScaledDownByTwentyEightBitsAtMost) {
    for (const double share : {0.995, 1.005}) {
        constexpr double decay = 0x1p-10;
        const std::vector<Mode> modes = {{decay, (share * 0x1p28 - 1.0) * decay}};
        int scale_bits = -1;
        const bool found =
            for_each_section<Q31>({0.5, 3, modes}, [&](const HeldSection& held, const SectionPlace& place) {
                scale_bits = place.scale_bits;
                EXPECT_EQ(held.b0, 0x1p-28);
                EXPECT_EQ(place.down, 0x1p-28);
                return true;
            });
        EXPECT_EQ(found, share < 1.0);
        EXPECT_EQ(scale_bits, share < 1.0 ? 28 : -1);
    }
}

// A section's scale is the least that holds its largest answer: just below a power of two it takes that power.
TEST(Sections, AreScaledDownByTheLeastThatHoldsTheirAnswer) {
    constexpr double decay = 0.25;
    for (const int bits : {1, 2, 10}) {
        for (const double share : {0.995, 1.005}) {
            const std::vector<Mode> modes = {{decay, (std::ldexp(share, bits) - 1.0) * decay}};  // H(1) is that power
            int scale_bits = -1;
            EXPECT_TRUE(for_each_section<Q31>({0.5, 3, modes}, [&](const HeldSection& held, const SectionPlace& place) {
                scale_bits = place.scale_bits;
                EXPECT_EQ(held.b0, place.down);
                return true;
            }));
            EXPECT_EQ(scale_bits, share < 1.0 ? bits : bits + 1) << share;
        }
    }
}

}  // namespace
