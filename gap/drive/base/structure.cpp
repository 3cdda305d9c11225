#include "gap/drive/base/structure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace gap {

const std::vector<Structure>& structures() {
    static const std::vector<Structure> all = {
        {"first_order", 1, 0, 0, "one lag"},
        {"fractional_lag", 1, 0, 0, "one lag of fractional order: it creeps to its end, as what diffuses does", true},
        {"pure_integrator", 1, 1, 0, "an integrator"},
        {"double_integrator", 2, 2, 0, "two integrators"},
        {"second_order", 2, 0, 0, "two lags, or an oscillator"},
        {"fractional_second_order", 2, 0, 0, "two lags, or an oscillator, of fractional orders", true},
        {"integrator_lag", 2, 1, 0, "an integrator behind a lag"},
        {"second_order_zero", 2, 0, 1, "two lags with a zero: a second mass, a wall"},
        {"third_order", 3, 0, 0, "three lags, or a lag and an oscillator"},
        {"integrator_second_order", 3, 1, 0, "an integrator behind two lags or an oscillator"},
        {"third_order_zero", 3, 0, 1, "three lags with a zero"},
        {"two_modes", 4, 0, 2, "two oscillators side by side: an arm that bends, a mass on a spring"},
    };
    return all;
}

double lowest_order(std::size_t whole) { return static_cast<double>(whole) - 0.7; }
double highest_order(std::size_t whole) { return static_cast<double>(whole) + 0.2; }

const Structure* structure_named(const std::string& name) {
    const auto found = std::find_if(structures().begin(), structures().end(),
                                    [&](const Structure& structure) { return name == structure.name; });
    return found == structures().end() ? nullptr : &*found;
}

Coefficients lag_and_oscillator(double lag_s, double period_s, double damping, double delay_s) {
    const double friction_s = 2.0 * damping * period_s;
    const double square = period_s * period_s;
    return {1.0, {lag_s + friction_s, square + lag_s * friction_s, lag_s * square}, {}, delay_s};
}

drive::Form form_of(const Structure& structure, const Coefficients& at, bool driven) {
    drive::Model model;
    model.kind = drive::Kind::fotf;
    model.gain = driven ? at.gain : 1.0;
    model.delay_s = driven ? at.delay_s : 0.0;
    model.numerator = {{1.0, 0.0}};
    for (std::size_t j = 0; j < at.numerator.size(); ++j) {
        model.numerator.push_back({at.numerator[j], static_cast<double>(j + 1)});
    }
    model.denominator = {{1.0, static_cast<double>(structure.integrators)}};
    for (std::size_t i = 0; i < at.denominator.size(); ++i) {
        const double order = structure.fractional ? at.orders[i] : static_cast<double>(i + 1);
        model.denominator.push_back({at.denominator[i], static_cast<double>(structure.integrators) + order});
    }
    drive::Form form(drive::Kind::fotf, model);
    for (drive::Parameter& parameter : form.parameters()) {
        const bool order = parameter.name.starts_with("alpha") || parameter.name.starts_with("beta");
        const bool lowest = parameter.name == "a0" || parameter.name == "b0";
        const bool of_input =
            parameter.name == "gain" || parameter.name == "delay_s" || parameter.name.starts_with("b");
        const bool free_order = structure.fractional && parameter.name.starts_with("alpha") && parameter.value != 0.0;
        parameter.fixed = (order && !free_order) || lowest || parameter.name == "offset" || (of_input && !driven);
        if (parameter.name.starts_with("a") && !order && !lowest) {
            parameter.lower = 0.0;  // a lag that is negative grows for ever
        }
        if (free_order) {
            const std::size_t whole = std::stoul(parameter.name.substr(5));
            parameter.lower = lowest_order(whole);
            parameter.upper = highest_order(whole);
        }
    }
    return form;
}

}  // namespace gap
