#include "gap/drive/level_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "gap/drive/moments.hpp"
#include "gap/drive/simulate.hpp"

namespace gap {
namespace {

std::vector<double> places_of(const Record& record) {
    constexpr std::size_t most = 24;
    std::vector<double> levels = {0.0};
    for (const double u : record.input) {
        levels.push_back(std::fabs(u));
    }
    std::sort(levels.begin(), levels.end());
    std::vector<double> apart = levels;
    apart.erase(std::unique(apart.begin(), apart.end()), apart.end());
    if (apart.size() > most + 1) {
        std::vector<double> evenly;
        for (std::size_t i = 0; i <= most; ++i) {
            evenly.push_back(levels[i * (levels.size() - 1) / most]);
        }
        evenly.erase(std::unique(evenly.begin(), evenly.end()), evenly.end());
        apart = evenly;
    }
    std::vector<double> places;
    for (std::size_t i = 1; i < apart.size(); ++i) {
        places.push_back(0.5 * (apart[i - 1] + apart[i]));
    }
    return places;
}

// What a line through the response leaves of the reading; infinite where the response does not move.
double left_by(std::span<const double> response, std::span<const double> reading) {
    const Moments sums = moments_of(response, reading);
    const double left = sums.yy - sums.xy * sums.xy / sums.xx;
    return std::isfinite(left) ? left : std::numeric_limits<double>::infinity();
}

}  // namespace

LevelPlace scan_levels(const Clue& clue, const std::function<void(Scenario&, double)>& add) {
    LevelPlace best{0.0, std::numeric_limits<double>::infinity()};
    for (const double level : places_of(clue.course.record())) {
        Scenario scenario = clue.scenario;
        add(scenario, level);
        const std::vector<double> response = clue.course.read(clue.course.nodes_of(scenario));
        const double squares = left_by(response, clue.course.record().output);
        if (squares < best.squares) {
            best = {level, squares};
        }
    }
    return best;
}

}  // namespace gap
