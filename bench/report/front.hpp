// The Pareto front: what nothing else beats on both axes.
#pragma once

#include <span>
#include <vector>

namespace bench::report {

/// A kernel at one length: what it costs and how wrong it is. Both above 0, or 0.
struct Point {
    double cost;
    double error;
};

/// Whether each point is on the front. Errors within 1 % count as the same. A point is dominated when another one costs
/// no more and errs no more, and is better in one of the two. page `front.js` says the same.
[[nodiscard]] std::vector<bool> on_front(std::span<const Point> points);

}  // namespace bench::report
