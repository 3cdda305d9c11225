// The bodies of windows summed for four outputs at once. Included by sum.cpp alone.
#pragma once

#include "glsum/design_range.hpp"
#include "glsum/lookahead/block_sum.hpp"

namespace glsum {

// All loads before the first product. On a Cortex-M7 a fused product holds off the loads behind it for three cycles:
// once a turn, not once a load.
[[gnu::always_inline]] inline void load_all(float (&c)[11], float (&x)[8], float (&s)[4]) {
#if defined(GLSUM_M7_FLOATS)
    // C99: load all
    __asm__ volatile(""
                     : "+t"(c[0]), "+t"(c[1]), "+t"(c[2]), "+t"(c[3]), "+t"(c[4]), "+t"(c[5]), "+t"(c[6]), "+t"(c[7]),
                       "+t"(c[8]), "+t"(c[9]), "+t"(c[10]));
    __asm__ volatile(""
                     : "+t"(x[0]), "+t"(x[1]), "+t"(x[2]), "+t"(x[3]), "+t"(x[4]), "+t"(x[5]), "+t"(x[6]), "+t"(x[7]),
                       "+t"(s[0]), "+t"(s[1]), "+t"(s[2]), "+t"(s[3]));
    // C99 end
#else
    (void)c;
    (void)x;
    (void)s;
#endif
}

template <class Technique, class Format>
Status Sum<Block, Technique, Format>::prepare(State& state, const Design& design, std::span<Coefficient> table,
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
    Technique::template fill<Format>(table.data(), past_samples, design, scale);
    for (std::size_t i = past_samples; i < table_count(design.taps); ++i) {
        table[i] = 0;
    }
    state = {};
    state.table = table.data();
    state.past = past.data();
    state.past_samples = static_cast<std::uint32_t>(past_samples);
    state.groups = static_cast<std::uint32_t>(Block::groups(past_samples));
    state.scale = scale;
    reset(state);
    return Status::ok;
}

template <class Technique, class Format>
void Sum<Block, Technique, Format>::reset(State& state) {
    for (std::size_t i = 0; i < phases * state.groups; ++i) {
        state.past[i] = 0;
    }
    for (std::size_t q = 0; q < phases; ++q) {
        state.ready[q] = Format::zero();
        state.coming[q] = Format::zero();
    }
    state.own = 0;
    state.phase = 0;
    state.left = state.groups;
    if constexpr (Format::fixed_point) {
        state.scale.saturations = 0;
    }
}

// Adds to the sums of neighbouring outputs their products with so many groups in turn, from `samples` on. a: of the
// first output the place behind the coefficient of the first sample; it falls by four from group to group. kept: the
// last of the coefficients are in c already.
template <class Technique, class Format>
template <std::size_t outputs, std::size_t groups, std::size_t kept>
void Sum<Block, Technique, Format>::add_groups(Accumulator (&s)[outputs],
                                               Coefficient (&c)[phases * groups - 1 + outputs], const Coefficient* a,
                                               const Sample* samples) {
    constexpr std::size_t count = phases * groups;
    // C99: groups
    // Of output q and sample r: lag q - r behind that of the first.
    GLSUM_UNROLLED
    for (std::size_t i = 0; i < count - 1 + outputs - kept; ++i) {
        c[i] = *(a - count + i);
    }
    Sample x[count];
    GLSUM_UNROLLED
    for (std::size_t r = 0; r < count; ++r) {
        x[r] = samples[r];
    }
    // C99 end
    if constexpr (fused && groups == 2) {
        load_all(c, x, s);
    }
    // C99: groups added
    GLSUM_UNROLLED
    for (std::size_t r = 0; r < count; ++r) {
        GLSUM_UNROLLED
        for (std::size_t q = 0; q < outputs; ++q) {
            s[q] = accumulate<Format, fused>(s[q], c[count - 1 + q - r], x[r]);
        }
    }
    // C99 end
}

template <class Technique, class Format>
template <std::size_t outputs>
void Sum<Block, Technique, Format>::add_share(Accumulator* sums, const Coefficient* a, const Sample* samples,
                                              std::size_t count) {
    // C99: share
    Accumulator s[outputs];
    GLSUM_UNROLLED
    for (std::size_t q = 0; q < outputs; ++q) {
        s[q] = sums[q];
    }
    Coefficient c[phases - 1 + outputs];
    // C99 end
    if constexpr (Format::fixed_point) {
        // C99: share fixed
        // What the next group has too is kept: a move beside a product costs nothing.
        GLSUM_UNROLLED
        for (std::size_t i = 0; i < outputs - 1; ++i) {
            c[phases + i] = a[i];
        }
        for (; count != 0; --count) {
            add_groups<outputs, 1, outputs - 1>(s, c, a, samples);
            GLSUM_UNROLLED
            for (std::size_t i = outputs - 1; i > 0; --i) {
                c[phases + i - 1] = c[i - 1];
            }
            a -= phases;
            samples += phases;
        }
        // C99 end
    } else {
        // C99: share floating
        // It is loaded again: a move is a floating-point operation more, a load goes beside one.
        if (count % 2 != 0) {
            add_groups<outputs, 1, 0>(s, c, a, samples);
            a -= phases;
            samples += phases;
        }
        Coefficient of_two[2 * phases - 1 + outputs];
        for (std::size_t turns = count / 2; turns != 0; --turns) {
            add_groups<outputs, 2, 0>(s, of_two, a, samples);
            a -= 2 * phases;
            samples += 2 * phases;
        }
        // C99 end
    }
    // C99: share kept
    GLSUM_UNROLLED
    for (std::size_t q = 0; q < outputs; ++q) {
        sums[q] = s[q];
    }
    // C99 end
}

template <class Technique, class Format>
auto Sum<Block, Technique, Format>::sum_of(const State& state, Sample newest) -> Accumulator {
    if (state.groups == 0) {
        return Format::start(newest, state.scale);
    }
    const std::size_t phase = state.phase;
    // C99: block
    const Sample* const own = state.past + phases * state.own;
    Accumulator sum = state.ready[phase];
    const Coefficient* a = state.table + phase;
    for (std::size_t i = 0; i < phase; ++i) {
        sum = accumulate<Format, fused>(sum, *--a, own[i]);
    }
    // C99: block closing
    sum = Format::start(newest, state.scale) + sum;
    // C99 end
    return sum;
}

template <class Technique, class Format>
void Sum<Block, Technique, Format>::advance(State& state, Sample newest) {
    const std::size_t groups = state.groups;
    if (groups == 0) {
        return;
    }
    const std::size_t phase = state.phase;
    constexpr std::size_t outputs = Format::fixed_point ? 2 : phases;  // registers
    // C99: block ahead
    state.past[phases * state.own + phase] = newest;
    // Its share of the groups that the next four outputs lack, the oldest first, in at most two pieces of the ring.
    std::size_t share = (groups + phase) / phases;
    while (share != 0) {
        const std::size_t left = state.left;
        std::size_t from = state.own + 1 + groups - left;
        from = from >= groups ? from - groups : from;
        const std::size_t count = std::min(share, groups - from);
        const Coefficient* const first = state.table + phases * left;
        const Sample* const samples = state.past + phases * from;
        for (std::size_t q = 0; q < phases; q += outputs) {
            add_share<outputs>(state.coming + q, first + q, samples, count);
        }
        state.left = static_cast<std::uint32_t>(left - count);
        share -= count;
    }
    if (phase + 1 != phases) {
        state.phase = static_cast<std::uint32_t>(phase + 1);
    } else {
        GLSUM_UNROLLED
        for (std::size_t q = 0; q < phases; ++q) {
            state.ready[q] = state.coming[q];
            state.coming[q] = Format::zero();
        }
        state.phase = 0;
        state.left = state.groups;
        state.own = state.own + 1 == groups ? 0 : state.own + 1;
    }
    // C99 end
}

template <class Technique, class Format>
GLSUM_FUSED_CLONES auto Sum<Block, Technique, Format>::sum_of_fused(const State& state, Sample newest) -> Accumulator {
    return sum_of(state, newest);
}
template <class Technique, class Format>
GLSUM_FUSED_CLONES void Sum<Block, Technique, Format>::advance_fused(State& state, Sample newest) {
    advance(state, newest);
}
template <class Technique, class Format>
GLSUM_FUSED_CLONES auto Sum<Block, Technique, Format>::step_fused(State& state, Sample newest) -> Output {
    const Accumulator sum = sum_of(state, newest);
    advance(state, newest);
    return Format::finish(sum, state.scale);
}

template <class Technique, class Format>
auto Sum<Block, Technique, Format>::answer(State& state, Sample newest) -> Output {
    if constexpr (fused) {
        return Format::finish(sum_of_fused(state, newest), state.scale);
    } else {
        return Format::finish(sum_of(state, newest), state.scale);
    }
}

template <class Technique, class Format>
void Sum<Block, Technique, Format>::settle(State& state, Sample newest) {
    if constexpr (fused) {
        advance_fused(state, newest);
    } else {
        advance(state, newest);
    }
}

template <class Technique, class Format>
auto Sum<Block, Technique, Format>::step(State& state, Sample newest) -> Output {
    if constexpr (fused) {
        return step_fused(state, newest);
    } else {
        const Accumulator sum = sum_of(state, newest);
        advance(state, newest);
        return Format::finish(sum, state.scale);
    }
}

}  // namespace glsum
