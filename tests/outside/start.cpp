// What starts a stranger's program on the emulated board: vectors, the FPU, and by semihosting what it says, and its
// end.
#include <cstdint>

int main();
void say(const char* line);

namespace {

void ask(std::uint32_t number, const void* parameter) {
    register std::uint32_t operation asm("r0") = number;
    register const void* block asm("r1") = parameter;
    asm volatile("bkpt 0xAB" : "+r"(operation) : "r"(block) : "memory");
}

[[noreturn]] void leave(int status) {
    const std::uint32_t parameters[2] = {0x20026,
                                         static_cast<std::uint32_t>(status)};  // an application's exit, extended
    ask(0x20, parameters);
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

void say(const char* line) { ask(4, line); }

[[gnu::section(".vectors"), gnu::used]] void (*const vectors[4])() = {reinterpret_cast<void (*)()>(0x20400000), reset,
                                                                      fault, fault};
