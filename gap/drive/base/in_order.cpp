#include "gap/drive/base/in_order.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "gap/drive/base/modes.hpp"

namespace gap {
namespace {

// A further number takes so much of what is left where it was not fitted, or it follows something else than lags.
constexpr double worth_a_number = 0.08;
// A record that has not settled looks like an integrator's: it must be clearly better.
constexpr double worth_an_integrator = 0.3;

// Whether its lags, whose sum is the lowest power's coefficient, outlast every record: beside a zero that nearly
// cancels it such a lag is a drift, which is none of the plant's, and alone it is an integrator.
bool outlasts(const Described& one, double longest_s) {
    constexpr double times = 1.5;
    double coefficient = 0.0;
    double order = 1.0;
    for (const drive::Parameter& parameter : one.form.parameters()) {
        coefficient = parameter.name == "a1" && !parameter.fixed ? parameter.value : coefficient;
        order = parameter.name == "alpha1" && !parameter.fixed ? parameter.value : order;
    }
    return std::pow(std::max(coefficient, 0.0), 1.0 / order) > times * longest_s;
}

}  // namespace

void keep_in_order(std::vector<Described>& found, double longest_s, double floor) {
    const auto too_slow = [&](const Described& one) { return outlasts(one, longest_s); };
    if (!std::ranges::all_of(found, too_slow)) {
        std::erase_if(found, too_slow);
    }
    keep_own_modes(found, longest_s);
    const auto size_of = [&](double gap) { return std::log(std::max({gap, floor, 1e-6})); };
    const auto price = [&](const Described& one) {
        return 0.5 * (size_of(one.aside) + size_of(one.validation)) + worth_a_number * one.numbers +
               (one.integrators > 0 ? worth_an_integrator : 0.0);
    };
    std::stable_sort(found.begin(), found.end(),
                     [&](const Described& a, const Described& b) { return price(a) < price(b); });
    // Of each structure the better one.
    std::set<std::string> seen;
    std::erase_if(found, [&](const Described& one) { return !seen.insert(one.name).second; });
}

drive::Form held_near(drive::Form form, double times) {
    double lags_s = 0.0;
    for (const drive::Parameter& parameter : form.parameters()) {
        lags_s = parameter.name == "a1" ? parameter.value : lags_s;
    }
    for (drive::Parameter& parameter : form.parameters()) {
        const bool number = !parameter.fixed && parameter.name != "gain";
        if (number && parameter.name == "delay_s") {
            const double more_s = (times - 1.0) * (parameter.value + lags_s);
            parameter.lower = std::max(0.0, parameter.value - more_s);
            parameter.upper = parameter.value + more_s;
        } else if (number && parameter.value > 0.0) {
            parameter.lower = parameter.value / times;
            parameter.upper = parameter.value * times;
        }
    }
    return form;
}

}  // namespace gap
