// The bodies of sums over a window. Included by sum.cpp alone.
#pragma once

#include "glsum/design_range.hpp"
#include "glsum/window/window_sum.hpp"

namespace glsum {

template <class History, class Technique, class Format>
Status Sum<History, Technique, Format>::prepare(State& state, const Design& design, std::span<Coefficient> table,
                                                std::span<Sample> past) {
    if (const Status status = window_in_range<Sum, Technique, Format>(design, table.size(), past.size());
        status != Status::ok) {
        return status;
    }
    typename Format::Scale scale;
    if (const Status status = Technique::template choose_scale<Format>(design, scale); status != Status::ok) {
        return status;
    }
    const std::size_t past_samples = design.taps - 1;
    Coefficient* const placed = Technique::placed(table.data());
    Technique::template fill<Format>(placed, past_samples, design, scale);
    state = {placed, past.data(), static_cast<std::uint32_t>(past_samples), 0, scale};
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
    } else if constexpr (Technique::template beside<Format> != 0) {
        const std::size_t held = Technique::template held<Format>(state.past_samples);
        const auto window = History::template window<Sample>(state.past, held, state.head);
        const auto sum =
            Technique::template sum_beside<Format>(state.table, window, newest, state.past + History::past_count(held));
        History::template push<Sample>(state.past, held, state.head, newest);
        History::template forget<Sample>(state.past, held, state.head, state.past_samples);
        return Format::finish(sum, state.scale);
    } else {
        const auto window = History::template window<Sample>(state.past, state.past_samples, state.head);
        const auto sum = Technique::template sum<Format>(state.table, window, newest, state.scale);
        History::template push<Sample>(state.past, state.past_samples, state.head, newest);
        return Format::finish(sum, state.scale);
    }
}

}  // namespace glsum
