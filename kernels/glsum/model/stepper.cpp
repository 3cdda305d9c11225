#include "glsum/model/stepper.hpp"

#include "glsum/model/stepper_body.hpp"

namespace glsum {
namespace {

constexpr double magnitude(double real) { return real < 0.0 ? -real : real; }

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
    for (std::size_t i = 0; i < design.tables.size(); ++i) {
        const PastTable& past_table = design.tables[i];
        if (const Status status = K::prepare(state.sums[i], past_table.design(), table, past); status != Status::ok) {
            return status;
        }
        table = table.subspan(table_count(past_table));
        past = past.subspan(past_count(past_table));
        state.factor[i] = factor(past_table.factor, static_cast<unsigned>(i));
    }
    const double input = design.input * (design.half_input && !fixed ? 0.5 : 1.0);
    state.input = factor(input * (fixed ? design.input_full_scale / design.stored_full_scale : 1.0), 16);
    state.constant = factor(design.constant * (fixed ? design.output_full_scale / design.stored_full_scale : 1.0), 17);
    int shift = 0;  // from units of x to those of y
    while (fixed && power_of_two(shift) * design.stored_full_scale < design.output_full_scale && shift < 32) {
        ++shift;
    }
    state.output_shift = shift;
    state.tables = static_cast<std::uint32_t>(design.tables.size());
    state.increments = design.increments ? 1 : 0;
    state.half_input = design.half_input ? 1 : 0;
    state.saturations = 0;
    state.output = 0;
    state.lost = 0;
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
    const Sample acting = exchange(state, input);
    if constexpr (fixed) {
        return step_fixed<K>(state, state.half_input != 0 ? mean_with_next(state, acting) : acting);
    } else {
        return step_floating<K>(state, state.half_input != 0 ? with_next(state, acting) : acting);
    }
}

template class Stepper<Sum<Ring, Plain, F32>>;
template class Stepper<Sum<Ring, Oldest, F32>>;
template class Stepper<Sum<Mirror, Multi, F32>>;
template class Stepper<Sum<Mirror, MultiFma, F32>>;
template class Stepper<Sum<Ring, Plain, Q31>>;
template class Stepper<Sum<Ring, Oldest, F64>>;
template class Stepper<Sum<Modes, Plain, F32>>;
template class Stepper<Sum<Modes, Compensated, F32>>;
template class Stepper<Sum<Modes, Plain, Q31>>;

}  // namespace glsum
