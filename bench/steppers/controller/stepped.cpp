#include "bench/steppers/controller/stepped.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "base/failure.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/host_line.hpp"
#include "glsum/design/held.hpp"
#include "glsum/design/modes.hpp"
#include "glsum/design/projection.hpp"
#include "glsum/registry.hpp"

namespace generate {
namespace {

// Compiled without fused products.
#define GLSUM_REAL float
#define GLSUM_PID_KEEP(value) ((void)(value))
#include "glsum/model/pid.h"
#undef GLSUM_PID_KEEP
#undef GLSUM_REAL

using Integral = glsum::Sum<glsum::Modes, glsum::Compensated, glsum::F32>;
using Derivative = glsum::Sum<glsum::Modes, glsum::Plain, glsum::F32>;

template <class Kernel>
bench::HostLine<Kernel> line_of(const SumOfController& sum, const ControllerSpec& spec) {
    const std::string name(Kernel::name());
    const bench::Length length = bench::length_of(name, sum.order, sum.taps, spec.horizon);
    return bench::HostLine<Kernel>(bench::design_of(name, sum.order, length, spec.horizon));
}

float limited(double real) {
    constexpr double most = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(real, -most, most));
}

SumOfController sum_within(double order, double max_error, std::size_t horizon) {
    if (!glsum::design::has_tail(order)) {
        return {order, static_cast<std::size_t>(order) + 1};  // a whole order's weights end
    }
    const auto found = glsum::design::design_modes({order, horizon}, max_error);
    if (!found) {
        throw glsum::Failure(
            glsum::Exit::check_failed,
            fmt::format("--max-error: no sum of order {} over {} samples keeps {}", order, horizon, max_error));
    }
    // A second near tap costs more than one more mode.
    const bool one_will_do = found->near_taps == 2 && glsum::design::least_near_taps(order) == 1;
    return {order, found->length() + (one_will_do ? 1 : 0)};
}

}  // namespace

SumOfController integral_sum(const ControllerSpec& spec) {
    return sum_within(1.0 - spec.controller.gains.integral_order, spec.max_error, spec.horizon);
}

SumOfController derivative_sum(const ControllerSpec& spec) {
    return sum_within(spec.controller.gains.derivative_order, derivative_share * spec.max_error, spec.horizon);
}

Factors factors_of(const drive::Fopid& controller) {
    const double h = controller.sample_time_s;
    return {h / (h + controller.gains.filter_s), std::pow(h, controller.gains.integral_order),
            std::pow(h, -controller.gains.derivative_order)};
}

struct SteppedController::State {
    glsum_pid pid{};
    float weight;
    bench::HostLine<Integral> integral;
    std::optional<bench::HostLine<Derivative>> derivative;
    glsum::design::Filter held_integral;
    glsum::design::Filter held_derivative;
};

SteppedController::SteppedController(const ControllerSpec& spec)
    : state_(new State{{},
                       static_cast<float>(spec.controller.setpoint_weight),
                       line_of<Integral>(integral_sum(spec), spec),
                       {},
                       {},
                       {}}) {
    const drive::Gains& gains = spec.controller.gains;
    const Factors factors = factors_of(spec.controller);
    state_->pid = {static_cast<float>(gains.kp),
                   static_cast<float>(gains.ki * factors.integral),
                   static_cast<float>(gains.kd * factors.derivative),
                   static_cast<float>(factors.passes),
                   limited(spec.controller.low),
                   limited(spec.controller.high),
                   0.0F,
                   0.0F,
                   0.0F,
                   0.0F};
    if (gains.kd != 0.0) {
        state_->derivative.emplace(line_of<Derivative>(derivative_sum(spec), spec));
        state_->held_derivative = glsum::design::held<glsum::Plain, glsum::F32>(state_->derivative->state());
    }
    state_->held_integral = glsum::design::held<glsum::Compensated, glsum::F32>(state_->integral.state());
    glsum_pid_start(&state_->pid, 0.0F, 0.0F);
    (void)glsum_pid_change;
}

SteppedController::~SteppedController() = default;

float SteppedController::step(float setpoint, float measured) {
    const float weighted = glsum_pid_product(state_->weight, setpoint) - measured;
    const float integral = state_->integral.step(setpoint - measured);
    return glsum_pid_step(&state_->pid, weighted, integral,
                          state_->derivative ? state_->derivative->step(weighted) : 0.0F);
}

std::complex<double> SteppedController::response(double angle) const {
    namespace design = glsum::design;
    const auto term = [&](float gain, const design::Filter& sum, double decay) {
        return static_cast<double>(gain) * frequency_response(sum, angle) * design::mode_response(decay, 0, angle);
    };
    const glsum_pid& pid = state_->pid;
    const std::complex<double> integral = term(pid.ki, state_->held_integral, 0.0);
    const std::complex<double> derivative =
        state_->derivative ? term(pid.kd * pid.passes, state_->held_derivative, pid.passes) : 0.0;
    return static_cast<double>(pid.kp) + integral + derivative;
}

double SteppedController::slowest() const {
    double slowest = state_->derivative ? state_->pid.passes : 1.0;
    for (const auto* sum : {&state_->held_integral, &state_->held_derivative}) {
        for (const glsum::Mode& mode : sum->modes) {
            slowest = std::min(slowest, mode.decay);
        }
    }
    return slowest;
}

}  // namespace generate
