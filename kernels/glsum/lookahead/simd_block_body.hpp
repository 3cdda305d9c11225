// The bodies of windows summed for eight outputs at once on the host's vector unit. Included by sum.cpp alone.
#pragma once

#include "glsum/design_range.hpp"
#include "glsum/lookahead/simd_block_sum.hpp"

namespace glsum {

template <class Technique, class Format>
Status Sum<HostBlock, Technique, Format>::prepare(State& state, const Design& design, std::span<Coefficient> table,
                                                  std::span<Sample> past) {
    if (const Status status = window_in_range<Sum, Technique, Format>(design, table.size(), past.size());
        status != Status::ok) {
        return status;
    }
    const std::size_t past_samples = design.taps - 1;
    for (std::size_t i = 0; i < table_count(design.taps); ++i) {
        table[i] = 0;
    }
    Coefficient* const window = table.data() + entering_count;
    const bool tables = has_tables(design.taps);
    const std::size_t lag = tables ? padded(design.taps) : 1;
    Weights weights(design);
    for (std::size_t j = 1; j <= past_samples; ++j) {
        weights.next();
        const auto weight = static_cast<Coefficient>(weights.weight());
        if (j < simd_block_samples) {
            table[simd_block_samples - 1 + j] = weight;
        }
        for (std::size_t q = 0; q < (tables ? simd_block_samples : 1) && q < j; ++q) {
            window[q * lag + j - 1 - (tables ? q : 0)] = weight;
        }
    }
    state = {{.entering = table.data(),
              .window = window,
              .lag = lag,
              .vectors = padded(design.taps) / lanes,
              .pending = past.data(),
              .past = past.data() + lanes,
              .size = static_cast<std::uint32_t>(ring_size(design.taps)),
              .head = 0},
             {}};
    reset(state);
    return Status::ok;
}

template <class Technique, class Format>
void Sum<HostBlock, Technique, Format>::reset(State& state) {
    if (state.size != 0) {
        Sample* const end = state.past + 2 * std::size_t{state.size} + lanes;
        for (Sample* sample = state.pending; sample != end; ++sample) {
            *sample = 0;
        }
    }
    state.head = 0;
}

template <class Technique, class Format>
auto Sum<HostBlock, Technique, Format>::step(State& state, Sample newest) -> Output {
    if constexpr (fused) {
        return simd_block_step_fused(state, newest);
    } else {
        return simd_block_step(state, newest);
    }
}

}  // namespace glsum
