// Designs with a running sum: their certificate by definition, their cost, and the weight that a level is added up
// with.
#include "glsum/design/integral.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "glsum/design/modes.hpp"

namespace {

using glsum::Mode;
using glsum::design::weights_to;

TEST(IntegralDesignTest, KeepsTheErrorItIsAskedFor) {
    for (const double order : {-0.2, -0.5, -0.8, -1.0}) {
        for (const std::size_t horizon : {600U, 5000U}) {
            const std::vector<double> weights = weights_to(order, horizon);
            for (const double error : {1e-1, 1e-3}) {
                const auto found = glsum::design::design_integral(weights, order, error);
                ASSERT_TRUE(found.has_value()) << order << " " << horizon;
                EXPECT_LE(found->error, error);
                // By the definition, in long double.
                std::vector<long double> terms;
                for (const Mode& mode : found->modes) {
                    terms.push_back(mode.weight);
                }
                long double missed = 0.0L;
                for (std::size_t j = found->near_taps; j <= horizon; ++j) {
                    long double sum = 0.0L;
                    for (std::size_t m = 0; m < terms.size(); ++m) {
                        sum += terms[m];
                        terms[m] *= 1.0L - static_cast<long double>(found->modes[m].decay);
                    }
                    missed += std::fabs(weights[j] - sum);
                }
                EXPECT_NEAR(static_cast<double>(missed), found->error, 1e-9 + 1e-6 * error);
                if (order != -1.0) {
                    EXPECT_GT(found->modes.front().weight, 0.2 * weights.back());
                    EXPECT_LT(found->modes.front().weight, 2.0 * weights.back());
                    // A running sum for the slowest mode costs a mode more at most, here and there beside a tap.
                    const auto decaying = glsum::design::design_modes({order, horizon}, error);
                    ASSERT_TRUE(decaying.has_value());
                    EXPECT_LE(found->length(), decaying->length() + 3) << order << " " << horizon << " " << error;
                } else {
                    EXPECT_EQ(found->length(), 3U);
                }
            }
        }
    }
}

TEST(IntegralDesignTest, OfOrderMinusOneTakesTheTapsThatHigherOrdersNeed) {
    // BDF2 to the power -1: a_j = 1 - (1/3)^(j+1), but for the scale that 1 = a_0 sets.
    std::vector<double> weights;
    for (int j = 0; j <= 600; ++j) {
        weights.push_back(1.5 * (1.0 - std::pow(3.0, -(j + 1))));
    }
    ASSERT_DOUBLE_EQ(weights.front(), 1.0);
    for (const double error : {1e-1, 1e-3, 1e-6}) {
        const auto found = glsum::design::design_integral(weights, -1.0, error);
        ASSERT_TRUE(found.has_value());
        EXPECT_LE(found->error, error);
        EXPECT_GT(3.0 * found->error, 0.99 * error);  // no tap too many
        EXPECT_EQ(found->modes.size(), 1U);
    }
}

// Where so many taps leave nothing to fit, what is left is a level: the last weight, added up.
TEST(IntegralDesignTest, OfWeightsThatTheTapsReachIsALevel) {
    const std::vector<double> weights = weights_to(-0.5, 4);
    ASSERT_EQ(weights.size(), 5U);
    const auto three = glsum::design::approximate_integral(weights, -0.5, 3, 6);
    EXPECT_EQ(three.near_taps, 3U);
    ASSERT_EQ(three.modes.size(), 1U);
    EXPECT_EQ(three.modes[0].decay, 0.0);
    EXPECT_EQ(three.modes[0].weight, weights[4]);
    EXPECT_DOUBLE_EQ(three.error, std::fabs(weights[3] - weights[4]));
    // No tap beyond the last weight but one.
    const auto ten = glsum::design::approximate_integral(weights, -0.5, 10, 6);
    EXPECT_EQ(ten.near_taps, 4U);
    EXPECT_EQ(ten.error, 0.0);
    // Of order -1, whatever the length, and of others beyond it modes as asked.
    EXPECT_EQ(glsum::design::approximate_integral(weights_to(-1.0, 600), -1.0, 2, 6).modes.size(), 1U);
    EXPECT_EQ(glsum::design::approximate_integral(weights_to(-0.5, 600), -0.5, 2, 6).modes.size(), 6U);
}

TEST(IntegralDesignTest, HasNoModeTooMany) {
    const std::vector<double> weights = weights_to(-0.7, 600);
    std::size_t least = glsum::design::most_modes;
    for (const double share : {0.3, 0.1, 1e-2, 1e-4}) {
        const double error = share * std::pow(600.0, 0.7);  // all weights together grow so
        const auto found = glsum::design::design_integral(weights, -0.7, error);
        ASSERT_TRUE(found.has_value()) << share;
        least = std::min(least, found->modes.size());
        if (const std::size_t modes = found->modes.size(); modes > 1) {
            EXPECT_GT(glsum::design::approximate_integral(weights, -0.7, found->near_taps, modes - 1).error, error);
        }
    }
    EXPECT_EQ(least, 1U);
}

// 40 modes are the most that any design has: an error that takes 42 of them has none.
TEST(IntegralDesignTest, HasNoMoreModesThanAnyDesign) {
    const auto longest = glsum::design::design_integral(weights_to(-0.8, 20000), -0.8, 1e-11);
    ASSERT_TRUE(longest.has_value());
    EXPECT_LE(longest->modes.size(), glsum::design::most_modes);
    EXPECT_FALSE(glsum::design::design_integral(weights_to(-0.8, 60000), -0.8, 3e-11).has_value());
}

}  // namespace
