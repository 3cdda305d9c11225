// What a gate allows: the rules of a thresholds file.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/rows/counters.hpp"

namespace bench::gate {

/// What is asked of a run, in this order: a later question is moot where an earlier one has failed.
enum class Layer { rows, answer, accuracy, instructions_and_bytes, model_cycles, host_time };
inline constexpr std::array layers = {
    Layer::rows, Layer::answer, Layer::accuracy, Layer::instructions_and_bytes, Layer::model_cycles, Layer::host_time};
[[nodiscard]] std::string_view name_of(Layer layer);

using bench::Better;

/// What may happen to some counters of some rows.
struct Rule {
    Layer layer = Layer::accuracy;
    std::vector<std::string> rows;      ///< globs of row names; `*` matches slashes too
    std::vector<std::string> counters;  ///< globs of counter names
    Better better = Better::lower;      ///< never `neither`
    double relative = 0.0;              ///< change for the worse that is allowed, as a share of the baseline's value
    double absolute = 0.0;              ///< the same in the counter's unit; the larger of both counts
    bool fails = true;                  ///< else it only warns
    std::string reason;
    // Of host_time only:
    std::string anchor;  ///< kernel of the same run, order and length that times are divided by
    std::vector<std::string>
        witnesses;             ///< globs of kernels whose code is not ours: when one's own ratio to the anchor
                               ///< moved, the machine did, and nothing of that order and length is judged
    double confidence = 0.99;  ///< of the one-sided bootstrap bound on the change of that ratio
    std::size_t line = 0;      ///< in the file

    [[nodiscard]] bool wants_row(const std::string& name) const;
    [[nodiscard]] bool wants_counter(const std::string& name) const;
    /// The change for the worse that is allowed from `baseline`, in the counter's unit.
    [[nodiscard]] double allowed(double baseline) const;
    /// How far `current` lies beyond what is allowed; at most 0 where it is allowed.
    [[nodiscard]] double excess(double baseline, double current) const;
};

/// For each row and counter the first rule that fails, and the first that warns, decide.
using Rules = std::vector<Rule>;

/// Reads a thresholds file.
/// \throws glsum::Failure (bad input) naming file, line and column: broken TOML, a key that is unknown, missing or of
/// another kind, a limit that is not a finite number of at least 0.
[[nodiscard]] Rules read_rules(const std::filesystem::path& path);

/// The same of a text. \param name  what messages call it
[[nodiscard]] Rules parse_rules(std::string_view text, const std::string& name);

/// Which direction of a counter the rules call better; empty where none speaks of it.
[[nodiscard]] std::optional<Better> better_of(const Rules& rules, const std::string& row, const std::string& counter);

}  // namespace bench::gate
