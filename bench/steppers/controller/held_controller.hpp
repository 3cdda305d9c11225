// A controller as its tables and gains are held, whatever the format: what it makes of a sine.
#pragma once

#include <complex>
#include <memory>

#include "bench/steppers/controller/controller_spec.hpp"
#include "glsum/design/filter.hpp"

namespace generate {

class HeldController {
public:
    virtual ~HeldController() = default;
    HeldController(const HeldController&) = delete;
    HeldController& operator=(const HeldController&) = delete;

    /// u for the set point and what was measured, from rest: rounded to the format on their way in.
    virtual double step_real(double setpoint, double measured) = 0;
    /// What it makes of e^(i angle k) as set point of weight 1, where no limit is met: by tables and gains as they are
    /// held, without the rounding of its steps. \param angle  w h in (0, pi]
    [[nodiscard]] std::complex<double> response(double angle) const;
    /// What its slowest state decays by a sample, in (0, 1]; the integral's, which does not decay, apart.
    [[nodiscard]] double slowest() const;

protected:
    HeldController() = default;
    /// Gains times their powers of h.
    struct Held {
        double kp = 0.0;
        double ki = 0.0;
        double kd = 0.0;
        double passes = 1.0;
        bool derives = false;
        glsum::design::Filter integral{};
        glsum::design::Filter derivative{};
    };
    Held held_;
};

/// The controller of the spec's format. \throws glsum::Failure as `integral_sum` and `fixed_pid`
[[nodiscard]] std::unique_ptr<HeldController> stepped_of(const ControllerSpec& spec);

}  // namespace generate
