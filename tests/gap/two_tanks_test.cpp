// The upper of two tanks runs over: against a plain integration of both levels, and by closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/gap/effect_case.hpp"

namespace {

using effect_test::h;
using effect_test::largest_difference;
using effect_test::staircase;
using effect_test::Values;

constexpr double gain = 2.0;
constexpr double lag_s = 3.0;

struct Brim {
    double limit;
    double before_s;
    double spill;
};

gap::Scenario lower(double operating_output) {
    gap::Scenario scenario;
    scenario.model = drive::make_fopdt(gain, lag_s, 0.0);
    scenario.operating_output = operating_output;
    return scenario;
}

// Both levels by Euler's rule, a thousand steps to an interval.
Values integrated(const Brim& brim, double operating_output, const gap::Record& record) {
    constexpr int steps = 1000;
    const double dt = h / steps;
    const double limit = brim.limit - operating_output;
    Values levels;
    double upper = 0.0;
    double below = 0.0;
    for (std::size_t k = 0; k < record.size(); ++k) {
        levels.push_back(below + operating_output);
        const double rest = gain * record.input[k];
        for (int i = 0; i < steps; ++i) {
            const double over = upper >= limit && rest > limit ? rest - limit : 0.0;
            below = std::min(limit, below + dt / lag_s * (std::min(upper, limit) + brim.spill * over - below));
            upper = std::min(limit, upper + dt / brim.before_s * (rest - upper));
        }
    }
    return levels;
}

TEST(TwoTanks, RunOverAsIntegrated) {
    const gap::Record record = staircase();
    for (const double operating_output : {0.0, -0.3}) {
        // Of the last the lower one is full, too.
        for (const Brim& brim : {Brim{1.2, 0.7, 0.0}, Brim{1.2, 0.7, 0.4}, Brim{1.0, 0.3, 1.0}}) {
            gap::Scenario scenario = lower(operating_output);
            gap::effect_named("end_stop").add_to(scenario, Values{brim.limit, 0.0, brim.before_s, brim.spill});
            const Values ours = gap::simulate(scenario, gap::Course(record, 1));
            EXPECT_LT(largest_difference(ours, integrated(brim, operating_output, record)), 1e-3) << brim.spill;
        }
    }
    gap::Scenario scenario = lower(0.0);
    gap::effect_named("end_stop").add_to(scenario, Values{1.0, 0.0, 0.3, 1.0});
    const Values full = gap::simulate(scenario, gap::Course(record, 1));
    EXPECT_EQ(*std::max_element(full.begin(), full.end()), 1.0);
}

// 2 (1 - e^-t) is at 1.2 after ln 2.5, and then 1.2 + 0.3 (2 - 1.2) leaves: the mean is exact however long the step.
TEST(TwoTanks, PassOnTheMeanOfEachStep) {
    gap::Scenario scenario = lower(0.0);
    gap::effect_named("end_stop").add_to(scenario, Values{1.2, 0.0, 1.0, 0.3});
    ASSERT_EQ(scenario.input.size(), 1U);
    Values held{1.0, 1.0, 0.25};
    scenario.input[0](held, {0.0, 2.0, held.size()});
    const double full_s = std::log(2.5);
    EXPECT_NEAR(gain * held[0], 0.5 * (2.0 * full_s - 1.2 + (2.0 - full_s) * 1.44), 1e-14);
    EXPECT_NEAR(gain * held[1], 1.44, 1e-14);
    EXPECT_NEAR(gain * held[2], 0.5 + 0.7 * 0.5 * (1.0 - std::exp(-2.0)), 1e-14);  // falls from the brim
    // A level that begins above the brim is at it.
    scenario = lower(0.0);
    scenario.initial_output = 5.0;
    gap::effect_named("end_stop").add_to(scenario, Values{1.2, 0.0, 1.0, 0.3});
    held = {0.25};
    scenario.input[0](held, {0.0, 2.0, held.size()});
    EXPECT_NEAR(gain * held[0], 0.5 + 0.7 * 0.5 * (1.0 - std::exp(-2.0)), 1e-14);
}

TEST(TwoTanks, AreOneWithoutALagBefore) {
    gap::Scenario one = lower(0.0);
    gap::effect_named("end_stop").add_to(one, Values{1.2, 0.0, 0.0, 0.3});
    EXPECT_TRUE(one.input.empty());
    EXPECT_TRUE(one.forces.stop);
    gap::Scenario closed = lower(0.0);
    closed.model.gain = 0.0;
    gap::effect_named("end_stop").add_to(closed, Values{1.2, 0.0, 1.0, 0.3});
    EXPECT_TRUE(closed.input.empty());
}

}  // namespace
