// The bodies of sums over growing blocks. Included by sum.cpp alone.
#pragma once

#include "glsum/design_range.hpp"
#include "glsum/logmemory/block_weights.hpp"
#include "glsum/logmemory/nested_sum.hpp"
#include "glsum/window/ring.hpp"

namespace glsum {

// u(k) of the level above, from two of the level below; in fixed point both are means.
template <class Format>
typename Format::Sample together(typename Format::Sample one, typename Format::Sample other) {
    if constexpr (Format::fixed_point) {
        // C99: together fixed
        return (one | other) - ((one ^ other) >> 1);  // (one + other) / 2, halves up, without its carry
        // C99 end
    } else {
        // C99: together
        return one + other;
        // C99 end
    }
}

// By `far` words on in a ring, far <= size. Without a branch: how often it wraps must not show.
inline std::size_t around(std::size_t at, std::size_t far, std::size_t size) {
    // C99: around
    const std::size_t next = at + far;
    return next >= size ? next - size : next;
    // C99 end
}

template <class Technique, class Format>
Status Sum<Nested, Technique, Format>::prepare(State& state, const Design& design, std::span<Coefficient> table,
                                               std::span<Sample> past) {
    if (const Status status = order_and_taps_in_range(design); status != Status::ok) {
        return status;
    }
    if (design.blocks.count > 0 && reach_of(design) > most_reach) {
        return Status::blocks_out_of_range;
    }
    if (const Status status =
            buffers_in_range(design, table.size(), table_count(design), past.size(), past_count(design));
        status != Status::ok) {
        return status;
    }
    if (!weights_in_range<Technique, Format>(design, reach_of(design) - 1)) {
        return Status::weights_out_of_range;
    }
    const std::size_t near_samples = design.taps - 1 - design.blocks.count;
    const auto for_each_coefficient = [&](auto visit) {
        Weights weights(design);
        for (std::size_t j = 1; j <= near_samples; ++j) {
            weights.next();
            visit(weights.weight());
        }
        BlockWeights blocks(design.blocks, weights);
        for (std::size_t b = 0; b < design.blocks.count; ++b) {
            blocks.next();
            visit(Format::fixed_point ? blocks.sum() : blocks.mean());
        }
    };
    typename Format::Scale scale = {};
    if constexpr (Format::fixed_point) {
        if (const Status status = Format::template choose_scale_of<64>(for_each_coefficient, scale);
            status != Status::ok) {
            return status;
        }
    }
    Coefficient* next = table.data();
    for_each_coefficient([&](double real) { *next++ = Format::coefficient(real, scale); });
    state = {table.data(),
             past.data(),
             static_cast<std::uint32_t>(past_count(design)),
             0,
             static_cast<std::uint32_t>(near_samples),
             static_cast<std::uint32_t>(design.blocks.count),
             static_cast<std::uint32_t>(design.blocks.per_level),
             scale};
    reset(state);
    return Status::ok;
}

template <class Technique, class Format>
void Sum<Nested, Technique, Format>::reset(State& state) {
    for (std::size_t i = 0; i < state.past_samples; ++i) {
        state.past[i] = 0;
    }
    state.head = 0;
    if constexpr (Format::fixed_point) {
        state.scale.saturations = 0;
    }
}

template <class Technique, class Format>
auto Sum<Nested, Technique, Format>::step(State& state, Sample newest) -> Output {
    const std::size_t size = state.past_samples;
    const std::size_t near_samples = state.near_samples;
    Sample* const past = state.past;
    // C99: nested window
    const Sample* const newer = past + state.head;
    const std::size_t newer_count = std::min<std::size_t>(near_samples, size - state.head);
    const Sample* const older = past;
    const std::size_t older_count = near_samples - newer_count;
    // C99 end
    auto sum =
        Plain::sum<Format>(state.table, {newer, newer_count, older, older_count, state.head}, newest, state.scale);
    if (std::uint32_t left = state.blocks; left != 0) {
        const Coefficient* weight = state.table + near_samples;
        const std::uint32_t per_level = state.per_level;
        // C99: nested
        std::size_t at = around(state.head, near_samples, size);  // x_(k-K)
        std::size_t width = 1;
        for (;;) {
            const Sample younger = past[at];
            at = around(at, width, size);
            const Sample block = together<Format>(younger, past[at]);
            past[at] = block;  // what the level below has dropped is the place of this one's newest
            sum = Format::multiply_add(sum, *weight++, block);
            width *= 2;
            // C99: nested others
            GLSUM_UNROLLED
            for (std::uint32_t others = std::min(left, per_level) - 1; others != 0; --others) {
                at = around(at, width, size);
                sum = Format::multiply_add(sum, *weight++, past[at]);
            }
            // C99: nested on
            if (left <= per_level) {
                break;
            }
            left -= per_level;
            at = around(at, width, size);
        }
        // C99 end
    }
    Ring::template push<Sample>(past, size, state.head, newest);
    return Format::finish(sum, state.scale);
}

}  // namespace glsum
