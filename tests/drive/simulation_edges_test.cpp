// The scheme at its edges: what rounding is, short memories written out, fixed point's scale, inputs' first samples.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/failure.hpp"
#include "drive/response.hpp"
#include "drive/simulation.hpp"
#include "tests/drive/plants.hpp"

namespace {

using drive::Model;
using drive::Scheme;
using testing::Each;
using testing::ElementsAre;

Model denominator_of(std::vector<drive::Term> terms) {
    Model model;
    model.kind = drive::Kind::fotf;
    model.denominator = std::move(terms);
    return model;
}

std::vector<double> of_ones(const Model& model, const Scheme& scheme, std::size_t count) {
    return drive::simulate(model, scheme, std::vector<double>(count, 1.0)).output;
}

// A dead time is a whole number of steps up to 1e-9 of one, and else counts as one more; behind it the held input takes
// a step.
TEST(SimulationEdges, ABillionthOfAStepIsNoDeadTime) {
    const auto first_moved = [](double delay_s) {
        const auto output = of_ones(drive::make_fopdt(1.0, 1.0, delay_s), {.step_s = 1.0}, 6);
        return std::find_if(output.begin(), output.end(), [](double y) { return y != 0.0; }) - output.begin();
    };
    EXPECT_EQ(first_moved(0.0), 1);
    EXPECT_EQ(first_moved(1.0), 2);
    EXPECT_EQ(first_moved(1.0 + 0.995e-9), 2);
    EXPECT_EQ(first_moved(1.0 + 1.005e-9), 3);
}

// Of several steps the billionth is of them all.
TEST(SimulationEdges, ADeadTimeFitsToABillionth) {
    const auto fits = [](double delay_s) { return drive::delay_fits(drive::make_fopdt(1.0, 1.0, delay_s), 1.0); };
    EXPECT_TRUE(fits(0.995e-9));
    EXPECT_FALSE(fits(1e-9));
    EXPECT_FALSE(fits(1.005e-9));
    EXPECT_TRUE(fits(1000.0 + 0.995e-6));
    EXPECT_FALSE(fits(1000.0 + 1.005e-6));
    EXPECT_TRUE(fits(1000.0 - 0.995e-6));
    EXPECT_FALSE(fits(1000.0 - 1.005e-6));
}

TEST(SimulationEdges, AConstantAboveIsAGain) {
    Model model = drive::make_fopdt(1.0, 1.0, 0.0);
    const auto one = of_ones(model, {.step_s = 1.0}, 8);
    model.numerator = {{1.01, 0.0}};
    const auto more = of_ones(model, {.step_s = 1.0}, 8);
    for (std::size_t k = 0; k < one.size(); ++k) {
        EXPECT_NEAR(more[k], 1.01 * one[k], 1e-15) << k;
    }
}

// y + y' = 1 in steps of 1 s: (1 + y_(k-1)) / 2, of which no double rounds anything, whatever sums it up.
TEST(SimulationEdges, HalvesAreExact) {
    const Model model = drive::make_fopdt(1.0, 1.0, 0.0);
    for (const char* kernel : {"", "ring_oldest_f64", "shift_plain_f64"}) {
        const auto found = drive::simulate(model, {.step_s = 1.0, .kernel = kernel}, std::vector<double>(40, 1.0));
        for (std::size_t k = 0; k < 40; ++k) {
            EXPECT_EQ(found.output[k], 1.0 - std::exp2(-static_cast<double>(k))) << kernel << ' ' << k;
        }
        EXPECT_EQ(found.saturations, 0U);
        EXPECT_EQ(found.full_scale, 0.0);
    }
}

// Two taps are the newest and the one before: of y + D^(1/2) y = u that is 2 y_k - y_(k-1) / 2 = u_k, and y_0 is 0
// whatever the input is. More taps than samples are as many as samples.
TEST(SimulationEdges, AShortMemoryIsItsTaps) {
    const Model model = denominator_of({{1.0, 0.5}, {1.0, 0.0}});
    const std::vector<double> input = {1.0, 2.0, -1.0, 0.5, 3.0, 1.0};
    const auto found =
        drive::simulate(model, {.step_s = 1.0, .taps = 2, .forcing = drive::Forcing::sampled}, input).output;
    double y = 0.0;
    for (std::size_t k = 0; k < input.size(); ++k) {
        y = k == 0 ? 0.0 : (input[k] + 0.5 * y) / 2.0;
        EXPECT_EQ(found[k], y) << k;
    }
    EXPECT_EQ(drive::simulate(model, {.step_s = 1.0, .taps = 9, .forcing = drive::Forcing::sampled}, input).output,
              drive::simulate(model, {.step_s = 1.0, .forcing = drive::Forcing::sampled}, input).output);
}

// The power of two from twice the largest steady output on, and of a plant that has none, from twice the input.
TEST(SimulationEdges, FullScaleIsAPowerOfTwo) {
    const auto scale = [](double constant, double peak) {
        return drive::simulate(denominator_of({{1.0, 0.5}, {constant, 0.0}}),
                               {.step_s = 1.0, .kernel = "ring_plain_q31"}, std::vector<double>(4, -peak))
            .full_scale;
    };
    EXPECT_EQ(scale(0.75, 3.0), 8.0);
    EXPECT_EQ(scale(0.75, 3.001), 16.0);
    EXPECT_EQ(scale(0.0, 2.0), 4.0);
    EXPECT_EQ(scale(0.0, 2.01), 8.0);
}

// Each sum stores a sample and tells its value once a step: more cannot fail to fit.
TEST(SimulationEdges, SaturationsAreCounted) {
    Model model = plants::niopdt();
    model.delay_s = 0.0;
    const auto found =
        drive::simulate(model, {.kernel = "ring_plain_q31", .full_scale = 0.5}, drive::make_input({}, 0.001, 5.0));
    EXPECT_GT(found.saturations, 0U);
    EXPECT_LE(found.saturations, 4U * 5001U);
}

TEST(ExcitationEdges, ARecordIsOfTwoToTenMillionSamples) {
    const auto samples = [](double step_s, double until_s) { return drive::make_input({}, step_s, until_s).size(); };
    EXPECT_EQ(samples(1.0, 1.0), 2U);
    EXPECT_EQ(samples(1.0, 2.0 - 0.995e-9), 3U);
    EXPECT_EQ(samples(1.0, 2.0 - 1.005e-9), 2U);
    EXPECT_EQ(samples(1024.0, 1024.0 * 1024.0 * 16.0), 16385U);
    EXPECT_THROW((void)samples(1.0, 0.99), glsum::Failure);
    EXPECT_THROW((void)samples(0.0, 1.0), glsum::Failure);
    EXPECT_THROW((void)samples(0.0625, 630000.0), glsum::Failure);
}

TEST(ExcitationEdges, APulseThatEndsAtOnceIsNone) {
    EXPECT_THAT(drive::make_input({.name = "pulse", .off_s = 0.0}, 0.5, 2.0), Each(0.0));
    EXPECT_THAT(drive::make_input({.name = "pulse", .off_s = 0.5}, 0.5, 2.0), ElementsAre(1.0, 0.0, 0.0, 0.0, 0.0));
}

}  // namespace
