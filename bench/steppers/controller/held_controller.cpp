#include "bench/steppers/controller/held_controller.hpp"

#include <algorithm>

#include "bench/steppers/controller/stepped.hpp"
#include "bench/steppers/controller/stepped_q31.hpp"

namespace generate {

std::complex<double> HeldController::response(double angle) const {
    namespace design = glsum::design;
    const auto term = [&](double gain, const design::Filter& sum, double decay) {
        return gain * frequency_response(sum, angle) * design::mode_response(decay, 0, angle);
    };
    const std::complex<double> integral = term(held_.ki, held_.integral, 0.0);
    const std::complex<double> derivative =
        held_.derives ? term(held_.kd * held_.passes, held_.derivative, held_.passes) : 0.0;
    return held_.kp + integral + derivative;
}

double HeldController::slowest() const {
    double slowest = held_.derives ? held_.passes : 1.0;
    for (const auto* sum : {&held_.integral, &held_.derivative}) {
        for (const glsum::Mode& mode : sum->modes) {
            slowest = std::min(slowest, mode.decay);
        }
    }
    return slowest;
}

std::unique_ptr<HeldController> stepped_of(const ControllerSpec& spec) {
    if (spec.input_full_scale) {
        return std::make_unique<FixedController>(spec);
    }
    return std::make_unique<SteppedController>(spec);
}

}  // namespace generate
