#include "bench/sweep/derivative_limits.hpp"

#include <cmath>

#include "bench/sweep/exact_weights.hpp"
#include "bench/sweep/signal_derivatives.hpp"
#include "bench/sweep/signals.hpp"

namespace bench {

std::vector<DerivativeLimit> derivative_limits(std::string_view signal, std::size_t samples, double order,
                                               Discretisation weights) {
    const Derivative derivative = derivative_of_signal(signal, samples);
    if (!derivative || samples < 2) {
        return {};
    }
    constexpr int points = 200;  // within 1 % of the largest error over all k; 24 can miss a tenth of it
    const reference::Real v = order;
    const reference::Real scale = pow(reference::Real(step_s), v) / first_weight(weights, v);
    const reference::Real lag = lag_steps(weights, v);
    const auto last = static_cast<double>(samples - 1);
    std::vector<DerivativeLimit> limits;
    std::size_t before = 0;
    for (int i = 0; i < points; ++i) {
        const auto k = static_cast<std::size_t>(std::lround(std::pow(last, i / (points - 1.0))));
        const reference::Real steps = k - lag;
        if (k == before || steps <= 0) {  // at t = 0 there is no derivative
            continue;
        }
        before = k;
        const reference::Real limit = scale * derivative(v, steps * reference::Real(step_s));
        limits.push_back({k, static_cast<double>(limit), 2 * k >= samples});
    }
    return limits;
}

}  // namespace bench
