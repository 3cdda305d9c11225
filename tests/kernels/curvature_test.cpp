// How fast the error of a filter bends: the bound is reached where all that is added has one phase, and exceeded
// nowhere.
#include "glsum/design/derivative_curvature.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace {

using glsum::design::Curvature;
using glsum::design::DerivativeGoal;
using glsum::design::Filter;

// f'' of a filter alone, of weights that have died out behind so many samples: -sum j^2 b_j z^-j.
std::complex<double> second_derivative(const Filter& filter, double angle) {
    constexpr std::size_t samples = 4000;
    std::complex<double> sum = 0.0;
    for (std::size_t j = 0; j < samples; ++j) {
        double weight = j < filter.taps.size() ? filter.taps[j] : 0.0;
        for (const auto& mode : filter.modes) {
            weight += j < filter.taps.size()
                          ? 0.0
                          : mode.weight * std::pow(1.0 - mode.decay, static_cast<double>(j - filter.taps.size()));
        }
        sum -= static_cast<double>(j * j) * weight * std::polar(1.0, -angle * static_cast<double>(j));
    }
    return sum;
}

const Filter slow_and_fast{{1.0, 0.5, 0.25}, {{0.05, 0.02}, {0.4, 0.3}}};
const Filter swinging{{1.0}, {{1.7, 0.4}}};

// Of order 1 the derivative itself does not bend. All weights have one sign: at 0 they add up; what changes its sign
// with each sample, at half the sample's rate.
TEST(Curvature, IsReachedWhereAllHasOnePhase) {
    const DerivativeGoal goal{1.0, 0.001};
    const double at_rest = std::abs(second_derivative(slow_and_fast, 0.0));
    EXPECT_NEAR(Curvature(slow_and_fast, goal).bound(1e-9, 1e-9), at_rest, 1e-9 * at_rest);
    const double pi = std::numbers::pi;
    const double at_the_end = std::abs(second_derivative(swinging, pi));
    EXPECT_NEAR(Curvature(swinging, goal).bound(pi, pi), at_the_end, 1e-9 * at_the_end);
    const Filter barely{{1.0}, {{1.005, 0.4}}};
    const double of_barely = std::abs(second_derivative(barely, pi));
    EXPECT_NEAR(Curvature(barely, goal).bound(pi, pi), of_barely, 1e-9 * of_barely);
}

// What the derivative adds: v (v - 1) h^-v a^(v-2), the most of an interval at the end where it is.
TEST(Curvature, HasThatOfTheDerivative) {
    const Filter none{{1.0}, {}};
    for (const double order : {-0.5, 0.5, 1.5, 2.0}) {
        const double factor = std::fabs(order * (order - 1.0)) * std::pow(0.01, -order);
        EXPECT_NEAR(Curvature(none, {order, 0.01}).bound(0.2, 0.3), factor * std::pow(0.2, order - 2.0),
                    1e-9 * factor * std::pow(0.2, order - 2.0))
            << order;
    }
}

TEST(Curvature, IsExceededNowhere) {
    const DerivativeGoal goal{1.0, 0.001};
    for (const Filter& filter : {slow_and_fast, swinging, Filter{{2.0, -1.0}, {{0.2, -0.5}, {1.5, 0.1}}}}) {
        const Curvature curvature(filter, goal);
        for (double low = 0.01; low < 3.0; low *= 1.7) {
            for (const double width : {0.0, 0.1, 0.7}) {
                const double high = std::min(low + width, std::numbers::pi);
                const double bound = curvature.bound(low, high);
                for (int i = 0; i <= 8; ++i) {
                    EXPECT_LE(std::abs(second_derivative(filter, low + (high - low) * i / 8)), bound * (1.0 + 1e-9))
                        << low << " " << high;
                }
            }
        }
    }
}

}  // namespace
