// Ovens and tanks in single steps, where what begins, ends or switches does so at the step's own ends.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "drive/stand/chance.hpp"
#include "tests/drive/oven_and_tanks.hpp"

namespace {

using oven_and_tanks::filled;
using oven_and_tanks::Held;
using oven_and_tanks::Oven;
using oven_and_tanks::Tanks;
using oven_and_tanks::warmed;

const Held off{{0.0}, {0.0}};
const Held on{{0.0}, {1.0}};
const Oven closed_oven{
    .body_j_per_k = 2.0, .body_loss_w_per_k = 0.0, .power_w_per_unit = 10.0, .ambient_c = 0.0, .start_c = 20.0};
const Tanks tank{.area_cm2 = 2.0, .outflow_cm2_per_s = 1.0, .reference_cm = 8.0, .inflow_per_unit = 8.0};

// Runge and Kutta ask at the beginning once, in the middle four times and at the end once, of six: an oven is open from
// the first moment to before the last.
TEST(OvenSteps, IsOpenFromTheFirstMomentToBeforeTheLast) {
    const auto lost = [](double from_s, double to_s) {
        Oven oven = closed_oven;
        oven.disturbance_w = 12.0;
        oven.disturbance_from_s = from_s;
        oven.disturbance_to_s = to_s;
        return (20.0 - warmed(oven, off, 1.0, 1.0)) * 2.0;
    };
    EXPECT_NEAR(lost(0.0, 2.0), 12.0, 1e-12);
    EXPECT_NEAR(lost(0.0, 1.0), 10.0, 1e-12);
    EXPECT_NEAR(lost(1.0, 2.0), 2.0, 1e-12);
    EXPECT_NEAR(lost(0.0, 0.5), 2.0, 1e-12);
}

TEST(OvenSteps, ItsFanStartsAboveItsTemperatureAndNotAtIt) {
    Oven oven = closed_oven;
    oven.body_loss_w_per_k = 1.0;
    oven.fan_share = 1.0;
    oven.fan_off_c = 1.0;
    oven.fan_on_c = 20.0;
    EXPECT_NEAR(warmed(oven, off, 0.5, 0.01), 20.0 * std::exp(-0.25), 1e-6);
    oven.fan_on_c = 19.999;
    EXPECT_NEAR(warmed(oven, off, 0.5, 0.01), 20.0 * std::exp(-0.5), 1e-6);
}

// A thermometer that lags only when it falls shows what rises at once.
TEST(OvenSteps, ShowsAtOnceWhatItDoesNotLag) {
    Oven oven = closed_oven;
    oven.falling_tau_s = 5.0;
    EXPECT_NEAR(warmed(oven, on, 1.0, 0.1), 25.0, 1e-9);
}

TEST(OvenSteps, LosesNothingThroughAWallThatNothingReaches) {
    Oven oven = closed_oven;
    oven.body_loss_w_per_k = 0.5;
    oven.wall_j_per_k = 1.0;
    oven.coupling_w_per_k = 0.0;
    oven.wall_loss_w_per_k = 0.0;
    EXPECT_EQ(stand::thermal::static_loss_w_per_k(oven), 0.5);
}

// Up to a billionth more than a step is one step: by Runge and Kutta, and by Heun.
TEST(OvenSteps, StepsAreCountedButForRounding) {
    Oven oven = closed_oven;
    oven.body_loss_w_per_k = 2.0;
    const double one = 20.0 * (1.0 - 1.0 + 0.5 - 1.0 / 6.0 + 1.0 / 24.0);
    const double half = 1.0 - 0.5 + 0.125 - 0.125 / 6.0 + 0.0625 / 24.0;
    EXPECT_NEAR(warmed(oven, off, 1.0 + 0.995e-9, 1.0), one, 1e-6);
    EXPECT_NEAR(warmed(oven, off, 1.0 + 1.005e-9, 1.0), 20.0 * half * half, 1e-6);
    Tanks tanks = tank;
    tanks.start_cm = 4.0;
    tanks.outflow_cm2_per_s = 2.0;
    EXPECT_NEAR(filled(tanks, off, 1.0 + 0.995e-9, 1.0), 4.0 * 0.5, 1e-6);
    EXPECT_NEAR(filled(tanks, off, 1.0 + 1.005e-9, 1.0), 4.0 * 0.625 * 0.625, 1e-6);
}

// Turns of half to one and a half times the mean, as the seed's first stream draws them.
TEST(TanksSteps, BubblesTurnAsTheirSeedDraws) {
    constexpr double step_s = 0.001;
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
        Tanks tanks = tank;
        tanks.outflow_cm2_per_s = 0.0;
        tanks.bubbles_share = 0.25;
        tanks.bubbles_s = 1.0;
        tanks.bubbles_seed = seed;
        stand::Chance same(seed, 1);
        const double first_s = same.between(0.5, 1.5);
        const double second_s = first_s + same.between(0.5, 1.5);
        // 4 cm/s, in bubbles 3.
        EXPECT_NEAR(filled(tanks, on, 0.999 * first_s, step_s), 4.0 * 0.999 * first_s, 1e-9);
        EXPECT_NEAR(filled(tanks, on, second_s, step_s), 4.0 * first_s + 3.0 * (second_s - first_s), 1.1 * step_s);
        EXPECT_NEAR(filled(tanks, on, second_s + 0.4, step_s), 4.0 * first_s + 3.0 * (second_s - first_s) + 1.6,
                    2.2 * step_s);
    }
}

}  // namespace
