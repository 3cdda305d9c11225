// What a lightly damped pole adds to a function: against partial fractions done by hand.
#include "drive/swing_part.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

namespace {

using Complex = std::complex<double>;

constexpr double w = 3.0;
constexpr double decay = 0.1;
const Complex pole(-decay, w);

// 1/((s - p)(s - p*)): c1 = 1/(2 i w). Its square: c2 = -1/(4 w^2), c1 = 2/(2 i w)^3 (-1). And s^0.5 times the first,
// whose cut passes at a distance: c1 = p^0.5/(2 i w).
void images(Complex s, std::span<Complex> values) {
    const Complex one = 1.0 / ((s - pole) * (s - std::conj(pole)));
    values[0] = one;
    values[1] = one * one;
    values[2] = std::sqrt(s) * one;
}

TEST(SwingPart, IsThatOfPartialFractions) {
    const drive::Swing swing{w, decay};
    const auto part = drive::swing_part(images, 3, swing, {swing});
    ASSERT_TRUE(part);
    const Complex two_iw(0.0, 2.0 * w);
    const auto expect_near = [](Complex found, Complex expected) { EXPECT_LT(std::abs(found - expected), 1e-14); };
    expect_near(part->pole, pole);
    expect_near(part->simple[0], 1.0 / two_iw);
    expect_near(part->squared[0], 0.0);
    expect_near(part->simple[1], -2.0 / (two_iw * two_iw * two_iw));
    expect_near(part->squared[1], 1.0 / (two_iw * two_iw));
    expect_near(part->simple[2], std::sqrt(pole) / two_iw);
    expect_near(part->squared[2], 0.0);
}

TEST(SwingPart, IsTakenFromTheImageAndAddedInTime) {
    const drive::Swing swing{w, decay};
    const auto part = drive::swing_part(images, 3, swing, {swing});
    ASSERT_TRUE(part);
    // Of the first two nothing is left anywhere; of the third no pole is.
    for (const Complex s : {Complex(0.5, 0.0), Complex(0.1, 2.0), pole + 0.01, Complex(2.0, -30.0)}) {
        std::vector<Complex> values(3);
        images(s, values);
        part->take_from(values, s);
        EXPECT_LT(std::abs(values[0]), 1e-11) << s;
        EXPECT_LT(std::abs(values[1]), 1e-9) << s;
        EXPECT_LT(std::abs(values[2]), 1.0) << s;
    }
    for (const double t : {0.0, 0.4, 5.0}) {
        std::vector<double> values{10.0, 20.0};
        part->add_to(values, t);
        const double swung = std::exp(-decay * t) * std::sin(w * t);
        EXPECT_NEAR(values[0], 10.0 + swung / w, 1e-13);
        const double square = (std::sin(w * t) - w * t * std::cos(w * t)) * std::exp(-decay * t) / (2.0 * w * w * w);
        EXPECT_NEAR(values[1], 20.0 + square, 1e-13);
        EXPECT_NEAR(part->size(0, t), std::exp(-decay * t) / w, 1e-13);
        EXPECT_NEAR(part->size(1, t), std::exp(-decay * t) * (1.0 / (w * w * w) + t / (w * w)) / 2.0, 1e-13);
    }
}

// A simple pole that was missed by a ten millionth is taken out all the same; by a thousandth, or with another within
// the circle, it is not alone.
TEST(SwingPart, IsThereWhereThePoleIsAlone) {
    const drive::Image simple = [](Complex s, std::span<Complex> values) {
        values[0] = 1.0 / ((s - pole) * (s - std::conj(pole)));
    };
    const auto found = [&](double by, std::vector<drive::Swing> others) {
        const drive::Swing swing{w * (1.0 + by), decay};
        others.push_back(swing);
        return drive::swing_part(simple, 1, swing, others).has_value();
    };
    EXPECT_TRUE(found(1e-7, {}));
    EXPECT_FALSE(found(1e-3, {}));
    EXPECT_TRUE(found(0.0, {{2.0 * w, decay}}));
    const drive::Image two = [](Complex s, std::span<Complex> values) {
        const Complex second(-decay, 1.1 * w);
        values[0] = 1.0 / ((s - pole) * (s - std::conj(pole)) * (s - second) * (s - std::conj(second)));
    };
    const drive::Swing swing{w, decay};
    EXPECT_FALSE(drive::swing_part(two, 1, swing, {swing}));
    EXPECT_TRUE(drive::swing_part(two, 1, swing, {swing, {1.1 * w, decay}}));
    // Nothing swings at no frequency, and what is no number has no part.
    EXPECT_FALSE(drive::swing_part(simple, 1, {0.0, decay}, {}));
    const drive::Image none = [](Complex, std::span<Complex> values) { values[0] = std::nan(""); };
    EXPECT_FALSE(drive::swing_part(none, 1, swing, {swing}));
}

}  // namespace
