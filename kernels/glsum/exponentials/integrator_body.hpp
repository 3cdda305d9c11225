// The bodies of sums with an integrator. Included by sum.cpp alone.
#pragma once

#include "glsum/design_range.hpp"
#include "glsum/exponentials/integrator_sum.hpp"
#include "glsum/exponentials/modes_body.hpp"

namespace glsum {

template <class Technique, class Format>
Status Sum<Integrator, Technique, Format>::prepare(State& state, const Design& design, std::span<Coefficient> table,
                                                   std::span<Sample> past) {
    if (const Status status = order_and_taps_in_range(design); status != Status::ok) {
        return status;
    }
    if (design.modes.size() > (design.taps - 1) / 2) {
        return Status::modes_out_of_range;
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
void Sum<Integrator, Technique, Format>::reset(State& state) {
    Inner::reset(state);
    state.total = 0;
    state.lost = 0;
}

template <class Technique, class Format>
[[gnu::flatten]] auto Sum<Integrator, Technique, Format>::step(State& state, Sample newest) -> Output {
    const Sample leaving = state.near_samples != 0 ? state.past[state.near_samples - 1] : newest;
    // C99: integrator
    const Sample total = state.total;
    const Sample lost = state.lost;
    const Sample after = total + leaving;
    const Sample leaving_part = after - total;
    state.total = after;
    state.lost = lost + ((total - (after - leaving_part)) + (leaving - leaving_part));
    // C99 end
    auto sum = Inner::step(state, newest);
    // C99: integrator closing
    sum = Format::multiply_add(sum, state.weight, total + lost);
    // C99 end
    return sum;
}

}  // namespace glsum
