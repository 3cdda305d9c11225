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
    const std::size_t past = state.past_samples;
    const Sample* const newer = window.newer;
    // C99: guess
    const std::uint32_t k = state.count;
    const bool dropped = k > past;
    if (dropped && k != last_count) {
        // C99 end
        if constexpr (to_first) {
            // C99: guess mean
            const Coefficient from_mean = state.tail.value - state.line.mean.value;
            state.line.mean.add(from_mean / static_cast<Coefficient>(k - past));
            // C99 end
        }
        // C99: guess weight
        state.tail.add((state.in_window + state.tail.value) * state.minus_order / static_cast<Coefficient>(k));
    }
    if (dropped) {
        const Sample oldest = past == 0 ? newest : newer[past - 1];
        // C99 end
        if constexpr (to_first) {
            // C99: guess line
            const Coefficient mean = state.line.mean.value;
            sum = Format::multiply_add(sum, mean, oldest);
            sum = Format::multiply_add(sum, state.tail.value - mean, state.line.first);
            // C99 end
        } else {
            // C99: guess hold
            sum = Format::multiply_add(sum, state.tail.value, oldest);
            // C99 end
        }
    }
    if constexpr (to_first) {
        // C99: guess first
        state.line.first = k == 0 ? newest : state.line.first;
        // C99 end
    }
    // C99: guess count
    state.count = k == last_count ? k : k + 1;
    // C99 end
    Mirror::template push<Sample>(state.past, state.past_samples, state.head, newest);
    return Format::finish(sum, state.scale);
}

}  // namespace glsum
