// Which of the calls that `measure` makes of a kernel the timing model sees: it is slow, and most calls are alike. The
// firmware marks them, the host reads their cycles in the same order.
#pragma once

#include <algorithm>
#include <cstddef>

namespace firmware {

/// Call 0 is the first, with cold caches and an untrained predictor. The next `taps` fill the past; of them only the
/// last few are timed, so that caches and predictor have settled. Then comes a whole turn of a ring: the steady calls,
/// and of a long turn some more, up to and over its wrap.
struct TimedCalls {
    std::size_t taps;
    bool software_double;  ///< such a call takes some 40 times the instructions: fewer of them are timed

    static constexpr std::size_t whole_turn = 64;  ///< a turn that is no longer is timed whole
    static constexpr std::size_t groups = 4;       ///< of a longer one, so many groups of so many calls
    static constexpr std::size_t group = 2;

    /// How many calls are made once the past is full: a turn of a ring and at least 32. In software double, where the
    /// arithmetic dwarfs the upkeep, 32: a turn of 5000 taps would take longer than all other kernels together.
    [[nodiscard]] constexpr std::size_t turn() const { return software_double ? 32 : std::max<std::size_t>(taps, 32); }
    /// All calls: the first, the past, the turn.
    [[nodiscard]] constexpr std::size_t calls() const { return 1 + taps + turn(); }
    /// How many calls let caches and predictor settle before the steady ones.
    [[nodiscard]] constexpr std::size_t settling() const { return software_double ? 0 : 2; }
    /// How many calls the steady figure is the mean of.
    [[nodiscard]] constexpr std::size_t steady() const { return software_double ? 1 : taps <= whole_turn ? 32 : 8; }
    [[nodiscard]] constexpr bool is_steady(std::size_t call) const { return call > taps && call <= taps + steady(); }
    /// Whether the past was full before this call.
    [[nodiscard]] constexpr bool is_full(std::size_t call) const { return call > taps; }

    [[nodiscard]] constexpr bool contains(std::size_t call) const {
        if (call == 0 || is_steady(call)) {
            return true;
        }
        if (!is_full(call)) {
            return call + settling() > taps;
        }
        const std::size_t behind = call - taps;  // 1 to turn()
        if (software_double) {
            return behind == turn();
        }
        for (std::size_t g = 1; g <= groups; ++g) {
            const std::size_t end = turn() * g / groups;
            if (behind <= end && behind + group > end) {
                return true;
            }
        }
        return turn() <= whole_turn;
    }
};

/// Of a kernel in two halves so many calls are made in halves once its row is through: whole groups of any block.
inline constexpr std::size_t calls_in_halves = 32;

/// Of the steps of a model, which has no one length: the first, and of the last 32 the first few.
inline constexpr std::size_t steady_steps = 32;
inline constexpr std::size_t least_timed_steps = 100;  ///< so that what is timed beside these lies behind the last
[[nodiscard]] constexpr TimedCalls timed_steps(std::size_t steps, bool software_double) {
    return {steps - steady_steps - 1, software_double};
}

}  // namespace firmware
