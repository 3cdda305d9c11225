// The one rule of dominance: when one way makes another not worth its cost.
#pragma once

#include <span>
#include <vector>

namespace bench {

/// What a kernel at one length costs and how wrong it is. Both above 0, or 0.
struct Point {
    double cost;
    double error;
    double bytes = 0.0;  ///< where memory counts beside the cost
};

/// Whether `one` makes `other` not worth its cost: it costs no more, takes no more bytes and errs no more, errors
/// within 1 % being the same, and is better in one of the three. The page's `front.js` says the same of two.
[[nodiscard]] bool dominates(const Point& one, const Point& other);

/// Whether each point is on the Pareto front: dominated by none.
[[nodiscard]] std::vector<bool> on_front(std::span<const Point> points);

}  // namespace bench
