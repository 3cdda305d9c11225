// The paper's model (12) stepped in single precision with a handful of multiplications, against its exact response.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "glsum/design/merged.hpp"

namespace {

using glsum::design::approximate_merged;
using glsum::design::Approximation;
using glsum::design::Discretisation;
using glsum::design::Term;

// 0.18234 D^1.9909 y + 0.65536 D^0.98319 y + 0.9992 y = u
constexpr Term terms[] = {{0.18234, 1.9909}, {0.65536, 0.98319}};
constexpr double stiffness = 0.9992;
constexpr double step_s = 1e-3;

// The step response by numerical inverse Laplace and by a series of Mittag-Leffler type, which agree in 18 digits.
struct Exact {
    double time_s;
    double value;
};
constexpr Exact exact[] = {{0.01, 2.85057556271580179e-4}, {0.1, 0.0250885673516995016}, {0.25, 0.129455821227154699},
                           {0.5, 0.375940553423532329},    {0.75, 0.613178259304225926}, {1, 0.79280738172774321},
                           {1.5, 0.973167579701079693},    {2, 1.0119932474053863},      {3, 0.999400058443313765},
                           {4, 0.996322242433827299},      {5, 0.997714465898579909},    {10, 0.999486138627598309}};

struct Scheme {
    std::size_t near_taps;
    std::size_t modes;
    Discretisation discretisation;
};

// Largest error over the published times of single-precision stepping, y carried in two words.
double largest_error(const Scheme& scheme) {
    const Approximation table =
        approximate_merged(terms, step_s, scheme.discretisation, 60000, scheme.near_taps, scheme.modes);
    const auto weights = merged_weights(terms, step_s, scheme.discretisation, scheme.near_taps);
    const double first = weights[0] + stiffness;
    std::vector<float> past(scheme.near_taps + 1, 0.0F);
    std::vector<float> states(table.modes.size(), 0.0F);
    const bool second_order = scheme.discretisation == Discretisation::bdf2;
    float y = 0.0F;
    float carry = 0.0F;
    double largest = 0.0;
    for (int k = second_order ? 0 : 1; k <= 10000; ++k) {
        std::rotate(past.begin(), past.end() - 1, past.end());
        float sum = 0.0F;
        for (std::size_t m = 0; m < states.size(); ++m) {
            const auto decay = static_cast<float>(table.modes[m].decay);
            states[m] += decay * (past[scheme.near_taps] - states[m]);
            sum += static_cast<float>(table.modes[m].weight / table.modes[m].decay / first) * states[m];
        }
        for (std::size_t j = scheme.near_taps - 1; j >= 1; --j) {
            sum += static_cast<float>(weights[j] / first) * past[j];
        }
        const float u = second_order && k == 0 ? 0.5F : 1.0F;
        past[0] = static_cast<float>(1.0 / first) * u - static_cast<float>(stiffness / first) * y - sum;
        const float step = past[0] + carry;
        const float next = y + step;
        carry = step - (next - y);
        y = next;
        for (const Exact& point : exact) {
            if (k == std::lround(point.time_s / step_s)) {
                largest = std::max(largest, std::fabs(static_cast<double>(y) - point.value));
            }
        }
    }
    return largest;
}

TEST(MergedModes, FirstOrderNeedsSixteenMultiplications) {
    // Full memory in double errs by 5.4e-4: the discretisation's own error. 600 taps of increments err by 6.9e-3.
    EXPECT_LT(largest_error({2, 7, Discretisation::grunwald_letnikov}), 7e-4);
}

TEST(MergedModes, SecondOrderNeedsTwentyFourAndTwentyEight) {
    EXPECT_LT(largest_error({6, 9, Discretisation::bdf2}), 1e-4);
    EXPECT_LT(largest_error({6, 11, Discretisation::bdf2}), 2e-5);
}

TEST(MergedModes, WeightsAreTheConvolutionByDefinition) {
    // Order 1: increments themselves, m = c/h, 0, 0, ...; and bdf2's (3 - z)/2.
    const Term derivative[] = {{2.0, 1.0}};
    const auto first = merged_weights(derivative, 0.5, Discretisation::grunwald_letnikov, 3);
    EXPECT_EQ(first, (std::vector<double>{4.0, 0.0, 0.0, 0.0}));
    const auto second = merged_weights(derivative, 0.5, Discretisation::bdf2, 3);
    EXPECT_NEAR(second[0], 6.0, 1e-15);
    EXPECT_NEAR(second[1], -2.0, 1e-15);
    EXPECT_NEAR(second[2], 0.0, 1e-15);
    // Two terms add.
    const auto both = merged_weights(terms, step_s, Discretisation::grunwald_letnikov, 10);
    const auto one = merged_weights(std::span(terms).first(1), step_s, Discretisation::grunwald_letnikov, 10);
    const auto other = merged_weights(std::span(terms).last(1), step_s, Discretisation::grunwald_letnikov, 10);
    for (std::size_t j = 0; j <= 10; ++j) {
        EXPECT_DOUBLE_EQ(both[j], one[j] + other[j]);
    }
    EXPECT_TRUE(approximate_merged(derivative, 0.5, Discretisation::grunwald_letnikov, 100, 2, 5).modes.empty());
}

}  // namespace
