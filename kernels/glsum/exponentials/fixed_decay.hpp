// What an average moves by with each sample, in fixed point: d = mantissa 2^-shift.
#pragma once

#include <cstdint>

#include "glsum/format/fixed.hpp"
#include "glsum/power_of_two.hpp"

namespace glsum {

/// The mantissa has 30 bits: so its products with two samples stay, with their difference and half a unit, within 64.
struct FixedDecay {
    std::int32_t mantissa;
    std::int32_t shift;
};
inline constexpr std::int32_t largest_shift = 62;

/// \param decay  in (0, 1]; below 2^-33 the mantissa has fewer bits
constexpr FixedDecay to_fixed(double decay) {
    std::int32_t shift = 30;
    while (shift < largest_shift && decay * power_of_two(shift) < 0x1p29) {
        ++shift;
    }
    return {round_to_integer<std::int32_t>(decay * power_of_two(shift)), shift};
}

}  // namespace glsum
