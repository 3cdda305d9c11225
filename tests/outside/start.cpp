// What starts a stranger's program on the emulated board: vectors, the FPU, and its end by semihosting.
#include <cstdint>

int main();

namespace {

[[noreturn]] void leave(int status) {
    const std::uint32_t parameters[2] = {0x20026,
                                         static_cast<std::uint32_t>(status)};  // an application's exit, extended
    register std::uint32_t operation asm("r0") = 0x20;
    register const void* block asm("r1") = parameters;
    asm volatile("bkpt 0xAB" : : "r"(operation), "r"(block) : "memory");
    for (;;) {
    }
}

[[noreturn]] void reset() {
    *reinterpret_cast<volatile std::uint32_t*>(0xE000ED88) |= 0xF00000;  // coprocessors 10 and 11
    asm volatile("dsb\nisb" ::: "memory");
    leave(main());
}

[[noreturn]] void fault() { leave(99); }

}  // namespace

[[gnu::section(".vectors"), gnu::used]] void (*const vectors[4])() = {reinterpret_cast<void (*)()>(0x20400000), reset,
                                                                      fault, fault};
