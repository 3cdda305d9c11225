// The causes of lost cycles that the model tells apart. Together they are the cycle effects of the diagnosis.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace timing {

/// What rules of the pipeline and its memories make a core pay.
enum class Effect : std::uint8_t {
    single_issue,        ///< the second slot of a cycle stays empty; instructions that take several cycles to issue
    result_latency,      ///< of the ALU, of flags, of a division
    load_use,            ///< a loaded value, integer or floating point
    load_bank_conflict,  ///< two loads of one bank; a load behind a late FP store of its bank
    fpu_latency,         ///< floating-point results, and what the FPU bars
    mac_latency,         ///< integer products
    branch_mispredict,
    store_buffer,
    unaligned_access,
    fetch_alignment,  ///< 64 bits a cycle come from a perfect memory
    icache_misses,
    dcache_misses,
    flash_wait_states,  ///< where no cache holds them off
};
inline constexpr std::size_t effect_count = 13;

inline constexpr std::array<std::string_view, effect_count> effect_names{
    "single_issue",  "result_latency",    "load_use",         "load_bank_conflict", "fpu_latency",
    "mac_latency",   "branch_mispredict", "store_buffer",     "unaligned_access",   "fetch_alignment",
    "icache_misses", "dcache_misses",     "flash_wait_states"};

[[nodiscard]] constexpr std::optional<Effect> effect_named(std::string_view name) {
    for (std::size_t i = 0; i < effect_count; ++i) {
        if (effect_names[i] == name) {
            return static_cast<Effect>(i);
        }
    }
    return std::nullopt;
}

/// Paid by programs, not by a rule: all that the routines take which compute in double precision without a unit.
inline constexpr std::string_view double_in_software = "double_precision_in_software";
/// Of the measurement, the board and the build. Core files hold figures for the first two, which lie beside a call; no
/// core file pays for the others.
inline constexpr std::array<std::string_view, 6> effects_beside_a_call{
    "call_overhead", "cache_maintenance", "clock_ratio", "interrupt_load", "bus_contention", "different_binary"};

[[nodiscard]] constexpr std::size_t index(Effect effect) { return static_cast<std::size_t>(effect); }

/// Half cycles lost to each effect.
using Losses = std::array<std::int64_t, effect_count>;

}  // namespace timing
