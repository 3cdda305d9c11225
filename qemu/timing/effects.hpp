// The causes of lost cycles that the model tells apart: the cycle effects of the diagnosis, as far as they arise inside
// the core and its memories.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace timing {

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
    "single_issue",      "result_latency",   "load_use",        "load_bank_conflict", "fpu_latency",
    "mac_latency",       "branch_mispredict", "store_buffer",   "unaligned_access",   "fetch_alignment",
    "icache_misses",     "dcache_misses",    "flash_wait_states"};

[[nodiscard]] constexpr std::optional<Effect> effect_named(std::string_view name) {
    for (std::size_t i = 0; i < effect_count; ++i) {
        if (effect_names[i] == name) {
            return static_cast<Effect>(i);
        }
    }
    return std::nullopt;
}

[[nodiscard]] constexpr std::size_t index(Effect effect) { return static_cast<std::size_t>(effect); }

}  // namespace timing
