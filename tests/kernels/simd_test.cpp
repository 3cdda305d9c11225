// The vector kernels give the same bits on every instruction set, because all of them add in the same order.
#include <gtest/gtest.h>

#include "glsum/registry.hpp"

#if defined(GLSUM_SIMD)
#include <random>
#include <vector>

#include "glsum/simd_dot_arch.hpp"
#include "tests/kernels/stated_simd_order.hpp"

namespace {

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
        check_each<T, false>(glsum::SimdArchitectures{}, a, x, test::in_the_stated_order<false>(a, x));
        check_each<T, true>(glsum::SimdArchitectures{}, a, x, test::in_the_stated_order<true>(a, x));
        EXPECT_EQ(glsum::simd_dot(a.data(), x.data(), blocks), test::in_the_stated_order<false>(a, x));
        EXPECT_EQ(glsum::simd_dot_fused(a.data(), x.data(), blocks), test::in_the_stated_order<true>(a, x));
    }
}

TEST(Simd, AddsInTheStatedOrderOnEveryInstructionSet) {
    check<float>();
    check<double>();
}

TEST(Simd, NamesItsInstructionSet) { EXPECT_FALSE(glsum::simd_instruction_set().empty()); }

}  // namespace
#endif
