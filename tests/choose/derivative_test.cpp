// What kernels hold of a filter fitted to a derivative, the noise of their arithmetic, and what running them gives.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "bench/choose/derivative_errors.hpp"
#include "bench/choose/derivative_text.hpp"
#include "bench/choose/kernel_run.hpp"
#include "bench/choose/question.hpp"
#include "bench/choose/would_do.hpp"
#include "tests/choose/costs_by.hpp"

namespace {

using choose::DerivativeErrors;
using choose::hold;
using glsum::design::Band;
using glsum::design::DerivativeGoal;
using glsum::design::FilterKind;
using glsum::design::fit_filter;
using glsum::design::FittedFilter;

DerivativeGoal goal_of(double order, double step_until_s) {
    DerivativeGoal goal{order, 0.001, Band{0.5, 80.0}};
    if (step_until_s > 0.0) {
        goal.step_until_s = step_until_s;
    }
    return goal;
}

TEST(HeldFilter, IsTheDesignAsFarAsTheFormatHasDigits) {
    const DerivativeGoal goal = goal_of(0.5, 2.0);
    const FittedFilter fitted = fit_filter(goal, 2, 4, FilterKind::samples);
    const auto largest_difference = [&](const char* kernel) {
        const auto held = hold(kernel, 10, goal, fitted);
        EXPECT_EQ(held.fault, "") << kernel;
        EXPECT_EQ(held.filter.taps.size(), 2U);
        EXPECT_EQ(held.filter.modes.size(), 4U);
        double largest = std::fabs(held.filter.taps[1] / fitted.filter().taps[1] - 1.0);
        for (std::size_t m = 0; m < fitted.modes.size(); ++m) {
            const auto& mode = held.filter.modes.at(m);
            largest = std::max(largest, std::fabs(mode.decay / fitted.modes[m].decay - 1.0));
            largest = std::max(largest, std::fabs(mode.weight / (fitted.factor * fitted.modes[m].weight) - 1.0));
        }
        return largest;
    };
    EXPECT_LT(largest_difference("modes_plain_f64"), 1e-15);
    EXPECT_GT(largest_difference("modes_plain_f32"), 1e-10);
    EXPECT_LT(largest_difference("modes_plain_f32"), 2e-7);
    EXPECT_GT(largest_difference("modes_plain_q31"), 1e-12);
    EXPECT_LT(largest_difference("modes_plain_q31"), 1e-6);
}

TEST(HeldFilter, AnIntegratorIsItsSlowestMode) {
    const DerivativeGoal goal = goal_of(-0.5, 2.0);
    const FittedFilter fitted = fit_filter(goal, 1, 4, FilterKind::integrator);
    const auto held = hold("modessum_plain_f64", 9, goal, fitted);
    ASSERT_EQ(held.filter.modes.size(), 4U);
    EXPECT_EQ(held.filter.modes.front().decay, 0.0);
    EXPECT_DOUBLE_EQ(held.filter.modes.front().weight, fitted.factor * fitted.modes.front().weight);
}

TEST(HeldFilter, OfIncrementsIsOneOfSamples) {
    const DerivativeGoal goal = goal_of(0.5, 2.0);
    const FittedFilter fitted = fit_filter(goal, 2, 4, FilterKind::increments);
    EXPECT_LT(fitted.error.largest(), 0.05);
    const auto held = hold("modesdelta_plain_f64", 10, goal, fitted);
    EXPECT_EQ(held.fault, "");
    const auto expected = fitted.filter();
    ASSERT_EQ(held.filter.taps.size(), 3U);
    ASSERT_EQ(held.filter.modes.size(), 4U);
    for (std::size_t j = 0; j < 3; ++j) {
        EXPECT_NEAR(held.filter.taps[j] / expected.taps[j], 1.0, 1e-13) << j;
    }
    EXPECT_NEAR(held.filter.modes[0].weight / expected.modes[0].weight, 1.0, 1e-13);
    EXPECT_LT(held.step_noise, 1e-10);
    // In single precision, as a cascade, whose poles and zeros move by their last places.
    const auto cascaded = hold("cascadedelta_df2t_f32", 10, goal, fitted);
    EXPECT_EQ(cascaded.fault, "");
    EXPECT_NEAR(certified_error(cascaded.filter, goal).band, certified_error(held.filter, goal).band, 1e-3);
    // A window of increments, whose noise is its promised bound.
    const FittedFilter window = fit_filter(goal, 20, 0, FilterKind::increments);
    EXPECT_EQ(hold("mirrordelta_oldest_f64", 20, goal, window).fault, "");
}

TEST(HeldFilter, NoiseIsOfTheFormatAndOfTheRecord) {
    const DerivativeGoal goal = goal_of(0.5, 200.0);
    const FittedFilter fitted = fit_filter(goal, 1, 6, FilterKind::samples);
    const auto noise = [&](const char* kernel) { return hold(kernel, 13, goal, fitted).step_noise; };
    EXPECT_LT(noise("modes_plain_f64"), 1e-10);
    EXPECT_LT(noise("modes_compensated_f32"), 1e-4);
    // Slow averages stop where their step is below half a unit of their last place.
    EXPECT_GT(noise("modes_plain_f32"), 10.0 * noise("modes_compensated_f32"));
}

TEST(HeldFilter, NoiseOfASineIsRelativeToTheDerivativeAtItsOwnFrequency) {
    // From end to end |w^v| changes by more than a thousand: what is lost in the large is much of the small.
    const auto check = [](double order, const char* kernel, FilterKind kind) {
        const FittedFilter fitted = fit_filter({order, 0.001, Band{0.02, 80.0}, {}}, 1, 5, kind);
        const auto noise = [&](double low_hz, double high_hz) {
            return hold(kernel, 11, {order, 0.001, Band{low_hz, high_hz}, {}}, fitted).band_noise;
        };
        const double middle_hz = std::sqrt(0.02 * 80.0);
        const double largest_alone = std::max({noise(0.02, 0.02), noise(middle_hz, middle_hz), noise(80.0, 80.0)});
        // Alone they are run for fewer samples.
        EXPECT_LT(noise(0.02, 80.0), 10.0 * largest_alone) << kernel;
        EXPECT_GE(noise(0.02, 80.0), 0.5 * largest_alone) << kernel;
    };
    check(-0.9, "modes_plain_f32", FilterKind::samples);
    check(1.5, "modesdelta_plain_f32", FilterKind::increments);
    check(1.5, "cascadedelta_df2t_f32", FilterKind::increments);
}

TEST(DerivativeReport, WhatRunningGivesIsWithinTheCertificate) {
    for (const double order : {0.5, 0.9, -0.5}) {
        const DerivativeGoal goal = goal_of(order, 2.0);
        for (const char* kernel : {"modes_plain_f32", "modes_compensated_f32", "modes_plain_q31", "modessum_plain_f32",
                                   "modesdelta_plain_f32", "cascadedelta_df2t_f32"}) {
            if (std::string(kernel) == "modessum_plain_f32" && order > 0.0) {
                continue;
            }
            DerivativeErrors errors(goal);
            for (const std::size_t taps : {7U, 11U}) {
                const auto at = errors.error(kernel, taps);
                if (!at.fault.empty()) {
                    continue;
                }
                const auto report = choose::report_on(kernel, taps, goal, errors.filter_of(kernel, taps));
                EXPECT_LE(report.measured.band, report.certified.band + 1e-5) << kernel << ", " << order;
                EXPECT_LE(report.measured.step, report.certified.step + 1e-9) << kernel << ", " << order;
                EXPECT_GT(report.measured.band, 0.3 * report.certified.band) << kernel << ", " << order;
                EXPECT_EQ(at.error, report.certified.largest()) << kernel << ", " << order;
            }
        }
    }
}

// Sines of nine frequencies from end to end, each as many times the one before; their responses are the filter's to a
// millionth, though a window of theirs is no whole number of periods.
TEST(DerivativeReport, RunsSinesOfNineFrequencies) {
    for (const auto& [low_hz, high_hz] : {std::pair(0.5, 80.0), std::pair(7.3, 191.0), std::pair(40.0, 40.0)}) {
        const DerivativeGoal goal{0.5, 0.001, Band{low_hz, high_hz}, {}};
        const FittedFilter fitted = fit_filter({0.5, 0.001, Band{0.5, 80.0}, {}}, 2, 4, FilterKind::samples);
        const auto ran = choose::run("modes_plain_f64", 10, goal, fitted);
        double largest = -1.0;
        double largest_hz = 0.0;
        for (int i = 0; i < 9; ++i) {
            const double hz = low_hz * std::pow(high_hz / low_hz, i / 8.0);
            const auto exact = glsum::design::exact_response(0.5, hz);
            const auto own = glsum::design::frequency_response(fitted.filter(), 2.0 * std::numbers::pi * hz * 0.001);
            const double error = std::abs(own - exact) / std::abs(exact);
            if (error > largest) {
                largest = error;
                largest_hz = hz;
            }
        }
        EXPECT_NEAR(ran.band, largest, 1e-6) << low_hz;
        EXPECT_DOUBLE_EQ(ran.band_hz, largest_hz) << low_hz;
    }
}

TEST(DerivativeReport, AWindowIsWithinItsPromisedBound) {
    DerivativeGoal goal{0.5, 0.001, Band{10.0, 100.0}};
    DerivativeErrors errors(goal);
    for (const char* kernel : {"ring_plain_f32", "mirror_plain_q15c31", "ring_oldest_f64"}) {
        const auto at = errors.error(kernel, 20);
        ASSERT_EQ(at.fault, "") << kernel;
        const auto report = choose::report_on(kernel, 20, goal, errors.filter_of(kernel, 20));
        EXPECT_LE(report.measured.band, report.certified.band + 1e-5) << kernel;
        EXPECT_LT(at.error, 0.2) << kernel;
    }
}

TEST(DerivativeErrors, LeavesOutWhatIsNoFilterOfItsOwn) {
    EXPECT_EQ(DerivativeErrors::why_not("ring_plain_f32"), "");
    EXPECT_EQ(DerivativeErrors::why_not("block_plain_q31"), "");
    EXPECT_EQ(DerivativeErrors::why_not("modessum_plain_f32"), "");
    EXPECT_NE(DerivativeErrors::why_not("nested_plain_f32"), "");
    EXPECT_NE(DerivativeErrors::why_not("mirrorhold_plain_f32"), "");
    EXPECT_EQ(DerivativeErrors::why_not("modesdelta_plain_f32"), "");
    DerivativeErrors errors(goal_of(0.5, 0.0));
    EXPECT_NE(errors.error("nested_plain_f32", 9).fault, "");
    EXPECT_FALSE(errors.meets("nested_plain_f32", 9, 1e9));
    EXPECT_NE(DerivativeErrors(goal_of(-0.5, 0.0)).error("modesdelta_plain_f32", 9).fault, "");
}

TEST(DerivativeErrors, KernelsOfOneGroupShareWhatIsFitted) {
    DerivativeErrors errors(goal_of(0.5, 0.0));
    EXPECT_EQ(errors.group("modes_plain_f32"), errors.group("modes_plain_q31"));
    EXPECT_EQ(errors.group("ring_plain_f32"), errors.group("mirror_smlad_q15"));
    EXPECT_NE(errors.group("modes_plain_f32"), errors.group("ring_plain_f32"));
    EXPECT_NE(errors.group("modes_plain_f32"), errors.group("modesdelta_plain_f32"));
    EXPECT_NE(errors.group("mirrordelta_plain_f32"), errors.group("ring_plain_f32"));
    // What floating point has room for is never worse than what fixed point takes, and the same without a pole.
    const FittedFilter& swinging = errors.filter_of("modes_plain_f32", 7);
    const FittedFilter& decaying = errors.filter_of("modes_plain_q31", 7);
    EXPECT_LE(swinging.error.largest(), decaying.error.largest());
    EXPECT_EQ(&swinging, &errors.filter_of("modes_compensated_f32", 7));
    EXPECT_EQ(
        swinging.error.largest(),
        fit_filter(goal_of(0.5, 0.0), 1, 3, FilterKind::samples, glsum::design::Poles::one_may_swing).error.largest());
    EXPECT_EQ(errors.filter_of("modes_plain_f32", 1).error.largest(),
              errors.filter_of("modes_plain_q31", 1).error.largest());
}

TEST(DerivativeErrors, AWindowForAnIntegralIsSoonFoundToBeNoUse) {
    // Its coefficients are large and of both signs: a near bound of what errs by all of it would take minutes.
    DerivativeErrors errors({-1.0, 0.001, Band{0.5, 40.0}, {}});
    std::size_t judged = 0;
    for (std::size_t taps = 1; taps <= 16; ++taps) {
        const auto one = errors.error("ring_oldest_f64", taps);
        if (one.fault.empty()) {
            ++judged;
            EXPECT_GT(one.error, 0.5) << taps;
            EXPECT_GE(one.error, errors.filter_of("ring_oldest_f64", taps).error.largest()) << taps;
            EXPECT_NEAR(errors.error("mirror_multi_f64", taps).error, one.error, 1e-6 * one.error) << taps;
        }
    }
    EXPECT_GE(judged, 3U);
    EXPECT_LT(errors.error("modes_plain_f64", 3).error, 0.006);
}

TEST(DerivativeErrors, EachFormatIsCertifiedForWhatItHolds) {
    const DerivativeGoal goal = goal_of(0.5, 0.0);
    DerivativeErrors errors(goal);
    for (const char* kernel : {"modes_plain_q31", "modes_plain_f32", "modes_plain_f64", "ring_oldest_f64"}) {
        const auto report = choose::report_on(kernel, 9, goal, errors.filter_of(kernel, 9));
        EXPECT_EQ(errors.error(kernel, 9).error, report.certified.largest()) << kernel;
    }
}

TEST(DerivativeErrors, WhereNoiseIsMostOfTheErrorSmallerCoefficientsAreTaken) {
    // What single precision cannot tell of a sample, w^1.5 makes much of at the low end of four decades.
    const DerivativeGoal loud{1.5, 0.001, Band{0.008, 80.0}, {}};
    const char* kernel = "modesdelta_plain_f32";
    const FittedFilter nearest = fit_filter(loud, 1, 3, FilterKind::increments);
    DerivativeErrors errors(loud);
    const auto taken = errors.error(kernel, 7);
    EXPECT_LT(taken.error, 0.9 * choose::report_on(kernel, 7, loud, nearest).certified.band);
    EXPECT_EQ(taken.error, choose::report_on(kernel, 7, loud, errors.filter_of(kernel, 7)).certified.band);
    EXPECT_GT(errors.filter_of(kernel, 7).error.band, nearest.error.band);
    // Where the noise is little, the nearest it is.
    const DerivativeGoal quiet{1.5, 0.001, Band{0.8, 80.0}, {}};
    EXPECT_EQ(DerivativeErrors(quiet).filter_of(kernel, 7).error.band,
              fit_filter(quiet, 1, 3, FilterKind::increments, glsum::design::Poles::one_may_swing).error.band);
}

TEST(DerivativeErrors, OustaloupsAndCharefsFiltersAreCertifiedAsKernelsHoldThem) {
    using choose::FilterDesign;
    for (const double order : {0.5, -0.5}) {
        const DerivativeGoal goal = goal_of(order, 0.0);
        for (const FilterDesign by : {FilterDesign::oustaloup, FilterDesign::charef}) {
            DerivativeErrors errors(goal, by);
            for (const char* kernel : {"modes_plain_f32", "modes_plain_q31", "cascade_df2t_f32", "cascade_df1_q31"}) {
                for (const std::size_t taps : {5U, 7U, 9U, 11U}) {
                    const auto at = errors.error(kernel, taps);
                    ASSERT_EQ(at.fault, "") << kernel << ", " << order << ", " << taps;
                    const auto report = choose::report_on(kernel, taps, goal, errors.filter_of(kernel, taps));
                    EXPECT_EQ(at.error, report.certified.band) << kernel;
                    EXPECT_LE(report.measured.band, report.certified.band + 1e-5) << kernel << ", " << order;
                    EXPECT_GT(at.error, DerivativeErrors(goal).error(kernel, taps).error) << kernel << ", " << order;
                }
            }
            EXPECT_NE(errors.error("ring_plain_f32", 5).fault, "");
            EXPECT_NE(errors.error("modes_plain_f32", 6).fault, "");
            EXPECT_NE(errors.error("modesdelta_plain_f32", 7).fault, "");
        }
    }
    // Above order 1 it is of increments.
    DerivativeErrors steep({1.5, 0.001, Band{0.5, 20.0}, {}}, FilterDesign::oustaloup);
    EXPECT_LT(steep.error("modesdelta_plain_f32", 9).error, 0.1);
    EXPECT_NE(steep.error("modes_plain_f32", 9).fault, "");
}

TEST(WholeOrders, AreToldInASentence) {
    EXPECT_EQ(choose::what_a_whole_order_is(0.5), "");
    EXPECT_NE(choose::what_a_whole_order_is(2.0).find("has 3 weights"), std::string::npos);
    EXPECT_NE(choose::what_a_whole_order_is(0.0).find("has 1 weight "), std::string::npos);
    EXPECT_NE(choose::what_a_whole_order_is(-1.0).find("all samples so far"), std::string::npos);
}

TEST(DerivativeErrors, LengthsAreThoseThatAFilterIsFittedTo) {
    DerivativeErrors errors(goal_of(0.5, 0.0));
    EXPECT_EQ(errors.lengths("modes_plain_f32")->size(), 40U);
    const auto windows = errors.lengths("ring_plain_f32").value();
    EXPECT_EQ(windows[15], 16U);
    EXPECT_EQ(windows[16], 18U);
    EXPECT_EQ(windows.back(), 64U);
    EXPECT_TRUE(errors.meets("modes_plain_f32", 11, 0.05));
    EXPECT_FALSE(errors.meets("modes_plain_f32", 3, 0.05));
}

TEST(WouldDo, AsksForLessAndKeepsTheLimits) {
    const DerivativeGoal goal = goal_of(0.5, 2.0);
    const auto lesser = choose::lesser_goals(goal);
    ASSERT_EQ(lesser.size(), 4U);
    EXPECT_EQ(lesser[0].first, "--band 0.5..80 alone");
    EXPECT_FALSE(lesser[0].second.step_until_s);
    EXPECT_EQ(lesser[1].first, "--step-until 2 alone");
    EXPECT_FALSE(lesser[1].second.band);
    EXPECT_EQ(lesser[2].first, "--band 0.5..40");
    EXPECT_EQ(lesser[2].second.band->high_hz, 40.0);
    EXPECT_EQ(lesser[3].first, "--step-s 0.0005");
    EXPECT_EQ(lesser[3].second.step_s, 0.0005);
    EXPECT_EQ(choose::lesser_goals({0.5, 0.001, Band{3.0, 5.0}}).size(), 1U);

    test::CostsBy costs([](const std::string&, std::size_t taps) {  // a tap costs a cycle and four bytes
        const auto cost = static_cast<double>(taps);
        return choose::Cost{cost, cost, 0.0, 4.0 * cost, ""};
    });
    // Band and step together come to 0.5 % at best.
    const auto found = choose::what_would_do(goal, {"modes_plain_f64", "modes_plain_f32"}, costs, {2e-3, {}, {}});
    ASSERT_GE(found.size(), 2U);
    for (const choose::WouldDo& other : found) {
        EXPECT_LE(other.fits.error.error, 2e-3) << other.instead;
        EXPECT_EQ(other.fits.cost.value, static_cast<double>(other.fits.taps)) << other.instead;
    }
    EXPECT_EQ(found[0].instead, "--band 0.5..80 alone");
    EXPECT_TRUE(choose::what_would_do(goal, {"modes_plain_f64"}, costs, {2e-3, 3.0, {}}).empty());
}

TEST(DerivativeText, SaysWhereAndWithinWhat) {
    const DerivativeGoal goal = goal_of(0.5, 2.0);
    EXPECT_EQ(choose::extent(goal), ", from 0.5 to 80 Hz, a step from 0.01 s until 2 s");
    glsum::design::DerivativeError error{0.0123, 7.5, 0.04, 1.0};
    EXPECT_EQ(choose::worst_place(error), "1 s");
    error.step = 0.01;
    EXPECT_EQ(choose::worst_place(error), "7.5 Hz");
    const std::string text = choose::use_of({{}, error, error}, goal);
    EXPECT_NE(text.find("within 1.2"), std::string::npos) << text;
    EXPECT_NE(text.find("until 2 s (worst at 1 s)"), std::string::npos) << text;
    EXPECT_EQ(choose::to_json(error, goal)["band_error"], 0.0123);
    EXPECT_EQ(choose::to_json(error, goal)["worst_s"], 1.0);
}

}  // namespace
