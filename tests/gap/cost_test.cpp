// What fits minimise: how it changes by each free number, over the difference that the number's scale says.
#include "gap/drive/cost.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "gap/drive/candidate.hpp"
#include "gap/drive/effect.hpp"
#include "gap/drive/start.hpp"

namespace {

struct Made {
    std::vector<gap::Record> records;
    gap::Study study;
    explicit Made(bool refit)
        : study{{gap::form_of(drive::make_fopdt(2.0, 1.0, 0.0)), refit}, {}, {}, {}, 0.01, 0.001, 0} {
        gap::Record record;
        record.name = "made";
        record.usual_interval_s = 0.1;
        for (int i = 0; i < 60; ++i) {
            record.time_s.push_back(0.1 * i);
            record.input.push_back(i < 20 ? 0.5 : 1.0);
            record.output.push_back(std::sin(0.3 * i));
        }
        records.assign(2, record);
        study.counts = gap::all_count(records);
        for (const gap::Record& one : records) {
            study.courses.emplace_back(one, 1);
        }
        study.scales = gap::scales_of(gap::model_of(study.base.form), records, {});
    }
};

// The residuals at some numbers, in units of their scales.
std::vector<double> residuals_at(const gap::Cost& cost, const std::vector<double>& at) {
    std::vector<double> residuals(static_cast<std::size_t>(cost.num_residuals()));
    const double* const parameters[] = {at.data()};
    EXPECT_TRUE(cost.Evaluate(parameters, residuals.data(), nullptr));
    return residuals;
}

// By rows of the residuals, numbers side by side.
std::vector<double> slopes_at(const gap::Cost& cost, const std::vector<double>& at) {
    const auto rows = static_cast<std::size_t>(cost.num_residuals());
    std::vector<double> residuals(rows);
    std::vector<double> slopes(rows * at.size(), 7.0);  // whatever was there
    const double* const parameters[] = {at.data()};
    double* jacobians[] = {slopes.data()};
    EXPECT_TRUE(cost.Evaluate(parameters, residuals.data(), jacobians));
    return slopes;
}

constexpr double step = 3e-4;

void expect_differences(const gap::Cost& cost, const std::vector<double>& at, double by) {
    const std::vector<double> here = residuals_at(cost, at);
    const std::vector<double> slopes = slopes_at(cost, at);
    for (std::size_t p = 0; p < at.size(); ++p) {
        std::vector<double> moved = at;
        moved[p] += by;
        const std::vector<double> there = residuals_at(cost, moved);
        for (std::size_t row = 0; row < here.size(); ++row) {
            ASSERT_NEAR(slopes[row * at.size() + p], (there[row] - here[row]) / by, 1e-9) << row << " by " << p;
        }
    }
}

// A record's own numbers move its residuals alone, the base's those of all.
TEST(CostSlopes, AreDifferencesByEachNumber) {
    const Made made(true);
    gap::Candidate candidate;
    candidate.base = gap::base_of(made.study);
    for (const gap::Record& record : made.records) {
        candidate.own.push_back(gap::state_of(made.study, record));
    }
    std::vector<std::size_t> which;
    std::vector<double> at;
    gap::Candidate counted = candidate;
    for (const gap::FreeParameter* number : gap::free_numbers(counted, false)) {
        which.push_back(which.size());
        at.push_back(number->value / number->scale);
    }
    ASSERT_GT(which.size(), 3U);
    const gap::Cost cost(made.study, candidate, false, which, nullptr);
    ASSERT_EQ(cost.num_residuals(), 120);
    expect_differences(cost, at, step);
}

// Upwards up to a number's upper bound, downwards beyond.
TEST(CostSlopes, StayWithinTheBounds) {
    const Made made(false);
    const gap::Effect& lag = gap::effect_named("sensor_lag");
    gap::Candidate candidate;
    candidate.effects = {&lag};
    candidate.lasting = {gap::parameters_of(lag, made.study.scales, 0)};
    candidate.own.resize(2);
    gap::FreeParameter& tau = candidate.lasting[0][0];
    tau.scale = 0.5;
    tau.value = 0.5;
    tau.upper = 0.5 + step * 0.5;
    expect_differences({made.study, candidate, false, {0}, nullptr}, {1.0}, step);
    tau.upper = 0.5 + 0.99 * step * 0.5;
    expect_differences({made.study, candidate, false, {0}, nullptr}, {1.0}, -step);
}

}  // namespace
