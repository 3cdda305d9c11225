// Which line leaves a cache that replaces at random: the one that the documented generator names, so that a run is the
// same everywhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "qemu/timing/cache.hpp"

namespace {

// Numerical Recipes, 7.1, begun at 1; its high half tells the place, counted from the line used last.
TEST(RandomReplacement, FollowsItsGenerator) {
    constexpr std::uint32_t ways = 6;
    timing::Cache cache(ways * 32, ways, 32, true);
    std::vector<std::uint32_t> held;  // lines, the one used last first; what holds none yet is as old as can be
    std::uint64_t x = 1;
    held.assign(ways, 0xFFFFFFFFU);
    for (std::uint32_t turn = 0; turn < 2000; ++turn) {
        const std::uint32_t line = turn * turn % 11;
        const auto found = std::find(held.begin(), held.end(), line);
        const bool hits = found != held.end();
        auto leaves = found;
        if (!hits) {
            x = (1664525U * x + 1013904223U) % 4294967296U;
            leaves = held.begin() + static_cast<std::ptrdiff_t>(x / 65536 % ways);
        }
        held.erase(leaves);
        held.insert(held.begin(), line);
        ASSERT_EQ(cache.touch(line * 32), hits) << turn;
    }
}

}  // namespace
