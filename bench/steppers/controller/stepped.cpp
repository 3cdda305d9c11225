#include "bench/steppers/controller/stepped.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "bench/steppers/controller/sum_line.hpp"
#include "glsum/design/held.hpp"
#include "glsum/registry.hpp"

namespace generate {
namespace {

// Compiled without fused products.
#define GLSUM_REAL float
#define GLSUM_PID_KEEP(value) ((void)(value))
#include "glsum/model/pid.h"
#undef GLSUM_PID_KEEP
#undef GLSUM_REAL

using Integral = glsum::modes_compensated_f32;
using Derivative = glsum::modes_plain_f32;

float limited(double real) {
    constexpr double most = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(real, -most, most));
}

}  // namespace

struct SteppedController::State {
    glsum_pid pid{};
    float weight;
    bench::HostLine<Integral> integral;
    std::optional<bench::HostLine<Derivative>> derivative;
};

SteppedController::SteppedController(const ControllerSpec& spec)
    : state_(new State{{},
                       static_cast<float>(spec.controller.setpoint_weight),
                       bench::HostLine<Integral>(design_of<Integral>(integral_sum(spec), spec)),
                       {}}) {
    const drive::Gains& gains = spec.controller.gains;
    const Factors factors = factors_of(spec.controller);
    glsum_pid& pid = state_->pid;
    pid = {static_cast<float>(gains.kp),
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
        state_->derivative.emplace(design_of<Derivative>(derivative_sum(spec), spec));
        held_.derivative = glsum::design::held<glsum::Plain, glsum::F32>(state_->derivative->state());
    }
    held_.integral = glsum::design::held<glsum::Compensated, glsum::F32>(state_->integral.state());
    held_.kp = static_cast<double>(pid.kp);
    held_.ki = static_cast<double>(pid.ki);
    held_.kd = static_cast<double>(pid.kd);
    held_.passes = static_cast<double>(pid.passes);
    held_.derives = gains.kd != 0.0;
    glsum_pid_start(&pid, 0.0F, 0.0F);
    (void)glsum_pid_change;
}

SteppedController::~SteppedController() = default;

float SteppedController::step(float setpoint, float measured) {
    const float weighted = glsum_pid_product(state_->weight, setpoint) - measured;
    const float integral = state_->integral.step(setpoint - measured);
    return glsum_pid_step(&state_->pid, weighted, integral,
                          state_->derivative ? state_->derivative->step(weighted) : 0.0F);
}

double SteppedController::step_real(double setpoint, double measured) {
    return static_cast<double>(step(static_cast<float>(setpoint), static_cast<float>(measured)));
}

}  // namespace generate
