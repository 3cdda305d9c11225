// A fractional PID in single precision as a generated header steps it, here: the same kernels, the same statements.
#pragma once

#include <complex>
#include <cstddef>
#include <memory>

#include "drive/controller_file.hpp"

namespace generate {

/// What a controller is made for.
struct ControllerSpec {
    drive::Fopid controller;
    double max_error = 5e-4;          ///< of the integral's weights, the sum of magnitudes, before powers of h
    std::size_t horizon = 1'000'000;  ///< samples that it counts over
};

/// What the derivative's weights may be off by, times `max_error`: nothing adds their errors up.
inline constexpr double derivative_share = 2.0;

/// The two sums of a controller: of order 1 - lambda over the error, of order mu over the weighted one.
struct SumOfController {
    double order;
    std::size_t taps;  ///< within the error
};
/// \throws glsum::Failure (check failed) where no length keeps the error
[[nodiscard]] SumOfController integral_sum(const ControllerSpec& spec);
[[nodiscard]] SumOfController derivative_sum(const ControllerSpec& spec);

/// The kernel of the integral's sum: each state carries what its steps lost, or slow ones would stop.
inline constexpr const char* integral_kernel = "modes_compensated_f32";
/// And of the derivative's, whose slow states weigh next to nothing.
inline constexpr const char* derivative_kernel = "modes_plain_f32";

class SteppedController {
public:
    explicit SteppedController(const ControllerSpec& spec);
    ~SteppedController();
    SteppedController(const SteppedController&) = delete;
    SteppedController& operator=(const SteppedController&) = delete;
    /// u for the setpoint and what was measured, from rest.
    float step(float setpoint, float measured);
    /// What it makes of e^(i angle k) as set point of weight 1, where no limit is met: by tables and gains as they are
    /// held, without the rounding of its steps. \param angle  w h in (0, pi]
    [[nodiscard]] std::complex<double> response(double angle) const;
    /// What its slowest state decays by a sample, in (0, 1]; the integral's, which does not decay, apart.
    [[nodiscard]] double slowest() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// h / (h + filter_s), h^lambda, h^-mu.
struct Factors {
    double passes;
    double integral;
    double derivative;
};
[[nodiscard]] Factors factors_of(const drive::Fopid& controller);

}  // namespace generate
