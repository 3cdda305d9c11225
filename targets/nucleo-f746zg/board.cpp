// Clocks, flash, caches and the cycle counter of the Nucleo-F746ZG.
#include <string_view>

#include "port.hpp"
#include "registers.hpp"

extern "C" {
// Where kernels are to run in ITCM; else there is nothing of that name.
extern std::uint32_t link_itcm_source[] [[gnu::weak]];
extern std::uint32_t link_itcm_begin[] [[gnu::weak]];
extern std::uint32_t link_itcm_end[] [[gnu::weak]];
extern std::uint32_t link_vectors[];
}

namespace port {
namespace {

using namespace stm32f746;

constexpr std::string_view code = GLSUM_CODE;
constexpr std::string_view data = GLSUM_DATA;
constexpr std::uint32_t wait_states = 7;  // 210 to 216 MHz at 2.7 to 3.6 V [RM0385, table 5]

void set(std::uint32_t address, std::uint32_t mask, std::uint32_t value) {
    at(address) = (at(address) & ~mask) | value;
}
void wait_for(std::uint32_t address, std::uint32_t mask, std::uint32_t value) {
    while ((at(address) & mask) != value) {
    }
}
void barrier() { asm volatile("dsb\n isb" ::: "memory"); }

// 216 MHz from the internal 16 MHz oscillator: no solder bridge or crystal decides. Buses: AHB 216, APB1 54, APB2 108
// MHz.
void start_clocks() {
    enable(rcc::apb1enr, bit(28));      // PWR
    set(pwr::cr1, 3U << 14, 3U << 14);  // scale 1
    // PLL: 16 MHz / 8 * 216 / 2; 48 MHz / 9 is not used.
    at(rcc::pllcfgr) = 8U | 216U << 6 | 0U << 16 | 9U << 24;
    at(rcc::cr) = at(rcc::cr) | bit(24);
    // Above 180 MHz the regulator is in over-drive.
    at(pwr::cr1) = at(pwr::cr1) | bit(16);
    wait_for(pwr::csr1, bit(16), bit(16));
    at(pwr::cr1) = at(pwr::cr1) | bit(17);
    wait_for(pwr::csr1, bit(17), bit(17));
    // Wait states before the clock that needs them. Accelerator off and reset first: its lines may be of other content.
    at(flash::acr) = wait_states;
    at(flash::acr) = wait_states | bit(11);
    at(flash::acr) = wait_states | (GLSUM_ART ? bit(8) | bit(9) : 0U);
    wait_for(flash::acr, 0xFU, wait_states);
    wait_for(rcc::cr, bit(25), bit(25));
    set(rcc::cfgr, 0xFU << 4 | 7U << 10 | 7U << 13, 5U << 10 | 4U << 13);
    set(rcc::cfgr, 3U, 2U);
    wait_for(rcc::cfgr, 3U << 2, 2U << 2);
}

// Calls by_set_and_way(register value) for each line of the data cache.
template <class Operation>
void for_each_line(Operation operation) {
    at(core::csselr) = 0;
    asm volatile("dsb" ::: "memory");
    const std::uint32_t size = at(core::ccsidr);
    const std::uint32_t last_set = size >> 13 & 0x7FFFU;
    const std::uint32_t last_way = size >> 3 & 0x3FFU;
    for (std::uint32_t s = 0; s <= last_set; ++s) {
        for (std::uint32_t way = 0; way <= last_way; ++way) {
            operation(s << 5 | way << 30);  // lines of 32 bytes, 4 ways
        }
    }
    barrier();
}

void start_caches() {
    if (code == "flash_cached") {
        barrier();
        at(core::iciallu) = 0;
        barrier();
        at(core::ccr) = at(core::ccr) | bit(17);
        barrier();
    }
    if (GLSUM_DATA_CACHE != 0) {
        for_each_line([](std::uint32_t line) { at(core::dcisw) = line; });
        at(core::ccr) = at(core::ccr) | bit(16);
        barrier();
    }
}

void start_counter() {
    at(core::demcr) = at(core::demcr) | bit(24);
    at(core::dwt_lar) = 0xC5ACCE55;  // a Cortex-M7 locks its DWT against software
    at(core::dwt_cyccnt) = 0;
    at(core::dwt_ctrl) = at(core::dwt_ctrl) | bit(0);
}

}  // namespace

void start() {
    start_clocks();
    at(core::vtor) = reinterpret_cast<std::uint32_t>(link_vectors);
    const std::uint32_t* source = link_itcm_source;
    for (std::uint32_t* word = link_itcm_begin; word < link_itcm_end;) {
        *word++ = *source++;
    }
    barrier();
    start_caches();
    start_counter();
}

std::uint32_t cycles() { return at(core::dwt_cyccnt); }

Memories memories() {
    Memories memories{code, data, GLSUM_MAINTENANCE != 0, GLSUM_SETUP};
    if (link_itcm_end != nullptr) {
        memories.code_end = reinterpret_cast<std::uintptr_t>(link_itcm_end);
    }
    return memories;
}

void maintain_data_cache() {
    for_each_line([](std::uint32_t line) { at(core::dccisw) = line; });
}

}  // namespace port
