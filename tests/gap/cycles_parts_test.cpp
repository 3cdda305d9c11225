// What cycles are explained with, part by part: gaps, medians, what a core pays, where the gap lies, what is drawn.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "gap/cycles/blind.hpp"
#include "gap/cycles/evidence.hpp"
#include "gap/cycles/intervals.hpp"
#include "gap/cycles/lines.hpp"
#include "gap/cycles/locate.hpp"
#include "gap/cycles/search.hpp"
#include "gap/cycles/steps.hpp"
#include "gap/cycles/verdict.hpp"

namespace {

using gap::cycles::Cycles;
using gap::cycles::Evidence;
using gap::cycles::Question;
using gap::cycles::State;
using testing::ElementsAre;

qemu::MeasuredCycles row(const char* kernel, std::uint32_t taps, double cycles, bool maintenance = false,
                         const char* code = "itcm", const char* data = "dtcm") {
    return {kernel, code, data, maintenance, taps, cycles, 0};
}

TEST(CyclesParts, MediansAreOfTheMiddle) {
    EXPECT_EQ(gap::cycles::median({}), 0.0);
    EXPECT_EQ(gap::cycles::median({7.0}), 7.0);
    EXPECT_EQ(gap::cycles::median({9.0, 1.0, 4.0}), 4.0);
    EXPECT_EQ(gap::cycles::median({9.0, 1.0, 4.0, 6.0}), 5.0);
}

TEST(CyclesParts, AGapIsTheShareOfTheMeasuredCycles) {
    const std::vector<double> measured{100.0, 50.0, 25.0};
    const std::vector<double> predicted{90.0, 60.0, 1000.0};
    EXPECT_NEAR(gap::cycles::gap_of(measured, predicted, {0, 1}), 20.0 / 150.0, 1e-12);
    EXPECT_EQ(gap::cycles::gap_of(measured, predicted, {}), 0.0);
}

TEST(CyclesParts, AChangeIsBelievedByTheCyclesAndTheGap) {
    // 0.3 % of the cycles, and 15 % of the gap.
    EXPECT_TRUE(gap::cycles::better(0.0099, 0.013));
    EXPECT_FALSE(gap::cycles::better(0.0101, 0.013));
    EXPECT_TRUE(gap::cycles::better(0.8499 * 0.4, 0.4));
    EXPECT_FALSE(gap::cycles::better(0.8501 * 0.4, 0.4));
}

// A kernel is met within 5 % of its slope, and 5 % or 8 cycles of its shortest call; closely within 2 % and 8 cycles.
TEST(CyclesParts, ALineIsMetByItsSlopeAndItsShortestCall) {
    const auto line = [](double slope, double constant, double shortest = 100.0) {
        return gap::cycles::LineLeft{"k", "p", slope, constant, shortest};
    };
    for (const double sign : {1.0, -1.0}) {
        EXPECT_TRUE(is_met(line(sign * 0.0499, 0.0)));
        EXPECT_FALSE(is_met(line(sign * 0.0501, 0.0)));
        EXPECT_TRUE(is_met(line(0.0, sign * 7.99)));
        EXPECT_FALSE(is_met(line(0.0, sign * 8.01)));
        EXPECT_TRUE(is_met(line(0.0, sign * 49.9, 1000.0)));
        EXPECT_FALSE(is_met(line(0.0, sign * 50.1, 1000.0)));
        EXPECT_TRUE(is_met_closely(line(sign * 0.01999, sign * 7.99)));
        EXPECT_FALSE(is_met_closely(line(sign * 0.02001, 0.0)));
        EXPECT_FALSE(is_met_closely(line(0.0, sign * 8.01, 1000.0)));
    }
}

TEST(CyclesParts, RowsAreNamedByTheirPlacement) {
    EXPECT_EQ(gap::cycles::placement_of(row("k_f32", 5, 1.0)), "code=itcm data=dtcm");
    EXPECT_EQ(gap::cycles::placement_of(row("k_f32", 5, 1.0, true, "flash", "axi")), "code=flash data=axi maintenance");
    EXPECT_FALSE(gap::cycles::on_bus(row("k_f32", 5, 1.0, false, "flash_cached", "dtcm")));
    EXPECT_TRUE(gap::cycles::on_bus(row("k_f32", 5, 1.0, false, "flash", "dtcm")));
    EXPECT_TRUE(gap::cycles::on_bus(row("k_f32", 5, 1.0, false, "itcm", "axi")));
}

// 10 a tap and 4 beside the call; 3 a tap of it single issue.
std::vector<std::vector<qemu::PredictedCycles>> predict(const Question& question,
                                                        const std::vector<qemu::CoreVariant>& variants) {
    std::vector<std::vector<qemu::PredictedCycles>> all;
    for (const auto& variant : variants) {
        all.emplace_back();
        for (const auto& one : question.rows) {
            const bool off =
                std::find(variant.without.begin(), variant.without.end(), "single_issue") != variant.without.end();
            qemu::PredictedCycles p{(off ? 7.0 : 10.0) * one.taps + 4.0, 0, 0, 4.0, 100, {}};
            p.half_cycles[timing::index(timing::Effect::single_issue)] =
                off ? 0 : 6 * static_cast<std::int64_t>(one.taps);
            all.back().push_back(p);
        }
    }
    return all;
}

struct Made {
    Question question;
    int calls = 0;
    gap::cycles::Predict by;
    explicit Made(std::vector<qemu::MeasuredCycles> rows) {
        question.rows = std::move(rows);
        question.base = "core";
        by = [this](const auto& variants) {
            ++calls;
            return predict(question, variants);
        };
    }
};

TEST(CyclesEvidence, FitsEveryOtherRowOfAKernelAndPlacement) {
    Made made({row("a_f32", 10, 100), row("b_f32", 10, 100), row("a_f32", 20, 200), row("a_f32", 30, 300),
               row("b_f32", 20, 200), row("a_f32", 40, 300, true), row("a_f32", 50, 300, true)});
    const Evidence evidence(made.question, made.by);
    EXPECT_THAT(evidence.to_fit(), ElementsAre(0, 1, 3, 5));
    EXPECT_THAT(evidence.to_judge(), ElementsAre(2, 4, 6));
    EXPECT_FALSE(evidence.judged_by_itself());
    made.question.rows.pop_back();
    const Evidence alone(made.question, made.by);
    EXPECT_TRUE(alone.judged_by_itself());
    EXPECT_THAT(alone.to_judge(), ElementsAre(0, 1, 2, 3, 4, 5));
    EXPECT_EQ(alone.to_fit(), alone.to_judge());
}

// Of rows measured again their differences from the median; half a cycle, as counters are whole.
TEST(CyclesEvidence, HasTheNoiseOfRowsMeasuredAgain) {
    Made made({row("a_f32", 10, 100), row("a_f32", 10, 104), row("a_f32", 10, 101), row("a_f32", 20, 200)});
    const Evidence evidence(made.question, made.by);
    EXPECT_NEAR(evidence.floor(), (1.0 + 3.0 + 0.5 + 0.5) / 505.0, 1e-12);
}

TEST(CyclesEvidence, AddsWhatACorePays) {
    Made made({row("a_f32", 10, 0), row("a_f32", 20, 0, true, "flash", "dtcm")});
    Evidence evidence(made.question, made.by);
    State state{.core = "core"};
    EXPECT_THAT(evidence.inside(state), ElementsAre(100.0, 200.0));
    state.factor["single_issue"] = 1.5;  // 3 a tap, half of it more
    EXPECT_THAT(evidence.inside(state), ElementsAre(115.0, 230.0));
    state.ratio = 2.0;
    state.contention = 0.1;  // on the bus
    EXPECT_THAT(evidence.inside(state), ElementsAre(230.0, testing::DoubleNear(506.0, 1e-9)));
    state.overhead = 7.0;
    state.maintenance = 30.0;
    EXPECT_THAT(evidence.whole(state), ElementsAre(237.0, testing::DoubleNear(543.0, 1e-9)));
    // What is known is not simulated again; what is asked for at once is simulated at once.
    const int before = made.calls;
    (void)evidence.whole(state);
    EXPECT_EQ(made.calls, before);
    State off = state;
    off.off = {"single_issue"};
    off.factor.clear();
    State other{.core = "other"};
    evidence.simulate({off, other, off});
    EXPECT_EQ(made.calls, before + 1);
    EXPECT_THAT(evidence.inside(State{.core = "core", .off = {"single_issue"}}), ElementsAre(70.0, 140.0));
    EXPECT_EQ(made.calls, before + 1);
}

// Cycles a sample and cycles a call count by what the file gives, not by the length of the call.
TEST(CyclesEvidence, ComparesRowsByTheirUnit) {
    Made made({row("a_f32", 10, 110), row("b_f32", 100, 1000)});
    made.question.rows[1].per = 100.0;
    const Evidence evidence(made.question, made.by);
    EXPECT_NEAR(evidence.gap({100.0, 1100.0}, {0, 1}), (10.0 + 1.0) / (110.0 + 10.0), 1e-12);
    EXPECT_NEAR(evidence.floor(), (0.5 + 0.005) / (110.0 + 10.0), 1e-12);
    // Two programs whose calls are of one length are no row that was measured again.
    made.question.rows = {row("a_f32", 10, 100), row("a_f32", 10, 104)};
    made.question.rows[0].program = "a.elf";
    made.question.rows[1].program = "b.elf";
    EXPECT_NEAR(Evidence(made.question, made.by).floor(), 1.0 / 204.0, 1e-12);
}

// Of a clock twice as fast a call's cost is twice as many cycles. It is a step where it is off by more than it is worth
// and, beside another clock, by more than a twentieth; what is less goes with the clock.
TEST(CyclesSteps, ACostIsAStepWhereTheClockDoesNotTakeItAlong) {
    Made made(
        {row("a_f32", 10, 600), row("a_f32", 20, 1400, true), row("a_f32", 30, 1000), row("a_f32", 40, 1800, true)});
    Evidence evidence(made.question, made.by);
    const auto steps = [&](double ratio, double overhead, double maintenance, double before = 200.0) {
        const State now{.core = "core", .overhead = before, .maintenance = 2.0 * before};
        const State found{.core = "core", .ratio = ratio, .overhead = overhead, .maintenance = maintenance};
        std::vector<std::string> effects;
        double gap = evidence.judged_gap(evidence.whole(now));
        for (const auto& step : gap::cycles::steps_to(evidence, found, now, found, 4.0)) {
            effects.push_back(step.effect);
            EXPECT_EQ(step.gap_before, gap);
            gap = step.gap_after;
        }
        if (ratio != 1.0) {
            EXPECT_EQ(gap, evidence.judged_gap(evidence.whole(found)));
        }
        std::sort(effects.begin(), effects.end());
        return effects;
    };
    EXPECT_THAT(steps(2.0, 419.0, 800.0), ElementsAre("clock_ratio"));
    EXPECT_THAT(steps(2.0, 381.0, 800.0), ElementsAre("clock_ratio"));
    EXPECT_THAT(steps(2.0, 421.0, 800.0), ElementsAre("call_overhead", "clock_ratio"));
    EXPECT_THAT(steps(2.0, 379.0, 800.0), ElementsAre("call_overhead", "clock_ratio"));
    EXPECT_THAT(steps(2.0, 400.0, 839.0), ElementsAre("clock_ratio"));
    EXPECT_THAT(steps(2.0, 400.0, 841.0), ElementsAre("cache_maintenance", "clock_ratio"));
    EXPECT_THAT(steps(2.0, 421.0, 841.0), ElementsAre("cache_maintenance", "call_overhead", "clock_ratio"));
    // A twentieth of 40 is less than such a cost is worth.
    EXPECT_THAT(steps(2.0, 43.9, 80.0, 20.0), ElementsAre("clock_ratio"));
    EXPECT_THAT(steps(2.0, 44.1, 80.0, 20.0), ElementsAre("call_overhead", "clock_ratio"));
    // Of the same clock all that it is worth.
    EXPECT_THAT(steps(1.0, 203.9, 404.1), ElementsAre("cache_maintenance"));
    EXPECT_THAT(steps(1.0, 204.1, 400.0), ElementsAre("call_overhead"));
}

// What takes off most goes first; of two that take off the same, the overhead.
TEST(CyclesSteps, GoByWhatTheyTakeOff) {
    Made made({row("a_f32", 10, 1104, true), row("a_f32", 20, 1204, true), row("a_f32", 30, 1304, true)});
    Evidence evidence(made.question, made.by);
    const State now{.core = "core", .overhead = 200.0, .maintenance = 200.0};
    const auto steps = [&](double overhead, double maintenance) {
        const State found{.core = "core", .overhead = overhead, .maintenance = maintenance};
        std::vector<std::string> effects;
        for (const auto& step : gap::cycles::steps_to(evidence, found, now, found, 4.0)) {
            effects.push_back(step.effect);
        }
        return effects;
    };
    EXPECT_THAT(steps(600.0, 400.0), ElementsAre("call_overhead", "cache_maintenance"));
    EXPECT_THAT(steps(400.0, 600.0), ElementsAre("cache_maintenance", "call_overhead"));
    EXPECT_THAT(steps(500.0, 500.0), ElementsAre("call_overhead", "cache_maintenance"));
}

TEST(CyclesLines, HaveWhatIsLeftOfSlopeAndConstant) {
    Made made({row("a_f32", 10, 120), row("a_f32", 20, 230), row("a_f32", 30, 340), row("a_f32", 40, 9999),
               row("a_f32", 50, 560), row("b_f32", 100, 1010), row("b_f32", 110, 1000)});
    const Evidence evidence(made.question, made.by);
    const auto lines = gap::cycles::lines_left(evidence, {110.0, 210.0, 310.0, 410.0, 510.0, 1000.0, 1000.0});
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines[0].kernel, "a_f32");
    EXPECT_NEAR(lines[0].slope, 1.0 / 11.0, 1e-12);  // whatever one row says
    EXPECT_NEAR(lines[0].constant, 10.0, 1e-12);
    EXPECT_NEAR(lines[0].shortest, 120.0, 1e-12);
    EXPECT_EQ(lines[0].placement, "code=itcm data=dtcm");
    EXPECT_NEAR(lines[1].slope, 0.0, 1e-12);  // calls of nearly one length are no line
    EXPECT_NEAR(lines[1].constant, 5.0, 1e-12);
}

TEST(CyclesLines, AreMetToFivePercentOrEightCycles) {
    using gap::cycles::is_met;
    using gap::cycles::is_met_closely;
    EXPECT_TRUE(is_met({"", "", 0.049, 8.0, 100.0}));
    EXPECT_FALSE(is_met({"", "", 0.051, 0.0, 100.0}));
    EXPECT_FALSE(is_met({"", "", -0.051, 0.0, 100.0}));
    EXPECT_FALSE(is_met({"", "", 0.0, 8.5, 100.0}));
    EXPECT_TRUE(is_met({"", "", 0.0, 8.5, 1000.0}));
    EXPECT_TRUE(is_met_closely({"", "", -0.019, -8.0, 1000.0}));
    EXPECT_FALSE(is_met_closely({"", "", 0.021, 0.0, 1000.0}));
    EXPECT_FALSE(is_met_closely({"", "", 0.0, 8.5, 1000.0}));
}

TEST(CyclesEvidence, TakesCostsBesideTheCallForMedians) {
    Made made({row("a_f32", 10, 105), row("a_f32", 20, 207), row("a_f32", 30, 390), row("a_f32", 10, 157, true),
               row("a_f32", 20, 259, true)});
    Evidence evidence(made.question, made.by);
    State state{.core = "core"};
    evidence.fit_beside(state, {0, 1, 2, 3, 4});
    EXPECT_EQ(state.overhead, 7.0);      // of 5, 7 and 90
    EXPECT_EQ(state.maintenance, 51.0);  // of 50 and 52 beside it
    evidence.fit_beside(state, {0, 1});
    EXPECT_EQ(state.overhead, 6.0);
    EXPECT_EQ(state.maintenance, 0.0);
    // Fitted are rows 0 and 2 of the plain ones and 3 of the others.
    EXPECT_THAT(evidence.to_fit(), ElementsAre(0, 2, 3));
    const double gap = evidence.fitted_gap(state);
    EXPECT_EQ(state.overhead, 47.5);
    EXPECT_EQ(state.maintenance, 9.5);
    EXPECT_NEAR(gap, (42.5 + 42.5) / (105.0 + 390.0 + 157.0), 1e-12);
}

// The median counts each row by its cycles: a few rows that are far off, or many short ones, move none that is drawn.
TEST(CyclesIntervals, AreOfTheMediansOfRowsDrawnAgain) {
    const auto interval = [](std::vector<qemu::MeasuredCycles> rows) {
        Made made(std::move(rows));
        Evidence evidence(made.question, made.by);
        std::vector<gap::cycles::Step> steps{{"clock_ratio", {{"ratio", 2.0}}, {}, 0.5, 0.1, 0.9}};
        gap::cycles::add_intervals(evidence, State{.core = "core", .ratio = 2.0}, steps);
        return steps[0].interval.at("ratio");
    };
    std::vector<qemu::MeasuredCycles> few(20, row("a_f32", 10, 200.0));
    few[3].cycles = few[11].cycles = 300.0;
    // Half a cycle to each side, of 100 for one clock.
    EXPECT_NEAR(interval(few).low, 1.995, 1e-12);
    EXPECT_NEAR(interval(few).high, 2.005, 1e-12);
    std::vector<qemu::MeasuredCycles> many(18, row("a_f32", 100, 2000.0));
    std::fill_n(many.begin(), 10, row("b_f32", 1, 30.0));
    EXPECT_NEAR(interval(many).low, 1.95, 1e-12);
    EXPECT_NEAR(interval(many).high, 2.05, 1e-12);
}

TEST(CyclesLocate, SharesOutTheGapOfWhatJudges) {
    // Judged are the second ones of each kernel and placement.
    Made made({row("a_f32", 10, 100), row("a_f32", 20, 230), row("b_q31", 10, 100), row("b_q31", 20, 210),
               row("a_f32", 10, 100, true), row("a_f32", 20, 260, true)});
    const Evidence evidence(made.question, made.by);
    const gap::WhereInRows where = gap::cycles::locate(evidence, Cycles(6, 200.0));
    ASSERT_EQ(where.kernels.size(), 2U);
    EXPECT_EQ(where.kernels[0].name, "a_f32");
    EXPECT_NEAR(where.kernels[0].share, 0.9, 1e-12);
    EXPECT_NEAR(where.kernels[1].share, 0.1, 1e-12);
    ASSERT_EQ(where.placements.size(), 2U);
    EXPECT_EQ(where.placements[0].name, "code=itcm data=dtcm maintenance");
    EXPECT_NEAR(where.placements[0].share, 0.6, 1e-12);
    ASSERT_EQ(where.lines.size(), 2U);
    EXPECT_NEAR(where.lines[0].share + where.lines[1].share, 1.0, 1e-12);
    // No gap at all: everything alike.
    const gap::WhereInRows none = gap::cycles::locate(evidence, {100.0, 230.0, 100.0, 210.0, 100.0, 260.0});
    EXPECT_EQ(none.kernels[0].share, 0.5);
    EXPECT_EQ(none.placements[1].share, 0.5);
}

// 3 a tap and 20 a call more than predicted, at 10 to 40 taps: the slope's share of both.
TEST(CyclesLocate, PartsTheSlopeFromTheConstant) {
    std::vector<qemu::MeasuredCycles> rows;
    for (const std::uint32_t taps : {10U, 10U, 20U, 20U, 40U, 40U}) {
        rows.push_back(row("a_f32", taps, 13.0 * taps + 20.0));
    }
    Made made(rows);
    const Evidence evidence(made.question, made.by);
    Cycles base;
    for (const auto& one : rows) {
        base.push_back(10.0 * one.taps);
    }
    const gap::WhereInRows where = gap::cycles::locate(evidence, base);
    const double slope = 3.0 * (10.0 + 20.0 + 40.0);
    EXPECT_EQ(where.lines[0].name, "slope");
    EXPECT_NEAR(where.lines[0].share, slope / (slope + 60.0), 1e-9);
    EXPECT_NEAR(where.lines[1].share, 60.0 / (slope + 60.0), 1e-9);
}

TEST(CyclesVerdict, IsToldInTheCommonForm) {
    gap::cycles::Explanation found;
    found.outcome = gap::Outcome::ambiguous;
    found.base_gap = 0.5;
    found.after_gap = 0.1;
    found.floor = 0.1;
    found.reference = "reference";
    found.apart = "both";
    found.steps = {{"single_issue", {{"factor", 1.0}}, {}, 0.5, 0.4, 0.95},
                   {"call_overhead", {{"cycles", 10.0}}, {{"cycles", {8.0, 12.0}}}, 0.4, 0.1, 0.6}};
    found.alternatives = {{"clock_ratio", {{"ratio", 2.0}}, {}, 0.4, 0.2, 0.6}};
    found.next_experiment = "next";
    found.notes = {"note"};
    const gap::Verdict verdict = gap::cycles::verdict_of(found, "judged");
    const auto& of = std::get<gap::OfCycles>(verdict.of);
    EXPECT_EQ(verdict.outcome, gap::Outcome::ambiguous);
    EXPECT_EQ(verdict.gap.base, 0.5);
    EXPECT_EQ(verdict.gap.after, 0.1);
    EXPECT_EQ(verdict.gap.noise_floor, 0.1);
    EXPECT_EQ(of.judged, "judged");
    EXPECT_EQ(of.reference, "reference");
    EXPECT_EQ(of.apart, "both");
    ASSERT_EQ(of.steps.size(), 2U);
    EXPECT_NEAR(of.steps[0].shrink, 0.1 / 0.4, 1e-12);
    EXPECT_NEAR(of.steps[1].shrink, 0.3 / 0.4, 1e-12);
    EXPECT_TRUE(of.steps[0].parameters[0].intervals.empty());
    EXPECT_THAT(of.steps[1].parameters[0].intervals, ElementsAre(std::pair(8.0, 12.0)));
    ASSERT_EQ(of.alternatives.size(), 1U);
    EXPECT_EQ(of.alternatives[0].confidence, 0.6);
    // What takes off most is first in the ranking.
    ASSERT_EQ(verdict.ranking.size(), 3U);
    EXPECT_EQ(verdict.ranking[0].effects, "call_overhead");
    EXPECT_NEAR(verdict.ranking[0].score, 0.3, 1e-12);
    EXPECT_EQ(verdict.ranking[1].effects, "clock_ratio");
    EXPECT_EQ(verdict.ranking[2].effects, "single_issue");
    // Of several that take off as much, as rival rules do, the one that was found first.
    found.alternatives = {{"load_use", {}, {}, 0.4, 0.2, 0.25}, {"store_buffer", {}, {}, 0.4, 0.2, 0.25}};
    const gap::Verdict rivals = gap::cycles::verdict_of(found, "judged");
    ASSERT_EQ(rivals.ranking.size(), 4U);
    EXPECT_EQ(rivals.ranking[1].effects, "load_use");
    EXPECT_EQ(rivals.ranking[2].effects, "store_buffer");
    found.floor = 0.5;  // nothing can be closed
    EXPECT_EQ(std::get<gap::OfCycles>(gap::cycles::verdict_of(found, "judged").of).steps[0].shrink, 0.0);
}

// Each kind as often as it is said to be, each size within its range and up to its ends.
TEST(BlindCyclesParts, SecretsHaveTheirSharesAndSizes) {
    constexpr std::size_t count = 200000;
    std::map<std::string, double> kinds;
    std::map<std::string, std::pair<double, double>> ranges;
    const auto widen = [&](const std::string& name, double value) {
        auto [at, fresh] = ranges.emplace(name, std::pair(value, value));
        at->second.first = std::min(at->second.first, value);
        at->second.second = std::max(at->second.second, value);
    };
    std::map<std::string, double> costs;
    double slower = 0.0;
    for (const auto& secret : gap::cycles::draw_secrets(count, 3, {"single_issue"})) {
        kinds[secret.kind] += 1.0 / count;
        if (secret.kind == "cost") {
            costs[secret.effects.front()] += 1.0 / count;
            slower += secret.ratio < 1.0 ? 1.0 / count : 0.0;
        }
        const auto has = [&](const char* name) {
            return std::count(secret.effects.begin(), secret.effects.end(), name) > 0;
        };
        if (has("call_overhead")) {
            widen("overhead", secret.overhead);
        }
        if (has("cache_maintenance")) {
            widen("maintenance", secret.maintenance);
        }
        if (has("clock_ratio")) {
            widen(secret.ratio < 1.0 ? "slower" : "faster", secret.ratio);
        }
        if (has("bus_contention")) {
            widen("contention", secret.contention);
        }
        if (secret.kind == "unlisted") {
            widen("sawtooth", secret.sawtooth);
        }
        EXPECT_EQ(has("call_overhead"), secret.overhead != 0.0);
        EXPECT_EQ(has("cache_maintenance"), secret.maintenance != 0.0);
        EXPECT_EQ(has("clock_ratio"), secret.ratio != 1.0);
        EXPECT_EQ(has("bus_contention"), secret.contention != 0.0);
    }
    // A deviation of 0.001.
    EXPECT_NEAR(kinds["nothing"], 0.25, 0.002);
    EXPECT_NEAR(kinds["two"], 0.15, 0.002);
    EXPECT_NEAR(kinds["unlisted"], 0.15, 0.002);
    EXPECT_NEAR(kinds["switch"], 0.225, 0.002);
    EXPECT_NEAR(kinds["cost"], 0.225, 0.002);
    // Of the four costs each is as often, and of the clocks each direction. A deviation of 0.0005 and less.
    ASSERT_EQ(costs.size(), 4U);
    for (const auto& [name, share] : costs) {
        EXPECT_NEAR(share, 0.225 / 4.0, 0.002) << name;
    }
    EXPECT_NEAR(slower, 0.225 / 8.0, 0.002);
    const auto expect = [&](const char* name, double low, double high) {
        EXPECT_GE(ranges[name].first, low) << name;
        EXPECT_LE(ranges[name].second, high) << name;
        EXPECT_NEAR(ranges[name].first, low, 0.003 * low) << name;
        EXPECT_NEAR(ranges[name].second, high, 0.003 * high) << name;
    };
    expect("overhead", 15.0, 60.0);
    expect("maintenance", 40.0, 200.0);
    expect("slower", 0.7, 0.92);
    expect("faster", 1.08, 1.5);
    expect("contention", 0.1, 0.4);
    expect("sawtooth", 0.15, 0.4);
}

TEST(BlindCyclesParts, RowsAreOfBothPlacementsAndSixLengths) {
    std::map<std::string, std::vector<std::uint32_t>> lengths;
    unsigned line = 2;
    for (const auto& one : gap::cycles::blind_rows()) {
        lengths[one.kernel + " " + gap::cycles::placement_of(one)].push_back(one.taps);
        EXPECT_EQ(one.line, line++);
    }
    EXPECT_EQ(lengths.size(), 12U);
    for (const auto& [name, taps] : lengths) {
        EXPECT_THAT(taps, ElementsAre(10U, 20U, 40U, 64U, 100U, 128U)) << name;
        EXPECT_TRUE(name.ends_with("code=itcm data=dtcm") || name.ends_with("code=flash_cached data=axi maintenance"))
            << name;
    }
    // A kernel over the bus also at lengths that a cache of 4 KB does not hold; a published loop has no such lengths.
    lengths.clear();
    for (const auto& one : gap::cycles::blind_rows(true)) {
        lengths[one.kernel + " " + gap::cycles::placement_of(one)].push_back(one.taps);
    }
    for (const auto& [name, taps] : lengths) {
        const bool is_long = name.ends_with("maintenance") && !name.starts_with("shift_fir");
        EXPECT_EQ(taps.size(), is_long ? 8U : 6U) << name;
        EXPECT_EQ(taps.back(), is_long ? 1000U : 128U) << name;
    }
}

}  // namespace
