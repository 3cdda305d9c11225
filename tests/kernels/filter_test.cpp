// A filter's answer to a sine and to a step, against closed forms and against running it.
#include "glsum/design/filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace {

using glsum::design::Filter;
using glsum::design::frequency_response;
using glsum::design::of_samples;
using glsum::design::step_response;

TEST(Filter, OfADifferenceIsTwiceTheSineOfHalfTheAngle) {
    for (const double angle : {1e-6, 0.1, 1.0, std::numbers::pi}) {
        const std::complex<double> response = frequency_response({{1.0, -1.0}, {}}, angle);
        EXPECT_NEAR(std::abs(response), 2.0 * std::sin(0.5 * angle), 1e-15) << angle;
        EXPECT_NEAR(std::arg(response), 0.5 * (std::numbers::pi - angle), 1e-9) << angle;
    }
}

TEST(Filter, OfAModeIsAGeometricSeries) {
    // 1 z^-2 + 0.9 z^-3 + 0.81 z^-4 ..., twice.
    const Filter filter{{0.0, 0.0}, {{0.1, 2.0}}};
    for (const double angle : {0.001, 0.3, 2.0}) {
        std::complex<double> sum;
        double weight = 2.0;
        for (int j = 2; j < 400; ++j, weight *= 0.9) {
            sum += weight * std::polar(1.0, -angle * j);
        }
        EXPECT_LT(std::abs(frequency_response(filter, angle) - sum), 1e-13) << angle;
    }
    EXPECT_EQ(step_response(filter, 1), 0.0);
    EXPECT_NEAR(step_response(filter, 2), 2.0, 1e-15);
    EXPECT_NEAR(step_response(filter, 4), 2.0 * (1.0 + 0.9 + 0.81), 1e-14);
    EXPECT_NEAR(step_response(filter, 100'000), 20.0, 1e-12);
}

// About d = 1, where a mode is but one tap more, its weights w, w (1 - d), ... fade at once, with either sign.
TEST(Filter, AModeThatFadesAtOnceIsTheSumOfItsWeights) {
    for (const double decay : {0.995, 1.0, 1.005, 1.01}) {
        const Filter filter{{0.0}, {{decay, 2.0}}};
        double weight = 2.0;
        double sum = 0.0;
        for (std::size_t k = 1; k < 6; ++k) {
            sum += weight;
            weight *= 1.0 - decay;
            EXPECT_NEAR(step_response(filter, k), sum, 1e-14) << decay << ' ' << k;
        }
    }
}

TEST(Filter, ARunningSumGrows) {
    const Filter filter{{0.5}, {{0.0, 0.25}}};
    EXPECT_EQ(step_response(filter, 0), 0.5);
    EXPECT_EQ(step_response(filter, 8), 0.5 + 0.25 * 8.0);
    // z^-1 / (1 - z^-1): at half the rate -1/2.
    EXPECT_NEAR(frequency_response(filter, std::numbers::pi).real(), 0.5 - 0.25 * 0.5, 1e-15);
}

TEST(Filter, OfIncrementsIsTheDifferenceOfOneOfSamples) {
    const Filter of_increments{{2.0, -0.5}, {{0.01, 0.3}, {0.4, -0.1}}};
    const Filter filter = of_samples(of_increments);
    ASSERT_EQ(filter.taps.size(), 3U);
    for (const double angle : {0.001, 0.3, 2.0}) {
        const std::complex<double> difference = 1.0 - std::polar(1.0, -angle);
        EXPECT_LT(std::abs(frequency_response(filter, angle) - difference * frequency_response(of_increments, angle)),
                  1e-14)
            << angle;
    }
    // Of a step the increments are 1, 0, 0, ...
    const double expected[] = {2.0, -0.5, 0.2, 0.3 * 0.99 - 0.1 * 0.6, 0.3 * 0.99 * 0.99 - 0.1 * 0.6 * 0.6};
    for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_NEAR(step_response(filter, k), expected[k], 1e-14) << k;
    }
}

TEST(Filter, SlowModesKeepTheirDigits) {
    // d = 1e-9 at an angle of 1e-9: 1/(d + i angle), to a part in a billion.
    const Filter filter{{0.0}, {{1e-9, 1.0}}};
    const std::complex<double> response = frequency_response(filter, 1e-9);
    const std::complex<double> exact = 1.0 / std::complex<double>(1e-9, 1e-9);
    EXPECT_LT(std::abs(response / exact - 1.0), 1e-8);
}

}  // namespace
