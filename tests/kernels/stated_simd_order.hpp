// The order of summation of the vector kernels as technique/simd.hpp states it, one number at a time.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace test {

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

}  // namespace test
