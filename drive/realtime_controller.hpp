// A fractional PID controller as a microcontroller steps it: the numbers of `kernels/glsum/model/controller.hpp`,
// designed here.
#pragma once

#include <cstddef>
#include <vector>

#include "drive/model.hpp"
#include "drive/realtime.hpp"
#include "glsum/model/controller.hpp"

namespace drive {

/// u = kp e + ki D^-integral_order e + kd D^derivative_order e; the derivative reaches up to half the sample rate.
struct FractionalPid {
    double kp = 0.0;
    double ki = 0.0;
    double kd = 0.0;
    double integral_order = 1.0;    ///< lambda, in (0, 1]
    double derivative_order = 1.0;  ///< mu, in (0, 1]
};

/// The numbers, and what they point into.
class RealtimeController {
public:
    /// \param horizon  with modes: for how many samples their tail is designed
    /// \throws glsum::Failure (bad input): no gain, orders outside (0, 1], a step that is not above 0, fewer than 3
    /// taps before the modes, which the derivative's weights need
    RealtimeController(const FractionalPid& gains, const Memory& memory, double step_s, std::size_t horizon = 60'000);
    RealtimeController(const RealtimeController&) = delete;
    RealtimeController& operator=(const RealtimeController&) = delete;
    RealtimeController(RealtimeController&&) = default;  // vectors keep their places
    RealtimeController& operator=(RealtimeController&&) = default;
    ~RealtimeController() = default;

    [[nodiscard]] const glsum::ControllerDesign& design() const { return design_; }
    [[nodiscard]] const Memory& memory() const { return memory_; }
    /// By how much u is off at most for |e| <= 1, over the horizon: the sum of the errors of its weights.
    [[nodiscard]] double error() const { return error_; }

private:
    std::vector<double> ratios_;
    std::vector<glsum::Mode> modes_;
    glsum::ControllerDesign design_;
    Memory memory_;
    double error_ = 0.0;
};

/// `RealtimeController::error` times what the exact loop around this plant makes of a disturbance of u (the sum of the
/// magnitudes of e, for 1 at one sample, over the horizon): below 1 the loop stays stable, by the small-gain theorem.
[[nodiscard]] double loop_gain(const RealtimeController& controller, const FractionalPid& gains, const Model& plant,
                               double step_s, std::size_t horizon = 20'000);

}  // namespace drive
