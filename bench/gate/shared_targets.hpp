// Which targets two runs share: of the others there is nothing to judge.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/rows/row.hpp"

namespace bench::gate {

/// "host", "m7", "m4": the target that a row was measured for. Empty of accuracy, which every run has, and of a name
/// that does not say.
[[nodiscard]] std::string target_of(const std::string& name);

class SharedTargets {
public:
    /// \param baseline, current  names of rows
    /// \param context  of the current run: which targets it was asked for. Where it does not say, for all of the
    ///                 baseline's: a row that is not there is lost then.
    SharedTargets(const std::vector<std::string>& baseline, const std::vector<std::string>& current,
                  const Json& context);
    /// Whether the row is of a target that both runs have, or of none.
    [[nodiscard]] bool has(const std::string& name) const;
    /// All rows of the baseline are of targets that the run has not.
    [[nodiscard]] bool none() const;
    /// "7 rows of m4, of which the baseline has none", by semicolons; empty where both have the same targets. Host
    /// times that the baseline has not are none of it.
    [[nodiscard]] std::string not_judged() const;
    [[nodiscard]] std::string of_baseline() const;  ///< "m7, m4"
    [[nodiscard]] std::string of_current() const;

private:
    std::map<std::string, std::size_t> baseline_;  // rows of each target
    std::map<std::string, std::size_t> current_;   // no rows: asked for, and none came
};

}  // namespace bench::gate
