// Records of given readings, for audits.
#pragma once

#include <cstddef>
#include <random>
#include <utility>
#include <vector>

#include "gap/drive/audit.hpp"

namespace audit_test {

using Values = std::vector<double>;

inline gap::Record record_of(Values output, double interval_s = 0.1) {
    gap::Record record;
    record.name = "made";
    record.usual_interval_s = interval_s;
    for (std::size_t i = 0; i < output.size(); ++i) {
        record.time_s.push_back(interval_s * static_cast<double>(i));
        record.input.push_back(1.0);
    }
    record.output = std::move(output);
    return record;
}

inline Values noisy(std::size_t count, unsigned seed, double size = 1.0) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal(0.0, size);
    Values values(count);
    for (double& value : values) {
        value = normal(engine);
    }
    return values;
}

// In a unit that has more than six digits: no logger rounded these.
constexpr double unit = 0.123456789;

inline Values in_units(Values numbers) {
    for (double& number : numbers) {
        number *= unit;
    }
    return numbers;
}

}  // namespace audit_test
