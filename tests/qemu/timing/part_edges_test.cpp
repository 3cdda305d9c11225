// The parts of the model at their edges: how much each of them holds, and what leaves it first.
#include <gtest/gtest.h>

#include "qemu/timing/cache.hpp"
#include "qemu/timing/core_file.hpp"
#include "qemu/timing/decode.hpp"
#include "qemu/timing/memory.hpp"
#include "qemu/timing/predictor.hpp"
#include "qemu/timing/store_buffer.hpp"
#include "qemu/timing/stored_words.hpp"

namespace {

using timing::Branch;
using timing::Prediction;

timing::Decoded branch_of(Branch kind, std::uint8_t bytes = 2) {
    timing::Decoded d;
    d.kind = timing::Kind::branch;
    d.branch = kind;
    d.bytes = bytes;
    return d;
}

constexpr std::uint32_t elsewhere = 0x8000;

// Whether the table has a branch, and then it has it as the one used last.
bool knows(timing::Predictor& predictor, std::uint32_t address) {
    return predictor.meet(branch_of(Branch::direct), address, elsewhere) == Prediction::right;
}

// 64 entries are 16 sets of 4, by the address in halfwords.
TEST(PredictorEdges, HoldsFourBranchesOfEachSet) {
    timing::Predictor all(64, 0);
    for (const bool again : {false, true}) {
        for (std::uint32_t n = 0; n < 64; ++n) {
            EXPECT_EQ(knows(all, 0x100 + 2 * n), again) << n;
        }
    }
    for (const std::uint32_t branches : {4U, 5U}) {
        timing::Predictor one_set(64, 0);
        for (const bool again : {false, true}) {
            for (std::uint32_t n = 0; n < branches; ++n) {
                EXPECT_EQ(knows(one_set, 0x100 + 32 * n), again && branches == 4) << n;
            }
        }
    }
}

// Sets are a power of two in number, and one at least.
TEST(PredictorEdges, HasAsManySetsAsGoIntoItsEntries) {
    for (const auto& [entries, sets] : {std::pair(1, 1U), std::pair(4, 1U), std::pair(7, 1U), std::pair(8, 2U),
                                        std::pair(31, 4U), std::pair(32, 8U)}) {
        timing::Predictor predictor(entries, 0);
        std::uint32_t held = 0;
        for (const bool again : {false, true}) {
            for (std::uint32_t n = 0; n < 4 * sets; ++n) {
                held += knows(predictor, 0x100 + 2 * n) && again ? 1U : 0U;
            }
        }
        EXPECT_EQ(held, 4 * sets) << entries;
        EXPECT_FALSE(knows(predictor, 0x100 + 8 * sets)) << entries;
        EXPECT_FALSE(knows(predictor, 0x100)) << entries << ": one more of its set came, and it was the oldest";
    }
}

// Of the four of a set the one used longest ago. A branch that is not taken takes up no entry, and leaves the others in
// their order.
TEST(PredictorEdges, TheBranchUsedLongestAgoLeaves) {
    for (const bool again : {true, false}) {
        timing::Predictor predictor(4, 0);
        for (const std::uint32_t address : {0x100U, 0x200U, 0x300U, 0x400U}) {
            EXPECT_FALSE(knows(predictor, address));
        }
        if (again) {
            EXPECT_TRUE(knows(predictor, 0x100));
        }
        EXPECT_EQ(predictor.meet(branch_of(Branch::conditional), 0x500, 0x502), Prediction::right);
        EXPECT_FALSE(knows(predictor, 0x600));
        const std::uint32_t stays = again ? 0x100 : 0x200;
        for (const std::uint32_t address : {stays, 0x300U, 0x400U, 0x600U}) {
            EXPECT_TRUE(knows(predictor, address)) << address;
        }
        EXPECT_FALSE(knows(predictor, again ? 0x200 : 0x100));
    }
}

// However often a branch was taken, two misses turn it; however often it was not, two do.
TEST(PredictorEdges, CountersEndAtTheirTwoBits) {
    timing::Predictor predictor(64, 0);
    const auto expect = [&](bool taken, Prediction prediction, int times) {
        for (int n = 0; n < times; ++n) {
            EXPECT_EQ(predictor.meet(branch_of(Branch::conditional), 0x110, taken ? 0x120U : 0x112U), prediction)
                << taken << n;
        }
    };
    expect(true, Prediction::wrong, 1);
    for (int turn = 0; turn < 2; ++turn) {
        expect(true, Prediction::right, 8);
        expect(false, Prediction::wrong, 2);
        expect(false, Prediction::right, 8);
        expect(true, Prediction::wrong, 2);
    }
}

// The table has where an indirect branch went last.
TEST(PredictorEdges, AnIndirectBranchIsForeseenWhereItWentLast) {
    timing::Predictor predictor(64, 0);
    const timing::Decoded jump = branch_of(Branch::indirect);
    for (const std::uint32_t target : {0x200U, 0x300U, 0x200U}) {
        EXPECT_EQ(predictor.meet(jump, 0x110, target), Prediction::wrong);
        EXPECT_EQ(predictor.meet(jump, 0x110, target), Prediction::right);
    }
}

// Without a stack nothing of a call is known; of 1024 calls it may hold all, whatever is asked for.
TEST(PredictorEdges, TheStackHoldsBetweenNoneAndAThousandReturns) {
    const timing::Decoded call = branch_of(Branch::call, 4);
    const timing::Decoded back = branch_of(Branch::back);
    for (const std::int64_t returns : {-1, 0}) {
        timing::Predictor none(64, returns);
        (void)none.meet(call, 0x200, 0x100);
        EXPECT_EQ(none.meet(back, 0x110, 0x204), Prediction::wrong);
    }
    timing::Predictor most(64, 5000);
    constexpr std::uint32_t calls = 1025;
    for (std::uint32_t n = 0; n < calls; ++n) {
        (void)most.meet(call, 0x1000 + 8 * n, 0x100);
    }
    for (std::uint32_t n = calls; n > 1; --n) {
        ASSERT_EQ(most.meet(back, 0x110, 0x1000 + 8 * (n - 1) + 4), Prediction::right) << n;
    }
    EXPECT_EQ(most.meet(back, 0x110, 0x1004), Prediction::wrong);
}

// A call whose condition was false left no return address, and a return whose condition decides is a branch like
// others.
TEST(PredictorEdges, WhatIsNotCarriedOutMovesNoStack) {
    const timing::Decoded call = branch_of(Branch::call, 4);
    timing::Decoded back = branch_of(Branch::back);
    timing::Predictor predictor(64, 4);
    (void)predictor.meet(call, 0x200, 0x100);
    (void)predictor.meet(call, 0x300, 0x304);  // skipped
    back.in_it_block = true;
    EXPECT_EQ(predictor.meet(back, 0x110, 0x112), Prediction::right);  // as well
    EXPECT_EQ(predictor.meet(back, 0x110, 0x204), Prediction::wrong);  // where to, the table has yet to learn
    back.in_it_block = false;
    EXPECT_EQ(predictor.meet(back, 0x120, 0x204), Prediction::right);
}

// LR is not what lies behind a jump that loads it with PC: the return before it is still the next one.
TEST(PredictorEdges, AJumpThatLoadsLrIsNoCall) {
    timing::Predictor predictor(64, 4);
    (void)predictor.meet(branch_of(Branch::call, 4), 0x200, 0x100);
    (void)predictor.meet(timing::decode(0xE893C000, 4), 0x100, 0x300);  // ldm.w r3, {lr, pc}
    EXPECT_EQ(predictor.meet(branch_of(Branch::back), 0x310, 0x204), Prediction::right);
}

// Counters by history: 4096 of them, so that addresses 8192 bytes apart share theirs, and 4096 bytes apart do not.
TEST(PredictorEdges, HistoriesChooseAmongFourThousandCounters) {
    timing::Predictor predictor(64, 0, true);
    const auto meets = [&](std::uint32_t address, bool taken) {
        return predictor.meet(branch_of(Branch::conditional), address, taken ? elsewhere : address + 2);
    };
    constexpr std::uint32_t one = 0x110;
    constexpr std::uint32_t alike = one + 8192;
    constexpr std::uint32_t other = one + 4096;
    for (const std::uint32_t address : {one, alike, other}) {
        EXPECT_EQ(meets(address, true), Prediction::wrong);  // forward: not taken, it says
    }
    const auto forget = [&] {  // eight directions of a branch that has no entry
        for (int n = 0; n < 8; ++n) {
            EXPECT_EQ(meets(0x202, false), Prediction::right);
        }
    };
    forget();
    EXPECT_EQ(meets(one, false), Prediction::wrong);  // a counter begins at 2: taken
    EXPECT_EQ(meets(one, false), Prediction::right);
    EXPECT_EQ(meets(alike, false), Prediction::right);
    EXPECT_EQ(meets(other, false), Prediction::wrong);
}

// Before the first branch none was taken: what comes behind one taken branch is known again when there was one since
// long.
TEST(PredictorEdges, AHistoryBeginsWithNothingTaken) {
    timing::Predictor predictor(64, 0, true);
    const auto meets = [&](std::uint32_t address, bool taken) {
        return predictor.meet(branch_of(Branch::conditional), address, taken ? elsewhere : address + 2);
    };
    EXPECT_EQ(meets(0x110, true), Prediction::wrong);
    EXPECT_EQ(meets(0x110, false), Prediction::wrong);
    for (int n = 0; n < 8; ++n) {
        EXPECT_EQ(meets(0x202, false), Prediction::right);
    }
    EXPECT_EQ(meets(0x110, true), Prediction::right);
    EXPECT_EQ(meets(0x110, false), Prediction::right);
}

// Nor does a table that holds nothing yet know any address, the lowest neither.
TEST(PredictorEdges, AnEmptyTableKnowsNoBranch) {
    for (const std::uint32_t address : {0U, 2U, 4U}) {
        timing::Predictor predictor(4, 0);
        EXPECT_EQ(predictor.meet(branch_of(Branch::direct), address, elsewhere), Prediction::right_without_entry);
    }
}

// As many sets as go in, rounded down to a power of two; of no ways there is one.
TEST(CacheEdges, HasSetsOfAPowerOfTwo) {
    timing::Cache cache(3072, 4, 32);  // 24 sets would go in: 16
    for (const std::uint32_t n : {0U, 16U, 32U, 48U, 64U}) {
        EXPECT_FALSE(cache.touch(32 * n));  // the fifth of one set
    }
    EXPECT_FALSE(cache.touch(0));
    timing::Cache of_one(64, 1, 32);
    timing::Cache of_none(64, 0, 32);
    for (timing::Cache* direct : {&of_one, &of_none}) {
        EXPECT_FALSE(direct->touch(0));
        EXPECT_FALSE(direct->touch(32));
        EXPECT_TRUE(direct->touch(0));
        EXPECT_FALSE(direct->touch(64));
        EXPECT_FALSE(direct->touch(0));
        EXPECT_TRUE(direct->touch(32));
    }
    timing::Cache less_than_a_set(64, 4, 32);  // one set all the same
    for (const bool again : {false, true}) {
        for (const std::uint32_t n : {0U, 1U, 2U, 3U}) {
            EXPECT_EQ(less_than_a_set.touch(32 * n), again) << n;
        }
    }
}

// Bit n stands for the last store but n. Bytes and halves are of their word; words that are alike in their low bits are
// not the same.
TEST(StoredWords, TellWhichOfTheLastEightStoresALoadMeets) {
    timing::StoredWords words;
    for (const std::uint32_t address : {0U, 0x100U, 0xFFFFFFFCU, 0x3FCU}) {
        EXPECT_EQ(words.met_by(address), 0U) << address;
    }
    words.add(0x100);
    EXPECT_EQ(words.met_by(0x100), 1U);
    EXPECT_EQ(words.met_by(0x103), 1U);
    EXPECT_EQ(words.met_by(0x104), 0U);
    EXPECT_EQ(words.met_by(0xFF), 0U);
    EXPECT_EQ(words.met_by(0x500), 0U);  // 256 words on
    words.add(0x102);
    EXPECT_EQ(words.met_by(0x101), 3U);
    for (std::uint32_t n = 0; n < 6; ++n) {
        words.add(0x200 + 4 * n);
        EXPECT_EQ(words.met_by(0x200 + 4 * n), 1U);
    }
    EXPECT_EQ(words.met_by(0x200), 1U << 5);
    EXPECT_EQ(words.met_by(0x100), 3U << 6);
    words.add(0x300);
    EXPECT_EQ(words.met_by(0x100), 1U << 7);
    words.add(0x300);
    EXPECT_EQ(words.met_by(0x100), 0U);
    EXPECT_EQ(words.met_by(0x300), 3U);
    EXPECT_EQ(words.met_by(0x200), 1U << 7);
}

timing::Figures buffer_figures(std::int64_t entries) {
    timing::Figures figures;
    figures.store_entries = entries;
    figures.store_word = 3;
    figures.store_narrow = 5;
    figures.store_unaligned = 7;
    return figures;
}

// Each store takes its bank for its own time, from when the bank is free; what is no word of one bank takes both.
TEST(StoreBufferEdges, EachStoreTakesItsBank) {
    const timing::Figures figures = buffer_figures(16);
    timing::StoreBuffer buffer;
    const auto banks = [&](std::int32_t even, std::int32_t odd) {
        EXPECT_EQ(buffer.free[0], even);
        EXPECT_EQ(buffer.free[1], odd);
    };
    buffer.add(figures, 10, 0, false, 4, 0);
    banks(13, 0);
    buffer.add(figures, 10, 1, false, 4, 2);  // two cycles more, of its memory
    banks(13, 15);
    buffer.add(figures, 11, 0, false, 2, 0);  // waits for its bank
    banks(18, 15);
    buffer.add(figures, 20, 1, false, 1, 1);
    banks(18, 26);
    buffer.add(figures, 21, 0, false, 8, 0);  // a double, behind the odd bank
    banks(29, 29);
    buffer.add(figures, 30, 1, false, 4, 0);
    buffer.add(figures, 30, 0, false, 2, 0);
    banks(35, 33);
    buffer.add(figures, 31, 1, true, 4, 4);  // unaligned, behind the even bank
    banks(46, 46);
    buffer.add(figures, 50, 1, true, 2, 0);
    banks(57, 57);
}

// As many entries as a core file says, one at least and sixteen at most: the first one waits for none of them.
TEST(StoreBufferEdges, HoldsOneToSixteenStores) {
    for (const auto& [entries, holds] : {std::pair(0, 1), std::pair(1, 1), std::pair(2, 2), std::pair(15, 15),
                                         std::pair(16, 16), std::pair(17, 16), std::pair(40, 16)}) {
        const timing::Figures figures = buffer_figures(entries);
        timing::StoreBuffer buffer;
        int at_once = 0;
        while (buffer.free_from(figures) == 0 && at_once < 40) {
            buffer.add(figures, 0, 0, false, 4, 0);
            ++at_once;
        }
        EXPECT_EQ(at_once, holds) << entries;
        EXPECT_EQ(buffer.free_from(figures), 3) << entries;
    }
}

TEST(StoreBufferEdges, SetsEachEntryAndBankBack) {
    const timing::Figures figures = buffer_figures(4);
    timing::StoreBuffer buffer;
    for (int n = 0; n < 4; ++n) {
        buffer.add(figures, 0, n == 3 ? 1U : 0U, false, 4, n == 3 ? 20 : 0);
    }
    buffer.settle(figures, 5);  // done at 3, 6, 9 on one bank, and at 23 on the other
    EXPECT_EQ(buffer.free, (std::array<std::int32_t, 2>{4, 18}));
    std::array<std::int32_t, timing::StoreBuffer::depth> done{};
    done[1] = 1;
    done[2] = 4;
    done[3] = 18;
    EXPECT_EQ(buffer.done, done);
}

timing::Figures memory_figures() {
    timing::Figures figures = timing::read_core(TEST_CORES, "stm32f746-flash").sets[0].figures;
    figures.cache_instruction_bytes = figures.cache_data_bytes = 0;
    return figures;
}

constexpr auto flash_code = timing::CodePlace::flash;
constexpr auto axi_data = timing::DataPlace::axi;

// Without a wait state, with nothing on the bus and the bus at the core's clock, a memory is as good as tightly
// coupled.
TEST(MemoryEdges, NothingWaitsWhereNeitherFlashNorBusDoes) {
    timing::Figures figures = memory_figures();
    figures.memory_clock_hz = figures.memory_flash_hz_per_wait_state;
    figures.memory_bus_overhead = 0;
    figures.memory_bus_clocks = 1;
    const auto fetch = [&] { return timing::Memory(figures, {flash_code, axi_data}).fetch(0x100).cycles; };
    timing::Memory as_good(figures, {flash_code, axi_data});
    EXPECT_EQ(fetch(), 0);
    EXPECT_EQ(as_good.load(0x20000000).cycles, 0);
    EXPECT_EQ(as_good.store(0x20000000).cycles, 0);
    EXPECT_TRUE(as_good.fetches_freely(0x100, 0x1000));
    figures.memory_bus_overhead = 1;
    EXPECT_EQ(fetch(), 1 + 1);
    figures.memory_bus_overhead = 0;
    figures.memory_bus_clocks = 2;
    EXPECT_EQ(fetch(), 2);
    figures.memory_bus_clocks = 1;
    figures.memory_clock_hz = figures.memory_flash_hz_per_wait_state + 1;
    EXPECT_EQ(fetch(), 1 + 1);
}

// Only the line behind the last one was read ahead, where anything is; it takes what is left of the read, if that is
// anything.
TEST(MemoryEdges, TheAcceleratorReadsOneLineAhead) {
    timing::Figures figures = memory_figures();
    figures.memory_art_lines = 64;
    for (const std::int64_t prefetch : {0, 1}) {
        figures.memory_art_prefetch = prefetch;
        timing::Memory memory(figures, {flash_code, axi_data});
        EXPECT_EQ(memory.fetch(0x100).cycles, 8);
        EXPECT_EQ(memory.fetch(0x120).cycles, prefetch == 1 ? 8 - 4 : 8);
        EXPECT_EQ(memory.fetch(0x160).cycles, 8);  // one was left out
        EXPECT_EQ(memory.fetch(0x120).cycles, 0);
        EXPECT_EQ(memory.fetch(0x140).cycles, prefetch == 1 ? 8 - 4 : 8);  // behind a line that was there
        EXPECT_EQ(memory.fetch(0x100).cycles, 0);
    }
    for (const auto& [line, left] : {std::pair(64, 0), std::pair(128, 0), std::pair(32, 4), std::pair(16, 6)}) {
        figures.memory_flash_line_bytes = line;
        timing::Memory memory(figures, {flash_code, axi_data});
        const auto bytes = static_cast<std::uint32_t>(line);
        EXPECT_EQ(memory.fetch(4 * bytes).cycles, 8) << line;
        EXPECT_EQ(memory.fetch(5 * bytes).cycles, left) << line;
    }
}

// A stretch is looked at word by word where a range begins or ends within it: not where it meets one of its ends.
TEST(MemoryEdges, AStretchIsFetchedFreelyUpToARange) {
    const timing::Figures figures = memory_figures();
    const timing::Memory memory(
        figures, {timing::CodePlace::itcm, timing::DataPlace::dtcm, {{0x180, 0x190, timing::Place::dtcm}}});
    EXPECT_TRUE(memory.fetches_freely(0x170, 0x17F));
    EXPECT_FALSE(memory.fetches_freely(0x170, 0x180));
    EXPECT_TRUE(memory.fetches_freely(0x180, 0x18F));
    EXPECT_FALSE(memory.fetches_freely(0x180, 0x190));
    EXPECT_FALSE(memory.fetches_freely(0x18F, 0x190));
    EXPECT_TRUE(memory.fetches_freely(0x190, 0x19F));
    EXPECT_FALSE(memory.fetches_freely(0x170, 0x1A0));
}

// Without an instruction cache each word that comes from afar is asked for.
TEST(MemoryEdges, NothingIsFetchedFreelyFromAfarWithoutACache) {
    const timing::Figures figures = memory_figures();
    timing::Memory memory(figures, {flash_code, axi_data});
    (void)memory.fetch(0x100);
    EXPECT_FALSE(memory.fetches_freely(0x100, 0x103));
}

// Either memory may be the slower one: a flash that is read anew, or a line's first eight bytes from narrow RAM.
TEST(MemoryEdges, TheLongestFetchIsOfTheSlowerMemory) {
    timing::Figures figures = memory_figures();
    const auto longest = [&] { return timing::Memory(figures, {flash_code, axi_data}).longest_fetch(); };
    EXPECT_EQ(longest(), 7 + 1 + 4);  // wait states, the read, the bus
    figures.memory_bus_clocks = 2;    // 108 MHz: 3 wait states
    EXPECT_EQ(longest(), (3 + 1 + 4) * 2);
    figures.memory_sram_beat_bytes = 1;
    EXPECT_EQ(longest(), (4 + 8) * 2);
}

}  // namespace
