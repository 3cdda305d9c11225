// The bound of the truncation: against a closed form, and never below what is measured.
#include "bench/truncation_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/results.hpp"
#include "bench/run.hpp"
#include "bench/signals.hpp"

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
    const auto rows = bench::measure(accuracy_alone, std::nullopt, nullptr, {}).rows;
    const auto bounds = bench::truncation_bounds(context(), rows, 1);
    EXPECT_EQ(bounds.missing, "");
    std::size_t held = 0;
    for (const bench::Json& row : rows) {
        const auto key = bench::parse_key(row["name"]);
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

}  // namespace
