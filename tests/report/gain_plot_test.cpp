// The picture of the classic windows' front beside that of all kernels, as gnuplot is told to draw it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "base/gnuplot.hpp"
#include "bench/report/classic.hpp"
#include "bench/report/curves.hpp"
#include "tests/bench/pretend_gnuplot.hpp"
#include "tests/count_of.hpp"

namespace {

using test::count_of;
using testing::HasSubstr;
using testing::Not;

// A kernel's point: what it errs, and what it costs on a modelled core.
struct Made {
    std::string kernel;
    std::string order;
    std::string taps;
    double error;
    double cycles;
};

class FrontsPicture : public PretendGnuplot {
protected:
    // Cycles are its only cost: nothing says how many bytes there are.
    std::string drawn(const std::vector<Made>& all) {
        std::vector<bench::Json> rows;
        for (const Made& made : all) {
            const std::string name = "gl/" + made.kernel + "/order:" + made.order + "/taps:" + made.taps;
            rows.emplace_back(bench::make_row(name + "/accuracy/signal:step", 1))["error_max"] = made.error;
            rows.emplace_back(bench::make_row(name + "/m7:f746", 1))["model_cycles_per_sample"] = made.cycles;
        }
        const auto groups = bench::group(rows);
        const auto costs = bench::report::costs_of(groups);
        bench::report::plot_gains(stem(), bench::report::curve_points(groups, costs), costs);
        return sent();
    }
};

// A window at each end of its front, and what beats both.
std::vector<Made> windows_and_modes(const std::string& order) {
    return {{"ring_plain_f32", order, "600", 0x1p-7, 600.0},
            {"ring_plain_f32", order, "full", 0x1p-14, 5000.0},
            {"modes_plain_f32", order, "2+7", 0x1p-7, 60.0},
            {"modes_plain_f32", order, "2+11", 0x1p-14, 90.0}};
}

TEST_F(FrontsPicture, HasBothFrontsTheCheapestFirst) {
    const std::string text = drawn(windows_and_modes("0.5"));
    const std::size_t after = text.find("$after << EOD\n");
    ASSERT_NE(after, std::string::npos);
    EXPECT_THAT(text.substr(0, after), HasSubstr("\n6.000000e+02 7.812500e-03\n5.000000e+03 6.103516e-05\nEOD\n"));
    EXPECT_THAT(text.substr(after), HasSubstr("\n6.000000e+01 7.812500e-03\n9.000000e+01 6.103516e-05\nEOD\n"));
}

// From the cheapest of any front to twice the costliest: there a factor is written.
TEST_F(FrontsPicture, HasRoomForAllFrontsAndForTheFactorsBesideThem) {
    std::vector<Made> all = windows_and_modes("0.5");
    const std::string ranges =
        "set xrange " + base::log_range(60.0, 2.0 * 5000.0) + "\nset yrange " + base::log_range(0x1p-14, 0x1p-7) + "\n";
    EXPECT_THAT(drawn(all), HasSubstr(ranges));
    // Of several orders it is one range.
    all.push_back({"ring_plain_f32", "0.9", "50", 0.25, 40.0});
    EXPECT_THAT(drawn(all), HasSubstr("set xrange " + base::log_range(40.0, 2.0 * 5000.0) + "\nset yrange " +
                                      base::log_range(0x1p-14, 0.25) + "\n"));
}

TEST_F(FrontsPicture, ShowsNoErrorsBelow1e9) {
    EXPECT_THAT(drawn({{"ring_plain_f32", "0.5", "50", 0.25, 50.0}, {"modes_plain_f64", "0.5", "2+9", 1e-12, 100.0}}),
                HasSubstr("set yrange " + base::log_range(1e-9, 0.25) + "\n"));
    EXPECT_THAT(drawn({{"ring_plain_f64", "0.5", "full", 1e-12, 50.0}, {"modes_plain_f64", "0.5", "2+9", 1e-13, 90.0}}),
                HasSubstr("set yrange " + base::log_range(1e-9, 1e-9) + "\n"));
}

// Logarithmic axes have no zero.
TEST_F(FrontsPicture, LeavesOutWhatIsFreeOrExact) {
    const std::string text = drawn({{"ring_plain_f32", "0.5", "50", 0.25, 0.0},
                                    {"ring_plain_f32", "0.5", "600", 0x1p-7, 600.0},
                                    {"ring_plain_f32", "0.5", "full", 0.0, 700.0}});
    EXPECT_THAT(text, Not(HasSubstr("0.000000e+00")));
    EXPECT_THAT(text, HasSubstr("\n6.000000e+02 7.812500e-03\nEOD\n"));
}

// An order of which nothing is left has an empty place, and the key stands in the first panel that there is.
TEST_F(FrontsPicture, HasItsKeyInTheFirstPanelThatIsDrawn) {
    std::vector<Made> all = {{"ring_plain_f32", "0.3", "full", 0.0, 700.0}};
    for (const char* order : {"0.5", "0.7"}) {
        for (const Made& made : windows_and_modes(order)) {
            all.push_back(made);
        }
    }
    const std::string text = drawn(all);
    EXPECT_EQ(count_of(text, "set multiplot next\n"), 1U);
    EXPECT_EQ(count_of(text, "set label \"order 0.3\""), 0U);
    EXPECT_EQ(count_of(text, "keyentry "), 2U);  // before and after
    EXPECT_LT(text.find("keyentry "), text.find("set label \"order 0.7\""));
    EXPECT_EQ(count_of(text, "set key at"), 1U);
    EXPECT_EQ(count_of(text, "unset key"), 1U);
}

// Errors within one percent are the same: two kernels that cost the same are then both on the front.
TEST_F(FrontsPicture, OfOneCostShowsTheSmallestError) {
    const std::string text = drawn({{"modes_plain_f32", "0.5", "2+7", 1.005e-2, 60.0},
                                    {"modes_compensated_f32", "0.5", "2+7", 1e-2, 60.0},
                                    {"modes_plain_f32", "0.5", "2+11", 1e-3, 90.0}});
    EXPECT_THAT(text, HasSubstr("\n6.000000e+01 1.000000e-02\n9.000000e+01 1.000000e-03\nEOD\n"));
    EXPECT_THAT(text, Not(HasSubstr("1.005000e-02")));
}

// At 1e-2, 1e-4 and 1e-6 alone, and where both fronts reach.
TEST_F(FrontsPicture, HasAnArrowAndAFactorAtMarkedErrors) {
    const std::string text = drawn({{"ring_plain_f32", "0.5", "600", 5e-3, 950.0},
                                    {"ring_plain_f32", "0.5", "full", 1e-5, 5000.0},
                                    {"modes_plain_f32", "0.5", "2+7", 5e-3, 100.0},
                                    {"modes_plain_f32", "0.5", "2+11", 1e-5, 500.0},
                                    {"modes_plain_f32", "0.5", "2+15", 1e-7, 4000.0}});
    EXPECT_THAT(text, HasSubstr("set arrow from 9.500000e+02,1e-02 to 1.000000e+02,1e-02 head"));
    EXPECT_THAT(text, HasSubstr("set label \"9.5×\" at 9.500000e+02,1e-02 left"));
    EXPECT_THAT(text, HasSubstr("set arrow from 5.000000e+03,1e-04 to 5.000000e+02,1e-04 head"));
    EXPECT_THAT(text, HasSubstr("set label \"10×\" at 5.000000e+03,1e-04 left"));  // from ten on without decimals
    EXPECT_EQ(count_of(text, "set arrow from"), 2U);
    EXPECT_EQ(count_of(text, "×"), 2U);
    EXPECT_THAT(text, HasSubstr("errors below 1e-9 are not shown; arrows: how many times the cost, at errors of 1e-2, "
                                "1e-4, 1e-6\"\n"));
}

// Five, fifteen and twenty times at 1e-4; at 1e-2 twice as much at each order, which is not told.
TEST_F(FrontsPicture, SaysTheMedianOfTheFactorsAt1e4) {
    std::vector<Made> all;
    const auto add = [&](const std::string& order, double cycles) {
        all.push_back({"ring_plain_f32", order, "600", 5e-3, 200.0});
        all.push_back({"ring_plain_f32", order, "full", 1e-5, cycles});
        all.push_back({"modes_plain_f32", order, "2+11", 1e-5, 100.0});
    };
    const std::string beginning =
        "What the best window costs beside the best kernel at an error of 1e-4, median of the orders: ";
    add("0.3", 500.0);
    EXPECT_THAT(drawn(all), HasSubstr(beginning + "f746, modelled cycles per sample: 5.0 times\\n"));
    add("0.5", 1500.0);
    EXPECT_THAT(drawn(all), HasSubstr(beginning + "f746, modelled cycles per sample: 10 times\\n"));  // of two the mean
    add("0.7", 2000.0);
    EXPECT_THAT(drawn(all), HasSubstr(beginning + "f746, modelled cycles per sample: 15 times\\n"));
    // Without a window of that error there is nothing to tell.
    EXPECT_THAT(drawn({{"modes_plain_f32", "0.5", "2+11", 1e-5, 100.0}}), Not(HasSubstr("What the best window costs")));
}

TEST_F(FrontsPicture, ShowsTheFirst24Orders) {
    std::vector<Made> all;
    for (int i = 1; i <= 25; ++i) {
        all.push_back({"ring_plain_f32", "0." + std::to_string(i), "600", 5e-3, 600.0});
    }
    const std::string text = drawn(all);
    EXPECT_EQ(count_of(text, "set label \"order "), 24U);
    EXPECT_EQ(count_of(text, "set label \"order 0.24\""), 1U);
    EXPECT_EQ(count_of(text, "set label \"order 0.25\""), 0U);
    EXPECT_THAT(text, HasSubstr("set multiplot layout 8,3 "));
}

// Panels, the room between them and the key above them lie on the page; only the left panels name the error.
TEST_F(FrontsPicture, LiesOnItsPage) {
    for (const int orders : {1, 3, 5, 10}) {
        std::vector<Made> all;
        for (int i = 1; i <= orders; ++i) {
            all.push_back({"ring_plain_f32", "1." + std::to_string(i), "600", 5e-3, 600.0});
        }
        const std::string text = drawn(all);
        int rows = 0;
        int columns = 0;
        double key = 0.0, left = 0.0, right = 0.0, bottom = 0.0, top = 0.0, beside = 0.0, above = 0.0;
        const std::size_t at = text.find("key_at = ");
        ASSERT_NE(at, std::string::npos);
        ASSERT_EQ(std::sscanf(text.c_str() + at,
                              "key_at = %lf\nset multiplot layout %d,%d margins %lf,%lf,%lf,%lf spacing %lf,%lf", &key,
                              &rows, &columns, &left, &right, &bottom, &top, &beside, &above),
                  9);
        EXPECT_EQ(columns, std::min(orders, 3));
        EXPECT_EQ(rows, (orders + columns - 1) / columns);
        EXPECT_GT(bottom, 0.0);
        EXPECT_LT(top, key);
        EXPECT_LT(key, 1.0);
        EXPECT_GT(above, 0.0);
        EXPECT_GT(top - bottom, 2.0 * above * (rows - 1)) << orders;
        EXPECT_EQ(count_of(text, "set ylabel \"error / largest exact sum\""), static_cast<std::size_t>(rows));
        EXPECT_EQ(count_of(text, "unset ylabel"), static_cast<std::size_t>(orders - rows));
    }
}

}  // namespace
