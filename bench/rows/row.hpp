// Result rows in Google Benchmark's schema.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "glsum/kernel.hpp"

namespace bench {

using Json = nlohmann::ordered_json;

/// What a row says in numbers: these, and stall_<cause>.
inline constexpr std::array<std::string_view, 31> counters = {
    "error_max",
    "error_rms",
    "rounding_error_max",
    "truncation_error_max",
    "discretisation_error_max",
    "derivative_error_max",
    "saturations",
    "effective_taps",
    "macs_per_sample",
    "horizon_samples",
    "coefficient_bytes",
    "state_bytes",
    "code_bytes",
    "stack_bytes",
    "real_time",
    "ns_per_sample",
    "cycles_per_sample",
    "instructions_per_sample",
    "loads_per_sample",
    "stores_per_sample",
    "branches_per_sample",
    "first_instructions",
    "worst_instructions",
    "model_cycles_per_sample",
    "model_cycles_low",
    "model_cycles_high",
    "first_model_cycles",
    "worst_model_cycles",
    "latency_model_cycles",
    "iterations",
    "repetition_index",
};
[[nodiscard]] bool is_counter(std::string_view field);

/// A row that Google Benchmark did not make itself: the fields that its tools expect, times 0.
[[nodiscard]] Json make_row(const std::string& name, std::size_t iterations);

/// Marks a row as wrong or impossible: such rows are never ranked.
void mark_error(Json& row, const std::string& message);

[[nodiscard]] std::string to_text(glsum::Status status);

}  // namespace bench
