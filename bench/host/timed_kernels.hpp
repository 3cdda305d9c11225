// The registry's kernels as lines to be timed.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "bench/host/timed_line.hpp"
#include "glsum/kernel.hpp"

namespace bench {

struct TimedKernel {
    std::string_view name;
    bool sums;  ///< not so `null`, which hands its sample through
    std::unique_ptr<TimedLine> (*make)(const glsum::Design& design);
};

/// Of the registry, in its order.
[[nodiscard]] std::vector<TimedKernel> timed_kernels();

}  // namespace bench
