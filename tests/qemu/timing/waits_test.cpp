// Memories that wait: on each core a wait counts from its first cycle on, for each kind of access, and has its name.
#include <gtest/gtest.h>

#include <algorithm>

#include "probe.hpp"
#include "qemu/timing/effects.hpp"

namespace {

using timing::Effect;

enum class Waits { code, data };

// Where code or data lies behind a bus, each access to it takes so many cycles more. There are no caches.
probe::Setting waiting(const char* core, std::int64_t cycles, Waits who) {
    probe::Setting setting = probe::core(core);
    setting.placement = {timing::CodePlace::itcm, timing::DataPlace::dtcm};
    timing::Figures& figures = setting.figures;
    figures.cache_data_bytes = 0;
    figures.cache_instruction_bytes = 0;
    figures.memory_art_lines = 0;
    figures.memory_bus_clocks = 1;
    figures.memory_sram_beat_bytes = 8;                                    // one beat,
    figures.memory_bus_overhead = std::max<std::int64_t>(0, cycles - 1);   // and the bus
    figures.memory_clock_hz = 2 * figures.memory_flash_hz_per_wait_state;  // of a chip without any nothing ever waits
    if (cycles > 0) {
        setting.placement = who == Waits::code ? timing::Placement{timing::CodePlace::axi, timing::DataPlace::dtcm}
                                               : timing::Placement{timing::CodePlace::itcm, timing::DataPlace::axi};
    }
    return setting;
}

constexpr const char* cores[] = {"cortex-m4-zerowait", "stm32f746-itcm"};

// What needs the word, or the place of a store, waits for it; there is nothing to do meanwhile.
TEST(Waits, OfDataCountFromTheirFirstCycle) {
    struct Case {
        const char* text;
        int accesses;
    };
    constexpr Case cases[] = {
        {"ldr.w r0,[r1]; add.w r0,r0,r2; eor.w r0,r0,r3", 1},
        {"ldr.w r0,[r1]; add.w r0,r0,r2; ldr.w r1,[r1]; add.w r0,r0,r1", 2},
        {"str.w r0,[r1]; str.w r0,[r1]", 2},
    };
    for (const char* core : cores) {
        for (const Case& test : cases) {
            const double none = probe::steady(test.text, probe::How::copies, waiting(core, 0, Waits::data));
            for (const std::int64_t cycles : {1, 2, 3, 7}) {
                EXPECT_EQ(probe::steady(test.text, probe::How::copies, waiting(core, cycles, Waits::data)),
                          none + static_cast<double>(test.accesses * cycles))
                    << core << ": " << test.text << ": " << cycles;
            }
        }
        const auto lost = [&](std::int64_t cycles) {
            return probe::run(probe::lines_of(cases[0].text), waiting(core, cycles, Waits::data))
                .losses[timing::index(Effect::dcache_misses)];
        };
        EXPECT_EQ(lost(0), 0) << core;
        EXPECT_GT(lost(1), 0) << core;
    }
}

// Words come one behind the other, each with its wait.
TEST(Waits, OfCodeCountFromTheirFirstCycle) {
    const char* const text = "add.w r0,r1,r2; add.w r3,r4,r5; add.w r6,r1,r2; add.w r7,r4,r5";
    for (const char* core : cores) {
        for (const std::int64_t cycles : {0, 1, 2, 3, 7}) {
            const probe::Setting setting = waiting(core, cycles, Waits::code);
            const double words = 16.0 / static_cast<double>(setting.figures.fetch_bytes);
            EXPECT_EQ(probe::steady(text, probe::How::copies, setting), words * static_cast<double>(1 + cycles))
                << core << ": " << cycles;
            const timing::Losses losses = probe::run(probe::lines_of(text), setting).losses;
            EXPECT_EQ(losses[timing::index(Effect::flash_wait_states)] > 0, cycles > 0) << core << ": " << cycles;
        }
    }
}

}  // namespace
