#include "bench/sweep/signal_derivatives.hpp"

#include <numbers>

#include "bench/sweep/signals.hpp"
#include "reference/derivatives.hpp"

namespace bench {

using reference::Real;

Derivative derivative_of_signal(std::string_view name, std::size_t samples) {
    if (name == "step") {
        return [](const Real& v, const Real& t) { return signal_peak * reference::derivative_of_power(0, v, t); };
    }
    if (name == "ramp" && samples > 1) {
        const Real slope = signal_peak / (Real(step_s) * (samples - 1));
        return [slope](const Real& v, const Real& t) { return slope * reference::derivative_of_power(1, v, t); };
    }
    if (const auto hz = sine_hz(name)) {
        const Real w = 2.0 * std::numbers::pi * *hz;
        return [w](const Real& v, const Real& t) { return signal_peak * reference::derivative_of_sine(w, v, t); };
    }
    return {};
}

}  // namespace bench
