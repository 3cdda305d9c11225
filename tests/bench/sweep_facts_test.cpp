// What a sweep and its lengths say of themselves, what a line of samples holds, and rows of accuracy by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/sweep/accuracy.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/host_line.hpp"
#include "bench/sweep/signals.hpp"
#include "bench/sweep/sweep.hpp"
#include "bench/sweep/truncation_bound.hpp"
#include "glsum/registry.hpp"

namespace {

using bench::Length;
using Names = std::vector<std::string>;

TEST(SweepFacts, ALengthIsAWindowsUnlessItHasModesOrBlocks) {
    const Length blocks{16, false, {}, glsum::Blocks{9, 1}};
    EXPECT_TRUE((Length{600}).window());
    EXPECT_TRUE((Length{600, true}).window());
    EXPECT_FALSE((Length{16, false, 7}).window());
    EXPECT_FALSE((Length{16, false, 0}).window());
    EXPECT_FALSE(blocks.window());
    EXPECT_EQ((Length{600}).text(), "600");
    EXPECT_EQ((Length{600, true}).text(), "full");
    EXPECT_EQ((Length{16, false, 7}).text(), "2+7");
    EXPECT_EQ(blocks.text(), "7+9");
}

TEST(SweepFacts, TheLongestLengthIsAMillion) {
    ASSERT_TRUE(bench::parse_length("1000000", 5000));
    EXPECT_EQ(bench::parse_length("1000000", 5000)->taps, 1'000'000U);
    ASSERT_TRUE(bench::parse_length("1+1000000", 5000));
    EXPECT_EQ(bench::parse_length("1+1000000", 5000)->modes, 1'000'000U);
    EXPECT_EQ(bench::parse_length("1+1000000", 5000)->taps, 2'000'001U);
    for (const char* longer : {"1000001", "1000001+1", "1+1000001"}) {
        EXPECT_FALSE(bench::parse_length(longer, 5000)) << longer;
    }
}

TEST(SweepFacts, CoresAreOfTheMachinesThatTheyAreNamedFor) {
    bench::Sweep sweep;
    sweep.cores = {"one", "count", "other"};
    sweep.machine_of_core = {{"other", "m4"}};
    EXPECT_EQ(sweep.modelled_cores(), (Names{"one", "other"}));
    EXPECT_EQ(sweep.cores_on(base::machines[0]), (Names{"one", "count"}));
    EXPECT_EQ(sweep.cores_on(base::machines[1]), (Names{"count", "other"}));
    sweep.targets = {"m4", "host"};
    EXPECT_TRUE(sweep.wants("host"));
    EXPECT_TRUE(sweep.wants("m4"));
    EXPECT_FALSE(sweep.wants("m7"));
    EXPECT_EQ(sweep.machines(), std::vector<const base::Machine*>{&base::machines[1]});
    sweep.targets = {"m4", "m7"};
    EXPECT_EQ(sweep.machines(), (std::vector<const base::Machine*>{&base::machines[0], &base::machines[1]}));
    sweep.targets = {"host"};
    EXPECT_TRUE(sweep.machines().empty());
}

// Of equal coefficients the fewer modes come first, and each once.
TEST(SweepFacts, LengthsWithModesRiseAndComeOnce) {
    bench::Sweep sweep;
    sweep.samples = 100;
    for (const char* text : {"2+7", "50", "1+2", "2+7", "4+6"}) {
        sweep.lengths.push_back(bench::parse_length(text, sweep.samples).value());
    }
    Names texts;
    for (const Length& length : bench::lengths_of(sweep, "modes_plain_f32", 0.5)) {
        texts.push_back(length.text());
    }
    EXPECT_EQ(texts, (Names{"1+2", "4+6", "2+7"}));
}

TEST(SweepFacts, ADesignIsNamedWithWhatTellsItApart) {
    const std::vector<glsum::Mode> decaying = {{0.5, 0.25}};
    const std::vector<glsum::Mode> integrator = {{0.0, 0.25}, {0.5, 0.25}};
    const Length blocks{16, false, {}, glsum::Blocks{9, 1}};
    EXPECT_EQ(bench::named({50}, {0.5, 50}), "50");
    EXPECT_EQ(bench::named({4, false, 1}, {0.5, 4, decaying}), "2+1");
    EXPECT_EQ(bench::named({6, false, 2}, {-0.5, 6, integrator}), "integrator 2+2");
    EXPECT_EQ(bench::named(blocks, {0.5, 16, {}, {}, {9, 1}}), "blocks 7+9");
}

// sum_{j=K..N} |a_j - sum_m w_m (1 - d_m)^(j-K)|, with a_j = a_(j-1) (1 - (v + 1)/j).
TEST(SweepFacts, TheErrorOfADesignWithModesIsThatOfItsWeights) {
    constexpr std::size_t samples = 200;
    const Length length{6, false, 2};  // two near taps
    const glsum::Design design = bench::design_of("modes_plain_f64", 0.5, length, samples);
    ASSERT_EQ(design.modes.size(), 2U);
    double off = 0.0;
    double weight = 1.0;
    for (std::size_t j = 1; j <= samples; ++j) {
        weight *= 1.0 - 1.5 / static_cast<double>(j);
        double made = 0.0;
        for (const glsum::Mode& mode : design.modes) {
            made += mode.weight * std::pow(1.0 - mode.decay, static_cast<double>(j) - 2.0);
        }
        off += j >= 2 ? std::fabs(weight - made) : 0.0;
    }
    EXPECT_GT(off, 0.0);
    EXPECT_NEAR(bench::design_error("modes_plain_f64", 0.5, design, samples) / off, 1.0, 1e-9);
    // A window errs by truncation.
    EXPECT_EQ(bench::design_error("ring_oldest_f64", 0.5, {0.5, 6}, samples), 0.0);
}

// Of whole orders the weights end: 1, -1 and 1, -2, 1.
TEST(SweepFacts, ALineHoldsWhatItsKernelNeeds) {
    using Kernel = glsum::Sum<glsum::Shift, glsum::Plain, glsum::F64>;
    const auto line_of = [](double order, std::size_t taps) { return bench::HostLine<Kernel>({order, taps}); };
    EXPECT_EQ(line_of(0.0, 5).effective_taps(), 1U);
    EXPECT_EQ(line_of(1.0, 5).effective_taps(), 2U);
    EXPECT_EQ(line_of(2.0, 5).effective_taps(), 3U);
    EXPECT_EQ(line_of(0.5, 5).effective_taps(), 5U);
    EXPECT_EQ(line_of(0.5, 1).effective_taps(), 1U);
    EXPECT_EQ(line_of(0.5, 5).coefficient_bytes(), 4 * sizeof(double));
    EXPECT_EQ(line_of(0.5, 5).state_bytes(),
              sizeof(Kernel::State) + glsum::past_needed<Kernel>({0.5, 5}) * sizeof(double));
    EXPECT_EQ(line_of(2.5, 5).status(), glsum::Status::order_out_of_range);
}

// Buffers may begin at each cache line of a page.
TEST(SweepFacts, PlacementsAreTheLinesOfAPage) {
    EXPECT_EQ(bench::Placement::line_bytes * bench::Placement::lines, 4096U);
}

// Of order -1 all weights are 1: of a step the sums are 0.9 (1, 2, 3, 4), those of two taps 0.9 (1, 2, 2, 2). The
// integral is 0.9 k at sample k.
TEST(SweepFacts, ErrorsOfAShortRecordAreKnown) {
    bench::Sweep sweep;
    sweep.kernels = {"shift_plain_f64"};
    sweep.orders = {-1.0};
    sweep.signals = {"step"};
    sweep.samples = 4;
    sweep.lengths = {{2}, {4, true}};
    const auto rows = bench::measure_accuracy(sweep, {0});
    ASSERT_EQ(rows.size(), 1U);
    ASSERT_EQ(rows[0].size(), 2U);
    const auto near = [](const bench::Json& row, const char* counter, double value) {
        EXPECT_NEAR(row.at(counter).get<double>(), value, 1e-14) << counter << ' ' << row;
    };
    const bench::Json& window = rows[0][0];
    EXPECT_EQ(window.at("name"), "gl/shift_plain_f64/order:-1/taps:2/accuracy/signal:step");
    near(window, "error_max", 2.0 / 4.0);
    near(window, "error_rms", std::sqrt((1.0 + 4.0) / 4.0) / 4.0);
    near(window, "rounding_error_max", 0.0);
    near(window, "truncation_error_max", 2.0 / 4.0);
    near(window, "discretisation_error_max", 1.0 / 4.0);
    near(window, "discretisation_error_late_max", 1.0 / 4.0);
    near(window, "derivative_error_max", 1.0 / 4.0);
    near(window, "derivative_error_late_max", 1.0 / 4.0);
    EXPECT_EQ(window.at("effective_taps"), 2);
    EXPECT_EQ(window.at("horizon_samples"), 2);
    EXPECT_EQ(window.at("macs_per_sample"), 1);
    EXPECT_EQ(window.at("coefficient_bytes"), 8);
    EXPECT_EQ(window.at("iterations"), 4);
    EXPECT_FALSE(window.contains("saturations"));
    const bench::Json& full = rows[0][1];
    EXPECT_EQ(full.at("name"), "gl/shift_plain_f64/order:-1/taps:full/accuracy/signal:step");
    near(full, "error_max", 0.0);
    near(full, "truncation_error_max", 0.0);
    near(full, "derivative_error_max", 1.0 / 4.0);
    EXPECT_EQ(full.at("horizon_samples"), 4);
}

// What lies at sample 0 is a_0, which a window of no tap drops.
TEST(SweepFacts, NothingIsDroppedOfARecordWithoutSamples) {
    EXPECT_EQ(bench::dropped_sum(0.5, 0, 0), 0.0);
    EXPECT_EQ(bench::dropped_sum(0.5, 0, 1), 1.0);
    EXPECT_EQ(bench::dropped_sum(0.5, 1, 1), 0.0);
    EXPECT_EQ(bench::dropped_sum(0.5, 1, 2), 0.5);
    EXPECT_EQ(bench::largest_sum(0.5, {}), 0.0);
}

TEST(SweepFacts, EachSignalHasAMeaningOfItsOwn) {
    for (std::size_t i = 0; i < std::size(bench::signal_names); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_NE(bench::meaning_of_signal(bench::signal_names[i]),
                      bench::meaning_of_signal(bench::signal_names[j]));
        }
    }
    EXPECT_EQ(bench::meaning_of_signal("sine50"), "a sine of 50 Hz, 0.9 high");
    EXPECT_THROW((void)bench::meaning_of_signal("square"), std::out_of_range);
}

// Of a library's name nothing is known: it sums the order's own weights.
TEST(SweepFacts, WhatAKernelSumsIsKnownByItsName) {
    EXPECT_EQ(bench::order_of_weights("peer_eigen_f32", 0.5), 0.5);
    EXPECT_EQ(bench::order_of_weights("ring_plain_f32", 0.5), 0.5);
    EXPECT_EQ(bench::order_of_weights("mirrordelta_plain_f32", 0.5), -0.5);
    EXPECT_FALSE(bench::has_integrator("peer_eigen_f32"));
    EXPECT_FALSE(bench::has_integrator("modes_plain_f32"));
    EXPECT_TRUE(bench::has_integrator("modessum_plain_f32"));
    EXPECT_TRUE(bench::serves("modessum_plain_f32", -0.5));
    EXPECT_FALSE(bench::serves("modessum_plain_f32", 0.5));
    EXPECT_TRUE(bench::serves("modes_plain_f32", 0.5));
    EXPECT_FALSE(bench::serves("modes_plain_f32", 2.5));
    try {
        (void)bench::facts_of("square");
        FAIL() << "there is no such kernel";
    } catch (const std::out_of_range& error) {
        EXPECT_STREQ(error.what(), "no kernel square");
    }
}

}  // namespace
