// Result rows in Google Benchmark's schema.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "glsum/kernel.hpp"

namespace bench {

using Json = nlohmann::ordered_json;

/// A row that Google Benchmark did not make itself: the fields that its tools expect, times 0.
[[nodiscard]] Json make_row(const std::string& name, std::size_t iterations);

/// Marks a row as wrong or impossible: such rows are never ranked.
void mark_error(Json& row, const std::string& message);

[[nodiscard]] std::string to_text(glsum::Status status);

}  // namespace bench
