// What a fit says of how well it knows its parameters, where that has a closed form: in its gain and its offset a model
// is linear, and the fit is a straight line through the points (unit response, output).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "drive/fit.hpp"
#include "drive/response.hpp"

namespace {

// Few samples, so that two degrees of freedom more or less are seen.
TEST(FitIntervals, OfGainAndOffsetAreThoseOfAStraightLine) {
    constexpr int samples = 12;
    drive::Record record;
    record.name = "step";
    record.changes = {{0.0, 1.0}};
    for (int k = 0; k < samples; ++k) {
        record.time_s.push_back(0.25 * k);
    }
    const drive::Model unit = drive::make_fopdt(1.0, 0.8, 0.0);
    const std::vector<double> x = drive::respond(unit, record.changes, record.time_s);
    const double noise[samples] = {0.03, -0.01, 0.02, -0.04, 0.01, 0.0, -0.02, 0.05, -0.03, 0.01, 0.02, -0.01};
    for (int k = 0; k < samples; ++k) {
        record.output.push_back(0.3 + 2.0 * x[k] + noise[k]);
    }

    double sum_x = 0.0;
    double sum_y = 0.0;
    double sum_xx = 0.0;
    double sum_xy = 0.0;
    for (int k = 0; k < samples; ++k) {
        sum_x += x[k];
        sum_y += record.output[k];
        sum_xx += x[k] * x[k];
        sum_xy += x[k] * record.output[k];
    }
    const double spread = sum_xx - sum_x * sum_x / samples;
    const double gain = (sum_xy - sum_x * sum_y / samples) / spread;
    const double offset = (sum_y - gain * sum_x) / samples;
    double squares = 0.0;
    double neighbours = 0.0;
    for (int k = 0; k < samples; ++k) {
        const auto left = [&](int at) { return record.output[at] - offset - gain * x[at]; };
        squares += left(k) * left(k);
        neighbours += k > 0 ? left(k) * left(k - 1) : 0.0;
    }
    const double deviation = std::sqrt(squares / (samples - 2));  // two numbers were fitted
    const double of_gain = deviation / std::sqrt(spread);
    const double of_offset = of_gain * std::sqrt(sum_xx / samples);
    constexpr double students_t_of_10 = 2.228138852;  // of 97.5 %, from tables

    drive::Form form(drive::Kind::fopdt, unit);
    for (drive::Parameter& parameter : form.parameters()) {
        parameter.fixed = parameter.name != "gain" && parameter.name != "offset";
    }
    const drive::Fit fit = drive::fit(form, {record}, {});
    EXPECT_NEAR(fit.sum_of_squares, squares, 1e-9);
    EXPECT_NEAR(fit.noise_deviation, deviation, 1e-7);
    EXPECT_NEAR(fit.lag_one, neighbours / squares, 1e-5);
    ASSERT_EQ(fit.free_names, (std::vector<std::string>{"gain", "offset"}));
    const struct {
        const char* name;
        double value;
        double deviation;
    } expected[] = {{"gain", gain, of_gain}, {"offset", offset, of_offset}};
    for (const auto& [name, value, own] : expected) {
        for (const drive::Estimate& estimate : fit.parameters) {
            if (estimate.name == name) {
                EXPECT_NEAR(estimate.value, value, 1e-6) << name;
                EXPECT_NEAR(estimate.deviation, own, 1e-6) << name;
                EXPECT_NEAR(estimate.low, value - students_t_of_10 * own, 1e-6) << name;
                EXPECT_NEAR(estimate.high, value + students_t_of_10 * own, 1e-6) << name;
            }
        }
    }
    // Along a line the sum of squares is a parabola: by profile the ends are the same, as near as they are looked for.
    const drive::Fit by_profile = drive::fit(form, {record}, {.profile = true});
    for (const auto& [name, value, own] : expected) {
        for (const drive::Estimate& estimate : by_profile.parameters) {
            if (estimate.name == name) {
                EXPECT_NEAR((value - estimate.low) / own, students_t_of_10, 0.01) << name;
                EXPECT_NEAR((estimate.high - value) / own, students_t_of_10, 0.01) << name;
            }
        }
    }
    EXPECT_NEAR(fit.correlation(0, 1), -sum_x / std::sqrt(samples * sum_xx), 1e-6);
}

// A profile that comes upon a lower sum than the fit's own says that the fit had stopped on its way.
TEST(FitIntervals, OfAFitThatStoppedOnItsWaySaySo) {
    const drive::Model plant = drive::make_fopdt(2.0, 0.5, 0.2);
    drive::Record record;
    record.name = "step";
    record.changes = {{0.0, 1.0}};
    for (int k = 0; k < 60; ++k) {
        record.time_s.push_back(0.05 * k);
    }
    record.output = drive::respond(plant, record.changes, record.time_s);
    for (std::size_t k = 0; k < record.output.size(); ++k) {
        record.output[k] += k * 7 % 5 < 2 ? 0.02 : -0.013;
    }
    const drive::Form form(drive::Kind::fopdt, drive::make_fopdt(1.5, 0.8, 0.2));
    const auto says_so = [&](int iterations) {
        const drive::Fit fit = drive::fit(form, {record}, {.iterations = iterations, .profile = true});
        return std::any_of(fit.warnings.begin(), fit.warnings.end(), [](const std::string& warning) {
            return warning ==
                   "a lower sum of squares is near: the intervals are of where the fit stopped; take more iterations "
                   "or starts";
        });
    };
    EXPECT_TRUE(says_so(1));
    EXPECT_FALSE(says_so(100));
}

// What takes long is told from its beginning to its end, the starts before the intervals.
TEST(FitIntervals, TellHowFarTheyAre) {
    drive::Record record;
    record.name = "step";
    record.changes = {{0.0, 1.0}};
    for (int k = 0; k < 60; ++k) {
        record.time_s.push_back(0.05 * k);
    }
    record.output = drive::respond(drive::make_fopdt(2.0, 0.5, 0.2), record.changes, record.time_s);
    std::vector<std::string> told;
    drive::FitOptions options{.starts = 2, .profile = true};
    options.on_progress = [&](const std::string& part, std::size_t done, std::size_t all) {
        told.push_back(part + ' ' + std::to_string(done) + '/' + std::to_string(all));
    };
    record.output[20] += 0.01;
    const drive::Fit fit =
        drive::fit(drive::Form(drive::Kind::fopdt, drive::make_fopdt(1.8, 0.6, 0.2)), {record}, options);
    std::vector<std::string> expected{"starts 0/2", "starts 1/2", "starts 2/2"};
    for (std::size_t end = 0; end <= 2 * fit.free_names.size(); ++end) {
        expected.push_back("intervals " + std::to_string(end) + '/' + std::to_string(2 * fit.free_names.size()));
    }
    EXPECT_EQ(told, expected);
}

}  // namespace
