// Lengths and designs of kernels with modes, and what their rows say.
#include "bench/sweep/designs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "bench/rows/key.hpp"
#include "bench/sweep/accuracy.hpp"
#include "bench/sweep/signals.hpp"
#include "bench/sweep/truncation_bound.hpp"
#include "bench/target/target_plan.hpp"
#include "glsum/design/blocks.hpp"
#include "glsum/design/modes.hpp"
#include "glsum/logmemory/nested.hpp"

namespace {

bench::Sweep sweep_of(std::vector<std::string> kernels) {
    bench::Sweep sweep;
    sweep.kernels = std::move(kernels);
    sweep.orders = {0.5, 1.9909, -0.5};
    sweep.lengths = {{50}, {600}};
    sweep.signals.assign(std::begin(bench::signal_names), std::end(bench::signal_names));
    sweep.samples = 1000;
    return sweep;
}

TEST(Lengths, AreReadAsTheyAreWritten) {
    for (const char* text : {"1", "600", "2+7", "1+0", "3+40", "full"}) {
        const auto length = bench::parse_length(text, 1000);
        ASSERT_TRUE(length) << text;
        EXPECT_EQ(length->text(), text);
        EXPECT_TRUE(bench::parse_key(to_name(bench::row_key("modes_plain_f32", 0.5, *length, "host")))) << text;
    }
    EXPECT_EQ(bench::parse_length("2+7", 1000)->taps, 16U);
    EXPECT_EQ(bench::parse_length("2+7", 1000)->modes, 7U);
    EXPECT_EQ(bench::parse_length("full", 1000)->taps, 1000U);
    EXPECT_FALSE(bench::parse_length("600", 1000)->modes);
    for (const char* text : {"", "0", "0+7", "+7", "2+", "2+7+1", "2-7", "2+-7", "-2", "1000001", "2+1000001", "Full",
                             "2 + 7", "99999999999999999999", "2+99999999999999999999"}) {
        EXPECT_FALSE(bench::parse_length(text, 1000)) << text;
    }
}

TEST(Designs, OfAKernelWithModesAreTheShortestForTheErrors) {
    const bench::Sweep sweep = sweep_of({"ring_plain_f32", "modes_plain_f32"});
    EXPECT_EQ(bench::lengths_of(sweep, "ring_plain_f32", 0.5).size(), 2U);
    for (const double order : sweep.orders) {
        const auto lengths = bench::lengths_of(sweep, "modes_plain_f32", order);
        ASSERT_LE(lengths.size(), sweep.design_errors.size());
        ASSERT_FALSE(lengths.empty());
        for (const double error : sweep.design_errors) {
            const auto found = glsum::design::design_modes({order, sweep.samples}, error);
            ASSERT_TRUE(found);
            EXPECT_TRUE(std::any_of(lengths.begin(), lengths.end(),
                                    [&](const bench::Length& length) {
                                        return length.taps == found->length() && length.modes == found->modes.size();
                                    }))
                << order << " " << error;
        }
    }
    EXPECT_TRUE(bench::lengths_of(sweep, "modes_plain_f32", 1.0).empty());
    EXPECT_TRUE(bench::lengths_of(sweep, "modes_plain_f32", -1.5).empty());
    bench::Sweep named = sweep;
    named.lengths = {{50}, *bench::parse_length("2+7", 1000)};
    ASSERT_EQ(bench::lengths_of(named, "modes_plain_f32", 0.5).size(), 1U);
    EXPECT_EQ(bench::lengths_of(named, "modes_plain_f32", 0.5).front().text(), "2+7");
    ASSERT_EQ(bench::lengths_of(named, "ring_plain_f32", 0.5).size(), 1U);
    EXPECT_EQ(bench::lengths_of(named, "ring_plain_f32", 0.5).front().text(), "50");
}

// A number is a length of so many coefficients; `full`, and lengths of modes, are none of theirs.
TEST(Designs, OfAKernelWithBlocksAreTheBestForTheLengths) {
    bench::Sweep sweep = sweep_of({"nested_plain_f32", "modes_plain_f32"});
    sweep.lengths = {{16}, {50}, *bench::parse_length("2+7", 1000), {1000, true}};
    for (const double order : {0.5, 1.9909, -0.5, -1.5, 1.0}) {
        const auto lengths = bench::lengths_of(sweep, "nested_plain_f32", order);
        ASSERT_EQ(lengths.size(), 2U) << order;
        for (const bench::Length& length : lengths) {
            const auto found = glsum::design::design_blocks({order, sweep.samples}, length.taps);
            ASSERT_TRUE(length.blocks);
            EXPECT_FALSE(length.modes);
            EXPECT_EQ(*length.blocks, found.blocks);
            EXPECT_EQ(length.text(), std::to_string(found.near_taps) + '+' + std::to_string(found.blocks.count));
            const auto design = bench::design_of("nested_plain_f32", order, length, sweep.samples);
            EXPECT_EQ(design.taps, length.taps);
            EXPECT_EQ(design.blocks, found.blocks);
            EXPECT_TRUE(design.modes.empty());
        }
    }
    EXPECT_EQ(bench::length_of("nested_plain_f32", 0.5, 24, 5000).text(), "13+11");
    EXPECT_NE(bench::length_of("nested_plain_f32", 0.5, 24, 5000).text(),
              bench::length_of("nested_plain_f32", 0.5, 24, 500).text());
    // The same words are a length of either kind.
    const bench::Length read = *bench::parse_length("13+11", 5000);
    EXPECT_EQ(bench::as_counted("nested_plain_f32", read).taps, 24U);
    EXPECT_EQ(bench::as_counted("nested_plain_f32", read).text(), "13+11");
    EXPECT_EQ(bench::as_counted("modes_plain_f32", read).taps, 35U);
    EXPECT_EQ(bench::as_counted("peer_eigen_f32", read).taps, 35U);
    EXPECT_FALSE(bench::truncates("nested_plain_f32"));
}

// Over increments the weights, and so the designs, are of one order less; and not every order is taken.
TEST(Designs, OfIncrementsAreThoseOfOneOrderLess) {
    const bench::Sweep sweep = sweep_of({"modesdelta_plain_f32"});
    const auto lengths = bench::lengths_of(sweep, "modesdelta_plain_f32", 0.5);
    const auto of_less = bench::lengths_of(sweep, "modes_plain_f32", -0.5);
    ASSERT_EQ(lengths.size(), of_less.size());
    ASSERT_FALSE(lengths.empty());
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        EXPECT_EQ(lengths[i].text(), of_less[i].text());
        const auto design = bench::design_of("modesdelta_plain_f32", 0.5, lengths[i], sweep.samples);
        const auto less = bench::design_of("modes_plain_f32", -0.5, lengths[i], sweep.samples);
        EXPECT_EQ(design.order, 0.5);
        ASSERT_EQ(design.modes.size(), less.modes.size());
        EXPECT_EQ(design.modes.data(), less.modes.data());  // made once
        // Increments of |x| <= 1 are twice as large.
        const double of_samples = bench::design_error("modes_plain_f32", -0.5, less, sweep.samples);
        EXPECT_GT(of_samples, 0.0);
        EXPECT_EQ(bench::design_error("modesdelta_plain_f32", 0.5, design, sweep.samples), 2.0 * of_samples);
    }
    EXPECT_EQ(bench::length_of("modesdelta_plain_f32", 0.5, 16, 1000).text(),
              bench::length_of("modes_plain_f32", -0.5, 16, 1000).text());
    EXPECT_TRUE(bench::lengths_of(sweep, "modesdelta_plain_f32", -0.5).empty());  // weights of -1.5 have no tail
    EXPECT_FALSE(bench::lengths_of(sweep, "mirrordelta_plain_f32", -0.5).empty());
    EXPECT_TRUE(bench::lengths_of(sweep, "mirrordelta_plain_f32", -1.5).empty());
    EXPECT_FALSE(bench::lengths_of(sweep, "mirrorhold_plain_f32", -1.5).empty());
    EXPECT_TRUE(bench::truncates("ring_plain_f32"));
    for (const char* kernel :
         {"mirrordelta_plain_f32", "mirrorhold_plain_f32", "mirrorlinear_plain_f32", "modes_plain_f32"}) {
        EXPECT_FALSE(bench::truncates(kernel)) << kernel;
    }
}

// A row's rounding is against what its history stands for: so small for every signal, and no truncation where it is
// exact.
TEST(Accuracy, OfGuessesAndIncrementsIsAgainstTheirOwnSums) {
    const bench::Sweep sweep = sweep_of(
        {"mirrordelta_oldest_f64", "modesdelta_plain_f64", "mirrorhold_oldest_f64", "mirrorlinear_oldest_f64"});
    std::vector<std::size_t> cases(sweep.signals.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
        cases[i] = i;  // of order 0.5
    }
    const auto rows = bench::measure_accuracy(sweep, cases);
    std::set<std::string> exact;
    std::size_t measured = 0;
    for (const auto& of_case : rows) {
        for (const bench::Json& row : of_case) {
            ASSERT_FALSE(row.contains("error_occurred")) << row;
            EXPECT_LE(row["rounding_error_max"].get<double>(), 1e-13) << row["name"];
            const double truncation = row["truncation_error_max"].get<double>();
            EXPECT_LE(row["error_max"].get<double>(),
                      (truncation + row["rounding_error_max"].get<double>()) * (1 + 1e-9));
            const auto key = bench::parse_key(row["name"].get<std::string>());
            ASSERT_TRUE(key);
            if (key->taps == "50") {
                if (truncation < 1e-15) {  // a ramp's samples are rounded
                    exact.insert(key->kernel + " " + key->signal);
                } else {
                    EXPECT_GT(truncation, 1e-3) << row["name"];
                }
            }
            ++measured;
        }
    }
    EXPECT_EQ(exact, (std::set<std::string>{"mirrorhold_oldest_f64 step", "mirrorlinear_oldest_f64 ramp",
                                            "mirrorlinear_oldest_f64 step"}));
    EXPECT_GE(measured, cases.size() * 9);
}

// The error of a row is within the design's, which is of |x| <= 1, and rounding: for every signal.
TEST(Accuracy, OfModesIsThatOfTheirDesign) {
    const bench::Sweep sweep = sweep_of({"modes_plain_f64", "modes_compensated_f32"});
    std::vector<std::size_t> cases(sweep.orders.size() * sweep.signals.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
        cases[i] = i;
    }
    const auto rows = bench::measure_accuracy(sweep, cases);
    std::size_t measured = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double order = sweep.orders[i / sweep.signals.size()];
        const auto record = bench::make_signal(sweep.signals[i % sweep.signals.size()], sweep.samples, sweep.seed);
        const double peak = bench::largest_sum(order, record);
        for (const bench::Json& row : rows[i]) {
            const auto key = bench::parse_key(row["name"].get<std::string>());
            ASSERT_TRUE(key) << row["name"];
            const auto length = bench::parse_length(key->taps, sweep.samples);
            ASSERT_TRUE(length && length->modes) << row["name"];
            ASSERT_FALSE(row.contains("error_occurred")) << row;
            const double designed =
                glsum::design::approximate({order, sweep.samples}, length->taps - 2 * *length->modes, *length->modes)
                    .error;
            const double truncation = row["truncation_error_max"].get<double>();
            const double rounding = row["rounding_error_max"].get<double>();
            EXPECT_LE(truncation, bench::signal_peak * designed / peak * (1 + 1e-6)) << row["name"];
            EXPECT_LE(row["error_max"].get<double>(), (truncation + rounding) * (1 + 1e-9)) << row["name"];
            EXPECT_LE(rounding, key->kernel == "modes_plain_f64" ? 1e-11 : 1e-3) << row["name"];
            EXPECT_EQ(row["macs_per_sample"], length->taps - 1);
            EXPECT_EQ(row["horizon_samples"], sweep.samples);
            ++measured;
        }
    }
    EXPECT_GE(measured, 2 * cases.size() * 3);
}

// The same of blocks: what a row says of its error is that of its layout.
TEST(Accuracy, OfBlocksIsThatOfTheirDesign) {
    bench::Sweep sweep = sweep_of({"nested_plain_f64", "nested_plain_f32"});
    sweep.lengths = {{16}, {50}};
    std::vector<std::size_t> cases(sweep.orders.size() * sweep.signals.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
        cases[i] = i;
    }
    const auto rows = bench::measure_accuracy(sweep, cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double order = sweep.orders[i / sweep.signals.size()];
        const auto record = bench::make_signal(sweep.signals[i % sweep.signals.size()], sweep.samples, sweep.seed);
        const double peak = bench::largest_sum(order, record);
        ASSERT_EQ(rows[i].size(), 4U);
        for (std::size_t r = 0; r < rows[i].size(); ++r) {
            const bench::Json& row = rows[i][r];
            const std::size_t taps = r % 2 == 0 ? 16 : 50;
            ASSERT_FALSE(row.contains("error_occurred")) << row;
            const auto found = glsum::design::design_blocks({order, sweep.samples}, taps);
            const double truncation = row["truncation_error_max"].get<double>();
            const double rounding = row["rounding_error_max"].get<double>();
            EXPECT_LE(truncation, bench::signal_peak * found.error / peak * (1 + 1e-6)) << row["name"];
            EXPECT_LE(row["error_max"].get<double>(), (truncation + rounding) * (1 + 1e-9)) << row["name"];
            EXPECT_LE(rounding, r < 2 ? 1e-12 : 1e-3) << row["name"];
            EXPECT_EQ(row["macs_per_sample"], taps - 1);
            EXPECT_FALSE(row.contains("effective_taps"));
            EXPECT_EQ(row["horizon_samples"], std::min(glsum::reach_of(found.near_taps, found.blocks), sweep.samples));
        }
    }
}

TEST(TargetPlan, KernelsWithBlocksAreReplayedWithThem) {
    bench::Sweep sweep = sweep_of({"nested_plain_f32", "nested_plain_q31"});
    sweep.lengths = {{16}, {50}};
    const bench::TargetPlan plan = bench::make_target_plan(sweep);
    EXPECT_EQ(plan.rows.size(), 12U);
    for (const auto& row : plan.rows) {
        EXPECT_EQ(plan.counts.at(row.count).blocks,
                  bench::length_of(row.kernel, plan.counts.at(row.count).order, row.length.taps, sweep.samples).blocks);
        EXPECT_EQ(plan.counts.at(row.count).blocks, row.length.blocks);
    }
    for (const auto& replay : plan.replays) {
        EXPECT_EQ(replay.planned.blocks, plan.rows.at(replay.row).length.blocks);
        EXPECT_EQ(replay.planned.calls, sweep.samples);
    }
}

TEST(TargetPlan, KernelsWithModesAreReplayedWithThemAndCountedOnce) {
    const bench::Sweep sweep = sweep_of({"ring_plain_f32", "modes_plain_f32", "modes_plain_q31"});
    const bench::TargetPlan plan = bench::make_target_plan(sweep);
    std::set<std::string> counted;
    std::set<std::size_t> pieces;
    std::set<std::size_t> replayed;
    std::set<std::size_t> signals;
    for (std::size_t i = 0; i < plan.rows.size(); ++i) {
        const auto& row = plan.rows[i];
        const auto& count = plan.counts.at(row.count);
        EXPECT_EQ(count.kernel, row.kernel);
        EXPECT_EQ(count.taps, row.length.taps);
        EXPECT_EQ(count.modes.size(), row.length.modes.value_or(0));
        if (row.kernel == "modes_plain_f32") {
            counted.insert(row.length.text());
            pieces.insert(row.piece);
        } else {
            EXPECT_EQ(pieces.count(row.piece), 0U);
        }
    }
    EXPECT_EQ(pieces.size(), 1U);
    EXPECT_EQ(std::count_if(plan.counts.begin(), plan.counts.end(),
                            [](const auto& count) { return count.kernel == "modes_plain_f32"; }),
              static_cast<std::ptrdiff_t>(counted.size()));
    for (const auto& replay : plan.replays) {
        const auto& row = plan.rows.at(replay.row);
        replayed.insert(replay.row);
        if (row.length.modes) {
            const auto design = bench::design_of(row.kernel, row.order, row.length, sweep.samples);
            ASSERT_EQ(replay.planned.modes.size(), design.modes.size());
            for (std::size_t m = 0; m < design.modes.size(); ++m) {
                EXPECT_EQ(replay.planned.modes[m].decay, design.modes[m].decay);
                EXPECT_EQ(replay.planned.modes[m].weight, design.modes[m].weight);
            }
            EXPECT_EQ(replay.planned.calls, sweep.samples);
            signals.insert(replay.planned.signal);
        }
    }
    EXPECT_EQ(replayed.size(), plan.rows.size());
    EXPECT_EQ(signals.size(), sweep.signals.size());
    for (const double of_piece : bench::piece_costs(plan)) {
        EXPECT_GT(of_piece, 0.0);
    }
}

}  // namespace
