// Loops of sampled controllers: responses and margins against closed forms, stability against roots, published designs.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "base/failure.hpp"
#include "drive/closed_loop.hpp"
#include "drive/stability.hpp"
#include "drive/tune/flat_phase.hpp"
#include "drive/tune/grid.hpp"
#include "drive/tune/load_error.hpp"
#include "drive/tune/margins.hpp"
#include "drive/tune/trial.hpp"
#include "tests/drive/plants.hpp"

namespace {

using tune::Complex;
using tune::Loop;
using tune::Margins;
using tune::SampledPlant;
constexpr double pi = tune::pi;

drive::Model integrator(double gain, double delay_s) {
    drive::Model model;
    model.gain = gain;
    model.denominator = {{1.0, 1.0}};
    model.delay_s = delay_s;
    return model;
}

drive::Model third_order() {
    drive::Model model;
    model.denominator = {{1.0, 3.0}, {3.0, 2.0}, {3.0, 1.0}, {1.0, 0.0}};
    return model;
}

double degrees(double radians) { return radians * 180.0 / pi; }

// z-transforms of textbooks: K h z^-(d+1) / (1 - z^-1), and K (1 - a) z^-(d+1) / (1 - a z^-1).
TEST(SampledPlant, HasThePulseTransferFunction) {
    const double h = 0.1;
    const SampledPlant one(integrator(2.0, 3 * h), h, "plant");
    const SampledPlant other(drive::make_fopdt(2.0, 0.5, 4 * h), h, "plant");
    const double a = std::exp(-h / 0.5);
    for (const double angle : {1e-4, 0.009, 0.02, 0.29, 0.31, 1.0, 2.0, 3.0}) {
        const Complex lag = std::polar(1.0, -angle);
        const Complex exact_one = 2.0 * h * std::pow(lag, 4) / (1.0 - lag);
        const Complex exact_other = 2.0 * (1.0 - a) * std::pow(lag, 5) / (1.0 - a * lag);
        EXPECT_LT(std::abs(one(angle / h) / exact_one - 1.0), 4e-3 * angle * angle / 10.0 + 3e-4) << angle;
        EXPECT_LT(std::abs(other(angle / h) / exact_other - 1.0), 4e-3 * angle * angle / 10.0 + 3e-4) << angle;
    }
}

// What it leaves of an integrator's aliases is theirs behind the 20th on each side, and behind the 200th where they
// count for more: 2e-4 of it below 0.3 rad a sample, and 0.3 % at Nyquist's frequency.
TEST(SampledPlant, LeavesTheAliasesBehindTheTwentieth) {
    const double h = 0.1;
    const SampledPlant plant(integrator(1.0, 0.0), h, "plant");
    for (const double angle : {0.02, 0.1, 0.29, 0.31, 1.0, 3.1}) {
        const double w = angle / h;
        const Complex lag = std::polar(1.0, -angle);
        const Complex exact = h * lag / (1.0 - lag);
        double rest = 0.0;
        constexpr int last = 200'000;
        for (int k = last; k > (angle < 0.3 ? 20 : 200); --k) {
            const double apart = 2.0 * pi * k / h;
            rest -= 1.0 / ((w + apart) * (w + apart)) + 1.0 / ((w - apart) * (w - apart));
        }
        rest -= 2.0 * h * h / (4.0 * pi * pi * last);
        const Complex left = (exact - plant(w)) * h / (1.0 - lag);
        EXPECT_NEAR(left.real() / rest, 1.0, 1e-3) << angle;
        EXPECT_LT(std::abs(left.imag() / rest), 1e-3) << angle;
        EXPECT_LT(std::abs(plant(w) / exact - 1.0), angle < 0.3 ? 2.1e-4 : 3e-3) << angle;
    }
}

TEST(SampledPlant, RefusesWhatItCannotTell) {
    drive::Model direct = drive::make_fopdt(1.0, 1.0, 0.0);
    direct.numerator = {{1.0, 1.0}};
    EXPECT_THROW(SampledPlant(direct, 0.1, "plant"), glsum::Failure);
    drive::Model growing = drive::make_fopdt(1.0, 1.0, 0.0);
    growing.denominator = {{1.0, 1.0}, {-1.0, 0.0}};
    EXPECT_THROW(SampledPlant(growing, 0.1, "plant"), glsum::Failure);
    drive::Model swinging;
    swinging.denominator = {{1.0, 2.0}, {1.0, 0.0}};
    EXPECT_THROW(SampledPlant(swinging, 0.1, "plant"), glsum::Failure);
    EXPECT_THROW(SampledPlant(plants::fopdt(), 0.0, "plant"), glsum::Failure);
}

TEST(SampledPlant, ScaleOfADeadTime) {
    // w tau + w h/2 + pi/2 = 3 pi / 4
    const SampledPlant plant(integrator(1.0, 2.0), 0.01, "plant");
    EXPECT_NEAR(plant.scale(), 0.25 * pi / 2.005, 0.02 * plant.scale());
}

// |L| = kp K h / (2 sin(angle/2)), arg L = -pi/2 - angle (d + 1/2).
TEST(Margins, OfAnIntegratorBehindADeadTime) {
    const double h = 0.1;
    const double d = 3.0;
    const SampledPlant plant(integrator(1.0, d * h), h, "plant");
    for (const double kp : {0.5, 1.5, 3.0}) {
        const Margins margins = tune::margins_of({&plant, {.kp = kp}});
        const double angle = 2.0 * std::asin(0.5 * kp * h);
        const double angle_180 = 0.5 * pi / (d + 0.5);
        EXPECT_EQ(margins.unstable_poles, 0);
        EXPECT_EQ(margins.crossings, 1);
        EXPECT_NEAR(margins.crossover, angle / h, 1e-3 * margins.crossover);
        EXPECT_NEAR(margins.phase_deg, degrees(0.5 * pi - angle * (d + 0.5)), 0.05);
        EXPECT_NEAR(margins.phase_crossover, angle_180 / h, 1e-3 * margins.phase_crossover);
        EXPECT_NEAR(margins.gain, 2.0 * std::sin(0.5 * angle_180) / (kp * h), 3e-3 * margins.gain);
        EXPECT_NEAR(margins.phase_slope, -angle * (d + 0.5), 3e-3);
    }
    // Beyond the gain margin a pair of poles grows.
    EXPECT_EQ(tune::margins_of({&plant, {.kp = 4.6}}).unstable_poles, 2);
}

// Dense sweep by another hand: largest |S| and the phase at each crossing.
TEST(Margins, AgreeWithADenseSweep) {
    const SampledPlant plant(plants::niopdt(), 0.05, "plant");
    const drive::Gains gains{
        .kp = 0.4, .ki = 0.5, .kd = 0.2, .filter_s = 0.1, .integral_order = 0.9, .derivative_order = 0.7};
    const Loop loop{&plant, gains};
    double sensitivity = 0.0;
    double phase = 180.0;
    Complex before = loop(1e-3);
    for (int i = 1; i <= 60'000; ++i) {
        const Complex now = loop(1e-3 * i);
        sensitivity = std::max(sensitivity, 1.0 / std::abs(1.0 + now));
        if ((std::abs(now) > 1.0) != (std::abs(before) > 1.0)) {
            phase = std::min(phase, degrees(std::arg(-now)));
        }
        before = now;
    }
    const Margins margins = tune::margins_of(loop);
    EXPECT_NEAR(margins.sensitivity, sensitivity, 1e-4);
    EXPECT_NEAR(margins.phase_deg, phase, 0.05);
    EXPECT_NEAR(tune::Grid(plant)(gains).sensitivity, sensitivity, 5e-3);
    EXPECT_NEAR(degrees(tune::Grid(plant)(gains).phase_rad), phase, 0.5);
}

// A lead behind a dead time: |S| has a peak at about each odd multiple of a frequency, and the second is the highest.
// It is looked for around the grid's own highest, not among the others.
TEST(Margins, OfSeveralPeaksTheHighestIsTold) {
    const SampledPlant plant(drive::make_fopdt(1.0, 1.0, 2.0), 0.05, "plant");
    const Loop loop{&plant, {.kp = 0.1, .kd = 0.7, .filter_s = 0.02}};
    double sensitivity = 0.0;
    double at = 0.0;
    for (int i = 1; i < 12'000; ++i) {
        const double now = 1.0 / std::abs(1.0 + loop(1e-3 * i));
        at = now > sensitivity ? 1e-3 * i : at;
        sensitivity = std::max(sensitivity, now);
    }
    ASSERT_NEAR(at, 4.64, 0.01);  // beside 1.74 and 7.65
    const Margins margins = tune::margins_of(loop);
    EXPECT_NEAR(margins.sensitivity_at, at, 1.5e-3);
    EXPECT_NEAR(margins.sensitivity, sensitivity, 1e-5);
    EXPECT_GE(margins.sensitivity, sensitivity);
}

// K (1 - a) z^-1 / (1 - a z^-1) is -K (1 - a) / (1 + a) at half the sample's rate, where |S| is largest: the grid ends
// there. As |L| is nowhere 1, there is no margin of phase.
TEST(Grid, EndsAtHalfTheSampleRate) {
    constexpr double h = 0.1;
    const double a = std::exp(-h / 0.05);
    const SampledPlant plant(drive::make_fopdt(0.9, 0.05, 0.0), h, "plant");
    const tune::Grid::Answer answer = tune::Grid(plant)({.kp = 1.0});
    const double least = 0.9 * (1.0 - a) / (1.0 + a);
    EXPECT_NEAR(answer.sensitivity, 1.0 / (1.0 - std::abs(plant(pi / h))), 1e-9);
    EXPECT_NEAR(answer.sensitivity, 1.0 / (1.0 - least), 2e-2);
    EXPECT_EQ(answer.phase_rad, pi);
    EXPECT_EQ(answer.unstable_poles, 0);
}

// (z - 1)(z - a) z^d + jump (kp (z - 1) + ki h z) = 0, the plant's held step beginning with `jump`
int poles_outside(double a, int d, double jump, double kp, double ki_h) {
    Eigen::VectorXd polynomial = Eigen::VectorXd::Zero(d + 3);  // rising powers
    polynomial(d) += a;
    polynomial(d + 1) += -(1.0 + a);
    polynomial(d + 2) += 1.0;
    polynomial(0) += jump * -kp;
    polynomial(1) += jump * (kp + ki_h);
    Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(d + 2, d + 2);
    companion.diagonal(-1).setOnes();
    companion.col(d + 1) = -polynomial.head(d + 2);
    const Eigen::VectorXcd roots = companion.eigenvalues();
    int outside = 0;
    for (const Complex& root : roots) {
        outside += std::abs(root) > 1.0 + 1e-9 ? 1 : 0;
    }
    return outside;
}

TEST(Stability, ByTheArgumentAsByRoots) {
    const double h = 0.1;
    std::mt19937 chance(7);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    int unstable = 0;
    for (int i = 0; i < 60; ++i) {
        const double time_s = 0.2 + 2.0 * share(chance);
        const int d = static_cast<int>(12.0 * share(chance));
        const SampledPlant plant(drive::make_fopdt(1.5, time_s, d * h), h, "plant");
        const drive::Gains gains{.kp = 4.0 * share(chance), .ki = 4.0 * share(chance)};
        const int roots =
            poles_outside(std::exp(-h / time_s), d, -1.5 * std::expm1(-h / time_s), gains.kp, gains.ki * h);
        const Margins margins = tune::margins_of({&plant, gains});
        EXPECT_EQ(margins.unstable_poles, roots) << i;
        if (margins.sensitivity < 5.0) {
            EXPECT_EQ(tune::Grid(plant)(gains).unstable_poles, roots) << i;
        }
        unstable += roots > 0 ? 1 : 0;
    }
    EXPECT_GT(unstable, 15);
    EXPECT_LT(unstable, 50);
}

// Two integrations: where L begins, beyond -180 degrees or short of it, decides.
TEST(Stability, OfTwoIntegrationsAsByRoots) {
    const double h = 0.1;
    const SampledPlant plant(integrator(1.0, 5 * h), h, "plant");
    for (const auto& [kp, ki] : {std::pair(0.5, 0.05), std::pair(0.5, 1.5), std::pair(0.1, 0.4), std::pair(3.5, 0.1)}) {
        const int roots = poles_outside(1.0, 5, h, kp, ki * h);
        EXPECT_EQ(tune::margins_of({&plant, {.kp = kp, .ki = ki}}).unstable_poles, roots) << kp << ' ' << ki;
        EXPECT_EQ(tune::Grid(plant)({.kp = kp, .ki = ki}).unstable_poles, roots) << kp << ' ' << ki;
    }
    EXPECT_EQ(poles_outside(1.0, 5, h, 0.5, 0.005), 0);
    EXPECT_EQ(poles_outside(1.0, 5, h, 0.5, 0.15), 2);
}

// Where 1 + L is below 0 right of z = 1, the real axis has a pole there.
TEST(Stability, OfGainsAgainstThePlantAsByRoots) {
    const double h = 0.1;
    const double time_s = 0.7;
    const SampledPlant resting(drive::make_fopdt(1.5, time_s, 3 * h), h, "plant");
    const SampledPlant integrating(integrator(1.0, 5 * h), h, "plant");
    for (const auto& [kp, ki] :
         {std::pair(0.5, -0.05), std::pair(-0.1, -0.2), std::pair(-3.0, -4.0), std::pair(-0.4, 0.1),
          std::pair(3.0, -0.1), std::pair(-1.0, 0.0), std::pair(-0.5, 0.0), std::pair(-4.0, 0.0)}) {
        const double a = std::exp(-h / time_s);
        const int of_resting = poles_outside(a, 3, -1.5 * std::expm1(-h / time_s), kp, ki * h);
        EXPECT_EQ(tune::margins_of({&resting, {.kp = kp, .ki = ki}}).unstable_poles, of_resting) << kp << ' ' << ki;
        const int of_integrating = poles_outside(1.0, 5, h, kp, ki * h);
        EXPECT_EQ(tune::margins_of({&integrating, {.kp = kp, .ki = ki}}).unstable_poles, of_integrating)
            << kp << ' ' << ki;
    }
}

// Without dead time, and sampled fast: zeros of s^lambda (P + kp) + ki by the argument principle on the orders as they
// are.
TEST(Stability, OfAFractionalLoopAsOfItsPseudoPolynomial) {
    drive::Model plant = plants::niopdt();
    plant.delay_s = 0.0;
    const SampledPlant sampled(plant, 1e-4, "plant");
    for (const double order : {0.6, 0.9}) {
        int growing = 0;
        for (const double ki : {0.5, 2.0, 10.0, 60.0}) {
            std::vector<drive::Term> closed;
            for (const drive::Term& term : plant.denominator) {
                closed.push_back({term.coefficient + (term.order == 0.0 ? 0.2 : 0.0), term.order + order});
            }
            closed.push_back({ki, 0.0});
            const int zeros = drive::zeros_right_of_axis(closed);
            EXPECT_EQ(tune::margins_of({&sampled, {.kp = 0.2, .ki = ki, .integral_order = order}}).unstable_poles,
                      zeros)
                << order << ' ' << ki;
            growing += zeros;
        }
        EXPECT_GT(growing, 0) << order;
    }
}

TEST(FlatPhase, GainsMeetAllThreeConditions) {
    const SampledPlant plant(plants::sopdt(), 0.02, "plant");
    for (const double integral : {0.4, 0.8, 1.0}) {
        for (const double derivative : {0.5, 1.0}) {
            const tune::Target target{0.7, 1.1, -0.3};
            const auto gains =
                tune::gains_for(target, {.filter_s = 0.1, .integral_order = integral, .derivative_order = derivative},
                                tune::point_of(plant, target.crossover), plant.step_s());
            ASSERT_TRUE(gains);
            const Loop loop{&plant, *gains};
            EXPECT_NEAR(std::abs(loop(0.7)), 1.0, 1e-9);
            EXPECT_NEAR(std::arg(-loop(0.7)), 1.1, 1e-9);
            const double e = 1e-5;
            EXPECT_NEAR(std::arg(loop(0.7 * (1 + e)) / loop(0.7 * (1 - e))) / (2 * e), -0.3, 1e-6);
        }
    }
}

// [Monje2008]: 3.13 exp(-50 s) / (433.33 s + 1), 60 degrees at 0.008 rad/s, flat.
TEST(Published, MonjesTank) {
    const SampledPlant plant(drive::make_fopdt(3.13, 433.33, 50.0), 0.01, "tank");
    const drive::Gains gains{.kp = 0.6152,
                             .ki = 0.0100,
                             .kd = 4.3867,
                             .filter_s = 0.0,
                             .integral_order = 0.8968,
                             .derivative_order = 0.4773};
    const Loop loop{&plant, gains};
    EXPECT_NEAR(std::abs(loop(0.008)), 1.0, 0.02);
    EXPECT_NEAR(degrees(std::arg(-loop(0.008))), 60.0, 1.0);
    EXPECT_NEAR(std::arg(loop(0.00808) / loop(0.00792)) / 0.02, 0.0, 0.05);
    EXPECT_TRUE(tune::margins_of(loop).stable());
}

// [Astrom1998]: 1 / (s + 1)^3 with the largest ki of a PI controller, |S| at most 1.4 and 2.
TEST(Published, LargestIntegralGainsOfAThirdOrder) {
    const SampledPlant plant(third_order(), 1e-3, "plant");
    const Margins low = tune::margins_of({&plant, {.kp = 0.633, .ki = 0.633 / 1.945}});
    const Margins high = tune::margins_of({&plant, {.kp = 1.22, .ki = 1.22 / 1.78}});
    EXPECT_NEAR(low.sensitivity, 1.40, 0.01);
    EXPECT_NEAR(high.sensitivity, 2.00, 0.02);
}

// Set point and load, stepped, against the exact loop of the continuous controller: the scheme is of first order.
TEST(Trial, TendsToTheExactLoop) {
    const drive::Model plant = plants::fopdt();
    const drive::Gains gains{
        .kp = 0.4, .ki = 0.5, .kd = 0.1, .filter_s = 0.2, .integral_order = 0.9, .derivative_order = 0.8};
    const auto largest = [&](double h) {
        const SampledPlant sampled(plant, h, "plant");
        drive::Fopid controller{.gains = gains, .sample_time_s = h, .notes = {}};
        const tune::Course course = tune::run(sampled, controller, {1.0, 0.0, 10.0});
        const std::vector<double> reference(course.time_s.size(), 1.0);
        const drive::LoopRun exact = drive::run_loop(plant, drive::to_model(gains, "pid"), course.time_s, reference);
        double worst = 0.0;
        for (std::size_t k = 0; k < exact.output.size(); ++k) {
            worst = std::max(worst, std::fabs(exact.output[k] - course.output[k]));
        }
        return worst;
    };
    const double coarse = largest(0.02);
    const double fine = largest(0.01);
    EXPECT_LT(fine, 0.012);
    EXPECT_NEAR(coarse / fine, 2.0, 0.25);
}

TEST(Trial, LoadAsItsTransform) {
    const SampledPlant plant(plants::fopdt(), 0.01, "plant");
    const drive::Gains gains{
        .kp = 0.4, .ki = 0.5, .kd = 0.1, .filter_s = 0.2, .integral_order = 0.9, .derivative_order = 0.8};
    const tune::LoadError load(plant, 25.0);
    const drive::Fopid controller{.gains = gains, .sample_time_s = 0.01, .notes = {}};
    const tune::Course with = tune::run(plant, controller, {1.0, 1.0, 25.0});
    const tune::Course without = tune::run(plant, controller, {1.0, 0.0, 25.0});
    const Eigen::VectorXd response = load.response(gains);
    double area = 0.0;
    for (std::size_t k = 2500; k < with.output.size(); ++k) {
        area += 0.01 * std::fabs(with.output[k] - without.output[k]);
    }
    for (Eigen::Index i = 0; i < response.size() - 1; i += 7) {
        const auto k = 2500 + static_cast<std::size_t>(std::lround(load.times()(i) / 0.01));
        EXPECT_NEAR(response(i), with.output[k] - without.output[k], 8e-3) << load.times()(i);
    }
    EXPECT_NEAR(load.iae(gains), area, 5e-3 * area);
}

// (1 - a) / (z - a) turns by arg(z - a) = angle + arg(1 - a / z), whose slope is a closed form. Aliases that are left
// out change it by some ten-thousandths. What the plant itself turns by is told as it is.
TEST(FlatPhase, KnowsHowThePlantsPhaseFalls) {
    const double h = 0.1;
    const double a = std::exp(-h / 0.5);
    const SampledPlant plant(drive::make_fopdt(2.0, 0.5, 0.0), h, "plant");
    for (const double w : {0.5, 2.0, 8.0}) {
        const double angle = w * h;
        const tune::PlantPoint point = tune::point_of(plant, w);
        EXPECT_EQ(point.w, w);
        EXPECT_EQ(point.value, plant(w));
        const double slope = 1.0 + a * (std::cos(angle) - a) / (1.0 - 2.0 * a * std::cos(angle) + a * a);
        EXPECT_NEAR(point.phase_slope, -angle * slope, 5e-4) << w;
        const double e = 1e-3;
        EXPECT_NEAR(point.phase_slope, std::arg(plant(w * (1.0 + e)) / plant(w * (1.0 - e))) / (2.0 * e), 1e-5) << w;
    }
}

// Without its integral of order 1 a load leaves an area that does not end: IAE = 1/ki for well damped loops with one.
TEST(Trial, AreaOfALoadIsOneOverKi) {
    const SampledPlant plant(plants::fopdt(), 0.001, "plant");
    const tune::LoadError load(plant, 40.0);
    EXPECT_NEAR(load.iae({.kp = 0.25, .ki = 0.3}), 1.0 / 0.3, 0.01);
}

TEST(Trial, LimitsHoldAndNothingWindsUp) {
    const SampledPlant plant(drive::make_fopdt(1.0, 1.0, 0.1), 0.01, "plant");
    drive::Fopid controller{
        .gains = {.kp = 4.0, .ki = 4.0}, .sample_time_s = 0.01, .low = -0.2, .high = 1.2, .notes = {}};
    const tune::Course limited = tune::run(plant, controller, {1.0, 0.1, 20.0});
    EXPECT_TRUE(limited.limited);
    EXPECT_LE(*std::max_element(limited.input.begin(), limited.input.end()), 1.2);
    EXPECT_GE(*std::min_element(limited.input.begin(), limited.input.end()), -0.2);
    EXPECT_LT(limited.overshoot, 0.05);
    EXPECT_NEAR(limited.output.back(), 1.0, 1e-3);
    EXPECT_THROW((void)tune::run(plant, controller, {1.0, 0.1, 1e5}), glsum::Failure);
}

TEST(Trial, WeightOfTheSetPointTakesTheKick) {
    const SampledPlant plant(drive::make_fopdt(1.0, 1.0, 0.1), 0.01, "plant");
    drive::Fopid controller{.gains = {.kp = 4.0, .ki = 4.0}, .sample_time_s = 0.01, .notes = {}};
    const double whole = tune::run(plant, controller, {1.0, 0.1, 20.0}).input.front();
    controller.setpoint_weight = 0.25;
    const tune::Course quarter = tune::run(plant, controller, {1.0, 0.1, 20.0});
    EXPECT_NEAR(whole, 4.04, 1e-9);
    EXPECT_NEAR(quarter.input.front(), 1.04, 1e-9);
    EXPECT_NEAR(quarter.output.back(), 1.0, 1e-3);
}

}  // namespace
