// The contract of a kernel, read first. A kernel evaluates, sample by sample, the Grünwald-Letnikov sum
//
//   S_k = sum_{j=0..min(k, L-1)} a_j x_(k-j),   a_0 = 1,   a_j = a_(j-1) (1 - (1+v)/j)      ([Matusiak2020] (3))
//
// of order v over L coefficients ("taps", a_0 included); x = 0 before k = 0. The factor h^-v is not part of it.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <string_view>

namespace glsum {

/// A decaying exponential that stands for far taps: behind the first K its part of the weight of index j is
/// weight (1 - decay)^(j-K).
struct Mode {
    /// d = 1 - r in (0, 1], in floating point below 2: beyond 1 its weights change their sign from lag to lag. r itself
    /// would lose the slow modes in single precision. 0: an integrator
    double decay;
    double weight;  ///< w
};

/// Sums over blocks of samples that stand for far taps (logmemory/nested.hpp): `per_level` blocks of 2, as many of 4,
/// of
/// 8
/// ..., `count` in all.
struct Blocks {
    std::size_t count = 0;      ///< M
    std::size_t per_level = 1;  ///< B >= 1
    bool operator==(const Blocks&) const = default;
};

/// What a kernel is prepared for.
struct Design {
    double order;      ///< v, in (-2, 2]
    std::size_t taps;  ///< L >= 1: coefficients, a_0 included; a mode counts as two, a block as one
    /// For a kernel whose history is `modes`: M exponentials behind the first K = L - 2M taps, K >= 1. Without any it
    /// ends where a window of L taps does. For `modessum` the first decays by 0, for others none does. A kernel
    /// that keeps a window does not look at them. They are copied.
    std::span<const Mode> modes = {};
    /// In place of the order's own weights, any others: a_1, a_2, ... as many as the taps before the modes need. So one
    /// kernel sums the merged table of a model of several orders, or weights of another discretisation. Empty: those of
    /// the order. The Horner forms refuse a weight behind a zero. They are copied.
    std::span<const double> weights = {};
    /// For a kernel whose history is `nested`: the blocks behind the first K = L - M taps, K >= 1. Named weights must
    /// then be there for every lag that the blocks reach. Without any it ends where a window of L taps does. Others do
    /// not look at them.
    Blocks blocks = {};
};

/// Why `prepare` refused. Nothing else in a kernel can fail.
enum class Status {
    ok,
    order_out_of_range,    ///< not in (-2, 2], or not a number
    no_taps,               ///< taps is 0
    table_too_small,       ///< fewer coefficients than `table_count(taps)`
    past_too_small,        ///< fewer samples than `past_count(taps)`
    format_too_narrow,     ///< the coefficients of this order and length do not fit the format with any scale
    modes_out_of_range,    ///< no tap is left beside the modes, or one that does not decay or is not a number
    weights_out_of_range,  ///< fewer weights than taps, one that is not a number, or one that has no Horner form
    blocks_out_of_range,   ///< no tap is left beside the blocks, a level has none, or they reach beyond 2^28 samples
};

/// A kernel is a type without objects; what changes lives in its State, which the caller owns together with two
/// buffers: the coefficient table and the past. Their sizes follow from the largest length (the capacity);
/// `prepare` may be called again for any order and any length that fits. With blocks the capacity is one of the lags
/// that they reach.
///
/// `prepare` may be slow and computes in double; `step` is what is measured: one sample in, one sum out.
/// Neither uses the heap, I/O, exceptions or RTTI. A State may be copied only together with its buffers.
template <class K>
concept Kernel = requires(typename K::State& state, const typename K::State& prepared, typename K::Sample sample,
                          typename K::Output output, const Design& design, std::size_t taps, double real,
                          std::span<typename K::Coefficient> table, std::span<typename K::Sample> past) {
    { K::name() } -> std::same_as<std::string_view>;
    { K::host_only } -> std::convertible_to<bool>;
    { K::table_count(taps) } -> std::same_as<std::size_t>;
    { K::past_count(taps) } -> std::same_as<std::size_t>;
    { K::prepare(state, design, table, past) } -> std::same_as<Status>;
    { K::reset(state) } -> std::same_as<void>;
    { K::step(state, sample) } -> std::same_as<typename K::Output>;
    { K::from_real(real) } -> std::same_as<typename K::Sample>;
    { K::to_real(prepared, output) } -> std::same_as<double>;
};

/// Whether a kernel's body is in the library: not of a combination of words that registry.def has no line for. A kernel
/// of somebody else's brings its own.
template <class K>
inline constexpr bool is_registered = true;

/// A kernel in two halves: `answer(state, x_k)` gives S_k as soon as x_k is there, then `settle(state, x_k)` does what
/// coming sums need; together, in this order, they are `step` to the last bit. Between sample and result lies only the
/// first (`latency_model_cycles`).
template <class K>
concept InHalves = requires(typename K::State& state, typename K::Sample sample) {
    { K::answer(state, sample) } -> std::same_as<typename K::Output>;
    { K::settle(state, sample) } -> std::same_as<void>;
};

/// Coefficients and samples of the past that a kernel needs for this very design: no more than for any of its taps.
template <Kernel K>
[[nodiscard]] constexpr std::size_t table_needed(const Design& design) {
    if constexpr (requires { K::table_count(design); }) {
        return K::table_count(design);
    } else if constexpr (requires { K::table_count(design.taps, design.modes.size()); }) {
        return K::table_count(design.taps, design.modes.size());
    } else {
        return K::table_count(design.taps);
    }
}
template <Kernel K>
[[nodiscard]] constexpr std::size_t past_needed(const Design& design) {
    if constexpr (requires { K::past_count(design); }) {
        return K::past_count(design);
    } else if constexpr (requires { K::past_count(design.taps, design.modes.size()); }) {
        return K::past_count(design.taps, design.modes.size());
    } else {
        return K::past_count(design.taps);
    }
}

/// The type list behind the registry.
template <Kernel... Ks>
struct KernelList {
    static constexpr std::size_t count = sizeof...(Ks);

    /// Calls `visit.template operator()<K>()` for every kernel, in the registry's order.
    template <class Visitor>
    static constexpr void for_each(Visitor&& visit) {
        (visit.template operator()<Ks>(), ...);
    }

    /// The same for the kernel of this name alone. \return whether there is one
    template <class Visitor>
    static constexpr bool with(std::string_view name, Visitor&& visit) {
        return ((Ks::name() == name && (visit.template operator()<Ks>(), true)) || ...);
    }
};

/// A State with buffers of its own, for at most `capacity` taps: the convenient way to use a kernel.
///
///     glsum::Line<glsum::ring_plain_f32, 600> line;
///     line.prepare({.order = 0.5, .taps = 400});
///     float sum = line.step(x);
///
/// Not copyable: the state points into the buffers.
template <Kernel K, std::size_t capacity>
class Line {
public:
    Line() = default;
    Line(const Line&) = delete;
    Line& operator=(const Line&) = delete;

    Status prepare(const Design& design) { return K::prepare(state_, design, table_, past_); }
    void reset() { K::reset(state_); }
    typename K::Output step(typename K::Sample sample) { return K::step(state_, sample); }
    typename K::Output answer(typename K::Sample sample) requires InHalves<K> { return K::answer(state_, sample); }
    void settle(typename K::Sample sample) requires InHalves<K> { K::settle(state_, sample); }
    [[nodiscard]] const typename K::State& state() const { return state_; }

private:
    static_assert(capacity >= 1);
    static_assert(is_registered<K>, "no such kernel: glsum/registry.def lists those that the library has");
    // One element more than needed: a capacity of 1 needs no past, and an array may not be empty.
    alignas(64) typename K::Coefficient table_[K::table_count(capacity) + 1] = {};
    alignas(64) typename K::Sample past_[K::past_count(capacity) + 1] = {};
    typename K::State state_ = {};
};

}  // namespace glsum
