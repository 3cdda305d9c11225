// Margins and the search's grid where a loop is unusual: several crossings, weak integrals, long dead times, the limit
// of stability. Closed forms, and what a margin is by its definition.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drive/tune/grid.hpp"
#include "drive/tune/margins.hpp"
#include "tests/drive/plants.hpp"

namespace {

using tune::Complex;
using tune::Loop;
using tune::Margins;
using tune::SampledPlant;
constexpr double pi = tune::pi;

drive::Model integrator(double delay_s) {
    drive::Model model;
    model.denominator = {{1.0, 1.0}};
    model.delay_s = delay_s;
    return model;
}

double degrees(double radians) { return radians * 180.0 / pi; }

// Crossings and peaks are found between the sweep's points to 1e-9: |L| is 1 and the phase is -180 degrees there.
TEST(Margins, AreWhatTheirDefinitionsSay) {
    const SampledPlant plant(plants::niopdt(), 0.05, "plant");
    const Loop loop{&plant,
                    {.kp = 0.4, .ki = 0.5, .kd = 0.2, .filter_s = 0.1, .integral_order = 0.9, .derivative_order = 0.7}};
    const Margins margins = tune::margins_of(loop);
    EXPECT_EQ(margins.crossings, 1);
    EXPECT_NEAR(std::abs(loop(margins.crossover)), 1.0, 1e-9);
    EXPECT_NEAR(margins.phase_deg, degrees(std::arg(-loop(margins.crossover))), 1e-6);
    EXPECT_NEAR(std::arg(-loop(margins.phase_crossover)), 0.0, 1e-8);
    EXPECT_NEAR(margins.gain * std::abs(loop(margins.phase_crossover)), 1.0, 1e-9);
    const auto sensitivity = [&](double w) { return 1.0 / std::abs(1.0 + loop(w)); };
    EXPECT_NEAR(margins.sensitivity, sensitivity(margins.sensitivity_at), 1e-9);
    EXPECT_GT(margins.sensitivity, sensitivity(margins.sensitivity_at * 1.003));
    EXPECT_GT(margins.sensitivity, sensitivity(margins.sensitivity_at / 1.003));
    double complementary = 0.0;
    for (double w = 1e-3; w < plant.nyquist(); w *= 1.0005) {
        complementary = std::max(complementary, std::abs(loop(w)) * sensitivity(w));
        EXPECT_LE(sensitivity(w), margins.sensitivity + 1e-9) << w;
    }
    EXPECT_NEAR(margins.complementary, complementary, 1e-3);
    const double e = 1e-5;
    EXPECT_NEAR(margins.phase_slope,
                std::arg(loop(margins.crossover * (1.0 + e)) / loop(margins.crossover * (1.0 - e))) / (2.0 * e), 1e-5);
}

// A plant that swings is passed twice: k / (s^2 + 2 d s + 1) has (1 - w^2)^2 + (2 d w)^2 = k^2 there. The highest is
// the crossover, and the least margin counts.
TEST(Margins, OfSeveralCrossingsAreTheHighestAndTheLeast) {
    constexpr double d = 0.05;
    constexpr double k = 0.5;
    drive::Model swings;
    swings.denominator = {{1.0, 2.0}, {2.0 * d, 1.0}, {1.0, 0.0}};
    const SampledPlant plant(swings, 1e-4, "plant");
    const Margins margins = tune::margins_of({&plant, {.kp = k}});
    const double half = 1.0 - 2.0 * d * d;
    const double root = std::sqrt(half * half - (1.0 - k * k));
    const auto margin_at = [&](double w) { return 180.0 - degrees(std::atan2(2.0 * d * w, 1.0 - w * w)); };
    EXPECT_EQ(margins.crossings, 2);
    EXPECT_NEAR(margins.crossover, std::sqrt(half + root), 1e-4);
    EXPECT_NEAR(margins.phase_deg, margin_at(margins.crossover), 0.02);
    EXPECT_LT(margins.phase_deg, margin_at(std::sqrt(half - root)));
    // Behind a dead time of a turn and a half at the lower crossing, that one has the less to spare.
    swings.delay_s = 1.6 * pi;
    const SampledPlant late(swings, 1e-3, "plant");
    const Margins other = tune::margins_of({&late, {.kp = k}});
    const auto left_at = [&](double w) { return margin_at(w) - degrees(w * (swings.delay_s + 0.5e-3)); };
    const auto around = [](double angle) { return angle - 360.0 * std::floor(angle / 360.0 + 0.5); };
    EXPECT_EQ(other.crossings, 2);
    EXPECT_NEAR(around(other.phase_deg),
                around(std::min(left_at(std::sqrt(half - root)), left_at(std::sqrt(half + root)))), 0.1);
}

// Far below the plant's own frequencies, |kp + ki / (j w)| = 1.
TEST(Margins, OfAWeakIntegralAreFoundFarBelow) {
    const SampledPlant plant(plants::fopdt(), 0.01, "plant");
    for (const double ki : {1e-6, 1e-4}) {
        const Margins margins = tune::margins_of({&plant, {.kp = 0.1, .ki = ki}});
        EXPECT_EQ(margins.crossings, 1) << ki;
        EXPECT_NEAR(margins.crossover / (ki / std::sqrt(0.99)), 1.0, 1e-3) << ki;
        EXPECT_NEAR(margins.phase_deg, 180.0 - degrees(std::acos(0.1)), 0.1) << ki;
        EXPECT_EQ(margins.unstable_poles, 0) << ki;
    }
    // Without one there is no crossing, and nothing to say of it.
    const Margins none = tune::margins_of({&plant, {.kp = 0.1}});
    EXPECT_EQ(none.crossings, 0);
    EXPECT_EQ(none.crossover, 0.0);
    EXPECT_EQ(none.phase_deg, 180.0);
    EXPECT_EQ(none.phase_slope, 0.0);
    EXPECT_TRUE(none.stable());
}

// The phase -pi/2 - a (d + 1/2) is -180 degrees at a = (pi/2 + 2 pi k) / (d + 1/2), and |L| falls: beyond the first the
// loop is unstable by a pair for each that is above 1, and the next may still be raised.
TEST(Margins, OfALoopBeyondItsLimitAreThoseOfTheNextTurn) {
    constexpr double h = 0.01;
    constexpr double d = 200.0;
    const SampledPlant plant(integrator(d * h), h, "plant");
    const auto turn = [&](double k) { return (0.5 * pi + 2.0 * pi * k) / (d + 0.5); };
    const auto size = [&](double k) { return h / (2.0 * std::sin(0.5 * turn(k))); };
    for (const int above : {0, 1, 2, 5}) {
        const double kp = above == 0 ? 0.5 / size(0.0) : 1.0 / std::sqrt(size(above - 1) * size(above));
        const Margins margins = tune::margins_of({&plant, {.kp = kp}});
        EXPECT_EQ(margins.unstable_poles, 2 * above) << kp;
        EXPECT_NEAR(margins.phase_crossover, turn(above) / h, 1e-3 * margins.phase_crossover) << kp;
        EXPECT_NEAR(margins.gain * kp * size(above), 1.0, 3e-3) << kp;
    }
}

// Where L is -1, no count of poles can be given; beside that it can. At half the sample's rate it is real.
TEST(Margins, OfALoopThroughMinusOneAreNone) {
    const SampledPlant plant(drive::make_fopdt(1.0, 0.05, 0.0), 0.1, "plant");
    const auto beside = [&](double by) {
        return tune::margins_of(plant, {[&plant, by](double w) { return -(1.0 + by) / plant(w); }, 0.0}).unstable_poles;
    };
    EXPECT_EQ(beside(0.0), -1);
    EXPECT_NE(beside(2e-9), -1);
    const double through = 1.0 / std::abs(plant(plant.nyquist()));
    EXPECT_EQ(tune::margins_of({&plant, {.kp = 0.99 * through}}).unstable_poles, 0);
    EXPECT_EQ(tune::margins_of({&plant, {.kp = 1.01 * through}}).unstable_poles, 1);
    const Margins at_the_end = tune::margins_of({&plant, {.kp = 0.5 * through}});
    EXPECT_NEAR(at_the_end.sensitivity, 2.0, 1e-9);
    EXPECT_NEAR(at_the_end.sensitivity_at, plant.nyquist(), 1e-6 * plant.nyquist());
}

// Beyond 40 rad of the dead time's phase every phase is taken to occur: |S| is up to 1 / (1 - |L|), and |L| has to be
// below 1.
TEST(Grid, TakesEveryPhaseWhereTheDeadTimeSpins) {
    constexpr double h = 0.01;
    constexpr double t = 0.02;
    const SampledPlant plant(drive::make_fopdt(1.0, t, 10.0), h, "plant");
    const tune::Grid grid(plant);
    const tune::Grid::Answer calm = grid({.kp = 0.5});
    EXPECT_NEAR(calm.sensitivity, 2.0, 0.02);  // |L| is still a half, but for the lag
    EXPECT_EQ(calm.unstable_poles, 0);
    EXPECT_EQ(calm.phase_rad, pi);
    const tune::Grid::Answer loud = grid({.kp = 1.05});
    EXPECT_EQ(loud.unstable_poles, 1);
    EXPECT_EQ(loud.sensitivity, INFINITY);
    EXPECT_EQ(loud.phase_rad, 0.0);
    // At 40 rad itself it is still followed: twenty half turns have gone by, and as many poles are unstable.
    const double top = plant.nyquist();
    ASSERT_EQ(top * (40.0 / top), 40.0);
    const auto at_the_end = [&](double phase) {
        return tune::Grid(SampledPlant(drive::make_fopdt(1.0, t, phase / top), h, "plant"))({.kp = 100.0});
    };
    EXPECT_GT(at_the_end(40.0).unstable_poles, 10);
    EXPECT_EQ(at_the_end(40.01).unstable_poles, 1);
    // Where |L| has fallen before, nothing spins: 1 / s with the same dead time and a gain of a half of its limit.
    const SampledPlant slow(integrator(10.0), h, "plant");
    const tune::Grid::Answer fine = tune::Grid(slow)({.kp = 0.25 * pi / 10.0});
    const Margins swept = tune::margins_of({&slow, {.kp = 0.25 * pi / 10.0}});
    EXPECT_EQ(fine.unstable_poles, 0);
    EXPECT_NEAR(fine.sensitivity, swept.sensitivity, 5e-3 * swept.sensitivity);
    EXPECT_NEAR(degrees(fine.phase_rad), swept.phase_deg, 0.2);
    EXPECT_EQ(tune::Grid(slow)({.kp = 0.55 * pi / 10.0}).unstable_poles, 2);
}

// The grid sees of a plain loop what the sweep does, with a derivative and its filter, too, and without a dead time.
TEST(Grid, SeesWhatTheSweepDoes) {
    for (const double delay_s : {0.0, 0.4}) {
        const SampledPlant plant(drive::make_sopdt(2.0, 0.5, delay_s), 0.02, "plant");
        for (const double order : {1.0, 0.6}) {
            const drive::Gains gains{
                .kp = 0.8, .ki = 0.6, .kd = 0.2, .filter_s = 0.05, .integral_order = order, .derivative_order = order};
            const tune::Grid::Answer grid = tune::Grid(plant)(gains);
            const Margins swept = tune::margins_of({&plant, gains});
            EXPECT_EQ(grid.unstable_poles, swept.unstable_poles);
            EXPECT_NEAR(grid.sensitivity, swept.sensitivity, 5e-3 * swept.sensitivity);
            EXPECT_NEAR(degrees(grid.phase_rad), swept.phase_deg, 0.5);
        }
    }
}

// 45 degrees below the beginning of a plant that never is above -135 degrees: two integrations behind a dead time, w
// (tau
// + h/2) = pi/4. One that always is: half of Nyquist's frequency.
TEST(SampledPlant, ScaleOfPlantsWithoutAPhaseOf135Degrees) {
    drive::Model twice;
    twice.denominator = {{1.0, 2.0}};
    twice.delay_s = 0.5;
    EXPECT_NEAR(SampledPlant(twice, 0.01, "plant").scale(), 0.25 * pi / 0.505, 0.02 * 0.25 * pi / 0.505);
    EXPECT_EQ(SampledPlant(twice, 0.01, "plant").integrations(), 2.0);
    const SampledPlant quick(drive::make_fopdt(1.0, 1.0, 0.0), 0.01, "plant");
    EXPECT_NEAR(quick.scale(), 0.5 * quick.nyquist(), 0.02 * 0.5 * quick.nyquist());
    EXPECT_EQ(quick.nyquist(), pi / 0.01);
    EXPECT_EQ(quick.sign(), 1.0);
    EXPECT_EQ(quick.integrations(), 0.0);
    drive::Model down = drive::make_fopdt(-1.0, 1.0, 0.0);
    EXPECT_EQ(SampledPlant(down, 0.01, "plant").sign(), -1.0);
    down.numerator = {{-1.0, 0.0}};
    EXPECT_EQ(SampledPlant(down, 0.01, "plant").sign(), 1.0);
}

}  // namespace
