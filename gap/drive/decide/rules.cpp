#include <stdexcept>
#include <string_view>

#include "gap/drive/decide/rule.hpp"

namespace gap {

const std::vector<Rule>& rules() {
    static const std::vector<Rule> all = {
        rule_of_clear_advantage,
        rule_of_what_can_be_foreseen,
        rule_of_what_cannot_be_parted,
        rule_of_fitted_forms,
        rule_of_rounded_readings,
        rule_of_what_is_no_noise,
        rule_of_patterns,
        rule_of_events_from_outside,
        rule_of_what_is_outdone,
        rule_of_smooth_laws,
        rule_of_few_alternatives,
        rule_of_logs_of_another_drive,
        rule_of_inputs_that_never_move,
        rule_of_suspects,
    };
    return all;
}

const Rule& rule_named(const char* name) {
    for (const Rule& rule : rules()) {
        if (std::string_view(rule.name) == name) {
            return rule;
        }
    }
    throw std::out_of_range(name);
}

}  // namespace gap
