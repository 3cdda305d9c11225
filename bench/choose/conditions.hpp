// What a choice is measured under.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace choose {

/// The conditions under which errors are measured.
struct Conditions {
    double order;   ///< v, in (-2, 2]
    double step_s;  ///< h of the records, above 0
    std::vector<std::string> signals;
    std::size_t samples = 5000;
    std::uint64_t seed = 2020;
};

}  // namespace choose
