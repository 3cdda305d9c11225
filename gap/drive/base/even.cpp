#include "gap/drive/base/even.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gap/drive/base/part.hpp"

namespace gap {

Even even_of(const Record& whole) {
    const Part part = part_of(whole);
    const Record& record = part.record;
    const Grid grid = record.grid(std::min(1.0, part.per_interval));
    const std::vector<double> held = held_on(grid, record.time_s, record.input);
    std::vector<double> times_s(grid.count);
    std::vector<double> output(grid.count);
    std::size_t i = 0;
    for (std::size_t k = 0; k < grid.count; ++k) {
        const double at = std::min(grid.at(k), record.time_s.back());
        while (i + 2 < record.size() && record.time_s[i + 1] <= at) {
            ++i;
        }
        const double share = (at - record.time_s[i]) / (record.time_s[i + 1] - record.time_s[i]);
        output[k] = record.output[i] + std::clamp(share, 0.0, 1.0) * (record.output[i + 1] - record.output[i]);
    }
    const auto count = static_cast<Eigen::Index>(grid.count);
    return {grid.step_s, record.time_s.back() - record.time_s.front(),
            Eigen::Map<const Eigen::VectorXd>(held.data(), count),
            Eigen::Map<const Eigen::VectorXd>(output.data(), count)};
}

Eigen::VectorXd late(const Eigen::VectorXd& values, Eigen::Index by) {
    Eigen::VectorXd moved(values.size());
    for (Eigen::Index k = 0; k < values.size(); ++k) {
        moved(k) = values(std::max<Eigen::Index>(0, k - by));
    }
    return moved;
}

}  // namespace gap
