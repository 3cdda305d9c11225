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
    static constexpr Family family = window_family;
    static constexpr std::string_view summary = "every sample moves one place on at each step";
    static constexpr std::string_view fields = "    @sample@ past[@NAME@_SAMPLES]; /* x_(k-1), x_(k-2), ... */\n";
    static constexpr bool contiguous = true;

    static constexpr std::size_t past_count(std::size_t past) { return past; }

    template <class T>
    static Window<T> window(const T* samples, std::size_t past, std::uint32_t) {
        // C99: shift window
        const T* const newer = samples;
        const std::size_t newer_count = past;
        // C99 end
        return {newer, newer_count, samples, 0, 0};
    }

    template <class T>
    static void push(T* samples, std::size_t past, std::uint32_t&, T newest) {
        if (past == 0) {
            return;
        }
        // C99: shift push
        // Where its flags are not ours a compiler would call memmove, which small C libraries copy byte by byte.
        for (std::size_t i = past - 1; i > 0; --i) {
            T moved = samples[i - 1];
            GLSUM_KEEP_WORD(moved);
            samples[i] = moved;
        }
        samples[0] = newest;
        // C99 end
    }
};

}  // namespace glsum
