// Nelder and Mead's simplex in three dimensions.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace stand::blind {

using Point3 = std::array<double, 3>;

/// The point on the line through `middle` and `end` that lies `by` times as far from the middle as the end; on the
/// other side where `by` is negative.
[[nodiscard]] inline Point3 along(const Point3& middle, const Point3& end, double by) {
    const auto of = [&](std::size_t i) { return middle[i] + by * (end[i] - middle[i]); };
    return {of(0), of(1), of(2)};
}

/// Asks for `cost(point)` from `first` and the points `reach` beside it in each direction on, downhill: until the
/// corners' costs differ by no more than 1e-4 of the least, or for `most_steps` steps. Which point was best its asker
/// knows.
template <class Cost>
void descend_simplex(const Point3& first, double reach, const Cost& cost, int most_steps = 120) {
    struct Corner {
        Point3 point;
        double cost;
    };
    const auto at = [&](const Point3& point) { return Corner{point, cost(point)}; };
    std::array<Corner, 4> simplex{at(first), at({first[0] + reach, first[1], first[2]}),
                                  at({first[0], first[1] + reach, first[2]}),
                                  at({first[0], first[1], first[2] + reach})};
    auto& best = simplex[0];
    auto& second = simplex[1];
    auto& third = simplex[2];
    auto& worst = simplex[3];
    for (int step = 0; step < most_steps; ++step) {
        std::sort(simplex.begin(), simplex.end(), [](const Corner& a, const Corner& b) { return a.cost < b.cost; });
        if (worst.cost - best.cost <= 1e-4 * best.cost) {
            return;
        }
        Point3 middle{};
        for (const Corner* corner : {&best, &second, &third}) {
            for (std::size_t i = 0; i < 3; ++i) {
                middle[i] += corner->point[i] / 3.0;
            }
        }
        const auto tried = [&](double by) { return at(along(middle, worst.point, by)); };
        const Corner mirrored = tried(-1.0);
        if (mirrored.cost < best.cost) {
            const Corner further = tried(-2.0);
            worst = further.cost < mirrored.cost ? further : mirrored;
        } else if (mirrored.cost < third.cost) {
            worst = mirrored;
        } else {
            const Corner nearer = tried(mirrored.cost < worst.cost ? -0.5 : 0.5);
            if (nearer.cost < std::min(mirrored.cost, worst.cost)) {
                worst = nearer;
                continue;
            }
            for (Corner* corner : {&second, &third, &worst}) {
                *corner = at(along(best.point, corner->point, 0.5));
            }
        }
    }
}

}  // namespace stand::blind
