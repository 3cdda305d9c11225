// What a gate found.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/failure.hpp"
#include "bench/gate/conditions.hpp"
#include "bench/gate/rules.hpp"

namespace bench::gate {

enum class Level { fail, warn, improvement, note };
[[nodiscard]] std::string_view name_of(Level level);

/// One counter of one row, or one row, or all rows of a lost kernel.
struct Finding {
    Level level = Level::note;
    Layer layer = Layer::rows;
    std::string row;      ///< its name, or a kernel's with `/*` behind it
    std::string counter;  ///< empty where the row itself is meant
    std::optional<double> baseline;
    std::optional<double> current;
    /// current / baseline - 1; of host times that of the ratio to the anchor. Empty where the baseline is 0 or missing.
    std::optional<double> change;
    std::optional<double> change_low;  ///< one-sided bootstrap bounds of host times
    std::optional<double> change_high;
    std::string what;    ///< in words
    std::string reason;  ///< the rule's
};

struct LayerCount {
    std::size_t compared = 0;  ///< values that a rule judged
    std::size_t failed = 0;
    std::size_t warned = 0;
    std::size_t better = 0;
    std::size_t moot = 0;        ///< not judged because an earlier layer of the same kernel, order and length failed
    std::size_t not_judged = 0;  ///< host times that cannot be judged; a note says why
};

struct Verdict {
    glsum::Exit status = glsum::Exit::good;
    std::string refusal;  ///< of input that cannot be read: why; all else is empty then
    std::vector<Difference> differences;
    std::vector<std::string> rows;  ///< that were looked at, in the baseline's order
    std::vector<Finding> findings;  ///< by layer, failures first
    std::array<LayerCount, layers.size()> layer_counts;
    std::string not_judged;  ///< what the run holds and no rule could judge, and why; empty: nothing
    std::string baseline_name;
    std::string current_name;

    [[nodiscard]] LayerCount& count(Layer layer) { return layer_counts[static_cast<std::size_t>(layer)]; }
    [[nodiscard]] const LayerCount& count(Layer layer) const { return layer_counts[static_cast<std::size_t>(layer)]; }
    [[nodiscard]] std::size_t with(Level level) const;
    /// "pass", "fail", "not comparable" or "refused".
    [[nodiscard]] std::string word() const;
    /// One sentence: the first layer that failed, with its first finding.
    [[nodiscard]] std::string headline() const;
    /// "; not judged: " and what; empty where all was.
    [[nodiscard]] std::string besides() const;
};

/// Where two core files model other cycles of the same instructions, what is left to do, behind "; "; else empty.
[[nodiscard]] std::string way_on(const Verdict& verdict);

}  // namespace bench::gate
