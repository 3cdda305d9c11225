// Result files: written whole, read with bounds, and told apart when they are broken.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/rows/row.hpp"

namespace bench {

/// What a result file holds: the conditions of a run, and its rows.
struct Results {
    Json context;
    std::vector<Json> rows;
};

/// Bounds of what is read: beyond them a file is refused, not swallowed.
struct ResultLimits {
    static constexpr std::size_t bytes = 512u << 20;
    static constexpr std::size_t rows = 1'000'000;
    static constexpr std::size_t text = 4096;   ///< of a name or value
    static constexpr std::size_t fields = 256;  ///< of a row
    static constexpr std::size_t context_values = 100'000;
};

/// Reads a file that `write_results` or Google Benchmark wrote: an object `context` and an array `benchmarks` of rows,
/// each an object of texts, booleans and finite numbers with a `name` of its own (repetitions and aggregates of one
/// benchmark share theirs).
/// \throws glsum::Failure (bad input) naming the file, the line or row, what was expected and what was found: a missing
/// file, one that ends in the middle, a NaN or an infinity, other broken JSON, a file of another kind, a name twice.
[[nodiscard]] Results read_results(const std::filesystem::path& path);

/// The same of a text. \param name  what messages call it
[[nodiscard]] Results parse_results(const std::string& text, const std::string& name);

/// Writes {"context", "benchmarks"}.
void write_results(const std::filesystem::path& path, const Json& context, const std::vector<Json>& rows);

}  // namespace bench
