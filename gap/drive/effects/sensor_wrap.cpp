// z is y within one turn, as jumps in the readings tell. Beside a measured reading that one of all turns counts which
// is nearest to it: the simulation is off by what lies within half a turn. Where nothing was measured it is read from 0
// to a turn.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gap/drive/effect.hpp"

namespace gap {

const Effect& sensor_wrap();

namespace {

std::vector<EffectParameter> parameters(const Scales& scales) {
    if (!(scales.turn > 0.0)) {
        return {};
    }
    // What is near a usual turn may be that one, and no number to be fitted.
    constexpr double near = 0.03;
    std::vector<double> starts = {scales.turn};
    for (const double usual : {1.0, 2.0 * std::numbers::pi, 360.0}) {
        if (std::fabs(scales.turn - usual) < near * usual) {
            starts.push_back(usual);
        }
    }
    const double begin = scales.output_low < -0.1 * scales.turn ? -0.5 * starts.back() : 0.0;
    return {{"turn", "y", 0.8 * scales.turn, 1.25 * scales.turn, 0.0, starts, false, 1},
            {"begin", "y", begin, begin, 0.0, {begin}, true}};
}

void add(Scenario& scenario, std::span<const double> values) {
    if (!(values[0] > 0.0)) {
        return;
    }
    scenario.logger.emplace_back(
        [turn = values[0], begin = values[1]](std::span<double> reading, const Record& record) {
            for (std::size_t i = 0; i < reading.size(); ++i) {
                reading[i] -= turn * (record.output.empty() ? std::floor((reading[i] - begin) / turn)
                                                            : std::nearbyint((reading[i] - record.output[i]) / turn));
            }
        });
}

}  // namespace

const Effect& sensor_wrap() {
    static const Effect effect{
        .name = "sensor_wrap",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::sensor,
        .numbers = {{"turn"}, {"begin", Number::Given::otherwise, 0.0}},
        .domains = {Domain::mechanical, Domain::electric},
    };
    return effect;
}

}  // namespace gap
