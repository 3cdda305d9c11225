// Stores wait here for their bank: 32-bit words, even and odd. A store that is no whole word takes its bank for longer.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "qemu/timing/core_file.hpp"

namespace timing {

class StoreBuffer {
public:
    explicit StoreBuffer(const Figures& figures)
        : figures_(figures), entries_(std::clamp<std::int64_t>(figures.store_entries, 1, depth)) {}

    /// The first cycle in which an entry is free for one more store.
    [[nodiscard]] std::int64_t free_from() const { return *std::min_element(done_.begin(), done_.begin() + entries_); }

    /// One store of 1 to 8 bytes, issued at a cycle. \param extra  cycles that its memory adds
    void add(std::int64_t cycle, std::uint32_t address, unsigned bytes, std::int64_t extra) {
        const bool aligned = address % std::min(bytes, 4U) == 0;
        const auto bank = address >> 2 & 1U;
        std::int64_t done = 0;
        if (!aligned || bytes == 8) {
            const std::int64_t busy = aligned ? figures_.store_word : figures_.store_unaligned;
            done = std::max({cycle, free_[0], free_[1]}) + busy + extra;
            free_ = {done, done};
        } else {
            done = std::max(cycle, free_[bank]) + (bytes < 4 ? figures_.store_narrow : figures_.store_word) + extra;
            free_[bank] = done;
        }
        // Each bank takes its stores in order, and an entry is free once its own is done: the other bank does not wait.
        *std::min_element(done_.begin(), done_.begin() + entries_) = done;
    }

private:
    static constexpr std::int64_t depth = 16;
    const Figures& figures_;
    std::int64_t entries_;
    std::array<std::int64_t, depth> done_{};  // cycle in which each entry is free
    std::array<std::int64_t, 2> free_{};
};

}  // namespace timing
