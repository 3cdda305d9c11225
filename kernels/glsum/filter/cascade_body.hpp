// The bodies of cascades. Included by sum.cpp alone.
#pragma once

#include "glsum/design_range.hpp"
#include "glsum/filter/cascade_sum.hpp"
#include "glsum/filter/section_rounding.hpp"
#include "glsum/format/fixed.hpp"
#include "glsum/power_of_two.hpp"
#include "glsum/window/shift.hpp"

namespace glsum {

template <class Technique, class Format>
Status Sum<Cascade, Technique, Format>::prepare(State& state, const Design& design, std::span<Coefficient> table,
                                                std::span<Sample> past) {
    if (const Status status = order_and_taps_in_range(design); status != Status::ok) {
        return status;
    }
    const std::size_t modes = design.modes.size();
    if (modes > (design.taps - 1) / 2) {
        return Status::modes_out_of_range;
    }
    const std::size_t near_samples = design.taps - 1 - 2 * modes;
    if (!weights_in_range<Technique, Format>(design, near_samples)) {
        return Status::weights_out_of_range;
    }
    for (const Mode& mode : design.modes) {
        if (!(mode.decay > 0.0 && (fixed ? mode.decay <= 1.0 : mode.decay < 2.0))) {
            return Status::modes_out_of_range;
        }
    }
    // Before anything that takes as long as the design is: what has no room is refused at once.
    if (const Status status = buffers_in_range(design, table.size(), table_count(design.taps, modes), past.size(),
                                               past_count(design.taps, modes));
        status != Status::ok) {
        return status;
    }
    const double last = last_near_tap(design);
    if (modes != 0 && !Series(design.modes, last).interlaces()) {
        return Status::modes_out_of_range;
    }
    int scale_bits = 0;
    if (!for_each_section<Format>(design, [&](const HeldSection& held, const SectionPlace& place) {
            scale_bits = place.scale_bits;
            return held.is_stable(place.single) && fits_format<Format>(held);
        })) {
        return Status::format_too_narrow;
    }
    typename Format::Scale scale = {};
    const bool alone = near_samples == 0 && modes != 0;  // the cascade is the sum
    // What the cascade's output, at its own scale, is multiplied by.
    const double behind = last * power_of_two(scale_bits);
    if constexpr (fixed) {
        if (alone) {
            scale.output_exponent = static_cast<std::int8_t>(scale_bits);
        } else {
            const auto for_each_coefficient = [&](auto visit) {
                Weights weights(design);
                for (std::size_t j = 1; j < near_samples; ++j) {
                    weights.next();
                    visit(weights.weight());
                }
                if (near_samples != 0) {
                    visit(behind);
                }
            };
            if (const Status status = Format::template choose_scale_of<64>(for_each_coefficient, scale);
                status != Status::ok) {
                return status;
            }
        }
    }
    Technique::template fill<Format>(table.data(), near_samples, design, scale);
    if (near_samples != 0) {
        table[near_samples - 1] = Format::coefficient(behind, scale);
    }
    Coefficient* of_section = table.data() + near_samples;
    (void)for_each_section<Format>(design, [&](const HeldSection& held, const SectionPlace& place) {
        const auto keep = [&](double coefficient, bool kept) {
            if (kept) {
                *of_section++ =
                    static_cast<Coefficient>(fixed ? coefficient * power_of_two(section_bits) : coefficient);
            }
        };
        keep(held.b0, fixed);
        keep(held.b1, true);
        keep(held.b2, fixed || !place.single);
        keep(-held.a1, true);
        keep(-held.a2, fixed || !place.single);
        return true;
    });
    state = {table.data(), past.data(), static_cast<std::uint32_t>(near_samples), static_cast<std::uint32_t>(modes),
             scale};
    reset(state);
    return Status::ok;
}

template <class Technique, class Format>
void Sum<Cascade, Technique, Format>::reset(State& state) {
    const std::size_t count = past_count(state.near_samples + 1 + 2 * state.modes, state.modes);
    for (std::size_t i = 0; i < count; ++i) {
        state.past[i] = 0;
    }
    if constexpr (fixed) {
        state.scale.saturations = 0;
        Sample* kept = state.past + state.near_samples;
        const std::size_t sections = (state.modes + 1) / 2;
        // C99: sections reset
        for (std::size_t s = 0; s < sections; ++s) {
            kept[3 * s + 2] = 1 << 28;  // half a unit: as if what came before had been rounded
        }
        // C99 end
    }
}

template <class Technique, class Format>
auto Sum<Cascade, Technique, Format>::pass(const Coefficient* of_section, const Sample* kept, Sample before) -> Passed {
    // Not by a requirement: clang instantiates with the class what that takes out.
    if constexpr (fixed) {
        return {};
    } else {
        // C99: section
        const Sample of_before = kept[1] + Format::multiply(of_section[0], before);
        const Sample second_of_before = Format::multiply(of_section[1], before);
        const Sample after = before + kept[0];
        const Sample first = of_before + Format::multiply(of_section[2], after);
        const Passed passed = {after, first, second_of_before + Format::multiply(of_section[3], after)};
        return passed;
        // C99 end
    }
}

template <class Technique, class Format>
void Sum<Cascade, Technique, Format>::keep(Sample* kept, const Passed& passed) {
    // C99: section kept
    kept[0] = passed.first;
    kept[1] = passed.second;
    // C99 end
}

template <class Technique, class Format>
auto Sum<Cascade, Technique, Format>::filtered(State& state, Sample entering) -> Sample {
    const Coefficient* of_section = state.table + state.near_samples;
    Sample* kept = state.past + state.near_samples;
    Sample value = entering;
    if constexpr (fixed) {
        const std::uint32_t sections = (state.modes + 1) / 2;
        if (sections != 0) {
            for (std::uint32_t left = sections; left != 0; --left) {
                // C99: section fixed
                std::int64_t sum = static_cast<std::int64_t>(of_section[0]) * value + kept[2];
                sum += static_cast<std::int64_t>(of_section[1]) * kept[0];
                sum += static_cast<std::int64_t>(of_section[2]) * kept[1];
                sum += static_cast<std::int64_t>(of_section[3]) * kept[3];
                sum += static_cast<std::int64_t>(of_section[4]) * kept[4];
                kept[1] = kept[0];
                kept[0] = value;
                kept[2] = static_cast<Sample>(static_cast<std::uint32_t>(sum) & 0x1FFFFFFFU);
                value = static_cast<Sample>(sum >> 29);
                of_section += 5;
                kept += 3;
                // C99 end
            }
            // C99: section fixed last
            kept[1] = kept[0];
            kept[0] = value;
            // C99 end
        }
    } else {
        if (state.modes % 2 != 0) {
            // C99: section single
            const Sample rising = value;
            value = rising + kept[0];
            kept[0] = Format::multiply(of_section[0], rising) + Format::multiply(of_section[1], value);
            of_section += 2;
            kept += 1;
            // C99 end
        }
        // Two at a time, as the modes' loop has it: what is loaded for the second does not wait for the first's stores.
        const auto two_sections = [&]() __attribute__((always_inline)) {
            // C99: section two
            const Passed one = pass(of_section, kept, value);
            const Passed other = pass(of_section + 4, kept + 2, one.value);
            value = other.value;
            keep(kept, one);
            keep(kept + 2, other);
            of_section += 8;
            kept += 4;
            // C99 end
        };
        const std::uint32_t sections = state.modes / 2;
        if (sections % 2 != 0) {
            // C99: section one
            const Passed alone = pass(of_section, kept, value);
            value = alone.value;
            keep(kept, alone);
            of_section += 4;
            kept += 2;
            // C99 end
        }
        // Into the middle of four at a time: see there, too.
        std::uint32_t pairs = sections / 2;
        if (pairs != 0) {
            switch (pairs % 4) {
                do {
                    case 0:
                        two_sections();
                        [[fallthrough]];
                    case 3:
                        two_sections();
                        [[fallthrough]];
                    case 2:
                        two_sections();
                        [[fallthrough]];
                    case 1:
                        two_sections();
                        pairs = pairs > 4 ? (pairs - 1) / 4 * 4 : 0;
                } while (pairs != 0);
            }
        }
    }
    return value;
}

template <class Technique, class Format>
auto Sum<Cascade, Technique, Format>::step(State& state, Sample newest) -> Output {
    const std::size_t near_samples = state.near_samples;
    if (near_samples == 0 && state.modes != 0) {
        return filtered(state, newest);
    }
    const Coefficient* table = state.table;
    Sample* const past = state.past;
    auto sum = Format::start(newest, state.scale);
    if (near_samples != 0) {
        for (std::size_t i = 0; i < near_samples - 1; ++i) {
            sum = Format::multiply_add(sum, table[i], past[i]);
        }
        // C99: cascade closing
        sum = Format::multiply_add(sum, table[near_samples - 1], filtered(state, past[near_samples - 1]));
        // C99 end
        for (std::size_t i = near_samples - 1; i > 0; --i) {
            past[i] = past[i - 1];
        }
        past[0] = newest;
    }
    return Format::finish(sum, state.scale);
}

}  // namespace glsum
