// Vector table and start-up of a Cortex-M7, for every board.
#include <cstdint>

#include "port.hpp"

extern "C" {
extern std::uint32_t link_data_source[];
extern std::uint32_t link_data_begin[];
extern std::uint32_t link_data_end[];
extern std::uint32_t link_bss_begin[];
extern std::uint32_t link_bss_end[];
extern std::uint32_t link_stack_top[];
using Initialiser = void (*)();
extern Initialiser link_init_begin[];
extern Initialiser link_init_end[];

[[noreturn]] void reset_handler() {
    // CPACR: full access to coprocessors 10 and 11, the FPU. [ARMv7-M B3.2.20]
    auto* const cpacr = reinterpret_cast<volatile std::uint32_t*>(0xE000ED88U);
    *cpacr = *cpacr | (0xFU << 20);
    asm volatile("dsb\n isb" ::: "memory");
    port::start();
    const std::uint32_t* source = link_data_source;
    for (std::uint32_t* word = link_data_begin; word < link_data_end;) {
        *word++ = *source++;
    }
    for (std::uint32_t* word = link_bss_begin; word < link_bss_end;) {
        *word++ = 0;
    }
    for (Initialiser* initialise = link_init_begin; initialise < link_init_end; ++initialise) {
        (*initialise)();
    }
    port::exit(firmware_main());
}

// A fault must end the program with an error: a silent loop would look like slow work.
[[noreturn]] void fault_handler() {
    port::write("fault: the processor took an exception\n");
    port::exit(70);
}

struct VectorTable {
    std::uint32_t* stack_top;
    void (*handlers[15])();
};
extern const VectorTable vector_table;
[[gnu::section(".vectors"), gnu::used]] const VectorTable vector_table = {
    link_stack_top,
    {reset_handler, fault_handler, fault_handler, fault_handler, fault_handler, fault_handler, fault_handler,
     fault_handler, fault_handler, fault_handler, fault_handler, fault_handler, fault_handler, fault_handler,
     fault_handler}};
}
