#include "gap/drive/excitation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace gap {
namespace {

// The last bit of a number mixed as SplitMix64 does: neighbours do not know of each other.
bool coin(std::uint64_t number) {
    std::uint64_t mixed = (number + 1) * 0x9E3779B97F4A7C15U;
    mixed = (mixed ^ (mixed >> 30U)) * 0xBF58476D1CE4E5B9U;
    mixed = (mixed ^ (mixed >> 27U)) * 0x94D049BB133111EBU;
    return ((mixed ^ (mixed >> 31U)) & 1U) != 0;
}

}  // namespace

std::vector<Excitation> excitations(double time_constant_s, double record_s) {
    const double hold_s = 5.0 * time_constant_s;
    const double bit_s = 0.3 * time_constant_s;
    std::vector<Excitation> all = {
        {fmt::format("a staircase of 5 levels up and down, {:.3g} s each", hold_s), 10.0 * hold_s,
         [](double share, double) {
             return (std::min(std::floor(share * 10.0), 9.0 - std::floor(share * 10.0)) + 1.0) / 5.0;
         }},
        {fmt::format("a pseudo-random sequence of bits of {:.3g} s between two fifths and four fifths", bit_s),
         60.0 * time_constant_s,
         [bit_s](double, double time_s) { return coin(static_cast<std::uint64_t>(time_s / bit_s)) ? 0.8 : 0.4; }},
        {fmt::format("a sine swept from {:.3g} to {:.3g} Hz", 0.02 / time_constant_s, 1.0 / time_constant_s),
         60.0 * time_constant_s,
         [](double share, double) {
             const double octaves = std::log(50.0);
             const double turns = 0.02 * 60.0 / octaves * std::expm1(octaves * share);
             return 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * turns);
         }},
        {fmt::format("three pulses of a third, two thirds and all, {:.3g} s on and off", hold_s), 6.0 * hold_s,
         [](double share, double) {
             const int part = std::min(5, static_cast<int>(share * 6.0));
             return part % 2 == 0 ? static_cast<double>(part / 2 + 1) / 3.0 : 0.0;
         }},
        {fmt::format("three fifths, held for {:.3g} s", 3.0 * record_s), 3.0 * record_s,
         [](double, double) { return 0.6; }},
    };
    // What is slower than the model's own time constant, a charge that is drawn or a motor that warms, needs as long.
    if (0.1 * record_s > 3.0 * hold_s) {
        all.push_back({fmt::format("a staircase of 5 levels up and down, {:.3g} s each", 0.1 * record_s), record_s,
                       all.front().level});
    }
    return all;
}

}  // namespace gap
