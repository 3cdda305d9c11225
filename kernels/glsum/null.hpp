// null: no sum at all. What a call, its argument and its result cost by themselves, measured like every kernel.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "glsum/kernel.hpp"

namespace glsum {

struct Null {
    using Sample = float;
    using Coefficient = float;
    using Output = float;
    struct State {};

    static constexpr bool host_only = false;

    static constexpr std::string_view name() { return "null"; }
    static constexpr std::size_t table_count(std::size_t) { return 0; }
    static constexpr std::size_t past_count(std::size_t) { return 0; }
    static constexpr std::size_t multiplications(std::size_t) { return 0; }
    static Status prepare(State& state, const Design& design, std::span<float> table, std::span<float> past);
    static void reset(State& state);
    static float step(State& state, float newest);
    static float from_real(double real) { return static_cast<float>(real); }
    static double to_real(const State&, float output) { return static_cast<double>(output); }
};

}  // namespace glsum
