// Compiled once for each instruction set, with GLSUM_SIMD_ARCHITECTURE naming it.
#include "glsum/window/simd_dot_arch.hpp"

#include <utility>

#include "glsum/window/simd_lines.hpp"
#include "glsum/window/simd_shifted.hpp"

namespace glsum {
namespace {

// Lane i in lane i + 1, and the last lane of `before` in lane 0.
template <class Batch, std::size_t... lane>
[[gnu::always_inline]] inline Batch moved_up(const Batch& values, const Batch& before, std::index_sequence<lane...>) {
    return Batch(__builtin_shufflevector(static_cast<Register<Batch>>(values), static_cast<Register<Batch>>(before),
                                         int(2 * sizeof...(lane) + 1), int(lane)...));
}

// Two or four of the sums, those of the blocks 4 n + `skipped` and behind. `a` and `x` begin with these. The first
// block of samples lies at `first`, the others behind x + 64 bytes.
template <bool fused, std::size_t skipped, std::size_t chains, class T, class Architecture>
[[gnu::always_inline]] inline Accumulator<T, Architecture> pass(const T* a, const T* first, const T* x,
                                                                const T* const end) {
    constexpr std::size_t block = 64 / sizeof(T);
    constexpr std::size_t last = 3 - skipped;
    static_assert(Simd::accumulators == 4 && (chains == 2 || chains == 4));
    Accumulator<T, Architecture> s0;
    Accumulator<T, Architecture> s1;
    Accumulator<T, Architecture> s2;
    Accumulator<T, Architecture> s3;
    const auto next_four = [&]() __attribute__((always_inline)) {
        a += 4 * block;
        x += 4 * block;
        // Two pointers: by an index to both, clang's loads in a product would be instructions of their own.
        __asm__("" : "+r"(a), "+r"(x));
    };
    // One in another, and each expected: of a short window jumps would cost as much as what they jump to. Inlined by
    // force: clang would call what stands twice, with the sums in memory.
    const auto add_rest = [&](const T* from) __attribute__((always_inline)) {
        if (a < end) [[likely]] {
            s0.template add<fused>(a, from);
            if (last > 1 && a + block < end) [[likely]] {
                s1.template add<fused>(a + block, x + block);
                if (chains == 4 && a + 2 * block < end) [[likely]] {
                    s2.template add<fused>(a + 2 * block, x + 2 * block);
                }
            }
        }
    };
    // Of two chains every second block loads its coefficients apart. On an Epyc of 2022 long windows take 2 or 3 % less
    // than with none; with all, short ones take as much more.
    if (a + last * block < end) [[likely]] {
        s0.start(a, first);
        s1.start(a + block, x + block);
        if constexpr (chains == 4) {
            s2.start(a + 2 * block, x + 2 * block);
            s3.start(a + 3 * block, x + 3 * block);
        }
        next_four();
        if constexpr (loads_lines<T, Architecture>) {
            const std::size_t fours = (end - a) / (4 * block);
            if (fours > worth_lines) {
                // All but the last, behind which the window may end.
                add_lines<fused>(a, x, fours - 1, s0, s1, s2, s3);
            }
        }
        while (a + last * block < end) {
            s0.template add<fused>(a, x);
            s1.template add<fused, chains == 2>(a + block, x + block);
            if constexpr (chains == 4) {
                s2.template add<fused>(a + 2 * block, x + 2 * block);
                s3.template add<fused>(a + 3 * block, x + 3 * block);
            }
            next_four();
        }
        add_rest(x);
    } else {
        add_rest(first);
    }
    s0.add(s1);
    if constexpr (chains == 4) {
        s2.add(s3);
        s0.add(s2);
    }
    return s0;
}

template <class T, bool fused, class Architecture>
[[gnu::always_inline]] inline T sum_of(const T* a, const T* first, const T* x, std::size_t blocks) {
    constexpr std::size_t block = 64 / sizeof(T);
    using Sums = Accumulator<T, Architecture>;
    const T* const end = a + blocks * block;
    Sums sums;
    if constexpr (Sums::parts == 4) {
        // Sixteen registers hold two of the sums at a time, so the window is passed twice. Whole blocks each: of halves
        // both passes would fetch all that the first cache does not hold.
        sums = pass<fused, 0, 2, T, Architecture>(a, first, x, end);
        sums.settle();
        sums.add(pass<fused, 2, 2, T, Architecture>(a + 2 * block, x + 2 * block, x + 2 * block, end));
    } else {
        // With AVX-512 that is four chains of additions, which hides an addition's latency of up to four cycles at one
        // block a cycle, the most that two loads a cycle can feed.
        sums = pass<fused, 0, 4, T, Architecture>(a, first, x, end);
    }
    // As if each accumulator had begun with 0 and not with its first product, which may be -0.
    return sums.joined() + T(0);
}

}  // namespace

template <class T, bool fused, class Architecture>
T simd_dot_on(const T* a, const T* x, std::size_t blocks) {
    return sum_of<T, fused, Architecture>(a, x, x, blocks);
}

template <class T, bool fused, class Architecture>
T simd_slide_on(const T* a, const T* x, T* recent, std::size_t blocks, T newest) {
    using Batch = xsimd::batch<T, Architecture>;
    [[maybe_unused]] constexpr std::size_t parts = 64 / sizeof(T) / Batch::size;
    if constexpr (!keeps_recent<Architecture>) {
        if constexpr (!fused) {
            if (blocks > longest_unshifted / (64 / sizeof(T))) {
                return sum_of_shifted<T, Architecture>(a, x, blocks);
            }
        }
        return sum_of<T, fused, Architecture>(a, x, x, blocks);
    } else {
        const T sum = sum_of<T, fused, Architecture>(a, recent, x, blocks);
        Batch before(newest);
        for (std::size_t part = 0; part < parts; ++part) {
            const Batch values = Batch::load_aligned(recent + part * Batch::size);
            moved_up(values, before, std::make_index_sequence<Batch::size - 1>{})
                .store_aligned(recent + part * Batch::size);
            before = values;
        }
        return sum;
    }
}

using Here = GLSUM_SIMD_ARCHITECTURE;
#define GLSUM_SIMD_BODIES(type, fused)                                                   \
    template type simd_dot_on<type, fused, Here>(const type*, const type*, std::size_t); \
    template type simd_slide_on<type, fused, Here>(const type*, const type*, type*, std::size_t, type);
GLSUM_SIMD_BODIES(float, false)
GLSUM_SIMD_BODIES(float, true)
GLSUM_SIMD_BODIES(double, false)
GLSUM_SIMD_BODIES(double, true)
#undef GLSUM_SIMD_BODIES

}  // namespace glsum
