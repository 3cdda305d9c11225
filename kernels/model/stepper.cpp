#include "model/stepper.hpp"

namespace glsum {
namespace {

constexpr double magnitude(double real) { return real < 0.0 ? -real : real; }

// The scale for any ratios: as `Fixed::choose_scale` has it for those of an order.
template <class Format>
bool choose_scale(std::span<const double> ratios, typename Format::Scale& scale) {
    if constexpr (Format::fixed_point) {
        double largest = 0.0;
        double absolute = 1.0;
        for (const double ratio : ratios) {
            largest = magnitude(ratio) > largest ? magnitude(ratio) : largest;
            // Each coefficient may be rounded up by half a unit.
            absolute += magnitude(ratio) + power_of_two(-31);
        }
        int exponent = 0;
        while (exponent < 31 && (largest >= power_of_two(exponent) || absolute > power_of_two(exponent + 1))) {
            ++exponent;
        }
        int output_exponent = 0;
        while (output_exponent < 31 && absolute > power_of_two(output_exponent)) {
            ++output_exponent;
        }
        if (exponent == 31 || output_exponent == 31) {
            return false;
        }
        scale = {};
        scale.table_exponent = static_cast<std::int8_t>(exponent);
        scale.output_exponent = static_cast<std::int8_t>(output_exponent);
        scale.output_shift =
            static_cast<std::int8_t>(Format::sample_bits + Format::coefficient_bits - exponent - 31 + output_exponent);
    }
    return true;
}

}  // namespace

template <class K>
Status Stepper<K>::prepare(State& state, const ModelDesign& design, std::span<Coefficient> table,
                           std::span<Sample> past, std::span<Sample> line) {
    if (line.size() < line_count(design.delay)) {
        return Status::past_too_small;
    }
    if (design.tables.size() > most_tables) {
        return Status::no_taps;
    }
    state.negative = 0;
    const auto factor = [&](double value, unsigned bit) {
        if constexpr (fixed) {
            state.negative |= value < 0.0 ? 1U << bit : 0U;
            // A factor of 0 has no mantissa.
            return value == 0.0 ? Gain{0, 0} : make_gain(magnitude(value));
        } else {
            (void)bit;
            return static_cast<Sample>(value);
        }
    };
    std::size_t coefficient_at = 0;
    std::size_t sample_at = 0;
    for (std::size_t i = 0; i < design.tables.size(); ++i) {
        const PastTable& past_table = design.tables[i];
        const std::size_t ratios = past_table.ratios.size();
        if (coefficient_at + table_count(ratios) > table.size()) {
            return Status::table_too_small;
        }
        if (sample_at + past_count(ratios) > past.size()) {
            return Status::past_too_small;
        }
        typename Format::Scale scale;
        if (!choose_scale<Format>(past_table.ratios, scale)) {
            return Status::format_too_narrow;
        }
        for (std::size_t j = 0; j < ratios; ++j) {
            table[coefficient_at + j] = Format::coefficient(past_table.ratios[j], scale);
        }
        state.sums[i] = {table.data() + coefficient_at, past.data() + sample_at, static_cast<std::uint32_t>(ratios), 0,
                         scale};
        K::reset(state.sums[i]);
        coefficient_at += table_count(ratios);
        sample_at += past_count(ratios);
        state.factor[i] = factor(past_table.factor, static_cast<unsigned>(i));
    }
    state.input = factor(design.input * (fixed ? design.input_full_scale / design.stored_full_scale : 1.0), 16);
    state.constant = factor(design.constant * (fixed ? design.output_full_scale / design.stored_full_scale : 1.0), 17);
    int shift = 0;  // from units of x to those of y
    while (fixed && power_of_two(shift) * design.stored_full_scale < design.output_full_scale && shift < 32) {
        ++shift;
    }
    state.output_shift = shift;
    state.tables = static_cast<std::uint32_t>(design.tables.size());
    state.increments = design.increments ? 1 : 0;
    state.saturations = 0;
    state.output = 0;
    state.newest = 0;
    state.line = line.data();
    state.line_length = static_cast<std::uint32_t>(line_count(design.delay));
    state.line_at = 0;
    for (std::size_t i = 0; i < line_count(design.delay); ++i) {
        line[i] = 0;
    }
    return Status::ok;
}

template <class K>
auto Stepper<K>::step(State& state, Sample input) -> Output {
    const Sample acting = state.line[state.line_at];
    state.line[state.line_at] = input;
    state.line_at = state.line_at + 1 == state.line_length ? 0 : state.line_at + 1;
    if constexpr (fixed) {
        const auto times = [&](std::int32_t value, int exponent, const Gain& gain, unsigned bit) {
            const Rounded product = apply_gain(value, exponent, gain, 0);
            state.saturations += product.saturated ? 1U : 0U;
            return (state.negative >> bit & 1U) != 0 ? -std::int64_t{product.value} : std::int64_t{product.value};
        };
        std::int64_t sum = times(acting, 0, state.input, 16);
        if (state.increments != 0) {
            sum -= times(round_shift(state.output, state.output_shift).value, 0, state.constant, 17);
        }
        for (std::uint32_t i = 0; i < state.tables; ++i) {
            const std::int32_t past = K::step(state.sums[i], state.newest);
            sum -= times(past, state.sums[i].scale.output_exponent, state.factor[i], i);
        }
        const Rounded stored = round_shift(sum, 0);
        state.saturations += stored.saturated ? 1U : 0U;
        state.newest = stored.value;
        state.output = state.increments != 0 ? state.output + stored.value : stored.value;
    } else {
        Sample sum = acting * state.input;
        if (state.increments != 0) {
            sum -= state.constant * state.output;
        }
        for (std::uint32_t i = 0; i < state.tables; ++i) {
            sum -= state.factor[i] * K::step(state.sums[i], state.newest);
        }
        state.newest = sum;
        state.output = state.increments != 0 ? state.output + sum : sum;
    }
    return state.output;
}

template class Stepper<Sum<Ring, Plain, F32>>;
template class Stepper<Sum<Ring, Oldest, F32>>;
template class Stepper<Sum<Mirror, Multi, F32>>;
template class Stepper<Sum<Mirror, MultiFma, F32>>;
template class Stepper<Sum<Ring, Plain, Q31>>;
template class Stepper<Sum<Ring, Oldest, F64>>;

}  // namespace glsum
