// A fractional PID in single precision as a generated header steps it, here: the same kernels, the same statements.
#pragma once

#include <memory>

#include "bench/steppers/controller/held_controller.hpp"

namespace generate {

class SteppedController : public HeldController {
public:
    explicit SteppedController(const ControllerSpec& spec);
    ~SteppedController() override;
    /// u for the setpoint and what was measured, from rest.
    float step(float setpoint, float measured);
    double step_real(double setpoint, double measured) override;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace generate
