// The bodies of all kernels, once, in the library: size, stack and cycles are those of the object code that ships.
#include "glsum/sum.hpp"

#include <algorithm>
#include <limits>

#include "glsum/block_weights.hpp"
#include "glsum/registry.hpp"

namespace glsum {

Status Null::prepare(State&, const Design& design, std::span<float>, std::span<float>) {
    return design.taps == 0 ? Status::no_taps : order_in_range(design.order) ? Status::ok : Status::order_out_of_range;
}
void Null::reset(State&) {}
float Null::step(State&, float newest) { return newest; }

namespace {

bool is_magnitude_at_most(double real, double limit) { return real <= limit && real >= -limit; }

// Whether the weights that a design names serve its first `count` taps behind a_0.
template <class Technique, class Format>
bool weights_in_range(const Design& design, std::size_t count) {
    if (design.weights.empty()) {
        return true;
    }
    constexpr bool nested = Technique::coefficient_roundings(2) == 2 || Technique::coefficient_roundings(5) == 2;
    // How far nested sums of any weights reach is not known beforehand, as it is for those of an order.
    if (design.weights.size() < count || (nested && Format::fixed_point)) {
        return false;
    }
    Weights weights(design);
    for (std::size_t j = 1; j <= count; ++j) {
        weights.next();
        constexpr double largest = std::numeric_limits<double>::max();
        if (!is_magnitude_at_most(nested ? weights.factor() : weights.weight(), largest)) {
            return false;
        }
    }
    return true;
}

}  // namespace

template <class History, class Technique, class Format>
Status Sum<History, Technique, Format>::prepare(State& state, const Design& design, std::span<Coefficient> table,
                                                std::span<Sample> past) {
    if (!order_in_range(design.order)) {
        return Status::order_out_of_range;
    }
    if (design.taps == 0) {
        return Status::no_taps;
    }
    if (!weights_in_range<Technique, Format>(design, design.taps - 1)) {
        return Status::weights_out_of_range;
    }
    if (design.taps > std::numeric_limits<std::uint32_t>::max() / 4 || table.size() < table_count(design.taps)) {
        return Status::table_too_small;
    }
    if (past.size() < past_count(design.taps)) {
        return Status::past_too_small;
    }
    typename Format::Scale scale;
    if (const Status status = Technique::template choose_scale<Format>(design, scale); status != Status::ok) {
        return status;
    }
    const std::size_t past_samples = design.taps - 1;
    Technique::template fill<Format>(table.data(), past_samples, design, scale);
    state = {table.data(), past.data(), static_cast<std::uint32_t>(past_samples), 0, scale};
    reset(state);
    return Status::ok;
}

template <class History, class Technique, class Format>
void Sum<History, Technique, Format>::reset(State& state) {
    const std::size_t count = past_count(state.past_samples + std::size_t{1});
    for (std::size_t i = 0; i < count; ++i) {
        state.past[i] = 0;
    }
    state.head = 0;
    if constexpr (Format::fixed_point) {
        state.scale.saturations = 0;
    }
}

template <class History, class Technique, class Format>
auto Sum<History, Technique, Format>::step(State& state, Sample newest) -> Output {
    if constexpr (requires { &Technique::template sum_and_push<Format>; }) {
        static_assert(History::contiguous && History::word == "shift");
        return Format::finish(
            Technique::template sum_and_push<Format>(state.table, state.past, state.past_samples, newest, state.scale),
            state.scale);
    } else {
        const auto window = History::template window<Sample>(state.past, state.past_samples, state.head);
        const auto sum = Technique::template sum<Format>(state.table, window, newest, state.scale);
        History::template push<Sample>(state.past, state.past_samples, state.head, newest);
        return Format::finish(sum, state.scale);
    }
}

namespace {

// d = mantissa 2^-shift, the mantissa of 30 bits: so its products with two samples stay, with their difference and half
// a unit, within 64 bits.
struct FixedDecay {
    std::int32_t mantissa;
    std::int32_t shift;
};
constexpr std::int32_t largest_shift = 62;

constexpr FixedDecay to_fixed(double decay) {
    std::int32_t shift = 30;
    while (shift < largest_shift && decay * power_of_two(shift) < 0x1p29) {
        ++shift;
    }
    return {round_to_integer<std::int32_t>(decay * power_of_two(shift)), shift};
}

}  // namespace

template <class Technique, class Format>
Status Sum<Modes, Technique, Format>::prepare(State& state, const Design& design, std::span<Coefficient> table,
                                              std::span<Sample> past) {
    if (!order_in_range(design.order)) {
        return Status::order_out_of_range;
    }
    if (design.taps == 0) {
        return Status::no_taps;
    }
    const std::size_t modes = design.modes.size();
    if (modes > (design.taps - 1) / 2) {
        return Status::modes_out_of_range;
    }
    if (!weights_in_range<Technique, Format>(design, design.taps - 1 - 2 * modes)) {
        return Status::weights_out_of_range;
    }
    for (const Mode& mode : design.modes) {
        if (!(mode.decay > 0.0 && mode.decay <= 1.0) ||
            !is_magnitude_at_most(mode.weight, std::numeric_limits<double>::max())) {
            return Status::modes_out_of_range;
        }
        const double gain = mode.weight / mode.decay;
        if constexpr (Format::fixed_point) {
            if (to_fixed(mode.decay).mantissa < 1 << 29) {
                return Status::format_too_narrow;
            }
        } else if (!(static_cast<Coefficient>(mode.decay) > 0) ||
                   !is_magnitude_at_most(gain, std::numeric_limits<Coefficient>::max())) {
            return Status::format_too_narrow;
        }
    }
    if (design.taps > std::numeric_limits<std::uint32_t>::max() / 4 || table.size() < table_count(design.taps, modes)) {
        return Status::table_too_small;
    }
    if (past.size() < past_count(design.taps, modes)) {
        return Status::past_too_small;
    }
    const std::size_t near_samples = design.taps - 1 - 2 * modes;
    typename Format::Scale scale = {};
    if constexpr (Format::fixed_point) {
        const auto for_each_coefficient = [&](auto visit) {
            Weights weights(design);
            for (std::size_t j = 1; j <= near_samples; ++j) {
                weights.next();
                visit(weights.weight());
            }
            for (const Mode& mode : design.modes) {
                visit(mode.weight / mode.decay);
            }
        };
        if (const Status status = Format::template choose_scale_of<64>(for_each_coefficient, scale);
            status != Status::ok) {
            return status;
        }
    }
    Plain::fill<Format>(table.data(), near_samples, design, scale);
    Coefficient* of_mode = table.data() + near_samples;
    for (std::size_t m = modes; m > 0; --m) {
        const Mode& mode = design.modes[m - 1];
        if constexpr (Format::fixed_point) {
            const FixedDecay decay = to_fixed(mode.decay);
            of_mode[0] = decay.mantissa;
            of_mode[1] = decay.shift;
        } else {
            of_mode[0] = static_cast<Coefficient>(mode.decay);
        }
        of_mode[coefficients_of_mode - 1] = Format::coefficient(mode.weight / mode.decay, scale);
        of_mode += coefficients_of_mode;
    }
    state = {table.data(), past.data(), static_cast<std::uint32_t>(near_samples), static_cast<std::uint32_t>(modes),
             scale};
    reset(state);
    return Status::ok;
}

template <class Technique, class Format>
void Sum<Modes, Technique, Format>::reset(State& state) {
    const std::size_t count = state.near_samples + words_of_mode * state.modes;
    for (std::size_t i = 0; i < count; ++i) {
        state.past[i] = 0;
    }
    if constexpr (Format::fixed_point) {
        state.scale.saturations = 0;
    }
}

// s + d (x - s), with what the step lost before and loses now where that is kept.
template <class Technique, class Format>
auto Sum<Modes, Technique, Format>::move(const Coefficient* of_mode, const Sample* average, Sample leaving)
    -> Averaged {
    const Sample before = average[0];
    if constexpr (Format::fixed_point) {
        const std::int64_t step = std::int64_t{of_mode[0]} * leaving - std::int64_t{of_mode[0]} * before;
        const std::int32_t shift = of_mode[1];
        // In 64 bits: the step alone may leave 32 where the average does not.
        return {static_cast<Sample>(before + ((step + (std::int64_t{1} << (shift - 1))) >> shift)), 0};
    } else if constexpr (compensated) {
        const Sample step = of_mode[0] * (leaving - before) + average[1];
        const Sample after = before + step;
        return {after, step - (after - before)};
    } else {
        return {before + of_mode[0] * (leaving - before), 0};
    }
}

template <class Technique, class Format>
void Sum<Modes, Technique, Format>::keep(Sample* average, const Averaged& moved) {
    average[0] = moved.average;
    if constexpr (compensated) {
        average[1] = moved.lost;
    }
}

template <class Technique, class Format>
auto Sum<Modes, Technique, Format>::step(State& state, Sample newest) -> Output {
    const std::size_t near_samples = state.near_samples;
    const Coefficient* table = state.table;
    Sample* const past = state.past;
    auto sum = Format::start(newest, state.scale);
    // What the near taps hold no longer when the next sample comes.
    Sample leaving = newest;
    if (near_samples != 0) {
        for (std::size_t i = 0; i < near_samples; ++i) {
            sum = Format::multiply_add(sum, table[i], past[i]);
        }
        leaving = past[near_samples - 1];
        for (std::size_t i = near_samples - 1; i > 0; --i) {
            past[i] = past[i - 1];
        }
        past[0] = newest;
    }
    table += near_samples;
    Sample* average = past + near_samples;
    const auto one_mode = [&]() __attribute__((always_inline)) {
        const Averaged moved = move(table, average, leaving);
        sum = Format::multiply_add(sum, table[coefficients_of_mode - 1], average[0]);
        keep(average, moved);
        table += coefficients_of_mode;
        average += words_of_mode;
    };
    if constexpr (Format::fixed_point) {
        for (std::uint32_t left = state.modes; left != 0; --left) {
            one_mode();
        }
    } else {
        // Two at a time: no mode waits for another, and a core that issues in order has something to do between the
        // steps of one. The sum still takes them one after the other.
        const auto two_modes = [&]() __attribute__((always_inline)) {
            const Sample first = average[0];
            const Sample second = average[words_of_mode];
            const Coefficient first_gain = table[coefficients_of_mode - 1];
            const Coefficient second_gain = table[2 * coefficients_of_mode - 1];
            const Averaged one = move(table, average, leaving);
            const Averaged other = move(table + coefficients_of_mode, average + words_of_mode, leaving);
            sum = Format::multiply_add(Format::multiply_add(sum, first_gain, first), second_gain, second);
            keep(average, one);
            keep(average + words_of_mode, other);
            table += 2 * coefficients_of_mode;
            average += 2 * words_of_mode;
        };
        if (state.modes % 2 != 0) {
            one_mode();
        }
        // Into the middle of eight at a time: the end of a loop over a few modes is a branch that is guessed wrong at
        // each step, a jump to the same place is not.
        std::uint32_t pairs = state.modes / 2;
        if (pairs != 0) {
            switch (pairs % 4) {
                do {
                    case 0:
                        two_modes();
                        [[fallthrough]];
                    case 3:
                        two_modes();
                        [[fallthrough]];
                    case 2:
                        two_modes();
                        [[fallthrough]];
                    case 1:
                        two_modes();
                        pairs = pairs > 4 ? (pairs - 1) / 4 * 4 : 0;
                } while (pairs != 0);
            }
        }
    }
    return Format::finish(sum, state.scale);
}

namespace {

// u(k) of the level above, from two of the level below; in fixed point both are means.
template <class Format>
typename Format::Sample together(typename Format::Sample one, typename Format::Sample other) {
    if constexpr (Format::fixed_point) {
        return (one | other) - ((one ^ other) >> 1);  // (one + other) / 2, halves up, without its carry
    } else {
        return one + other;
    }
}

// By `far` words on in a ring, far <= size. Without a branch: how often it wraps must not show.
std::size_t around(std::size_t at, std::size_t far, std::size_t size) {
    const std::size_t next = at + far;
    return next >= size ? next - size : next;
}

}  // namespace

template <class Technique, class Format>
Status Sum<Nested, Technique, Format>::prepare(State& state, const Design& design, std::span<Coefficient> table,
                                               std::span<Sample> past) {
    if (!order_in_range(design.order)) {
        return Status::order_out_of_range;
    }
    if (design.taps == 0) {
        return Status::no_taps;
    }
    if (design.blocks.count > 0 && reach_of(design) > most_reach) {
        return Status::blocks_out_of_range;
    }
    if (design.taps > std::numeric_limits<std::uint32_t>::max() / 4 || table.size() < table_count(design)) {
        return Status::table_too_small;
    }
    if (past.size() < past_count(design)) {
        return Status::past_too_small;
    }
    if (!weights_in_range<Technique, Format>(design, reach_of(design) - 1)) {
        return Status::weights_out_of_range;
    }
    const std::size_t near_samples = design.taps - 1 - design.blocks.count;
    const auto for_each_coefficient = [&](auto visit) {
        Weights weights(design);
        for (std::size_t j = 1; j <= near_samples; ++j) {
            weights.next();
            visit(weights.weight());
        }
        BlockWeights blocks(design.blocks, weights);
        for (std::size_t b = 0; b < design.blocks.count; ++b) {
            blocks.next();
            visit(Format::fixed_point ? blocks.sum() : blocks.mean());
        }
    };
    typename Format::Scale scale = {};
    if constexpr (Format::fixed_point) {
        if (const Status status = Format::template choose_scale_of<64>(for_each_coefficient, scale);
            status != Status::ok) {
            return status;
        }
    }
    Coefficient* next = table.data();
    for_each_coefficient([&](double real) { *next++ = Format::coefficient(real, scale); });
    state = {table.data(),
             past.data(),
             static_cast<std::uint32_t>(past_count(design)),
             0,
             static_cast<std::uint32_t>(near_samples),
             static_cast<std::uint32_t>(design.blocks.count),
             static_cast<std::uint32_t>(design.blocks.per_level),
             scale};
    reset(state);
    return Status::ok;
}

template <class Technique, class Format>
void Sum<Nested, Technique, Format>::reset(State& state) {
    for (std::size_t i = 0; i < state.past_samples; ++i) {
        state.past[i] = 0;
    }
    state.head = 0;
    if constexpr (Format::fixed_point) {
        state.scale.saturations = 0;
    }
}

template <class Technique, class Format>
auto Sum<Nested, Technique, Format>::step(State& state, Sample newest) -> Output {
    const std::size_t size = state.past_samples;
    const std::size_t near_samples = state.near_samples;
    Sample* const past = state.past;
    const std::size_t newer = std::min<std::size_t>(near_samples, size - state.head);
    auto sum = Plain::sum<Format>(state.table, {past + state.head, newer, past, near_samples - newer, state.head},
                                  newest, state.scale);
    if (std::uint32_t left = state.blocks; left != 0) {
        const Coefficient* weight = state.table + near_samples;
        const std::uint32_t per_level = state.per_level;
        std::size_t at = around(state.head, near_samples, size);  // x_(k-K)
        for (std::size_t width = 1;;) {
            const Sample younger = past[at];
            at = around(at, width, size);
            const Sample block = together<Format>(younger, past[at]);
            past[at] = block;  // what the level below has dropped is the place of this one's newest
            sum = Format::multiply_add(sum, *weight++, block);
            width *= 2;
            for (std::uint32_t others = std::min(left, per_level) - 1; others != 0; --others) {
                at = around(at, width, size);
                sum = Format::multiply_add(sum, *weight++, past[at]);
            }
            if (left <= per_level) {
                break;
            }
            left -= per_level;
            at = around(at, width, size);
        }
    }
    Ring::template push<Sample>(past, size, state.head, newest);
    return Format::finish(sum, state.scale);
}

template <class Kept, class Technique, class Format>
Status Sum<Delta<Kept>, Technique, Format>::prepare(State& state, const Design& design, std::span<Coefficient> table,
                                                    std::span<Sample> past) {
    if (!order_in_range(design.order)) {
        return Status::order_out_of_range;
    }
    const Status status = Inner::prepare(state, inner_design(design), table, past);
    if (status == Status::ok) {
        state.before = 0;
    }
    return status;
}

template <class Kept, class Technique, class Format>
void Sum<Delta<Kept>, Technique, Format>::reset(State& state) {
    Inner::reset(state);
    state.before = 0;
}

// Flat: with the inner sum as a call, its cost would count as one of that kernel, too.
template <class Kept, class Technique, class Format>
[[gnu::flatten]] auto Sum<Delta<Kept>, Technique, Format>::step(State& state, Sample newest) -> Output {
    Sample increment;
    if constexpr (Format::fixed_point) {
        static_assert(Format::sample_bits == 31);
        const Rounded difference = round_shift(std::int64_t{newest} - state.before, 0);
        increment = difference.value;
        state.scale.saturations += difference.saturated ? 1U : 0U;
    } else {
        increment = newest - state.before;
    }
    state.before = newest;
    return Inner::step(state, increment);
}

template <class Technique, class Format>
Status Sum<Integral, Technique, Format>::prepare(State& state, const Design& design, std::span<Coefficient> table,
                                                 std::span<Sample> past) {
    if (!order_in_range(design.order)) {
        return Status::order_out_of_range;
    }
    if (design.modes.size() > (std::max<std::size_t>(design.taps, 1) - 1) / 2) {
        return design.taps == 0 ? Status::no_taps : Status::modes_out_of_range;
    }
    const double weight = design.modes.empty() ? 0.0 : design.modes.front().weight;
    if (!design.modes.empty() &&
        (design.modes.front().decay != 0.0 || !is_magnitude_at_most(weight, std::numeric_limits<double>::max()))) {
        return Status::modes_out_of_range;
    }
    if (!is_magnitude_at_most(weight, std::numeric_limits<Coefficient>::max())) {
        return Status::format_too_narrow;
    }
    const Status status = Inner::prepare(state, inner_design(design), table, past);
    if (status == Status::ok) {
        state.weight = static_cast<Coefficient>(weight);
        state.total = 0;
        state.lost = 0;
    }
    return status;
}

template <class Technique, class Format>
void Sum<Integral, Technique, Format>::reset(State& state) {
    Inner::reset(state);
    state.total = 0;
    state.lost = 0;
}

template <class Technique, class Format>
[[gnu::flatten]] auto Sum<Integral, Technique, Format>::step(State& state, Sample newest) -> Output {
    const Sample leaving = state.near_samples != 0 ? state.past[state.near_samples - 1] : newest;
    const Sample total = state.total;
    const Sample lost = state.lost;
    const Sample after = total + leaving;
    const Sample leaving_part = after - total;
    state.total = after;
    state.lost = lost + ((total - (after - leaving_part)) + (leaving - leaving_part));
    return Format::multiply_add(Inner::step(state, newest), state.weight, total + lost);
}

template <bool to_first, class Technique, class Format>
Status Sum<Guess<to_first>, Technique, Format>::prepare(State& state, const Design& design,
                                                        std::span<Coefficient> table, std::span<Sample> past) {
    if (!design.weights.empty()) {
        return order_in_range(design.order) ? Status::weights_out_of_range : Status::order_out_of_range;
    }
    if (const Status status = Inner::prepare(state, design, table, past); status != Status::ok) {
        return status;
    }
    Weights weights(design.order);
    while (weights.index() < design.taps) {
        weights.next();
    }
    // a_L = -A v / L. Of order 0 nothing is behind a_0.
    const double in_window =
        design.order == 0.0 ? 1.0 : -weights.weight() * static_cast<double>(design.taps) / design.order;
    state.minus_order = static_cast<Coefficient>(-design.order);
    state.in_window = static_cast<Coefficient>(in_window);
    reset(state);
    return Status::ok;
}

template <bool to_first, class Technique, class Format>
void Sum<Guess<to_first>, Technique, Format>::reset(State& state) {
    Inner::reset(state);
    state.count = 0;
    state.tail = {};
    state.line = {};
}

template <bool to_first, class Technique, class Format>
auto Sum<Guess<to_first>, Technique, Format>::step(State& state, Sample newest) -> Output {
    const auto window = Mirror::template window<Sample>(state.past, state.past_samples, state.head);
    auto sum = Technique::template sum<Format>(state.table, window, newest, state.scale);
    const std::uint32_t k = state.count;
    const bool dropped = k > state.past_samples;
    if (dropped && k != last_count) {
        if constexpr (to_first) {
            Carried<Coefficient>& mean = state.line.mean;
            mean.add((state.tail.value - mean.value) / static_cast<Coefficient>(k - state.past_samples));
        }
        state.tail.add((state.in_window + state.tail.value) * state.minus_order / static_cast<Coefficient>(k));
    }
    if (dropped) {
        const Sample oldest = state.past_samples == 0 ? newest : window.newer[state.past_samples - 1];
        if constexpr (to_first) {
            const Coefficient mean = state.line.mean.value;
            sum = Format::multiply_add(sum, mean, oldest);
            sum = Format::multiply_add(sum, state.tail.value - mean, state.line.first);
        } else {
            sum = Format::multiply_add(sum, state.tail.value, oldest);
        }
    }
    if constexpr (to_first) {
        state.line.first = k == 0 ? newest : state.line.first;
    }
    state.count = k == last_count ? k : k + 1;
    Mirror::template push<Sample>(state.past, state.past_samples, state.head, newest);
    return Format::finish(sum, state.scale);
}

#if defined(GLSUM_SIMD)
template <class Technique, class Format>
Status Sum<HostBlock, Technique, Format>::prepare(State& state, const Design& design, std::span<Coefficient> table,
                                                  std::span<Sample> past) {
    if (!order_in_range(design.order)) {
        return Status::order_out_of_range;
    }
    if (design.taps == 0) {
        return Status::no_taps;
    }
    const std::size_t past_samples = design.taps - 1;
    if (!weights_in_range<Technique, Format>(design, past_samples)) {
        return Status::weights_out_of_range;
    }
    if (design.taps > std::numeric_limits<std::uint32_t>::max() / 4 || table.size() < table_count(design.taps)) {
        return Status::table_too_small;
    }
    if (past.size() < past_count(design.taps)) {
        return Status::past_too_small;
    }
    for (std::size_t i = 0; i < table_count(design.taps); ++i) {
        table[i] = 0;
    }
    Coefficient* const window = table.data() + entering_count;
    const bool tables = has_tables(design.taps);
    const std::size_t lag = tables ? padded(design.taps) : 1;
    Weights weights(design);
    for (std::size_t j = 1; j <= past_samples; ++j) {
        weights.next();
        const auto weight = static_cast<Coefficient>(weights.weight());
        if (j < simd_block_samples) {
            table[simd_block_samples - 1 + j] = weight;
        }
        for (std::size_t q = 0; q < (tables ? simd_block_samples : 1) && q < j; ++q) {
            window[q * lag + j - 1 - (tables ? q : 0)] = weight;
        }
    }
    state = {{.entering = table.data(),
              .window = window,
              .lag = lag,
              .vectors = padded(design.taps) / lanes,
              .pending = past.data(),
              .past = past.data() + lanes,
              .size = static_cast<std::uint32_t>(ring_size(design.taps)),
              .head = 0},
             {}};
    reset(state);
    return Status::ok;
}

template <class Technique, class Format>
void Sum<HostBlock, Technique, Format>::reset(State& state) {
    if (state.size != 0) {
        Sample* const end = state.past + 2 * std::size_t{state.size} + lanes;
        for (Sample* sample = state.pending; sample != end; ++sample) {
            *sample = 0;
        }
    }
    state.head = 0;
}

template <class Technique, class Format>
auto Sum<HostBlock, Technique, Format>::step(State& state, Sample newest) -> Output {
    if constexpr (fused) {
        return simd_block_step_fused(state, newest);
    } else {
        return simd_block_step(state, newest);
    }
}
#endif

namespace {

// All loads before the first product. On a Cortex-M7 a fused product holds off the loads behind it for three cycles:
// once a turn, not once a load.
[[gnu::always_inline]] inline void load_all(float (&c)[11], float (&x)[8], float (&s)[4]) {
#if defined(GLSUM_M7_FLOATS)
    __asm__ volatile(""
                     : "+t"(c[0]), "+t"(c[1]), "+t"(c[2]), "+t"(c[3]), "+t"(c[4]), "+t"(c[5]), "+t"(c[6]), "+t"(c[7]),
                       "+t"(c[8]), "+t"(c[9]), "+t"(c[10]));
    __asm__ volatile(""
                     : "+t"(x[0]), "+t"(x[1]), "+t"(x[2]), "+t"(x[3]), "+t"(x[4]), "+t"(x[5]), "+t"(x[6]), "+t"(x[7]),
                       "+t"(s[0]), "+t"(s[1]), "+t"(s[2]), "+t"(s[3]));
#else
    (void)c;
    (void)x;
    (void)s;
#endif
}

}  // namespace

template <class Technique, class Format>
Status Sum<Block, Technique, Format>::prepare(State& state, const Design& design, std::span<Coefficient> table,
                                              std::span<Sample> past) {
    if (!order_in_range(design.order)) {
        return Status::order_out_of_range;
    }
    if (design.taps == 0) {
        return Status::no_taps;
    }
    if (!weights_in_range<Technique, Format>(design, design.taps - 1)) {
        return Status::weights_out_of_range;
    }
    if (design.taps > std::numeric_limits<std::uint32_t>::max() / 4 || table.size() < table_count(design.taps)) {
        return Status::table_too_small;
    }
    if (past.size() < past_count(design.taps)) {
        return Status::past_too_small;
    }
    typename Format::Scale scale;
    if (const Status status = Technique::template choose_scale<Format>(design, scale); status != Status::ok) {
        return status;
    }
    const std::size_t past_samples = design.taps - 1;
    Technique::template fill<Format>(table.data(), past_samples, design, scale);
    for (std::size_t i = past_samples; i < table_count(design.taps); ++i) {
        table[i] = 0;
    }
    state = {};
    state.table = table.data();
    state.past = past.data();
    state.past_samples = static_cast<std::uint32_t>(past_samples);
    state.groups = static_cast<std::uint32_t>(Block::groups(past_samples));
    state.scale = scale;
    reset(state);
    return Status::ok;
}

template <class Technique, class Format>
void Sum<Block, Technique, Format>::reset(State& state) {
    for (std::size_t i = 0; i < phases * state.groups; ++i) {
        state.past[i] = 0;
    }
    for (std::size_t q = 0; q < phases; ++q) {
        state.ready[q] = Format::zero();
        state.coming[q] = Format::zero();
    }
    state.own = 0;
    state.phase = 0;
    state.left = state.groups;
    if constexpr (Format::fixed_point) {
        state.scale.saturations = 0;
    }
}

// Adds to the sums of neighbouring outputs their products with so many groups in turn, from `samples` on. a: of the
// first output the place behind the coefficient of the first sample; it falls by four from group to group. kept: the
// last of the coefficients are in c already.
template <class Technique, class Format>
template <std::size_t outputs, std::size_t groups, std::size_t kept>
void Sum<Block, Technique, Format>::add_groups(Accumulator (&s)[outputs],
                                               Coefficient (&c)[phases * groups - 1 + outputs], const Coefficient* a,
                                               const Sample* samples) {
    constexpr std::size_t count = phases * groups;
    // Of output q and sample r: lag q - r behind that of the first.
    for (std::size_t i = 0; i < std::size(c) - kept; ++i) {
        c[i] = *(a - count + i);
    }
    Sample x[count];
    for (std::size_t r = 0; r < count; ++r) {
        x[r] = samples[r];
    }
    if constexpr (fused && groups == 2) {
        load_all(c, x, s);
    }
    for (std::size_t r = 0; r < count; ++r) {
        for (std::size_t q = 0; q < outputs; ++q) {
            s[q] = accumulate<Format, fused>(s[q], c[count - 1 + q - r], x[r]);
        }
    }
}

template <class Technique, class Format>
template <std::size_t outputs>
void Sum<Block, Technique, Format>::add_share(Accumulator* sums, const Coefficient* a, const Sample* samples,
                                              std::size_t count) {
    Accumulator s[outputs];
    for (std::size_t q = 0; q < outputs; ++q) {
        s[q] = sums[q];
    }
    Coefficient c[phases - 1 + outputs];
    if constexpr (Format::fixed_point) {
        // What the next group has too is kept: a move beside a product costs nothing.
        constexpr std::size_t kept = outputs - 1;
        for (std::size_t i = 0; i < kept; ++i) {
            c[phases + i] = a[i];
        }
        for (; count != 0; --count) {
            add_groups<outputs, 1, kept>(s, c, a, samples);
            for (std::size_t i = kept; i > 0; --i) {
                c[phases + i - 1] = c[i - 1];
            }
            a -= phases;
            samples += phases;
        }
    } else {
        // It is loaded again: a move is a floating-point operation more, a load goes beside one.
        if (count % 2 != 0) {
            add_groups<outputs, 1, 0>(s, c, a, samples);
            a -= phases;
            samples += phases;
        }
        Coefficient of_two[2 * phases - 1 + outputs];
        for (std::size_t turns = count / 2; turns != 0; --turns) {
            add_groups<outputs, 2, 0>(s, of_two, a, samples);
            a -= 2 * phases;
            samples += 2 * phases;
        }
    }
    for (std::size_t q = 0; q < outputs; ++q) {
        sums[q] = s[q];
    }
}

template <class Technique, class Format>
auto Sum<Block, Technique, Format>::sum_of(const State& state, Sample newest) -> Accumulator {
    if (state.groups == 0) {
        return Format::start(newest, state.scale);
    }
    const std::size_t phase = state.phase;
    const Sample* const own = state.past + phases * state.own;
    auto sum = state.ready[phase];
    const Coefficient* a = state.table + phase;
    for (std::size_t i = 0; i < phase; ++i) {
        sum = accumulate<Format, fused>(sum, *--a, own[i]);
    }
    return Format::start(newest, state.scale) + sum;
}

template <class Technique, class Format>
void Sum<Block, Technique, Format>::advance(State& state, Sample newest) {
    const std::size_t groups = state.groups;
    if (groups == 0) {
        return;
    }
    const std::size_t phase = state.phase;
    state.past[phases * state.own + phase] = newest;
    // Its share of the groups that the next four outputs lack, the oldest first, in at most two pieces of the ring.
    std::size_t share = (groups + phase) / phases;
    while (share != 0) {
        const std::size_t left = state.left;
        std::size_t from = state.own + 1 + groups - left;
        from = from >= groups ? from - groups : from;
        const std::size_t count = std::min(share, groups - from);
        const Coefficient* const first = state.table + phases * left;
        const Sample* const samples = state.past + phases * from;
        constexpr std::size_t outputs = Format::fixed_point ? 2 : phases;  // registers
        for (std::size_t q = 0; q < phases; q += outputs) {
            add_share<outputs>(state.coming + q, first + q, samples, count);
        }
        state.left = static_cast<std::uint32_t>(left - count);
        share -= count;
    }
    if (phase + 1 != phases) {
        state.phase = static_cast<std::uint32_t>(phase + 1);
    } else {
        for (std::size_t q = 0; q < phases; ++q) {
            state.ready[q] = state.coming[q];
            state.coming[q] = Format::zero();
        }
        state.phase = 0;
        state.left = state.groups;
        state.own = state.own + 1 == groups ? 0 : state.own + 1;
    }
}

template <class Technique, class Format>
GLSUM_FUSED_CLONES auto Sum<Block, Technique, Format>::sum_of_fused(const State& state, Sample newest) -> Accumulator {
    return sum_of(state, newest);
}
template <class Technique, class Format>
GLSUM_FUSED_CLONES void Sum<Block, Technique, Format>::advance_fused(State& state, Sample newest) {
    advance(state, newest);
}
template <class Technique, class Format>
GLSUM_FUSED_CLONES auto Sum<Block, Technique, Format>::step_fused(State& state, Sample newest) -> Output {
    const Accumulator sum = sum_of(state, newest);
    advance(state, newest);
    return Format::finish(sum, state.scale);
}

template <class Technique, class Format>
auto Sum<Block, Technique, Format>::answer(State& state, Sample newest) -> Output {
    if constexpr (fused) {
        return Format::finish(sum_of_fused(state, newest), state.scale);
    } else {
        return Format::finish(sum_of(state, newest), state.scale);
    }
}

template <class Technique, class Format>
void Sum<Block, Technique, Format>::settle(State& state, Sample newest) {
    if constexpr (fused) {
        advance_fused(state, newest);
    } else {
        advance(state, newest);
    }
}

template <class Technique, class Format>
auto Sum<Block, Technique, Format>::step(State& state, Sample newest) -> Output {
    if constexpr (fused) {
        return step_fused(state, newest);
    } else {
        const Accumulator sum = sum_of(state, newest);
        advance(state, newest);
        return Format::finish(sum, state.scale);
    }
}

#define GLSUM_KERNEL(published, history, technique, format) template struct Sum<history, technique, format>;
#if defined(GLSUM_SIMD)
#define GLSUM_HOST_KERNEL GLSUM_KERNEL
#else
#define GLSUM_HOST_KERNEL(published, history, technique, format)
#endif
#include "glsum/registry.def"

}  // namespace glsum
