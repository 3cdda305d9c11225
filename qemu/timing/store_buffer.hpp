// Stores wait here for their bank: 32-bit words, even and odd. A store that is no whole word takes its bank for longer.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "qemu/timing/core_file.hpp"

namespace timing {

struct StoreBuffer {
    static constexpr std::size_t depth = 16;
    std::array<std::int32_t, depth> done{};  ///< cycle in which each entry is free
    std::array<std::int32_t, 2> free{};      ///< and each bank

    /// The first cycle in which one of the entries in use is free for one more store.
    [[nodiscard]] std::int32_t free_from(const Figures& figures) const {
        return *std::min_element(done.begin(), done.begin() + entries(figures));
    }

    /// One store of 1 to 8 bytes, issued at a cycle. \param extra  cycles that its memory adds
    void add(const Figures& figures, std::int32_t cycle, unsigned bank, bool unaligned, unsigned bytes,
             std::int32_t extra) {
        std::int32_t ready = 0;
        if (unaligned || bytes == 8) {
            const std::int64_t busy = unaligned ? figures.store_unaligned : figures.store_word;
            ready = std::max({cycle, free[0], free[1]}) + static_cast<std::int32_t>(busy) + extra;
            free = {ready, ready};
        } else {
            const std::int64_t busy = bytes < 4 ? figures.store_narrow : figures.store_word;
            ready = std::max(cycle, free[bank]) + static_cast<std::int32_t>(busy) + extra;
            free[bank] = ready;
        }
        // Each bank takes its stores in order, and an entry is free once its own is done: the other bank does not wait.
        *std::min_element(done.begin(), done.begin() + entries(figures)) = ready;
    }

    /// Sets the clock back; what is done by then counts no more, and entries are alike.
    void settle(const Figures& figures, std::int32_t back) {
        for (std::int32_t* cycles : {done.data(), free.data()}) {
            const std::size_t count = cycles == done.data() ? done.size() : free.size();
            std::transform(cycles, cycles + count, cycles, [back](std::int32_t at) { return std::max(at - back, 0); });
        }
        std::sort(done.begin(), done.begin() + entries(figures));
    }

    bool operator==(const StoreBuffer&) const = default;

private:
    static std::ptrdiff_t entries(const Figures& figures) {
        return static_cast<std::ptrdiff_t>(std::clamp<std::int64_t>(figures.store_entries, 1, depth));
    }
};

}  // namespace timing
