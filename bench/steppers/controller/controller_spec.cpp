#include "bench/steppers/controller/controller_spec.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/failure.hpp"
#include "glsum/design/modes.hpp"
#include "glsum/design/projection.hpp"

namespace generate {
namespace {

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

const char* integral_kernel(const ControllerSpec& spec) {
    return spec.input_full_scale ? "modes_plain_q31" : "modes_compensated_f32";
}

const char* derivative_kernel(const ControllerSpec& spec) {
    return spec.input_full_scale ? "modes_plain_q31" : "modes_plain_f32";
}

}  // namespace generate
