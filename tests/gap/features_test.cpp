// The columns of a model without physics, each by its own formula.
#include "gap/drive/residuals/features.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace {

constexpr std::size_t samples = 200;
constexpr double step_s = 0.05;
constexpr double delay_s = 2.0 * step_s;
constexpr double time_constant_s = 20.0 * step_s;

gap::Record record_of_samples() {
    gap::Record record;
    for (std::size_t i = 0; i < samples; ++i) {
        record.time_s.push_back(7.0 + step_s * static_cast<double>(i));
        record.input.push_back(-2.0 * std::sin(0.37 * static_cast<double>(i)));
        record.output.push_back(0.0);
    }
    return record;
}

gap::Remainder remainder_of(const gap::Record& record) {
    gap::Remainder of{&record, {}, std::vector<double>(samples, 0.0), std::vector<char>(samples, 1)};
    for (std::size_t i = 0; i < samples; ++i) {
        of.simulated.push_back(1.0 + 3.0 * std::cos(0.11 * static_cast<double>(i)));
    }
    return of;
}

TEST(Features, AreScaledByAllRecords) {
    const gap::Record record = record_of_samples();
    const gap::Remainder one = remainder_of(record);
    gap::Record longer = record;
    longer.time_s.back() += 1.0;
    longer.input[5] = -4.0;
    gap::Remainder other = remainder_of(longer);
    other.simulated[20] = 9.0;
    other.simulated[30] = -5.0;
    const gap::Range range = gap::range_of({&one, &other});
    EXPECT_EQ(range.input, 4.0);
    EXPECT_EQ(range.high, 9.0);
    EXPECT_EQ(range.low, -5.0);
    EXPECT_DOUBLE_EQ(range.length_s, step_s * (samples - 1) + 1.0);
    // The steepest rise or fall over two intervals.
    double steepest = 0.0;
    for (std::size_t i = 0; i < samples; ++i) {
        const std::size_t from = std::max<std::size_t>(i, 1) - 1;
        const std::size_t to = std::min(i + 1, samples - 1);
        steepest = std::max(steepest, std::fabs(other.simulated[to] - other.simulated[from]) /
                                          (longer.time_s[to] - longer.time_s[from]));
    }
    EXPECT_DOUBLE_EQ(range.speed, steepest);
}

TEST(Features, AreTheirFormulas) {
    const gap::Record record = record_of_samples();
    const gap::Remainder of = remainder_of(record);
    const gap::Range range = gap::range_of({&of});
    std::vector<double> u(samples);
    std::vector<double> y(samples);
    std::vector<double> v(samples);
    for (std::size_t i = 0; i < samples; ++i) {
        u[i] = record.input[i] / range.input;
        y[i] = 2.0 * (of.simulated[i] - range.low) / (range.high - range.low) - 1.0;
        const std::size_t from = std::max<std::size_t>(i, 1) - 1;
        const std::size_t to = std::min(i + 1, samples - 1);
        v[i] = (of.simulated[to] - of.simulated[from]) / (record.time_s[to] - record.time_s[from]) / range.speed;
    }
    const auto late = [](const std::vector<double>& values, std::size_t i, std::size_t by) {
        return i < by ? 0.0 : values[i - by];
    };
    const auto share = [](std::size_t i) { return static_cast<double>(i) / (samples - 1); };
    std::vector<std::function<double(std::size_t)>> columns;
    // A twentieth of the time constant is a sample; the input comes two later.
    for (const std::size_t lag : {0, 3, 8, 16, 30, 60}) {
        columns.push_back([&, lag](std::size_t i) { return late(u, i, lag + 2); });
        columns.push_back([&, lag](std::size_t i) { return late(u, i, lag + 2) * std::fabs(late(u, i, lag + 2)); });
        columns.push_back([&, lag](std::size_t i) { return late(u, i, lag + 2) * y[i]; });
    }
    for (const std::size_t lag : {0, 6, 16, 40}) {
        columns.push_back([&, lag](std::size_t i) { return late(y, i, lag); });
        columns.push_back([&, lag](std::size_t i) { return std::pow(late(y, i, lag), 2); });
    }
    columns.push_back([&](std::size_t i) { return std::pow(y[i], 3); });
    columns.push_back([&](std::size_t i) { return y[i] > 0.6 ? y[i] - 0.6 : 0.0; });
    columns.push_back([&](std::size_t i) { return v[i]; });
    columns.push_back([&](std::size_t i) { return std::copysign(v[i] * v[i], v[i]); });
    columns.push_back([&](std::size_t i) { return std::fabs(v[i]); });
    columns.push_back([&](std::size_t i) { return std::tanh(20.0 * v[i]); });
    columns.push_back([&](std::size_t i) { return v[i] * y[i]; });
    for (const std::size_t lag : {6, 20}) {
        columns.push_back([&, lag](std::size_t i) { return std::tanh(20.0 * late(v, i, lag)); });
        columns.push_back([&, lag](std::size_t i) { return late(v, i, lag); });
    }
    for (const double waves : {1.0, 2.0, 3.0, 5.0, 8.0}) {
        columns.push_back([&, waves](std::size_t i) { return std::sin(std::numbers::pi * waves * y[i]); });
        columns.push_back([&, waves](std::size_t i) { return std::cos(std::numbers::pi * waves * y[i]); });
    }
    columns.push_back([&](std::size_t i) { return share(i); });
    columns.push_back([&](std::size_t i) { return u[i] * share(i); });
    columns.push_back([](std::size_t) { return 1.0; });
    const Eigen::MatrixXd found = gap::features_of(of, range, delay_s, time_constant_s);
    ASSERT_EQ(found.rows(), static_cast<Eigen::Index>(samples));
    ASSERT_EQ(found.cols(), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t c = 0; c < columns.size(); ++c) {
        for (std::size_t i = 0; i < samples; ++i) {
            EXPECT_NEAR(found(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)), columns[c](i), 1e-12)
                << "column " << c << ", sample " << i;
        }
    }
}

}  // namespace
