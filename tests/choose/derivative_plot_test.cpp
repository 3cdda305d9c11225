// The picture of a derivative's errors: its numbers by closed forms, and which of them is drawn in which panel.
#include "bench/choose/derivative_plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tests/bench/pretend_gnuplot.hpp"

namespace {

using glsum::design::DerivativeGoal;
using testing::HasSubstr;
using testing::Not;
using Rows = std::vector<std::vector<double>>;

constexpr double h = 0.001;
constexpr double pi = std::numbers::pi;

class DerivativePlot : public PretendGnuplot {
protected:
    // Of an integral, c (1 + 1/z) stands for it: its gain is 2 c cos(w h / 2), its phase -w h / 2, and a step's
    // response stays at 2 c.
    static constexpr double c = 0.25;
    std::string drawn(const DerivativeGoal& goal, double limit = 0.02) {
        choose::DerivativeReport report{};
        report.filter.factor = c;
        report.filter.weights = {1.0};
        choose::plot_derivative(report, goal, limit, stem());
        return sent();
    }
    // A block of numbers by its name.
    static Rows block(const std::string& script, const std::string& name) {
        const std::size_t begin = script.find('\n', script.find(name + " << EOD")) + 1;
        std::istringstream lines(script.substr(begin, script.find("EOD", begin) - begin));
        Rows rows;
        for (std::string line; std::getline(lines, line);) {
            std::istringstream words(line);
            rows.emplace_back();
            for (double value = 0.0; words >> value;) {
                rows.back().push_back(value);
            }
        }
        return rows;
    }
    // From a panel's title to what begins behind its lines.
    static std::string panel(const std::string& script, const std::string& title) {
        const std::size_t begin = script.find("set title \"" + title + '"');
        return script.substr(begin, script.find("\"chosen\"", begin) - begin);
    }
};

double off_by(double value, double wanted) { return std::fabs(value - wanted) / std::max(1.0, std::fabs(wanted)); }

// Beside the sum's, h / (1 - 1/z): (w h / 2) / sin(w h / 2) of the integral, w h / 2 ahead of it.
TEST_F(DerivativePlot, HasTheErrorsOfGainAndPhaseOverFrequency) {
    const std::string script = drawn({-1.0, h, glsum::design::Band{0.1, 10.0}, {}});
    const Rows rows = block(script, "$r");
    ASSERT_EQ(rows.size(), 401U);
    EXPECT_DOUBLE_EQ(rows.front()[0], 0.01);  // a tenth of the band's lowest
    EXPECT_DOUBLE_EQ(rows.back()[0], 500.0);  // half the sampling rate
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
        const double hz = rows[i][0];
        ASSERT_EQ(rows[i].size(), 5U);
        EXPECT_LT(off_by(hz, 0.01 * std::pow(5e4, static_cast<double>(i) / 400.0)), 1e-6);
        const double half = pi * hz * h;
        const double w = 2.0 * pi * hz;
        EXPECT_LT(off_by(rows[i][1], 100.0 * (w * 2.0 * c * std::cos(half) - 1.0)), 1e-4) << hz;
        EXPECT_LT(off_by(rows[i][2], 90.0 - 180.0 * hz * h), 1e-4) << hz;
        EXPECT_LT(off_by(rows[i][3], 100.0 * (half / std::sin(half) - 1.0)), 1e-4) << hz;
        EXPECT_LT(off_by(rows[i][4], 180.0 * hz * h), 1e-4) << hz;
    }
}

// The sum's is h (k + 1) after k steps.
TEST_F(DerivativePlot, HasTheErrorsOfAStepFromItsTenthSampleOn) {
    const std::string script = drawn({-1.0, h, {}, 2.0});
    const Rows rows = block(script, "$s");
    ASSERT_GT(rows.size(), 20U);
    EXPECT_DOUBLE_EQ(rows.front()[0], 0.01);
    EXPECT_DOUBLE_EQ(rows.back()[0], 2.0);
    for (const auto& row : rows) {
        ASSERT_EQ(row.size(), 3U);
        EXPECT_LT(off_by(row[1], 100.0 * (2.0 * c / row[0] - 1.0)), 1e-4) << row[0];
        EXPECT_LT(off_by(row[2], 100.0 * h / row[0]), 1e-4) << row[0];
    }
}

// What is promised is shaded, and a quarter of what is to be seen.
TEST_F(DerivativePlot, DrawsEachErrorInItsPanel) {
    const std::string script = drawn({-1.0, h, glsum::design::Band{0.1, 10.0}, 2.0}, 0.01 * pi);
    const auto has = [](const std::string& text, const char* data, double range, const char* chosen,
                        const char* full_memory) {
        double low = 0.0;
        double high = 0.0;
        const std::size_t at = text.find("set yrange");
        ASSERT_NE(at, std::string::npos);
        ASSERT_EQ(std::sscanf(text.c_str() + at, "set yrange [%lf:%lf]", &low, &high), 2);
        EXPECT_NEAR(high, range, 1e-9);
        EXPECT_NEAR(low, -range, 1e-9);
        // Its lines: full memory first, so that it lies below.
        const std::size_t second = text.find("title \"full memory\"");
        EXPECT_THAT(text.substr(0, second), HasSubstr(std::string(data) + " using 1:" + full_memory));
        EXPECT_THAT(text.substr(second), HasSubstr(std::string(data) + " using 1:" + chosen));
    };
    has(panel(script, "gain"), "$r", 4.0 * pi, "2", "4");
    has(panel(script, "phase"), "$r", 4.0 * 1.8, "3", "5");
    has(panel(script, "response to a step"), "$s", 4.0 * pi, "2", "3");
    const auto lies_before = [&](const std::string& shade, const char* title) {
        double from_x = 0.0, from_y = 0.0, to_x = 0.0, to_y = 0.0;
        const std::size_t at = script.rfind("set object 1 rectangle from", script.find(shade));
        (void)std::sscanf(script.c_str() + at, "set object 1 rectangle from %lf,%lf to %lf,%lf", &from_x, &from_y,
                          &to_x, &to_y);
        EXPECT_LT(at, script.find(title));
        return std::vector{from_x, from_y, to_x, to_y};
    };
    using testing::DoubleNear;
    using testing::ElementsAre;
    EXPECT_THAT(
        lies_before("set title \"gain\"", "set title \"gain\""),
        ElementsAre(DoubleNear(0.1, 1e-9), DoubleNear(-pi, 1e-9), DoubleNear(10.0, 1e-9), DoubleNear(pi, 1e-9)));
    EXPECT_THAT(
        lies_before("set title \"phase\"", "set title \"phase\""),
        ElementsAre(DoubleNear(0.1, 1e-9), DoubleNear(-1.8, 1e-9), DoubleNear(10.0, 1e-9), DoubleNear(1.8, 1e-9)));
    EXPECT_THAT(
        lies_before("set title \"response", "set title \"response"),
        ElementsAre(DoubleNear(0.01, 1e-9), DoubleNear(-pi, 1e-9), DoubleNear(2.0, 1e-9), DoubleNear(pi, 1e-9)));
    EXPECT_THAT(script, HasSubstr("set xrange [0.01:500"));
    EXPECT_THAT(script, HasSubstr("set xrange [0.01:2"));
}

// A panel for what is asked for, each as wide as another.
TEST_F(DerivativePlot, LeavesOutWhatIsNotAskedFor) {
    const auto width = [](const std::string& script) {
        int found = 0;
        (void)std::sscanf(script.c_str(), "set terminal svg size %d", &found);
        return found;
    };
    const auto panels = [](const std::string& script) {
        int found = 0;
        (void)std::sscanf(script.c_str() + script.find("set multiplot layout"), "set multiplot layout 1,%d", &found);
        return found;
    };
    const std::string band = drawn({-1.0, h, glsum::design::Band{0.1, 10.0}, {}});
    const std::string step = drawn({-1.0, h, {}, 2.0});
    const std::string both = drawn({-1.0, h, glsum::design::Band{0.1, 10.0}, 2.0});
    EXPECT_EQ(panels(band), 2);
    EXPECT_EQ(panels(step), 1);
    EXPECT_EQ(panels(both), 3);
    EXPECT_EQ(2 * width(band), 4 * width(step));
    EXPECT_EQ(width(both), 3 * width(step));
    EXPECT_THAT(band, Not(HasSubstr("response to a step")));
    EXPECT_THAT(step, Not(HasSubstr("\"gain\"")));
    EXPECT_THAT(step, Not(HasSubstr("\"phase\"")));
}

}  // namespace
