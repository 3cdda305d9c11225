// What a choice is measured with: errors are bench's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/choose/question.hpp"
#include "bench/rows/key.hpp"
#include "bench/sweep/accuracy.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/host_line.hpp"
#include "glsum/bound.hpp"
#include "glsum/design/modes.hpp"
#include "glsum/registry.hpp"

namespace {

using choose::MeasuredErrors;

constexpr std::size_t samples = 150;
const std::vector<std::string> signals = {"step", "sine50", "noise"};

choose::Conditions conditions(double order = 0.5) { return {order, 1e-3, signals, samples, 2020}; }

// error_max and truncation_error_max of bench's rows, by signal.
std::map<std::string, std::pair<double, double>> rows_of(const std::string& kernel, std::size_t taps) {
    bench::Sweep sweep;
    sweep.kernels = {kernel};
    sweep.orders = {0.5};
    sweep.signals = signals;
    sweep.samples = samples;
    const bench::Length length = bench::length_of(kernel, 0.5, taps, samples);
    sweep.lengths = {length.blocks ? bench::Length{taps} : length};
    std::map<std::string, std::pair<double, double>> found;
    for (const auto& rows : bench::measure_accuracy(sweep, {0, 1, 2})) {
        for (const bench::Json& row : rows) {
            found[bench::parse_key(row.at("name").get<std::string>()).value().signal] = {
                row.at("error_max").get<double>(), row.at("truncation_error_max").get<double>()};
        }
    }
    return found;
}

TEST(MeasuredErrors, AreTheBitsOfBenchsRowsAndTheWorstSignals) {
    MeasuredErrors errors(0.5, choose::make_records(conditions(), 1));
    EXPECT_EQ(errors.longest(), samples);
    std::size_t asked = 0;
    for (const char* kernel :
         {"ring_plain_f32", "ring_plain_q15", "mirrorhold_plain_f32", "nested_plain_f32", "modes_plain_f32"}) {
        for (const std::size_t taps : {2U, 20U}) {
            const choose::ErrorAt at = errors.error(kernel, taps);
            const auto rows = rows_of(kernel, taps);
            ASSERT_EQ(rows.size(), signals.size()) << kernel;
            const auto worst = std::max_element(
                rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.second.first < b.second.first; });
            EXPECT_EQ(at.error, worst->second.first) << kernel << ' ' << taps;
            EXPECT_EQ(at.signal, worst->first) << kernel << ' ' << taps;
            EXPECT_EQ(at.fault, "");
            EXPECT_EQ(errors.measured(), asked += signals.size());
            // What is known is not measured again, whichever way it is asked.
            EXPECT_TRUE(errors.meets(kernel, taps, at.error));
            EXPECT_FALSE(errors.meets(kernel, taps, at.error * (1.0 - 1e-12)));
            EXPECT_EQ(errors.error(kernel, taps).error, at.error);
            EXPECT_EQ(errors.measured(), asked);
        }
    }
}

TEST(MeasuredErrors, MeetALimitOnlyWithEverySignal) {
    const auto records = choose::make_records(conditions(), 2);
    for (const std::size_t taps : {3U, 30U}) {
        const double error = MeasuredErrors(0.5, records).error("ring_plain_f32", taps).error;
        MeasuredErrors above(0.5, records);
        EXPECT_TRUE(above.meets("ring_plain_f32", taps, error));
        EXPECT_EQ(above.measured(), signals.size());
        MeasuredErrors below(0.5, records);
        EXPECT_FALSE(below.meets("ring_plain_f32", taps, error * (1.0 - 1e-12)));
        // A failure ends the question: nothing may be left of it that passes for an answer.
        EXPECT_EQ(below.error("ring_plain_f32", taps).error, error);
    }
    // The signal that truncation hits hardest is asked first, and is enough to say no.
    MeasuredErrors first(0.5, records);
    EXPECT_FALSE(first.meets("ring_plain_f32", 3, 1e-6));
    EXPECT_EQ(first.measured(), 1U);
}

TEST(MeasuredErrors, RecordsHaveTheirPeakAndWhatEachWindowLeavesOut) {
    const auto records = choose::make_records(conditions(), 1);
    ASSERT_EQ(records.size(), signals.size());
    // The first sum of a step of order 0.5 is its largest: all later weights take away.
    EXPECT_EQ(records[0].peak, 0.9);
    MeasuredErrors errors(0.5, records);
    for (const std::size_t taps : {1U, 2U, 17U, 149U}) {
        double worst = 0.0;
        const auto rows = rows_of("shift_plain_f64", taps);
        for (const choose::Record& record : records) {
            EXPECT_NEAR(record.truncation.at(taps - 1), rows.at(record.signal).second, 1e-12) << taps;
            worst = std::max(worst, record.truncation.at(taps - 1));
        }
        EXPECT_EQ(errors.truncation(taps), worst);
    }
    EXPECT_EQ(errors.truncation(samples), 0.0);
    // No window leaves anything out of the sum of an impulse-free zero order, whose only weight is a_0.
    EXPECT_EQ(choose::make_records(conditions(0.0), 1)[2].truncation, std::vector<double>(samples, 0.0));
}

TEST(MeasuredErrors, RoundingIsWithinItsBound) {
    MeasuredErrors errors(0.5, choose::make_records(conditions(), 1));
    for (const char* kernel : {"ring_plain_f32", "mirror_multi_f32", "ring_plain_q15"}) {
        for (const std::size_t taps : {2U, 60U}) {
            const double bound = errors.rounding_bound(kernel, taps);
            EXPECT_LE(std::fabs(errors.error(kernel, taps).error - errors.truncation(taps)), bound) << kernel;
            EXPECT_LT(bound, 0.1) << kernel;
        }
    }
    // The kernel's own bound, relative to the smallest peak.
    double least = 1.0;
    for (const choose::Record& record : choose::make_records(conditions(), 1)) {
        least = std::min(least, record.peak);
    }
    using K = glsum::Sum<glsum::Ring, glsum::Plain, glsum::F32>;
    const glsum::Design design{0.5, 60};
    bench::HostLine<K> line(design);
    EXPECT_EQ(errors.rounding_bound("ring_plain_f32", 60),
              glsum::error_bound<K>(design, line.state(), 0.9, samples) / least);
    EXPECT_TRUE(std::isinf(errors.rounding_bound("null", 60)));
    EXPECT_THROW((void)errors.rounding_bound("no_kernel", 2), std::out_of_range);
}

TEST(MeasuredErrors, LengthsAreAsTheDesignsAre) {
    choose::Conditions longer = conditions();
    longer.samples = 1000;
    longer.signals = {"step"};
    const MeasuredErrors errors(0.5, choose::make_records(longer, 1));
    EXPECT_FALSE(errors.lengths("ring_plain_f32"));
    EXPECT_EQ(errors.longest_of("ring_plain_f32"), 1000U);
    // Every length to 128, then each an eighth longer than the last.
    for (const char* kernel : {"nested_plain_f32", "mirrorhold_plain_f32"}) {
        const auto rungs = errors.lengths(kernel).value();
        for (std::size_t i = 0; i < 128; ++i) {
            ASSERT_EQ(rungs.at(i), i + 1) << kernel;
        }
        EXPECT_EQ((std::vector<std::size_t>(rungs.begin() + 128, rungs.end())),
                  (std::vector<std::size_t>{144, 162, 182, 204, 229, 257, 289, 325, 365, 410, 461, 518, 582, 654, 735,
                                            826, 929, 1000}))
            << kernel;
    }
    const auto modes = errors.lengths("modes_plain_f32").value();
    EXPECT_EQ(modes.size(), std::min<std::size_t>(1000, glsum::design::most_taps(0.5)));
    EXPECT_EQ(modes.front(), 1U);
    EXPECT_EQ(modes.back(), modes.size());
    EXPECT_EQ(errors.lengths("modesdelta_plain_f32").value().size(),
              std::min<std::size_t>(1000, glsum::design::most_taps(-0.5)));
}

TEST(MeasuredErrors, WhatAnotherRunMeasuredIsTakenSignalBySignal) {
    MeasuredErrors errors(0.5, choose::make_records(conditions(), 1));
    errors.remember("ring_plain_f32", 7, "step", 0.25);
    errors.remember("ring_plain_f32", 7, "sine50", 0.0);
    errors.remember("ring_plain_f32", 7, "noise", 0.125);
    errors.remember("ring_plain_f32", 7, "ramp", 0.5);  // not asked for
    EXPECT_TRUE(errors.meets("ring_plain_f32", 7, 0.25));
    EXPECT_EQ(errors.error("ring_plain_f32", 7).error, 0.25);
    EXPECT_EQ(errors.error("ring_plain_f32", 7).signal, "step");
    EXPECT_EQ(errors.remembered(), 3U);
    EXPECT_EQ(errors.measured(), 0U);
    errors.remember("ring_plain_f32", 8, "noise", 0.75);
    EXPECT_EQ(errors.error("ring_plain_f32", 8).error, 0.75);
    EXPECT_EQ(errors.remembered(), 4U);
    EXPECT_EQ(errors.measured(), 2U);
}

TEST(MeasuredErrors, AKernelThatRefusesHasAFaultAndNoError) {
    MeasuredErrors errors(-1.5, choose::make_records(conditions(-1.5), 1));
    const choose::ErrorAt at = errors.error("mirrordelta_plain_f32", 20);  // takes orders above -1
    EXPECT_EQ(at.fault, "the order is not in (-2, 2]");
    EXPECT_FALSE(std::isfinite(at.error));
    EXPECT_FALSE(errors.meets("mirrordelta_plain_f32", 20, 1e300));
    EXPECT_TRUE(std::isinf(errors.rounding_bound("mirrordelta_plain_f32", 20)));
}

}  // namespace
