// What is looked up equals what is computed, half cycle for half cycle and loss for loss: on random walks through
// random programs, on every core and under each of its rule sets.
#include "qemu/timing/replay.hpp"

#include <gtest/gtest.h>

#include <random>

#include "listing.hpp"
#include "qemu/timing/band.hpp"
#include "qemu/timing/decode.hpp"

namespace {

const char* const words[] = {
    "add.w r1,r2,r3",
    "sub.w r1,r1,#4",
    "eor.w r4,r1,r5",
    "eor.w r4,r4,r5,ror #8",
    "lsl.w r2,r3,#2",
    "adds.w r6,r6,#1",
    "adc.w r3,r3,r4",
    "uxtb.w r2,r4",
    "rev.w r2,r4",
    "qadd r2,r2,r4",
    "ubfx r3,r2,#1,#4",
    "mul r3,r2,r4",
    "smlal r4,r5,r2,r3",
    "smlad r6,r2,r3,r6",
    "udiv r2,r2,r3",
    "ldr.w r2,[r0]",
    "ldr.w r3,[r1]",
    "ldrb.w r4,[r0]",
    "ldrd r4,r5,[r0]",
    "ldm r0,{r2,r3,r4,r5}",
    "str.w r2,[r1]",
    "strb.w r2,[r1]",
    "strd r4,r5,[r0]",
    "stm r0,{r2,r3,r4,r5}",
    "vldr s0,[r0]",
    "vldr s1,[r1]",
    "vldr d4,[r1]",
    "vstr s0,[r1]",
    "vldm r0,{s4-s9}",
    "vstm r1,{s4-s9}",
    "vadd.f32 s0,s1,s2",
    "vmul.f32 s3,s0,s1",
    "vfma.f32 s4,s0,s1",
    "vfma.f32 s5,s0,s1",
    "vmla.f32 s4,s3,s1",
    "vdiv.f32 s6,s4,s1",
    "vmov.f32 s7,s4",
    "vmov r2,s4",
    "vmov s2,r2",
    "vmov s2,s3,r2,r3",
    "vcmp.f32 s0,s1",
    "vmrs apsr_nzcv,fpscr",
    "vadd.f64 d0,d1,d2",
    "vfma.f64 d0,d1,d2",
    "vcvt.f32.s32 s0,s0",
    "it eq",
    "moveq r2,r3",
    "nop",
    "bne.w .+40",
    "b.w .-40",
    "dsb",
    "movw r2,#1",
};

TEST(Replay, EqualsTheComputationStepByStep) {
    std::string text;
    for (const char* word : words) {
        text += std::string(word) + "\n";
    }
    const std::vector<listing::Line> lines = listing::assemble(text);
    ASSERT_EQ(lines.size(), std::size(words));
    std::vector<std::unique_ptr<timing::Prepared>> sites;
    std::mt19937 generator(7);
    const auto draw = [&](std::size_t below) { return static_cast<std::uint32_t>(generator() % below); };
    constexpr std::size_t length = 96;
    std::vector<std::uint32_t> addresses;
    std::uint32_t address = 0x100;
    for (std::size_t i = 0; i < length; ++i) {
        const listing::Line& line = lines[draw(lines.size())];
        sites.push_back(std::make_unique<timing::Prepared>(timing::decode(line.encoding, line.bytes)));
        addresses.push_back(address);
        address += line.bytes;
    }
    for (const std::string& name : timing::core_names(TEST_CORES)) {
        const timing::CoreFile core = timing::read_core(TEST_CORES, name);
        timing::Surroundings surroundings(core.sets[0].figures, core.placement);
        timing::Replay replay(core);
        std::vector<std::unique_ptr<timing::Pipeline>> direct;
        for (const timing::RuleSet& set : core.sets) {
            direct.push_back(std::make_unique<timing::Pipeline>(set.figures, core.off));
        }
        std::uint64_t steps = 0;
        std::size_t at = 0;
        for (int turn = 0; turn < 300; ++turn) {
            // Some of the program, often the same: from a place that is drawn, a few times over.
            const std::size_t first = draw(length - 24);
            const std::size_t count = 1 + draw(24);
            const std::uint32_t data = 0x20000000U + 4 * draw(4) + (draw(16) == 0 ? 1 : 0);
            for (unsigned time = 1 + draw(12); time > 0; --time) {
                for (std::size_t i = first; i < first + count; ++i) {
                    at = i;
                    const timing::Decoded& d = sites[at]->decoded;
                    std::vector<qemu::Access> accesses;
                    const unsigned registers =
                        d.registers == 2 && d.is_fp && d.kind == timing::Kind::load_multiple ? 1 : d.registers;
                    for (unsigned n = 0; n < registers; ++n) {
                        const auto bytes = registers == d.registers ? d.access_bytes : std::uint8_t{8};
                        accesses.push_back(
                            {data + 64 * (static_cast<unsigned>(turn) % 5) + 4 * n, bytes, d.is_store()});
                    }
                    const std::uint32_t next = i + 1 < first + count ? addresses[at] + d.bytes : addresses[first];
                    const timing::Event& event = surroundings.meet(d, addresses[at], accesses, next);
                    replay.execute(static_cast<std::uint32_t>(at), *sites[at], event);
                    ++steps;
                    for (std::size_t s = 0; s < direct.size(); ++s) {
                        direct[s]->execute(*sites[at], event);
                        ASSERT_EQ(replay.positions()[s], direct[s]->state.position)
                            << name << " " << core.sets[s].name << " step " << steps << " " << d.mnemonic;
                    }
                }
            }
        }
        EXPECT_EQ(replay.losses(), direct[0]->losses) << name;
        EXPECT_LT(replay.computed(), steps) << name;
    }
}

timing::CoreFile core_of_sets(std::initializer_list<bool> fits) {
    timing::CoreFile core = timing::read_core(TEST_CORES, "stm32f746-itcm");
    core.sets.resize(1);
    for (const bool one : fits) {
        core.sets.push_back({"rival", "", core.sets[0].figures, one});
    }
    return core;
}

TEST(Band, IsThePublishedErrorWhereAllSetsAgree) {
    const std::int64_t figures[] = {1000, 1000, 1000};
    const timing::Band band = timing::band_of(core_of_sets({true, false}), figures);
    EXPECT_EQ(band.low, 950);
    EXPECT_EQ(band.high, 1050);
}

TEST(Band, GrowsWithWhatFittedRulesDecideAndIsNeverWiderThanAQuarter) {
    const std::int64_t refuted[] = {1000, 1000, 960};  // fitted rules make 4 %
    timing::Band band = timing::band_of(core_of_sets({true, false}), refuted);
    EXPECT_EQ(band.low, 910);
    EXPECT_EQ(band.high, 1090);
    const std::int64_t spread[] = {1000, 900, 2000};
    band = timing::band_of(core_of_sets({true, true}), spread);
    EXPECT_EQ(band.low, 1000);  // the nominal figure lies inside, the middle as near as it may
    EXPECT_EQ(band.high, 1250);
    const std::int64_t halves[] = {1000, 500, 500};
    band = timing::band_of(core_of_sets({true, false}), halves);
    EXPECT_EQ(band.low, 750);
    EXPECT_EQ(band.high, 1000);
}

TEST(Band, OfTheIdealCoreIsItsFigure) {
    const timing::CoreFile core = timing::read_core(TEST_CORES, "m7-ideal");
    const std::vector<std::int64_t> figures(core.sets.size(), 77);
    const timing::Band band = timing::band_of(core, figures);
    EXPECT_EQ(band.low, 77);
    EXPECT_EQ(band.high, 77);
}

}  // namespace
