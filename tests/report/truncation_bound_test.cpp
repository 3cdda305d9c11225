// The bound of the truncation: against a closed form, and never below what is measured.
#include "bench/sweep/truncation_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/rows/key.hpp"
#include "bench/run/run.hpp"
#include "bench/sweep/signals.hpp"

namespace {

// sum_{j=0..n} a_j = gamma(n + 1 - v) / (gamma(1 - v) gamma(n + 1)), the sum of the first binomial coefficients with
// alternating signs.
double partial_sum(double order, std::size_t n) {
    const auto at = static_cast<double>(n);
    return std::exp(std::lgamma(at + 1.0 - order) - std::lgamma(at + 1.0)) / std::tgamma(1.0 - order);
}

TEST(TruncationBound, DroppedSumIsTheClosedForm) {
    for (const double order : {0.2, 0.5, 0.98319, 1.5, 1.9909, -0.5}) {  // behind tap 2 of one sign
        for (const std::size_t taps : {3U, 50U, 600U}) {
            const double expected = std::fabs(partial_sum(order, taps - 1) - partial_sum(order, 4999));
            EXPECT_NEAR(bench::dropped_sum(order, taps, 5000) / expected, 1.0, 1e-9) << order << ' ' << taps;
        }
    }
}

TEST(TruncationBound, NothingIsDroppedFromWholeOrdersAndShortRecords) {
    EXPECT_EQ(bench::dropped_sum(1.0, 2, 1000), 0.0);
    EXPECT_EQ(bench::dropped_sum(2.0, 3, 1000), 0.0);
    EXPECT_EQ(bench::dropped_sum(0.5, 1000, 1000), 0.0);
    EXPECT_EQ(bench::dropped_sum(1.0, 0, 1000), 2.0);
    EXPECT_EQ(bench::dropped_sum(-1.0, 10, 1000), 990.0);
}

TEST(TruncationBound, LargestSumOfAStepIsKnown) {
    // For 0 < v < 1 the sums fall from the first, a_0 x_0; for v = -1 they grow to the sum of the record.
    EXPECT_EQ(bench::largest_sum(0.5, std::vector<double>(100, 0.9)), 0.9);
    EXPECT_NEAR(bench::largest_sum(-1.0, std::vector<double>(100, 0.9)), 90.0, 1e-9);
    EXPECT_NEAR(bench::largest_sum(-1.0, std::vector<double>(100, -0.9)), 90.0, 1e-9);
}

class MeasuredTruncation : public testing::Test {
protected:
    static bench::Sweep sweep() {
        bench::Sweep sweep;
        sweep.kernels = {"shift_plain_f64"};
        sweep.orders = {0.2, 0.5, 0.98319, 1.0, 1.5, 1.9909, -0.5};
        sweep.lengths = {{5}, {40}, {150}, {400, true}};
        sweep.signals.assign(std::begin(bench::signal_names), std::end(bench::signal_names));
        sweep.samples = 400;
        return sweep;
    }
    static bench::Json context() {
        bench::Json context;
        context["n_samples"] = 400;
        context["seed"] = 2020;
        return context;
    }
};

TEST_F(MeasuredTruncation, NeverExceedsTheBoundAndAStepReachesIt) {
    bench::Sweep accuracy_alone = sweep();
    accuracy_alone.targets.clear();
    const auto rows = bench::measure(accuracy_alone, std::nullopt, {}, {}).rows;
    const auto bounds = bench::truncation_bounds(context(), rows, 1);
    EXPECT_EQ(bounds.missing, "");
    std::size_t held = 0;
    for (const bench::Json& row : rows) {
        const auto key = bench::parse_key(row["name"].get<std::string>());
        ASSERT_TRUE(key);
        if (key->taps == "full") {
            continue;
        }
        const double bound = bounds.of.at(key->order).at(key->signal).at(key->taps);
        const double measured = row["truncation_error_max"];
        EXPECT_LE(measured, bound) << row["name"];
        ++held;
        if (key->signal == "step" && key->order != "1") {
            EXPECT_GE(measured, bound * (1.0 - 1e-6)) << row["name"];
        }
    }
    EXPECT_EQ(held, 7U * 7U * 3U);
    const auto worst = bench::worst_of_signals(bounds);
    for (const auto& [signal, by_taps] : bounds.of.at("0.5")) {
        EXPECT_LE(by_taps.at("40"), worst.at("0.5").at("40"));
    }
}

TEST_F(MeasuredTruncation, WithoutTheRecordThereIsNoneAndItSaysWhy) {
    const std::vector<bench::Json> rows = {
        bench::make_row("gl/shift_plain_f64/order:0.5/taps:40/accuracy/signal:step", 1)};
    bench::Json without = context();
    without.erase("seed");
    EXPECT_NE(bench::truncation_bounds(without, rows, 1).missing.find("seed"), std::string::npos);
    bench::Json long_record = context();
    long_record["n_samples"] = 100'000'000;
    EXPECT_NE(bench::truncation_bounds(long_record, rows, 1).missing.find("20000"), std::string::npos);
    EXPECT_TRUE(bench::truncation_bounds(long_record, rows, 1).of.empty());
    bench::Json other_weights = context();
    other_weights["weights"] = "bdf2";
    EXPECT_NE(bench::truncation_bounds(other_weights, rows, 1).missing.find("bdf2"), std::string::npos);
    EXPECT_TRUE(bench::truncation_bounds(other_weights, rows, 1).of.empty());
    for (const char* same : {"gl", "shifted"}) {
        other_weights["weights"] = same;
        EXPECT_EQ(bench::truncation_bounds(other_weights, rows, 1).missing, "") << same;
    }
}

// Records of 2 to 20 000 samples, and a thousand pairs of order and signal: beyond, a page would take too long.
TEST_F(MeasuredTruncation, BoundsAreMadeUpToTheirLimits) {
    const auto row = [](const std::string& order, const std::string& rest) {
        return bench::make_row("gl/shift_plain_f64/order:" + order + rest, 1);
    };
    const auto missing = [&](const bench::Json& samples, std::size_t orders, const bench::Json& seed = 1) {
        std::vector<bench::Json> rows;
        for (std::size_t i = 0; i < orders; ++i) {
            rows.push_back(row("0." + std::to_string(1000 + i), "/taps:1/accuracy/signal:step"));
        }
        return bench::truncation_bounds({{"n_samples", samples}, {"seed", seed}}, rows, 1).missing;
    };
    EXPECT_EQ(missing(2, 1), "");
    EXPECT_EQ(missing(2, 1, 0), "");
    EXPECT_EQ(missing(1, 1), "records of 1 samples; bounds are made for up to 20000");
    EXPECT_EQ(missing(20000, 0), "");
    EXPECT_EQ(missing(20001, 0), "records of 20001 samples; bounds are made for up to 20000");
    EXPECT_EQ(missing(2, 1000), "");
    EXPECT_EQ(missing(2, 1001), "1001 pairs of order and signal; bounds are made for up to 1000");
    for (const bench::Json& bad : {bench::Json(-1), bench::Json("2"), bench::Json(2.5)}) {
        EXPECT_NE(missing(bad, 1).find("cannot be made again"), std::string::npos) << bad;
        EXPECT_NE(missing(2, 1, bad).find("cannot be made again"), std::string::npos) << bad;
    }
    // Of full scale, of our signals, windows and orders alone.
    const std::vector<bench::Json> rows = {row("0.5", "/taps:2/accuracy/signal:step"),
                                           row("0.5", "/taps:3/accuracy/signal:step"),
                                           row("0.5", "/taps:2/accuracy/signal:step/amplitude:0.0625"),
                                           row("0.5", "/taps:2/accuracy/signal:other"),
                                           row("0.5", "/taps:2/host"),
                                           row("0.5", "/taps:2+7/accuracy/signal:ramp"),
                                           row("2.5", "/taps:2/accuracy/signal:ramp")};
    const auto bounds = bench::truncation_bounds({{"n_samples", 4}, {"seed", 1}}, rows, 1);
    ASSERT_EQ(bounds.of.size(), 1U);
    ASSERT_EQ(bounds.of.at("0.5").size(), 1U);
    const auto& of_step = bounds.of.at("0.5").at("step");
    ASSERT_EQ(of_step.size(), 2U);
    // |a_2| = 1/8 and |a_3| = 1/16 of the peak, which is the largest sum; a little more for the rounding.
    EXPECT_GT(of_step.at("2"), 0.1875);
    EXPECT_NEAR(of_step.at("2"), 0.1875 * (1.0 + 1e-9), 1e-12);
    EXPECT_NEAR(of_step.at("3"), 0.0625 * (1.0 + 1e-9), 1e-12);
}

TEST(TruncationBound, TheWorstSignalCountsAtEachLength) {
    bench::TruncationBounds bounds;
    bounds.of["0.5"]["step"] = {{"2", 0.5}, {"3", 0.25}};
    bounds.of["0.5"]["ramp"] = {{"2", 0.125}, {"3", 0.375}};
    bounds.of["1"]["step"] = {{"2", 0.75}};
    const auto worst = bench::worst_of_signals(bounds);
    EXPECT_EQ(worst.at("0.5").at("2"), 0.5);
    EXPECT_EQ(worst.at("0.5").at("3"), 0.375);
    EXPECT_EQ(worst.at("1").at("2"), 0.75);
}

}  // namespace
