// Stability next to its border, and what is told of roots and poles: closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "drive/stability.hpp"

namespace {

using drive::Model;
using drive::Stability;
using drive::Term;
using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

Model with(std::vector<Term> terms) {
    Model model;
    model.denominator = std::move(terms);
    return model;
}

// s^2 + 2 d s + 1 has its roots at angles of pi / 2 + asin(d).
drive::StabilityVerdict damped(double d) { return drive::judge_stability(with({{1, 2}, {2.0 * d, 1}, {1, 0}}), 1.0); }

TEST(StabilityLimits, ARootWithinATenMillionthOfARadianIsOnTheBorder) {
    EXPECT_EQ(damped(1.02e-7).verdict, Stability::stable);
    EXPECT_EQ(damped(0.98e-7).verdict, Stability::borderline);
    EXPECT_EQ(damped(0.0).verdict, Stability::borderline);
    EXPECT_EQ(damped(-0.98e-7).unstable_by_roots, 0);
    EXPECT_EQ(damped(-1.02e-7).unstable_by_roots, 2);
    EXPECT_EQ(damped(-1.02e-7).verdict, Stability::unstable);
    EXPECT_EQ(damped(-1.02e-7).unstable_by_argument, 2);  // the argument goes by the axis itself
    EXPECT_EQ(damped(0.0).unstable_by_argument, -1);
    EXPECT_STREQ(drive::name_of(Stability::stable), "stable");
    EXPECT_STREQ(drive::name_of(Stability::borderline), "borderline");
    EXPECT_STREQ(drive::name_of(Stability::unstable), "unstable");
}

// (s + 1 / r) (s + 1) (s + r): the eigenvalues err by a rounding of the largest, which the small root is improved from.
TEST(StabilityLimits, SmallRootsBesideLargeOnesAreAsExactAsThose) {
    for (const double r : {1e3, 1e4, 1e5}) {
        const double middle = r + 1.0 + 1.0 / r;
        const auto judged = drive::judge_stability(with({{1, 3}, {middle, 2}, {middle, 1}, {1, 0}}), 1.0);
        ASSERT_EQ(judged.roots.size(), 3U);
        std::vector<double> sizes;
        for (const Complex root : judged.roots) {
            sizes.push_back(std::abs(root));
        }
        std::sort(sizes.begin(), sizes.end());
        EXPECT_NEAR(sizes[0] * r, 1.0, 1e-12) << r;
        EXPECT_NEAR(sizes[1], 1.0, 1e-12) << r;
        EXPECT_NEAR(sizes[2] / r, 1.0, 1e-12) << r;
        EXPECT_LT(judged.largest_residual, 1e-14) << r;
    }
}

TEST(StabilityLimits, RootsAndPolesAreThoseOfTheirPolynomial) {
    const auto judged = damped(0.3);
    EXPECT_NEAR(judged.smallest_angle_rad, 0.5 * pi + std::asin(0.3), 1e-12);
    EXPECT_NEAR(judged.limit_rad, 0.5 * pi, 1e-15);
    EXPECT_EQ(judged.base_order, 1.0);
    EXPECT_EQ(judged.rounding, 0.0);
    ASSERT_EQ(judged.roots.size(), 2U);
    ASSERT_EQ(judged.poles.size(), 2U);
    EXPECT_LT(std::abs(judged.roots[0] - Complex(-0.3, -std::sqrt(0.91))), 1e-12);  // of a pair the lower first
    EXPECT_LT(std::abs(judged.roots[1] - Complex(-0.3, std::sqrt(0.91))), 1e-12);
    EXPECT_LT(judged.largest_residual, 1e-14);
    // (s^0.5)^2 - 2 c s^0.5 + 1: roots of size 1 at the angle acos(c), and as many poles as lie on the principal sheet.
    const auto half = [](double angle) {
        return drive::judge_stability(with({{1, 1.0}, {-2.0 * std::cos(angle), 0.5}, {1, 0}}), 0.5);
    };
    EXPECT_NEAR(half(1.0).smallest_angle_rad, 1.0, 1e-9);
    EXPECT_NEAR(half(1.0).limit_rad, 0.25 * pi, 1e-15);
    ASSERT_EQ(half(1.0).poles.size(), 2U);
    EXPECT_LT(std::abs(half(1.0).poles[1] - std::polar(1.0, 2.0)), 1e-9);
    EXPECT_TRUE(half(2.0).poles.empty());
    EXPECT_EQ(half(2.0).roots.size(), 2U);
    EXPECT_EQ(half(0.7).unstable_by_roots, 2);
    EXPECT_EQ(half(0.7).unstable_by_argument, 2);
    EXPECT_EQ(half(0.8).unstable_by_roots, 0);
    // A root of size 3 is a pole of size 9.
    const auto larger = drive::judge_stability(with({{1, 1.0}, {-6.0 * std::cos(1.0), 0.5}, {9, 0}}), 0.5);
    ASSERT_EQ(larger.poles.size(), 2U);
    EXPECT_LT(std::abs(larger.poles[1] - std::polar(9.0, 2.0)), 1e-8);
    // The smallest angle first; a root at 0 is on the border, whatever the others are.
    const auto three = drive::judge_stability(with({{1, 3}, {2, 2}, {2, 1}}), 1.0);
    ASSERT_EQ(three.roots.size(), 3U);
    EXPECT_EQ(three.verdict, Stability::borderline);
    EXPECT_NEAR(three.smallest_angle_rad, 0.5 * pi, 1e-15);
    // A double root on the real axis is told as real.
    for (const Complex& pole : drive::judge_stability(with({{1, 2}, {2, 1}, {1, 0}}), 1.0).poles) {
        EXPECT_EQ(pole.imag(), 0.0);
        EXPECT_NEAR(pole.real(), -1.0, 1e-6);
    }
    // So many orders of magnitude apart as roots may be: (s + 1e-6)(s + 1e6).
    const auto apart = drive::judge_stability(with({{1, 2}, {1e6 + 1e-6, 1}, {1, 0}}), 1.0);
    ASSERT_EQ(apart.poles.size(), 2U);
    const double slow = std::min(std::abs(apart.poles[0]), std::abs(apart.poles[1]));
    EXPECT_NEAR(slow / 1e-6, 1.0, 1e-9);
    EXPECT_NEAR(apart.poles[0].real() + apart.poles[1].real(), -1e6, 1e-3);
    EXPECT_EQ(apart.unstable_by_argument, 0);
}

// (s + 1) (s + 2) ... (s + n), whose roots move a million times as far as its coefficients: the polished ones leave a
// rounding of their polynomial.
TEST(StabilityLimits, RootsLeaveARoundingOfTheirPolynomial) {
    for (const int degree : {6, 9, 12}) {
        std::vector<double> product{1.0};
        for (int root = 1; root <= degree; ++root) {
            product.push_back(0.0);
            for (std::size_t i = product.size(); i-- > 0;) {
                product[i] = root * product[i] + (i > 0 ? product[i - 1] : 0.0);
            }
        }
        std::vector<drive::Term> terms;
        for (std::size_t i = 0; i < product.size(); ++i) {
            terms.push_back({product[i], static_cast<double>(i)});
        }
        const auto judged = drive::judge_stability(with(terms), 1.0);
        EXPECT_LT(judged.largest_residual, 1e-15) << degree;
        ASSERT_EQ(judged.poles.size(), static_cast<std::size_t>(degree));
        EXPECT_EQ(judged.verdict, Stability::stable);
    }
}

TEST(StabilityLimits, ZerosRightOfTheAxisOfWhatIsNoPolynomial) {
    // s^2.5 + 1 has poles at angles of +-pi / 2.5 on the principal sheet; s^3 + 1 two, s^3 - 1 one.
    EXPECT_EQ(drive::zeros_right_of_axis({{1, 2.5}, {1, 0}}), 2);
    EXPECT_EQ(drive::zeros_right_of_axis({{1, 3.0}, {1, 0}}), 2);
    EXPECT_EQ(drive::zeros_right_of_axis({{-1, 3.0}, {1, 0}}), 1);
    EXPECT_EQ(drive::zeros_right_of_axis({{1, 0}}), 0);                         // one term alone
    EXPECT_EQ(drive::zeros_right_of_axis({{1, 0}, {0.0, 4.0}}), 0);             // whose like is none
    EXPECT_EQ(drive::zeros_right_of_axis({{1, 1.5}, {1, 0.5}}), -1);            // 0 is on the axis
    EXPECT_EQ(drive::zeros_right_of_axis({{1, 5.0}, {1e-3, 2.0}, {1, 0}}), 2);  // of five, at 36 degrees and 108
    EXPECT_EQ(drive::zeros_right_of_axis({{1, 0}, {1, 1.0}}), 0);               // in any order
    EXPECT_EQ(drive::usual_base_order(with({{1, 2}, {1, 1}, {1, 0}})), 1.0);
    Model zero = with({{1, 2}, {1, 0}});
    zero.numerator = {{1, 0.5}, {1, 0}};
    EXPECT_EQ(drive::usual_base_order(zero), 0.01);
}

}  // namespace
