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

// 1026 px of time between margins of 64 and 10, 200 px of output between 8 and 34: here 1026 s from -14 s on, -1 to 4.
TEST(PlotAxes, StandWhereTheirFormulaeSay) {
    const gap::PlotOf plot{"left", 242.0, {{"line", {-1.0, 4.0}}}};
    const std::string svg = gap::to_svg(plot, {-14.0, 1012.0});
    const std::string screen = svg.substr(0, svg.find("phone"));
    using testing::ElementsAre;
    EXPECT_THAT(all_between(screen, "class=\"grid\" d=\"", "\"/>"),
                ElementsAre("M64.0 208.0H1090.0", "M64.0 168.0H1090.0", "M64.0 128.0H1090.0", "M64.0 88.0H1090.0",
                            "M64.0 48.0H1090.0", "M64.0 8.0H1090.0"));
    // Left of the grid by 6 and a line of text's half below it; below the drawing by 16. A zero has no sign. At 12 px
    // from the end of the drawing half a label still finds room.
    EXPECT_THAT(
        all_between(screen, "<text ", "</text>"),
        ElementsAre(
            "x=\"58.0\" y=\"212.0\" text-anchor=\"end\">-1", "x=\"58.0\" y=\"172.0\" text-anchor=\"end\">0",
            "x=\"58.0\" y=\"132.0\" text-anchor=\"end\">1", "x=\"58.0\" y=\"92.0\" text-anchor=\"end\">2",
            "x=\"58.0\" y=\"52.0\" text-anchor=\"end\">3", "x=\"58.0\" y=\"12.0\" text-anchor=\"end\">4",
            "x=\"78.0\" y=\"224.0\" text-anchor=\"middle\">0 s", "x=\"278.0\" y=\"224.0\" text-anchor=\"middle\">200",
            "x=\"478.0\" y=\"224.0\" text-anchor=\"middle\">400", "x=\"678.0\" y=\"224.0\" text-anchor=\"middle\">600",
            "x=\"878.0\" y=\"224.0\" text-anchor=\"middle\">800",
            "x=\"1078.0\" y=\"224.0\" text-anchor=\"middle\">1000"));
    EXPECT_THAT(gap::to_svg(plot, {-14.1, 1011.9}),
                testing::HasSubstr("x=\"1100.0\" y=\"224.0\" text-anchor=\"end\">1000"));
    // Between -0.5 and 4.5, too, zero has none.
    EXPECT_THAT(gap::to_svg({"left", 242.0, {{"line", {-0.5, 4.5}}}}, {0.0, 1.0}),
                testing::AllOf(testing::HasSubstr(">0</text>"), testing::Not(testing::HasSubstr(">-0<"))));
    // What never moves lies at the bottom of a span of 1.
    const std::string flat = gap::to_svg({"left", 242.0, {{"line", {3.0, 3.0}}}}, {0.0, 1.0});
    EXPECT_THAT(all_between(flat.substr(0, flat.find("phone")), "class=\"grid\" d=\"M64.0 ", "H"),
                ElementsAre("208.0", "168.0", "128.0", "88.0", "48.0", "8.0"));
}

// Steps of the output are round ones of at least a sixth of it, a half where it is low.
TEST(PlotAxes, HaveStepsOfASixthOrAHalf) {
    const auto marks = [](double height, double most) {
        const std::string svg = gap::to_svg({"left", height, {{"line", {0.0, most}}}}, {0.0, 1.1});
        return all_between(svg.substr(0, svg.find("phone")), "text-anchor=\"end\">", "</text>");
    };
    using testing::ElementsAre;
    EXPECT_THAT(marks(300.0, 5.97), ElementsAre("0", "1", "2", "3", "4", "5"));
    EXPECT_THAT(marks(300.0, 6.03), ElementsAre("0", "2", "4", "6"));
    EXPECT_THAT(marks(120.0, 1.99), ElementsAre("0", "1"));
    EXPECT_THAT(marks(120.0, 2.01), ElementsAre("0", "2"));
}

// A part of the time is as dark as its share, 0.3 for the whole; below 0.01 it is left out.
TEST(PlotShades, AreAsWideAsTheirPartsAndAsDarkAsTheirShares) {
    const auto rects = [](std::vector<double> shade) {
        const std::string svg = gap::to_svg({"left", 242.0, {{"line", {0.0, 1.0}}}, std::move(shade)}, {7.0, 9.0});
        return all_between(svg.substr(0, svg.find("phone")), "<rect class=\"shade\" ", "/>");
    };
    using testing::ElementsAre;
    const std::string first = "x=\"64.0\" y=\"8.0\" width=\"342.0\" height=\"200.0\" opacity=";
    const std::string last = "x=\"748.0\" y=\"8.0\" width=\"342.0\" height=\"200.0\" opacity=";
    EXPECT_THAT(rects({0.5, 0.0, 1.0}), ElementsAre(first + "\"0.15\"", last + "\"0.30\""));
    EXPECT_THAT(rects({0.9837, 0.0, 0.0}), ElementsAre(first + "\"0.30\""));
    EXPECT_THAT(rects({0.9831, 0.0, 0.0}), ElementsAre(first + "\"0.29\""));
    EXPECT_THAT(rects({0.01 / 0.3 * 1.005, 0.0, 0.01 / 0.3 * 0.995}), ElementsAre(first + "\"0.01\""));
}

// What lasts no time lies in its first part.
TEST(PlotShades, OfOneStampAreInTheFirstPart) {
    std::vector<double> wanted(60, 0.0);
    wanted.front() = 1.0;
    EXPECT_EQ(gap::shade_of({2.0}, {5.0}), wanted);
}

}  // namespace
