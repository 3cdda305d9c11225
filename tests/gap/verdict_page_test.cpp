// A verdict's page: which of its lines stand for what.
#include "gap/verdict/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "gap/verdict/plot.hpp"
#include "tests/count_of.hpp"
#include "tests/gap/verdict_case.hpp"

namespace {

using test::count_of;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using verdict_test::backlash;
using verdict_test::of_drive;
using verdict_test::verdict_of;

gap::Verdict verdict() {
    return {gap::Outcome::unknown, {"simulation", 0.5, 0.1, 0.05}, {{"none", 0.5, 0.0}}, gap::OfDrive{}, "rest", {}};
}

// What a simulation leaves is taken off from its first sample on, of what was chosen as of the base.
TEST(VerdictPage, DrawsWhatTheChosenLeaves) {
    gap::OfDrive of{};
    of.chosen = "backlash";
    const gap::Curve curve{"ramp.csv", {0.0, 1.0, 2.0}, {0.0, 0.5, 1.0}, {-1.0, 0.0, 1.0}, {0.5, 0.0, -0.5}};
    const std::string page = gap::to_html(verdict(), of, {{curve}});
    // From -0.5 to 1.5 on 288 px: 1 to 0 by the base, -0.5 to 1.5 by the chosen; of what they leave -1 to 1 on 128 px.
    EXPECT_THAT(page, AllOf(HasSubstr("<polyline class=\"base\" points=\"64.0,80.0 577.0,152.0 1090.0,224.0 \"/>"),
                            HasSubstr("<polyline class=\"after\" points=\"64.0,296.0 577.0,152.0 1090.0,8.0 \"/>"),
                            HasSubstr("<polyline class=\"base\" points=\"64.0,136.0 577.0,72.0 1090.0,8.0 \"/>"),
                            HasSubstr("<polyline class=\"after\" points=\"64.0,40.0 577.0,72.0 1090.0,104.0 \"/>")));
}

// The first two simulations of the next record in the colours of what helps and of the base, which is dashed; further
// ones dim.
TEST(VerdictPage, KeysTheNextRecordsLines) {
    gap::OfDrive of{};
    of.chosen = "none";
    const gap::NextRecord next{
        "step", {0.0, 1.0}, {0.0, 1.0}, {{"a", {0.0, 1.0}}, {"b", {0.0, 1.0}}, {"c", {0.0, 1.0}}, {"d", {0.0, 1.0}}}};
    const std::string page = gap::to_html(verdict(), of, {{}, next});
    EXPECT_THAT(
        page,
        AllOf(HasSubstr("<p class=\"key\"><span style=\"color:var(--measured)\"><i></i>measured</span>"
                        "<span style=\"color:var(--base)\"><i style=\"border-top-style:dashed\"></i>base</span></p>"),
              HasSubstr("<p class=\"key\"><span style=\"color:var(--after)\"><i></i>a</span>"
                        "<span style=\"color:var(--base)\"><i style=\"border-top-style:dashed\"></i>b</span>"
                        "<span style=\"color:var(--dim)\"><i></i>c</span>"
                        "<span style=\"color:var(--dim)\"><i></i>d</span></p>")));
    EXPECT_EQ(count_of(page, "<polyline class=\"after\""), 2U);  // on a screen and on a phone
    EXPECT_EQ(count_of(page, "<polyline class=\"base\""), 2U);
    EXPECT_EQ(count_of(page, "<polyline class=\"other\""), 4U);
}

gap::Curve ramp(std::size_t samples) {
    gap::Curve curve{"r<a>mp.csv", {}, {}, {}, {}};
    for (std::size_t i = 0; i < samples; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(samples - 1);
        curve.time_s.push_back(10.0 * share);
        curve.measured.push_back(share);
        curve.left_by_base.push_back(0.25 * share);
    }
    return curve;
}

TEST(VerdictPage, DrawsWhatWasMeasuredAndSimulated) {
    gap::OfDrive of = of_drive();
    of.chosen = "none";
    const gap::Verdict verdict = verdict_of(of);
    const std::string page = gap::to_html(verdict, of, {{ramp(5)}});
    // From 64 to 1090 along, from 8 for the highest to 296 for the lowest.
    EXPECT_THAT(
        page,
        HasSubstr(
            "<polyline class=\"measured\" points=\"64.0,296.0 320.5,224.0 577.0,152.0 833.5,80.0 1090.0,8.0 \"/>"));
    EXPECT_THAT(
        page,
        HasSubstr("<polyline class=\"base\" points=\"64.0,296.0 320.5,242.0 577.0,188.0 833.5,134.0 1090.0,80.0 \"/>"));
    EXPECT_THAT(
        page,
        HasSubstr("<polyline class=\"base\" points=\"64.0,136.0 320.5,104.0 577.0,72.0 833.5,40.0 1090.0,8.0 \"/>"));
    EXPECT_THAT(page, AllOf(HasSubstr("output, r&lt;a&gt;mp.csv"), Not(HasSubstr("class=\"after\"")),
                            Not(HasSubstr("base + "))));
    // Marks of 0 to 1 by fifths, of 0 to 0.25 by twentieths, of 10 s by 2 s; the first says in what.
    for (const char* mark :
         {">0</text>", ">0.2</text>", ">0.8</text>", ">1</text>", ">0 s</text>", ">2</text>", ">10</text>"}) {
        EXPECT_THAT(page, HasSubstr(mark)) << mark;
    }
    EXPECT_THAT(page, AllOf(HasSubstr(">0.15</text>"), Not(HasSubstr(">0.3</text>"))));
    EXPECT_EQ(count_of(page, "<svg class=\"screen\""), 2U);
    EXPECT_EQ(count_of(page, "<svg class=\"phone\""), 2U);
}

// Of a residual that grows like t: the integral of t^2 over each part.
TEST(VerdictPage, ShadesWhereTheSquaresLie) {
    const gap::Curve curve = ramp(6001);
    const std::vector<double> shade = gap::shade_of(curve.left_by_base, curve.time_s);
    ASSERT_EQ(shade.size(), 60U);
    for (std::size_t i = 0; i < 60; ++i) {
        // The integral of t^2 over a part, over that of the last part.
        const auto cube = [](double k) { return k * k * k; };
        const auto k = static_cast<double>(i);
        EXPECT_NEAR(shade[i], (cube(k + 1) - cube(k)) / (cube(60) - cube(59)), 0.012) << i;
    }
    EXPECT_EQ(gap::shade_of({0.0, std::nan(""), 0.0}, {0.0, 1.0, 2.0}), std::vector<double>(60, 0.0));
    gap::OfDrive of = of_drive();
    const std::string page = gap::to_html(verdict_of(of), of, {{curve}});
    EXPECT_THAT(page, HasSubstr("height=\"288.0\" opacity=\"0.30\""));
    EXPECT_THAT(page, Not(HasSubstr("opacity=\"0.00\"")));
}

TEST(VerdictPage, DrawsTheInputAndTheNextRecordInSteps) {
    gap::OfDrive of = of_drive();
    gap::Curve curve = ramp(5);
    curve.input = {0.0, 0.0, 1.0, 1.0, 0.0};
    gap::NextRecord next{"a <step>",
                         {0.0, 1.0, 2.0},
                         {0.0, 1.0, 1.0},
                         {{"backlash", {0.0, 0.5, 1.0}}, {"rate_limit, refitted", {0.0, 0.0, 1.0}}}};
    const std::string page = gap::to_html(verdict_of(of), of, {{curve}, next, "glsum diagnose drive --log <x>"});
    EXPECT_THAT(page,
                HasSubstr("<polyline class=\"input\" points=\"64.0,86.0 320.5,86.0 577.0,86.0 577.0,8.0 833.5,8.0 "
                          "1090.0,8.0 1090.0,86.0 \"/>"));
    EXPECT_THAT(page, HasSubstr("<polyline class=\"input\" points=\"64.0,86.0 577.0,86.0 577.0,8.0 1090.0,8.0 \"/>"));
    EXPECT_THAT(page, HasSubstr("<polyline class=\"after\" points=\"64.0,186.0 577.0,97.0 1090.0,8.0 \"/>"));
    EXPECT_THAT(page, HasSubstr("<polyline class=\"base\" points=\"64.0,186.0 577.0,186.0 1090.0,8.0 \"/>"));
    EXPECT_THAT(page, HasSubstr("output, simulated: a &lt;step&gt;"));
    EXPECT_THAT(page, AllOf(HasSubstr("</i>backlash</span>"), HasSubstr("</i>rate_limit, refitted</span>")));
    EXPECT_THAT(page, HasSubstr("<code>glsum diagnose drive --log &lt;x&gt;</code>"));
    EXPECT_EQ(count_of(page, "<svg class=\"screen\""), 5U);
    EXPECT_THAT(gap::to_html(verdict_of(of), of, {}), Not(HasSubstr("<svg")));
}

TEST(VerdictPage, LeavesOutWhatIsNoNumberAndThinsWhatIsLong) {
    gap::OfDrive of = of_drive();
    gap::Curve curve = ramp(5);
    curve.left_by_chosen = {0.0, std::nan(""), 0.0, 0.0, 0.0};
    std::string page = gap::to_html(verdict_of(of), of, {{curve}});
    EXPECT_THAT(page,
                HasSubstr("<polyline class=\"after\" points=\"64.0,296.0 577.0,152.0 833.5,80.0 1090.0,8.0 \"/>"));
    EXPECT_THAT(page, HasSubstr("base + backlash"));
    // Of 4400 samples every second one.
    page = gap::to_html(verdict_of(of), of, {{ramp(4400)}});
    const std::size_t from = page.find("class=\"measured\" points=\"");
    EXPECT_EQ(count_of(page.substr(from, page.find("\"/>", from) - from), ","), 2200U);
    page = gap::to_html(verdict_of(of), of, {{ramp(4399)}});
    EXPECT_EQ(count_of(page.substr(from, page.find("\"/>", from) - from), ","), 4399U);
    // What never moves is drawn with a span of 1.
    gap::Curve flat = ramp(5);
    flat.measured.assign(5, 3.0);
    flat.left_by_base.assign(5, 0.0);
    EXPECT_THAT(gap::to_html(verdict_of(of), of, {{flat}}),
                HasSubstr("<polyline class=\"measured\" points=\"64.0,296.0 "));
}

TEST(VerdictPage, ListsFourteenCandidatesAndNoneWithTheirBars) {
    gap::OfDrive of = of_drive();
    of.where.rising = 0.625;
    gap::Verdict verdict = verdict_of(of);
    verdict.ranking.clear();
    for (int i = 1; i <= 16; ++i) {
        verdict.ranking.push_back({i == 2 ? "backlash" : "effect-" + std::to_string(i), 0.05 * i, 100.0 - i});
    }
    verdict.ranking.push_back({"none", 0.5, 40.0});
    const std::string page = gap::to_html(verdict, of, {});
    EXPECT_THAT(page, AllOf(HasSubstr("effect-14<"), Not(HasSubstr("effect-15<")), HasSubstr("<td>none</td>")));
    EXPECT_THAT(page,
                HasSubstr("<td>backlash</td><td><span class=\"track\"><span class=\"bar2\" style=\"width:20.0%\">"));
    EXPECT_THAT(
        page,
        HasSubstr(
            "<td>effect-1</td><td><span class=\"track\"><span class=\"bar\" style=\"width:10.0%\"></span></span></td>"
            "<td class=\"n\">0.0500</td><td class=\"n\">59.0</td>"));
    EXPECT_THAT(
        page,
        HasSubstr(
            "<td>effect-14</td><td><span class=\"track\"><span class=\"bar\" style=\"width:100.0%\">"));  // no wider
    EXPECT_THAT(page, AllOf(HasSubstr("style=\"width:62.5%\"></span></span></td><td class=\"n\">62.5 %</td>"),
                            HasSubstr("<td class=\"n\">30.0 %</td>"), HasSubstr("<td class=\"n\">20.0 %</td>"),
                            HasSubstr("<td>0 to 2 s</td>"), HasSubstr("<td class=\"n\">95.0 %</td><td>start</td>")));
    verdict.gap.base = 0.0;
    EXPECT_THAT(gap::to_html(verdict, of, {}),
                HasSubstr("<td>effect-14</td><td><span class=\"track\"><span class=\"bar\" style=\"width:0.0%\">"));
}

TEST(VerdictPage, SaysWhatTheTextSays) {
    gap::OfDrive of = of_drive();
    of.alternatives = {{backlash()}, {backlash()}};
    of.extrapolated = {"input above <1>"};
    of.split = true;
    gap::Verdict verdict = verdict_of(of);
    verdict.notes = {"a \"note\" & more"};
    const std::string page = gap::to_html(verdict, of, {});
    EXPECT_THAT(
        page, AllOf(HasSubstr("<h1>attributed: backlash or backlash</h1>"),
                    HasSubstr("confidence 0.88; gap (simulation) 0.5000 before, 0.1000 after, 0.0500 at best"),
                    HasSubstr("Extrapolated, as training has none of it: input above &lt;1&gt;."),
                    HasSubstr("Judged by parts"), HasSubstr("Note: a &quot;note&quot; &amp; more."),
                    HasSubstr("<p>base: second_order"), HasSubstr("<ul><li>backlash.gap = 0.25  [0.2, 0.3]</li></ul>"),
                    HasSubstr("<h2>Next</h2><p>rest.</p>")));
    of.extrapolated.clear();
    of.split = false;
    EXPECT_THAT(gap::to_html(verdict, of, {}),
                AllOf(Not(HasSubstr("Extrapolated")), Not(HasSubstr("Judged by parts"))));
}

// A label at the picture's right edge ends there: in the middle of its tick, half of it would be cut off.
TEST(VerdictPage, TheLastTimeIsNotCutOff) {
    const gap::PlotOf plot{"output", 300.0, {{"measured", {0.0, 1.0, 2.0}}}};
    const std::string to_a_tick = gap::to_svg(plot, {0.0, 3000.0, 6000.0});
    EXPECT_EQ(count_of(to_a_tick, "text-anchor=\"end\">6000<"), 2U);  // on a screen and on a phone
    EXPECT_THAT(to_a_tick, HasSubstr("text-anchor=\"middle\">0 s<"));
    const std::string beyond = gap::to_svg(plot, {0.0, 3000.0, 7000.0});
    EXPECT_THAT(beyond, HasSubstr("text-anchor=\"middle\">6000<"));
}

}  // namespace
