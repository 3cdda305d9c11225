// The bodies of sums by decaying averages. Included by sum.cpp alone.
#pragma once

#include "glsum/design_range.hpp"
#include "glsum/exponentials/fixed_decay.hpp"
#include "glsum/exponentials/modes_sum.hpp"
#include "glsum/format/fixed.hpp"

namespace glsum {

template <class Technique, class Format>
Status Sum<Modes, Technique, Format>::prepare(State& state, const Design& design, std::span<Coefficient> table,
                                              std::span<Sample> past) {
    if (const Status status = order_and_taps_in_range(design); status != Status::ok) {
        return status;
    }
    const std::size_t modes = design.modes.size();
    if (modes > (design.taps - 1) / 2) {
        return Status::modes_out_of_range;
    }
    if (!weights_in_range<Technique, Format>(design, design.taps - 1 - 2 * modes)) {
        return Status::weights_out_of_range;
    }
    for (const Mode& mode : design.modes) {
        constexpr bool may_swing = !Format::fixed_point;
        if (!(mode.decay > 0.0 && (may_swing ? mode.decay < 2.0 : mode.decay <= 1.0)) ||
            !is_magnitude_at_most(mode.weight, std::numeric_limits<double>::max())) {
            return Status::modes_out_of_range;
        }
        const double gain = mode.weight / mode.decay;
        if constexpr (Format::fixed_point) {
            if (to_fixed(mode.decay).mantissa < 1 << 29) {
                return Status::format_too_narrow;
            }
        } else if (!(static_cast<Coefficient>(mode.decay) > 0 && static_cast<Coefficient>(mode.decay) < 2) ||
                   !is_magnitude_at_most(gain, std::numeric_limits<Coefficient>::max())) {
            return Status::format_too_narrow;
        }
    }
    if (const Status status = buffers_in_range(design, table.size(), table_count(design.taps, modes), past.size(),
                                               past_count(design.taps, modes));
        status != Status::ok) {
        return status;
    }
    const std::size_t near_samples = design.taps - 1 - 2 * modes;
    typename Format::Scale scale = {};
    if constexpr (Format::fixed_point) {
        const auto for_each_coefficient = [&](auto visit) {
            Weights weights(design);
            for (std::size_t j = 1; j <= near_samples; ++j) {
                weights.next();
                visit(weights.weight());
            }
            for (const Mode& mode : design.modes) {
                visit(mode.weight / mode.decay);
            }
        };
        if (const Status status = Format::template choose_scale_of<64>(for_each_coefficient, scale);
            status != Status::ok) {
            return status;
        }
    }
    Plain::fill<Format>(table.data(), near_samples, design, scale);
    Coefficient* of_mode = table.data() + near_samples;
    for (std::size_t m = modes; m > 0; --m) {
        const Mode& mode = design.modes[m - 1];
        if constexpr (Format::fixed_point) {
            const FixedDecay decay = to_fixed(mode.decay);
            of_mode[0] = decay.mantissa;
            of_mode[1] = decay.shift;
        } else {
            of_mode[0] = static_cast<Coefficient>(mode.decay);
        }
        of_mode[coefficients_of_mode - 1] = Format::coefficient(mode.weight / mode.decay, scale);
        of_mode += coefficients_of_mode;
    }
    state = {table.data(), past.data(), static_cast<std::uint32_t>(near_samples), static_cast<std::uint32_t>(modes),
             scale};
    reset(state);
    return Status::ok;
}

template <class Technique, class Format>
void Sum<Modes, Technique, Format>::reset(State& state) {
    const std::size_t count = state.near_samples + words_of_mode * state.modes;
    for (std::size_t i = 0; i < count; ++i) {
        state.past[i] = 0;
    }
    if constexpr (Format::fixed_point) {
        state.scale.saturations = 0;
    }
}

// s + d (x - s), with what the step lost before and loses now where that is kept.
template <class Technique, class Format>
auto Sum<Modes, Technique, Format>::move(const Coefficient* of_mode, const Sample* average, Sample leaving)
    -> Averaged {
    // C99: mode
    const Sample before = average[0];
    // C99 end
    if constexpr (Format::fixed_point) {
        // C99: mode fixed
        const std::int64_t decay = of_mode[0];
        const std::int64_t step = decay * leaving - decay * before;
        const std::int32_t shift = of_mode[1];
        // In 64 bits: the step alone may leave 32 where the average does not.
        const std::int64_t half = static_cast<std::int64_t>(1) << (shift - 1);
        const Averaged moved = {static_cast<Sample>(before + ((step + half) >> shift)), 0};
        return moved;
        // C99 end
    } else if constexpr (compensated) {
        // C99: mode compensated
        const Sample step = Format::multiply(of_mode[0], leaving - before) + average[1];
        const Sample after = before + step;
        const Averaged moved = {after, step - (after - before)};
        return moved;
        // C99 end
    } else {
        // C99: mode plain
        const Averaged moved = {before + Format::multiply(of_mode[0], leaving - before), 0};
        return moved;
        // C99 end
    }
}

template <class Technique, class Format>
void Sum<Modes, Technique, Format>::keep(Sample* average, const Averaged& moved) {
    // C99: mode kept
    average[0] = moved.average;
    if constexpr (compensated) {
        average[1] = moved.lost;
    }
    // C99 end
}

template <class Technique, class Format>
auto Sum<Modes, Technique, Format>::step(State& state, Sample newest) -> Output {
    const std::size_t near_samples = state.near_samples;
    const Coefficient* table = state.table;
    Sample* const past = state.past;
    auto sum = Format::start(newest, state.scale);
    // What the near taps hold no longer when the next sample comes.
    Sample leaving = newest;
    if (near_samples != 0) {
        for (std::size_t i = 0; i < near_samples; ++i) {
            sum = Format::multiply_add(sum, table[i], past[i]);
        }
        leaving = past[near_samples - 1];
        for (std::size_t i = near_samples - 1; i > 0; --i) {
            past[i] = past[i - 1];
        }
        past[0] = newest;
    }
    table += near_samples;
    Sample* average = past + near_samples;
    const auto one_mode = [&]() __attribute__((always_inline)) {
        // C99: mode one
        const Averaged moved = move(table, average, leaving);
        sum = Format::multiply_add(sum, table[coefficients_of_mode - 1], average[0]);
        keep(average, moved);
        table += coefficients_of_mode;
        average += words_of_mode;
        // C99 end
    };
    if constexpr (Format::fixed_point) {
        for (std::uint32_t left = state.modes; left != 0; --left) {
            one_mode();
        }
    } else {
        // Two at a time: no mode waits for another, and a core that issues in order has something to do between the
        // steps of one. The sum still takes them one after the other.
        const auto two_modes = [&]() __attribute__((always_inline)) {
            // C99: mode two
            const Sample first = average[0];
            const Sample second = average[words_of_mode];
            const Coefficient first_gain = table[coefficients_of_mode - 1];
            const Coefficient second_gain = table[2 * coefficients_of_mode - 1];
            const Averaged one = move(table, average, leaving);
            const Averaged other = move(table + coefficients_of_mode, average + words_of_mode, leaving);
            sum = Format::multiply_add(Format::multiply_add(sum, first_gain, first), second_gain, second);
            keep(average, one);
            keep(average + words_of_mode, other);
            table += 2 * coefficients_of_mode;
            average += 2 * words_of_mode;
            // C99 end
        };
        if (state.modes % 2 != 0) {
            one_mode();
        }
        // Into the middle of eight at a time: the end of a loop over a few modes is a branch that is guessed wrong at
        // each step, a jump to the same place is not.
        std::uint32_t pairs = state.modes / 2;
        if (pairs != 0) {
            switch (pairs % 4) {
                do {
                    case 0:
                        two_modes();
                        [[fallthrough]];
                    case 3:
                        two_modes();
                        [[fallthrough]];
                    case 2:
                        two_modes();
                        [[fallthrough]];
                    case 1:
                        two_modes();
                        pairs = pairs > 4 ? (pairs - 1) / 4 * 4 : 0;
                } while (pairs != 0);
            }
        }
    }
    return Format::finish(sum, state.scale);
}

}  // namespace glsum
