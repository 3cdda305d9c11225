// shift: the newest sample lies at index 0 and every sample moves one place on at each step.
// Upkeep: taps - 1 loads and stores a sample. One contiguous piece. Memory: taps - 1 samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "glsum/window/window.hpp"

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
        for (std::size_t i = past - 1; i > 0; --i) {
            samples[i] = samples[i - 1];
        }
        samples[0] = newest;
    }
};

}  // namespace glsum
