#include "drive/tune/trial.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/failure.hpp"
#include "drive/fast_memory.hpp"
#include "drive/response.hpp"
#include "glsum/weights.hpp"

namespace tune {
namespace {

// Impulse responses of the controller: of what acts on the weighted set point, and of the integral.
struct Weights {
    std::vector<double> at_once;
    std::vector<double> integral;
};

Weights weights_of(const drive::Fopid& controller, std::size_t count) {
    const drive::Gains& gains = controller.gains;
    const double h = controller.sample_time_s;
    const double lag = gains.filter_s / h;
    const double derivative_scale = gains.kd * std::pow(h, -gains.derivative_order) / (1.0 + lag);
    const double integral_scale = gains.ki * std::pow(h, gains.integral_order);
    glsum::Weights derivative(gains.derivative_order);
    glsum::Weights integral(-gains.integral_order);
    Weights weights{std::vector<double>(count), std::vector<double>(count)};
    double filtered = 0.0;
    for (std::size_t j = 0; j < count; ++j) {
        filtered = derivative_scale * derivative.weight() + lag / (1.0 + lag) * filtered;
        weights.at_once[j] = filtered + (j == 0 ? gains.kp : 0.0);
        weights.integral[j] = integral_scale * integral.weight();
        derivative.next();
        integral.next();
    }
    return weights;
}

}  // namespace

Course run(const SampledPlant& plant, const drive::Fopid& controller, const Trial& trial) {
    const double h = controller.sample_time_s;
    const double samples = std::ceil(trial.until_s / h);
    if (!(samples >= 2.0 && 2.0 * samples <= static_cast<double>(most_trial_samples))) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("--until-s: expected {} to {} s at a sample time of {} s, found {}", 2.0 * h,
                                         0.5 * static_cast<double>(most_trial_samples) * h, h, trial.until_s));
    }
    const auto half = static_cast<std::size_t>(samples);
    const std::size_t count = 2 * half;
    const Weights weights = weights_of(controller, count);
    std::vector<double> feedback(count);
    for (std::size_t j = 0; j < count; ++j) {
        feedback[j] = weights.at_once[j] + weights.integral[j];
    }
    for (std::size_t j = count - 1; j > 0; --j) {  // of increments
        feedback[j] -= feedback[j - 1];
    }
    drive::StepResponse response(plant.model());
    std::vector<double> step(count);
    for (std::size_t j = 0; j < count; ++j) {
        step[j] = response(static_cast<double>(j) * h);
    }
    drive::FastMemory errors(feedback);
    drive::FastMemory inputs(step);
    Course course;
    double input = 0.0;
    double highest = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
        const double output = inputs.past() + (k >= half ? trial.load * step[k - half] : 0.0);
        const double set = trial.setpoint * (controller.setpoint_weight * weights.at_once[k] + weights.integral[k]);
        const double wanted = input + set - feedback[0] * output + errors.past();
        const double now = std::clamp(wanted, controller.low, controller.high);
        course.limited = course.limited || now != wanted;
        errors.push(-output);
        inputs.push(now - input);
        input = now;
        course.time_s.push_back(static_cast<double>(k) * h);
        course.output.push_back(output);
        course.input.push_back(input);
        (k < half ? course.setpoint_iae : course.load_iae) += h * std::fabs(trial.setpoint - output);
        highest = k < half ? std::max(highest, output / trial.setpoint) : highest;
    }
    course.overshoot = std::max(0.0, highest - 1.0);
    return course;
}

}  // namespace tune
