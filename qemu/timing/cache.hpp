// Tags of a set-associative cache: hit or miss. The line used longest ago is replaced, or one at random.
#pragma once

#include <cstdint>
#include <vector>

namespace timing {

class Cache {
public:
    /// \param bytes      0: no cache, every touch misses
    /// \param at_random  which line is replaced: the same ones in every run
    Cache(std::int64_t bytes, std::int64_t ways, std::int64_t line_bytes, bool at_random = false);

    /// Looks the line up, and brings it in if it is not there. \return whether it was there
    bool touch(std::uint32_t address) {
        if (lines_.empty()) {
            return false;
        }
        const std::uint32_t tag = address >> line_shift_;
        std::uint32_t& newest = lines_[std::size_t{tag & (sets_ - 1)} * ways_];
        return newest == tag || touch_older(&newest, tag);
    }
    /// Whether all lines from this address to that are the ones that their sets had last: touching them changes
    /// nothing.
    [[nodiscard]] bool newest(std::uint32_t first, std::uint32_t last) const {
        for (std::uint32_t tag = first >> line_shift_; tag <= last >> line_shift_; ++tag) {
            if (lines_[std::size_t{tag & (sets_ - 1)} * ways_] != tag) {
                return false;
            }
        }
        return true;
    }
    [[nodiscard]] bool on() const { return !lines_.empty(); }

private:
    static constexpr std::uint32_t no_line = 0xFFFFFFFFU;
    bool touch_older(std::uint32_t* first, std::uint32_t tag);

    std::uint32_t line_shift_ = 0;
    std::uint32_t sets_ = 1;  // a power of two: the index is a field of the address
    std::uint32_t ways_ = 1;
    bool at_random_ = false;
    std::uint32_t random_ = 1;
    std::vector<std::uint32_t> lines_;  // tags, those of each set together, the most recently used first
};

}  // namespace timing
