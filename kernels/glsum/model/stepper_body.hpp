// What a step of a model does around its sums, in floating point. Included by stepper.cpp alone; what stands behind
// "C99" is also what a generated header holds (glsum/c99.hpp).
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

}  // namespace glsum
