// What is looked up equals what is computed, half cycle for half cycle and loss for loss: on random walks through
// random programs, on every core and under each of its rule sets.
#include "qemu/timing/block_replay.hpp"

#include <gtest/gtest.h>
#include <malloc.h>

#include <random>

#include "listing.hpp"
#include "qemu/timing/band.hpp"
#include "qemu/timing/cortex_m4/pipeline.hpp"
#include "qemu/timing/decode.hpp"
#include "qemu/timing/model.hpp"
#include "qemu/timing/surroundings.hpp"

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

// A pipeline of any core, computed on and on: its clock is never set back.
class Direct {
public:
    Direct() = default;
    Direct(const Direct&) = delete;
    Direct& operator=(const Direct&) = delete;
    virtual ~Direct() = default;
    virtual void execute(const timing::Prepared& instruction, const timing::Event& event) = 0;
    [[nodiscard]] virtual std::int32_t position() const = 0;
    [[nodiscard]] virtual const timing::Losses& losses() const = 0;
};
template <class Pipeline>
class DirectOf final : public Direct {
public:
    DirectOf(const timing::Figures& figures, std::int64_t longest_fetch, timing::Effects off)
        : pipeline_(figures, longest_fetch, off) {}
    void execute(const timing::Prepared& instruction, const timing::Event& event) override {
        pipeline_.execute(instruction, event);
    }
    [[nodiscard]] std::int32_t position() const override { return pipeline_.state.position; }
    [[nodiscard]] const timing::Losses& losses() const override { return pipeline_.losses; }

private:
    Pipeline pipeline_;
};

std::vector<std::unique_ptr<Direct>> pipelines_of_sets(const timing::CoreFile& core, std::int64_t longest_fetch) {
    std::vector<std::unique_ptr<Direct>> direct;
    for (const timing::RuleSet& set : core.sets) {
        if (core.core == timing::Core::cortex_m4) {
            direct.push_back(
                std::make_unique<DirectOf<timing::cortex_m4::Pipeline>>(set.figures, longest_fetch, core.off));
        } else {
            direct.push_back(std::make_unique<DirectOf<timing::Pipeline>>(set.figures, longest_fetch, core.off));
        }
    }
    return direct;
}

// Keys stand for events: what differs in any one thing has another key.
TEST(PackedEvent, TellsEventsApart) {
    timing::Event load;
    load.accesses = 1;
    load.access_bytes = 4;
    load.load_delay = 7;
    load.words = 1;
    load.fetch_delays[0] = 5;
    load.fetch_effect = timing::Effect::flash_wait_states;
    timing::Event store;
    store.accesses = 2;
    store.access_bytes = 4;
    store.store_delayed = true;
    store.store_delays[1] = 9;
    const auto changed = [](timing::Event event, auto change) {
        change(event);
        return event;
    };
    const std::vector<timing::Event> events{
        load,
        changed(load, [](auto& e) { e.load_delay = 8; }),
        changed(load, [](auto& e) { e.load_effect = timing::Effect::flash_wait_states; }),
        changed(load, [](auto& e) { e.meets = 2; }),
        changed(load, [](auto& e) { e.odd_word = 1; }),
        changed(load, [](auto& e) { e.in_dtcm = 1; }),
        changed(load, [](auto& e) { e.words = 2; }),
        changed(load, [](auto& e) { e.words = 4; }),
        changed(load, [](auto& e) { e.fetch_delays[0] = 6; }),
        changed(load, [](auto& e) { e.fetch_effect = timing::Effect::icache_misses; }),
        changed(load, [](auto& e) { e.taken = true; }),
        changed(load, [](auto& e) { e.second_half = true; }),
        changed(load, [](auto& e) { e.prediction = timing::Prediction::wrong; }),
        store,
        changed(store, [](auto& e) { e.store_delays[1] = 8; }),
        changed(store, [](auto& e) { e.store_delays[0] = 9; }),
        changed(store, [](auto& e) { e.store_effect = timing::Effect::flash_wait_states; }),
    };
    for (const timing::Event& a : events) {
        EXPECT_TRUE(timing::packs(a));
        for (const timing::Event& b : events) {
            const timing::PackedEvent of_a = timing::packed(a);
            const timing::PackedEvent of_b = timing::packed(b);
            EXPECT_EQ(of_a.event == of_b.event && of_a.fetch_delays == of_b.fetch_delays, &a == &b)
                << &a - events.data() << " " << &b - events.data();
        }
    }
    // The delays themselves may be left out where there are none: the rest tells so, whatever a delay would be called.
    const timing::Event at_once = changed(load, [](auto& e) { e.fetch_delays = {}; });
    for (std::size_t e = 0; e < timing::effect_count; ++e) {
        const timing::Event late =
            changed(load, [&](auto& event) { event.fetch_effect = static_cast<timing::Effect>(e); });
        EXPECT_NE(timing::packed(at_once).event, timing::packed(late).event) << timing::effect_names[e];
    }
    EXPECT_EQ(timing::packed(at_once).fetch_delays, 0U);
    EXPECT_FALSE(timing::packs(changed(store, [](auto& e) { e.store_delays[0] = 8; }))) << "two delays";
    EXPECT_FALSE(timing::packs(changed(store, [](auto& e) { e.store_delays[8] = 9; }))) << "beyond the eighth";
    EXPECT_FALSE(timing::packs(changed(load, [](auto& e) { e.words = 5; }))) << "more words than delays";
}

// Which of a block's instructions an event is of takes the ten bits above it: of more than 1023 a block has no key.
TEST(PackedEvent, ABlockThatIsTooLongHasNoKey) {
    timing::BlockEvents met;
    const auto key_of = [&](std::size_t accesses) {
        timing::Event load;
        load.accesses = 1;
        met.events.assign(met.events.size(), {});
        met.events[accesses] = load;
        met.make_key();
        return std::vector<std::uint64_t>(met.key().begin(), met.key().end());
    };
    met.events.resize(1023);
    EXPECT_FALSE(key_of(1022).empty());
    EXPECT_NE(key_of(1021), key_of(1020));
    met.events.resize(1024);
    EXPECT_TRUE(key_of(1022).empty());
}

// From the first state, at the first site, with nothing to be said of it: no step is known for it.
TEST(Replay, ComputesTheFirstStepOfAll) {
    const listing::Line line = listing::assemble("nop.w\n").front();
    const timing::Prepared nop(timing::decode(line.encoding, line.bytes));
    timing::Replay replay(timing::read_core(TEST_CORES, "m7-ideal"));
    for (int k = 0; k < 100; ++k) {
        replay.execute(0, nop, {});
        EXPECT_EQ(replay.positions()[0], k);  // half a cycle each
    }
    EXPECT_LT(replay.computed(), 50U);  // it comes back to states that it knows
}

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
        timing::Surroundings surroundings(core.sets[0].figures, core.placement, core.core);
        timing::Replay replay(core);
        const auto direct = pipelines_of_sets(core, surroundings.memory().longest_fetch());
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
                        ASSERT_EQ(replay.positions()[s], direct[s]->position())
                            << name << " " << core.sets[s].name << " step " << steps << " " << d.mnemonic;
                    }
                }
            }
        }
        EXPECT_EQ(replay.losses(), direct[0]->losses()) << name;
        EXPECT_LT(replay.computed(), steps) << name;
    }
}

// The same by whole blocks, with caches that learn on the way: what is kept of a block's fetches and accesses from one
// execution to the next, too.
TEST(BlockReplay, EqualsTheComputationStepByStep) {
    std::string text;
    for (const char* word : words) {
        text += std::string(word) + "\n";
    }
    const std::vector<listing::Line> lines = listing::assemble(text);
    std::mt19937 generator(11);
    const auto draw = [&](std::size_t below) { return static_cast<std::uint32_t>(generator() % below); };
    std::vector<std::unique_ptr<timing::Prepared>> sites;
    std::vector<timing::CodeBlock> blocks(24);
    std::uint32_t address = 0x100;
    for (timing::CodeBlock& block : blocks) {
        block.index = static_cast<std::uint32_t>(&block - blocks.data());
        for (unsigned count = 1 + draw(20); count > 0; --count) {
            const listing::Line& line = lines[draw(lines.size())];
            sites.push_back(std::make_unique<timing::Prepared>(timing::decode(line.encoding, line.bytes)));
            block.lines.push_back({sites.back().get(), static_cast<std::uint32_t>(sites.size() - 1), address});
            address += line.bytes;
        }
        address += 2 * draw(40);
    }
    for (const std::string& name : timing::core_names(TEST_CORES)) {
        const timing::CoreFile core = timing::read_core(TEST_CORES, name);
        timing::Surroundings of_blocks(core.sets[0].figures, core.placement, core.core);
        timing::Surroundings of_steps(core.sets[0].figures, core.placement, core.core);
        timing::BlockReplay replay(core);
        const auto direct = pipelines_of_sets(core, of_steps.memory().longest_fetch());
        std::vector<timing::BlockEvents> met(blocks.size());
        std::vector<std::int64_t> half_cycles(sites.size());
        std::vector<timing::Losses> lost(sites.size());
        for (int turn = 0; turn < 400; ++turn) {
            const timing::CodeBlock& block = blocks[draw(blocks.size())];
            const std::uint32_t data = 0x20000000U + 4 * draw(64) + (draw(16) == 0 ? 1 : 0);
            for (unsigned times = 1 + draw(12); times > 0; --times) {
                const bool counted = draw(4) != 0;
                const std::uint32_t next = times > 1 ? block.lines.front().address : 0x10;
                std::vector<qemu::Access> accesses;
                std::vector<std::vector<qemu::Access>> of_line(block.lines.size());
                for (std::uint32_t nth = 0; nth < block.lines.size(); ++nth) {
                    const timing::Decoded& d = block.lines[nth].instruction->decoded;
                    const unsigned made = draw(24) == 0 ? 0 : d.registers;  // now and then a condition is false
                    for (unsigned n = 0; n < made; ++n) {
                        of_line[nth].push_back(
                            {data + 32 * (draw(8) == 0 ? draw(512) : 0) + 4 * n, d.access_bytes, d.is_store()});
                        of_line[nth].back().by = static_cast<std::uint16_t>(nth);
                        accesses.push_back(of_line[nth].back());
                    }
                }
                timing::BlockEvents& events = met[block.index];
                of_blocks.meet(block.lines, accesses, next, events);
                replay.execute(block, events, counted);
                for (std::uint32_t nth = 0; nth < block.lines.size(); ++nth) {
                    const timing::CodeBlock::Instruction& line = block.lines[nth];
                    const std::uint32_t behind = nth + 1 < block.lines.size() ? block.lines[nth + 1].address : next;
                    const std::int32_t before = direct[0]->position();
                    const timing::Losses lost_before = direct[0]->losses();
                    const timing::Event& event =
                        of_steps.meet(line.instruction->decoded, line.address, of_line[nth], behind);
                    for (const auto& pipeline : direct) {
                        pipeline->execute(*line.instruction, event);
                    }
                    half_cycles[line.site] += counted ? direct[0]->position() - before : 0;
                    for (std::size_t e = 0; counted && e < timing::effect_count; ++e) {
                        lost[line.site][e] += direct[0]->losses()[e] - lost_before[e];
                    }
                }
                for (std::size_t s = 0; s < direct.size(); ++s) {
                    ASSERT_EQ(replay.core().positions()[s], direct[s]->position())
                        << name << " " << core.sets[s].name << " turn " << turn << " block " << block.index;
                }
            }
        }
        EXPECT_EQ(replay.core().losses(), direct[0]->losses()) << name;
        std::vector<timing::SiteTime> counted = replay.times();
        counted.resize(half_cycles.size());
        for (std::size_t site = 0; site < counted.size(); ++site) {
            EXPECT_EQ(counted[site].half_cycles, half_cycles[site]) << name << ' ' << site;
            EXPECT_EQ(counted[site].lost, lost[site]) << name << ' ' << site;
        }
    }
}

// Past 2^16 steps all is forgotten and begun anew: a run of hours takes no more memory than one of minutes, and counts
// on.
TEST(BlockReplay, RemembersNoMoreHoweverLongItRuns) {
    const listing::Line line = listing::assemble("ldr.w r2,[r0]\n").front();
    const timing::Prepared load(timing::decode(line.encoding, line.bytes));
    timing::CodeBlock block;
    block.lines = {{&load, 0, 0x100}, {&load, 1, 0x104}};
    timing::BlockReplay replay(timing::read_core(TEST_CORES, "stm32f746-itcm"));
    const std::int64_t before = replay.core().positions()[0];
    // Few events of each load, in more and more pairs.
    timing::BlockEvents met;
    met.events.resize(2);
    std::uint32_t number = 0;
    const auto in_use_after = [&](unsigned steps) {
        for (; steps > 0; --steps, ++number) {
            for (timing::Event& event : met.events) {
                event.accesses = 1;
                event.access_bytes = 4;
            }
            met.events[0].load_delay = static_cast<std::uint16_t>(1 + number % 512);
            met.events[1].load_delay = static_cast<std::uint16_t>(1 + number / 512);
            met.make_key();
            replay.execute(block, met, true);
        }
#ifdef __GLIBC__
        return mallinfo2().uordblks + mallinfo2().hblkhd;
#else
        return std::size_t{0};
#endif
    };
    constexpr unsigned most_steps = 1U << 16;
    (void)in_use_after(most_steps / 2);
    EXPECT_EQ(replay.remembered(), most_steps / 2);  // each was another one
    const std::size_t full = in_use_after(3 * most_steps / 4);
    EXPECT_LE(in_use_after(2 * most_steps), full + (std::size_t{1} << 18));
    EXPECT_LT(replay.remembered(), most_steps);
    const std::vector<timing::SiteTime> times = replay.times();
    EXPECT_EQ(times.at(0).half_cycles + times.at(1).half_cycles, replay.core().positions()[0] - before);
}

timing::CoreFile core_of_sets(std::initializer_list<bool> fits) {
    timing::CoreFile core = timing::read_core(TEST_CORES, "stm32f746-itcm");
    core.sets.resize(1);
    core.sets[0].figures.band_published_permille = 50;
    core.sets[0].figures.band_fitted_permille = 125;
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
