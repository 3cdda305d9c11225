// Plots of logs whose stamps do not begin at 0: what is drawn, and shaded, lies where it lies from their first stamp
// on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "gap/verdict/plot.hpp"

namespace {

std::vector<double> times_from(double first_s) {
    std::vector<double> all;
    for (int i = 0; i <= 240; ++i) {
        all.push_back(first_s + 0.5 * i);
    }
    return all;
}

// 1 in the first tenth of the time and in the last twentieth, 0 between.
std::vector<double> at_both_ends() {
    std::vector<double> values(241, 0.0);
    std::fill_n(values.begin(), 24, 1.0);
    std::fill(values.end() - 13, values.end(), 1.0);
    return values;
}

TEST(PlotTimes, ShadesCountFromTheFirstStamp) {
    for (const double first_s : {0.0, 1000.0, -75.0}) {
        const std::vector<double> shade = gap::shade_of(at_both_ends(), times_from(first_s));
        ASSERT_EQ(shade.size(), 60U);
        for (std::size_t part = 0; part < 60; ++part) {
            // Four samples a part; the last has the last stamp, too.
            EXPECT_NEAR(shade[part],
                        part < 6 || (part > 56 && part < 59) ? 0.8
                        : part == 59                         ? 1.0
                                                             : 0.0,
                        1e-12)
                << first_s << " " << part;
        }
    }
}

// Where something lies across the picture: what stands between two marks, over all of them.
std::vector<std::string> all_between(const std::string& text, const std::string& from, const std::string& to) {
    std::vector<std::string> found;
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
        at += from.size();
        found.push_back(text.substr(at, text.find(to, at) - at));
    }
    return found;
}

TEST(PlotTimes, LinesAndShadesLieAsFromZero) {
    const gap::PlotOf plot{"left", 300.0, {{"line", at_both_ends()}}, std::vector<double>{0.0, 0.5, 1.0}};
    const std::string from_zero = gap::to_svg(plot, times_from(0.0));
    ASSERT_EQ(all_between(from_zero, "points=\"", "\"").size(), 2U);  // of a screen and of a phone
    ASSERT_EQ(all_between(from_zero, "<rect ", "/>").size(), 4U);
    for (const double first_s : {1000.0, -75.0}) {
        const std::string later = gap::to_svg(plot, times_from(first_s));
        EXPECT_EQ(all_between(later, "points=\"", "\""), all_between(from_zero, "points=\"", "\""));
        EXPECT_EQ(all_between(later, "<rect ", "/>"), all_between(from_zero, "<rect ", "/>"));
        EXPECT_THAT(later, testing::HasSubstr(first_s > 0.0 ? ">1100<" : ">-50<"));  // as the stamps are
    }
}

// Round steps: 0.2 here. A tick stands at the end of what is drawn, too, where that is a billionth of a step below it.
TEST(PlotTicks, ReachTheEndToABillionthOfAStep) {
    const auto has_one = [](double below) {
        std::vector<double> values = at_both_ends();
        std::replace(values.begin(), values.end(), 1.0, 1.0 - below * 0.2e-9);
        const std::string svg = gap::to_svg({"left", 300.0, {{"line", values}}}, times_from(0.0));
        EXPECT_THAT(svg, testing::HasSubstr(">0.8</text>"));
        EXPECT_THAT(svg, testing::Not(testing::HasSubstr(">0.9</text>")));
        return svg.find(">1</text>") != std::string::npos;
    };
    EXPECT_TRUE(has_one(0.0));
    EXPECT_TRUE(has_one(0.995));
    EXPECT_FALSE(has_one(1.005));
}

// Six steps, two below 150 px.
TEST(PlotTicks, AreFewerWhereItIsLow) {
    const auto on_screen = [](double height) {
        const std::string svg = gap::to_svg({"left", height, {{"line", at_both_ends()}}}, times_from(0.0));
        return svg.substr(0, svg.find("phone"));
    };
    EXPECT_THAT(on_screen(150.0), testing::HasSubstr(">0.8</text>"));
    EXPECT_THAT(on_screen(149.9), testing::Not(testing::HasSubstr(">0.8</text>")));
    EXPECT_THAT(on_screen(149.9), testing::HasSubstr(">0.5</text>"));
}

// Of the time six steps, three on a phone: round ones of at least a sixth of it, or a third.
TEST(PlotTicks, AreFewerWhereItIsNarrow) {
    const auto of = [](double length_s) {
        const std::string svg = gap::to_svg({"left", 300.0, {{"line", {0.0, 1.0}}}}, {0.0, length_s});
        const std::size_t phone = svg.find("phone");
        const auto along = [](const std::string& drawn) {
            return all_between(drawn, "text-anchor=\"middle\">", "</text>");
        };
        return std::pair(along(svg.substr(0, phone)), along(svg.substr(phone)));
    };
    using testing::ElementsAre;
    EXPECT_THAT(of(5.99).first, ElementsAre("0 s", "1", "2", "3", "4", "5"));
    EXPECT_THAT(of(6.03).first, ElementsAre("0 s", "2", "4"));
    EXPECT_THAT(of(5.99).second, ElementsAre("0 s", "2", "4"));
    EXPECT_THAT(of(6.03).second, ElementsAre("0 s", "5"));
}

// As high as asked for 1100 px across; on a phone 400 across and three fifths as high, 110 at least.
TEST(PlotSizes, AreThoseOfAScreenAndOfAPhone) {
    const auto boxes = [](double height) {
        return all_between(gap::to_svg({"left", height, {{"line", at_both_ends()}}}, times_from(0.0)), "viewBox=\"",
                           "\"");
    };
    using testing::ElementsAre;
    EXPECT_THAT(boxes(300.0), ElementsAre("0 0 1100 300", "0 0 400 180"));
    EXPECT_THAT(boxes(190.0), ElementsAre("0 0 1100 190", "0 0 400 114"));
    EXPECT_THAT(boxes(180.0), ElementsAre("0 0 1100 180", "0 0 400 110"));
    EXPECT_THAT(boxes(110.0), ElementsAre("0 0 1100 110", "0 0 400 110"));
}

}  // namespace
