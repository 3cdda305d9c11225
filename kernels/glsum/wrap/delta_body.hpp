// The bodies of sums of increments. Included by sum.cpp alone.
#pragma once

#include "glsum/design_range.hpp"
#include "glsum/exponentials/modes_body.hpp"
#include "glsum/filter/cascade_body.hpp"
#include "glsum/window/window_body.hpp"
#include "glsum/wrap/delta_sum.hpp"

namespace glsum {

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
    // C99: increment
    Sample increment;
    // C99 end
    if constexpr (Format::fixed_point) {
        static_assert(Format::sample_bits == 31);
        // C99: increment fixed
        const Rounded difference = saturate(static_cast<std::int64_t>(newest) - state.before);
        increment = difference.value;
        state.scale.saturations += difference.saturated ? 1U : 0U;
        // C99 end
    } else {
        // C99: increment floating
        increment = newest - state.before;
        // C99 end
    }
    // C99: increment kept
    state.before = newest;
    // C99 end
    return Inner::step(state, increment);
}

}  // namespace glsum
