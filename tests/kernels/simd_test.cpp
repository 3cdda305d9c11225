// The vector kernels give the same bits on every instruction set, because all of them add in the same order.
#include <gtest/gtest.h>

#include "glsum/registry.hpp"

#if defined(GLSUM_SIMD)
#include <cmath>
#include <random>
#include <vector>

#include "glsum/simd_dot_arch.hpp"

namespace {

// The order of summation as technique/simd.hpp states it, one number at a time.
template <bool fused, class T>
T in_the_stated_order(const std::vector<T>& a, const std::vector<T>& x) {
    constexpr std::size_t block = 64 / sizeof(T);
    T sum[4][block] = {};
    for (std::size_t i = 0; i < a.size(); ++i) {
        T& lane = sum[i / block % 4][i % block];
        const volatile T product = a[i] * x[i];
        lane = fused ? std::fma(a[i], x[i], lane) : lane + product;
    }
    T lanes[block];
    for (std::size_t i = 0; i < block; ++i) {
        lanes[i] = (sum[0][i] + sum[1][i]) + (sum[2][i] + sum[3][i]);
    }
    for (std::size_t half = block / 2; half > 0; half /= 2) {
        for (std::size_t i = 0; i < half; ++i) {
            lanes[i] += lanes[i + half];
        }
    }
    return lanes[0];
}

// All instruction sets of the library that this machine has, not only the one that is chosen.
template <class T, bool fused, class... Architectures>
void check_each(xsimd::arch_list<Architectures...>, const std::vector<T>& a, const std::vector<T>& x, T expected) {
    const auto check = [&]<class Architecture>(Architecture) {
        if (xsimd::available_architectures().best >= Architecture::version()) {
            const T found = glsum::simd_dot_on<T, fused, Architecture>(a.data(), x.data(), a.size() * sizeof(T) / 64);
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
        check_each<T, false>(glsum::SimdArchitectures{}, a, x, in_the_stated_order<false>(a, x));
        check_each<T, true>(glsum::SimdArchitectures{}, a, x, in_the_stated_order<true>(a, x));
        EXPECT_EQ(glsum::simd_dot(a.data(), x.data(), blocks), in_the_stated_order<false>(a, x));
        EXPECT_EQ(glsum::simd_dot_fused(a.data(), x.data(), blocks), in_the_stated_order<true>(a, x));
    }
}

TEST(Simd, AddsInTheStatedOrderOnEveryInstructionSet) {
    check<float>();
    check<double>();
}

TEST(Simd, NamesItsInstructionSet) { EXPECT_FALSE(glsum::simd_instruction_set().empty()); }

}  // namespace
#endif
