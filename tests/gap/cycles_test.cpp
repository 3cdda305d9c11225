// The diagnosis of cycles on made-up cores: what was done to the measurement is what is found.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "gap/cycles/blind.hpp"
#include "gap/cycles/explain.hpp"

namespace {

using gap::Outcome;
using gap::cycles::Explanation;
using gap::cycles::Question;

// A kernel's cycles: of its instructions, and lost to effects, a tap and a call.
struct Loss {
    const char* effect;
    double a_tap;
    double a_call;
};
struct Kernel {
    const char* name;
    double ideal_a_tap;
    std::vector<Loss> losses;
};
const std::vector<Kernel> kernels{
    {"ring_plain_q31", 2.0, {{"single_issue", 1.0, 4.0}, {"load_use", 0.5, 1.0}, {"branch_mispredict", 0.0, 16.0}}},
    {"ring_fir_q31", 3.0, {{"single_issue", 0.5, 2.0}, {"store_buffer", 1.0, 0.0}, {"branch_mispredict", 0.0, 8.0}}},
    {"mirror_multi_q15",
     1.0,
     {{"single_issue", 0.25, 6.0}, {"load_bank_conflict", 0.75, 0.0}, {"branch_mispredict", 0.0, 24.0}}},
};

std::vector<qemu::MeasuredCycles> rows() {
    std::vector<qemu::MeasuredCycles> all;
    for (const Kernel& kernel : kernels) {
        for (const bool maintenance : {false, true}) {
            for (const std::uint32_t taps : {10U, 20U, 50U, 100U, 200U, 400U}) {
                all.push_back({kernel.name, "itcm", maintenance ? "axi" : "dtcm", maintenance, taps, 0.0, 0});
            }
        }
    }
    return all;
}

std::vector<qemu::PredictedCycles> predict(const std::vector<qemu::MeasuredCycles>& all,
                                           const qemu::CoreVariant& variant) {
    std::vector<qemu::PredictedCycles> predicted;
    for (const qemu::MeasuredCycles& row : all) {
        const Kernel& kernel =
            *std::find_if(kernels.begin(), kernels.end(), [&](const Kernel& one) { return row.kernel == one.name; });
        qemu::PredictedCycles p{kernel.ideal_a_tap * row.taps, 0, 0, 0, 100, {}};
        for (const Loss& loss : kernel.losses) {
            const bool off = variant.core == "ideal" || std::find(variant.without.begin(), variant.without.end(),
                                                                  loss.effect) != variant.without.end();
            const double cycles = loss.a_tap * row.taps + loss.a_call;
            if (!off) {
                p.nominal += cycles;
                p.half_cycles[timing::index(*timing::effect_named(loss.effect))] = std::llround(2.0 * cycles);
            }
        }
        predicted.push_back(p);
    }
    return predicted;
}

// Cycles of the core `real` without some effects, changed by `change`. \param beside  of each call, as core files have
// it
Explanation diagnose(const std::string& base, const std::vector<std::string>& without,
                     const std::function<double(const qemu::MeasuredCycles&, const qemu::PredictedCycles&)>& change,
                     std::vector<qemu::MeasuredCycles> measured = rows(), double beside = 0.0) {
    Question question;
    question.rows = std::move(measured);
    question.base = base;
    question.references = {"real"};
    question.sets["real"] = question.fitting["real"] = {"nominal"};
    if (base == "ideal") {
        for (const std::string_view name : timing::effect_names) {
            question.base_off.emplace_back(name);
        }
    }
    const auto predicted = [&](const qemu::CoreVariant& variant) {
        auto all = predict(question.rows, variant);
        for (qemu::PredictedCycles& p : all) {
            p.nominal += beside;
            p.beside = beside;
        }
        return all;
    };
    const auto truth = predicted({"real", "", without});
    for (std::size_t i = 0; i < truth.size(); ++i) {
        question.rows[i].cycles = std::round(change(question.rows[i], truth[i]));
    }
    return gap::cycles::explain(question, [&](const std::vector<qemu::CoreVariant>& variants) {
        std::vector<std::vector<qemu::PredictedCycles>> all;
        for (const auto& variant : variants) {
            all.push_back(predicted(variant));
        }
        return all;
    });
}

double unchanged(const qemu::MeasuredCycles&, const qemu::PredictedCycles& p) { return p.nominal; }

std::vector<std::string> effects_of(const Explanation& found) {
    std::vector<std::string> names;
    for (const auto& step : found.steps) {
        names.push_back(step.effect);
    }
    std::sort(names.begin(), names.end());
    return names;
}

TEST(Cycles, FromNothingEachEffectThatTheRowsPayIsFound) {
    const Explanation found = diagnose(
        "ideal", {}, [](const auto& row, const auto& p) { return p.nominal + 12.0 + (row.maintenance ? 90.0 : 0.0); });
    EXPECT_EQ(found.outcome, Outcome::attributed);
    EXPECT_EQ(effects_of(found),
              (std::vector<std::string>{"branch_mispredict", "cache_maintenance", "call_overhead", "load_bank_conflict",
                                        "load_use", "single_issue", "store_buffer"}));
    EXPECT_LT(found.after_gap, 0.005);
    EXPECT_NEAR(found.steps.front().gap_before, found.base_gap, 1e-12);
    EXPECT_NEAR(found.steps.back().gap_after, found.after_gap, 1e-12);
    for (const auto& step : found.steps) {
        if (step.effect == "cache_maintenance") {
            EXPECT_NEAR(step.parameters.at("cycles"), 90.0, 1.0);
            EXPECT_LE(step.interval.at("cycles").low, 90.0);
            EXPECT_GE(step.interval.at("cycles").high, 90.0);
        }
    }
    double sum = 0.0;
    for (const auto& share : found.where.kernels) {
        sum += share.share;
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
}

// Without rows that maintain caches nothing is said of what that costs, though the core file has a cost for each call.
TEST(Cycles, FromNothingNoMaintenanceIsNamedThatNoRowHas) {
    std::vector<qemu::MeasuredCycles> measured = rows();
    std::erase_if(measured, [](const qemu::MeasuredCycles& row) { return row.maintenance; });
    const Explanation found = diagnose("ideal", {}, unchanged, measured, 20.0);
    EXPECT_EQ(found.outcome, Outcome::attributed);
    EXPECT_EQ(effects_of(found), (std::vector<std::string>{"branch_mispredict", "load_bank_conflict", "load_use",
                                                           "single_issue", "store_buffer"}));
}

TEST(Cycles, OfACoreThatPaysTooMuchTheEffectIsNamed) {
    for (const char* effect : {"single_issue", "load_use", "store_buffer", "load_bank_conflict"}) {
        const Explanation found = diagnose("real", {effect}, unchanged);
        EXPECT_EQ(found.outcome, Outcome::attributed) << effect;
        EXPECT_EQ(effects_of(found), std::vector<std::string>{effect});
        ASSERT_EQ(found.steps.size(), 1U);
        EXPECT_EQ(found.steps[0].parameters.at("factor"), 0.0);
        EXPECT_LT(found.after_gap, 0.003);
    }
}

TEST(Cycles, AnotherCostOfAnEffectIsFound) {
    const Explanation found = diagnose("real", {}, [](const auto&, const auto& p) {
        return p.nominal +
               0.8 * static_cast<double>(p.half_cycles[timing::index(timing::Effect::load_bank_conflict)]) / 2.0;
    });
    EXPECT_EQ(found.outcome, Outcome::attributed);
    ASSERT_EQ(effects_of(found), std::vector<std::string>{"load_bank_conflict"});
    EXPECT_NEAR(found.steps[0].parameters.at("factor"), 1.8, 0.02);
}

TEST(Cycles, OtherCostsOfTwoEffectsAreFound) {
    const Explanation found = diagnose("real", {}, [](const auto&, const auto& p) {
        const auto cycles = [&](timing::Effect effect) {
            return static_cast<double>(p.half_cycles[timing::index(effect)]) / 2.0;
        };
        return p.nominal + 0.8 * cycles(timing::Effect::load_bank_conflict) +
               0.6 * cycles(timing::Effect::store_buffer);
    });
    EXPECT_EQ(found.outcome, Outcome::attributed);
    ASSERT_EQ(effects_of(found), (std::vector<std::string>{"load_bank_conflict", "store_buffer"}));
    for (const auto& step : found.steps) {
        EXPECT_NEAR(step.parameters.at("factor"), step.effect == "store_buffer" ? 1.6 : 1.8, 0.02) << step.effect;
    }
}

// With one row of a kernel and placement there is none left to judge on, and that is said.
TEST(Cycles, WhatIsJudgedOnTheRowsThatItIsFittedToSaysSo) {
    const auto notes = [](std::vector<std::uint32_t> taps) {
        Question question;
        question.base = "real";
        question.references = {"real"};
        question.sets["real"] = question.fitting["real"] = {"nominal"};
        for (const std::uint32_t length : taps) {
            question.rows.push_back({"ring_plain_q31", "itcm", "dtcm", false, length, 4.0 * length, 0});
        }
        return gap::cycles::explain(question,
                                    [&](const std::vector<qemu::CoreVariant>& variants) {
                                        std::vector<std::vector<qemu::PredictedCycles>> all;
                                        for (const auto& variant : variants) {
                                            all.push_back(predict(question.rows, variant));
                                        }
                                        return all;
                                    })
            .notes;
    };
    const auto says_so = testing::Contains(testing::HasSubstr("judged on the same rows"));
    EXPECT_THAT(notes({100}), says_so);
    EXPECT_THAT(notes({100, 200}), testing::Not(says_so));
}

// Rules were fitted to floating-point loops: where they explain what published ones leave there, by the length alone,
// no row tells which effect it is.
TEST(Cycles, WhatPublishedRulesLeaveOfFloatingRowsIsAmbiguous) {
    Question question;
    question.base = "ideal";
    question.references = {"real"};
    question.sets["real"] = question.fitting["real"] = {"published", "fitted"};
    for (const std::string_view name : timing::effect_names) {
        question.base_off.emplace_back(name);
    }
    const auto cycles = [&](const qemu::CoreVariant& variant) {
        std::vector<qemu::PredictedCycles> all;
        for (const auto& row : question.rows) {
            qemu::PredictedCycles p{2.0 * row.taps, 0, 0, 0, 100, {}};
            const bool floating = row.kernel == "ring_plain_f32";
            const std::string effect = floating ? "fpu_latency" : "single_issue";
            const double lost = 8.0 + row.taps * (floating ? (variant.set == "published" ? 2.0 : 3.5) : 1.0);
            if (variant.core != "ideal" && std::count(variant.without.begin(), variant.without.end(), effect) == 0) {
                p.nominal += lost;
                p.half_cycles[timing::index(*timing::effect_named(effect))] = std::llround(2.0 * lost);
            }
            all.push_back(p);
        }
        return all;
    };
    for (const char* kernel : {"ring_plain_q31", "ring_plain_f32"}) {
        for (const std::uint32_t taps : {10U, 20U, 50U, 100U, 200U, 400U}) {
            question.rows.push_back({kernel, "itcm", "dtcm", false, taps, 0.0, 0});
        }
    }
    const auto truth = cycles({"real", "fitted", {}});
    for (std::size_t i = 0; i < truth.size(); ++i) {
        question.rows[i].cycles = truth[i].nominal;
    }
    const Explanation found = gap::cycles::explain(question, [&](const std::vector<qemu::CoreVariant>& variants) {
        std::vector<std::vector<qemu::PredictedCycles>> all;
        for (const auto& variant : variants) {
            all.push_back(cycles(variant));
        }
        return all;
    });
    EXPECT_EQ(found.outcome, Outcome::ambiguous);
    EXPECT_THAT(found.apart, testing::HasSubstr("floating-point rows"));
    std::vector<std::string> names;
    for (const auto& one : found.alternatives) {
        names.push_back(one.effect);
        ASSERT_EQ(one.parameters.size(), 1U);  // q31 rows leave nothing
        EXPECT_THAT(one.parameters.begin()->first, testing::StartsWith("cycles_per_tap f32"));
        EXPECT_NEAR(one.parameters.begin()->second, 1.5, 1e-9);
        EXPECT_NEAR(one.gap_after, found.after_gap, 1e-12);
        EXPECT_GT(one.gap_before, 0.1);
    }
    EXPECT_THAT(names, testing::ElementsAre("fpu_latency", "load_bank_conflict", "store_buffer", "load_use"));
    EXPECT_LT(found.after_gap, 1e-9);
    EXPECT_THAT(found.notes, testing::Contains(testing::HasSubstr("fitted leaves 0.00 %")));
}

TEST(Cycles, TheSameCoreIsNoGap) { EXPECT_EQ(diagnose("real", {}, unchanged).outcome, Outcome::no_gap); }

// Rows measured twice are told by that how far they lie apart: a gap of four such floors is none, of little more it is.
TEST(Cycles, AGapOfFourFloorsIsNone) {
    std::vector<qemu::MeasuredCycles> twice;
    for (qemu::MeasuredCycles row : rows()) {
        row.taps *= 100000;  // whole cycles are nothing beside
        twice.insert(twice.end(), {row, row});
    }
    const auto of_floors = [&](double floors) {
        constexpr double longer = 0.1;  // of the second of each two, which judges
        // Of the first `apart` less than twice that: each lies so far from the median of both.
        const double floor = longer / (1.0 + longer) / floors;
        const double apart = floor * (1.0 + longer) / (1.0 + floor);
        std::size_t n = 0;
        return diagnose(
            "real", {},
            [&](const auto&, const auto& p) { return p.nominal * (1.0 + longer - (n++ % 2 == 0 ? 2.0 * apart : 0.0)); },
            twice);
    };
    const Explanation none = of_floors(3.98);
    EXPECT_EQ(none.outcome, Outcome::no_gap);
    EXPECT_NEAR(none.base_gap / none.floor, 3.98, 1e-4);
    const Explanation some = of_floors(4.02);
    EXPECT_NE(some.outcome, Outcome::no_gap);
    EXPECT_NEAR(some.base_gap / some.floor, 4.02, 1e-4);
}

TEST(Cycles, AFasterClockIsNamedAndASlowerOneMayBeInterrupts) {
    const auto scaled = [](double ratio) { return [ratio](const auto&, const auto& p) { return ratio * p.nominal; }; };
    const Explanation faster = diagnose("real", {}, scaled(0.5));
    EXPECT_EQ(faster.outcome, Outcome::attributed);
    EXPECT_EQ(effects_of(faster), std::vector<std::string>{"clock_ratio"});
    EXPECT_NEAR(faster.steps[0].parameters.at("ratio"), 0.5, 0.005);
    const Explanation slower = diagnose("real", {}, scaled(1.25));
    EXPECT_EQ(slower.outcome, Outcome::ambiguous);
    ASSERT_EQ(slower.alternatives.size(), 2U);
    EXPECT_EQ(slower.alternatives[0].effect, "clock_ratio");
    EXPECT_EQ(slower.alternatives[1].effect, "interrupt_load");
    EXPECT_NEAR(slower.alternatives[1].parameters.at("share"), 0.2, 0.005);
    EXPECT_FALSE(slower.next_experiment.empty());
}

// No counter runs at 1.875 times the core; one at twice or a third of it may.
TEST(Cycles, AClockThatNobodySetsIsAnotherCore) {
    const auto outcome_at = [](double ratio) {
        return diagnose("real", {}, [ratio](const auto&, const auto& p) { return ratio * p.nominal; });
    };
    for (const double ratio : {1.875, 0.4}) {
        const Explanation found = outcome_at(ratio);
        EXPECT_EQ(found.outcome, Outcome::unknown) << ratio;
        EXPECT_THAT(found.notes, testing::Contains(testing::HasSubstr("no counter runs at such a ratio"))) << ratio;
    }
    for (const double ratio : {2.0, 3.0, 1.0 / 3.0}) {
        EXPECT_EQ(outcome_at(ratio).outcome, Outcome::attributed) << ratio;
    }
}

// At the end of what was tried nothing was found.
TEST(Cycles, ACostAtTheEndOfTheSearchIsNone) {
    const Explanation found = diagnose("real", {}, [](const auto&, const auto& p) {
        return p.nominal + 3.5 * static_cast<double>(p.half_cycles[timing::index(timing::Effect::load_bank_conflict)]);
    });
    EXPECT_EQ(found.outcome, Outcome::unknown);
    for (const auto& step : found.steps) {
        if (step.parameters.contains("factor")) {
            EXPECT_LT(step.parameters.at("factor"), 3.9) << step.effect;
        }
    }
}

// Two kernels have two constants: an overhead and any effect of a call fit them, whatever they are.
TEST(Cycles, FewCyclesOfAConstantAreNoEffectBesideTheOverhead) {
    std::vector<qemu::MeasuredCycles> two;
    for (const char* kernel : {"ring_plain_q31", "ring_fir_q31"}) {
        for (const std::uint32_t taps : {5U, 10U, 20U, 50U, 100U, 128U}) {
            two.push_back({kernel, "itcm", "dtcm", false, taps, 0.0, 0});
        }
    }
    for (const double other : {-7.0, -4.0, 4.0, 7.0}) {
        const Explanation found = diagnose(
            "real", {},
            [&](const auto& row, const auto& p) {
                return p.nominal + 30.0 + (row.kernel == "ring_fir_q31" ? other : 0.0);
            },
            two);
        EXPECT_EQ(found.outcome, Outcome::attributed);
        EXPECT_EQ(effects_of(found), std::vector<std::string>{"call_overhead"}) << other;
        EXPECT_NEAR(found.steps[0].parameters.at("cycles"), 30.0, std::fabs(other));
    }
}

// Counters are whole: rows that all say the same tell a number to half a cycle, not exactly.
TEST(Cycles, NoIntervalIsOfZeroWidth) {
    const auto interval = [](const std::string& effect, const std::string& number, const auto& change) {
        const Explanation found = diagnose("real", {}, change);
        for (const auto* steps : {&found.steps, &found.alternatives}) {
            for (const auto& step : *steps) {
                if (step.effect == effect) {
                    const gap::cycles::Interval range = step.interval.at(number);
                    EXPECT_LT(range.low, step.parameters.at(number)) << effect;
                    EXPECT_GT(range.high, step.parameters.at(number)) << effect;
                    return range.high - range.low;
                }
            }
        }
        ADD_FAILURE() << effect << ": not found";
        return 0.0;
    };
    EXPECT_NEAR(interval("call_overhead", "cycles", [](const auto&, const auto& p) { return p.nominal + 60.0; }), 1.0,
                1e-9);
    EXPECT_LT(interval("clock_ratio", "ratio", [](const auto&, const auto& p) { return 0.5 * p.nominal; }), 0.1);
    EXPECT_LT(interval("clock_ratio", "ratio", [](const auto&, const auto& p) { return 1.25 * p.nominal; }), 0.1);
    EXPECT_LT(interval("bus_contention", "share",
                       [](const auto& row, const auto& p) { return p.nominal * (row.data == "axi" ? 1.3 : 1.0); }),
              0.1);
    EXPECT_LT(
        interval("load_bank_conflict", "factor",
                 [](const auto&, const auto& p) {
                     return p.nominal +
                            0.4 * static_cast<double>(p.half_cycles[timing::index(timing::Effect::load_bank_conflict)]);
                 }),
        0.2);
}

// One clock for all rows is none that leaves a kernel's slope far off: another core has other costs of its
// instructions.
TEST(Cycles, ACauseThatLeavesAKernelsSlopeIsNone) {
    const Explanation found = diagnose("real", {}, [](const auto& row, const auto& p) {
        return (row.kernel == "mirror_multi_q15" ? 2.2 : 2.0) * p.nominal;
    });
    EXPECT_EQ(found.outcome, Outcome::unknown);
    EXPECT_THAT(found.notes, testing::Contains(testing::HasSubstr("mirror_multi_q15")));
}

// A call costs something beside the kernel, or nothing.
TEST(Cycles, ACostBelowNothingIsNone) {
    const Explanation found =
        diagnose("real", {}, [](const auto&, const auto& p) { return std::max(1.0, 2.0 * p.nominal - 40.0); });
    EXPECT_EQ(found.outcome, Outcome::unknown);
    EXPECT_THAT(found.notes, testing::Contains(testing::HasSubstr("none costs less than nothing")));
}

TEST(Cycles, WhatOnlyRowsOnTheBusLoseIsContention) {
    const Explanation found = diagnose(
        "real", {}, [](const auto& row, const auto& p) { return p.nominal * (row.data == "axi" ? 1.3 : 1.0); });
    EXPECT_EQ(found.outcome, Outcome::attributed);
    ASSERT_EQ(effects_of(found), std::vector<std::string>{"bus_contention"});
    EXPECT_NEAR(found.steps[0].parameters.at("share"), 0.3, 0.005);
    EXPECT_LT(found.after_gap, 0.003);
}

TEST(Cycles, WhatNoEffectDoesIsUnknown) {
    const Explanation found =
        diagnose("real", {}, [](const auto& row, const auto& p) { return p.nominal + 1.5e-2 * row.taps * row.taps; });
    EXPECT_EQ(found.outcome, Outcome::unknown);
}

TEST(Cycles, AClockAndASwitchAtOnceAreParted) {
    for (const char* effect : {"single_issue", "store_buffer", "load_bank_conflict"}) {
        for (const double ratio : {0.8, 1.3}) {
            const Explanation found =
                diagnose("real", {effect}, [&](const auto&, const auto& p) { return ratio * p.nominal; });
            std::vector<std::string> both{"clock_ratio", effect};
            std::sort(both.begin(), both.end());
            EXPECT_TRUE(names(found, {.kind = "two", .effects = both}))
                << effect << ' ' << ratio << ' ' << name_of(found.outcome);
            EXPECT_EQ(found.outcome, ratio > 1.0 ? Outcome::ambiguous : Outcome::attributed);
        }
    }
}

}  // namespace
