// The formats f64 and f32.
//
// Range: |S_k| and |x_k| anywhere below overflow (about 10^38 in f32); no saturation. Infinities and NaN pass through.
// Overflow: as IEEE 754 has it. Denormals are kept: the bound below adds half of the smallest one per product.
// Error: each rounding is relative, at most `unit_roundoff`; how many a term meets is the technique's affair.
#pragma once

#include <cstddef>
#include <limits>
#include <string_view>

#include "glsum/kernel.hpp"

namespace glsum {

template <class T>
struct Floating {
    using Sample = T;
    using Coefficient = T;
    using Accumulator = T;
    using Output = T;
    struct Scale {};

    static constexpr bool fixed_point = false;
    static constexpr double unit_roundoff = std::numeric_limits<T>::epsilon() / 2.0;

    static Status choose_scale(const Design&, Scale&) { return Status::ok; }
    static Coefficient coefficient(double real, const Scale&) { return static_cast<T>(real); }

    /// The accumulator that holds a_0 x_k = x_k alone.
    static Accumulator start(Sample sample, const Scale&) { return sample; }
    static Accumulator zero() { return T(0); }
    static Accumulator multiply_add(Accumulator sum, Coefficient a, Sample x) { return sum + a * x; }
    /// One rounding in place of two.
    static Accumulator fused_multiply_add(Accumulator sum, Coefficient a, Sample x) {
        if constexpr (sizeof(T) == sizeof(float)) {
            return __builtin_fmaf(a, x, sum);
        } else {
            return __builtin_fma(a, x, sum);
        }
    }
    static Output finish(Accumulator sum, Scale&) { return sum; }

    static Sample from_real(double real) { return static_cast<T>(real); }
    static double to_real(Output output, const Scale&) { return static_cast<double>(output); }
};

struct F64 : Floating<double> {
    static constexpr std::string_view word = "f64";
};
struct F32 : Floating<float> {
    static constexpr std::string_view word = "f32";
};

}  // namespace glsum
