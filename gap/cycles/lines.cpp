#include "gap/cycles/lines.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "qemu/emulate/rows_fit.hpp"

namespace gap::cycles {
namespace {

// Of a slope, where causes are parted: what is called no gap.
constexpr double close_share = 0.02;

using Points = std::vector<std::pair<double, double>>;

// The median slope between points of different length.
double slope_of(const Points& points) {
    std::vector<double> slopes;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = i + 1; j < points.size(); ++j) {
            const double longer = points[j].first - points[i].first;
            if (longer != 0.0) {
                slopes.push_back((points[j].second - points[i].second) / longer);
            }
        }
    }
    return median(std::move(slopes));
}

double at_length(const Points& points, double slope, double length) {
    std::vector<double> values;
    for (const auto& [of, value] : points) {
        values.push_back(value + slope * (length - of));
    }
    return median(std::move(values));
}

}  // namespace

std::vector<LineLeft> lines_left(const Evidence& evidence, const Cycles& predicted) {
    std::map<std::pair<std::string, std::string>, Rows> groups;
    for (std::size_t i = 0; i < evidence.rows().size(); ++i) {
        groups[{evidence.rows()[i].kernel, placement_of(evidence.rows()[i])}].push_back(i);
    }
    std::vector<LineLeft> lines;
    for (const auto& [name, rows] : groups) {
        Points measured;
        Points left;
        for (const std::size_t i : rows) {
            const auto length = static_cast<double>(evidence.rows()[i].taps);
            measured.emplace_back(length, evidence.measured()[i]);
            left.emplace_back(length, evidence.measured()[i] - predicted[i]);
        }
        const auto [shortest, longest] = std::minmax_element(measured.begin(), measured.end());
        const bool is_line = longest->first >= qemu::longer_call * shortest->first;
        const double slope = is_line ? slope_of(measured) : 0.0;
        const double slope_left = is_line ? slope_of(left) : 0.0;
        lines.push_back({name.first, name.second, slope != 0.0 ? slope_left / slope : 0.0,
                         at_length(left, slope_left, shortest->first), at_length(measured, slope, shortest->first)});
    }
    return lines;
}

bool is_met(const LineLeft& line) {
    return std::fabs(line.slope) <= qemu::allowed_share && !qemu::misses(line.shortest - line.constant, line.shortest);
}

bool is_met_closely(const LineLeft& line) {
    return std::fabs(line.slope) <= close_share && std::fabs(line.constant) <= qemu::allowed_cycles;
}

}  // namespace gap::cycles
