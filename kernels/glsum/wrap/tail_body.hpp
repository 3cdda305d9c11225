// The bodies of windows with a guess of what they dropped. Included by sum.cpp alone.
#pragma once

#include "glsum/design_range.hpp"
#include "glsum/window/window_body.hpp"
#include "glsum/wrap/tail_sum.hpp"

namespace glsum {

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

}  // namespace glsum
