// The loop that a generated controller is measured in, held against recursions by hand.
#include "bench/steppers/controller/loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bench/steppers/controller/controller_spec.hpp"
#include "bench/steppers/controller/held_controller.hpp"
#include "drive/model.hpp"
#include "tests/refusal.hpp"

namespace {

constexpr double kp = 1.5;
constexpr double ki = 0.8;
constexpr double integral_order = 0.9;
constexpr double step_s = 0.05;
constexpr double time_constant_s = 2.0;
constexpr double gain = 1.2;

// T (y_k - y_k-1) / h + y_k = K u of `delay` samples and one before, u = kp e + the sum of ki h^v times the sum of
// order 1 - v of e.
std::vector<double> loop_by_hand(double h, std::size_t delay, std::size_t count) {
    std::vector<double> error;
    std::vector<double> control;
    std::vector<double> output;
    double integral = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
        const double acts = k > delay ? control[k - 1 - delay] : 0.0;
        output.push_back(k == 0 ? 0.0
                                : (time_constant_s / h * output.back() + gain * acts) / (time_constant_s / h + 1.0));
        error.push_back((2 * k < count ? 1.0 : generate::second_level) - output.back());
        double weight = 1.0;
        double sum = 0.0;
        for (std::size_t j = 0; j <= k; ++j) {
            sum += weight * error[k - j];
            weight *= 1.0 - (2.0 - integral_order) / (static_cast<double>(j) + 1.0);
        }
        integral += ki * std::pow(h, integral_order) * sum;
        control.push_back(kp * error.back() + integral);
    }
    return output;
}

TEST(ControllerLoop, SamplesAsItsRecursionsDo) {
    constexpr std::size_t count = 400;
    for (const std::size_t delay : {0U, 1U, 4U}) {
        generate::ControllerSpec spec;
        spec.controller.gains = {};
        spec.controller.gains.kp = kp;
        spec.controller.gains.ki = ki;
        spec.controller.gains.integral_order = integral_order;
        spec.controller.sample_time_s = step_s;
        spec.horizon = count;
        drive::Model plant;
        plant.gain = gain;
        plant.numerator = {{1.0, 0.0}};
        plant.denominator = {{time_constant_s, 1.0}, {1.0, 0.0}};
        plant.delay_s = static_cast<double>(delay) * step_s;
        const std::vector<double> whole = loop_by_hand(step_s, delay, count);
        const std::vector<double> half = loop_by_hand(0.5 * step_s, 2 * delay, 2 * count);
        double peak = 0.0;
        double apart = 0.0;
        for (std::size_t k = 0; k < count; ++k) {
            peak = std::max(peak, std::fabs(whole[k]));
            apart = std::max(apart, std::fabs(whole[k] - half[2 * k]));
        }
        const generate::LoopDeviation found = generate::measure_loop(spec, plant, count);
        EXPECT_NEAR(found.sampling, apart / peak, 1e-9) << delay;
        EXPECT_LT(found.header, spec.max_error) << delay;
    }
}

// Of the two loops, as parts of the largest value of the first: the second has half its step.
double apart_by_hand(double h, std::size_t delay, std::size_t delay_of_half, std::size_t count) {
    const std::vector<double> whole = loop_by_hand(h, delay, count);
    const std::vector<double> half = loop_by_hand(0.5 * h, delay_of_half, 2 * count);
    double peak = 0.0;
    double apart = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
        peak = std::max(peak, std::fabs(whole[k]));
        apart = std::max(apart, std::fabs(whole[k] - half[2 * k]));
    }
    return apart / peak;
}

generate::ControllerSpec spec_by_hand(double h) {
    generate::ControllerSpec spec;
    spec.controller.gains = {.kp = kp, .ki = ki, .integral_order = integral_order};
    spec.controller.sample_time_s = h;
    spec.horizon = 400;
    return spec;
}

drive::Model plant_by_hand(double delay_s) {
    drive::Model plant;
    plant.gain = 2.0 * gain;
    plant.numerator = {{0.5, 0.0}};
    plant.denominator = {{time_constant_s, 1.0}, {1.0, 0.0}};
    plant.delay_s = delay_s;
    return plant;
}

// A dead time between samples ends at the next one; a billionth of a step is taken for the rounding of a quotient.
TEST(ControllerLoop, ADeadTimeIsWholeStepsButForABillionth) {
    constexpr double h = 0.0625;
    const auto sampling = [&](double steps) {
        return generate::measure_loop(spec_by_hand(h), plant_by_hand(steps * h), 101).sampling;
    };
    EXPECT_NEAR(sampling(3.0 + 0.4975e-9), apart_by_hand(h, 3, 6, 101), 1e-9);
    EXPECT_NEAR(sampling(3.0 + 0.995e-9), apart_by_hand(h, 3, 7, 101), 1e-9);
    EXPECT_NEAR(sampling(3.0 + 1.005e-9), apart_by_hand(h, 4, 7, 101), 1e-9);
    EXPECT_NEAR(sampling(3.5), apart_by_hand(h, 4, 7, 101), 1e-9);
}

// Where no limit is met the loop is linear: at half of its level each value is half as large.
TEST(ControllerLoop, OfALowerLevelHasTheSameParts) {
    generate::ControllerSpec spec = spec_by_hand(step_s);
    EXPECT_EQ(generate::first_level(spec), 1.0);
    spec.controller.low = -1000.0;
    spec.controller.high = 1000.0;
    spec.input_full_scale = 8.0;
    EXPECT_EQ(generate::first_level(spec), 1.0);
    spec.input_full_scale = 1.0;
    EXPECT_EQ(generate::first_level(spec), 0.5);
    EXPECT_NEAR(generate::measure_loop(spec, plant_by_hand(step_s), 200).sampling, apart_by_hand(step_s, 1, 2, 200),
                1e-9);
}

// The same loop twice: with the header's coarse tables, and with all of the past in sums by hand.
TEST(ControllerLoop, TheHeadersPartIsThatOfItsOwnSteps) {
    constexpr std::size_t count = 300;
    constexpr double mu = 0.7;
    constexpr double kd = 0.3;
    constexpr double filter_s = 0.1;
    constexpr double weight = 0.5;
    generate::ControllerSpec spec = spec_by_hand(step_s);
    spec.controller.gains.kd = kd;
    spec.controller.gains.derivative_order = mu;
    spec.controller.gains.filter_s = filter_s;
    spec.controller.setpoint_weight = weight;
    spec.max_error = 0.1;
    const auto output_of = [](auto&& controller) {
        std::vector<double> control;
        std::vector<double> output;
        for (std::size_t k = 0; k < count; ++k) {
            const double lag = time_constant_s / step_s;
            output.push_back(k == 0 ? 0.0
                                    : (lag * output.back() + gain * (k > 1 ? control[k - 2] : 0.0)) / (lag + 1.0));
            control.push_back(controller(2 * k < count ? 1.0 : generate::second_level, output.back()));
        }
        return output;
    };
    const auto sum_of = [](double order, const std::vector<double>& values) {
        double sum = 0.0;
        double next = 1.0;
        for (std::size_t j = 0; j < values.size(); ++j) {
            sum += next * values[values.size() - 1 - j];
            next *= 1.0 - (order + 1.0) / (static_cast<double>(j) + 1.0);
        }
        return sum;
    };
    std::vector<double> errors;
    std::vector<double> weighted;
    double integral = 0.0;
    double filtered = 0.0;
    const std::vector<double> exact = output_of([&](double setpoint, double measured) {
        errors.push_back(setpoint - measured);
        weighted.push_back(weight * setpoint - measured);
        integral += ki * std::pow(step_s, integral_order) * sum_of(1.0 - integral_order, errors);
        filtered += step_s / (step_s + filter_s) * (sum_of(mu, weighted) - filtered);
        return kp * weighted.back() + integral + kd * std::pow(step_s, -mu) * filtered;
    });
    const auto stepped = generate::stepped_of(spec);
    const std::vector<double> own =
        output_of([&](double setpoint, double measured) { return stepped->step_real(setpoint, measured); });
    double peak = 0.0;
    double apart = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
        peak = std::max(peak, std::fabs(exact[k]));
        apart = std::max(apart, std::fabs(exact[k] - own[k]));
    }
    ASSERT_GT(apart, 1e-4);  // far above single precision
    EXPECT_NEAR(generate::measure_loop(spec, plant_by_hand(step_s), count).header, apart / peak, 2e-6);
}

// With T = h a step halves the way to u: from rest to kp / 2. At half the step it goes a third. Where kp is 4 that is
// to 4/3 and back to 4/9, exactly in q31. The plant may reach the input's full scale and no more.
TEST(ControllerLoop, AnOutputOfTheInputsFullScaleIsHeld) {
    generate::ControllerSpec spec;
    spec.controller.gains = {.kp = 4.0};
    spec.controller.sample_time_s = 0.5;
    spec.controller.low = -8.0;
    spec.controller.high = 8.0;
    spec.input_full_scale = 2.0;
    const drive::Model lag = drive::make_fopdt(1.0, 0.5, 0.0);
    const generate::LoopDeviation found = generate::measure_loop(spec, lag, 2);
    EXPECT_EQ(found.header, 0.0);
    EXPECT_NEAR(found.sampling, (2.0 - 4.0 / 9.0) / 2.0, 1e-12);
    spec.controller.gains.kp = 4.5;
    EXPECT_EQ(test::refusal(glsum::Exit::bad_input, [&] { (void)generate::measure_loop(spec, lag, 2); }),
              "--input-scale: expected at least 2.25, what the loop reaches at a set point of 1, found 2");
}

TEST(ControllerLoop, RefusesPlantsWithDerivativesAndLoopsThatRunAway) {
    const generate::ControllerSpec spec = spec_by_hand(step_s);
    const auto refused = [&](const std::vector<drive::Term>& numerator) {
        drive::Model plant = plant_by_hand(0.0);
        plant.numerator = numerator;
        return test::refusal(glsum::Exit::bad_input, [&] { (void)generate::measure_loop(spec, plant, 50); });
    };
    const std::string words = "--plant: expected a numerator without derivatives";
    EXPECT_EQ(refused({{1.0, 0.5}}), words);
    EXPECT_EQ(refused({{1.0, 0.0}, {1.0, 0.5}}), words);
    EXPECT_EQ(refused({{1.0, 0.5}, {1.0, 0.0}}), words);
    // Gains against the plant's sign, each output thousands of times the one before.
    generate::ControllerSpec wrong = spec;
    wrong.controller.gains = {.kp = -1e6};
    EXPECT_EQ(
        test::refusal(glsum::Exit::check_failed, [&] { (void)generate::measure_loop(wrong, plant_by_hand(0.0), 500); }),
        "the loop does not stay finite");
}

}  // namespace
