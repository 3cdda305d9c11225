#include "gap/drive/residuals/features.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gap {
namespace {

// The value held at a time, 0 before the record.
class Held {
public:
    Held(const Record& record, const std::vector<double>& values) : record_(record), values_(values) {}
    // For times that rise.
    double at(double time_s) {
        while (next_ < record_.size() && record_.time_s[next_] <= time_s) {
            ++next_;
        }
        return next_ == 0 ? 0.0 : values_[next_ - 1];
    }

private:
    const Record& record_;
    const std::vector<double>& values_;
    std::size_t next_ = 0;
};

std::vector<double> lagged(const Record& record, const std::vector<double>& values, double lag_s) {
    Held held(record, values);
    std::vector<double> late;
    for (const double t : record.time_s) {
        late.push_back(held.at(t - lag_s + 1e-9));
    }
    return late;
}

std::vector<double> speeds(const Remainder& of) {
    const Record& record = *of.record;
    std::vector<double> speed(record.size());
    const std::size_t reach = std::max<std::size_t>(1, record.size() / 2000);
    for (std::size_t i = 0; i < speed.size(); ++i) {
        const std::size_t from = i - std::min(i, reach);
        const std::size_t to = std::min(speed.size() - 1, i + reach);
        speed[i] = (of.simulated[to] - of.simulated[from]) / (record.time_s[to] - record.time_s[from]);
    }
    return speed;
}

}  // namespace

Range range_of(const std::vector<const Remainder*>& all) {
    Range range;
    range.low = range.high = all.front()->simulated.front();
    for (const Remainder* one : all) {
        for (std::size_t i = 0; i < one->simulated.size(); ++i) {
            range.low = std::min(range.low, one->simulated[i]);
            range.high = std::max(range.high, one->simulated[i]);
            range.input = std::max(range.input, std::fabs(one->record->input[i]));
        }
        for (const double speed : speeds(*one)) {
            range.speed = std::max(range.speed, std::fabs(speed));
        }
        range.length_s = std::max(range.length_s, one->record->time_s.back() - one->record->time_s.front());
    }
    return range;
}

Eigen::MatrixXd features_of(const Remainder& of, const Range& range, double delay_s, double time_constant_s) {
    const Record& record = *of.record;
    std::vector<std::vector<double>> columns;
    const auto add = [&](auto value) {
        columns.emplace_back();
        for (std::size_t i = 0; i < record.size(); ++i) {
            columns.back().push_back(value(i));
        }
    };
    const std::vector<double> speed = speeds(of);
    std::vector<double> u;
    std::vector<double> y;
    std::vector<double> v;
    for (std::size_t i = 0; i < record.size(); ++i) {
        u.push_back(record.input[i] / range.input);
        y.push_back((of.simulated[i] - range.low) / (range.high - range.low) * 2.0 - 1.0);
        v.push_back(speed[i] / range.speed);
    }
    for (const double lag : {0.0, 0.15, 0.4, 0.8, 1.5, 3.0}) {
        const std::vector<double> late = lagged(record, u, delay_s + lag * time_constant_s);
        add([&](std::size_t i) { return late[i]; });
        add([&](std::size_t i) { return late[i] * std::fabs(late[i]); });
        add([&](std::size_t i) { return late[i] * y[i]; });
    }
    for (const double lag : {0.0, 0.3, 0.8, 2.0}) {
        const std::vector<double> late = lagged(record, y, lag * time_constant_s);
        add([&](std::size_t i) { return late[i]; });
        add([&](std::size_t i) { return late[i] * late[i]; });
    }
    add([&](std::size_t i) { return y[i] * y[i] * y[i]; });
    add([&](std::size_t i) { return std::max(0.0, y[i] - 0.6); });
    add([&](std::size_t i) { return v[i]; });
    add([&](std::size_t i) { return v[i] * std::fabs(v[i]); });
    add([&](std::size_t i) { return std::fabs(v[i]); });
    add([&](std::size_t i) { return std::tanh(20.0 * v[i]); });
    add([&](std::size_t i) { return v[i] * y[i]; });
    for (const double lag : {0.3, 1.0}) {
        const std::vector<double> late = lagged(record, v, lag * time_constant_s);
        add([&](std::size_t i) { return std::tanh(20.0 * late[i]); });
        add([&](std::size_t i) { return late[i]; });
    }
    for (const double waves : {1.0, 2.0, 3.0, 5.0, 8.0}) {  // teeth, magnets
        add([&](std::size_t i) { return std::sin(std::numbers::pi * waves * y[i]); });
        add([&](std::size_t i) { return std::cos(std::numbers::pi * waves * y[i]); });
    }
    add([&](std::size_t i) { return (record.time_s[i] - record.time_s.front()) / range.length_s; });
    add([&](std::size_t i) { return u[i] * (record.time_s[i] - record.time_s.front()) / range.length_s; });
    add([&](std::size_t) { return 1.0; });
    Eigen::MatrixXd features(static_cast<Eigen::Index>(record.size()), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t c = 0; c < columns.size(); ++c) {
        features.col(static_cast<Eigen::Index>(c)) =
            Eigen::Map<const Eigen::VectorXd>(columns[c].data(), static_cast<Eigen::Index>(record.size()));
    }
    return features;
}

}  // namespace gap
