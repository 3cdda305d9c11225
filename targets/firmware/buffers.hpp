// Memory for the one kernel that is at work.
#pragma once

#include <cstddef>
#include <span>

namespace firmware {

template <class K>
struct Buffers {
    std::span<typename K::Coefficient> table;
    std::span<typename K::Sample> past;
};

/// Room for so many taps of every kernel, the widest format's: a table of a coefficient a tap and some to fill groups
/// up, and a past kept twice.
template <std::size_t taps>
struct Memory {
    static constexpr std::size_t table_bytes = (taps + 16) * sizeof(double);
    static constexpr std::size_t past_bytes = 2 * taps * sizeof(double);
    alignas(64) static inline std::byte table[table_bytes];
    alignas(64) static inline std::byte past[past_bytes];
};

template <class K, std::size_t taps>
Buffers<K> buffers() {
    using Coefficient = typename K::Coefficient;
    using Sample = typename K::Sample;
    using Memory = firmware::Memory<taps>;
    return {{reinterpret_cast<Coefficient*>(Memory::table), Memory::table_bytes / sizeof(Coefficient)},
            {reinterpret_cast<Sample*>(Memory::past), Memory::past_bytes / sizeof(Sample)}};
}

}  // namespace firmware
