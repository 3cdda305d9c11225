// A fractional model stepped in real time, on the microcontroller and on the host by the same code.
//
//   sum_i a_i h^-alpha_i sum_{j>=0} w_j^(alpha_i) x_(k-j) = gain u_(k-1-d)     solved for the newest x_k
//
// x is the output y itself, or, in increments, y_k - y_(k-1) with orders one lower and the constant term apart. All
// sums of the past are kernels of the registry: the past of one table is m_1 (x_(k-1) + sum_{j>=1} (m_(j+1)/m_1)
// x_(k-1-j)), which is a kernel's sum for the newest sample x_(k-1). So a step costs one kernel call for each table and
// a few operations:
//
//   x_k = input u_(k-1-d) - constant y_(k-1) - sum_i factor_i S_i,     y_k = y_(k-1) + x_k  or  x_k
//
// A scheme of second order takes (u_(k-1-d) + u_(k-d))/2 for u_(k-1-d): an input that jumps at a sample acts at it with
// half of the jump. With a kernel that compensates, y too carries what its last addition lost ([Dekker1971]): in single
// precision y else stops where an increment is below half a unit of its last place (4e-5 of model (12) at h = 1 ms).
//
// Range, floating point: as the kernel's. Fixed point: x is a fraction of the design's `stored_full_scale`, u of
// `input_full_scale`; y is exact in 64 bits in increments. Overflow saturates and is counted.
// Error: that of the scheme (first order in h), of the memory that is cut off, and of the format; measured, not
// promised.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "glsum/gain.hpp"
#include "glsum/registry.hpp"

namespace glsum {

/// One table of a model's past.
struct PastTable {
    double factor;                     ///< m_1 over the newest coefficient
    std::span<const double> ratios;    ///< m_2/m_1, m_3/m_1, ...; the kernel has one tap more
    std::span<const Mode> modes = {};  ///< of a kernel with modes: of what lies behind these, over m_1
    /// What the kernel is prepared for.
    [[nodiscard]] Design design() const { return {0.0, ratios.size() + 1 + 2 * modes.size(), modes, ratios}; }
};

/// A model as numbers, in double, computed once on the host: no power of h is taken on the target.
struct ModelDesign {
    bool increments = true;
    bool half_input = false;         ///< the mean of the inputs before and at a sample acts there: second order
    std::uint32_t delay = 0;         ///< whole steps
    double input = 1.0;              ///< gain over the newest coefficient
    double constant = 0.0;           ///< in increments: a of order 0 over the newest coefficient
    double input_full_scale = 1.0;   ///< fixed point only, as the next two; powers of two
    double stored_full_scale = 1.0;  ///< of x
    double output_full_scale = 1.0;  ///< of y where it is multiplied by `constant`
    std::span<const PastTable> tables;
};

inline constexpr std::size_t most_tables = 4;

template <class K>
class Stepper {
    static_assert(is_registered<K>, "no such kernel: glsum/registry.def lists those that the library has");
    using Format = typename K::FormatPart;
    static constexpr bool fixed = Format::fixed_point;

public:
    using Sample = typename K::Sample;
    using Coefficient = typename K::Coefficient;
    using Output = std::conditional_t<fixed, std::int64_t, Sample>;

    struct State {
        typename K::State sums[most_tables];
        // What multiplies the sums, the input and y: a number, or mantissa and exponent.
        using Factor = std::conditional_t<fixed, Gain, Sample>;
        Factor factor[most_tables];
        Factor input;
        Factor constant;
        std::uint32_t
            negative;  // fixed point: bits of the factors whose sign is minus; 16 the input's, 17 the constant's
        std::int32_t output_shift;
        std::uint32_t tables;
        std::uint32_t increments;
        std::uint32_t half_input;
        std::uint32_t saturations;
        Output output;
        Output lost;  // of the output, by its last addition; compensated only
        Sample newest;
        Sample* line;  // inputs that wait for the dead time
        std::uint32_t line_length;
        std::uint32_t line_at;
    };

    /// Coefficients and samples of the past that a table needs.
    static constexpr std::size_t table_count(const PastTable& table) { return table_needed<K>(table.design()); }
    static constexpr std::size_t past_count(const PastTable& table) { return past_needed<K>(table.design()); }
    static constexpr std::size_t line_count(std::uint32_t delay) { return std::size_t{delay} + 1; }

    /// Multiplications of a step: those of the sums, and one for each of them, for the input and for y.
    static std::size_t multiplications(const ModelDesign& design) {
        std::size_t count = design.increments && design.constant != 0.0 ? 2 : 1;
        for (const PastTable& table : design.tables) {
            count += K::multiplications(table.design().taps) + 1;
        }
        return count;
    }

    /// Fills the state and clears the past. `table` and `past` hold those of all tables, one after the other.
    /// On failure the state is undefined.
    static Status prepare(State& state, const ModelDesign& design, std::span<Coefficient> table, std::span<Sample> past,
                          std::span<Sample> line);
    /// y_k for the next input u_k, which acts from the next sample on.
    [[gnu::noinline]] static Output step(State& state, Sample input);

    static Sample from_real(const ModelDesign& design, double input) {
        return K::from_real(fixed ? input / design.input_full_scale : input);
    }
    static double to_real(const ModelDesign& design, Output output) {
        return static_cast<double>(output) * (fixed ? design.stored_full_scale * power_of_two(-31) : 1.0);
    }
};

/// The kernels that models are stepped with. A model that names modes needs one with modes, and no other takes them.
using ModelKernels = KernelList<Sum<Ring, Plain, F32>, Sum<Ring, Oldest, F32>, Sum<Mirror, Multi, F32>,
                                Sum<Mirror, MultiFma, F32>, Sum<Ring, Plain, Q31>, Sum<Ring, Oldest, F64>,
                                Sum<Modes, Plain, F32>, Sum<Modes, Compensated, F32>, Sum<Modes, Plain, Q31>>;

}  // namespace glsum
