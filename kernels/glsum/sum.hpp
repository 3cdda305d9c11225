// A kernel as the combination of its name's three words: how the past is kept, how it is summed, in which numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "glsum/kernel.hpp"
#include "glsum/weights.hpp"

namespace glsum {

/// "<history>_<technique>_<format>".
template <class History, class Technique, class Format>
inline constexpr auto kernel_name = [] {
    constexpr std::size_t size = History::word.size() + Technique::word.size() + Format::word.size() + 2;
    std::array<char, size> joined{};
    std::size_t at = 0;
    for (std::string_view word : {History::word, Technique::word, Format::word}) {
        if (at != 0) {
            joined[at++] = '_';
        }
        for (char letter : word) {
            joined[at++] = letter;
        }
    }
    return joined;
}();

/// What every Sum has alike: its words, its numbers, its name, and how reals become samples.
template <class History, class Technique, class Format>
struct SumOf {
    using Sample = typename Format::Sample;
    using Coefficient = typename Format::Coefficient;
    using Output = typename Format::Output;
    using HistoryPart = History;
    using TechniquePart = Technique;
    using FormatPart = Format;

    static constexpr bool host_only = Technique::host_only;

    static constexpr std::string_view name() {
        return {kernel_name<History, Technique, Format>.data(), kernel_name<History, Technique, Format>.size()};
    }

    /// The orders that `prepare` takes.
    static constexpr bool order_in_range(double order) { return glsum::order_in_range(order); }

    static Sample from_real(double real) { return Format::from_real(real); }
    template <class State>
    static double to_real(const State& state, Output output) {
        return Format::to_real(output, state.scale);
    }
};

/// Each family of histories defines its own.
template <class History, class Technique, class Format>
struct Sum;

/// registry.hpp says which are.
template <class History, class Technique, class Format>
inline constexpr bool is_registered<Sum<History, Technique, Format>> = false;

}  // namespace glsum
