// The gain falls with the charge drawn, 1 - per_unit_s * integral of |u|, and with the load, 1 - resistance |u|.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& supply_sag();

namespace {

std::vector<EffectParameter> parameters([[maybe_unused]] const Scales& scales) {
    return {{"per_unit_s",
             "1/(u s)",
             0.0,
             0.9 / (scales.input_max * scales.length_s),
             0.0,
             {0.15 / (scales.input_max * scales.length_s), 0.5 / (scales.input_max * scales.length_s)}},
            {"resistance", "1/u", 0.0, 0.6 / scales.input_max, 0.0, {0.02 / scales.input_max}}};
}

void add([[maybe_unused]] Scenario& scenario, [[maybe_unused]] std::span<const double> values) {
    scenario.input.emplace_back(
        [per_unit_s = values[0], resistance = values[1]](std::span<double> held, const Grid& grid) {
            double charge = 0.0;
            for (double& u : held) {
                const double size = std::fabs(u);
                charge += 0.5 * size * grid.step_s;
                u *= std::max(0.0, 1.0 - per_unit_s * charge - resistance * size);
                charge += 0.5 * size * grid.step_s;
            }
        });
}

}  // namespace

const Effect& supply_sag() {
    static const Effect effect{
        .name = "supply_sag",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .looks_like = {"gain_drift"},
        .place = Place::actuator,
        .numbers = {{"per_unit_s", Number::Given::otherwise, 0.0}, {"resistance", Number::Given::otherwise, 0.0}},
        .smooth = true,
    };
    return effect;
}

}  // namespace gap
