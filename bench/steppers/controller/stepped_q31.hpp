// A fractional PID in q31 as a generated header steps it, here: the same kernels, the same statements.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "bench/steppers/controller/fixed_pid.hpp"
#include "bench/steppers/controller/held_controller.hpp"

namespace generate {

/// How far u is off at most from exact arithmetic with the sums' own taps and modes, where no limit is met, for
/// integers that stand for themselves. In units of u.
struct FixedError {
    double direct = 0.0;      ///< at any time
    double per_sample = 0.0;  ///< and for each sample, which the integral adds up
    [[nodiscard]] double after(std::size_t samples) const { return direct + static_cast<double>(samples) * per_sample; }
};

class FixedController : public HeldController {
public:
    /// \pre spec.input_full_scale
    explicit FixedController(const ControllerSpec& spec);
    ~FixedController() override;
    /// u for the set point and what was measured, from rest, each a fraction of its full scale.
    std::int32_t step(std::int32_t setpoint, std::int32_t measured);
    /// Mantissas of other gains.
    void change(std::int32_t kp, std::int32_t ki, std::int32_t kd);
    double step_real(double setpoint, double measured) override;
    [[nodiscard]] const FixedPid& numbers() const;
    [[nodiscard]] const FixedError& error() const { return error_; }

private:
    struct State;
    std::unique_ptr<State> state_;
    FixedError error_;
};

}  // namespace generate
