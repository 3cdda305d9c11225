// The vector kernels give the same bits on every instruction set, because all of them add in the same order.
#include <gtest/gtest.h>

#include "glsum/registry.hpp"

#if defined(GLSUM_SIMD)
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "glsum/lookahead/simd_block_arch.hpp"
#include "glsum/window/simd_architectures.hpp"
#include "glsum/window/simd_dot_arch.hpp"
#include "tests/kernels/stated_simd_order.hpp"

namespace {

// Whether this machine has an instruction set, asked as newer or older releases of xsimd want to be.
template <class Architecture>
bool is_here() {
    return [](const auto& here) {
        if constexpr (requires { here.has(Architecture{}); }) {
            return static_cast<bool>(here.has(Architecture{}));
        } else {
            return here.best >= Architecture::version();
        }
    }(xsimd::available_architectures());
}

template <class T>
using Table = std::vector<T, xsimd::aligned_allocator<T, 64>>;

// All instruction sets of the library that this machine has, not only the one that is chosen.
template <class T, bool fused, class... Architectures>
void check_each(xsimd::arch_list<Architectures...>, const std::vector<T>& a, const std::vector<T>& x, T expected) {
    const auto check = [&]<class Architecture>(Architecture) {
        if (is_here<Architecture>()) {
            const Table<T> table(a.begin(), a.end());
            const T found =
                glsum::simd_dot_on<T, fused, Architecture>(table.data(), x.data(), a.size() * sizeof(T) / 64);
            EXPECT_EQ(found, expected) << Architecture::name() << (fused ? ", fused, " : ", ") << a.size();
        }
    };
    (check(Architectures{}), ...);
}

template <class T>
void check() {
    constexpr std::size_t block = 64 / sizeof(T);
    std::mt19937 generator(5);
    for (std::size_t blocks = 0; blocks < 14; ++blocks) {
        std::vector<T> a(blocks * block);
        std::vector<T> x(blocks * block);
        for (std::size_t i = 0; i < a.size(); ++i) {
            a[i] = static_cast<T>(generator()) / static_cast<T>(4294967296.0) - T(0.5);
            x[i] = static_cast<T>(generator()) / static_cast<T>(4294967296.0) - T(0.5);
        }
        check_each<T, false>(glsum::SimdArchitectures{}, a, x, test::in_the_stated_order<false>(a, x));
        check_each<T, true>(glsum::SimdArchitectures{}, a, x, test::in_the_stated_order<true>(a, x));
        const Table<T> table(a.begin(), a.end());
        EXPECT_EQ((glsum::simd_dot<T, false>(table.data(), x.data(), blocks)), test::in_the_stated_order<false>(a, x));
        EXPECT_EQ((glsum::simd_dot<T, true>(table.data(), x.data(), blocks)), test::in_the_stated_order<true>(a, x));
    }
}

TEST(Simd, AddsInTheStatedOrderOnEveryInstructionSet) {
    check<float>();
    check<double>();
}

// A window that slides over a record: its newest block is kept beside it.
template <class T, bool fused, class... Architectures>
void check_slides_on_each(xsimd::arch_list<Architectures...>, std::size_t blocks) {
    constexpr std::size_t block = 64 / sizeof(T);
    const auto check = [&]<class Architecture>(Architecture) {
        if (!is_here<Architecture>()) {
            return;
        }
        std::mt19937 generator(6);
        const auto draw = [&] { return static_cast<T>(generator()) / static_cast<T>(4294967296.0) - T(0.5); };
        std::vector<T> a(blocks * block);
        std::generate(a.begin(), a.end(), draw);
        const Table<T> table(a.begin(), a.end());
        std::vector<T> window(a.size());  // newest first
        std::vector<T> without_newest(a.size());
        alignas(64) T recent[block] = {};
        for (std::size_t k = 0; k < 3 * block; ++k) {
            without_newest = window;
            if constexpr (glsum::keeps_recent<Architecture>) {  // then what lies in the window's first block is not
                                                                // read
                std::fill(without_newest.begin(), without_newest.begin() + block, T(1e30));
            }
            const T newest = draw();
            const T found = glsum::simd_slide_on<T, fused, Architecture>(table.data(), without_newest.data(), recent,
                                                                         blocks, newest);
            ASSERT_EQ(found, (test::in_the_stated_order<fused>(a, window)))
                << Architecture::name() << ' ' << blocks << ' ' << k;
            window.insert(window.begin(), newest);
            window.pop_back();
        }
    };
    (check(Architectures{}), ...);
}

// Long windows that begin anywhere between two lines of the processor's cache, where AVX-512 has a loop of its own for
// each place. What lies beside the window, in the lines that it begins and ends in, is not in the sum.
template <class T, bool fused, class... Architectures>
void check_places_on_each(xsimd::arch_list<Architectures...>, std::size_t blocks) {
    constexpr std::size_t block = 64 / sizeof(T);
    std::mt19937 generator(7);
    const auto draw = [&] { return static_cast<T>(generator()) / static_cast<T>(4294967296.0) - T(0.5); };
    Table<T> a(blocks * block);
    std::generate(a.begin(), a.end(), draw);
    std::vector<T> x(a.size());
    std::generate(x.begin(), x.end(), draw);
    const T expected = test::in_the_stated_order<fused>({a.begin(), a.end()}, x);
    const auto check = [&]<class Architecture>(Architecture) {
        if (!is_here<Architecture>()) {
            return;
        }
        for (std::size_t place = 0; place < block; ++place) {
            Table<T> memory(a.size() + place + block, T(1e30));
            std::copy(x.begin(), x.end(), memory.begin() + place);
            ASSERT_EQ((glsum::simd_dot_on<T, fused, Architecture>(a.data(), memory.data() + place, blocks)), expected)
                << Architecture::name() << (fused ? ", fused, " : ", ") << blocks << " blocks from " << place;
        }
    };
    (check(Architectures{}), ...);
}

TEST(Simd, LongWindowsAddInTheStatedOrderWhereverTheyBegin) {
    for (const std::size_t blocks : {51, 52, 53, 55, 56, 57, 58, 59, 60, 61, 95, 128}) {
        check_places_on_each<float, false>(glsum::SimdArchitectures{}, blocks);
        check_places_on_each<float, true>(glsum::SimdArchitectures{}, blocks);
        check_places_on_each<double, false>(glsum::SimdArchitectures{}, blocks);
        check_places_on_each<double, true>(glsum::SimdArchitectures{}, blocks);
    }
}

// Windows whose tables have copies shifted to where a window begins. What lies beside the window is not finite, and is
// not in the sum.
template <class Format, bool fused, class... Architectures>
void check_shifted_on_each(xsimd::arch_list<Architectures...>, std::size_t blocks) {
    using T = typename Format::Sample;
    constexpr std::size_t block = 64 / sizeof(T);
    const std::size_t past = blocks * block - 3;
    using K = glsum::Sum<glsum::Mirror, std::conditional_t<fused, glsum::SimdFma, glsum::Simd>, Format>;
    std::vector<T> table(K::table_count(past + 1));
    std::vector<T> samples(K::past_count(past + 1));
    typename K::State state;
    ASSERT_EQ(K::prepare(state, {0.98319, past + 1}, table, samples), glsum::Status::ok);
    std::mt19937 generator(8);
    std::vector<T> x(blocks * block);
    std::generate(x.begin(), x.end(), [&] { return static_cast<T>(generator()) / static_cast<T>(4294967296.0); });
    const std::vector<T> coefficients(state.table, state.table + blocks * block);
    EXPECT_EQ(coefficients.back(), T(0));
    const T expected = test::in_the_stated_order<fused>(coefficients, x);
    const auto check = [&]<class Architecture>(Architecture) {
        if (!is_here<Architecture>()) {
            return;
        }
        for (std::size_t place = 0; place < block; ++place) {
            Table<T> memory(x.size() + place + block, std::numeric_limits<T>::infinity());
            std::copy(x.begin(), x.end(), memory.begin() + place);
            alignas(64) T recent[block];
            std::copy(x.begin(), x.begin() + block, recent);
            ASSERT_EQ((glsum::simd_slide_on<T, fused, Architecture>(state.table, memory.data() + place, recent, blocks,
                                                                    T(1))),
                      expected)
                << Architecture::name() << (fused ? ", fused, " : ", ") << blocks << " blocks from " << place;
        }
    };
    (check(Architectures{}), ...);
}

TEST(Simd, WindowsWithShiftedTablesAddInTheStatedOrderWhereverTheyBegin) {
    for (const std::size_t more : {0, 1, 2, 3, 4, 5, 96, 217}) {
        check_shifted_on_each<glsum::F32, false>(glsum::SimdArchitectures{}, 1536 / 16 + more);
        check_shifted_on_each<glsum::F32, true>(glsum::SimdArchitectures{}, 1536 / 16 + more);
        check_shifted_on_each<glsum::F64, false>(glsum::SimdArchitectures{}, 1536 / 8 + more);
        check_shifted_on_each<glsum::F64, true>(glsum::SimdArchitectures{}, 1536 / 8 + more);
    }
}

// Accumulators that begin with 0: products of -0 add to 0, and not to -0.
TEST(Simd, ASumOfNegativeZerosIsZeroOnEveryInstructionSet) {
    const auto check_zeros = []<class... Architectures>(xsimd::arch_list<Architectures...>) {
        const Table<float> a(8 * 16, -1.0F);
        const Table<float> x(8 * 16, 0.0F);
        const auto check_on = [&]<class Architecture>(Architecture) {
            if (is_here<Architecture>()) {
                for (const std::size_t blocks : {1, 3, 4, 5, 8}) {
                    EXPECT_FALSE(
                        std::signbit(glsum::simd_dot_on<float, false, Architecture>(a.data(), x.data(), blocks)))
                        << Architecture::name() << ", " << blocks << " blocks";
                    EXPECT_FALSE(
                        std::signbit(glsum::simd_dot_on<float, true, Architecture>(a.data(), x.data(), blocks)))
                        << Architecture::name() << ", fused, " << blocks << " blocks";
                }
            }
        };
        (check_on(Architectures{}), ...);
    };
    check_zeros(glsum::SimdArchitectures{});
}

TEST(Simd, SlidesInTheStatedOrderOnEveryInstructionSet) {
    for (std::size_t blocks = 1; blocks < 14; ++blocks) {
        check_slides_on_each<float, false>(glsum::SimdArchitectures{}, blocks);
        check_slides_on_each<float, true>(glsum::SimdArchitectures{}, blocks);
        check_slides_on_each<double, false>(glsum::SimdArchitectures{}, blocks);
        check_slides_on_each<double, true>(glsum::SimdArchitectures{}, blocks);
    }
}

// A whole record through each instruction set's own body, on a state that the kernel prepared.
template <class K, bool fused, class... Architectures>
void check_blocks_on_each(xsimd::arch_list<Architectures...>, std::size_t taps) {
    using T = typename K::Sample;
    std::vector<T> weights;
    glsum::Weights walk(0.98319);
    for (std::size_t j = 1; j < taps; ++j) {
        walk.next();
        weights.push_back(static_cast<T>(walk.weight()));
    }
    const auto check = [&]<class Architecture>(Architecture) {
        if (!is_here<Architecture>()) {
            return;
        }
        std::vector<T> table(K::table_count(taps) + 1);
        std::vector<T> past(K::past_count(taps) + 1);
        typename K::State state;
        ASSERT_EQ(K::prepare(state, {0.98319, taps}, table, past), glsum::Status::ok);
        std::mt19937 generator(7);
        std::vector<T> record;
        for (std::size_t k = 0; k < 2 * taps + 20; ++k) {
            record.push_back(static_cast<T>(generator()) / static_cast<T>(4294967296.0) - T(0.5));
            const T found = glsum::simd_block_on<T, fused, Architecture>(state, record.back());
            ASSERT_EQ(found, (test::in_blocks_in_the_stated_order<fused>(weights, record)))
                << Architecture::name() << ", taps " << taps << ", k " << k;
        }
    };
    (check(Architectures{}), ...);
}

TEST(Simd, AddsBlocksInTheStatedOrderOnEveryInstructionSet) {
    // 600 and 1100: with a table for each sum, and one for all.
    for (const std::size_t taps : {1U, 2U, 5U, 8U, 9U, 10U, 16U, 17U, 18U, 50U, 600U, 1100U}) {
        const auto each = [&]<class Technique, class Format>() {
            check_blocks_on_each<glsum::Sum<glsum::HostBlock, Technique, Format>,
                                 std::is_same_v<Technique, glsum::SimdFma>>(glsum::SimdArchitectures{}, taps);
        };
        each.operator()<glsum::Simd, glsum::F32>();
        each.operator()<glsum::SimdFma, glsum::F32>();
        each.operator()<glsum::Simd, glsum::F64>();
        each.operator()<glsum::SimdFma, glsum::F64>();
    }
}

TEST(Simd, NamesItsInstructionSet) { EXPECT_FALSE(glsum::simd_instruction_set().empty()); }

}  // namespace
#endif
