// The bodies of windows as the sums to come. Included by sum.cpp alone.
#pragma once

#include "glsum/transposed/transposed_sum.hpp"
#include "glsum/window/window_body.hpp"

namespace glsum {

template <class Technique, class Format>
Status Sum<Transposed, Technique, Format>::prepare(State& state, const Design& design, std::span<Coefficient> table,
                                                   std::span<Sample> past) {
    return Inner::prepare(state, design, table, past);
}

template <class Technique, class Format>
void Sum<Transposed, Technique, Format>::reset(State& state) {
    Inner::reset(state);
}

template <class Technique, class Format>
void Sum<Transposed, Technique, Format>::settle(State& state, Sample newest) {
    const std::size_t past = state.past_samples;
    if (past == 0) {
        return;
    }
    std::uint32_t head = state.head;
    Sample* waiting = state.past;
    // C99: transposed settle
    GLSUM_KEEP_WORD(waiting);
    const Coefficient* a = state.table;
    Sample* to = waiting + head + 1;
    const Sample* end = waiting + past;
    for (std::size_t piece = 0; piece < 2; ++piece) {
        for (; end - to >= 8; to += 8) {
            // Of a group all are loaded before the first product: none waits for its own load.
            Sample s[8];
            Coefficient c[8];
            GLSUM_UNROLLED
            for (std::size_t q = 0; q < 8; ++q) {
                s[q] = to[q];
                c[q] = a[q];
            }
            GLSUM_UNROLLED
            for (std::size_t q = 0; q < 8; ++q) {
                s[q] = Format::multiply_add(s[q], c[q], newest);
            }
            GLSUM_UNROLLED
            for (std::size_t q = 0; q < 8; ++q) {
                to[q] = s[q];
            }
            a += 8;
        }
        for (; to < end; ++to) {
            *to = Format::multiply_add(*to, *a++, newest);
        }
        to = waiting;
        end = waiting + head;
    }
    waiting[head] = Format::multiply_add(Format::zero(), *a, newest);
    head = head + 1 == past ? 0 : head + 1;
    state.head = head;
    // C99 end
}

template <class Technique, class Format>
auto Sum<Transposed, Technique, Format>::answer(State& state, Sample newest) -> Output {
    if (state.past_samples == 0) {
        return Format::finish(Format::start(newest, state.scale), state.scale);
    }
    const std::uint32_t head = state.head;
    // C99: transposed
    Sample* waiting = state.past;
    const Sample sum = Format::start(newest, state.scale) + waiting[head];
    // C99 end
    return Format::finish(sum, state.scale);
}

template <class Technique, class Format>
auto Sum<Transposed, Technique, Format>::step(State& state, Sample newest) -> Output {
    const Output output = answer(state, newest);
    settle(state, newest);
    return output;
}

}  // namespace glsum
