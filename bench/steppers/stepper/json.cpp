#include "bench/steppers/stepper/json.hpp"

namespace generate {

nlohmann::ordered_json cost_json(const StepCost& cost) {
    return {{"model_cycles", cost.cycles},       {"model_cycles_low", cost.low},    {"model_cycles_high", cost.high},
            {"instructions", cost.instructions}, {"state_bytes", cost.state_bytes}, {"table_bytes", cost.table_bytes},
            {"code_bytes", cost.code_bytes}};
}

void add_checks(nlohmann::ordered_json& json, const std::vector<CheckedBits>& checked) {
    for (const CheckedBits& one : checked) {
        json["checked"].push_back(
            {{"where", one.where}, {"steps", one.steps}, {"first_wrong", one.first_wrong}, {"good", one.good()}});
    }
}

}  // namespace generate
