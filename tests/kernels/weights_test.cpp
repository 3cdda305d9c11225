// The weights of the kernels against 50 digits.
#include "glsum/weights.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/sums.hpp"

namespace {

TEST(Weights, AreWithinOneUnitInTheLastPlaceToALongLength) {
    for (const double order : {0.2, 0.3, 0.5, 0.7, 0.9, 0.98319, 1.5, 1.9909, -0.5, -1.5, 1e-9, 1.999999}) {
        const auto exact = reference::weights(reference::Real(order), 20000);
        glsum::Weights weights(order);
        for (std::size_t j = 1; j < exact.size(); ++j) {
            weights.next();
            const double rounded = static_cast<double>(exact[j]);
            const double unit = std::fabs(std::nextafter(rounded, 2.0 * rounded) - rounded);
            ASSERT_LE(std::fabs(reference::Exact(exact[j]).error_of(weights.weight())), unit)
                << "order " << order << ", j " << j;
            const reference::Real factor = 1 - (1 + reference::Real(order)) / reference::Real(j);
            ASSERT_NEAR(weights.factor(), static_cast<double>(factor), 1.2e-16 * std::fabs(weights.factor()));
        }
    }
}

TEST(Weights, StopAtWholeOrders) {
    glsum::Weights weights(2.0);
    const double expected[] = {-2.0, 1.0, 0.0, 0.0};
    for (const double weight : expected) {
        weights.next();
        EXPECT_EQ(weights.weight(), weight);
    }
}

TEST(Weights, AbsoluteSumHasItsKnownLimits) {
    EXPECT_NEAR(glsum::absolute_sum(0.5, 1000000), 2.0, 1e-3);
    EXPECT_NEAR(glsum::absolute_sum(0.98319, 100000), 2.0, 1e-6);
    EXPECT_NEAR(glsum::absolute_sum(1.5, 100000), 3.0, 1e-6);
    EXPECT_NEAR(glsum::absolute_sum(1.9909, 100000), 2.0 * 1.9909, 1e-9);
    EXPECT_DOUBLE_EQ(glsum::absolute_sum(-1.0, 600), 600.0);
}

// Printed by peers: a recurrence that recurses, or the Gamma function, fails beyond about 170 taps.
TEST(Weights, ReachFarBeyondTheGammaFunction) {
    glsum::Weights weights(0.5);
    for (int j = 0; j < 600; ++j) {
        weights.next();
    }
    EXPECT_DOUBLE_EQ(weights.weight(), -1.9206126162304156e-5);
}

}  // namespace
