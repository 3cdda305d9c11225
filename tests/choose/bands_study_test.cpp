// What cycles buy over a band: which filters are compared, by whose costs, what rows, table and picture say of them.
#include "bench/studies/bands.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/gnuplot.hpp"
#include "bench/choose/derivative_errors.hpp"
#include "tests/bench/pretend_gnuplot.hpp"
#include "tests/choose/costs_by.hpp"

namespace {

using bench::BandPoint;
using bench::BandStudy;
using glsum::design::Band;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr Band narrow{8, 80};
constexpr Band wide{0.8, 80};

BandPoint made(const char* way, double cycles, double error, double order = 0.5, Band band = narrow,
               const char* taps = "1+2") {
    return {way, taps, order, band, error, cycles, cycles + 3.0, 8.0 * cycles};
}

// Ten cycles a tap and as many more as the order has hundredths, a hundred for the cascade.
double cycles_of(const std::string& kernel, std::size_t taps, double order) {
    return 10.0 * static_cast<double>(taps) + 100.0 * order + (kernel.starts_with("cascade") ? 100.0 : 0.0) +
           (kernel.find("delta") != std::string::npos ? 1000.0 : 0.0);
}

// Three taps are not to be run.
std::unique_ptr<choose::CostSource> made_costs(const choose::CountedOrder& order) {
    EXPECT_TRUE(order.fitted);
    return std::make_unique<test::CostsBy>([order](const std::string& kernel, std::size_t taps) {
        const double cycles = cycles_of(kernel, taps, order.order);
        return choose::Cost{cycles, cycles + 1.0, 0.0, 4.0 * static_cast<double>(taps), taps == 3 ? "none" : ""};
    });
}

TEST(BandStudy, MeasuresEveryFilterAtItsOwnCosts) {
    BandStudy study;
    study.orders = {0.5, 1.5};
    study.bands = {narrow, wide};
    study.poles = {2};
    study.longest = 5;
    const auto points = bench::measure_bands(study, made_costs);
    std::set<std::pair<double, double>> cases;
    std::map<double, std::set<std::string>> ways;
    for (const BandPoint& point : points) {
        cases.insert({point.order, point.band.low_hz});
        ways[point.order].insert(point.way);
        const std::size_t taps = point.taps == "1+2" ? 5U : 4U;
        EXPECT_THAT(point.taps, testing::AnyOf("1+2", "2+1"));
        const bench::Rival* rival = bench::rival_of(point.way);
        const std::string kernel = rival == nullptr ? point.way
                                   : rival->cascade ? (point.order > 1.0 ? "cascadedelta_df2t_f32" : "cascade_df2t_f32")
                                                    : (point.order > 1.0 ? "modesdelta_plain_f32" : "modes_plain_f32");
        EXPECT_EQ(point.model_cycles, cycles_of(kernel, taps, point.order)) << point.way;
        EXPECT_EQ(point.model_cycles_high, point.model_cycles + 1.0);
        EXPECT_EQ(point.bytes, 4.0 * static_cast<double>(taps));
        if (rival == nullptr) {
            choose::DerivativeErrors errors({point.order, study.step_s, point.band, {}});
            EXPECT_EQ(point.error, errors.error(point.way, taps).error) << point.way;
        } else {
            // What others' rules are certified to in such a kernel.
            EXPECT_EQ(point.taps, "1+2");
            choose::DerivativeErrors errors({point.order, study.step_s, point.band, {}},
                                            rival->rule == glsum::design::RationalRule::oustaloup
                                                ? choose::FilterDesign::oustaloup
                                                : choose::FilterDesign::charef);
            EXPECT_NEAR(point.error, errors.error(kernel, 5).error, 1e-3 * point.error) << point.way;
        }
    }
    EXPECT_THAT(cases, ElementsAre(std::pair(0.5, 0.8), std::pair(0.5, 8.0), std::pair(1.5, 0.8), std::pair(1.5, 8.0)));
    for (const double order : study.orders) {
        EXPECT_THAT(ways[order],
                    ElementsAre("cascade_df2t_f32", "cascadedelta_df2t_f32", "charef_df2t_f32", "charef_f32",
                                "modes_plain_f32", "modesdelta_plain_f32", "oustaloup_df2t_f32", "oustaloup_f32"));
    }
    // Orders and bands come as they were asked for.
    EXPECT_EQ(points.front().order, 0.5);
    EXPECT_EQ(points.front().band, narrow);
    EXPECT_EQ(points.back().order, 1.5);
    EXPECT_EQ(points.back().band, wide);
}

TEST(BandStudy, LengthsBandsAndPolesAreThoseOfThePage) {
    const BandStudy study;
    EXPECT_EQ(study.longest, 20U);
    EXPECT_THAT(study.orders, ElementsAre(0.2, 0.5, 0.9, -0.5, -0.9, 1.5));
    EXPECT_THAT(study.bands, ElementsAre(Band{8, 80}, Band{0.8, 80}, Band{0.08, 80}, Band{0.008, 80}));
    EXPECT_THAT(study.poles, ElementsAre(2U, 3U, 4U, 5U, 6U, 7U, 8U));
    EXPECT_EQ(study.step_s, 0.001);
}

// Each of others' filters stands beside the best of ours within its cycles, of its own order and band.
std::vector<BandPoint> compared() {
    return {made("modes_plain_f32", 10.0, 0.01),     made("cascade_df2t_f32", 20.0, 0.001),
            made("modes_plain_f32", 1.0, 1e-6, 0.9), made("modes_plain_f32", 1.0, 1e-6, 0.5, wide),
            made("oustaloup_f32", 10.0, 0.02),       made("charef_f32", 25.0, 0.0005),
            made("charef_df2t_f32", 9.0, 0.25)};
}

TEST(BandStudy, ComparesWithinEqualCycles) {
    const auto found = bench::compare_bands(compared());
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].rival.way, "oustaloup_f32");
    EXPECT_EQ(found[0].ours.error, 0.01);  // as many cycles are enough
    EXPECT_DOUBLE_EQ(found[0].ratio(), 2.0);
    EXPECT_EQ(found[1].ours.way, "cascade_df2t_f32");
    EXPECT_DOUBLE_EQ(found[1].ratio(), 0.5);
    EXPECT_TRUE(std::isinf(found[2].ours.error));
    EXPECT_EQ(found[2].ratio(), 0.0);
    EXPECT_EQ(bench::rival_of("modes_plain_f32"), nullptr);
    EXPECT_STREQ(bench::rival_of("charef_df2t_f32")->way, "charef_df2t_f32");
}

TEST(BandStudy, HasARowForEachPoint) {
    const auto rows = bench::rows_of_bands({made("oustaloup_f32", 10.0, 0.02)});
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].at("name"), "band/oustaloup_f32/order:0.5/taps:1+2/hz:8..80");
    EXPECT_EQ(rows[0].at("iterations"), 1);
    EXPECT_EQ(rows[0].at("band_error"), 0.02);
    EXPECT_EQ(rows[0].at("model_cycles_per_sample"), 10.0);
    EXPECT_EQ(rows[0].at("model_cycles_high"), 13.0);
    EXPECT_EQ(rows[0].at("memory_bytes"), 80.0);
}

TEST(BandStudy, TableHasALineForEachFormOfBothFilters) {
    BandStudy study;
    study.orders = {0.5};
    study.bands = {narrow};
    study.poles = {2, 3};
    std::vector<BandPoint> points{
        made("modes_plain_f32", 10.0, 0.01), made("oustaloup_f32", 10.0, 0.02),
        made("charef_f32", 10.0, 0.05),      made("oustaloup_df2t_f32", 12.0, 0.04),
        made("charef_df2t_f32", 12.0, 0.03), made("oustaloup_f32", 9.0, 0.5, 0.5, narrow, "1+3")};
    const std::string table = bench::to_table(study, points);
    EXPECT_THAT(table, HasSubstr("\nOrder 0.5\n"));
    EXPECT_THAT(table, ContainsRegex("8..80 +2  parallel +10.0 +80 +2 % +5 % +1 %  modes_plain_f32 1.2 +80 +2.0\n"));
    EXPECT_THAT(table, ContainsRegex("8..80 +2  cascade +12.0 +96 +4 % +3 % +1 %  modes_plain_f32 1.2 +80 +3.0\n"));
    EXPECT_THAT(table, Not(ContainsRegex("8..80 +3 ")));  // only one of both is there
    // Of 0, 2, 3, 4 and 5.
    EXPECT_THAT(table,
                HasSubstr("Of 5 comparisons at equal cycles the fitted filter errs more in 1; the other's error is "
                          "0 to 5 times its own, 3 times in the median."));
    EXPECT_THAT(bench::to_table(study, {}), Not(HasSubstr("comparisons")));
}

// A cycle a tap, and a hundred over increments.
std::vector<BandPoint> measured_plainly(double order, std::size_t longest) {
    BandStudy study;
    study.orders = {order};
    study.bands = {narrow};
    study.poles = {2};
    study.longest = longest;
    return bench::measure_bands(study, [](const choose::CountedOrder&) {
        return std::make_unique<test::CostsBy>([](const std::string& kernel, std::size_t taps) {
            const double more = kernel.find("delta") != std::string::npos ? 100.0 : 0.0;
            return choose::Cost{static_cast<double>(taps) + more, 0.0, 0.0, 0.0, ""};
        });
    });
}

// One near tap and one mode are three coefficients, of an order near 1, too.
TEST(BandStudy, BeginsWithOneMode) {
    const auto points = measured_plainly(0.9, 3);
    EXPECT_TRUE(std::ranges::any_of(points, [](const BandPoint& point) {
        return point.way == "modes_plain_f32" && point.taps == "1+1" && point.model_cycles == 3.0;
    }));
    EXPECT_TRUE(std::ranges::none_of(
        points, [](const BandPoint& point) { return bench::rival_of(point.way) == nullptr && point.taps != "1+1"; }));
}

// From just above order 1 on the filters of others have a difference before them.
TEST(BandStudy, OthersFiltersStandOverIncrementsAboveOne) {
    for (const double order : {0.9921875, 1.0078125}) {
        const auto points = measured_plainly(order, 2);
        EXPECT_FALSE(points.empty()) << order;
        for (const BandPoint& point : points) {
            EXPECT_EQ(point.model_cycles, order > 1.0 ? 105.0 : 5.0) << point.way;
        }
    }
}

// A filter that errs as much is not behind: of the ratios 1, 1.0078125 and 0.99609375 the last alone is.
TEST(BandStudy, AsMuchErrorIsNotMore) {
    BandStudy study;
    study.orders = {0.5};
    study.bands = {narrow};
    const std::vector<BandPoint> points{made("modes_plain_f32", 10.0, 0.5), made("modesdelta_plain_f32", 9.0, 0.5),
                                        made("oustaloup_f32", 10.0, 0.5), made("charef_f32", 10.0, 0.50390625),
                                        made("charef_df2t_f32", 10.0, 0.498046875)};
    EXPECT_THAT(bench::to_table(study, points),
                HasSubstr("Of 3 comparisons at equal cycles the fitted filter errs more in 1; the other's error is "
                          "0.996 to 1.01 times its own, 1 times in the median."));
}

class BandPlot : public PretendGnuplot {};

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) {
        ++count;
    }
    return count;
}

// A panel for each order and band, and in it a front of each of both others and of ours.
TEST_F(BandPlot, ShowsWhatNoOtherOfItsSeriesBetters) {
    BandStudy study;
    study.orders = {0.5, 0.9};
    study.bands = {narrow};
    const std::vector<BandPoint> points{made("modes_plain_f32", 20.0, 0.001), made("modes_plain_f32", 10.0, 0.01),
                                        made("cascade_df2t_f32", 10.0, 0.02),  // as dear and worse
                                        made("cascade_df2t_f32", 15.0, 0.01),  // dearer and no better
                                        made("oustaloup_f32", 12.0, 0.04),    made("oustaloup_df2t_f32", 11.0, 0.05),
                                        made("charef_f32", 40.0, 0.002)};
    bench::plot_bands(study, points, stem());
    const std::string script = sent();
    EXPECT_THAT(script,
                HasSubstr("$d0 << EOD\n11 5.000000e+00\n12 4.000000e+00\nEOD\n$d1 << EOD\n40 2.000000e-01\nEOD\n"
                          "$d2 << EOD\n10 1.000000e+00\n20 1.000000e-01\nEOD\n"));
    EXPECT_THAT(script, HasSubstr("$d0 << EOD\n0 NaN\nEOD\n"));  // of order 0.9
    EXPECT_THAT(script, HasSubstr("set title \"order 0.5, 8 to 80 Hz\""));
    EXPECT_THAT(script, HasSubstr("set title \"order 0.9, 8 to 80 Hz\""));
    EXPECT_THAT(script, HasSubstr("set multiplot layout 2,1 "));
    EXPECT_THAT(script, HasSubstr(" size 410,590 "));  // panels of 290 by 220 pixels
    EXPECT_THAT(script, HasSubstr("set xrange [0:42]"));
    // Panels lie within the picture, above each other, with room for what is written beside them.
    double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0, beside = 0.0, between = 0.0;
    ASSERT_EQ(std::sscanf(script.c_str() + script.find(" margins "), " margins %lf,%lf,%lf,%lf spacing %lf,%lf", &left,
                          &right, &bottom, &top, &beside, &between),
              6);
    const double width = 410.0 * (right - left);
    const double height = 590.0 * (top - bottom - between) / 2.0;
    EXPECT_TRUE(width > 220.0 && width < 310.0) << width;
    EXPECT_TRUE(height > 150.0 && height < 220.0) << height;
    EXPECT_GT(410.0 * left, 50.0);
    EXPECT_GT(410.0 * beside, 50.0);
    EXPECT_LT(right, 1.0);
    EXPECT_GT(590.0 * bottom, 30.0);
    EXPECT_GT(590.0 * between, 30.0);
    EXPECT_GT(590.0 * (1.0 - top), 60.0);
    double low = 0.0;
    double high = 0.0;
    ASSERT_EQ(std::sscanf(script.c_str() + script.find("set yrange"), "set yrange [%lf:%lf]", &low, &high), 2);
    EXPECT_LT(low, 0.1);
    EXPECT_GT(low, 0.01);
    EXPECT_GT(high, 5.0);
    EXPECT_LT(high, 50.0);
    // Titles stand once, and what is drawn is told apart.
    EXPECT_EQ(count_of(script, "title \"Oustaloup, tuned\""), 1U);
    EXPECT_EQ(count_of(script, "title \"Charef, tuned\""), 1U);
    EXPECT_EQ(count_of(script, "title \"fitted, as the kernel holds it\""), 1U);
    EXPECT_EQ(count_of(script, "modelled cycles a sample\""), 1U);
    std::set<std::string> colours;
    for (std::size_t at = script.find("lc rgb \"", script.find("plot $d0")); at != std::string::npos;
         at = script.find("lc rgb \"", at + 1)) {
        colours.insert(script.substr(at + 8, 7));
    }
    EXPECT_EQ(colours.size(), 3U);
    // Of the ratios 4, 5 and 2.
    EXPECT_THAT(script,
                HasSubstr("Of 3 comparisons at equal cycles the fitted filter errs more in 0; in the median the "
                          "others err 4 times as much"));
}

// Of the ratios 0.99609375, 1, 1.0078125, 2 and 4.
TEST_F(BandPlot, SaysWhoErrsMoreAsTheTableDoes) {
    BandStudy study;
    study.orders = {0.5};
    study.bands = {narrow};
    bench::plot_bands(study,
                      {made("modes_plain_f32", 10.0, 0.5), made("oustaloup_f32", 10.0, 0.5),
                       made("oustaloup_df2t_f32", 10.0, 1.0), made("charef_f32", 10.0, 0.50390625),
                       made("charef_df2t_f32", 10.0, 0.498046875), made("charef_df2t_f32", 12.0, 2.0)},
                      stem());
    const std::string script = sent();
    EXPECT_THAT(script, HasSubstr("Of 5 comparisons at equal cycles the fitted filter errs more in 1; in the median "
                                  "the others err 1.01 times as much"));
    // Drawn are the fronts alone.
    EXPECT_THAT(script, HasSubstr("set yrange " + base::log_range(49.8046875, 50.0)));
    bench::plot_bands(study, {made("modes_plain_f32", 10.0, 0.5)}, stem());
    EXPECT_THAT(sent(), Not(HasSubstr("comparisons")));
}

// Room beside the panels takes as many pixels however many there are; the key stands above the uppermost.
TEST_F(BandPlot, MarginsDoNotGrowWithThePanels) {
    struct Margins {
        double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0, across = 0.0, down = 0.0, width = 0.0, height = 0.0;
    };
    const auto margins_of = [&](const std::vector<double>& orders, const std::vector<Band>& bands) {
        BandStudy study;
        study.orders = orders;
        study.bands = bands;
        bench::plot_bands(study, {}, stem());
        const std::string script = sent();
        Margins found;
        EXPECT_EQ(std::sscanf(script.c_str() + script.find(" size "), " size %lf,%lf", &found.width, &found.height), 2);
        EXPECT_EQ(std::sscanf(script.c_str() + script.find(" margins "), " margins %lf,%lf,%lf,%lf spacing %lf,%lf",
                              &found.left, &found.right, &found.bottom, &found.top, &found.across, &found.down),
                  6);
        double x = 0.0;
        double y = 0.0;
        EXPECT_EQ(std::sscanf(script.c_str() + script.find("set key horizontal at "),
                              "set key horizontal at screen %lf, screen %lf", &x, &y),
                  2);
        EXPECT_EQ(x, 0.5);
        EXPECT_GT(y, found.top);
        EXPECT_LT(y, 1.0);
        return found;
    };
    const Margins few = margins_of({0.5}, {narrow});
    const Margins many = margins_of({0.1, 0.3, 0.5, 0.7}, {narrow, wide, narrow, wide});
    const auto same = [](double one, double other) {
        EXPECT_GT(one, 10.0);
        EXPECT_NEAR(one, other, 0.2);  // the shares have four digits
    };
    same(few.left * few.width, many.left * many.width);
    same((1.0 - few.right) * few.width, (1.0 - many.right) * many.width);
    same(few.bottom * few.height, many.bottom * many.height);
    same((1.0 - few.top) * few.height, (1.0 - many.top) * many.height);
    same(few.across * few.width, many.across * many.width);
    same(few.down * few.height, many.down * many.height);
}

}  // namespace
