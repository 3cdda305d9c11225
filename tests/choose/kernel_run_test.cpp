// Kernels run over what a derivative is judged by, with filters that are made by hand: noise and errors by closed
// forms.
#include "bench/choose/kernel_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "bench/choose/derivative_errors.hpp"
#include "bench/choose/would_do.hpp"
#include "bench/sweep/host_line.hpp"
#include "glsum/bound.hpp"
#include "glsum/registry.hpp"

namespace {

using glsum::design::Band;
using glsum::design::DerivativeGoal;
using glsum::design::FilterKind;
using glsum::design::FittedFilter;

constexpr double h = 0.001;

// |w^v| and t^-v / Gamma(1 - v).
double response_of(double order, double hz) { return std::pow(2.0 * std::numbers::pi * hz, order); }
double step_of(double order, double time_s) { return std::pow(time_s, -order) / std::tgamma(1.0 - order); }

// c (1 + w/z) in a window of two taps.
FittedFilter two_taps(double factor, double weight) { return {factor, {weight}, {}, {}}; }

// The bound of any record at full scale, relative to the least that is wanted. That is a derivative's at the band's low
// end and the step's late one, an integral's at the others.
TEST(KernelNoise, OfAWindowIsItsPromisedBoundOfTheLeastThatIsWanted) {
    using K = glsum::Sum<glsum::Ring, glsum::Plain, glsum::F32>;
    for (const double order : {0.5, -0.5}) {
        for (const double factor : {31.0, -31.0}) {
            const FittedFilter fitted = two_taps(factor, -0.5);
            const DerivativeGoal goal{order, h, Band{2.0, 50.0}, 2.0};
            const choose::Held held = choose::hold("ring_plain_f32", 2, goal, fitted);
            ASSERT_EQ(held.fault, "");
            EXPECT_TRUE(held.as_fitted);
            EXPECT_EQ(held.filter.taps, (std::vector<double>{factor, -0.5 * factor}));
            glsum::Design design{order, 2};
            design.weights = fitted.weights;
            bench::HostLine<K> line(design);
            // Two seconds are longer than a period of 2 Hz.
            const double bound = 31.0 * glsum::error_bound<K>(design, line.state(), 1.0, 2000);
            EXPECT_GT(bound, 0.0);
            const double least_of_band = response_of(order, order > 0.0 ? 2.0 : 50.0);
            const double least_of_step = step_of(order, order > 0.0 ? 2.0 : 10.0 * h);
            EXPECT_NEAR(held.band_noise * least_of_band / bound, 1.0, 1e-12) << order;
            EXPECT_NEAR(held.step_noise * least_of_step / bound, 1.0, 1e-12) << order;
        }
    }
    // What a goal does not ask for has no noise.
    EXPECT_EQ(choose::hold("ring_plain_f32", 2, {0.5, h, {}, 2.0}, two_taps(1.0, -0.5)).band_noise, 0.0);
    EXPECT_EQ(choose::hold("ring_plain_f32", 2, {0.5, h, Band{2.0, 50.0}, {}}, two_taps(1.0, -0.5)).step_noise, 0.0);
}

// Averages in double differ from the filter's own by roundings alone, over sines as over a step.
TEST(KernelNoise, OfDoubleIsOfItsRoundingAlone) {
    const auto noise_is_rounding = [](const char* kernel, FilterKind kind, double first_decay) {
        FittedFilter fitted{2.0, {-0.5}, {}, {}};
        fitted.modes = {{.decay = first_decay, .weight = 0.03125}, {.decay = 0.25, .weight = -0.125}};
        fitted.kind = kind;
        const DerivativeGoal goal{-0.5, h, Band{2.0, 50.0}, 0.5};
        const choose::Held held = choose::hold(kernel, 6, goal, fitted);
        EXPECT_EQ(held.fault, "") << kernel;
        EXPECT_FALSE(held.as_fitted) << kernel;
        // Sums of some hundreds, relative to the least wanted: 1 / sqrt(w) of 50 Hz and sqrt(t) of ten samples.
        EXPECT_LT(held.band_noise, 1e-10) << kernel;
        EXPECT_LT(held.step_noise, 1e-10) << kernel;
    };
    noise_is_rounding("modes_plain_f64", FilterKind::samples, 0.0625);
    noise_is_rounding("modesdelta_plain_f64", FilterKind::increments, 0.0625);
    noise_is_rounding("modessum_plain_f64", FilterKind::integrator, 0.0);
}

// Of an integral of order 1 a window stays at c (1 + w), where t is wanted.
TEST(KernelRun, AStepIsHeldAgainstTimeFromItsTenthSampleToItsLast) {
    const auto ran = [](double factor) {
        return choose::run("ring_oldest_f64", 2, {-1.0, h, {}, 0.1}, two_taps(factor, 1.0));
    };
    // 0.5 of 0.01 at the first that counts; an earlier one would be farther off.
    EXPECT_NEAR(ran(0.25).step, 49.0, 1e-9);
    EXPECT_NEAR(ran(0.25).step_s, 0.01, 1e-15);
    // 0.01 of 0.1 at the last.
    EXPECT_NEAR(ran(0.005).step, 0.9, 1e-12);
    EXPECT_NEAR(ran(0.005).step_s, 0.1, 1e-15);
    EXPECT_EQ(ran(0.25).band, 0.0);
    EXPECT_EQ(ran(0.25).band_hz, 0.0);
    // Nothing of a step where none is asked for.
    const auto band = choose::run("ring_oldest_f64", 2, {-1.0, h, Band{2.0, 50.0}, {}}, two_taps(0.25, 1.0));
    EXPECT_EQ(band.step, 0.0);
    EXPECT_EQ(band.step_s, 0.0);
    EXPECT_GT(band.band, 0.0);
}

// A sine of the band's one frequency: |c w (1 + 1/z) j - 1|.
TEST(KernelRun, ASineIsHeldAgainstItsDerivative) {
    const auto ran = choose::run("ring_oldest_f64", 2, {-1.0, h, Band{20.0, 20.0}, {}}, two_taps(0.25, 1.0));
    const double w = 2.0 * std::numbers::pi * 20.0;
    const std::complex<double> own = 0.25 * (1.0 + std::polar(1.0, -w * h));
    EXPECT_NEAR(ran.band, std::abs(own * std::complex<double>(0.0, w) - 1.0), 1e-6);
    EXPECT_DOUBLE_EQ(ran.band_hz, 20.0);
}

// Every length to 16, then each an eighth longer than the last.
TEST(DerivativeLengths, OfAWindowRiseByAnEighth) {
    choose::DerivativeErrors errors({0.5, h, Band{0.5, 80.0}, {}});
    const std::vector<std::size_t> expected = {1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15,
                                               16, 18, 20, 22, 24, 27, 30, 33, 37, 41, 46, 51, 57, 64};
    EXPECT_EQ(errors.lengths("ring_plain_f32").value(), expected);
    EXPECT_EQ(errors.longest(), 64U);
    EXPECT_EQ(errors.longest_of("modes_plain_f32"), 40U);
    EXPECT_EQ(errors.lengths("modes_plain_f32")->front(), 1U);
    EXPECT_EQ(errors.lengths("modes_plain_f32")->at(20), 21U);
    // No filter is a truncated one, and its rounding is in its error.
    EXPECT_EQ(errors.truncation(1), 0.0);
    EXPECT_EQ(errors.rounding_bound("ring_plain_f32", 1), 0.0);
    EXPECT_EQ(errors.patience(), 6U);
}

TEST(DerivativeErrors, AreToldAtTheBandWhereBothAreAsLarge) {
    EXPECT_EQ(choose::worst_place({0.25, 7.5, 0.25, 1.0}), "7.5 Hz");
    EXPECT_EQ(choose::worst_place({0.25, 7.5, 0.2500001, 1.0}), "1 s");
}

// Half the highest frequency is asked for as long as it is no lower than the lowest.
TEST(WouldDo, ABandOfAnOctaveMayBeHalved) {
    const auto lesser = choose::lesser_goals({0.5, h, Band{3.0, 6.0}, {}});
    ASSERT_EQ(lesser.size(), 2U);
    EXPECT_EQ(lesser[0].first, "--band 3..3");
    EXPECT_EQ(lesser[1].first, "--step-s 0.0005");
    EXPECT_EQ(choose::lesser_goals({0.5, h, Band{3.0, 5.99}, {}}).size(), 1U);
    EXPECT_EQ(choose::lesser_goals({0.5, h, {}, 2.0}).size(), 1U);
}

}  // namespace
