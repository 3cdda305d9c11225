// z is a rolling mean of the logger over the window behind each stamp, exact for an output that is straight between
// nodes. Before the record the output rested.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& logger_filter();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    return {{"window_s",
             "s",
             0.0,
             3.0 * scales.time_constant_s,
             0.0,
             {0.1 * scales.time_constant_s, 0.4 * scales.time_constant_s}}};
}

void add(Scenario& scenario, std::span<const double> values) {
    scenario.output.emplace_back([window_s = values[0]](std::span<double> z, const Motion& motion) {
        if (!(window_s > 0.0) || z.empty()) {
            return;
        }
        const double window = window_s / motion.grid.step_s;  // in intervals
        std::vector<double> integral(z.size(), 0.0);
        for (std::size_t k = 1; k < z.size(); ++k) {
            integral[k] = integral[k - 1] + 0.5 * (z[k - 1] + z[k]);
        }
        const std::vector<double> y(z.begin(), z.end());
        const auto integral_to = [&](double place) {
            if (place <= 0.0) {
                return y[0] * place;
            }
            const auto below = std::min(static_cast<std::size_t>(place), y.size() - 2);
            const double share = place - static_cast<double>(below);
            return integral[below] + share * (y[below] + 0.5 * share * (y[below + 1] - y[below]));
        };
        for (std::size_t k = 0; k < z.size(); ++k) {
            z[k] = (integral[k] - integral_to(static_cast<double>(k) - window)) / window;
        }
    });
}

}  // namespace

const Effect& logger_filter() {
    static const Effect effect{
        .name = "logger_filter",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::logger,
        .numbers = {{"window_s"}},
        .linear = true,
    };
    return effect;
}

}  // namespace gap
