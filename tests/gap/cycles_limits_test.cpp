// The diagnosis of cycles on both sides of each of its limits, on a core that is made up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gap/cycles/explain.hpp"

namespace {

using gap::Outcome;
using gap::cycles::Explanation;
using gap::cycles::Question;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Rows = std::vector<qemu::MeasuredCycles>;
using Losses = std::vector<std::pair<timing::Effect, double>>;

// What a kernel takes a tap, and of that what it loses to effects.
struct Kernel {
    const char* name;
    double a_tap;
    Losses lost_a_tap;
};

using timing::Effect;
const std::vector<Kernel> integer_kernels{
    {"ring_plain_q31", 400.0, {{Effect::single_issue, 100.0}, {Effect::load_use, 50.0}}},
    {"ring_fir_q31", 500.0, {{Effect::single_issue, 60.0}, {Effect::store_buffer, 90.0}}},
};

// Taps so many that whole cycles are nothing beside.
Rows rows_of(const std::vector<Kernel>& kernels, const char* code = "itcm", const char* data = "dtcm") {
    Rows all;
    for (const Kernel& kernel : kernels) {
        for (const std::uint32_t taps : {10U, 20U, 50U, 100U, 200U, 400U}) {
            all.push_back({kernel.name, code, data, false, 10 * taps, 0.0, 0});
        }
    }
    return all;
}

// Of the core "real"; "ideal" loses nothing. Under published rules each effect costs so many times as much.
qemu::PredictedCycles predicted(const std::vector<Kernel>& kernels, const qemu::MeasuredCycles& row,
                                const qemu::CoreVariant& variant, double published) {
    const Kernel& kernel = *std::ranges::find_if(kernels, [&](const Kernel& one) { return row.kernel == one.name; });
    qemu::PredictedCycles p{kernel.a_tap * row.taps, 0, 0, 0, 100, {}};
    for (const auto& [effect, a_tap] : kernel.lost_a_tap) {
        const bool off = variant.core == "ideal" ||
                         std::ranges::count(variant.without, timing::effect_names[timing::index(effect)]) > 0;
        const double by = off ? 0.0 : variant.set == "published" ? published : 1.0;
        p.nominal += (by - 1.0) * a_tap * row.taps;
        p.half_cycles[timing::index(effect)] = std::llround(2.0 * by * a_tap * row.taps);
    }
    return p;
}

struct Asked {
    std::vector<Kernel> kernels = integer_kernels;
    Rows rows = rows_of(integer_kernels);
    std::string base = "real";
    double published = 1.0;

    // Cycles of the core `real`, each row's changed.
    template <class Change>
    Explanation answer(const Change& change) {
        Question question;
        question.rows = rows;
        question.base = base;
        question.references = {"real"};
        question.sets["real"] = question.fitting["real"] = {"published", "fitted"};
        if (base == "ideal") {
            question.base_off.assign(timing::effect_names.begin(), timing::effect_names.end());
        }
        for (qemu::MeasuredCycles& row : question.rows) {
            row.cycles = change(row, predicted(kernels, row, {"real"}, published).nominal);
        }
        return gap::cycles::explain(question, [&](const std::vector<qemu::CoreVariant>& variants) {
            std::vector<std::vector<qemu::PredictedCycles>> all;
            for (const auto& variant : variants) {
                all.emplace_back();
                for (const auto& row : question.rows) {
                    all.back().push_back(predicted(kernels, row, variant, published));
                }
            }
            return all;
        });
    }
    Explanation at_ratio(double ratio) {
        return answer([ratio](const auto&, double cycles) { return ratio * cycles; });
    }
};

std::vector<std::string> effects_of(const std::vector<gap::cycles::Step>& steps) {
    std::vector<std::string> names;
    for (const auto& step : steps) {
        names.push_back(step.effect);
    }
    return names;
}

// A fiftieth of the measured cycles.
TEST(CyclesLimits, AGapOfTwoPercentIsNone) {
    const Explanation none = Asked{}.at_ratio(1.0 / (1.0 - 0.01999));
    EXPECT_NEAR(none.base_gap, 0.01999, 1e-9);
    EXPECT_EQ(none.outcome, Outcome::no_gap);
    EXPECT_EQ(none.after_gap, none.base_gap);
    EXPECT_EQ(none.reference, "real");
    EXPECT_NE(Asked{}.at_ratio(1.0 / (1.0 - 0.02001)).outcome, Outcome::no_gap);
}

// Of rows that are all on the bus whatever takes a part of each may be another clock, interrupts or who else is there.
TEST(CyclesLimits, ASlowerClockMayBeInterruptsOrTheBus) {
    Asked asked;
    for (const bool on_bus : {false, true}) {
        asked.rows = rows_of(integer_kernels, on_bus ? "flash" : "itcm");
        const Explanation found = asked.at_ratio(1.25);
        EXPECT_EQ(found.outcome, Outcome::ambiguous);
        EXPECT_THAT(found.steps, IsEmpty());
        EXPECT_EQ(found.apart, "a part of every row's time");
        EXPECT_EQ(found.next_experiment,
                  "the same rows with interrupts off, and with the counter read around a delay of known length");
        ASSERT_EQ(found.alternatives.size(), on_bus ? 3U : 2U);
        EXPECT_EQ(found.alternatives[0].effect, "clock_ratio");
        EXPECT_NEAR(found.alternatives[0].parameters.at("ratio"), 1.25, 1e-3);
        EXPECT_EQ(found.alternatives[1].effect, "interrupt_load");
        EXPECT_NEAR(found.alternatives[1].parameters.at("share"), 0.2, 1e-3);
        for (const auto& one : found.alternatives) {
            EXPECT_EQ(one.parameters.size(), 1U);
            EXPECT_NEAR(one.gap_before, 0.2, 1e-6);
            EXPECT_NEAR(one.gap_after, found.after_gap, 1e-12);
        }
        if (on_bus) {
            EXPECT_EQ(found.alternatives[2].effect, "bus_contention");
            EXPECT_NEAR(found.alternatives[2].parameters.at("share"), 0.25, 1e-3);
        }
    }
    // One row that is not there rules the bus out.
    asked.rows.back().code = asked.rows[asked.rows.size() - 2].code = "itcm";
    EXPECT_THAT(effects_of(asked.at_ratio(1.25).alternatives), ElementsAre("clock_ratio", "interrupt_load"));
}

// Counter and core run at clocks within half of each other, or at a whole ratio to a hundredth; a slower one that is
// no half slower may be interrupts.
TEST(CyclesLimits, ClocksAreNearEachOtherOrAtWholeRatios) {
    const auto outcome = [](double ratio) { return Asked{}.at_ratio(ratio).outcome; };
    EXPECT_EQ(outcome(1.495), Outcome::ambiguous);
    EXPECT_EQ(outcome(1.505), Outcome::unknown);
    EXPECT_EQ(outcome(0.505), Outcome::attributed);
    EXPECT_EQ(outcome(1.0 / 2.018), Outcome::attributed);
    EXPECT_EQ(outcome(1.0 / 2.023), Outcome::unknown);
    EXPECT_EQ(outcome(3.025), Outcome::attributed);
    EXPECT_EQ(outcome(3.035), Outcome::unknown);
    EXPECT_EQ(outcome(2.985), Outcome::attributed);
    EXPECT_EQ(outcome(2.965), Outcome::unknown);
}

// A clock that explains as much as one more effect does is none; as much as two more, it is the simpler cause.
TEST(CyclesLimits, OneClockGoesBeforeTwoEffectsThatLookLikeIt) {
    Asked asked;
    // Without single issue loads are three hundredths of either kernel, and stores two. All other effects are there.
    asked.kernels = {
        {"ring_plain_q31",
         400.0,
         {{Effect::single_issue, 100.0}, {Effect::load_use, 9.0}, {Effect::store_buffer, 6.0}}},
        {"ring_fir_q31", 500.0, {{Effect::single_issue, 60.0}, {Effect::load_use, 13.2}, {Effect::store_buffer, 8.8}}}};
    for (std::size_t i = 0; i < timing::effect_count; ++i) {
        const auto effect = static_cast<Effect>(i);
        if (effect != Effect::single_issue && effect != Effect::load_use && effect != Effect::store_buffer) {
            asked.kernels[i % 2].lost_a_tap.emplace_back(effect, 5.0 + static_cast<double>(i));
        }
    }
    const auto named = [&](bool stores) {
        const Explanation found = asked.answer([&](const qemu::MeasuredCycles& row, double cycles) {
            double lost = 0.0;
            for (const auto& [effect, a_tap] : asked.kernels[row.kernel == "ring_plain_q31" ? 0 : 1].lost_a_tap) {
                const bool is_away = effect == Effect::single_issue || effect == Effect::load_use ||
                                     (stores && effect == Effect::store_buffer);
                lost += is_away ? a_tap : 0.0;
            }
            return cycles - lost * row.taps;
        });
        EXPECT_EQ(found.outcome, Outcome::attributed);
        std::vector<std::string> names = effects_of(found.steps);
        std::ranges::sort(names);
        return names;
    };
    EXPECT_THAT(named(false), ElementsAre("load_use", "single_issue"));
    EXPECT_THAT(named(true), ElementsAre("clock_ratio", "single_issue"));
}

// Of a core that pays nothing half a cycle of a call is a step; of one that pays all, four.
TEST(CyclesLimits, ACallsCostIsAStepBeyondHalfACycleOrFour) {
    const auto has_cost = [](const std::string& base, double cost) {
        Asked asked;
        asked.base = base;
        // Its loads cost nothing here, so that there is a gap.
        const Explanation found = asked.answer([cost](const qemu::MeasuredCycles& row, double cycles) {
            return cycles - (row.kernel == "ring_plain_q31" ? 50.0 * row.taps : 0.0) + cost;
        });
        const std::vector<std::string> names = effects_of(found.steps);
        EXPECT_EQ(std::ranges::count(names, "load_use"), base == "ideal" ? 0 : 1);
        EXPECT_EQ(std::ranges::count(names, "single_issue"), base == "ideal" ? 1 : 0);
        return std::ranges::count(names, "call_overhead") > 0;
    };
    EXPECT_FALSE(has_cost("real", 3.98));
    EXPECT_TRUE(has_cost("real", 4.02));
    EXPECT_FALSE(has_cost("ideal", 0.498));
    EXPECT_TRUE(has_cost("ideal", 0.502));
}

// What published rules leave of floating-point rows, of each placement for itself, from a fifth of a cycle a tap on.
// Of a program of anybody's those are rows that wait for the floating-point unit.
TEST(CyclesLimits, APublishedRuleIsOffByAFifthOfACycleATap) {
    Asked asked;
    asked.base = "ideal";
    asked.published = 0.5;
    const auto parted = [&](double lost_a_tap) {
        asked.kernels = {{"far", 2.0 + 12.0, {{Effect::fpu_latency, 12.0}}},
                         {"near", 2.0 + lost_a_tap, {{Effect::fpu_latency, lost_a_tap}}},
                         {"whole", 31.0, {{Effect::single_issue, 1.0}}}};
        asked.rows = rows_of(asked.kernels);
        const Explanation found = asked.answer([](const auto&, double cycles) { return cycles; });
        EXPECT_EQ(found.outcome, Outcome::ambiguous);
        EXPECT_EQ(found.alternatives.size(), 4U);
        std::vector<std::string> names;
        for (const auto& [name, value] : found.alternatives.at(0).parameters) {
            names.push_back(name);
            EXPECT_NEAR(value, name.find("far") != std::string::npos ? 6.0 : 0.5 * lost_a_tap, 1e-3);
        }
        EXPECT_EQ(found.alternatives.at(0).confidence, 0.25);
        return names;
    };
    EXPECT_THAT(parted(0.399), ElementsAre(HasSubstr("far")));
    EXPECT_THAT(parted(0.401), ElementsAre(HasSubstr("far"), HasSubstr("near")));
}

}  // namespace
