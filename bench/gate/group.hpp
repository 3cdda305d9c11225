// Findings as people want them: what one kernel changed in one counter is one, at however many lengths and orders.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/gate/verdict.hpp"

namespace bench::gate {

/// Of one level, layer, kernel, target and counter, in the order of the first ones; a row of another program is its
/// own.
struct FindingGroup {
    std::vector<const Finding*> findings;  ///< into the verdict

    [[nodiscard]] const Finding& first() const { return *findings.front(); }
    /// "gl/ring_plain_f32/.../m7:stm32f746-itcm model_cycles_per_sample" of a row, "ring_plain_f32 m7:stm32f746-itcm
    /// model_cycles_per_sample" of several.
    [[nodiscard]] std::string subject() const;
    /// The rows' part of that, and the counter's.
    [[nodiscard]] std::string rows() const;
    /// In words: of several "+2.0 % to +3.1 % in 12 rows".
    [[nodiscard]] std::string what() const;
};

[[nodiscard]] std::vector<FindingGroup> groups_of(const Verdict& verdict, Level level);

/// A file of the project and a line of it.
struct Place {
    std::string file;  ///< empty: none
    int line = 0;
};
/// Where a kernel stands in the registry. \param row  its name, or a kernel's with `/*` behind it
[[nodiscard]] Place place_of(const std::string& row);

}  // namespace bench::gate
