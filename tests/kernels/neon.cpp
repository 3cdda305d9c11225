// simd and simdfma on AArch64's NEON: the bits of the stated order. Needs no GoogleTest, which is not there for
// AArch64.
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "glsum/registry.hpp"
#include "tests/kernels/stated_simd_order.hpp"

template <class T>
int wrong_sums() {
    std::mt19937 generator(5);
    int wrong = 0;
    for (std::size_t blocks = 0; blocks < 14; ++blocks) {
        std::vector<T> a(blocks * 64 / sizeof(T));
        std::vector<T> x(a.size());
        for (std::size_t i = 0; i < a.size(); ++i) {
            a[i] = static_cast<T>(generator()) / static_cast<T>(4294967296.0) - T(0.5);
            x[i] = static_cast<T>(generator()) / static_cast<T>(4294967296.0) - T(0.5);
        }
        wrong +=
            glsum::simd_dot<T, false>(a.data(), x.data(), blocks) != test::in_the_stated_order<false>(a, x) ? 1 : 0;
        wrong += glsum::simd_dot<T, true>(a.data(), x.data(), blocks) != test::in_the_stated_order<true>(a, x) ? 1 : 0;
    }
    return wrong;
}

template <class Technique, class Format>
int wrong_in_blocks() {
    using K = glsum::Sum<glsum::HostBlock, Technique, Format>;
    using T = typename K::Sample;
    constexpr std::size_t taps = 50;
    int wrong = 0;
    std::vector<T> weights;
    glsum::Weights walk(0.98319);
    for (std::size_t j = 1; j < taps; ++j) {
        walk.next();
        weights.push_back(static_cast<T>(walk.weight()));
    }
    glsum::Line<K, taps> line;
    wrong += line.prepare({0.98319, taps}) != glsum::Status::ok ? 1 : 0;
    std::mt19937 generator(7);
    std::vector<T> record;
    for (int k = 0; k < 120; ++k) {
        record.push_back(static_cast<T>(generator()) / static_cast<T>(4294967296.0) - T(0.5));
        constexpr bool fused = Technique::fused;
        wrong += line.step(record.back()) != test::in_blocks_in_the_stated_order<fused>(weights, record) ? 1 : 0;
    }
    return wrong;
}

int main() {
    const int wrong = wrong_sums<float>() + wrong_sums<double>() + wrong_in_blocks<glsum::Simd, glsum::F32>() +
                      wrong_in_blocks<glsum::SimdFma, glsum::F32>() + wrong_in_blocks<glsum::Simd, glsum::F64>() +
                      wrong_in_blocks<glsum::SimdFma, glsum::F64>();
    std::printf("%s: %d wrong sums of 536\n", std::string(glsum::simd_instruction_set()).c_str(), wrong);
    return wrong == 0 ? 0 : 1;
}
