// Weights of higher order: published values, closed forms, and an oracle that makes them another way.
#include "glsum/design/bdf.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "reference/bdf.hpp"
#include "reference/sums.hpp"

namespace {

using glsum::design::bdf_first_weight;
using glsum::design::bdf_increment_weights;
using glsum::design::bdf_weights;
using reference::Real;

// w_j of order 1: the formulas themselves, as in every table of them.
TEST(BdfWeights, OfOrderOneAreTheFormulas) {
    const double published[3][5] = {
        {3.0 / 2, -2, 1.0 / 2, 0, 0}, {11.0 / 6, -3, 3.0 / 2, -1.0 / 3, 0}, {25.0 / 12, -4, 3, -4.0 / 3, 1.0 / 4}};
    for (unsigned steps = 2; steps <= 4; ++steps) {
        const auto a = bdf_weights(steps, 1.0, 40);
        const double first = bdf_first_weight(steps, 1.0);
        for (std::size_t j = 0; j < a.size(); ++j) {
            const double expected = j < 5 ? published[steps - 2][j] : 0.0;
            EXPECT_NEAR(first * a[j], expected, 1e-15) << steps << ", " << j;
            if (j > steps) {
                EXPECT_EQ(a[j], 0.0) << steps << ", " << j;
            }
        }
    }
}

TEST(BdfWeights, OfWholeOrdersEndAndOfOrderZeroAreOne) {
    // ((3 - 4z + z^2) / 2)^2 = (9 - 24z + 22z^2 - 8z^3 + z^4) / 4
    const double squared[] = {1, -24.0 / 9, 22.0 / 9, -8.0 / 9, 1.0 / 9};
    const auto a = bdf_weights(2, 2.0, 30);
    const auto over_increments = bdf_increment_weights(2, 2.0, 30);
    double sum = 0.0;
    for (std::size_t j = 0; j < a.size(); ++j) {
        EXPECT_NEAR(a[j], j < 5 ? squared[j] : 0.0, 1e-15);
        sum += a[j];
        EXPECT_NEAR(over_increments[j], sum, 1e-15);
        EXPECT_TRUE(j < 4 || over_increments[j] == 0.0) << j;
        EXPECT_TRUE(j < 5 || a[j] == 0.0) << j;
    }
    EXPECT_EQ(bdf_weights(4, 0.0, 3), (std::vector<double>{1, 0, 0}));
    EXPECT_EQ(bdf_increment_weights(4, 0.0, 3), (std::vector<double>{1, 1, 1}));
    EXPECT_EQ(bdf_weights(3, 0.5, 1), std::vector<double>{1});
    EXPECT_TRUE(bdf_weights(3, 0.5, 0).empty());
}

// However few are asked for: a list that is cut at its last weight keeps it.
TEST(BdfWeights, OfWholeOrdersOverIncrementsAreTheFrontOfALongerList) {
    for (const double order : {1.0, 2.0, 3.0}) {
        for (unsigned steps = 2; steps <= 4; ++steps) {
            const auto all = bdf_increment_weights(steps, order, 30);
            for (std::size_t count = 1; count < all.size(); ++count) {
                EXPECT_EQ(bdf_increment_weights(steps, order, count),
                          std::vector<double>(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)))
                    << order << ", " << steps << ", " << count;
            }
        }
    }
    EXPECT_NEAR(bdf_increment_weights(2, 1.0, 2)[1], -1.0 / 3, 1e-15);  // (3 - 4z + z^2) / 3 over 1 - z
}

// 1 / P = 2 / ((1 - z)(3 - z)): w_j = 1 - 3^-(j+1). It sums a signal up, with half its weight lost at the start.
TEST(BdfWeights, OfOrderMinusOneIntegrate) {
    const auto a = bdf_weights(2, -1.0, 100);
    for (std::size_t j = 0; j < a.size(); ++j) {
        EXPECT_NEAR(bdf_first_weight(2, -1.0) * a[j], 1.0 - std::pow(3.0, -static_cast<double>(j) - 1), 2e-16) << j;
    }
    for (unsigned steps = 2; steps <= 4; ++steps) {
        EXPECT_NEAR(bdf_first_weight(steps, -1.0) * bdf_weights(steps, -1.0, 200).back(), 1.0, 1e-15) << steps;
    }
}

// Twice a half derivative is one: the weights' squares, as series, are the formula's.
TEST(BdfWeights, OfHalfOrderAreASquareRoot) {
    for (unsigned steps = 2; steps <= 4; ++steps) {
        const auto half = bdf_weights(steps, 0.5, 200);
        const auto whole = bdf_weights(steps, 1.0, 200);
        for (std::size_t n = 0; n < half.size(); ++n) {
            double sum = 0.0;
            for (std::size_t j = 0; j <= n; ++j) {
                sum += half[j] * half[n - j];
            }
            EXPECT_NEAR(sum, whole[n], 2e-15) << steps << ", " << n;
        }
    }
}

TEST(BdfWeights, AreTheOraclesToTheLastBit) {
    for (unsigned steps = 2; steps <= 4; ++steps) {
        for (const double order : {0.2, 0.5, 0.9, 0.98319, 1.5, 1.9909, -0.5, -1.0, -1.5}) {
            const std::string where = std::to_string(steps) + " steps, order " + std::to_string(order);
            const std::size_t count = 2000;
            const auto exact = reference::bdf_weights(steps, Real(order), count);
            const auto exact_sums = reference::bdf_increment_weights(steps, Real(order), count);
            const auto found = bdf_weights(steps, order, count);
            const auto found_sums = bdf_increment_weights(steps, order, count);
            ASSERT_EQ(found.size(), count);
            ASSERT_EQ(found_sums.size(), count);
            double furthest = 0.0;  // in units of half the last place, for numbers of the same exponent
            for (std::size_t j = 0; j < count; ++j) {
                for (const auto& [one, other] :
                     {std::pair(found[j], exact[j]), std::pair(found_sums[j], exact_sums[j])}) {
                    const Real off = abs(Real(one) - other) / abs(other);
                    furthest = std::max(furthest, static_cast<double>(off));
                }
            }
            EXPECT_LE(furthest, 0x1p-53 * (1 + 1e-9)) << where;
            EXPECT_NEAR(
                bdf_first_weight(steps, order) / static_cast<double>(reference::bdf_first_weight(steps, Real(order))),
                1.0, 4e-16)
                << where;
        }
    }
}

// Far out they are those of Grünwald-Letnikov: P(1-u) = u (1 + u/2 + ...).
TEST(BdfWeights, FallLikeThoseOfFirstOrder) {
    const auto gl = reference::weights(Real(0.5), 200000);
    for (unsigned steps = 2; steps <= 4; ++steps) {
        const auto a = bdf_weights(steps, 0.5, gl.size());
        EXPECT_NEAR(bdf_first_weight(steps, 0.5) * a.back() / static_cast<double>(gl.back()), 1.0, 1e-5);
    }
}

TEST(BdfWeights, OtherFormulasAreRefused) {
    for (const unsigned steps : {0U, 1U, 5U}) {
        EXPECT_THROW((void)bdf_weights(steps, 0.5, 3), std::out_of_range);
        EXPECT_THROW((void)bdf_increment_weights(steps, 0.5, 3), std::out_of_range);
        EXPECT_THROW((void)bdf_first_weight(steps, 0.5), std::out_of_range);
    }
}

}  // namespace
