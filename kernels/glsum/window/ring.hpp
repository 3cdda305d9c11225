// ring: samples stay where they are; the head moves down by one place a sample and wraps.
// Upkeep: one store. Two contiguous pieces, so that no tap tests for the wrap. Memory: taps - 1 samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "glsum/window/window.hpp"

namespace glsum {

struct Ring {
    static constexpr std::string_view word = "ring";
    static constexpr Family family = window_family;
    static constexpr std::string_view summary = "samples stay in place, the head moves down and wraps";
    static constexpr std::string_view fields =
        "    uint32_t head; /* where x_(k-1) lies; x_(k-2) behind it */\n"
        "    @sample@ past[@NAME@_SAMPLES];\n";
    static constexpr bool contiguous = false;

    static constexpr std::size_t past_count(std::size_t past) { return past; }

    template <class T>
    static Window<T> window(const T* samples, std::size_t past, std::uint32_t head) {
        // C99: ring window
        const T* const newer = samples + head;
        const std::size_t newer_count = past - head;
        const T* const older = samples;
        const std::size_t older_count = head;
        // C99 end
        return {newer, newer_count, older, older_count, head};
    }

    template <class T>
    static void push(T* samples, std::size_t past, std::uint32_t& head, T newest) {
        if (past == 0) {
            return;
        }
        // C99: ring push
        head = next_head(head, past);
        GLSUM_KEEP_WORD(head);
        samples[head] = newest;
        // C99 end
    }
};

}  // namespace glsum
