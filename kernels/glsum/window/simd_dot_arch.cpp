// Compiled once for each instruction set, with GLSUM_SIMD_ARCHITECTURE naming it.
#include "glsum/window/simd_dot_arch.hpp"

#include <utility>

#include "glsum/window/simd_product.hpp"

namespace glsum {
namespace {

template <class Batch>
using Register = typename Batch::register_type;

// Lane i + half in lane i, the first lanes behind the last.
template <std::size_t half, class Batch, std::size_t... lane>
[[gnu::always_inline]] inline Batch turned(const Batch& values, std::index_sequence<lane...>) {
    const auto lanes = static_cast<Register<Batch>>(values);
    return Batch(__builtin_shufflevector(lanes, lanes, int((lane + half) % sizeof...(lane))...));
}

// Lane i in lane i + 1, and the last lane of `before` in lane 0.
template <class Batch, std::size_t... lane>
[[gnu::always_inline]] inline Batch moved_up(const Batch& values, const Batch& before, std::index_sequence<lane...>) {
    return Batch(__builtin_shufflevector(static_cast<Register<Batch>>(values), static_cast<Register<Batch>>(before),
                                         int(2 * sizeof...(lane) + 1), int(lane)...));
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
    template <bool fused>
    void add(const T* a, const T* x) {
        each([&](auto part) {
            sums[part] = add_product<fused>(sums[part], Batch::load_aligned(a + part * Batch::size),
                                            Batch::load_unaligned(x + part * Batch::size));
        });
    }
    void add(const Accumulator& other) {
        each([&](auto part) { sums[part] = sums[part] + other.sums[part]; });
    }
    // Formed here: clang would put the last additions off, and have too few registers behind them.
    void settle() {
#if defined(__x86_64__)
        each([&](auto part) {
            auto formed = static_cast<Register<Batch>>(sums[part]);
            __asm__("" : "+x"(formed));
            sums[part] = Batch(formed);
        });
#endif
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
    if (a + last * block < end) [[likely]] {
        s0.start(a, first);
        s1.start(a + block, x + block);
        if constexpr (chains == 4) {
            s2.start(a + 2 * block, x + 2 * block);
            s3.start(a + 3 * block, x + 3 * block);
        }
        next_four();
        while (a + last * block < end) {
            s0.template add<fused>(a, x);
            s1.template add<fused>(a + block, x + block);
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
