// Lengths are counted in 32 bits, and bytes of a table too: what is longer is refused, however large the table is said
// to be. Nothing of the buffers is touched, so none has to be there, and no weight is walked to before.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "glsum/registry.hpp"

namespace {

TEST(LongestLength, IsAQuarterOfWhat32BitsCount) {
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max() / 4;
    constexpr std::size_t endless = std::size_t{1} << 40;
    glsum::Registry::for_each([&]<class K>() {
        if constexpr (!std::is_same_v<K, glsum::Null>) {
            typename K::State state{};
            typename K::Coefficient coefficient{};
            typename K::Sample sample{};
            const std::span<typename K::Coefficient> table(&coefficient, endless);
            const std::span<typename K::Sample> past(&sample, 1);
            EXPECT_EQ(K::prepare(state, {-0.5, most + 1}, table, past), glsum::Status::table_too_small) << K::name();
            EXPECT_EQ(K::prepare(state, {-0.5, most}, table, past), glsum::Status::past_too_small) << K::name();
        }
    });
}

}  // namespace
