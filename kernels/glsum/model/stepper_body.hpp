// What a step of a model does around its sums, in floating and in fixed point. Included by stepper.cpp alone; what
// stands behind "C99" is also what a generated header holds (glsum/c99.hpp).
#pragma once

#include <cstdint>
#include <type_traits>

#include "glsum/c99.hpp"
#include "glsum/model/stepper.hpp"

namespace glsum {

// Most models have one table: the branch of a loop over it would point backward and never be taken, which branch
// predictors guess wrong at each step.
template <class State, class Visit>
[[gnu::always_inline]] inline void for_each_table(const State& state, Visit visit) {
    if (state.tables != 0) {
        visit(0);
    }
    if (state.tables > 1) [[unlikely]] {
        for (std::uint32_t i = 1; i < state.tables; ++i) {
            visit(i);
        }
    }
}

// The input that acts now, for the one that begins to wait.
template <class State, class Sample>
[[gnu::always_inline]] inline Sample exchange(State& state, Sample input) {
    // C99: model input
    Sample acting = state.line[state.line_at];
    state.line[state.line_at] = input;
    state.line_at = state.line_at + 1 == state.line_length ? 0 : state.line_at + 1;
    // C99 end
    return acting;
}

// Of second order both inputs act; the half of them is the factor's.
template <class State, class Sample>
[[gnu::always_inline]] inline Sample with_next(const State& state, Sample acting) {
    // C99: model half input
    acting += state.line[state.line_at];
    // C99 end
    return acting;
}

// Their mean, rounded down, as their sum need not fit.
template <class State, class Sample>
[[gnu::always_inline]] inline Sample mean_with_next(const State& state, Sample acting) {
    // C99: model half input fixed
    acting = static_cast<Sample>((static_cast<std::int64_t>(acting) + state.line[state.line_at]) >> 1);
    // C99 end
    return acting;
}

template <class K, class State>
[[gnu::always_inline]] inline typename K::Sample step_floating(State& state, typename K::Sample acting) {
    using Sample = typename K::Sample;
    // C99: model forcing
    Sample sum = acting * state.input;
    GLSUM_KEEP(sum);
    // C99 end
    if (state.increments != 0) {
        // C99: model constant
        Sample held = state.constant * state.output;
        GLSUM_KEEP(held);
        sum -= held;
        // C99 end
    }
    for_each_table(state, [&](std::uint32_t i) {
        const Sample factor = state.factor[i];
        const Sample past = K::step(state.sums[i], state.newest);
        // C99: model past
        Sample passed = factor * past;
        GLSUM_KEEP(passed);
        sum -= passed;
        // C99 end
    });
    state.newest = sum;
    if (state.increments == 0) {
        state.output = sum;
    } else if constexpr (std::is_same_v<typename K::TechniquePart, Compensated>) {
        // C99: model output compensated
        const Sample before = state.output;
        const Sample added = sum + state.lost;
        state.output = before + added;
        state.lost = added - (state.output - before);
        // C99 end
    } else {
        // C99: model output
        state.output += sum;
        // C99 end
    }
    return state.output;
}

// A factor's product in units of the increments. \param exponent  integer bits of the value \param bit  of its sign
template <class State>
inline std::int64_t times(State& state, std::int32_t value, int exponent, const Gain& gain, unsigned bit) {
    const std::int32_t mantissa = gain.mantissa;
    const int shift = gain_shift(gain, exponent, 0);
    // C99: model times
    const Rounded product = round_shift(static_cast<std::int64_t>(value) * mantissa, shift);
    state.saturations += product.saturated ? 1U : 0U;
    // C99 end
    const bool negative = (state.negative >> bit & 1U) != 0;
    // C99: model times signed
    return negative ? -static_cast<std::int64_t>(product.value) : static_cast<std::int64_t>(product.value);
    // C99 end
}

template <class K, class State>
[[gnu::always_inline]] inline std::int64_t step_fixed(State& state, std::int32_t acting) {
    // C99: model forcing fixed
    std::int64_t sum = times(state, acting, 0, state.input, 16);
    // C99 end
    if (state.increments != 0) {
        // C99: model constant fixed
        const Rounded held = round_shift(state.output, state.output_shift);
        sum -= times(state, held.value, 0, state.constant, 17);
        // C99 end
    }
    for_each_table(state, [&](std::uint32_t i) {
        const std::int32_t past = K::step(state.sums[i], state.newest);
        // C99: model past fixed
        sum -= times(state, past, state.sums[i].scale.output_exponent, state.factor[i], i);
        // C99 end
    });
    // C99: model stored fixed
    const Rounded stored = round_shift(sum, 0);
    state.saturations += stored.saturated ? 1U : 0U;
    state.newest = stored.value;
    // C99 end
    if (state.increments == 0) {
        state.output = 0;
    }
    // C99: model output fixed
    state.output += stored.value;
    // C99 end
    return state.output;
}

}  // namespace glsum
