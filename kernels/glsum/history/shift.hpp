// shift: the newest sample lies at index 0 and every sample moves one place on at each step.
// Upkeep: taps - 1 loads and stores a sample. One contiguous piece. Memory: taps - 1 samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "glsum/history/window.hpp"

namespace glsum {

struct Shift {
    static constexpr std::string_view word = "shift";
    static constexpr bool contiguous = true;

    static constexpr std::size_t past_count(std::size_t past) { return past; }

    template <class T>
    static Window<T> window(const T* samples, std::size_t past, std::uint32_t) {
        return {samples, past, samples, 0, 0};
    }

    template <class T>
    static void push(T* samples, std::size_t past, std::uint32_t&, T newest) {
        if (past == 0) {
            return;
        }
        std::memmove(samples + 1, samples, (past - 1) * sizeof(T));
        samples[0] = newest;
    }
};

}  // namespace glsum
