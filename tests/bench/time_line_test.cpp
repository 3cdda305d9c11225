// How a line is timed and checked: what it is fed with, and which answers are wrong.
#include "bench/host/time_line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/host/benchmark_run.hpp"

namespace {

using Fed = std::vector<std::pair<std::size_t, std::size_t>>;  // from which sample on, and how many

// A line that sums what it was fed with since it last rested, and remembers what was asked of it.
class Recorded : public bench::TimedLine {
public:
    explicit Recorded(std::vector<double> weights) : weights_(std::move(weights)) {}
    double feed(std::size_t from, std::size_t count) override {
        fed.emplace_back(from, count);
        for (std::size_t k = from; k < from + count; ++k) {
            past_.push_back(bench::stream()[k % bench::stream_samples]);
        }
        double sum = off;
        for (std::size_t j = 0; j < past_.size(); ++j) {
            // Behind its weights the last one goes on, where it forgets nothing.
            const double weight = j < weights_.size() ? weights_[j] : forgets ? 0.0 : weights_.back();
            sum += weight * past_[past_.size() - 1 - j];
        }
        return sum;
    }
    void rest() override {
        past_.clear();
        ++rests;
    }
    [[nodiscard]] double bound(std::size_t terms) const override { return terms == weights_.size() ? allowed : -1.0; }
    [[nodiscard]] std::optional<bench::LineSizes> sizes() const override { return has; }

    Fed fed;
    int rests = 0;
    bool forgets = true;
    double off = 0.0;
    double allowed = 1e-12;  // far above the roundings of some sums, far below a sample
    std::optional<bench::LineSizes> has;

private:
    std::vector<double> weights_;
    std::vector<double> past_;
};

// The row of a hundred samples.
bench::Json row_of(Recorded& line, const std::vector<double>& weights, bool rests) {
    bench::set_benchmark_flags(
        {"--benchmark_repetitions=1", "--benchmark_enable_random_interleaving=false", "--benchmark_filter=."});
    const std::vector<reference::Real> exact(weights.begin(), weights.end());
    benchmark::RegisterBenchmark("fed", [&](benchmark::State& state) {
        bench::time_line(state, line, exact, rests);
    })->Iterations(100);
    return bench::run_benchmarks(1).at("benchmarks").at(0);
}

// A sample more than the window holds, then what is timed in one piece, then the one whose output is checked.
TEST(TimeLine, FeedsAWindowAndChecksTheNextOutput) {
    const std::vector<double> weights = {1.0, -0.5, 0.25};
    Recorded line(weights);
    line.has = bench::LineSizes{3, 24, 48};
    const bench::Json row = row_of(line, weights, false);
    EXPECT_FALSE(row.contains("error_occurred")) << row;
    EXPECT_EQ(line.fed, (Fed{{0, 4}, {4, 100}, {104, 1}}));
    EXPECT_EQ(line.rests, 0);
    EXPECT_EQ(row.at("iterations"), 100);
    EXPECT_EQ(row.at("macs_per_sample"), 3.0);
    EXPECT_EQ(row.at("coefficient_bytes"), 24.0);
    EXPECT_EQ(row.at("state_bytes"), 48.0);
    EXPECT_TRUE(row.contains("cycles_per_sample"));
    EXPECT_TRUE(row.contains("ns_per_sample"));
    // One that sums nothing has no sizes.
    Recorded other(weights);
    EXPECT_FALSE(row_of(other, weights, false).contains("state_bytes"));
}

// Emptied, and filled again with what the exact sum reaches.
TEST(TimeLine, ALineThatForgetsNothingRestsBeforeTheCheck) {
    for (const auto& [weights, fed] : {std::pair(std::vector{1.0, 1.0, 1.0}, Fed{{0, 4}, {4, 100}, {102, 2}, {104, 1}}),
                                       std::pair(std::vector{0.5, 0.25}, Fed{{0, 3}, {3, 100}, {102, 1}, {103, 1}})}) {
        Recorded line(weights);
        line.forgets = false;
        const bench::Json row = row_of(line, weights, true);
        EXPECT_FALSE(row.contains("error_occurred")) << row;
        EXPECT_EQ(line.fed, fed);
        EXPECT_EQ(line.rests, 1);
        // Without the rest its past is in the sum.
        Recorded tired(weights);
        tired.forgets = false;
        EXPECT_TRUE(row_of(tired, weights, false).contains("error_occurred"));
    }
}

// An error as large as its bound is none; of one weight nothing is fed between the rest and the check.
TEST(TimeLine, AnExactLineMayHaveABoundOfNothing) {
    Recorded line({1.0});
    line.allowed = 0.0;
    const bench::Json row = row_of(line, {1.0}, true);
    EXPECT_FALSE(row.contains("error_occurred")) << row;
    EXPECT_EQ(line.fed, (Fed{{0, 2}, {2, 100}, {102, 1}}));
}

TEST(TimeLine, AWrongAnswerIsNoTime) {
    for (const double off : {0.5, -0.5, std::numeric_limits<double>::quiet_NaN()}) {
        Recorded line({1.0});
        line.off = off;
        line.allowed = 0.25;
        const bench::Json row = row_of(line, {1.0}, false);
        ASSERT_TRUE(row.contains("error_occurred")) << row;
        EXPECT_THAT(row.at("error_message").get<std::string>(), testing::StartsWith("wrong answer: error "));
        EXPECT_THAT(row.at("error_message").get<std::string>(), testing::EndsWith(" beyond its bound 0.25"));
        EXPECT_FALSE(row.contains("cycles_per_sample"));
    }
}

// A line that takes a tenth of a millisecond each time, however many samples it is fed with.
class Slow : public Recorded {
public:
    using Recorded::Recorded;
    double feed(std::size_t from, std::size_t count) override {
        const auto begin = std::chrono::steady_clock::now();
        while (std::chrono::steady_clock::now() - begin < std::chrono::microseconds(100)) {
        }
        fed.emplace_back(from, count);
        return 0.0;
    }
};

TEST(TimeLine, IsEstimatedByTheShortestOfSomeTries) {
    Slow line({1.0});
    const double ns = bench::estimated_ns(line, 3);
    ASSERT_GT(line.fed.size(), 10U);
    EXPECT_EQ(line.fed[0], (Fed::value_type{0, 4}));  // the window is full, and one more
    for (std::size_t i = 1; i < line.fed.size(); ++i) {
        EXPECT_EQ(line.fed[i].first, line.fed[i - 1].first + line.fed[i - 1].second) << i;
        EXPECT_EQ(line.fed[i].second, line.fed[1].second) << i;
    }
    const auto samples = static_cast<double>(line.fed[1].second);
    EXPECT_GE(ns, 1e5 / samples);
    EXPECT_LT(ns, 1e8 / samples);  // not every try is disturbed for a tenth of a second
}

}  // namespace
