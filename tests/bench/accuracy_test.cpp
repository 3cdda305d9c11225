#include "bench/sweep/accuracy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "bench/sweep/derivative_limits.hpp"
#include "bench/sweep/signal_derivatives.hpp"
#include "bench/sweep/signals.hpp"
#include "reference/sums.hpp"

namespace {

// The counter of each row of one kernel in double; nothing where the row has none.
std::vector<std::optional<double>> discretisation(double order, const std::vector<std::string>& signals,
                                                  std::size_t samples = 1000) {
    bench::Sweep sweep;
    sweep.kernels = {"shift_plain_f64"};
    sweep.orders = {order};
    sweep.lengths = {{50}, {samples, true}};
    sweep.signals = signals;
    sweep.samples = samples;
    std::vector<std::optional<double>> all;
    std::vector<std::size_t> cases(signals.size());
    std::iota(cases.begin(), cases.end(), std::size_t{0});
    for (const auto& rows : bench::measure_accuracy(sweep, cases)) {
        for (const bench::Json& row : rows) {
            EXPECT_FALSE(row.contains("error_occurred")) << row;
            const auto found = row.find("discretisation_error_max");
            all.push_back(found == row.end() ? std::nullopt : std::optional(found->get<double>()));
        }
    }
    return all;
}

TEST(Accuracy, DiscretisationIsKnownForWholeOrders) {
    for (const auto& row : discretisation(0.0, {"step", "ramp", "sine1", "sine50"})) {
        EXPECT_LE(row.value(), 1e-13);
    }
    // The difference quotient of a step and of a ramp is exact behind the start, but for the rounding of the record.
    for (const auto& row : discretisation(1.0, {"step", "ramp"})) {
        EXPECT_LE(row.value(), 1e-12);
    }
    // That of a sine lags by half a step: w h / 2 of its peak, all but the phases that the samples miss.
    const double lag = 2.0 * std::numbers::pi * 50.0 * 1e-3 / 2.0;
    for (const auto& row : discretisation(1.0, {"sine50"})) {
        EXPECT_LE(row.value(), lag * 1.01);
        EXPECT_GE(row.value(), lag * 0.99);
    }
    // Order 2 of a step: 0.9 (1, -1, 0, ...) against 0 from the second sample.
    for (const auto& row : discretisation(2.0, {"step"})) {
        EXPECT_NEAR(row.value(), 1.0, 1e-13);
    }
}

TEST(Accuracy, DiscretisationIsOfTheOrderAndTheSignalAlone) {
    const auto rows = discretisation(0.5, {"sine5", "ramp"});
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_EQ(rows[0], rows[1]);
    EXPECT_EQ(rows[2], rows[3]);
    EXPECT_GT(rows[0].value(), rows[2].value());
}

// The samples it is taken at see what all would see.
TEST(Accuracy, DiscretisationMissesNoPhaseOfASine) {
    constexpr std::size_t samples = 1000;
    const reference::Real v = -0.5;
    const reference::Real h = bench::step_s;
    for (const std::string signal : {"sine1", "sine50"}) {
        const auto derivative = bench::derivative_of_signal(signal, samples);
        const std::size_t lengths[] = {samples};
        const auto exact =
            reference::sums(reference::weights(v, samples), bench::make_signal(signal, samples, 1), lengths);
        double peak = 0.0;
        double largest = 0.0;
        for (std::size_t k = 1; k < samples; ++k) {
            const auto limit = static_cast<double>(derivative(v, k * h) * pow(h, v));
            largest = std::max(largest, std::fabs(exact.front()[k].high - limit));
            peak = std::max(peak, std::fabs(exact.front()[k].high));
        }
        const double found = discretisation(-0.5, {signal}).front().value();
        EXPECT_NEAR(found / (largest / peak), 1.0, 0.01) << signal;
    }
}

TEST(Accuracy, SignalsWithoutFormulaHaveNoDiscretisation) {
    for (const auto& row : discretisation(0.5, {"noise", "drive"})) {
        EXPECT_FALSE(row.has_value());
    }
}

TEST(Accuracy, RoundingIsAgainstTheKernelsOwnDesign) {
    // Of one length, with and without a running sum; with blocks of as many coefficients.
    bench::Sweep sweep;
    sweep.kernels = {"modes_plain_f64", "modessum_plain_f64", "nested_plain_f64"};
    sweep.orders = {-0.5};
    sweep.lengths = {bench::parse_length("1+6", 400).value(), {13}};
    sweep.signals = {"noise"};
    sweep.samples = 400;
    const std::vector<std::size_t> cases = {0};
    const auto rows = bench::measure_accuracy(sweep, cases);
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].size(), 3U);
    for (const bench::Json& row : rows[0]) {
        EXPECT_LE(row.at("rounding_error_max").get<double>(), 1e-14) << row;
    }
}

// At 600 taps of a smooth and of a measured signal: in double the same errors, in fifteen bits larger ones, as what is
// rounded there weighs more. Of other lengths and signals none.
TEST(Accuracy, SmallAmplitudesAreOfOneLengthAndTwoSignals) {
    bench::Sweep sweep;
    sweep.kernels = {"shift_plain_f64", "ring_plain_q15"};
    sweep.orders = {0.5};
    sweep.lengths = {{599}, {600}, {601}};
    sweep.signals = {"step", "sine5", "drive"};
    sweep.samples = 1000;
    std::map<std::string, bench::Json> found;
    for (const auto& rows : bench::measure_accuracy(sweep, {0, 1, 2})) {
        for (const bench::Json& row : rows) {
            found[row.at("name").get<std::string>()] = row;
        }
    }
    EXPECT_EQ(found.size(), 2U * (9U + 4U));
    for (const std::string signal : {"sine5", "drive"}) {
        const auto counter = [&](const std::string& kernel, const std::string& amplitude, const char* name) {
            const std::string row = "gl/" + kernel + "/order:0.5/taps:600/accuracy/signal:" + signal + amplitude;
            EXPECT_TRUE(found.contains(row)) << row;
            return found[row].value(name, -1.0);
        };
        double before = counter("ring_plain_q15", "", "rounding_error_max");
        for (const std::string amplitude : {"/amplitude:0.0625", "/amplitude:0.00390625"}) {
            for (const char* name : {"error_max", "error_rms", "rounding_error_max", "truncation_error_max"}) {
                EXPECT_EQ(counter("shift_plain_f64", amplitude, name), counter("shift_plain_f64", "", name)) << name;
            }
            const double rounding = counter("ring_plain_q15", amplitude, "rounding_error_max");
            EXPECT_GT(rounding, before);
            before = rounding;
        }
    }
}

// Of 600 coefficients the first is 1, and neither held nor multiplied by; of two bytes each.
TEST(Accuracy, RowsSayWhatAKernelHolds) {
    bench::Sweep sweep;
    sweep.kernels = {"ring_plain_q15"};
    sweep.orders = {0.5};
    sweep.lengths = {{600}, bench::parse_length("2+7", 1000).value()};
    sweep.signals = {"noise"};
    sweep.samples = 1000;
    const auto rows = bench::measure_accuracy(sweep, {0});
    ASSERT_EQ(rows[0].size(), 1U);  // a window has no modes
    const bench::Json& row = rows[0][0];
    EXPECT_EQ(row.at("coefficient_bytes"), 2.0 * 599.0);
    EXPECT_EQ(row.at("horizon_samples"), 600.0);
    EXPECT_EQ(row.at("macs_per_sample"), 599.0);
    EXPECT_EQ(row.at("effective_taps"), 600.0);
    EXPECT_EQ(row.at("iterations"), 1000);
}

TEST(Accuracy, ShortRecordsAreMeasured) {
    for (const std::size_t samples : {2U, 3U, 7U}) {
        for (const auto& row : discretisation(0.5, {"step"}, samples)) {
            EXPECT_TRUE(row.has_value());
        }
    }
    EXPECT_FALSE(discretisation(0.5, {"step"}, 1).front().has_value());
}

// At up to 200 samples from the first to the last, each as much later than the one before; late from the middle on.
TEST(DerivativeLimits, LieFromTheFirstSampleToTheLast) {
    const auto samples_of = [](std::size_t samples) {
        std::vector<std::size_t> found;
        for (const bench::DerivativeLimit& limit : bench::derivative_limits("ramp", samples, 0.5)) {
            found.push_back(limit.sample);
            EXPECT_EQ(limit.late, 2 * limit.sample >= samples) << limit.sample;
        }
        return found;
    };
    EXPECT_EQ(samples_of(5), (std::vector<std::size_t>{1, 2, 3, 4}));
    EXPECT_EQ(samples_of(2), std::vector<std::size_t>{1});
    EXPECT_TRUE(samples_of(1).empty());
    const auto many = samples_of(100000);
    EXPECT_LE(many.size(), 200U);
    EXPECT_EQ(many.front(), 1U);
    EXPECT_EQ(many.back(), 99999U);
    EXPECT_EQ(many[many.size() - 2], static_cast<std::size_t>(std::lround(std::pow(99999.0, 198.0 / 199.0))));
    EXPECT_TRUE(std::is_sorted(many.begin(), many.end()));
    EXPECT_EQ(std::adjacent_find(many.begin(), many.end()), many.end());
    EXPECT_TRUE(bench::derivative_limits("noise", 100, 0.5).empty());
}

// h^v / w_0 times the derivative, at the place of which the weights are an approximation.
TEST(DerivativeLimits, AreInTheUnitOfTheSum) {
    constexpr double h = 1e-3;
    for (const bench::DerivativeLimit& limit : bench::derivative_limits("step", 100, 0.5)) {
        const double t = static_cast<double>(limit.sample) * h;
        EXPECT_NEAR(limit.value, 0.9 * std::sqrt(h) / std::sqrt(std::numbers::pi * t), 1e-12) << limit.sample;
    }
    for (const bench::DerivativeLimit& limit : bench::derivative_limits("ramp", 101, 1.0)) {
        EXPECT_NEAR(limit.value, 0.9 / 100.0, 1e-15);  // of sample to sample
    }
    for (const bench::DerivativeLimit& limit :
         bench::derivative_limits("ramp", 101, 1.0, bench::Discretisation::bdf2)) {
        EXPECT_NEAR(limit.value, 0.9 / 100.0 / 1.5, 1e-15);
    }
    for (const bench::DerivativeLimit& limit :
         bench::derivative_limits("ramp", 101, -1.0, bench::Discretisation::shifted)) {
        const double k = static_cast<double>(limit.sample) + 0.5;  // half a step later
        EXPECT_NEAR(limit.value, 0.9 / 100.0 * k * k / 2.0, 1e-12) << limit.sample;
    }
    const std::vector<bench::DerivativeLimit> limits = {
        {1, 2.0, false}, {5, -3.0, false}, {9, -2.5, true}, {11, 1.0, true}};
    const bench::LimitError error =
        bench::error_at(limits, [](const bench::DerivativeLimit& limit) { return limit.value; });
    EXPECT_EQ(error.largest, 3.0);
    EXPECT_EQ(error.late, 2.5);
}

}  // namespace
