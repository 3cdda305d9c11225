// The rules of the Cortex-M4, each on a few instructions whose cycles were derived by hand. The names are those of the
// figures in qemu/cores/_cortex-m4.toml that decide them.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "probe.hpp"
#include "qemu/timing/cortex_m4/pipeline.hpp"

namespace {

using probe::How;
using probe::lines_of;

struct Probe {
    const char* rule;
    const char* text;  // lines parted by ";"
    double cycles;
    How how = How::copies;
    const char* core = "cortex-m4-zerowait";
};

// Where a copy is followed by the next one, the answer counts both.
constexpr Probe probes[] = {
    // One instruction a cycle, in order, whatever it needs of the one before.
    {"single", "add.w r0,r1,r2; eor.w r3,r4,r5", 2},
    {"single", "eor.w r0,r0,r1,lsl #2; eor.w r0,r0,r2,ror #7", 2},
    {"single", "uxtb.w r0,r1; ssat r0,#16,r0; sadd16 r0,r0,r1", 3},
    {"single", "mul r0,r0,r1; smlad r0,r0,r2,r0; smlal r0,r3,r1,r0; smmlar r0,r0,r1,r2", 4},
    {"single", "cmp.w r0,r1; adc.w r2,r3,r4", 2},
    {"single", "nop", 1},
    // takes
    {"takes.multiply_accumulate", "mla r0,r1,r2,r0", 1},
    {"takes.divide", "sdiv r0,r1,r2; add.w r3,r0,r4", 7},
    {"takes.system", "mrs r0,primask; add.w r1,r2,r3", 3},
    {"takes.multiple_first", "ldm r0,{r1,r2,r3,r4}; eor.w r5,r6,r7", 6},
    {"takes.multiple_first", "stm r0,{r1,r2,r3}", 4},
    {"takes.multiple_first", "ldrd r1,r2,[r0]", 3},
    {"takes.multiple_first", "strd r1,r2,[r0]", 3},
    {"takes.multiple_first", "vldm r0,{s0-s7}", 9},
    {"takes.multiple_first", "vldm r0,{s0}; eor.w r5,r6,r7", 3},  // of one, too
    {"takes.multiple_first", "vldm r0,{s0-s31}", 33},             // as many as there are
    {"takes.multiple_first", "vpush {s0-s3}; vpop {s0-s3}", 10},
    {"takes.fp_mac", "vfma.f32 s0,s1,s2", 3},
    {"takes.fp_mac", "vmla.f32 s0,s1,s2; vmla.f32 s3,s4,s5", 6},
    {"takes.fp_mac_of_core", "vfma.f32 s0,s1,s2; add.w r0,r1,r2", 4},
    {"takes.fp_divide", "vdiv.f32 s0,s1,s2", 14},
    {"takes.fp_divide", "vdiv.f32 s0,s1,s2; add.w r0,r1,r2; add.w r3,r4,r5", 14},  // they complete beside it
    {"takes.fp_divide", "vdiv.f32 s0,s1,s2; vldr s3,[r0]", 16},
    {"takes.fp_sqrt", "vsqrt.f32 s0,s1", 14},
    {"takes.fp_transfer", "vmov s0,r0; vmov r1,s0", 2},
    {"takes.fp_two_transfers", "vmov s0,s1,r0,r1", 2},
    {"takes.fp_store_extra", "vstr s0,[r0]", 1},
    {"takes.indexed_store_extra", "str.w r0,[r1,r2]; add.w r3,r4,r5", 3},
    {"takes.indexed_store_extra", "str.w r0,[r1,r2]; nop", 2},
    {"takes.if_then_folds", "adds r0,r0,r1; it eq; addeq r2,r2,r3; adds r4,r4,r5", 3},
    {"takes.if_then_folds", "adds.w r0,r0,r1; it eq; addeq.w r2,r2,r3", 3},  // not behind a wide one
    // use
    {"use.address_ahead", "add.w r1,r1,r2; ldr.w r0,[r1]; add.w r3,r4,r5", 5},
    {"use.address_ahead", "add.w r1,r1,r2; add.w r3,r4,r5; ldr.w r0,[r1]; add.w r6,r4,r5", 5},
    {"use.address_ahead", "add.w r1,r1,r2; str.w r0,[r1]", 3},
    {"use.address_ahead", "add.w r0,r1,r2; str.w r0,[r3]", 2},  // what is stored is no address
    {"use.address_ahead", "ldr r0,[r1],#4; ldr r2,[r1],#4", 4},
    {"use.address_ahead", "ldr r0,[r1],#4; ldr r2,[r3],#4; add.w r4,r5,r6", 4},  // alternating bases chain
    {"use.loaded_address_ahead", "ldr.w r0,[r0]", 3},
    {"use.loaded_address_ahead", "ldr.w r0,[r1]; add.w r0,r0,r2", 3},
    {"use.fp_next", "vadd.f32 s0,s0,s1", 2},
    {"use.fp_next", "vmul.f32 s0,s1,s2; vadd.f32 s3,s0,s4; nop.w", 4},
    {"use.fp_next", "vmul.f32 s0,s1,s2; nop.w; vadd.f32 s3,s0,s4; nop.w", 4},
    {"use.fp_next", "vadd.f32 s0,s1,s2; vstr s0,[r0]", 3},
    {"use.fp_next", "vneg.f32 s0,s1; vabs.f32 s0,s0", 2},
    {"use.fp_next", "vfma.f32 s0,s1,s2; vmul.f32 s3,s0,s4; nop.w", 6},
    {"use.fp_next_addend", "vmul.f32 s0,s1,s2; vfma.f32 s0,s3,s4", 4},
    {"use.fp_next_addend", "vfma.f32 s0,s1,s2; vfma.f32 s0,s3,s4", 6},
    // access
    {"access.load_wait", "ldr.w r0,[r1]; add.w r2,r3,r4", 3},
    {"access.load_wait", "ldr.w r0,[r1]; add.w r2,r0,r4", 3},
    {"access.load_pipelines", "ldr.w r0,[r1]; ldr.w r2,[r3]; ldrb.w r4,[r5]; add.w r6,r7,r8", 5},
    {"access.load_pipelines", "vldr s0,[r1]; vldr s1,[r1,#4]; vadd.f32 s2,s0,s1", 4},
    {"access.load_pipelines", "ldr.w r0,[r1]; ldm r2,{r3,r4}", 5},
    {"access.load_pipelines", "ldr.w r0,[pc,#16]; ldr.w r1,[r2]; add.w r3,r4,r5", 5},  // another block of memory
    {"access.load_pipelines", "ldr.w r0,[r1]; str.w r0,[r3]; add.w r4,r5,r6", 3},      // takes the load's wait away
    // What the kernels' own loops rest on (window/cortex-m/): four words of two pointers, and by LDM; four floats by
    // VLDM.
    {"access.load_pipelines",
     "ldr.w r4,[r3]; ldr.w r5,[r3,#4]; ldr.w r6,[r3,#8]; ldr.w r7,[r3,#12]; ldr.w r8,[r2]; ldr.w r9,[r2,#4]; "
     "ldr.w r10,[r2,#8]; ldr.w r11,[r2,#12]; smlald r0,r1,r4,r8; smlald r0,r1,r5,r9; smlald r0,r1,r6,r10; "
     "smlald r0,r1,r7,r11",
     13},
    {"takes.multiple_first",
     "ldm r3,{r4-r7}; ldm r2,{r8-r11}; smlald r0,r1,r4,r8; smlald r0,r1,r5,r9; smlald r0,r1,r6,r10; smlald "
     "r0,r1,r7,r11",
     14},
    {"takes.multiple_first",
     "vldm r1,{s4-s7}; vldm r2,{s8-s11}; vmul.f32 s4,s4,s8; vmul.f32 s5,s5,s9; vmul.f32 s6,s6,s10; vmul.f32 s7,s7,s11; "
     "vadd.f32 s0,s0,s4; vadd.f32 s1,s1,s5; vadd.f32 s2,s2,s6; vadd.f32 s3,s3,s7",
     18},
    {"access.load_hides_nop", "ldr.w r0,[r1]; nop.w; add.w r2,r3,r4", 3},
    {"access.load_hides_nop", "ldr.w r0,[r1]; cmp.w r5,r6; add.w r2,r3,r4", 4},
    {"access.load_behind_store", "str.w r0,[r1]; ldr.w r2,[r3]; add.w r4,r5,r6", 5},
    {"access.load_behind_store", "str.w r0,[r1]; ldm r2,{r3,r4}", 5},
    {"access.load_behind_store", "str.w r0,[r1]; stm r2,{r3,r4}", 4},
    {"access.load_behind_store", "str.w r0,[r1]; str.w r2,[r3]", 2},
    {"access.unaligned_load", "ldr.w r0,[r1,#1]; add.w r2,r3,r4", 4},
    {"access.unaligned_load", "str.w r0,[r1,#1]; add.w r2,r3,r4", 2},
    // refill: a loop's branch, to a target whose bytes come with one word, with two, and by address from elsewhere
    {"refill.direct", "1: subs.w r6,r6,#1; bne 1b", 3, How::turns},
    {"refill.direct", "nop; 1: subs.w r6,r6,#1; bne 1b", 4, How::turns},  // across two words
    {"refill.direct", "nop; 1: subs r6,r6,#1; bne 1b", 3, How::turns},
    {"refill.direct", "beq 9f; add.w r0,r1,r2; 9:", 2},  // not taken
    {"refill.by_register", "1: bl 8f; b 9f; 8: bx lr; 9: subs r6,r6,#1; bne 1b", 10, How::turns},
    {"refill.loaded", "1: bl 8f; b 9f; 8: pop {r4,pc}; 9: subs r6,r6,#1; bne 1b", 13, How::turns},
    // prefetch: an instruction of several cycles, then wide ones across words
    {"prefetch.restart", "sdiv r0,r1,r2; nop; add.w r3,r4,r5; add.w r3,r4,r5; nop", 10},
    {"prefetch.restart", "sdiv r0,r1,r2; nop; add.w r3,r4,r5; add.w r3,r4,r5; add.w r3,r4,r5; nop", 12},
    {"prefetch.restart", "sdiv r0,r1,r2; nop; .rept 4; add.w r3,r4,r5; .endr; nop", 13},  // once
    {"prefetch.restart", "sdiv r0,r1,r2; .rept 4; add.w r3,r4,r5; .endr", 10},            // not of whole words
    // Beside the core: flash behind the accelerator, and memory afar.
    {"memory", "1: add.w r0,r1,r2; subs.w r6,r6,#1; bne 1b", 4, How::turns, "stm32h747-m4"},
    {"memory", "nop.w; nop.w; nop.w; nop.w; nop.w; nop.w; nop.w; nop.w", 11, How::copies, "stm32h747-m4"},
};

double cycles_of(const Probe& probe, const probe::Setting& setting) {
    return probe::steady(probe.text, probe.how, setting);
}

TEST(CortexM4, TakesTheCyclesDerivedByHand) {
    for (const Probe& probe : probes) {
        EXPECT_EQ(cycles_of(probe, probe::core(probe.core)), probe.cycles) << probe.rule << ": " << probe.text;
        EXPECT_EQ(probe::run(lines_of(probe.text), probe::core(probe.core)).unknown, 0U) << probe.text;
    }
}

// Flash without wait states is as fast as any memory: where code lies there is no other figure.
TEST(CortexM4, WithoutWaitStatesNoMemoryIsSlower) {
    for (const Probe& probe : probes) {
        probe::Setting setting = probe::core("cortex-m4-zerowait");
        const double cycles = cycles_of(probe, setting);
        setting.placement.code = timing::CodePlace::flash;
        EXPECT_EQ(cycles_of(probe, setting), cycles) << probe.text;
    }
    // At 60 MHz there is one: two words of a line come with a cycle more.
    probe::Setting setting = probe::core("cortex-m4-zerowait");
    setting.placement.code = timing::CodePlace::flash;
    setting.figures.memory_clock_hz = 60'000'000;
    EXPECT_GT(cycles_of({"", "nop.w; nop.w; nop.w; nop.w", 4}, setting), 4.0);
}

TEST(CortexM4, LossesSumExactlyToWhatIsAboveHalfACycleAnInstruction) {
    for (const Probe& probe : probes) {
        for (const char* core : {"cortex-m4-zerowait", "stm32h747-m4"}) {
            probe::expect_losses_to_sum(probe.text, core);
        }
    }
}

TEST(CortexM4, AnEffectThatIsOffLosesNothing) {
    for (const Probe& probe : probes) {
        probe::expect_effects_to_switch_off(probe.text, probe.core);
    }
}

// Each of the core's figures decides a probe, as the name of one says.
TEST(CortexM4, EveryRowMovesAProbe) {
    struct Row {
        const char* name;
        std::int64_t timing::Figures::*figure;
    };
    constexpr Row figures[] = {
#define ROW(section, name) {#section "." #name, &timing::Figures::section##_##name},
#include "qemu/timing/cortex_m4/rows.def"
#undef ROW
        {"fetch.queue", &timing::Figures::fetch_queue},
    };
    for (const Row& row : figures) {
        bool moved = false;
        for (const Probe& probe : probes) {
            if (std::string(row.name) == "prefetch.latency" || std::string(row.name) == "fetch.queue" ||
                std::string(row.name) == probe.rule) {
                for (const std::int64_t more : {1, -1}) {
                    probe::Setting setting = probe::core(probe.core);
                    setting.figures.*row.figure += more;
                    moved = moved || cycles_of(probe, setting) != probe.cycles;
                }
            }
        }
        EXPECT_TRUE(moved) << row.name;
    }
}

// A branch frees the whole buffer: what its target's first words take is the refill's figure alone, however long a word
// takes from a place that becomes free to its use. Nor does a program begin with a wait.
TEST(CortexM4, TheFirstWordsOfATargetComeWithTheRefill) {
    probe::Setting setting = probe::core("cortex-m4-zerowait");
    const std::string begin = lines_of("add.w r0,r1,r2; add.w r3,r4,r5");
    const std::vector<std::int64_t> usual = probe::run(begin, setting).positions;
    for (const std::int64_t latency : {1, 2, 5, 12, 40}) {
        setting.figures.prefetch_latency = latency;
        EXPECT_EQ(cycles_of({"", "1: subs.w r6,r6,#1; bne 1b", 3, How::turns}, setting), 3) << latency;
        EXPECT_EQ(probe::run(begin, setting).positions, usual) << latency;
    }
}

// Of several words each is asked for as soon as there is a place for it, without a restart: so many of them are under
// way in the time that one takes, and no more than one a cycle.
TEST(CortexM4, AsManyWordsAreUnderWayAsTheBufferHolds) {
    probe::Setting setting = probe::core("cortex-m4-zerowait");
    setting.figures.prefetch_restart = 4;
    for (const auto& [words, text] : {std::pair(2, "add.w r0,r1,r2; add.w r3,r4,r5"),
                                      std::pair(3, "add.w r0,r1,r2; add.w r3,r4,r5; add.w r6,r7,r8")}) {
        setting.figures.fetch_queue = words;
        for (const int latency : {1, 2, 3, 4, 7}) {
            setting.figures.prefetch_latency = latency;
            EXPECT_EQ(cycles_of({"", text, 0}, setting), std::max(words, latency)) << words;
        }
    }
}

// Of one word a buffer asks for the next when it is used up, and has to begin anew: latency and restart for each. An
// instruction across two words does not keep the first from leaving, else the second never came.
TEST(CortexM4, ABufferOfOneWordAsksForEachByItself) {
    probe::Setting setting = probe::core("cortex-m4-zerowait");
    setting.figures.fetch_queue = 1;
    setting.figures.prefetch_latency = 3;
    setting.figures.prefetch_restart = 4;
    EXPECT_EQ(cycles_of({"", "add.w r0,r1,r2; add.w r3,r4,r5", 0}, setting), 2 * (3 + 4));
    // The second word was asked for a cycle behind the first, and two instructions go on from it.
    EXPECT_EQ(cycles_of({"", "nop; add.w r0,r1,r2; nop", 0}, setting), 3 + 4 + 2);
}

// The registers of an LDM come a cycle one behind the other: each is an address as many cycles later, where nothing
// else keeps the next instruction from issuing at once.
TEST(CortexM4, RegistersOfALoadOfSeveralComeOneACycle) {
    probe::Setting setting = probe::core("cortex-m4-zerowait");
    setting.figures.takes_multiple_first = -3;
    for (int nth = 0; nth < 4; ++nth) {
        const std::string text = "ldm r0,{r1,r2,r3,r4}; ldr.w r5,[r" + std::to_string(1 + nth) + "]";
        const auto positions = probe::run(lines_of(text.c_str()), setting).positions;
        EXPECT_EQ(positions.at(1) / 2 - positions.at(0) / 2, 3 + nth);  // as LDR's own at least
    }
}

// Nothing was stored, nothing computed and nothing held before a program's first instruction: it waits for its word
// alone.
TEST(CortexM4, BeginsWithNothingUnderWay) {
    for (const char* text : {"ldr.w r0,[r1]", "str.w r0,[r1]", "vadd.f32 s0,s1,s2", "vldr s0,[r1]", "add.w r0,r1,r2"}) {
        const timing::Losses losses = probe::run(lines_of(text), probe::core("cortex-m4-zerowait")).losses;
        for (std::size_t e = 0; e < losses.size(); ++e) {
            const auto effect = static_cast<timing::Effect>(e);
            if (effect != timing::Effect::single_issue && effect != timing::Effect::fetch_alignment) {
                EXPECT_EQ(losses[e], 0) << text << ": " << timing::effect_names[e];
            }
        }
    }
}

// What each wait is called, in half cycles, beside the half of each instruction that starts a cycle of its own.
TEST(CortexM4, LossesHaveTheNameOfTheirCause) {
    struct Case {
        const char* text;
        timing::Effect effect;
        std::int64_t half_cycles;
    };
    constexpr Case cases[] = {
        {"ldr.w r0,[r1]; add.w r2,r3,r4", timing::Effect::load_use, 2},
        {"add.w r1,r1,r2; ldr.w r0,[r1]", timing::Effect::result_latency, 2},
        {"sdiv r0,r1,r2; add.w r3,r4,r5", timing::Effect::result_latency, 10},
        {"vadd.f32 s0,s1,s2; vadd.f32 s3,s0,s4", timing::Effect::fpu_latency, 2},
        {"vfma.f32 s0,s1,s2; add.w r0,r1,r2", timing::Effect::fpu_latency, 4},
        {"str.w r0,[r1]; ldr.w r2,[r3]", timing::Effect::store_buffer, 2},
        {"str.w r0,[r1,r2]; add.w r3,r4,r5", timing::Effect::store_buffer, 2},
        {"ldm r0,{r1,r2,r3}; add.w r4,r5,r6", timing::Effect::single_issue, 6},
        {"b 9f; nop.w; 9: nop.w", timing::Effect::branch_mispredict, 2},
        {"ldr.w r0,[r1,#1]; add.w r2,r3,r4", timing::Effect::unaligned_access, 2},
    };
    for (const Case& test : cases) {
        const probe::Outcome outcome = probe::run(lines_of(test.text), probe::core("cortex-m4-zerowait"));
        const bool every = test.effect == timing::Effect::single_issue;
        const auto halves = static_cast<std::int64_t>(outcome.positions.size()) - 1;
        EXPECT_EQ(outcome.losses[timing::index(test.effect)], test.half_cycles + (every ? halves : 0)) << test.text;
    }
}

}  // namespace
