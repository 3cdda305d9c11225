// How noisy readings are, by the median of how neighbours differ.
#include "gap/drive/white_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace {

std::vector<double> sizes_of_differences(std::vector<double> z, std::size_t order) {
    for (std::size_t taken = 0; taken < order; ++taken) {
        for (std::size_t i = 0; i + 1 < z.size(); ++i) {
            z[i] = z[i + 1] - z[i];
        }
        z.pop_back();
    }
    for (double& size : z) {
        size = std::fabs(size);
    }
    return z;
}

TEST(WhiteNoise, IsToldByDifferencesOfEachOrderAndNotByJumps) {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal(0.0, 0.3);
    std::vector<double> z(20000);
    for (std::size_t i = 0; i < z.size(); ++i) {
        z[i] = normal(random) + (i % 1000 < 500 ? 5.0 : -5.0);
    }
    for (const std::size_t order : {1U, 2U, 3U, 8U}) {
        EXPECT_NEAR(gap::noise_by_differences(sizes_of_differences(z, order), order), 0.3, 0.3 * 0.03) << order;
    }
}

TEST(WhiteNoise, IsTheMedianOfTheirSizes) {
    EXPECT_DOUBLE_EQ(gap::noise_by_differences({9.0, 1.0, 2.0}, 0), 2.0 / 0.6745);
    EXPECT_DOUBLE_EQ(gap::noise_by_differences({9.0, 1.0, 2.0}, 1), 2.0 / (0.6745 * std::sqrt(2.0)));
    EXPECT_DOUBLE_EQ(gap::noise_by_differences({9.0, 1.0, 2.0}, 2), 2.0 / (0.6745 * std::sqrt(6.0)));
    EXPECT_EQ(gap::noise_by_differences({}, 2), 0.0);
}

}  // namespace
