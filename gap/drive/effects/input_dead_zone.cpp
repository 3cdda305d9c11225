// w = u - width beyond the width, else 0; below 0 likewise with a width of its own, which an input of one sign does not
// tell: then it is the same one.
#include <algorithm>
#include <cmath>

#include "gap/drive/effect.hpp"
#include "gap/drive/level_scan.hpp"

namespace gap {

const Effect& input_dead_zone();

namespace {

constexpr double the_same = -1.0;

std::vector<EffectParameter> parameters(const Scales& scales) {
    const double widest = 0.9 * scales.input_max;
    const std::vector<double> starts = {0.08 * scales.input_max, 0.3 * scales.input_max};
    const EffectParameter width{"width", "u", 0.0, widest, 0.0, starts};
    if (!scales.two_signs) {
        return {width, {"width_down", "u", the_same, the_same, the_same, {the_same}, true}};
    }
    return {width, {"width_down", "u", 0.0, widest, 0.0, starts}};
}

void add(Scenario& scenario, std::span<const double> values) {
    const double down = values[1] < 0.0 ? values[0] : values[1];
    scenario.levels.emplace_back([up = values[0], down](std::span<double> levels) {
        for (double& u : levels) {
            u = u > up ? u - up : u < -down ? u + down : 0.0;
        }
    });
}

std::vector<double> start(const Clue& clue) {
    const double width = scan_levels(clue, [](Scenario& scenario, double level) {
                             add(scenario, std::vector{level, level});
                         }).level;
    return {width, clue.scales.two_signs ? width : the_same};
}

std::vector<Written> to_contract(const Effect& effect, std::span<const Fitted> fitted) {
    std::vector<Written> written = numbers_to_contract(effect, fitted);
    if (fitted[1].value < 0.0) {
        written.pop_back();
    }
    return written;
}

}  // namespace

const Effect& input_dead_zone() {
    static const Effect effect{
        .name = "input_dead_zone",
        .kind = Kind::lasting,
        .parameters = parameters,
        .add_to = add,
        .place = Place::actuator,
        .numbers = {{"width"}, {"width_down", Number::Given::otherwise, the_same}},
        .leads_base = true,
        .to_contract = to_contract,
        .start = start,
    };
    return effect;
}

}  // namespace gap
