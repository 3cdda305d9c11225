#include "drive/stand/blind/deck.hpp"

namespace stand::blind {

bool pairs_with(const std::string& a, const std::string& b) {
    const auto place = [](const std::string& effect) -> std::string {
        if (bends_the_input(effect) || effect == "gain_error" || effect == "gain_drift" || effect == "valve_stiction" ||
            effect == "input_hysteresis") {
            return "input";
        }
        if (is_lag(effect) || effect == "dead_time_error" || effect == "time_scale_error" || effect == "order_error" ||
            effect == "rate_limit" || effect == "direction_asymmetry" || effect == "variable_delay") {
            return "dynamics";
        }
        if (effect == "end_stop" || effect == "sensor_saturation" || effect == "output_curve" ||
            effect == "gravity_nonlinearity" || effect == "cubic_stiffness") {
            return "range";
        }
        if (effect == "coulomb_friction" || effect == "direction_dependent_friction" || effect == "backlash" ||
            effect == "quadratic_drag" || effect == "cogging") {
            return "motion";
        }
        if (effect == "sensor_offset" || effect == "sensor_drift" || effect == "load_disturbance" ||
            effect == "missed_counts") {
            return "bias";
        }
        return effect;
    };
    return place(a) != place(b);
}

}  // namespace stand::blind
