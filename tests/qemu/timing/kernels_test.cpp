// Whole loops as compilers and assembly programmers write them: what the facts say of them, under each rule set, and
// how wide their bands are.
#include <gtest/gtest.h>

#include "probe.hpp"
#include "qemu/timing/band.hpp"

namespace {

std::string lines_of(std::string text) {
    for (char& letter : text) {
        letter = letter == ';' ? '\n' : letter;
    }
    return text + "\n";
}

// Cycles of a turn under each set of a core.
std::map<std::string, double> turns_of(const std::string& text, const char* name) {
    const timing::CoreFile core = timing::read_core(TEST_CORES, name);
    std::map<std::string, double> cycles;
    for (const timing::RuleSet& set : core.sets) {
        cycles[set.name] = probe::steady_turns(lines_of(text), {set.figures, core.placement, core.off});
    }
    return cycles;
}

const char* const f32_row =
    "1: vldr s15,[r0,#516]; subs r1,r1,#1; vldr s13,[r0]; add r0,r0,#4; vstr s15,[r0,#508]; vfma.f32 s14,s15,s13; bne "
    "1b";
const char* const q31_row =
    "1: ldr r2,[r0,#516]; subs r1,r1,#1; ldr r3,[r0]; add r0,r0,#4; str r2,[r0,#508]; smmlar r4,r2,r3,r4; bne 1b";

TEST(Kernel, TheRowsOfTheH747UnderEachSet) {
    using Sets = std::map<std::string, double>;
    EXPECT_EQ(turns_of(f32_row, "stm32h747-axi"),
              (Sets{{"nominal", 8}, {"barred", 7}, {"chain", 8}, {"published", 4}, {"unfolded", 8}}));
    EXPECT_EQ(turns_of(f32_row, "stm32h747-dtcm"),
              (Sets{{"nominal", 9}, {"barred", 8}, {"chain", 8}, {"published", 4}, {"unfolded", 9}}));
    for (const char* core : {"stm32h747-axi", "stm32h747-dtcm"}) {
        for (const auto& [set, cycles] : turns_of(q31_row, core)) {
            EXPECT_EQ(cycles, 4) << set;
        }
    }
}

// The facts' floors of a dot product over words in DTCM, samples and coefficients on different banks.
TEST(Kernel, TheFloorsOfADotProduct) {
    // f32, one load after the other: no VLDR pairs with a MAC. 5 a tap under both sets of the facts.
    std::string naive = "1: ";
    for (int tap = 0; tap < 8; ++tap) {
        const std::string n = std::to_string(tap);
        naive += "vldr s8,[r0,#" + std::to_string(4 * tap) + "]; vldr s9,[r1,#" + std::to_string(4 * tap + 4) +
                 "]; vfma.f32 s" + n + ",s8,s9; ";
    }
    naive += "bne 1b";
    const auto f32 = turns_of(naive, "stm32f746-itcm");
    EXPECT_NEAR(f32.at("barred") / 8, 5.0, 0.15);
    EXPECT_NEAR(f32.at("chain") / 8, 5.0, 0.15);
    EXPECT_NEAR(f32.at("nominal") / 8, 5.0, 0.15);
    EXPECT_NEAR(f32.at("published") / 8, 3.08, 0.1);

    // q31: ldr x0 | ldr c0, ldr x1 | smlal, ldr c1 | smlal: three cycles for two taps, and the branch once in 24.
    std::string q31 = "1: ";
    for (int pair = 0; pair < 12; ++pair) {
        const std::string at = std::to_string(8 * pair);
        const std::string next = std::to_string(8 * pair + 4);
        q31 += "ldr.w r4,[r0,#" + at + "]; ldr.w r5,[r1,#" + next + "]; ldr.w r6,[r0,#" + next +
               "]; smlal r8,r9,r10,r11; ldr.w r7,[r1,#" + at + "]; smlal r8,r9,r10,r12; ";
    }
    const auto fixed = turns_of(q31 + "bne 1b", "stm32f746-itcm");
    EXPECT_NEAR(fixed.at("nominal") / 24, 1.58, 0.05);

    // f32 Horner, one chain: VFMA result to multiplicand.
    const auto horner = turns_of("1: .rept 8; vfma.f32 s1,s0,s2; vfma.f32 s0,s1,s2; .endr; bne 1b", "stm32f746-itcm");
    EXPECT_NEAR(horner.at("nominal") / 16, 5.0, 0.1);
}

struct Loop {
    const char* name;
    const char* text;
};
// Plausible code of each kind. What is stored and loaded by turns walks on by the written-back bases.
constexpr Loop floating[] = {
    {"dot, 1 sum", "1: vldmia r0!,{s1}; vldmia r1!,{s2}; cmp r0,r3; vfma.f32 s0,s1,s2; bne 1b"},
    {"dot, VMLA", "1: vldmia r0!,{s1}; vldmia r1!,{s2}; cmp r0,r3; vmla.f32 s0,s1,s2; bne 1b"},
    {"dot, 4 taps, 1 sum",
     "1: vldr s1,[r0]; vldr s2,[r1,#4]; vfma.f32 s0,s1,s2; vldr s3,[r0,#4]; vldr s4,[r1,#8]; vfma.f32 s0,s3,s4; "
     "vldr s5,[r0,#8]; vldr s6,[r1,#12]; vfma.f32 s0,s5,s6; vldr s7,[r0,#12]; vldr s8,[r1,#16]; vfma.f32 s0,s7,s8; bne "
     "1b"},
    {"dot, 4 sums",
     "1: vldr s1,[r0]; vldr s2,[r1,#4]; vldr s3,[r0,#4]; vldr s4,[r1,#8]; vldr s5,[r0,#8]; vldr s6,[r1,#12]; "
     "vldr s7,[r0,#12]; vldr s8,[r1,#16]; vfma.f32 s10,s1,s2; vfma.f32 s11,s3,s4; vfma.f32 s12,s5,s6; "
     "vfma.f32 s13,s7,s8; bne 1b"},
    {"dot, VLDM, 4 sums",
     "1: vldmia r0!,{s0-s7}; vldmia r1!,{s8-s15}; vfma.f32 s16,s0,s8; vfma.f32 s17,s1,s9; vfma.f32 s18,s2,s10; "
     "vfma.f32 s19,s3,s11; vfma.f32 s16,s4,s12; vfma.f32 s17,s5,s13; vfma.f32 s18,s6,s14; vfma.f32 s19,s7,s15; bne 1b"},
    {"biquad, direct form 1",
     "1: vldr s0,[r0]; vmul.f32 s1,s10,s0; vfma.f32 s1,s11,s15; vfma.f32 s1,s12,s16; vfma.f32 s1,s13,s17; "
     "vfma.f32 s1,s14,s18; vmov.f32 s16,s15; vmov.f32 s15,s0; vmov.f32 s18,s17; vmov.f32 s17,s1; vstr s1,[r1]; bne 1b"},
    {"biquad, direct form 2 transposed",
     "1: vldr s0,[r0]; vmov.f32 s1,s15; vfma.f32 s1,s10,s0; vmul.f32 s3,s11,s0; vadd.f32 s3,s3,s16; vfma.f32 "
     "s3,s13,s1; "
     "vmov.f32 s15,s3; vmul.f32 s16,s12,s0; vfma.f32 s16,s14,s1; vstr s1,[r1]; bne 1b"},
    {"biquad of VMUL and VADD",
     "1: vldr s0,[r0]; vmul.f32 s1,s10,s0; vadd.f32 s1,s1,s15; vmul.f32 s3,s11,s0; vmul.f32 s4,s13,s1; vadd.f32 "
     "s3,s3,s16; "
     "vadd.f32 s15,s3,s4; vmul.f32 s5,s12,s0; vmul.f32 s6,s14,s1; vadd.f32 s16,s5,s6; vstr s1,[r1]; bne 1b"},
    {"axpy", "1: vldr s1,[r0]; vldr s2,[r1,#4]; vfma.f32 s2,s1,s0; vstr s2,[r1,#4]; subs r2,r2,#1; bne 1b"},
    {"scale", "1: vldr s1,[r0]; vmul.f32 s1,s1,s0; vstr s1,[r1]; subs r2,r2,#1; bne 1b"},
    {"Horner", "1: vldmia r0!,{s1}; vfma.f32 s1,s0,s2; vldmia r0!,{s0}; vfma.f32 s0,s1,s2; subs r2,#1; bne 1b"},
    {"LMS",
     "1: vldr s1,[r0]; vldr s2,[r1,#4]; vfma.f32 s2,s1,s10; vldr s3,[r0,#4]; vfma.f32 s11,s3,s2; vstr s2,[r1,#4]; "
     "subs r2,#1; bne 1b"},
    {"FFT butterfly",
     "1: vldr s0,[r0]; vldr s1,[r0,#4]; vldr s2,[r1]; vldr s3,[r1,#4]; vmul.f32 s4,s2,s10; vfms.f32 s4,s3,s11; "
     "vmul.f32 s5,s2,s11; vfma.f32 s5,s3,s10; vsub.f32 s6,s0,s4; vsub.f32 s7,s1,s5; vadd.f32 s0,s0,s4; vadd.f32 "
     "s1,s1,s5; "
     "vstr s6,[r1]; vstr s7,[r1,#4]; vstr s0,[r0]; vstr s1,[r0,#4]; bne 1b"},
    {"matrix", "1: vldmia r0!,{s1}; vldr s2,[r1]; add r1,r1,r4; vfma.f32 s0,s1,s2; subs r2,#1; bne 1b"},
    {"shift register", "1: vmov.f32 s4,s3; vmov.f32 s3,s2; vmov.f32 s2,s1; vldmia r0!,{s1}; subs r2,#1; bne 1b"},
    {"8 MACs of registers",
     "1: vfma.f32 s0,s10,s20; vfma.f32 s1,s11,s20; vfma.f32 s2,s12,s20; vfma.f32 s3,s13,s20; vfma.f32 s4,s14,s20; "
     "vfma.f32 s5,s15,s20; vfma.f32 s6,s16,s20; vfma.f32 s7,s17,s20; subs r2,#1; bne 1b"},
};
constexpr Loop whole[] = {
    {"q15 dot", "1: ldr r4,[r0],#4; ldr r5,[r1],#4; smlad r6,r4,r5,r6; subs r2,#1; bne 1b"},
    {"q15 dot by LDRD",
     "1: ldrd r4,r5,[r0],#8; ldrd r6,r7,[r1],#8; smlald r8,r9,r4,r6; smlald r8,r9,r5,r7; subs r2,#1; bne 1b"},
    {"copy by LDM", "1: ldmia r0!,{r4-r11}; stmia r1!,{r4-r11}; subs r2,#32; bne 1b"},
    {"copy of bytes", "1: ldrb r3,[r0],#1; strb r3,[r1],#1; subs r2,#1; bne 1b"},
    {"CRC by table",
     "1: ldrb r3,[r0],#1; eor r3,r3,r4; uxtb r3,r3; ldr r3,[r5,r3,lsl #2]; eor r4,r3,r4,lsr #8; bne 1b"},
    {"quarter round",
     "1: add r0,r0,r1; eor r3,r0,r3,ror #16; add r2,r2,r3,ror #16; eor r1,r2,r1,ror #12; add r0,r0,r1,ror #20; "
     "eor r3,r0,r3,ror #24; add r2,r2,r3,ror #8; eor r1,r2,r1,ror #19; bne 1b"},
    {"q15 biquad",
     "1: ldrsh r3,[r0],#2; smulbb r4,r3,r5; smlad r4,r6,r7,r4; smlad r4,r8,r9,r4; ssat r4,#16,r4; pkhbt r6,r3,r6,lsl "
     "#16; "
     "pkhbt r8,r4,r8,lsl #16; strh r4,[r1],#2; subs r2,#1; bne 1b"},
};

TEST(Kernel, BandsOfPlausibleLoopsHoldTheNominalFigureAndAreNoWiderThanAQuarter) {
    for (const char* name : {"stm32f746-itcm", "stm32h747-dtcm", "stm32h747-axi"}) {
        const timing::CoreFile core = timing::read_core(TEST_CORES, name);
        for (const auto& loops : {std::span<const Loop>(floating), std::span<const Loop>(whole)}) {
            for (const Loop& loop : loops) {
                std::vector<std::int64_t> figures;
                for (const timing::RuleSet& set : core.sets) {
                    const double cycles =
                        probe::steady_turns(lines_of(loop.text), {set.figures, core.placement, core.off});
                    figures.push_back(static_cast<std::int64_t>(cycles * 16000));
                }
                const timing::Band band = timing::band_of(core, figures);
                EXPECT_LE(band.low, figures[0]) << loop.name;
                EXPECT_GE(band.high, figures[0]) << loop.name;
                EXPECT_LE(band.high - band.low, figures[0] / 4 + 2) << loop.name;
            }
        }
    }
}

// Integer code follows from published rules: no rival of the FPU's rules moves it.
TEST(Kernel, IntegerLoopsAreTheSameUnderEverySetButUnfolded) {
    for (const Loop& loop : whole) {
        const auto cycles = turns_of(loop.text, "stm32f746-itcm");
        for (const char* set : {"barred", "chain", "published"}) {
            EXPECT_EQ(cycles.at(set), cycles.at("nominal")) << loop.name << " under " << set;
        }
    }
}

}  // namespace
