// What a choice is measured with: errors are bench's own, costs of an earlier run are taken as they are, what cannot be
// asked is refused, and the search agrees with a plain loop over real kernels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "bench/choose/brute_force.hpp"
#include "bench/choose/earlier.hpp"
#include "bench/choose/question.hpp"
#include "bench/rows/key.hpp"
#include "bench/sweep/accuracy.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/host_line.hpp"
#include "glsum/bound.hpp"
#include "glsum/design/modes.hpp"
#include "glsum/registry.hpp"
#include "tests/choose/pretend_board.hpp"

namespace {

using choose::MeasuredErrors;
using choose::Question;

constexpr std::size_t samples = 150;
const std::vector<std::string> signals = {"step", "sine50", "noise"};

choose::Conditions conditions(double order = 0.5) { return {order, 1e-3, signals, samples, 2020}; }

// error_max and truncation_error_max of bench's rows, by signal.
std::map<std::string, std::pair<double, double>> rows_of(const std::string& kernel, std::size_t taps) {
    bench::Sweep sweep;
    sweep.kernels = {kernel};
    sweep.orders = {0.5};
    sweep.signals = signals;
    sweep.samples = samples;
    const bench::Length length = bench::length_of(kernel, 0.5, taps, samples);
    sweep.lengths = {length.blocks ? bench::Length{taps} : length};
    std::map<std::string, std::pair<double, double>> found;
    for (const auto& rows : bench::measure_accuracy(sweep, {0, 1, 2})) {
        for (const bench::Json& row : rows) {
            found[bench::parse_key(row.at("name").get<std::string>()).value().signal] = {
                row.at("error_max").get<double>(), row.at("truncation_error_max").get<double>()};
        }
    }
    return found;
}

TEST(MeasuredErrors, AreTheBitsOfBenchsRowsAndTheWorstSignals) {
    MeasuredErrors errors(0.5, choose::make_records(conditions(), 1));
    EXPECT_EQ(errors.longest(), samples);
    std::size_t asked = 0;
    for (const char* kernel :
         {"ring_plain_f32", "ring_plain_q15", "mirrorhold_plain_f32", "nested_plain_f32", "modes_plain_f32"}) {
        for (const std::size_t taps : {2U, 20U}) {
            const choose::ErrorAt at = errors.error(kernel, taps);
            const auto rows = rows_of(kernel, taps);
            ASSERT_EQ(rows.size(), signals.size()) << kernel;
            const auto worst = std::max_element(
                rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.second.first < b.second.first; });
            EXPECT_EQ(at.error, worst->second.first) << kernel << ' ' << taps;
            EXPECT_EQ(at.signal, worst->first) << kernel << ' ' << taps;
            EXPECT_EQ(at.fault, "");
            EXPECT_EQ(errors.measured(), asked += signals.size());
            // What is known is not measured again, whichever way it is asked.
            EXPECT_TRUE(errors.meets(kernel, taps, at.error));
            EXPECT_FALSE(errors.meets(kernel, taps, at.error * (1.0 - 1e-12)));
            EXPECT_EQ(errors.error(kernel, taps).error, at.error);
            EXPECT_EQ(errors.measured(), asked);
        }
    }
}

TEST(MeasuredErrors, MeetALimitOnlyWithEverySignal) {
    const auto records = choose::make_records(conditions(), 2);
    for (const std::size_t taps : {3U, 30U}) {
        const double error = MeasuredErrors(0.5, records).error("ring_plain_f32", taps).error;
        MeasuredErrors above(0.5, records);
        EXPECT_TRUE(above.meets("ring_plain_f32", taps, error));
        EXPECT_EQ(above.measured(), signals.size());
        MeasuredErrors below(0.5, records);
        EXPECT_FALSE(below.meets("ring_plain_f32", taps, error * (1.0 - 1e-12)));
        // A failure ends the question: nothing may be left of it that passes for an answer.
        EXPECT_EQ(below.error("ring_plain_f32", taps).error, error);
    }
    // The signal that truncation hits hardest is asked first, and is enough to say no.
    MeasuredErrors first(0.5, records);
    EXPECT_FALSE(first.meets("ring_plain_f32", 3, 1e-6));
    EXPECT_EQ(first.measured(), 1U);
}

TEST(MeasuredErrors, RecordsHaveTheirPeakAndWhatEachWindowLeavesOut) {
    const auto records = choose::make_records(conditions(), 1);
    ASSERT_EQ(records.size(), signals.size());
    // The first sum of a step of order 0.5 is its largest: all later weights take away.
    EXPECT_EQ(records[0].peak, 0.9);
    MeasuredErrors errors(0.5, records);
    for (const std::size_t taps : {1U, 2U, 17U, 149U}) {
        double worst = 0.0;
        const auto rows = rows_of("shift_plain_f64", taps);
        for (const choose::Record& record : records) {
            EXPECT_NEAR(record.truncation.at(taps - 1), rows.at(record.signal).second, 1e-12) << taps;
            worst = std::max(worst, record.truncation.at(taps - 1));
        }
        EXPECT_EQ(errors.truncation(taps), worst);
    }
    EXPECT_EQ(errors.truncation(samples), 0.0);
    // No window leaves anything out of the sum of an impulse-free zero order, whose only weight is a_0.
    EXPECT_EQ(choose::make_records(conditions(0.0), 1)[2].truncation, std::vector<double>(samples, 0.0));
}

TEST(MeasuredErrors, RoundingIsWithinItsBound) {
    MeasuredErrors errors(0.5, choose::make_records(conditions(), 1));
    for (const char* kernel : {"ring_plain_f32", "mirror_multi_f32", "ring_plain_q15"}) {
        for (const std::size_t taps : {2U, 60U}) {
            const double bound = errors.rounding_bound(kernel, taps);
            EXPECT_LE(std::fabs(errors.error(kernel, taps).error - errors.truncation(taps)), bound) << kernel;
            EXPECT_LT(bound, 0.1) << kernel;
        }
    }
    // The kernel's own bound, relative to the smallest peak.
    double least = 1.0;
    for (const choose::Record& record : choose::make_records(conditions(), 1)) {
        least = std::min(least, record.peak);
    }
    using K = glsum::Sum<glsum::Ring, glsum::Plain, glsum::F32>;
    const glsum::Design design{0.5, 60};
    bench::HostLine<K> line(design);
    EXPECT_EQ(errors.rounding_bound("ring_plain_f32", 60),
              glsum::error_bound<K>(design, line.state(), 0.9, samples) / least);
    EXPECT_TRUE(std::isinf(errors.rounding_bound("null", 60)));
    EXPECT_THROW((void)errors.rounding_bound("no_kernel", 2), std::out_of_range);
}

TEST(MeasuredErrors, LengthsAreAsTheDesignsAre) {
    choose::Conditions longer = conditions();
    longer.samples = 1000;
    longer.signals = {"step"};
    const MeasuredErrors errors(0.5, choose::make_records(longer, 1));
    EXPECT_FALSE(errors.lengths("ring_plain_f32"));
    EXPECT_EQ(errors.longest_of("ring_plain_f32"), 1000U);
    // Every length to 128, then each an eighth longer than the last.
    for (const char* kernel : {"nested_plain_f32", "mirrorhold_plain_f32"}) {
        const auto rungs = errors.lengths(kernel).value();
        for (std::size_t i = 0; i < 128; ++i) {
            ASSERT_EQ(rungs.at(i), i + 1) << kernel;
        }
        EXPECT_EQ((std::vector<std::size_t>(rungs.begin() + 128, rungs.end())),
                  (std::vector<std::size_t>{144, 162, 182, 204, 229, 257, 289, 325, 365, 410, 461, 518, 582, 654, 735,
                                            826, 929, 1000}))
            << kernel;
    }
    const auto modes = errors.lengths("modes_plain_f32").value();
    EXPECT_EQ(modes.size(), std::min<std::size_t>(1000, glsum::design::most_taps(0.5)));
    EXPECT_EQ(modes.front(), 1U);
    EXPECT_EQ(modes.back(), modes.size());
    EXPECT_EQ(errors.lengths("modesdelta_plain_f32").value().size(),
              std::min<std::size_t>(1000, glsum::design::most_taps(-0.5)));
}

TEST(MeasuredErrors, WhatAnotherRunMeasuredIsTakenSignalBySignal) {
    MeasuredErrors errors(0.5, choose::make_records(conditions(), 1));
    errors.remember("ring_plain_f32", 7, "step", 0.25);
    errors.remember("ring_plain_f32", 7, "sine50", 0.0);
    errors.remember("ring_plain_f32", 7, "noise", 0.125);
    errors.remember("ring_plain_f32", 7, "ramp", 0.5);  // not asked for
    EXPECT_TRUE(errors.meets("ring_plain_f32", 7, 0.25));
    EXPECT_EQ(errors.error("ring_plain_f32", 7).error, 0.25);
    EXPECT_EQ(errors.error("ring_plain_f32", 7).signal, "step");
    EXPECT_EQ(errors.remembered(), 3U);
    EXPECT_EQ(errors.measured(), 0U);
    errors.remember("ring_plain_f32", 8, "noise", 0.75);
    EXPECT_EQ(errors.error("ring_plain_f32", 8).error, 0.75);
    EXPECT_EQ(errors.remembered(), 4U);
    EXPECT_EQ(errors.measured(), 2U);
}

TEST(MeasuredErrors, AKernelThatRefusesHasAFaultAndNoError) {
    MeasuredErrors errors(-1.5, choose::make_records(conditions(-1.5), 1));
    const choose::ErrorAt at = errors.error("mirrordelta_plain_f32", 20);  // takes orders above -1
    EXPECT_EQ(at.fault, "the order is not in (-2, 2]");
    EXPECT_FALSE(std::isfinite(at.error));
    EXPECT_FALSE(errors.meets("mirrordelta_plain_f32", 20, 1e300));
    EXPECT_TRUE(std::isinf(errors.rounding_bound("mirrordelta_plain_f32", 20)));
}

// Costs that rise with the length, as code does that goes tap by tap; one kernel's are a bargain far behind.
class PretendCosts : public choose::CostSource {
public:
    explicit PretendCosts(bool bargains) : bargains_(bargains) {}
    [[nodiscard]] std::string unit() const override { return "instructions"; }
    [[nodiscard]] std::string limited_unit() const override { return "instructions"; }
    [[nodiscard]] bool exact() const override { return true; }
    [[nodiscard]] std::vector<choose::Cost> costs(const std::vector<choose::Case>& cases) override {
        std::vector<choose::Cost> found;
        for (const auto& [kernel, taps] : cases) {
            choose::Cost cost;
            const double per_tap = 3.0 + static_cast<double>(kernel.size() % 5);
            cost.value = cost.limited = 10.0 + per_tap * static_cast<double>(taps);
            cost.value = cost.limited = bargains_ && taps > 40 ? 1.0 : cost.value;
            cost.bytes = 8.0 * static_cast<double>(taps);
            found.push_back(cost);
        }
        return found;
    }

private:
    bool bargains_;
};

Question small() {
    Question question;
    question.conditions = {0.5, 1e-3, {"step", "noise"}, 60, 2020};
    question.kernels = {"ring_plain_f32", "ring_plain_q15", "mirrorhold_plain_f32", "nested_plain_f32",
                        "modes_plain_f32"};
    return question;
}

TEST(BruteForce, TheSearchAgreesOnRealKernels) {
    PretendCosts costs(false);
    const choose::Agreement found = choose::check_against_brute_force(small(), costs, 120, 3);
    EXPECT_EQ(found.budgets, 120U);
    EXPECT_EQ(found.same, 120U) << found.differences;
    EXPECT_EQ(found.differences, "");
    EXPECT_EQ(found.same_miss, found.nothing);
    EXPECT_GT(found.nothing, 3U);
    EXPECT_LT(found.nothing, 90U);
    const std::size_t of_modes = std::min<std::size_t>(60, glsum::design::most_taps(0.5));
    EXPECT_EQ(found.candidates, 4 * 60 + of_modes);
}

// The search may only expect costs to rise, but for the rest of a group: where they do not, the check must say so.
TEST(BruteForce, ADifferenceIsSeenAndNamed) {
    PretendCosts costs(true);
    const choose::Agreement found = choose::check_against_brute_force(small(), costs, 60, 3);
    EXPECT_EQ(found.budgets, 60U);
    EXPECT_LT(found.same, 60U);
    EXPECT_EQ(static_cast<std::size_t>(std::count(found.differences.begin(), found.differences.end(), '\n')),
              60U - found.same);
    EXPECT_NE(found.differences.find("the search has "), std::string::npos) << found.differences;
}

template <class Ask>
std::string refusal(glsum::Exit status, Ask ask) {
    try {
        ask();
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), status) << failure.what();
        return failure.what();
    }
    ADD_FAILURE() << "nothing was refused";
    return "";
}

TEST(Question, LimitsThatDoNotSuitTheTargetAreRefused) {
    const auto ask = [](choose::Target target, const char* core, bool cycles, bool instructions) {
        Question question = small();
        question.target = target;
        question.core = core;
        question.max_error = 0.1;
        if (cycles) {
            question.max_cycles = 100.0;
        }
        if (instructions) {
            question.max_instructions = 100.0;
        }
        return [question] { (void)choose::answer(question, std::nullopt); };
    };
    using choose::Target;
    EXPECT_NE(refusal(glsum::Exit::bad_input, ask(Target::host, "", false, true)).find("only with --target m7"),
              std::string::npos);
    EXPECT_NE(refusal(glsum::Exit::bad_input, ask(Target::m7, "m7-ideal", false, true)).find("with --core use"),
              std::string::npos);
    EXPECT_NE(refusal(glsum::Exit::bad_input, ask(Target::m7, "", true, false)).find("only instructions are counted"),
              std::string::npos);
    for (const auto& well : {ask(Target::m7, "", false, true), ask(Target::m7, "m7-ideal", true, false),
                             ask(Target::m7, "", false, false), ask(Target::m7, "m7-ideal", false, false)}) {
        EXPECT_NE(refusal(glsum::Exit::missing, well).find("the emulated board is needed"), std::string::npos);
    }
}

TEST(Question, KernelsAreThoseThatRunThere) {
    const auto host = choose::kernels_of(choose::Target::host, 0.5);
    const auto m7 = choose::kernels_of(choose::Target::m7, 0.5);
    const auto integral = choose::kernels_of(choose::Target::m7, -0.5);
    std::set<std::string> of_host;
    std::set<std::string> of_m7;
    std::set<std::string> of_integrals;
    glsum::Registry::for_each([&]<class K>() {
        const std::string name(K::name());
        if (name == "null") {
            return;
        }
        const bool integrates = bench::has_integrator(name);
        if (!integrates) {
            of_host.insert(name);
        }
        if (!integrates && !K::host_only) {
            of_m7.insert(name);
        }
        if (!K::host_only) {
            of_integrals.insert(name);
        }
    });
    EXPECT_EQ(std::set<std::string>(host.begin(), host.end()), of_host);
    EXPECT_EQ(std::set<std::string>(m7.begin(), m7.end()), of_m7);
    EXPECT_EQ(std::set<std::string>(integral.begin(), integral.end()), of_integrals);
    EXPECT_LT(of_m7.size(), of_host.size());
    EXPECT_LT(of_m7.size(), of_integrals.size());
}

TEST(Question, OneKernelWithoutABoardHasItsErrorAndNoCost) {
    Question question = small();
    for (const char* core : {"", "m7-ideal"}) {
        question.core = core;
        const choose::Answer one = choose::measure_one(question, "ring_plain_f32", 20, std::nullopt);
        ASSERT_TRUE(one.choice.chosen);
        EXPECT_EQ(one.choice.chosen->kernel, "ring_plain_f32");
        EXPECT_EQ(one.choice.chosen->taps, 20U);
        EXPECT_EQ(one.choice.chosen->cost.fault, "the emulated board was not found");
        MeasuredErrors errors(0.5, choose::make_records(question.conditions, 1));
        EXPECT_EQ(one.choice.chosen->error.error, errors.error("ring_plain_f32", 20).error);
        EXPECT_EQ(one.unit, *core == '\0' ? "instructions" : "model cycles");
        EXPECT_EQ(one.limited_unit, one.unit);
        // The conditions are those that were asked for.
        EXPECT_EQ(one.context.at("executable"), "glsum choose");
        EXPECT_EQ(one.context.at("step_s"), 1e-3);
        EXPECT_EQ(one.context.at("n_samples"), 60);
        EXPECT_EQ(one.context.at("seed"), 2020);
        EXPECT_EQ(one.context.at("core_file"), "none");
        EXPECT_EQ(one.context.at("sweep").at("kernels"), bench::Json(question.kernels));
        EXPECT_EQ(one.context.at("sweep").at("orders"), bench::Json({0.5}));
        EXPECT_EQ(one.context.at("sweep").at("signals"), bench::Json(question.conditions.signals));
        EXPECT_EQ(one.context.at("sweep").at("cores"),
                  *core == '\0' ? bench::Json({"count"}) : bench::Json({"m7-ideal"}));
    }
    question.conditions.order = -1.5;
    EXPECT_NE(refusal(glsum::Exit::bad_input,
                      [&] { (void)choose::measure_one(question, "mirrordelta_plain_f32", 20, std::nullopt); })
                  .find("mirrordelta_plain_f32 with 20 taps: the order is not in (-2, 2]"),
              std::string::npos);
}

TEST(Question, TargetsHaveTheirWords) {
    using choose::Target;
    for (const auto& [word, target] : {std::pair("host", Target::host), {"m7", Target::m7}, {"m4", Target::m4}}) {
        EXPECT_EQ(choose::target_called(word), target);
        EXPECT_EQ(choose::word_of(target), word);
    }
    EXPECT_FALSE(choose::target_called("m5"));
    EXPECT_EQ(choose::machine_of(Target::host), nullptr);
    EXPECT_EQ(choose::machine_of(Target::m4), &base::machines[1]);
}

// Errors of the records here, costs of a board that is pretended: where each tap costs as much, the shortest length
// that meets the error is chosen.
TEST(Question, IsAnsweredByErrorsHereAndCostsThere) {
    const test::PretendBoard pretended(0.5, 60, 2020);
    for (std::size_t taps = 1; taps <= 60; ++taps) {
        pretended.knows(taps);
    }
    const base::Scratch folder;
    std::ofstream(folder.file("qemu")) << "#!/bin/sh\necho QEMU emulator version 7.2.22\n";
    std::filesystem::permissions(folder.file("qemu"), std::filesystem::perms::owner_all);
    setenv("GLSUM_QEMU", folder.file("qemu").c_str(), 1);
    Question question = small();
    question.kernels = {"ring_plain_f32"};
    MeasuredErrors errors(0.5, choose::make_records(question.conditions, 1));
    question.max_error = errors.error("ring_plain_f32", 20).error;
    std::size_t shortest = 1;
    while (!errors.meets("ring_plain_f32", shortest, question.max_error)) {
        ++shortest;
    }
    for (const char* core : {"", "m7-ideal"}) {
        question.core = core;
        const double tap = *core == '\0' ? 10.0 : 20.0;
        const choose::Answer found = choose::answer(question, pretended.board());
        ASSERT_TRUE(found.choice.chosen);
        EXPECT_EQ(found.choice.chosen->taps, shortest);
        EXPECT_DOUBLE_EQ(found.choice.chosen->cost.value, tap * static_cast<double>(shortest));
        EXPECT_EQ(found.unit, *core == '\0' ? "instructions" : "model cycles");
        EXPECT_EQ(found.limited_unit, *core == '\0' ? "instructions" : "model cycles, upper end of the band");
        ASSERT_EQ(found.notes.size(), 3U);
        EXPECT_EQ(found.notes[1], *core == '\0' ? "counted on the emulated Cortex-M7; instructions are not cycles"
                                                : "cycles: modelled for m7-ideal, on the emulated Cortex-M7");
        EXPECT_NE(found.notes[2].find(" costs measured, 0 taken from the file"), std::string::npos) << found.notes[2];
        EXPECT_EQ(found.context.at("qemu_version"), "QEMU emulator version 7.2.22");
        // Of one length alone, whatever the limits.
        const choose::Answer one = choose::measure_one(question, "ring_plain_f32", 7, pretended.board());
        ASSERT_TRUE(one.choice.chosen);
        EXPECT_DOUBLE_EQ(one.choice.chosen->cost.value, 7.0 * tap);
        EXPECT_DOUBLE_EQ(one.choice.chosen->cost.limited, *core == '\0' ? 70.0 : 168.0);
        EXPECT_EQ(one.choice.chosen->cost.fault, "");
        EXPECT_EQ(one.unit, found.unit);
        EXPECT_EQ(one.limited_unit, found.limited_unit);
    }
    unsetenv("GLSUM_QEMU");
}

// Of a derivative: kernels whose weights change from sample to sample hold no filter, and are said to be left out.
TEST(Question, OfADerivativeSaysWhichKernelsAreLeftOut) {
    Question question = small();
    question.target = choose::Target::host;
    question.goal = glsum::design::DerivativeGoal{0.5, 0.001, glsum::design::Band{0.5, 80.0}};
    question.by = choose::FilterDesign::oustaloup;
    question.max_error = 0.05;
    question.kernels = {"nested_plain_f32", "mirrorhold_plain_f32", "nested_plain_q31"};
    const choose::Answer found = choose::answer(question, std::nullopt);
    EXPECT_FALSE(found.choice.chosen);
    EXPECT_TRUE(found.choice.kernels.empty());
    EXPECT_TRUE(found.would_do.empty());
    const auto says = [&](const std::string& what) {
        return std::count_if(found.notes.begin(), found.notes.end(),
                             [&](const std::string& note) { return note.starts_with(what); });
    };
    EXPECT_EQ(says("left out, since its blocks' weights change from sample to sample: nested_plain_f32, "
                   "nested_plain_q31"),
              1);
    EXPECT_EQ(says("left out, since the weights of its guessed tail change with the record: mirrorhold_plain_f32"), 1);
    EXPECT_EQ(says(std::string("errors: of ") + choose::text_of(question.by) + " for each length"), 1);
    EXPECT_EQ(says("host times: taken in this run alone"), 1);
}

bench::Json row(const std::string& name, std::initializer_list<std::pair<const char*, double>> fields) {
    bench::Json made = bench::make_row(name, 1);
    for (const auto& [field, value] : fields) {
        made[field] = value;
    }
    return made;
}

TEST(Earlier, ErrorsAreThoseOfTheOrderAndOfNothingElse) {
    choose::Earlier earlier;
    earlier.errors = true;
    earlier.rows = {
        row("gl/ring_plain_f32/order:0.5/taps:5/accuracy/signal:step", {{"error_max", 0.5}}),
        row("gl/ring_plain_f32/order:0.5/taps:5/accuracy/signal:sine50", {{"error_max", 0.25}}),
        row("gl/ring_plain_f32/order:0.5/taps:5/accuracy/signal:noise", {{"error_max", 0.125}}),
        row("gl/ring_plain_f32/order:0.9/taps:5/accuracy/signal:step", {{"error_max", 0.75}}),
        row("gl/ring_plain_f32/order:0.5/taps:5/accuracy/signal:step/amplitude:0.0625", {{"error_max", 0.875}}),
        row("gl/ring_plain_f32/order:0.5/taps:5/host", {{"error_max", 0.875}}),
        row("gl/ring_plain_f32/order:0.5/taps:500/accuracy/signal:step", {{"error_max", 0.875}}),
        row("gl/modes_plain_f32/order:0.5/taps:9+1/accuracy/signal:step", {{"error_max", 0.875}})};
    bench::Json wrong = row("gl/ring_plain_f32/order:0.5/taps:5/accuracy/signal:step", {{"error_max", 0.875}});
    bench::mark_error(wrong, "wrong");
    earlier.rows.push_back(wrong);
    bench::Json mean = row("gl/ring_plain_f32/order:0.5/taps:5/accuracy/signal:step", {{"error_max", 0.875}});
    mean["run_type"] = "aggregate";
    earlier.rows.push_back(mean);
    Question question;
    question.conditions = conditions();
    MeasuredErrors errors(0.5, choose::make_records(conditions(), 1));
    choose::remember(earlier, question, errors);
    EXPECT_EQ(errors.error("ring_plain_f32", 5).error, 0.5);
    EXPECT_EQ(errors.measured(), 0U);
    earlier.errors = false;
    MeasuredErrors fresh(0.5, choose::make_records(conditions(), 1));
    choose::remember(earlier, question, fresh);
    EXPECT_NE(fresh.error("ring_plain_f32", 5).error, 0.5);
    EXPECT_EQ(fresh.remembered(), 0U);
}

// No board is needed for costs that another run of the same firmware has.
TEST(Earlier, CostsOfTheTargetAreItsCyclesBandAndBytes) {
    choose::Earlier earlier;
    earlier.on_target = true;
    bench::Json of_double = row("gl/shift_plain_f64/order:0.5/taps:5/m7:m7-ideal", {{"model_cycles_per_sample", 900.0},
                                                                                    {"model_cycles_high", 950.0},
                                                                                    {"instructions_per_sample", 1800.0},
                                                                                    {"state_bytes", 40.0},
                                                                                    {"coefficient_bytes", 32.0}});
    of_double["counted_at_order"] = 0.5;
    bench::Json elsewhere = of_double;
    elsewhere["name"] = "gl/shift_plain_f64/order:0.5/taps:6/m7:m7-ideal";
    elsewhere["counted_at_order"] = 0.9;
    earlier.rows = {
        row("gl/ring_plain_f32/order:0.5/taps:5/m7:m7-ideal", {{"model_cycles_per_sample", 30.0},
                                                               {"model_cycles_high", 33.0},
                                                               {"instructions_per_sample", 61.0},
                                                               {"state_bytes", 28.0},
                                                               {"coefficient_bytes", 16.0}}),
        row("gl/ring_plain_f32/order:0.5/taps:7/m7:m7-ideal",
            {{"model_cycles_per_sample", 30.0}, {"instructions_per_sample", 61.0}}),
        row("gl/ring_plain_f32/order:0.5/taps:7/m7:another-core",
            {{"model_cycles_per_sample", 70.0}, {"model_cycles_high", 73.0}, {"instructions_per_sample", 81.0}}),
        of_double, elsewhere};
    Question question;
    question.conditions = conditions();
    qemu::Board board;
    board.cores = TEST_CORES;
    const auto taken = [&](const std::string& core) {
        question.core = core;
        choose::OnTarget costs(board, 0.5, samples, 2020, 1, core);
        choose::remember(earlier, question, costs);
        const std::vector<choose::Cost> found = costs.costs({{"ring_plain_f32", 5}, {"shift_plain_f64", 5}});
        EXPECT_EQ(costs.remembered(), 2U);
        EXPECT_EQ(costs.measured(), 0U);
        EXPECT_EQ(costs.costs({{"ring_plain_f32", 5}}).front().value, found[0].value);
        EXPECT_EQ(costs.remembered(), 2U);
        // Software double's other order is not taken, nor a row without its band: both would have to be measured.
        EXPECT_ANY_THROW((void)costs.costs({{"shift_plain_f64", 6}}));
        return found;
    };
    const auto modelled = taken("m7-ideal");
    EXPECT_EQ(modelled[0].value, 30.0);
    EXPECT_EQ(modelled[0].limited, 33.0);
    EXPECT_EQ(modelled[0].bytes, 44.0);
    EXPECT_EQ(modelled[0].noise, 0.0);
    EXPECT_EQ(modelled[1].value, 900.0);
    EXPECT_EQ(modelled[1].limited, 950.0);
    const auto counted = taken("");
    EXPECT_EQ(counted[0].value, 61.0);
    EXPECT_EQ(counted[0].limited, 61.0);
    EXPECT_EQ(counted[1].bytes, 72.0);
    choose::OnTarget cycles(board, 0.5, samples, 2020, 1, "m7-ideal");
    EXPECT_EQ(cycles.unit(), "model cycles");
    EXPECT_EQ(cycles.limited_unit(), "model cycles, upper end of the band");
    EXPECT_TRUE(cycles.exact());
    EXPECT_TRUE(cycles.costly("shift_plain_f64"));
    EXPECT_FALSE(cycles.costly("shift_plain_f32"));
    question.core = "m7-ideal";
    choose::remember(earlier, question, cycles);
    EXPECT_ANY_THROW((void)cycles.costs({{"ring_plain_f32", 7}}));
    choose::OnTarget counts(board, 0.5, samples, 2020, 1);
    EXPECT_EQ(counts.unit(), "instructions");
    EXPECT_EQ(counts.limited_unit(), "instructions");
    earlier.on_target = false;
    choose::remember(earlier, question, counts);
    EXPECT_ANY_THROW((void)counts.costs({{"ring_plain_f32", 5}}));
}

// Of nine repetitions the median, half of what the middle half spans, and the cycles' median, whatever their order.
TEST(HostTimes, AreTheMedianOfTheirRepetitions) {
    const std::string name = "gl/ring_plain_f32/order:0.5/taps:50/host";
    std::vector<bench::Json> rows;
    for (const double ns : {50.0, 10.0, 20.0, 40.0, 90.0, 30.0, 60.0, 80.0, 70.0}) {
        rows.push_back(row(name, {{"real_time", ns},
                                  {"cycles_per_sample", 1000.0 - ns},
                                  {"state_bytes", 200.0},
                                  {"coefficient_bytes", 196.0}}));
    }
    bench::Json mean = row(name, {{"real_time", 1e6}, {"cycles_per_sample", 1e6}});
    mean["run_type"] = "aggregate";
    rows.push_back(mean);
    rows.push_back(row("gl/ring_plain_f32/order:0.5/taps:51/host", {{"real_time", 1.0}}));
    for (bench::Json& one : rows) {
        one["run_name"] = one["name"];
    }
    const choose::Cost cost = choose::cost_of_times(rows, name);
    EXPECT_EQ(cost.value, 50.0);
    EXPECT_EQ(cost.noise, 20.0);  // from 30 to 70
    EXPECT_EQ(cost.limited, 950.0);
    EXPECT_EQ(cost.bytes, 396.0);
    EXPECT_EQ(cost.fault, "");
    // Between two values in proportion.
    const choose::Cost two = choose::cost_of_times({rows[0], rows[1]}, name);  // 50 and 10
    EXPECT_EQ(two.value, 30.0);
    EXPECT_EQ(two.noise, 10.0);  // 20 to 40
    EXPECT_EQ(choose::cost_of_times({}, name).fault, "not timed");
    bench::mark_error(rows[3], "wrong answer");
    EXPECT_EQ(choose::cost_of_times({rows[3]}, name).fault, "wrong answer");
    EXPECT_EQ(choose::cost_of_times({rows[0], rows[3]}, name).fault, "wrong answer");
}

TEST(Question, OnTheHostTimesAreTakenInThisRunAlone) {
    Question question = small();
    question.target = choose::Target::host;
    question.kernels = {"ring_plain_f32", "shift_plain_f32"};
    question.max_error = 0.5;
    question.max_bytes = 1e6;
    const choose::Answer found = choose::answer(question, std::nullopt);
    ASSERT_TRUE(found.choice.chosen);
    EXPECT_LE(found.choice.chosen->error.error, 0.5);
    EXPECT_GT(found.choice.chosen->cost.value, 0.0);
    EXPECT_GT(found.choice.chosen->cost.bytes, 0.0);
    EXPECT_GE(found.choice.chosen->cost.noise, 0.0);
    EXPECT_EQ(found.unit, "ns");
    EXPECT_EQ(found.limited_unit, "cycles");
    ASSERT_EQ(found.notes.size(), 4U);
    EXPECT_EQ(found.notes[1],
              "host times: taken in this run alone, 9 interleaved repetitions of each candidate, never of a file");
    EXPECT_NE(found.notes[2].find(", 0 errors taken from the file"), std::string::npos) << found.notes[2];
    EXPECT_TRUE(found.notes[3].starts_with("host cycles: ")) << found.notes[3];
    EXPECT_NE(found.notes[3].find("cycles", 12), std::string::npos) << found.notes[3];
    EXPECT_TRUE(choose::HostTimes(0.5, 60).costs({}).empty());
    EXPECT_FALSE(choose::HostTimes(0.5, 60).exact());
    question.max_bytes = 1.0;
    EXPECT_FALSE(choose::answer(question, std::nullopt).choice.chosen);
    question.max_cycles = 1e-9;
    question.max_bytes.reset();
    EXPECT_FALSE(choose::answer(question, std::nullopt).choice.chosen);
}

}  // namespace
