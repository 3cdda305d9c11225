// mirror: a ring kept twice, one copy behind the other, so that the whole past is contiguous wherever the head is.
// Upkeep: two stores. One contiguous piece. Memory: 2 (taps - 1) samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "glsum/window/window.hpp"

namespace glsum {

struct Mirror {
    static constexpr std::string_view word = "mirror";
    static constexpr Family family = window_family;
    static constexpr std::string_view summary = "a ring kept twice, so that the past is one piece";
    static constexpr std::string_view fields =
        "    uint32_t head; /* where x_(k-1) lies; x_(k-2) behind it */\n"
        "    @sample@ past[@NAME@_SAMPLES]; /* twice the same */\n";
    static constexpr bool contiguous = true;

    static constexpr std::size_t past_count(std::size_t past) { return 2 * past; }

    template <class T>
    static Window<T> window(const T* samples, std::size_t past, std::uint32_t head) {
        // C99: mirror window
        const T* const newer = samples + head;
        const std::size_t newer_count = past;
        // C99 end
        return {newer, newer_count, samples, 0, head};
    }

    template <class T>
    static void push(T* samples, std::size_t past, std::uint32_t& head, T newest) {
        if (past == 0) {
            return;
        }
        // C99: mirror push
        head = next_head(head, past);
        GLSUM_KEEP_WORD(head);
        samples[head] = newest;
        samples[head + past] = newest;
        // C99 end
    }

    /// Of `past` samples held the oldest, from `kept` on, meet zeros: what is not finite must not.
    template <class T>
    static void forget(T* samples, std::size_t past, std::uint32_t head, std::size_t kept) {
        if (kept == past || samples[head + kept] - samples[head + kept] == T(0)) {
            return;
        }
        const std::size_t at = (head + kept) % past;
        samples[at] = 0;
        samples[at + past] = 0;
    }
};

}  // namespace glsum
