// Weights of higher order as a choice: what they converge to and how fast, which kernels sum them, what their rows say.
#include "bench/sweep/exact_weights.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "bench/host/host_timing.hpp"
#include "bench/report/discretisation_table.hpp"
#include "bench/rows/key.hpp"
#include "bench/sweep/accuracy.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/signals.hpp"
#include "reference/derivatives.hpp"
#include "reference/sums.hpp"

namespace {

using bench::Discretisation;
using reference::Real;

constexpr Discretisation all[] = {Discretisation::gl, Discretisation::shifted, Discretisation::bdf2,
                                  Discretisation::bdf3, Discretisation::bdf4};
constexpr Discretisation of_higher_order[] = {Discretisation::bdf2, Discretisation::bdf3, Discretisation::bdf4};

TEST(Discretisation, NamesAreReadAsTheyAreWritten) {
    for (const Discretisation one : all) {
        EXPECT_EQ(bench::parse_discretisation(bench::to_text(one)), one);
    }
    for (const char* text : {"", "GL", "bdf1", "bdf5", "bdf", "gl "}) {
        EXPECT_FALSE(bench::parse_discretisation(text)) << text;
    }
    EXPECT_THROW((void)bench::named_weights(Discretisation::shifted, 0.5, false, 3), std::out_of_range);
}

// The error at t = 1 of D^v t^6, which starts smoothly enough for all of them, in so many steps.
double error_at_one(Discretisation discretisation, double order, std::size_t steps) {
    const Real h = Real(1) / steps;
    std::vector<Real> a = reference::weights(Real(order), steps + 1);
    if (bench::names_weights(discretisation)) {  // those that the kernels are given
        const auto named = bench::named_weights(discretisation, order, false, steps);
        std::copy(named.begin(), named.end(), a.begin() + 1);
    }
    Real sum = 0;
    for (std::size_t j = 0; j <= steps; ++j) {
        sum += a[j] * pow(Real(steps - j) / steps, 6);
    }
    const Real found = bench::first_weight(discretisation, order) * pow(h, -Real(order)) * sum;
    const Real at = 1 - bench::lag_steps(discretisation, order) * h;
    return static_cast<double>(abs(found - reference::derivative_of_power(6, order, at)));
}

TEST(Discretisation, ErrorsFallWithThePromisedPowerOfTheStep) {
    const double promised[] = {1, 2, 2, 3, 4};
    for (const double order : {0.5, 0.9, 1.5, -0.5}) {
        for (std::size_t i = 0; i < std::size(all); ++i) {
            const double observed = std::log2(error_at_one(all[i], order, 200) / error_at_one(all[i], order, 400));
            EXPECT_NEAR(observed, promised[i], 0.1) << bench::to_text(all[i]) << " of order " << order;
        }
    }
}

TEST(Discretisation, OverIncrementsTheWeightsAreTheSums) {
    for (const Discretisation one : of_higher_order) {
        const auto a = bench::named_weights(one, 0.5, false, 50);
        const auto b = bench::named_weights(one, 0.5, true, 50);
        ASSERT_EQ(a.size(), 50U);
        ASSERT_EQ(b.size(), 50U);
        double sum = 1.0;
        for (std::size_t j = 0; j < a.size(); ++j) {
            sum += a[j];
            EXPECT_NEAR(b[j], sum, 1e-15);
        }
    }
}

bench::Sweep sweep_of(Discretisation weights, std::vector<std::string> kernels, std::vector<double> orders,
                      std::vector<std::string> signals) {
    bench::Sweep sweep;
    sweep.weights = weights;
    sweep.kernels = std::move(kernels);
    sweep.orders = std::move(orders);
    sweep.samples = 400;
    sweep.lengths = {{5}, {50}, {sweep.samples, true}};
    sweep.signals = std::move(signals);
    sweep.targets = {"host"};
    return sweep;
}

std::vector<bench::Json> rows_of(const bench::Sweep& sweep) {
    std::vector<std::size_t> cases(sweep.orders.size() * sweep.signals.size());
    std::iota(cases.begin(), cases.end(), std::size_t{0});
    std::vector<bench::Json> rows;
    for (const auto& of_case : bench::measure_accuracy(sweep, cases)) {
        rows.insert(rows.end(), of_case.begin(), of_case.end());
    }
    return rows;
}

double counter(const bench::Sweep& sweep, const char* name) { return rows_of(sweep).back().at(name).get<double>(); }

// The difference formula (3/2, -2, 1/2) is exact for a line from its third sample on; at the second it errs by half the
// slope, of which the largest sum has 1.5; bdf3 and bdf4 by 5/6 of 11/6 and 13/12 of 25/12. In the second half by
// nothing.
TEST(Discretisation, OfTheFirstDerivativeOfARampIsKnown) {
    const double known[] = {(3.0 / 2 - 1) / (3.0 / 2), (11.0 / 6 - 1) / (11.0 / 6), (25.0 / 12 - 1) / (25.0 / 12)};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto sweep = sweep_of(of_higher_order[i], {"shift_plain_f64"}, {1.0}, {"ramp"});
        EXPECT_NEAR(counter(sweep, "discretisation_error_max"), known[i], 1e-12) << i;
        EXPECT_LE(counter(sweep, "discretisation_error_late_max"), 1e-11) << i;
    }
}

// A difference quotient taken for the derivative in the middle of its step: (w h)^2 / 24 of its peak.
TEST(Discretisation, ShiftedByHalfAStepADifferenceIsOfSecondOrder) {
    const double angle = 2.0 * std::numbers::pi * 50.0 * bench::step_s;
    auto sweep = sweep_of(Discretisation::shifted, {"shift_plain_f64"}, {1.0}, {"sine50"});
    EXPECT_NEAR(counter(sweep, "discretisation_error_max") / (angle * angle / 24.0), 1.0, 0.02);
    // The sums are those of gl, whatever they stand for; and what they stand for begins with the record.
    sweep.orders = {2.0, 0.5};
    auto gl = sweep;
    gl.weights = Discretisation::gl;
    const auto rows = rows_of(sweep);
    const auto rows_of_gl = rows_of(gl);
    ASSERT_EQ(rows.size(), rows_of_gl.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i]["error_max"], rows_of_gl[i]["error_max"]);
        EXPECT_LT(rows[i]["discretisation_error_late_max"], rows_of_gl[i]["discretisation_error_late_max"]);
    }
}

// Of the second half of a sine's record the higher order is the nearer.
TEST(Discretisation, LateErrorsShowTheOrder) {
    double before = 1.0;
    for (const Discretisation one : {Discretisation::gl, Discretisation::bdf2, Discretisation::bdf3}) {
        auto sweep = sweep_of(one, {"shift_plain_f64"}, {0.9}, {"sine5"});
        sweep.samples = 1000;
        sweep.lengths = {{1000, true}};
        const double late = counter(sweep, "discretisation_error_late_max");
        EXPECT_LT(late, before / 3.0) << bench::to_text(one);
        before = late;
    }
}

// In double every kernel's rounding is far below its truncation, so it sums the very weights that it is held against.
TEST(Discretisation, KernelsInDoubleSumTheWeights) {
    for (const Discretisation one : of_higher_order) {
        const auto rows = rows_of(sweep_of(
            one,
            {"shift_plain_f64", "ring_horner_f64", "mirror_simd_f64", "mirrordelta_oldest_f64", "nested_plain_f64"},
            {0.5, 1.5, -0.5}, {"step", "sine5", "noise"}));
        std::size_t measured = 0;
        for (const bench::Json& row : rows) {
            ASSERT_FALSE(row.contains("error_occurred")) << row;
            EXPECT_LE(row["rounding_error_max"].get<double>(), 1e-12) << row["name"];
            const auto key = bench::parse_key(row["name"].get<std::string>());
            ASSERT_TRUE(key);
            if (key->taps == "full") {
                EXPECT_LE(row["error_max"].get<double>(), 1e-12) << row["name"];
            }
            ++measured;
        }
        EXPECT_EQ(measured, 3U * 3U * (3U * 4U + 2U)) << bench::to_text(one);
    }
}

// Modes are made for the weights themselves: what their rows truncate is within the error of the design.
TEST(Discretisation, ModesKeepTheErrorsThatTheyAreDesignedFor) {
    for (const Discretisation one : of_higher_order) {
        for (const bool increments : {false, true}) {
            const std::string kernel = increments ? "modesdelta_plain_f64" : "modes_plain_f64";
            const double order = 0.5;
            const auto sweep = sweep_of(one, {kernel}, {order}, {"step", "sine5", "noise"});
            const auto lengths = bench::lengths_of(sweep, kernel, order);
            ASSERT_EQ(lengths.size(), sweep.design_errors.size());
            const auto rows = rows_of(sweep);
            ASSERT_EQ(rows.size(), sweep.signals.size() * lengths.size());
            for (std::size_t i = 0; i < rows.size(); ++i) {
                ASSERT_FALSE(rows[i].contains("error_occurred")) << rows[i];
                const auto record = bench::make_signal(sweep.signals[i / lengths.size()], sweep.samples, sweep.seed);
                const std::size_t reach[] = {record.size()};
                const auto weights = bench::exact_weights(one, order, record.size());
                double peak = 0.0;
                const auto exact = reference::sums(weights, record, reach).front();
                for (const auto& sum : exact) {
                    peak = std::max(peak, std::fabs(sum.high));
                }
                // Of |x| <= 0.9, of increments twice that.
                const double largest = bench::signal_peak * (increments ? 2.0 : 1.0);
                EXPECT_LE(rows[i]["truncation_error_max"].get<double>() * peak,
                          largest * sweep.design_errors[i % lengths.size()] * (1.0 + 1e-6))
                    << rows[i]["name"];
                EXPECT_LE(rows[i]["rounding_error_max"].get<double>(), 1e-11) << rows[i]["name"];
            }
        }
    }
}

TEST(Discretisation, KernelsThatCannotSumNamedWeightsSayWhy) {
    for (const char* kernel : {"ring_plain_f32", "mirror_smlaldshaped_q15", "mirror_scaled_q15", "ring_horner_f32",
                               "nested_plain_q31", "block_oldestfma_f32", "modes_plain_q31", "modesdelta_plain_f32",
                               "cascadedelta_df2t_f32", "mirrordelta_plain_f32", "null", "peer_std_f32"}) {
        EXPECT_EQ(bench::why_not_served(kernel, Discretisation::bdf2), "") << kernel;
    }
    for (const char* kernel : {"mirrorhold_plain_f32", "mirrorlinear_plain_f32", "ring_horner_q31"}) {
        EXPECT_NE(bench::why_not_served(kernel, Discretisation::bdf3), "") << kernel;
        EXPECT_EQ(bench::why_not_served(kernel, Discretisation::gl), "") << kernel;
        EXPECT_EQ(bench::why_not_served(kernel, Discretisation::shifted), "") << kernel;
        const auto sweep = sweep_of(Discretisation::bdf2, {kernel}, {0.5}, {"step"});
        EXPECT_TRUE(bench::lengths_of(sweep, kernel, 0.5).empty()) << kernel;
    }
}

// A timing's answer is checked against the same weights, of kernels and of other libraries alike.
TEST(Discretisation, TimingsCheckTheirAnswers) {
    std::vector<bench::Timed> cases;
    for (const double order : {0.5, 1.9909, -0.5}) {
        for (const char* name : {"ring_plain_f32", "ring_plain_q31", "mirrordelta_plain_f32", "nested_plain_f32",
                                 "block_simd_f32", "peer_std_f32", "peer_std_q31"}) {
            cases.push_back({name, bench::Length{100}, order, Discretisation::bdf4});
        }
    }
    for (bench::Timed& timed : cases) {
        if (timed.name == "nested_plain_f32") {
            timed.length = bench::length_of(timed.name, timed.order, 50, 1000);
        }
    }
    const auto timing = bench::time_on_host(cases, 1000, 1, {"--benchmark_min_time=0.0001"});
    ASSERT_EQ(timing.rows.size(), cases.size());
    for (const bench::Json& row : timing.rows) {
        EXPECT_FALSE(row.value("error_occurred", false)) << row;
    }
}

TEST(DiscretisationTable, HasALineForEachOrderAndNamesTheWeights) {
    const auto sweep = sweep_of(Discretisation::bdf3, {"ring_plain_f32"}, {0.5, 1.5}, {"sine5", "noise", "step"});
    const auto rows = rows_of(sweep);
    const std::string text = bench::discretisation_table({{"weights", "bdf3"}}, rows);
    EXPECT_NE(text.find("weights bdf3"), std::string::npos) << text;
    EXPECT_NE(text.find("sine5      step\n  0.5 "), std::string::npos) << text;
    EXPECT_NE(text.find("\n  1.5 "), std::string::npos) << text;
    char expected[32];
    std::snprintf(expected, sizeof expected, " %.2e", rows.front().at("discretisation_error_max").get<double>());
    EXPECT_NE(text.find(expected), std::string::npos) << text;
    EXPECT_NE(bench::discretisation_table({}, rows).find("weights gl"), std::string::npos);
    EXPECT_NE(bench::discretisation_table({{"weights", 7}}, rows).find("weights 7"), std::string::npos);
    EXPECT_EQ(bench::discretisation_table({}, {}), "");
}

}  // namespace
