#include "bench/steppers/controller/stepped_q31.hpp"

#include <cmath>
#include <optional>

#include "bench/steppers/controller/sum_line.hpp"
#include "glsum/bound.hpp"
#include "glsum/design/held.hpp"
#include "glsum/format/fixed.hpp"
#include "glsum/registry.hpp"

namespace generate {
namespace {

// In a header they are constants.
#define GLSUM_PID_DESIGN const FixedPid* numbers;
#define GLSUM_PID_NUMBER(name) (number_##name(*S->numbers))
#define GLSUM_PID_ROUND(number, shift) (glsum::round_shift(number, shift).value)
int number_SHIFT_KP(const FixedPid& fixed) { return fixed.kp.shift; }
int number_SHIFT_KI(const FixedPid& fixed) { return fixed.ki.shift; }
int number_SHIFT_KD(const FixedPid& fixed) { return fixed.kd.shift; }
int number_EXTRA(const FixedPid& fixed) { return fixed.extra; }
std::int32_t number_WEIGHT(const FixedPid& fixed) { return fixed.weight; }
std::int32_t number_PASSES(const FixedPid& fixed) { return fixed.passes.mantissa; }
int number_PASSES_SHIFT(const FixedPid& fixed) { return fixed.passes.shift; }
#include "glsum/model/pid_q31.h"
#undef GLSUM_PID_ROUND
#undef GLSUM_PID_NUMBER
#undef GLSUM_PID_DESIGN

using Sum = glsum::modes_plain_q31;

double real_of(const FixedGain& gain) { return gain.mantissa * gain.unit; }

// What 32 bits hold of a full scale.
std::int32_t to_fraction(double real, double full_scale) { return Sum::from_real(real / full_scale); }

// Of |S_k| for |x| <= 1, by the taps and modes that are held.
double most_of(const glsum::design::Filter& sum) {
    double most = 0.0;
    for (const double tap : sum.taps) {
        most += std::fabs(tap);
    }
    for (const glsum::Mode& mode : sum.modes) {
        most += std::fabs(mode.weight / mode.decay);
    }
    return most;
}

}  // namespace

struct FixedController::State {
    bench::HostLine<Sum> integral;
    std::optional<bench::HostLine<Sum>> derivative;
    FixedPid numbers;
    glsum_pid pid;
};

FixedController::FixedController(const ControllerSpec& spec) {
    const drive::Fopid& controller = spec.controller;
    const Factors factors = factors_of(controller);
    const glsum::Design integral = design_of<Sum>(integral_sum(spec), spec);
    state_.reset(new State{bench::HostLine<Sum>(integral), {}, {}, {}});
    held_.derives = controller.gains.kd != 0.0;
    glsum::Design derivative{};
    if (held_.derives) {
        derivative = design_of<Sum>(derivative_sum(spec), spec);
        state_->derivative.emplace(derivative);
        held_.derivative = glsum::design::held<glsum::Plain, glsum::Q31>(state_->derivative->state());
    }
    held_.integral = glsum::design::held<glsum::Plain, glsum::Q31>(state_->integral.state());
    const int integral_bits = state_->integral.state().scale.output_exponent;
    const int derivative_bits = held_.derives ? state_->derivative->state().scale.output_exponent : 0;
    state_->numbers = fixed_pid(controller, *spec.input_full_scale, integral_bits, derivative_bits);
    const FixedPid& fixed = state_->numbers;
    held_.kp = real_of(fixed.kp);
    held_.ki = real_of(fixed.ki) * factors.integral;
    held_.kd = real_of(fixed.kd) * factors.derivative;
    held_.passes = std::ldexp(fixed.passes.mantissa, -fixed.passes.shift);

    // Of gains g for g', |g'| |S' - S| + |g' - g| |S|, each product rounded once.
    const double full = 2.0 * fixed.input_full_scale;
    const double product = 0.5 * std::ldexp(fixed.output_unit(), -fixed.extra);
    const auto part = [&](double held, double exact, double sum_error, double sum) {
        return std::fabs(held) * sum_error + std::fabs(held - exact) * sum + product;
    };
    const drive::Gains& gains = controller.gains;
    // Of the weighted error its weight's rounding, too, times a set point of half of full scale.
    const double rounded = 0.5 * fixed.error_unit() + std::ldexp(0.5 * fixed.input_full_scale, -30);
    error_.per_sample =
        part(held_.ki, gains.ki * factors.integral,
             full * glsum::error_bound<Sum>(integral, state_->integral.state(), 1.0), full * most_of(held_.integral));
    error_.direct = part(held_.kp, gains.kp, rounded, full) + 0.5 * fixed.output_unit();
    if (held_.derives) {
        const double most = full * most_of(held_.derivative);
        const double sum = full * glsum::error_bound<Sum>(derivative, state_->derivative->state(), 1.0) +
                           rounded * most_of(held_.derivative);
        // The filter: its decay to 2^-30 of itself, and half a unit at each step.
        const double filter =
            sum + std::ldexp(2.0 * most, -30) + 0.5 * fixed.error_unit(derivative_bits) / held_.passes;
        error_.direct += part(held_.kd, gains.kd * factors.derivative, filter, most);
    }
    glsum_pid& pid = state_->pid;
    pid = {0, fixed.kp.mantissa, fixed.ki.mantissa, fixed.kd.mantissa, fixed.low, fixed.high, 0, 0, &fixed};
    glsum_pid_start(&pid, 0, 0);
}

FixedController::~FixedController() = default;

std::int32_t FixedController::step(std::int32_t setpoint, std::int32_t measured) {
    const std::int32_t weighted = glsum_pid_weighted(&state_->pid, setpoint, measured);
    const std::int32_t integral = state_->integral.step(glsum_pid_error(setpoint, measured));
    return glsum_pid_step(&state_->pid, weighted, integral,
                          state_->derivative ? state_->derivative->step(weighted) : 0);
}

void FixedController::change(std::int32_t kp, std::int32_t ki, std::int32_t kd) {
    glsum_pid_change(&state_->pid, kp, ki, kd);
}

double FixedController::step_real(double setpoint, double measured) {
    const double full = state_->numbers.input_full_scale;
    return step(to_fraction(setpoint, full), to_fraction(measured, full)) * state_->numbers.output_unit();
}

const FixedPid& FixedController::numbers() const { return state_->numbers; }

}  // namespace generate
