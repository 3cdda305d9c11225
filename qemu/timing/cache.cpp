#include "qemu/timing/cache.hpp"

#include <algorithm>
#include <bit>

namespace timing {

Cache::Cache(std::int64_t bytes, std::int64_t ways, std::int64_t line_bytes, bool at_random) : at_random_(at_random) {
    if (bytes > 0) {
        ways_ = static_cast<std::uint32_t>(std::max<std::int64_t>(ways, 1));
        line_shift_ = static_cast<std::uint32_t>(std::countr_zero(static_cast<std::uint32_t>(line_bytes)));
        sets_ = std::bit_floor(std::max(1U, static_cast<std::uint32_t>(bytes) / ways_ >> line_shift_));
        lines_.resize(std::size_t{sets_} * ways_, no_line);
    }
}

bool Cache::touch_older(std::uint32_t* first, std::uint32_t tag) {
    std::uint32_t* const last = first + ways_;
    std::uint32_t* const found = std::find(first, last, tag);
    if (found != last) {
        std::rotate(first, found, found + 1);
        return true;
    }
    std::uint32_t* victim = last - 1;
    if (at_random_) {
        random_ = random_ * 1664525U + 1013904223U;  // Numerical Recipes, 7.1
        victim = first + (random_ >> 16) % ways_;
    }
    std::rotate(first, victim, victim + 1);
    *first = tag;
    return false;
}

}  // namespace timing
