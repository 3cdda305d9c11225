// What the pages of the documentation are made of, as JSON: what the product itself says of its kernels, cores and
// effects.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace docs {

/// A list of families: {"word", "keeps", "kernels": [{"name", "history", "technique", "format", "host_only",
/// "exact_sums", "in_double", "integrals_alone", "orders": "all", or which}]}.
[[nodiscard]] nlohmann::ordered_json families();

/// A list of cores: {"name", "note", "core", "code", "data", "figures": [{"key", "value", "mark", "source", "file"}],
/// "rivals": [{"name", "note", "fits", "differs": [{"key", "value"}]}]}.
[[nodiscard]] nlohmann::ordered_json cores(const std::filesystem::path& folder);

/// A list of effects: {"name", "place", "domains", "event", "linear", "base_takes_it", "moves_nothing", "plant",
/// "parameters", "units", "alike": [[name, cosine]], "time_s", "input", "without", "with"}.
[[nodiscard]] nlohmann::ordered_json effects();

}  // namespace docs
