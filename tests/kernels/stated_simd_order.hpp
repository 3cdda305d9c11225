// The order of summation of the vector kernels as window/simd.hpp states it, one number at a time.
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

/// The sum S_k of the weights a_1, a_2, ... in blocks, as simd_block.hpp states it. Only numbers that are sums of
/// nothing may be zeros of another sign. \param record  x_0 ... x_k
template <bool fused, class T>
T in_blocks_in_the_stated_order(const std::vector<T>& a, const std::vector<T>& record) {
    constexpr std::size_t lanes = 64 / sizeof(T);
    const auto add = [](T sum, T weight, T x) {
        const volatile T product = weight * x;
        return fused ? std::fma(weight, x, sum) : sum + product;
    };
    const std::size_t k = record.size() - 1;
    const std::size_t q = k % 8;
    const std::size_t begin = k - q;
    T lane[lanes] = {};
    for (std::size_t i = 0; i < begin && q + i < a.size(); ++i) {
        lane[i % lanes] = add(lane[i % lanes], a[q + i], record[begin - 1 - i]);
    }
    for (std::size_t half = lanes / 2; half > 0; half /= 2) {
        for (std::size_t i = 0; i < half; ++i) {
            lane[i] += lane[i + half];
        }
    }
    T sum = lane[0];
    for (std::size_t i = q; i > 0; --i) {
        sum = add(sum, i <= a.size() ? a[i - 1] : T(0), record[k - i]);
    }
    return record[k] + sum;
}

}  // namespace test
