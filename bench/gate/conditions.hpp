// Whether two runs may be compared at all.
#pragma once

#include <string>
#include <vector>

#include "bench/gate/row_table.hpp"

namespace bench::gate {

/// What a difference between two contexts does.
enum class Effect {
    incomparable,  ///< the numbers mean different things
    advisory,      ///< times of the host are of two machines: a finding about them only warns
    note,          ///< worth knowing when something else differs
};

struct Difference {
    std::string field;
    std::string baseline;  ///< as in the file; "(absent)" where it has none
    std::string current;
    Effect effect;
};

/// One of two runs.
struct Side {
    const Json& context;
    const std::vector<std::string>& rows;  ///< their names
};

/// The fields that matter to the kinds of rows that both runs hold, in a fixed order, worst effect first. What belongs
/// to one emulated machine matters where both have rows of that machine.
[[nodiscard]] std::vector<Difference> differences(const Side& baseline, const Side& current);

/// "compiler: GNU 12.2.0 in the baseline, Clang 14.0.6 now", of each field that makes the runs incomparable, by
/// semicolons; empty where none does. \param first, second  what the two runs are called
[[nodiscard]] std::string incomparable(const std::vector<Difference>& differences,
                                       const std::string& first = "the baseline", const std::string& second = "now");

[[nodiscard]] bool has_effect(const std::vector<Difference>& differences, Effect effect);

}  // namespace bench::gate
