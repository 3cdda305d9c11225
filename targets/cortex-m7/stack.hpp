// How deep a call's stack goes, by painting.
#pragma once

#include <cstddef>
#include <cstdint>

namespace cortex_m7 {

/// Bytes of stack that `call` touches below its caller's own frame. Interrupts must be off.
/// Counts at most 8 KB; a call that leaves the pattern's value at its lowest word is counted short by that word.
template <class Call>
[[gnu::noinline]] std::size_t stack_bytes(Call call) {
    constexpr std::uint32_t pattern = 0xC5A11ACEU;
    constexpr std::size_t words = 2048;
    volatile std::uint32_t* top;
    asm volatile("mov %0, sp" : "=r"(top));
    for (std::size_t i = 1; i <= words; ++i) {
        top[-static_cast<std::ptrdiff_t>(i)] = pattern;
    }
    call();
    std::size_t untouched = words;
    while (untouched > 0 && top[-static_cast<std::ptrdiff_t>(untouched)] == pattern) {
        --untouched;
    }
    return untouched * sizeof(std::uint32_t);
}

}  // namespace cortex_m7
