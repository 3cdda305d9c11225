#include "gap/drive/base/part.hpp"

#include <algorithm>
#include <cmath>

#include "gap/drive/audit.hpp"
#include "gap/drive/moments.hpp"

namespace gap {
namespace {

// How far a swing goes on from reading to reading, of what is no noise: of a sine y the mean square of differences is
// (2 - 2 cos angle) times y's.
double angle_per_reading(const Record& record) {
    const std::vector<double>& z = record.output;
    const double noise = audit({record}).noise;
    double differences = 0.0;
    for (std::size_t i = 1; i < z.size(); ++i) {
        differences += (z[i] - z[i - 1]) * (z[i] - z[i - 1]) / static_cast<double>(z.size() - 1);
    }
    const double square = moments_of(z, z).xx / static_cast<double>(z.size());
    const double moved = std::max(0.0, differences - 2.0 * noise * noise);
    return square > 0.0 ? std::acos(std::clamp(1.0 - 0.5 * moved / square, -1.0, 1.0)) : 0.0;
}

}  // namespace

Part part_of(const Record& record) {
    constexpr double nodes = 1500.0;
    constexpr double more_nodes = 3000.0;
    // From node to node, at which a swing is simulated within a per cent of its period.
    constexpr double widest_angle = 0.15;
    constexpr double most_per_interval = 8.0;
    const auto size = static_cast<double>(record.size());
    const double usual = std::min(1.0, nodes / size);
    const double needed = std::min(angle_per_reading(record) / widest_angle, most_per_interval);
    if (!(needed > usual)) {
        return {record, usual};
    }
    const double readings = more_nodes / needed;
    if (!(readings < size)) {
        return {record, needed};
    }
    return {up_to(record, record.time_s[static_cast<std::size_t>(readings)]), needed};
}

}  // namespace gap
