// What a controller's trial and a search's load error count, by closed forms and by hand; what a request leaves open.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/failure.hpp"
#include "drive/tune/load_error.hpp"
#include "drive/tune/trial.hpp"
#include "drive/tune/tune.hpp"
#include "tests/drive/plants.hpp"

namespace {

using tune::Course;
using tune::SampledPlant;

// y(k + 1) = a y(k) + (1 - a) (u(k) + load), u = kp (r - y): the loop of a proportional gain around a first order.
TEST(Trial, IsTheLoopThatAProportionalGainCloses) {
    constexpr double h = 0.1;
    const double a = std::exp(-h / 0.5);
    const SampledPlant plant(drive::make_fopdt(1.0, 0.5, 0.0), h, "plant");
    const drive::Fopid controller{.gains = {.kp = 2.0}, .sample_time_s = h, .notes = {}};
    const Course course = tune::run(plant, controller, {1.5, 0.25, 3.0});
    ASSERT_EQ(course.time_s.size(), 60U);
    double y = 0.0;
    double setpoint_iae = 0.0;
    double load_iae = 0.0;
    double highest = 0.0;
    for (std::size_t k = 0; k < 60; ++k) {
        EXPECT_NEAR(course.time_s[k], h * static_cast<double>(k), 1e-12);
        EXPECT_NEAR(course.output[k], y, 1e-9) << k;
        EXPECT_NEAR(course.input[k], 2.0 * (1.5 - y), 1e-9) << k;
        (k < 30 ? setpoint_iae : load_iae) += h * std::fabs(1.5 - y);
        highest = k < 30 ? std::max(highest, y) : highest;
        y = a * y + (1.0 - a) * (2.0 * (1.5 - y) + (k >= 30 ? 0.25 : 0.0));
    }
    EXPECT_NEAR(course.setpoint_iae, setpoint_iae, 1e-9);
    EXPECT_NEAR(course.load_iae, load_iae, 1e-9);
    EXPECT_EQ(course.overshoot, 0.0);
    EXPECT_FALSE(course.limited);
    // An integral carries it beyond: as a part of the set point, whatever its sign, and before the load alone.
    const drive::Fopid integral{.gains = {.ki = 4.0}, .sample_time_s = h, .notes = {}};
    for (const double setpoint : {1.5, -1.5}) {
        const Course over = tune::run(plant, integral, {setpoint, 10.0 * setpoint, 6.0});
        double most = 0.0;
        for (std::size_t k = 0; k < 60; ++k) {
            most = std::max(most, over.output[k] / setpoint);
        }
        EXPECT_GT(most, 1.2);
        EXPECT_DOUBLE_EQ(over.overshoot, most - 1.0);
    }
}

// (1 - z) u = ki h e, and kd (1 - z) / h filtered by 1 / (1 + filter / h (1 - z)).
TEST(Trial, FiltersItsDerivativeAndSumsItsIntegral) {
    constexpr double h = 0.1;
    const SampledPlant plant(drive::make_fopdt(1.0, 0.5, 20.0), h, "plant");  // nothing comes back meanwhile
    const drive::Fopid controller{
        .gains = {.kp = 1.0, .ki = 0.5, .kd = 0.3, .filter_s = 0.4}, .sample_time_s = h, .notes = {}};
    const Course course = tune::run(plant, controller, {1.0, 0.0, 5.0});
    double filtered = 0.0;
    for (std::size_t k = 0; k < 50; ++k) {
        filtered = (0.4 / h * filtered + (k == 0 ? 0.3 / h : 0.0)) / (1.0 + 0.4 / h);
        EXPECT_NEAR(course.input[k], 1.0 + 0.5 * h * static_cast<double>(k + 1) + filtered, 1e-9) << k;
    }
}

// Orders of a half. The weights of (1 - z)^-0.5 are 1, 0.5, 0.375, 0.3125, those of (1 - z)^0.5 are 1, -0.5, -0.125,
// -0.0625; sums of them act. What acts at once is given a part of the set point.
TEST(Trial, SumsFractionalOrdersAndWeighsTheSetPoint) {
    constexpr double h = 0.25;
    const SampledPlant plant(drive::make_fopdt(1.0, 0.5, 20.0), h, "plant");  // nothing comes back meanwhile
    const drive::Fopid controller{
        .gains = {.kp = 1.5, .ki = 0.6, .kd = 0.8, .integral_order = 0.5, .derivative_order = 0.5},
        .sample_time_s = h,
        .setpoint_weight = 0.25,
        .notes = {}};
    const Course course = tune::run(plant, controller, {2.0, 0.0, 1.0});
    const double integral[] = {1.0, 1.5, 1.875, 2.1875};
    const double derivative[] = {1.0, 0.5, 0.375, 0.3125};
    for (std::size_t k = 0; k < 4; ++k) {
        const double at_once = 1.5 + 0.8 / 0.5 * derivative[k];  // h^0.5 is a half
        EXPECT_NEAR(course.input[k], 2.0 * (0.25 * at_once + 0.6 * 0.5 * integral[k]), 1e-12) << k;
    }
}

// In velocity form: an input that is held at its limit goes on from there as soon as it may.
TEST(Trial, StopsAtItsLimitsAndGoesOnFromThere) {
    constexpr double h = 0.1;
    const double a = std::exp(-h / 0.5);
    const SampledPlant plant(drive::make_fopdt(1.0, 0.5, 0.0), h, "plant");
    const auto course_within = [&](double low, double high) {
        const drive::Fopid controller{.gains = {.kp = 2.0, .ki = 6.0},
                                      .sample_time_s = h,
                                      .low = low,
                                      .high = high,
                                      .setpoint_weight = 0.5,
                                      .notes = {}};
        return tune::run(plant, controller, {1.0, -0.5, 3.0});
    };
    const auto expect_steps = [&](const Course& course, double low, double high) {
        double y = 0.0;
        double before = 0.0;
        double u = 0.0;
        for (std::size_t k = 0; k < 60; ++k) {
            u += (k == 0 ? 0.5 * 2.0 : 0.0) + 6.0 * h * (1.0 - y) - 2.0 * (y - before);
            u = std::clamp(u, low, high);
            EXPECT_NEAR(course.output[k], y, 1e-9) << k;
            EXPECT_NEAR(course.input[k], u, 1e-9) << k;
            before = y;
            y = a * y + (1.0 - a) * (u + (k >= 30 ? -0.5 : 0.0));
        }
    };
    const Course free = course_within(-100.0, 100.0);
    EXPECT_FALSE(free.limited);
    expect_steps(free, -100.0, 100.0);
    const double most = *std::max_element(free.input.begin(), free.input.end());
    const Course limited = course_within(1.1, 0.95 * most);
    EXPECT_TRUE(limited.limited);
    expect_steps(limited, 1.1, 0.95 * most);
}

TEST(Trial, TakesTwoToHalfOfTheMostSamples) {
    const SampledPlant plant(drive::make_fopdt(1.0, 0.5, 0.0), 0.5, "plant");
    const drive::Fopid controller{.gains = {.kp = 1.0}, .sample_time_s = 0.5, .notes = {}};
    EXPECT_EQ(tune::most_trial_samples, 400'000U);
    EXPECT_EQ(tune::run(plant, controller, {1.0, 0.0, 1.0}).time_s.size(), 4U);
    EXPECT_EQ(tune::run(plant, controller, {1.0, 0.0, 1.1}).time_s.size(), 6U);
    EXPECT_THROW((void)tune::run(plant, controller, {1.0, 0.0, 0.5}), glsum::Failure);
    EXPECT_THROW((void)tune::run(plant, controller, {1.0, 0.0, 100'000.5}), glsum::Failure);
    const tune::Trial usual;
    EXPECT_EQ(usual.setpoint, 1.0);
    EXPECT_EQ(usual.load, 0.5);
    EXPECT_EQ(usual.until_s, 10.0);
}

// A proportional gain leaves y = (1 - e^(-(1 + k) t / T)) / (1 + k) of a load: its area ends with a rest, half of whose
// last step is not there.
TEST(LoadError, IsTheAreaOfAResponseThatRests) {
    constexpr double k = 1.0;
    constexpr double t = 0.5;
    constexpr double until_s = 4.0;
    const SampledPlant plant(drive::make_fopdt(1.0, t, 0.0), 1e-3, "plant");
    const tune::LoadError load(plant, until_s);
    ASSERT_EQ(load.times().size(), 200);
    EXPECT_NEAR(load.times()(0), until_s / 200.0, 1e-12);
    EXPECT_NEAR(load.times()(199), until_s, 1e-12);
    const double rate = (1.0 + k) / t;
    const auto response = load.response({.kp = k});
    for (const Eigen::Index i : {20, 60, 199}) {
        EXPECT_NEAR(response(i), (1.0 - std::exp(-rate * load.times()(i))) / (1.0 + k), 2e-3) << i;
    }
    EXPECT_NEAR(load.iae({.kp = k}), (until_s - (1.0 - std::exp(-rate * until_s)) / rate) / (1.0 + k), 2e-3);
    // With a filtered derivative the loop is (T s + 1)(f s + 1) + k (f s + 1) + kd s over f s + 1; it rests at the
    // same.
    EXPECT_NEAR(load.response({.kp = k, .kd = 0.2, .filter_s = 0.1})(199), 0.5, 2e-3);
    EXPECT_LT(load.response({.kp = k, .kd = 0.2, .filter_s = 0.1})(10), response(10) - 0.02);
}

// Lanczos' factors of 512 frequencies average the damped response over a 512th of the horizon on either side: of a
// swing that takes a 128th of it, half of which that is, 2 / pi is left.
TEST(LoadError, AveragesOverA512thOfTheHorizonOnEitherSide) {
    constexpr double until_s = 4.0;
    constexpr double w = 128.0 * 2.0 * std::numbers::pi / until_s;
    constexpr double damping = 1e-3;
    drive::Model swing;
    swing.denominator = {{1.0 / (w * w), 2.0}, {2.0 * damping / w, 1.0}, {1.0, 0.0}};
    const tune::LoadError load(SampledPlant(swing, 1e-3, "plant"), until_s);
    const auto response = load.response({.kp = 0.0});
    const double rate = std::log(1e4) / (2.0 * until_s);  // of the damping, 1e-4 over two horizons
    const double w_damped = w * std::sqrt(1.0 - damping * damping);
    const auto damped = [&](double t) {
        const double sine = damping / std::sqrt(1.0 - damping * damping) * std::sin(w_damped * t);
        return std::exp(-rate * t) * (1.0 - std::exp(-damping * w * t) * (std::cos(w_damped * t) + sine));
    };
    double largest = 0.0;
    for (Eigen::Index i = 4; i < 190; ++i) {  // but for the ends of the period, which are cut off
        const double t = load.times()(i);
        double mean = 0.0;
        constexpr int parts = 200;
        for (int part = 0; part < parts; ++part) {
            mean += damped(t + until_s / 512.0 * ((2.0 * part + 1.0) / parts - 1.0)) / parts;
        }
        EXPECT_NEAR(response(i), std::exp(rate * t) * mean, 5e-4) << i;
        largest = std::max(largest, std::fabs(response(i) - 1.0));
    }
    EXPECT_NEAR(largest, 2.0 / std::numbers::pi, 0.03);
}

tune::Request with_margin(double degrees, double crossover) {
    tune::Request request;
    request.margin_deg = degrees;
    request.crossover = crossover;
    request.sample_time_s = 0.01;
    return request;
}

// What is left open has the value that the request's page says.
TEST(Tune, FillsWhatARequestLeavesOpen) {
    const tune::Request nothing;
    EXPECT_EQ(nothing.setpoint_weight, 1.0);
    EXPECT_EQ(nothing.setpoint, 1.0);
    EXPECT_EQ(nothing.low, -INFINITY);
    EXPECT_EQ(nothing.high, INFINITY);
    EXPECT_EQ(tune::worthwhile_saving, 0.03);
    // An integrator: 0.5 of load; the filter a tenth of the crossover's time; 20 crossovers' times.
    drive::Model motor;
    motor.denominator = {{0.4, 2.0}, {1.0, 1.0}};
    const tune::Tuned tuned = tune::tune(motor, with_margin(60.0, 2.0), "plant");
    EXPECT_EQ(tuned.trial.load, 0.5);
    EXPECT_EQ(tuned.trial.until_s, 10.0);
    EXPECT_EQ(*tuned.request.filter_s, 0.05);
    EXPECT_EQ(tuned.wish.sensitivity, 2.0);
    ASSERT_TRUE(tuned.integer);
    // The margins with 0.8 and 1.25 of the plant's gain are those of such plants.
    for (const auto& [gain, margin] :
         {std::pair(0.8, tuned.integer->weak_deg), std::pair(1.25, tuned.integer->strong_deg)}) {
        drive::Model other = motor;
        other.gain = gain;
        const SampledPlant plant(other, 0.01, "plant");
        EXPECT_NEAR(tune::margins_of({&plant, tuned.integer->controller.gains}).phase_deg, margin, 1e-6) << gain;
    }
    // A flat phase at a crossover leaves an integer PID nothing free; orders are tried on a grid of 77 by 77, some 6000
    // places, and up to 400 more from each of the eight best. Without a flat phase its slope is free: 400 places, and
    // as many.
    EXPECT_EQ(tuned.integer->tries, 1U);
    EXPECT_GT(tuned.fractional->tries, 77U * 77U + 8U);
    EXPECT_LE(tuned.fractional->tries, 77U * 77U + 8U * 400U);
    EXPECT_GT(tuned.steep->tries, 400U + 8U);
    EXPECT_LE(tuned.steep->tries, 400U + 8U * 400U);
    // The area that was searched is one without limits, of a load of 1.
    EXPECT_NEAR(tuned.integer->course.load_iae / 0.5 / tuned.integer->load_iae, 1.0, 0.03);
}

// A margin of 20 degrees alone has |S| = 2.88; 1.3 times as much may be there. The filter is no shorter than a sample.
TEST(Tune, AllowsSmallMarginsTheirSensitivity) {
    tune::Request request = with_margin(20.0, 12.0);
    request.sample_time_s = 0.02;
    const tune::Tuned tuned = tune::tune(drive::make_fopdt(1.0, 0.5, 0.02), request, "plant");
    EXPECT_NEAR(tuned.wish.sensitivity, 1.3 / (2.0 * std::sin(tune::pi / 18.0)), 1e-12);
    EXPECT_EQ(*tuned.request.filter_s, 0.02);
    EXPECT_NEAR(tuned.trial.until_s, 20.0 / 12.0, 1e-12);
}

bool is_refused(tune::Request request) {
    try {
        // No controller is as good as that: nothing is judged.
        (void)tune::tune(plants::fopdt(), request, "plant");
    } catch (const glsum::Failure&) {
        return true;
    }
    return false;
}

// Limits are taken up to what they exclude: the input that holds the set point, the one that stands against the load, a
// quarter of the samples' frequency.
TEST(Tune, TakesLimitsThatJustDo) {
    tune::Request request = with_margin(60.0, 0.6);
    request.high = 1.0;
    request.low = 0.5;
    EXPECT_FALSE(is_refused(request));
    request.high = std::nextafter(1.0, 0.0);
    EXPECT_TRUE(is_refused(request));
    request.high = 1.0;
    request.low = std::nextafter(0.5, 1.0);
    EXPECT_TRUE(is_refused(request));
    request = with_margin(60.0, 0.25 * 2.0 * tune::pi / 0.01);
    EXPECT_TRUE(is_refused(request));
}

}  // namespace
