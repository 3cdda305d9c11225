// What of a record starts are compared on: so many nodes at most, and no fewer to a swing than it takes.
#pragma once

#include <vector>

#include "gap/drive/record.hpp"

namespace gap {

struct Part {
    Record record;        ///< all of it, or its beginning
    double per_interval;  ///< nodes to its usual interval; below 1 a node spans several
};

/// All of a record where some 1500 nodes show how it moves. Where the output swings too quickly for that, twice as many
/// of its beginning: nodes that lie a third of a swing apart show another one.
[[nodiscard]] Part part_of(const Record& record);

}  // namespace gap
