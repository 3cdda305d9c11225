// What is asked and answered: what cannot be asked is refused; errors are of the records here, costs of a board.
#include "bench/choose/question.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <utility>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "bench/sweep/designs.hpp"
#include "glsum/design/modes.hpp"
#include "glsum/registry.hpp"
#include "tests/choose/pretend_board.hpp"
#include "tests/choose/small_question.hpp"
#include "tests/refusal.hpp"

namespace {

using choose::MeasuredErrors;
using choose::Question;

TEST(Question, LimitsThatDoNotSuitTheTargetAreRefused) {
    const auto ask = [](choose::Target target, const char* core, bool cycles, bool instructions) {
        Question question = test::small_question();
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
    EXPECT_NE(test::refusal(glsum::Exit::bad_input, ask(Target::host, "", false, true)).find("only with --target m7"),
              std::string::npos);
    EXPECT_NE(test::refusal(glsum::Exit::bad_input, ask(Target::m7, "m7-ideal", false, true)).find("with --core use"),
              std::string::npos);
    EXPECT_NE(
        test::refusal(glsum::Exit::bad_input, ask(Target::m7, "", true, false)).find("only instructions are counted"),
        std::string::npos);
    for (const auto& well : {ask(Target::m7, "", false, true), ask(Target::m7, "m7-ideal", true, false),
                             ask(Target::m7, "", false, false), ask(Target::m7, "m7-ideal", false, false)}) {
        EXPECT_NE(test::refusal(glsum::Exit::missing, well).find("the emulated board is needed"), std::string::npos);
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
    Question question = test::small_question();
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
    EXPECT_NE(test::refusal(glsum::Exit::bad_input,
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
    Question question = test::small_question();
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
    Question question = test::small_question();
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

TEST(Question, OnTheHostTimesAreTakenInThisRunAlone) {
    Question question = test::small_question();
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
