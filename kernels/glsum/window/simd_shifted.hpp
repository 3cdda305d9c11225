// A long window by vectors of 16 bytes that never lie across two lines of the processor's cache; for the sources that
// are compiled once for each instruction set.
//
// A vector across two lines takes two loads: one of four, where the samples do not begin at a multiple of 16 bytes.
// SSE2, which sums long windows as fast as it can load, takes a tenth less without. So the samples are loaded from the
// multiple of 16 bytes before the newest one on, by a copy of the table that is shifted by as many. A lane then holds
// what another one holds otherwise, but all of it and in the same order; in its place again at the end, it is added as
// always.
//
// One pass: of two, of half the sums each, either leaves out every second pair of lines, and what lies beyond the first
// cache comes best by lines in a row. One of 16 registers holds a product, so that the last sum is kept in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "glsum/window/simd.hpp"
#include "glsum/window/simd_accumulator.hpp"

namespace glsum {
// Internal to each source: two sets must not share a body.
namespace {

// In the register of the sum: clang would put each sum into that of its product, and move all sums through memory.
template <class T, class Architecture>
[[gnu::always_inline]] inline void add_in_place(xsimd::batch<T, Architecture>& sum,
                                                const xsimd::batch<T, Architecture>& product) {
#if defined(__x86_64__)
    auto lanes = static_cast<Register<xsimd::batch<T, Architecture>>>(sum);
    const auto added = static_cast<Register<xsimd::batch<T, Architecture>>>(product);
    if constexpr (std::is_same_v<T, float>) {
        __asm__("addps %1, %0" : "+x"(lanes) : "x"(added));
    } else {
        __asm__("addpd %1, %0" : "+x"(lanes) : "x"(added));
    }
    sum = xsimd::batch<T, Architecture>(lanes);
#else
    static_assert(sizeof(T) == 0, "for SSE2 alone");
#endif
}

// All but the last 16 bytes of the sums, and these: apart, since a sum that lies beside one in memory lies in memory.
template <class T, class Architecture>
struct ShiftedSums {
    using Batch = xsimd::batch<T, Architecture>;
    static constexpr std::size_t width = Batch::size;
    static constexpr std::size_t lanes = Simd::accumulators * 64 / sizeof(T);
    static constexpr std::size_t in_registers = lanes / width - 1;
    static_assert(in_registers == 15);
    Batch sums[in_registers];

    static Batch product(std::size_t part, const T* a, const T* x) {
        return Batch::load_aligned(a + part * width) * Batch::load_aligned(x + part * width);
    }
    static Batch last_product(const T* a, const T* x) { return product(in_registers, a, x); }

    void start(const T* a, const T* x, const Batch& first_product) {
        each([&](auto part) { sums[part] = part == 0 ? first_product : product(part, a, x); });
    }
    void add(const T* a, const T* x) {
        each([&](auto part) { add_in_place(sums[part], product(part, a, x)); });
    }

    template <class Body>
    [[gnu::always_inline]] static inline void each(const Body& body) {
        of_parts(body, std::make_index_sequence<in_registers>{});
    }
    template <class Body, std::size_t... part>
    [[gnu::always_inline]] static inline void of_parts(const Body& body, std::index_sequence<part...>) {
        (body(std::integral_constant<std::size_t, part>{}), ...);
    }
};

template <class T, class Architecture>
struct ShiftedLast {
    using Batch = xsimd::batch<T, Architecture>;
    alignas(16) T lanes[Batch::size];

    void keep(const Batch& sum) {
        sum.store_aligned(lanes);
        __asm__("" : "+m"(lanes));
    }
    [[nodiscard]] Batch sum() const { return Batch::load_aligned(lanes); }
};

// Lanes `at` and on of both behind each other.
template <std::size_t at, class Batch, std::size_t... lane>
[[gnu::always_inline]] inline Batch lanes_from(const Batch& values, const Batch& behind, std::index_sequence<lane...>) {
    return Batch(__builtin_shufflevector(static_cast<Register<Batch>>(values), static_cast<Register<Batch>>(behind),
                                         int(at + lane)...));
}
template <std::size_t at, class Batch>
[[gnu::always_inline]] inline Batch lanes_from(const Batch& values, const Batch& behind) {
    return lanes_from<at>(values, behind, std::make_index_sequence<Batch::size>{});
}

// Of a window that begins `shift` samples behind a multiple of 16 bytes.
template <std::size_t shift, class T, class Architecture>
[[gnu::always_inline]] inline T sum_of_shifted(const T* a, const T* x, std::size_t blocks) {
    using Batch = xsimd::batch<T, Architecture>;
    using Shifted = ShiftedSums<T, Architecture>;
    constexpr std::size_t block = 64 / sizeof(T);
    constexpr std::size_t width = Batch::size;
    constexpr std::size_t lanes = Shifted::lanes;
    const std::size_t count = blocks * block;
    const Batch zero(T(0));
    const auto product = [&](std::size_t at) { return Batch::load_unaligned(a + at) * Batch::load_unaligned(x + at); };

    Shifted shifted;
    ShiftedLast<T, Architecture> last;
    const T* from = a + shift * count;
    const T* samples = x - shift;
    // What lies before the newest sample is none of the window's, and need not be finite, nor there.
    shifted.start(from, samples, lanes_from<width - shift>(zero, product(0)));
    last.keep(Shifted::last_product(from, samples));
    const std::size_t groups = (count + shift) / lanes;
    for (std::size_t group = 1; group < groups; ++group) {
        from += lanes;
        samples += lanes;
        // Two pointers: by an index to both, clang's loads in a product would be instructions of their own.
        __asm__("" : "+r"(from), "+r"(samples));
        shifted.add(from, samples);
        last.keep(last.sum() + Shifted::last_product(from, samples));
    }

    // Each lane in its place; the first `shift` ones belong at the end, and lack one product yet.
    using Sums = Accumulator<T, Architecture>;
    Sums s[Simd::accumulators];
    std::size_t at = groups * lanes;
    const auto& sums = shifted.sums;
    const Batch wrapped = sums[0] + lanes_from<width - shift>(product(at - width), zero);
    Shifted::each([&](auto part) {
        const Batch behind = part + 1 < Shifted::in_registers ? sums[(part + 1) % Shifted::in_registers] : last.sum();
        s[part / Sums::parts].sums[part % Sums::parts] = lanes_from<shift>(sums[part], behind);
    });
    s[3].sums[Sums::parts - 1] = lanes_from<shift>(last.sum(), wrapped);
    for (std::size_t i = 0; i < Simd::accumulators; ++i, at += block) {
        if (at < count) {
            s[i].template add<false>(a + at, x + at);
        }
    }
    s[0].add(s[1]);
    s[2].add(s[3]);
    s[0].add(s[2]);
    return s[0].joined() + T(0);
}

template <class T, class Architecture, std::size_t... shifts>
[[gnu::always_inline]] inline T sum_of_shifted(const T* a, const T* x, std::size_t blocks,
                                               std::index_sequence<shifts...>) {
    const std::size_t shift = reinterpret_cast<std::uintptr_t>(x) / sizeof(T) % sizeof...(shifts);
    T sum = 0;
    (void)((shift == shifts ? (sum = sum_of_shifted<shifts, T, Architecture>(a, x, blocks), true) : false) || ...);
    return sum;
}

/// \param a  the table of `blocks` blocks, and behind it its copies shifted by one, two ... samples (Simd::fill)
template <class T, class Architecture>
[[nodiscard]] inline T sum_of_shifted(const T* a, const T* x, std::size_t blocks) {
    return sum_of_shifted<T, Architecture>(a, x, blocks,
                                           std::make_index_sequence<xsimd::batch<T, Architecture>::size>{});
}

}  // namespace
}  // namespace glsum
