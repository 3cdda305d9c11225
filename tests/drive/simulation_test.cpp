// The Grünwald-Letnikov scheme: against the exact response, a published vector, and itself by other means.
#include "drive/simulation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "base/failure.hpp"
#include "drive/fast_memory.hpp"
#include "drive/response.hpp"
#include "glsum/design/merged.hpp"
#include "glsum/design/modes.hpp"
#include "tests/drive/plants.hpp"

namespace {

using drive::Model;
using drive::Scheme;

Model undelayed() {
    Model model = plants::niopdt();
    model.delay_s = 0.0;
    return model;
}

std::vector<double> stepped(const Model& model, const Scheme& scheme, double until_s = 5.0) {
    return drive::simulate(model, scheme, drive::make_input({}, scheme.step_s, until_s)).output;
}

double largest_error(const Model& model, const std::vector<double>& output, double step_s) {
    drive::StepResponse exact(model);
    double error = 0.0;
    for (std::size_t k = 0; k < output.size(); ++k) {
        error = std::max(error, std::fabs(output[k] - exact(static_cast<double>(k) * step_s)));
    }
    return error;
}

TEST(Simulate, InDoubleWithFullMemoryIsNearTheExactResponse) {
    const double error = largest_error(undelayed(), stepped(undelayed(), {}), 0.001);
    EXPECT_LT(error, 6e-4);
    EXPECT_GT(error, 5e-4);  // it is of first order in the step, and known: 5.4e-4
    const double coarse = largest_error(undelayed(), stepped(undelayed(), {.step_s = 0.01}), 0.01);
    EXPECT_NEAR(coarse, 5.3e-3, 1e-4);
}

// FOMCON's scheme on five fractional terms and two zeros, as FractionalDiffEq.jl records it.
TEST(Simulate, ReproducesTheVectorOfAFiveTermEquation) {
    Model model;
    model.denominator = {{1, 3.5}, {8, 3.1}, {26, 2.3}, {73, 1.2}, {90, 0.5}};
    model.numerator = {{30, 1.0}, {90, 0.3}, {3, 0.0}};
    std::vector<double> input;
    for (int k = 0; k <= 10; ++k) {
        input.push_back(std::sin(0.25 * k * k));
    }
    const double expected[] = {0,
                               .0854971609134175,
                               .38289836071474537,
                               .6454389110668579,
                               .2783045139283708,
                               .043460434414588106,
                               .12348574062908478,
                               .04623359232392658,
                               -.07835912500702993,
                               .26027660764161137,
                               .2855329523586738};
    const auto found = drive::simulate(model, {.step_s = 0.5, .forcing = drive::Forcing::sampled}, input).output;
    ASSERT_EQ(found.size(), std::size(expected));
    for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_NEAR(found[k], expected[k], 1e-14) << k;
    }
    // The same through a kernel, whose orders end at 2: in increments twice would do, once does not.
    EXPECT_THROW((void)drive::simulate(model, {.step_s = 0.5, .kernel = "shift_plain_f64"}, input), glsum::Failure);
}

TEST(Simulate, SinglePrecisionFailsInTheTextbookFormAndNotInIncrements) {
    const Model model = undelayed();
    EXPECT_NEAR(stepped(model, {}).back(), 0.998, 1e-3);
    EXPECT_NEAR(stepped(model, {.merged = true, .kernel = "ring_plain_f32"}).back(), 1.147, 5e-4);
    EXPECT_NEAR(stepped(model, {.kernel = "ring_plain_f32"}).back(), 1.292, 5e-4);
    EXPECT_NEAR(stepped(model, {.taps = 600}).back(), 0.987, 1e-3);
    EXPECT_NEAR(stepped(model, {.increments = true, .kernel = "ring_oldest_f32"}).back(), 0.9977, 1e-4);
    EXPECT_LT(largest_error(model, stepped(model, {.increments = true, .kernel = "ring_oldest_f32"}), 0.001), 6e-4);
    EXPECT_LT(
        largest_error(model, stepped(model, {.taps = 600, .increments = true, .kernel = "ring_oldest_f32"}), 0.001),
        7e-3);
}

TEST(Simulate, IncrementsAreTheSameScheme) {
    const auto plain = stepped(plants::niopdt(), {});
    const auto increments = stepped(plants::niopdt(), {.increments = true});
    for (std::size_t k = 0; k < plain.size(); ++k) {
        EXPECT_NEAR(plain[k], increments[k], 1e-9) << k;
    }
}

TEST(Simulate, AKernelInDoubleIsTheMergedTable) {
    for (const bool increments : {false, true}) {
        for (const auto taps :
             {std::optional<std::size_t>(), std::optional<std::size_t>(300), std::optional<std::size_t>(1500)}) {
            const auto merged = stepped(undelayed(), {.taps = taps, .increments = increments}, 2.0);
            const auto kernel =
                stepped(undelayed(), {.taps = taps, .increments = increments, .kernel = "ring_oldest_f64"}, 2.0);
            for (std::size_t k = 0; k < merged.size(); ++k) {
                ASSERT_NEAR(merged[k], kernel[k], 1e-9) << k;
            }
        }
    }
}

TEST(Simulate, AMergedTableIsTheSumOfTheOrders) {
    for (const bool increments : {false, true}) {
        const auto apart = stepped(undelayed(), {.increments = increments, .kernel = "ring_oldest_f64"}, 1.0);
        const auto merged =
            stepped(undelayed(), {.increments = increments, .merged = true, .kernel = "ring_oldest_f64"}, 1.0);
        const auto fixed =
            stepped(undelayed(), {.increments = increments, .merged = true, .kernel = "ring_plain_q31"}, 1.0);
        for (std::size_t k = 0; k < apart.size(); ++k) {
            ASSERT_NEAR(apart[k], merged[k], 1e-9) << k;
            ASSERT_NEAR(apart[k], fixed[k], 5e-2) << k;
        }
    }
    // The Horner form takes it too, but not in fixed point, where nothing bounds its sums.
    const auto apart = stepped(undelayed(), {.kernel = "ring_oldest_f64"}, 1.0);
    const auto nested = stepped(undelayed(), {.merged = true, .kernel = "ring_horner_f64"}, 1.0);
    for (std::size_t k = 0; k < apart.size(); ++k) {
        ASSERT_NEAR(apart[k], nested[k], 1e-9) << k;
    }
    EXPECT_THROW((void)stepped(undelayed(), {.merged = true, .kernel = "ring_horner_q31"}), glsum::Failure);
}

// (1 - z) / h twice over: 1, -2, 1; on increments once: 1, -1. As many as were asked for, the newest at least.
TEST(Simulate, MergedWeightsAreAsManyAsWereAskedFor) {
    const std::vector<drive::Term> terms{{1.0, 2.0}, {3.0, 0.0}};
    const auto weights = [&](std::size_t count, bool increments) {
        return drive::merged_weights(terms, 0.5, count, increments);
    };
    EXPECT_EQ(weights(4, false), (std::vector{7.0, -8.0, 4.0, 0.0}));
    EXPECT_EQ(weights(4, true), (std::vector{4.0, -4.0, 0.0, 0.0}));
    EXPECT_EQ(weights(1, false), std::vector{7.0});
    EXPECT_EQ(weights(0, false), std::vector{7.0});
    EXPECT_EQ(weights(0, true), std::vector{4.0});
}

// 16 multiplications where 5000 taps err as much; as a table of its own for each order, and one for all.
TEST(Simulate, ModesStandForFullMemory) {
    const auto full = stepped(undelayed(), {.increments = true}, 5.0);
    const auto off = [&](const drive::Scheme& scheme) {
        const auto found = stepped(undelayed(), scheme, 5.0);
        double largest = 0.0;
        for (std::size_t k = 0; k < full.size(); ++k) {
            largest = std::max(largest, std::fabs(found[k] - full[k]));
        }
        return largest;
    };
    EXPECT_LT(off({.taps = 16, .increments = true, .merged = true, .kernel = "modes_plain_f64"}), 5e-4);
    EXPECT_LT(off({.taps = 30, .increments = true, .merged = true, .kernel = "modes_compensated_f32"}), 1e-4);
    EXPECT_LT(off({.taps = 30, .increments = true, .kernel = "modes_plain_f64"}), 1e-6);
    EXPECT_GT(off({.taps = 30, .increments = true, .kernel = "ring_oldest_f64"}), 1e-2);
    EXPECT_THROW((void)stepped(undelayed(), {.increments = true, .kernel = "modes_plain_f64"}), glsum::Failure);
    EXPECT_THROW((void)stepped(undelayed(), {.taps = 16, .merged = true, .kernel = "modes_plain_f64"}), glsum::Failure);
}

// Of 16 coefficients those that modes leave are near taps, one more than increments of one order need: the recursion
// written out.
TEST(Simulate, OneTableWithModesIsItsRecursion) {
    const Model model = undelayed();
    const double h = 0.001;
    const auto found =
        stepped(model, {.taps = 17, .increments = true, .merged = true, .kernel = "modes_plain_f64"}, 2.0);
    const std::size_t count = found.size();
    const std::size_t wanted = glsum::design::modes_within(0.5, 16);
    const std::size_t near_taps = 17 - 2 * wanted;
    const std::vector<glsum::design::Term> terms = {{0.18234, 1.9909}, {0.65536, 0.98319}};
    const auto gl = glsum::design::Discretisation::grunwald_letnikov;
    const std::vector<double> weights = glsum::design::merged_weights(terms, h, gl, near_taps);
    const auto table = glsum::design::approximate_merged(terms, h, gl, count, near_taps, wanted);
    ASSERT_GT(table.modes.size(), 4U);
    std::vector<double> memories(table.modes.size(), 0.0);
    std::vector<double> moved(count, 0.0);
    double y = 0.0;
    for (std::size_t k = 1; k < count; ++k) {
        double rest = 1.0 - 0.9992 * y;
        for (std::size_t j = 1; j < near_taps && j <= k; ++j) {
            rest -= weights[j] * moved[k - j];
        }
        for (std::size_t m = 0; m < memories.size(); ++m) {
            memories[m] = (1.0 - table.modes[m].decay) * memories[m] + (k >= near_taps ? moved[k - near_taps] : 0.0);
            rest -= table.modes[m].weight * memories[m];
        }
        moved[k] = rest / (weights[0] + 0.9992);
        y += moved[k];
        ASSERT_NEAR(found[k], y, 1e-9) << k;
    }
}

TEST(Simulate, FixedPointInIncrementsSeesItsScale) {
    const auto input = drive::make_input({}, 0.001, 5.0);
    const auto q31 = drive::simulate(undelayed(), {.increments = true, .kernel = "ring_plain_q31"}, input);
    EXPECT_EQ(q31.full_scale, 4.0);
    EXPECT_EQ(q31.saturations, 0U);
    EXPECT_LT(largest_error(undelayed(), q31.output, 0.001), 2e-2);
    const auto narrow = drive::simulate(undelayed(), {.kernel = "ring_plain_q31", .full_scale = 0.5}, input);
    EXPECT_GT(narrow.saturations, 0U);
}

TEST(Simulate, WaitsForTheDeadTimeAndTheSecondSample) {
    const auto output = stepped(plants::niopdt(), {});
    EXPECT_EQ(output[1000], 0.0);
    EXPECT_GT(output[1001], 0.0);
    const auto immediate = stepped(undelayed(), {});
    for (std::size_t k = 0; k + 1000 < output.size(); ++k) {
        EXPECT_NEAR(output[k + 1000], immediate[k], 1e-10);
    }
    EXPECT_TRUE(drive::delay_fits(plants::fopdt(), 0.0001));
    EXPECT_FALSE(drive::delay_fits(plants::fopdt(), 0.001));
}

TEST(Simulate, RefusesWhatItCannotDo) {
    EXPECT_THROW((void)stepped(undelayed(), {.kernel = "ring_plane_f32"}), glsum::Failure);
    EXPECT_THROW((void)drive::simulate(undelayed(), {.step_s = 0.0}, std::vector<double>(3)), glsum::Failure);
    EXPECT_THROW((void)drive::make_input({.name = "square"}, 0.001, 1.0), glsum::Failure);
    EXPECT_THROW((void)drive::make_input({}, 0.001, 0.0), glsum::Failure);
}

TEST(Excitation, PulsesAndStairs) {
    const auto pulse = drive::make_input({.name = "pulse", .amplitude = 0.27}, 0.001, 5.0);
    EXPECT_EQ(pulse.size(), 5001U);
    EXPECT_EQ(pulse[2599], 0.27);
    EXPECT_EQ(pulse[2600], 0.0);
    const auto stairs = drive::make_input({.name = "staircase", .amplitude = 1.0, .stairs = 2}, 1.0, 7.0);
    EXPECT_EQ(stairs, (std::vector<double>{0.5, 0.5, 1, 1, 0.5, 0.5, 0, 0}));
}

TEST(Excitation, IsALogWithoutAnOutput) {
    const drive::Log log = drive::make_log({.name = "pulse", .amplitude = 0.5, .off_s = 0.25}, 0.125, 0.5);
    EXPECT_EQ(log.name, "pulse");
    EXPECT_EQ(log.time_s, (std::vector<double>{0.0, 0.125, 0.25, 0.375, 0.5}));
    EXPECT_EQ(log.input, (std::vector<double>{0.5, 0.5, 0.0, 0.0, 0.0}));
    EXPECT_TRUE(log.output.empty());
}

TEST(FastMemory, IsTheDirectSum) {
    const std::size_t count = 5000;
    const auto weights = drive::merged_weights(undelayed().denominator, 0.001, count);
    drive::FastMemory memory(weights);
    std::vector<double> samples;
    double magnitude = 0.0;
    for (const double weight : weights) {
        magnitude += std::fabs(weight);
    }
    for (std::size_t k = 0; k < count; ++k) {
        double direct = 0.0;
        for (std::size_t j = k; j > 0; --j) {
            direct += weights[j] * samples[k - j];
        }
        ASSERT_NEAR(memory.past(), direct, 1e-15 * magnitude) << k;
        samples.push_back(std::sin(0.37 * static_cast<double>(k)));
        memory.push(samples.back());
    }
}

}  // namespace
