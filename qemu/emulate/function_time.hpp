// What a function takes, from what the timing model saw of its calls.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "qemu/timing/effects.hpp"
#include "qemu/timing/timing_log.hpp"

namespace qemu {

/// Of all calls.
struct Spread {
    std::int64_t min = 0;
    std::int64_t median = 0;  ///< the lower one of two in the middle
    std::int64_t max = 0;
};

[[nodiscard]] constexpr double in_cycles(std::int64_t half_cycles) { return static_cast<double>(half_cycles) / 2.0; }

/// Times in half cycles, as the timing model has them.
struct FunctionTime {
    std::uint64_t calls = 0;
    Spread instructions;
    Spread nominal;         ///< by the core file's nominal rule set
    std::int64_t low = 0;   ///< the least median of the rule sets, the nominal one included
    std::int64_t high = 0;  ///< the largest
    std::array<Spread, timing::effect_count> lost;
    Spread in_double;               ///< within the routines of double precision in software
    std::uint32_t stack_bytes = 0;  ///< the most of any call, below its caller's frame
    std::vector<Spread> sets;       ///< under each rule set of the core file, in its order
    std::vector<std::pair<std::uint32_t, timing::HotSpot>>
        hot;                                         ///< addresses, what all calls spent there; costliest first
    std::map<std::uint32_t, std::uint64_t> unknown;  ///< executions of what the decoder does not know
    bool recursive = false;
};

/// \param log  of one call or more \param core  which of the log's cores
[[nodiscard]] FunctionTime function_time(const timing::TimingLog& log, std::size_t core = 0);

}  // namespace qemu
