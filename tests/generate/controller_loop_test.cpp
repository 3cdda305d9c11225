// The loop that a generated controller is measured in, held against recursions by hand.
#include "bench/steppers/controller/loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/steppers/controller/controller_spec.hpp"
#include "drive/model.hpp"

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

}  // namespace
