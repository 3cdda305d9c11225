// An effect by its name and numbers, in a record whose input steps.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "gap/drive/effect.hpp"
#include "gap/drive/simulate.hpp"

namespace effect_test {

using Values = std::vector<double>;

constexpr double h = 0.01;

inline gap::Scenario with(const std::string& name, const Values& values, gap::Scenario scenario = {}) {
    gap::effect_named(name).add_to(scenario, values);
    return scenario;
}

inline gap::Record staircase() {
    gap::Record record;
    record.name = "staircase";
    record.usual_interval_s = h;
    for (std::size_t k = 0; k <= 800; ++k) {
        const double t = static_cast<double>(k) * h;
        record.time_s.push_back(t);
        record.input.push_back(k < 200 ? 0.4 : k < 450 ? 1.0 : 0.2);
        record.output.push_back(0.0);
    }
    return record;
}

inline double largest_difference(const Values& a, const Values& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max(largest, std::fabs(a[i] - b[i]));
    }
    return largest;
}

}  // namespace effect_test
