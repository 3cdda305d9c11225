#include "bench/steppers/controller/loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <vector>

#include "base/failure.hpp"
#include "bench/steppers/controller/held_controller.hpp"
#include "drive/fast_memory.hpp"
#include "drive/simulation.hpp"
#include "drive/whole_record.hpp"

namespace generate {
namespace {

#define GLSUM_REAL double
#define GLSUM_PID_KEEP(value) ((void)(value))
#include "glsum/model/pid.h"
#undef GLSUM_PID_KEEP
#undef GLSUM_REAL

// A sum whose newest sample comes last, all of its past in memory.
class FullSum {
public:
    FullSum(double order, std::size_t count) : FullSum(drive::record_weights(order, count)) {}
    double step(double newest) {
        const double sum = newest + memory_.past();
        memory_.push(newest);
        return sum;
    }

private:
    explicit FullSum(const std::vector<double>& weights) : memory_(weights) {}
    drive::FastMemory memory_;
};

class FullController {
public:
    FullController(const drive::Fopid& controller, std::size_t count)
        : weight_(controller.setpoint_weight), integral_(1.0 - controller.gains.integral_order, count) {
        if (controller.gains.kd != 0.0) {
            derivative_.emplace(controller.gains.derivative_order, count);
        }
        const Factors factors = factors_of(controller);
        pid_ = {controller.gains.kp,
                controller.gains.ki * factors.integral,
                controller.gains.kd * factors.derivative,
                factors.passes,
                controller.low,
                controller.high,
                0.0,
                0.0,
                0.0,
                0.0};
        glsum_pid_start(&pid_, 0.0, 0.0);
        (void)glsum_pid_change;
    }
    double step(double setpoint, double measured) {
        const double weighted = glsum_pid_product(weight_, setpoint) - measured;
        const double integral = integral_.step(setpoint - measured);
        return glsum_pid_step(&pid_, weighted, integral, derivative_ ? derivative_->step(weighted) : 0.0);
    }

private:
    glsum_pid pid_{};
    double weight_;
    FullSum integral_;
    std::optional<FullSum> derivative_;
};

// The plant's output in a loop with whatever puts out u for set point and reading.
template <class Controller>
std::vector<double> outputs_of(const drive::Model& plant, double step_s, std::size_t count, double level,
                               Controller&& controller) {
    const auto delay = static_cast<std::size_t>(std::ceil(plant.delay_s / step_s - 1e-9));
    const std::vector<double> weights = drive::merged_weights(plant.denominator, step_s, count, true);
    const double constant = drive::constant_coefficient(plant.denominator);
    drive::FastMemory memory(weights);
    std::vector<double> output(count, 0.0);
    std::deque<double> under_way(std::min(delay, count), 0.0);  // inputs that have not arrived yet
    for (std::size_t k = 0; k < count; ++k) {
        double increment = 0.0;
        if (k > 0) {
            const double forcing = plant.gain * plant.numerator[0].coefficient * under_way.front();
            under_way.pop_front();
            increment = (forcing - memory.past() - constant * output[k - 1]) / (weights[0] + constant);
            output[k] = output[k - 1] + increment;
        }
        memory.push(increment);
        if (!std::isfinite(output[k])) {
            throw glsum::Failure(glsum::Exit::check_failed, "the loop does not stay finite");
        }
        under_way.push_back(controller(2 * k < count ? level : second_level * level, output[k]));
    }
    return output;
}

double largest_difference(const std::vector<double>& one, const std::vector<double>& other, std::size_t stride) {
    double largest = 0.0;
    for (std::size_t k = 0; k < one.size(); ++k) {
        largest = std::max(largest, std::fabs(one[k] - other[stride * k]));
    }
    return largest;
}

}  // namespace

double first_level(const ControllerSpec& spec) {
    return spec.input_full_scale ? std::min(1.0, 0.5 * *spec.input_full_scale) : 1.0;
}

LoopDeviation measure_loop(const ControllerSpec& spec, const drive::Model& plant, std::size_t samples) {
    if (plant.numerator.size() != 1 || plant.numerator[0].order != 0.0) {
        throw glsum::Failure(glsum::Exit::bad_input, "--plant: expected a numerator without derivatives");
    }
    const double step_s = spec.controller.sample_time_s;
    const double level = first_level(spec);
    const auto full = [&](const drive::Fopid& controller, std::size_t count) {
        FullController stepped(controller, count);
        return outputs_of(plant, controller.sample_time_s, count, level,
                          [&](double setpoint, double measured) { return stepped.step(setpoint, measured); });
    };
    const std::vector<double> exact = full(spec.controller, samples);
    double peak = 0.0;
    for (const double value : exact) {
        peak = std::max(peak, std::fabs(value));
    }
    const auto own = stepped_of(spec);
    const std::vector<double> header = outputs_of(plant, step_s, samples, level, [&](double setpoint, double measured) {
        return own->step_real(setpoint, measured);
    });
    if (spec.input_full_scale && peak > *spec.input_full_scale) {
        throw glsum::Failure(
            glsum::Exit::bad_input,
            fmt::format("--input-scale: expected at least {:.3g}, what the loop reaches at a set point "
                        "of {:.3g}, found {:.3g}",
                        peak, level, *spec.input_full_scale));
    }
    drive::Fopid finer = spec.controller;
    finer.sample_time_s = 0.5 * step_s;
    return {largest_difference(exact, header, 1) / peak, largest_difference(exact, full(finer, 2 * samples), 2) / peak};
}

}  // namespace generate
