#include "bench/rows/front.hpp"

#include <algorithm>

namespace bench {
namespace {

constexpr double same_error = 1.01;

}  // namespace

bool dominates(const Point& one, const Point& other) {
    return one.cost <= other.cost && one.bytes <= other.bytes && one.error <= other.error * same_error &&
           (one.cost < other.cost || one.bytes < other.bytes || one.error * same_error < other.error);
}

std::vector<bool> on_front(std::span<const Point> points) {
    std::vector<bool> on;
    for (const Point& point : points) {
        on.push_back(
            std::none_of(points.begin(), points.end(), [&](const Point& other) { return dominates(other, point); }));
    }
    return on;
}

}  // namespace bench
