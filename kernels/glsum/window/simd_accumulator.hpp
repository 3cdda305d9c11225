// Sums of 64 bytes in vector registers; for the sources that are compiled once for each instruction set.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include "glsum/window/simd_product.hpp"

namespace glsum {
// Internal to each source: two sets must not share a body.
namespace {

template <class Batch>
using Register = typename Batch::register_type;

// Lane i + half in lane i, the first lanes behind the last.
template <std::size_t half, class Batch, std::size_t... lane>
[[gnu::always_inline]] inline Batch turned(const Batch& values, std::index_sequence<lane...>) {
    const auto lanes = static_cast<Register<Batch>>(values);
    return Batch(__builtin_shufflevector(lanes, lanes, int((lane + half) % sizeof...(lane))...));
}

// Pairwise: the upper half of the lanes is added to the lower, until one is left. In registers, since what has just
// been stored in other portions than it is loaded in has to wait for its store.
template <std::size_t half, class Batch>
[[gnu::always_inline]] inline auto joined(const Batch& lanes) {
    if constexpr (half == 0) {
        return static_cast<Register<Batch>>(lanes)[0];
    } else {
        return joined<half / 2>(lanes + turned<half>(lanes, std::make_index_sequence<Batch::size>{}));
    }
}

// In a register from here on: no instruction that uses it loads it anew.
template <class Batch>
[[gnu::always_inline]] inline Batch in_register(const Batch& values) {
    auto lanes = static_cast<Register<Batch>>(values);
#if defined(__x86_64__)
    __asm__("" : "+x"(lanes));
#endif
    return Batch(lanes);
}

// Sums of 64 bytes. Indices are constants throughout: by others, and by loops, GCC would keep the sums in memory.
template <class T, class Architecture>
struct Accumulator {
    using Batch = xsimd::batch<T, Architecture>;
    static constexpr std::size_t parts = 64 / sizeof(T) / Batch::size;
    Batch sums[parts];

    Accumulator() {
        each([&](auto part) { sums[part] = Batch(T(0)); });
    }
    void start(const T* a, const T* x) {
        each([&](auto part) {
            sums[part] = Batch::load_aligned(a + part * Batch::size) * Batch::load_unaligned(x + part * Batch::size);
        });
    }
    /// \tparam apart  coefficients are loaded by instructions of their own, not by the products
    template <bool fused, bool apart = false>
    void add(const T* a, const T* x) {
        each([&](auto part) {
            auto coefficients = Batch::load_aligned(a + part * Batch::size);
            if constexpr (apart) {
                coefficients = in_register(coefficients);
            }
            sums[part] = add_product<fused>(sums[part], coefficients, Batch::load_unaligned(x + part * Batch::size));
        });
    }
    void add(const Accumulator& other) {
        each([&](auto part) { sums[part] = sums[part] + other.sums[part]; });
    }
    void load(const T* lanes) {
        each([&](auto part) { sums[part] = Batch::load_unaligned(lanes + part * Batch::size); });
    }
    // Formed here: clang would put the last additions off, and have too few registers behind them.
    void settle() {
        each([&](auto part) { sums[part] = in_register(sums[part]); });
    }
    [[nodiscard]] T joined() const {
        if constexpr (parts == 4) {
            return glsum::joined<Batch::size / 2>((sums[0] + sums[2]) + (sums[1] + sums[3]));
        } else {
            return glsum::joined<Batch::size / 2>(parts == 2 ? sums[0] + sums[parts - 1] : sums[0]);
        }
    }

private:
    template <class Body>
    [[gnu::always_inline]] static inline void each(const Body& body) {
        of_parts(body, std::make_index_sequence<parts>{});
    }
    template <class Body, std::size_t... part>
    [[gnu::always_inline]] static inline void of_parts(const Body& body, std::index_sequence<part...>) {
        (body(std::integral_constant<std::size_t, part>{}), ...);
    }
};

}  // namespace
}  // namespace glsum
