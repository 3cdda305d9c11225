// The formats f64, f32 and f32a64 (f32 samples, coefficients and output, sums in f64).
//
// Range: |S_k| and |x_k| anywhere below overflow (about 10^38 in f32); no saturation. Infinities and NaN pass through.
// Overflow: as IEEE 754 has it. Denormals are kept: the bound adds half of the smallest one per product.
// Error: each rounding is relative, at most half a unit in the last place of the format that it rounds to; how many a
// term meets is the technique's affair.
#pragma once

#include <cstddef>
#include <limits>
#include <string_view>

#include "glsum/c99.hpp"
#include "glsum/kernel.hpp"

namespace glsum {

/// \tparam Data  samples, coefficients and output
/// \tparam Wide  sums
template <class Data, class Wide = Data>
struct Floating {
    using Sample = Data;
    using Coefficient = Data;
    using Accumulator = Wide;
    using Output = Data;
    struct Scale {};

    static constexpr bool fixed_point = false;
    static constexpr double data_roundoff = std::numeric_limits<Data>::epsilon() / 2.0;
    static constexpr double sum_roundoff = std::numeric_limits<Wide>::epsilon() / 2.0;
    static constexpr double output_roundoff = sizeof(Data) < sizeof(Wide) ? data_roundoff : 0.0;

    template <int>
    static Status choose_scale(const Design&, Scale&) {
        return Status::ok;
    }
    static Status choose_horner_scale(const Design&, Scale&) { return Status::ok; }
    static Coefficient coefficient(double real, const Scale&) { return static_cast<Data>(real); }

    /// The accumulator that holds a_0 x_k = x_k alone.
    static Accumulator start(Sample sample, const Scale&) { return static_cast<Wide>(sample); }
    static Accumulator zero() { return Wide(0); }
    static Accumulator product(Accumulator a, Accumulator b) {
        // C99: product
        Accumulator rounded = a * b;
        GLSUM_KEEP(rounded);
        return rounded;
        // C99 end
    }
    static Accumulator multiply(Coefficient a, Sample x) {
        // C99: multiply
        return product(static_cast<Accumulator>(a), static_cast<Accumulator>(x));
        // C99 end
    }
    static Accumulator multiply_add(Accumulator sum, Coefficient a, Sample x) {
        // C99: multiply_add
        return sum + multiply(a, x);
        // C99 end
    }
    /// One rounding in place of two.
    static Accumulator fused_multiply_add(Accumulator sum, Coefficient a, Sample x) {
        // C99: fused_multiply_add
        return fused(static_cast<Accumulator>(a), static_cast<Accumulator>(x), sum);
        // C99 end
    }
    /// x + c inner, a step of the Horner form.
    template <bool fuse>
    static Accumulator horner_step(Sample x, Coefficient c, Accumulator inner, const Scale&) {
        if constexpr (fuse) {
            // C99: fused horner step
            return fused(static_cast<Accumulator>(c), inner, static_cast<Accumulator>(x));
            // C99 end
        } else {
            // C99: horner step
            return static_cast<Accumulator>(x) + product(static_cast<Accumulator>(c), inner);
            // C99 end
        }
    }
    static Output finish(Accumulator sum, Scale&) { return static_cast<Data>(sum); }

    static Sample from_real(double real) { return static_cast<Data>(real); }
    static double to_real(Output output, const Scale&) { return static_cast<double>(output); }

private:
    [[gnu::always_inline]] static inline Wide fused(Wide a, Wide b, Wide sum) {
        if constexpr (sizeof(Wide) == sizeof(float)) {
            return __builtin_fmaf(a, b, sum);
        } else {
            return __builtin_fma(a, b, sum);
        }
    }
};

struct F64 : Floating<double> {
    static constexpr std::string_view word = "f64";
};
struct F32 : Floating<float> {
    static constexpr std::string_view word = "f32";
};
struct F32A64 : Floating<float, double> {
    static constexpr std::string_view word = "f32a64";
};

}  // namespace glsum
