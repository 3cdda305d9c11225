// The parts of the model that can be judged alone: cache, predictor, store buffer, IT blocks.
#include <gtest/gtest.h>

#include "probe.hpp"
#include "qemu/timing/cache.hpp"
#include "qemu/timing/decode.hpp"
#include "qemu/timing/memory.hpp"
#include "qemu/timing/predictor.hpp"
#include "qemu/timing/store_buffer.hpp"

namespace {

TEST(Cache, KeepsTheLinesUsedLast) {
    timing::Cache cache(4096, 4, 32);  // 32 sets of 4
    for (const std::uint32_t way : {0U, 1U, 2U, 3U}) {
        EXPECT_FALSE(cache.touch(way * 1024));
        EXPECT_TRUE(cache.touch(way * 1024 + 31));
    }
    EXPECT_TRUE(cache.touch(0));  // now line 1 is the oldest
    EXPECT_FALSE(cache.touch(4 * 1024));
    EXPECT_TRUE(cache.touch(0));
    EXPECT_FALSE(cache.touch(1 * 1024));
    EXPECT_FALSE(cache.touch(32));  // another set
}

// Five lines in turn in a set of four: the oldest is always the next one to be missed, one at random is not.
TEST(Cache, AtRandomKeepsSomeOfALoopThatDoesNotFit) {
    const auto hits = [](bool at_random) {
        timing::Cache cache(128, 4, 32, at_random);
        int found = 0;
        for (std::uint32_t turn = 0; turn < 400; ++turn) {
            found += cache.touch(turn % 5 * 32) ? 1 : 0;
        }
        return found;
    };
    EXPECT_EQ(hits(false), 0);
    EXPECT_GT(hits(true), 100);
    EXPECT_EQ(hits(true), hits(true));
}

// Where each line of a stretch is the one that its set had last, touching them in turn changes nothing.
TEST(Cache, KnowsAStretchOfLinesThatItsSetsHadLast) {
    timing::Cache cache(4096, 4, 32);  // 32 sets of 4
    EXPECT_FALSE(cache.newest(0, 0));
    for (std::uint32_t line = 29; line < 35; ++line) {  // sets 29, 30, 31, 0, 1, 2
        (void)cache.touch(line * 32);
    }
    EXPECT_TRUE(cache.newest(29 * 32, 34 * 32 + 31));
    EXPECT_TRUE(cache.newest(29 * 32 + 31, 30 * 32));
    EXPECT_TRUE(cache.newest(31 * 32, 31 * 32));
    EXPECT_FALSE(cache.newest(29 * 32 - 1, 34 * 32));
    EXPECT_FALSE(cache.newest(29 * 32, 35 * 32));
    (void)cache.touch(31 * 32 + 4096 / 4);
    EXPECT_FALSE(cache.newest(29 * 32, 34 * 32)) << "its set has had another since";
    EXPECT_TRUE(cache.newest(29 * 32, 31 * 32 - 1));
    EXPECT_TRUE(cache.newest(32 * 32, 34 * 32));
    EXPECT_TRUE(cache.newest(31 * 32 + 1024, 31 * 32 + 1024));
    EXPECT_FALSE(cache.newest(0, 0)) << "another line of the same set";
}

TEST(Cache, OfNoBytesIsOff) {
    timing::Cache cache(0, 4, 32);
    EXPECT_FALSE(cache.on());
    EXPECT_FALSE(cache.touch(0));
    EXPECT_FALSE(cache.touch(0));
}

timing::Decoded branch(timing::Branch kind) {
    timing::Decoded d;
    d.kind = timing::Kind::branch;
    d.branch = kind;
    return d;
}

TEST(Predictor, ALoopIsMissedOnceAtItsEnd) {
    timing::Predictor predictor(64, 0);
    auto bne = branch(timing::Branch::conditional);
    bne.backward = true;
    EXPECT_EQ(predictor.meet(bne, 0x210, 0x212), timing::Prediction::wrong);                // backward: taken, it says
    EXPECT_EQ(predictor.meet(bne, 0x110, 0x100), timing::Prediction::right_without_entry);  // and so it is
    for (int turn = 0; turn < 8; ++turn) {
        EXPECT_EQ(predictor.meet(bne, 0x110, 0x100), timing::Prediction::right);
    }
    EXPECT_EQ(predictor.meet(bne, 0x110, 0x112), timing::Prediction::wrong);
    EXPECT_EQ(predictor.meet(bne, 0x110, 0x100), timing::Prediction::right);  // still strongly taken
}

TEST(Predictor, AForwardBranchIsNotTakenAtFirst) {
    timing::Predictor predictor(64, 0);
    const auto beq = branch(timing::Branch::conditional);
    EXPECT_EQ(predictor.meet(beq, 0x110, 0x112), timing::Prediction::right);
    EXPECT_EQ(predictor.meet(beq, 0x110, 0x120), timing::Prediction::wrong);
}

// What comes back every third time follows from what was before it, and not from how often it was.
TEST(Predictor, OfAHistoryForeseesWhatCountersCannot) {
    const auto wrong = [](bool history) {
        timing::Predictor predictor(64, 0, history);
        const auto beq = branch(timing::Branch::conditional);
        int count = 0;
        for (int turn = 0; turn < 300; ++turn) {
            const bool taken = turn % 3 == 0;
            count += predictor.meet(beq, 0x110, taken ? 0x120 : 0x112) == timing::Prediction::wrong ? 1 : 0;
        }
        return count;
    };
    EXPECT_GT(wrong(false), 90);
    EXPECT_LT(wrong(true), 15);
}

// Of four states two say taken: one that was taken once is turned by one miss, one that never was by two.
TEST(Predictor, RemembersInTwoBits) {
    timing::Predictor predictor(64, 0);
    const auto beq = branch(timing::Branch::conditional);
    const auto meets = [&](bool taken) { return predictor.meet(beq, 0x110, taken ? 0x120 : 0x112); };
    EXPECT_EQ(meets(true), timing::Prediction::wrong);
    EXPECT_EQ(meets(false), timing::Prediction::wrong);
    EXPECT_EQ(meets(false), timing::Prediction::right);
    EXPECT_EQ(meets(false), timing::Prediction::right);
    EXPECT_EQ(meets(true), timing::Prediction::wrong);
    EXPECT_EQ(meets(true), timing::Prediction::wrong);
    EXPECT_EQ(meets(true), timing::Prediction::right);
}

TEST(Predictor, AReturnGoesWhereItWentLast) {
    timing::Predictor predictor(64, 0);
    const auto bx = branch(timing::Branch::back);
    EXPECT_EQ(predictor.meet(bx, 0x110, 0x200), timing::Prediction::wrong);
    EXPECT_EQ(predictor.meet(bx, 0x110, 0x200), timing::Prediction::right);
    EXPECT_EQ(predictor.meet(bx, 0x110, 0x300), timing::Prediction::wrong);
}

// As many as the stack holds come back to their callers, whoever called last; those before go where they went last.
TEST(Predictor, AReturnGoesToItsCallAsFarAsTheStackHolds) {
    timing::Predictor predictor(64, 2);
    auto bl = branch(timing::Branch::call);
    bl.bytes = 4;
    const auto back = branch(timing::Branch::back);
    for (const std::uint32_t caller : {0x200U, 0x300U, 0x400U}) {
        (void)predictor.meet(bl, caller, 0x100);
        EXPECT_EQ(predictor.meet(back, 0x110, caller + 4), timing::Prediction::right) << caller;
    }
    for (const std::uint32_t caller : {0x200U, 0x300U, 0x400U}) {  // each within the other
        (void)predictor.meet(bl, caller, 0x100);
    }
    EXPECT_EQ(predictor.meet(back, 0x110, 0x404), timing::Prediction::right);
    EXPECT_EQ(predictor.meet(back, 0x110, 0x304), timing::Prediction::right);
    EXPECT_EQ(predictor.meet(back, 0x110, 0x204), timing::Prediction::wrong);  // it lies under them no more
    // A return that goes elsewhere than its call came from.
    (void)predictor.meet(bl, 0x200, 0x100);
    EXPECT_EQ(predictor.meet(back, 0x110, 0x500), timing::Prediction::wrong);
    // A call through a register is one, and a jump through one is none.
    auto blx = branch(timing::Branch::indirect);
    (void)predictor.meet(blx, 0x600, 0x100);
    EXPECT_EQ(predictor.meet(back, 0x120, 0x602), timing::Prediction::wrong);
    blx.write(timing::registers::lr);
    (void)predictor.meet(blx, 0x600, 0x100);
    EXPECT_EQ(predictor.meet(back, 0x130, 0x602), timing::Prediction::right);
}

// However many it holds.
TEST(Predictor, ReturnsComeBackFromAsManyCallsAsTheStackHolds) {
    for (const std::uint32_t held : {1U, 3U, 6U, 8U}) {
        timing::Predictor predictor(64, held);
        auto bl = branch(timing::Branch::call);
        bl.bytes = 4;
        const auto back = branch(timing::Branch::back);
        for (int turn = 0; turn < 2; ++turn) {
            for (std::uint32_t depth = 1; depth <= held; ++depth) {
                (void)predictor.meet(bl, 0x200 * depth, 0x100);
            }
            for (std::uint32_t depth = held; depth >= 1; --depth) {
                EXPECT_EQ(predictor.meet(back, 0x110, 0x200 * depth + 4), timing::Prediction::right) << held << depth;
            }
        }
    }
}

TEST(StoreBuffer, IsFullWhenItsBankFallsBehind) {
    timing::Figures figures = probe::core("stm32f746-itcm").figures;
    figures.store_entries = 4;
    timing::StoreBuffer buffer;
    for (int cycle = 0; cycle < 4; ++cycle) {
        EXPECT_LE(buffer.free_from(figures), cycle);
        buffer.add(figures, cycle, 0, false, 1, 0);  // 4 cycles each, all on one bank: done at 4, 8, 12, 16
    }
    EXPECT_EQ(buffer.free_from(figures), 4);
    buffer.add(figures, 4, 0, false, 1, 0);
    EXPECT_EQ(buffer.free_from(figures), 8);
}

// What is done by the time to which the clock is set back is forgotten: a buffer that has written everything is a new
// one.
TEST(StoreBuffer, ForgetsWhatIsDoneWhereTheClockIsSetBack) {
    timing::Figures figures = probe::core("stm32f746-itcm").figures;
    figures.store_entries = 4;
    timing::StoreBuffer buffer;
    buffer.add(figures, 0, 0, false, 1, 0);  // done at 4
    buffer.add(figures, 0, 0, false, 1, 0);  // at 8
    timing::StoreBuffer later = buffer;
    later.settle(figures, 5);
    EXPECT_NE(later, timing::StoreBuffer{});
    timing::StoreBuffer empty = buffer;
    empty.settle(figures, 8);
    EXPECT_EQ(empty, timing::StoreBuffer{});
    empty = buffer;
    empty.settle(figures, 1000);
    EXPECT_EQ(empty, timing::StoreBuffer{});
}

TEST(ItBlock, GivesEachMemberItsCondition) {
    timing::ItBlock it;
    EXPECT_FALSE(it.inside());
    it.begin(0xBF06);  // itte eq
    EXPECT_TRUE(it.inside());
    EXPECT_EQ(it.condition(), 0x0);
    it.advance();
    EXPECT_EQ(it.condition(), 0x0);
    it.advance();
    EXPECT_EQ(it.condition(), 0x1);
    it.advance();
    EXPECT_FALSE(it.inside());
}

// 216 MHz, one wait state for each 30 MHz: 7. [stm32f7xx_ll_utils.c, scale 1]
TEST(Memory, WaitStatesFollowFromTheClock) {
    timing::Figures figures = probe::core("stm32f746-flash").figures;
    const struct {
        std::int64_t mhz;
        std::int64_t wait_states;
    } rows[] = {{30, 0}, {31, 1}, {60, 1}, {90, 2}, {120, 3}, {150, 4}, {180, 5}, {210, 6}, {211, 7}, {216, 7}};
    for (const auto& row : rows) {
        figures.memory_clock_hz = row.mhz * 1'000'000;
        EXPECT_EQ(timing::Memory(figures, {}).flash_wait_states(), row.wait_states) << row.mhz;
    }
}

TEST(Memory, PlacesDecideWhatAnAccessCosts) {
    const timing::Figures figures = probe::core("stm32f746-flash").figures;
    timing::Memory tcm(figures, {timing::CodePlace::itcm, timing::DataPlace::dtcm});
    EXPECT_EQ(tcm.fetch(0x100).cycles, 0);
    EXPECT_EQ(tcm.load(0x20000000).cycles, 0);
    timing::Memory flash(figures, {timing::CodePlace::flash, timing::DataPlace::axi});
    const timing::Delay miss = flash.fetch(0x100);
    EXPECT_EQ(miss.cycles, 8 + 4);  // 7 wait states and the read itself, and the bus
    EXPECT_EQ(miss.effect, timing::Effect::icache_misses);
    EXPECT_EQ(flash.fetch(0x11F).cycles, 0);
    EXPECT_EQ(flash.load(0x20000000).cycles, 4 + 2);  // the bus, two beats of 32 bits
    EXPECT_EQ(flash.load(0x2000001C).cycles, 0);
    // A store allocates: the line is read once.
    EXPECT_EQ(flash.store(0x20000040).cycles, 4 + 2);
    EXPECT_EQ(flash.store(0x20000040).cycles, 0);
    EXPECT_EQ(flash.load(0x20000044).cycles, 0);
    timing::Figures accelerated = figures;
    accelerated.memory_art_lines = 64;
    accelerated.memory_art_prefetch = 1;
    timing::Memory art(accelerated, {timing::CodePlace::flash, timing::DataPlace::dtcm});
    const timing::Delay read = art.fetch(0x100);
    EXPECT_EQ(read.cycles, 8);
    EXPECT_EQ(read.effect, timing::Effect::flash_wait_states);
    EXPECT_EQ(art.fetch(0x120).cycles, 8 - 4);  // read ahead while four words of the line before ran
    EXPECT_EQ(art.fetch(0x100).cycles, 0);
}

// Of a line the eight bytes that are asked for come first: as many beats as these take on the bus, one at least, and
// the bus' overhead, each of as many clocks as the bus is slower.
TEST(Memory, ALineOfSramTakesTheBeatsOfEightBytes) {
    timing::Figures figures = probe::core("stm32f746-flash").figures;
    figures.cache_data_bytes = 0;
    for (const auto& [bytes, beats] :
         {std::pair(1, 8), std::pair(2, 4), std::pair(4, 2), std::pair(8, 1), std::pair(16, 1)}) {
        for (const std::int64_t clocks : {1, 2}) {
            figures.memory_sram_beat_bytes = bytes;
            figures.memory_bus_clocks = clocks;
            figures.memory_bus_overhead = 5;
            timing::Memory memory(figures, {timing::CodePlace::itcm, timing::DataPlace::axi});
            EXPECT_EQ(memory.load(0x20000000).cycles, (5 + beats) * clocks) << bytes;
            EXPECT_EQ(memory.store(0x20000000).cycles, (5 + beats) * clocks) << bytes;
        }
    }
}

// The DTCM's words lie in two banks, and the data cache's; what comes past both from a bus or through the accelerator
// has none, nor has the ITCM.
TEST(Memory, HasBanksInTheDtcmAndInTheDataCache) {
    timing::Figures figures = probe::core("stm32f746-flash").figures;
    const auto banks_at = [&](timing::CodePlace code, timing::DataPlace data, std::uint32_t address) {
        return timing::Memory(figures, {code, data}).has_banks(address);
    };
    constexpr auto flash = timing::CodePlace::flash;
    constexpr auto axi = timing::DataPlace::axi;
    for (const std::int64_t bytes : {4096, 0}) {
        figures.cache_data_bytes = bytes;
        EXPECT_TRUE(banks_at(timing::CodePlace::itcm, timing::DataPlace::dtcm, 0x20000000));
        EXPECT_FALSE(banks_at(timing::CodePlace::itcm, timing::DataPlace::dtcm, 0x100));
        EXPECT_EQ(banks_at(flash, axi, 0x20000000), bytes > 0);
        EXPECT_EQ(banks_at(flash, axi, 0x100), bytes > 0);
    }
    figures.cache_data_bytes = 4096;
    figures.memory_art_lines = 64;
    EXPECT_FALSE(banks_at(flash, axi, 0x100));
}

// The flash holds the line that it read last for fetches, and another one for loads: neither saves the other a read,
// whether caches ask or the core itself. A second access by the same side takes the bus alone.
TEST(Memory, FetchesAndLoadsEachHaveALineOfTheFlashOpen) {
    for (const char* core : {"stm32f746-flash", "stm32f746-flash-nocache"}) {
        timing::Figures figures = probe::core(core).figures;
        const timing::Placement placement{timing::CodePlace::flash, timing::DataPlace::axi};
        const std::int64_t line = figures.memory_flash_line_bytes;
        ASSERT_GE(line, 8) << core;
        // Of the least lines that a cache can have, so that one line of the flash is read in two.
        figures.cache_line_bytes = 4;
        const std::int64_t bus = figures.memory_bus_overhead * figures.memory_bus_clocks;
        const std::int64_t read = 8 * figures.memory_bus_clocks;  // seven wait states at 216 MHz, and the read itself
        timing::Memory fetches_first(figures, placement);
        EXPECT_EQ(fetches_first.fetch(0x100).cycles, bus + read) << core;
        EXPECT_EQ(fetches_first.load(0x100).cycles, bus + read) << core;
        EXPECT_EQ(fetches_first.fetch(0x104).cycles, bus) << core;
        EXPECT_EQ(fetches_first.load(0x104).cycles, bus) << core;
        timing::Memory loads_first(figures, placement);
        EXPECT_EQ(loads_first.load(0x100).cycles, bus + read) << core;
        EXPECT_EQ(loads_first.fetch(0x100).cycles, bus + read) << core;
    }
}

// A real program mixes memories: of two ranges that overlap the later one holds, and neither reaches behind its end.
TEST(Memory, RangesLieElsewhereThanTheirNeighbours) {
    const timing::Figures figures = timing::read_core(TEST_CORES, "stm32f746-flash-nocache").sets[0].figures;
    const timing::Placement placement{timing::CodePlace::flash,
                                      timing::DataPlace::dtcm,
                                      {{0x100, 0x200, timing::Place::dtcm},
                                       {0x180, 0x190, timing::Place::axi},
                                       {0x20000100, 0x20000200, timing::Place::axi}}};
    timing::Memory memory(figures, placement);
    for (const std::uint32_t near : {0x100U, 0x17CU, 0x190U, 0x1FCU, 0x200000FCU, 0x20000200U}) {
        EXPECT_EQ(memory.load(near).cycles, 0) << near;
        EXPECT_TRUE(memory.in_dtcm(near)) << near;
        EXPECT_TRUE(memory.fetches_freely(near, near + 3)) << near;
        EXPECT_EQ(memory.store(near).cycles, 0) << near;
    }
    for (const std::uint32_t far : {0xFCU, 0x180U, 0x18CU, 0x200U, 0x20000100U, 0x200001FCU}) {
        EXPECT_GT(memory.load(far).cycles, 0) << far;
        EXPECT_FALSE(memory.in_dtcm(far)) << far;
        EXPECT_FALSE(memory.fetches_freely(far, far + 3)) << far;
    }
    EXPECT_GT(memory.store(0x20000100).cycles, 0);
    EXPECT_EQ(memory.store(0x200).cycles, 0);  // a flash
    // A block with a range's edge in it is looked at word by word.
    EXPECT_FALSE(memory.fetches_freely(0x170, 0x197));
    EXPECT_EQ(memory.longest_fetch(), timing::Memory(figures, {timing::CodePlace::flash}).longest_fetch());
    EXPECT_GT(timing::Memory(figures, {{}, {}, {{0, 4, timing::Place::axi}}}).longest_fetch(), 0);
    EXPECT_EQ(timing::Memory(figures, {{}, {}, {{0, 4, timing::Place::dtcm}}}).longest_fetch(), 0);
}

}  // namespace
