// What an instruction meets around the core: the words that its fetch takes up, its accesses and how late they come,
// and whether its branch was foreseen.
#include "qemu/timing/surroundings.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace {

using timing::Branch;
using timing::Effect;
using timing::Event;

const timing::Placement fast = {timing::CodePlace::itcm, timing::DataPlace::dtcm, {}};
const timing::Placement afar = {timing::CodePlace::flash, timing::DataPlace::axi, {}};

timing::Figures figures_of_flash() { return timing::read_core(TEST_CORES, "stm32f746-flash").sets[0].figures; }

timing::Decoded of_bytes(std::uint8_t bytes, Branch branch = Branch::none) {
    timing::Decoded d;
    d.bytes = bytes;
    d.branch = branch;
    return d;
}

class Around {
public:
    explicit Around(const timing::Placement& placement, const timing::Figures& figures = figures_of_flash(),
                    timing::Core core = timing::Core::cortex_m7)
        : surroundings_(figures, placement, core) {}
    Event fetch(std::uint32_t address, std::uint8_t bytes) {
        return surroundings_.meet(of_bytes(bytes), address, {}, address + bytes);
    }
    Event access(const std::vector<qemu::Access>& accesses) {
        return surroundings_.meet(of_bytes(4), 0x100, accesses, 0x104);
    }
    Event branch(Branch kind, std::uint32_t address, std::uint32_t next) {
        return surroundings_.meet(of_bytes(2, kind), address, {}, next);
    }

private:
    timing::Surroundings surroundings_;
};

// Eight bytes each. An instruction takes up those of its words that are not at hand; behind a taken branch none is.
TEST(Surroundings, AFetchTakesUpEachWordOnce) {
    Around around(fast);
    EXPECT_EQ(around.fetch(0x100, 4).words, 1U);
    EXPECT_EQ(around.fetch(0x104, 2).words, 0U);
    EXPECT_EQ(around.fetch(0x106, 4).words, 1U);  // of its two the second
    EXPECT_EQ(around.fetch(0x10A, 4).words, 0U);
    EXPECT_EQ(around.fetch(0x11E, 4).words, 2U);
    EXPECT_EQ(around.branch(Branch::conditional, 0x122, 0x124).words, 0U);  // not taken
    EXPECT_EQ(around.fetch(0x124, 2).words, 0U);
    EXPECT_EQ(around.branch(Branch::direct, 0x126, 0x120).words, 0U);
    EXPECT_EQ(around.fetch(0x120, 2).words, 1U);
    for (const std::uint32_t address : {0x120U, 0x122U, 0x124U, 0x126U}) {
        EXPECT_EQ(around.fetch(address, 2).second_half, address % 4 == 2) << address;
    }
}

// A line of the cache takes 7 wait states, the read and 4 cycles of the bus, for the word that brings it in.
TEST(Surroundings, EachWordComesAsLateAsItsMemorySays) {
    Around around(afar);
    using Delays = std::array<std::uint16_t, 4>;
    const Event both = around.fetch(0x11E, 4);  // the last word of a line, and the first of the next one
    EXPECT_EQ(both.fetch_delays, (Delays{12, 12, 0, 0}));
    EXPECT_EQ(both.fetch_effect, Effect::icache_misses);
    EXPECT_EQ(around.fetch(0x122, 2).fetch_delays, Delays{});
    const Event first = around.fetch(0x146, 4);  // the second word is of the same line
    EXPECT_EQ(first.words, 2U);
    EXPECT_EQ(first.fetch_delays, (Delays{12, 0, 0, 0}));
    EXPECT_EQ(first.fetch_effect, Effect::icache_misses);
}

// Of memories that lie a cycle away, the least that there is: a bus of eight bytes without any overhead.
TEST(Surroundings, ACycleIsLateToo) {
    timing::Figures figures = figures_of_flash();
    figures.cache_instruction_bytes = figures.cache_data_bytes = 0;
    figures.memory_bus_overhead = 0;
    figures.memory_sram_beat_bytes = 8;
    timing::Placement placement{timing::CodePlace::axi, timing::DataPlace::axi, {}};
    Around around(placement, figures);
    const Event fetched = around.fetch(0x100, 4);
    EXPECT_EQ(fetched.fetch_delays[0], 1U);
    EXPECT_EQ(fetched.fetch_effect, Effect::flash_wait_states);
    EXPECT_EQ(around.access({{0x20000000, 4, false}}).load_delay, 1U);
    const Event stored = around.access({{0x20000000, 4, true}});
    EXPECT_TRUE(stored.store_delayed);
    EXPECT_EQ(stored.store_delays[0], 1U);
    placement.ranges = {{0x20000000, 0x20001000, timing::Place::flash}};
    figures.memory_clock_hz = 30'000'000;  // no wait state: a read takes one cycle
    figures.memory_bus_overhead = 1;
    Around constants(placement, figures);
    const Event loaded = constants.access({{0x20000000, 4, false}});
    EXPECT_EQ(loaded.load_delay, 1U + 1U);
    EXPECT_EQ(loaded.load_effect, Effect::flash_wait_states);
    EXPECT_EQ(constants.access({{0x20000004, 4, false}}).load_delay, 1U);  // the line is open: the bus alone
}

// A load waits for all that it loads; of stores each has its own delay, and the next instruction none of them.
TEST(Surroundings, LoadsAddUpAndStoresDoNot) {
    Around around(afar);
    const Event loaded = around.access({{0x20000000, 4, false}, {0x20000020, 4, false}, {0x20000024, 4, false}});
    EXPECT_EQ(loaded.load_delay, 2U * (4 + 2));  // two lines
    EXPECT_EQ(loaded.load_effect, Effect::dcache_misses);
    EXPECT_FALSE(loaded.store_delayed);
    const Event stored = around.access({{0x2000005C, 4, true}, {0x20000060, 4, true}, {0x20000064, 4, true}});
    EXPECT_TRUE(stored.store_delayed);
    EXPECT_EQ(stored.store_effect, Effect::dcache_misses);
    EXPECT_EQ(stored.store_delays[0], 6U);
    EXPECT_EQ(stored.store_delays[1], 6U);
    EXPECT_EQ(stored.store_delays[2], 0U);
    EXPECT_EQ(stored.load_delay, 0U);
    const Event next = around.access({});
    EXPECT_FALSE(next.store_delayed);
    EXPECT_EQ(next.store_delays, Event{}.store_delays);
    EXPECT_EQ(next.accesses, 0U);
}

// A load meets the words that the last stores wrote, each of a store of several by itself.
TEST(Surroundings, ALoadMeetsTheLastStores) {
    Around around(fast);
    (void)around.access({{0x20000000, 4, true}, {0x20000004, 4, true}});
    EXPECT_EQ(around.access({{0x20000004, 4, false}}).meets, 1U);
    EXPECT_EQ(around.access({{0x20000000, 4, false}, {0x20000004, 4, false}}).meets, 2U);  // by its first word
    EXPECT_EQ(around.access({{0x20000008, 4, false}}).meets, 0U);
    EXPECT_EQ(around.access({{0x20000004, 4, true}}).meets, 0U);  // no load
}

// What the pipeline is told of accesses, by the first of them.
TEST(Surroundings, AccessesAreToldByTheirFirstAddress) {
    Around around(fast);
    struct Row {
        std::uint32_t offset;
        std::uint8_t bytes;
        bool odd, off_eight, unaligned;
    };
    for (const Row& row : {Row{0, 4, false, false, false}, Row{4, 4, true, true, false}, Row{8, 4, false, false, false},
                           Row{12, 4, true, true, false}, Row{16, 4, false, false, false}, Row{2, 4, false, true, true},
                           Row{5, 4, true, true, true}, Row{2, 2, false, true, false}, Row{6, 2, true, true, false},
                           Row{3, 2, false, true, true}, Row{7, 1, true, true, false}, Row{4, 8, true, true, false},
                           Row{8, 8, false, false, false}, Row{10, 8, false, true, true}}) {
        for (const bool store : {false, true}) {
            const Event event = around.access({{0x20000000 + row.offset, row.bytes, store}});
            EXPECT_EQ(event.accesses, 1U) << row.offset;
            EXPECT_EQ(event.access_bytes, row.bytes) << row.offset;
            EXPECT_EQ(event.odd_word == 1, row.odd) << row.offset;
            EXPECT_EQ(event.off_eight == 1, row.off_eight) << row.offset;
            EXPECT_EQ(event.unaligned == 1, row.unaligned) << row.offset << ' ' << int{row.bytes};
            EXPECT_EQ(event.has_banks, 1U) << row.offset;
            EXPECT_EQ(event.in_dtcm, 1U) << row.offset;
        }
    }
    EXPECT_EQ(around.access({{0x100, 4, false}}).has_banks, 0U);  // constants in the ITCM
    EXPECT_EQ(around.access({{0x100, 4, false}}).in_dtcm, 0U);
    std::vector<qemu::Access> many;
    for (std::uint32_t n = 0; n < 32; ++n) {
        many.push_back({0x20000000 + 4 * n, 4, false});
        EXPECT_EQ(around.access(many).accesses, n + 1);
    }
}

// Taken is what goes elsewhere; guesses are of cores that make them, and of branches.
TEST(Surroundings, BranchesAreForeseenByACoreThatPredicts) {
    for (const timing::Core core : {timing::Core::cortex_m7, timing::Core::cortex_m4}) {
        Around around(fast, figures_of_flash(), core);
        const bool guesses = core == timing::Core::cortex_m7;
        const Event jump = around.branch(Branch::indirect, 0x100, 0x200);
        EXPECT_TRUE(jump.taken);
        EXPECT_EQ(jump.prediction, guesses ? timing::Prediction::wrong : timing::Prediction::right);
        const Event again = around.branch(Branch::indirect, 0x100, 0x200);
        EXPECT_TRUE(again.taken);
        EXPECT_EQ(again.prediction, timing::Prediction::right);
        const Event skipped = around.branch(Branch::conditional, 0x300, 0x302);
        EXPECT_FALSE(skipped.taken);
        EXPECT_EQ(skipped.prediction, timing::Prediction::right);
        EXPECT_FALSE(around.fetch(0x302, 2).taken);
    }
}

}  // namespace
