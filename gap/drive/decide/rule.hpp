// A step of the decision, with its name and its reason.
#pragma once

#include <vector>

#include "gap/drive/decide/decision.hpp"
#include "gap/drive/decide/evidence.hpp"

namespace gap {

struct Rule {
    const char* name;
    const char* reason;
    void (*apply)(const Evidence& evidence, Decision& decision);  ///< behind those before it
};

/// In the order in which they are applied, each file's together: a later one sees what the earlier ones made.
[[nodiscard]] const std::vector<Rule>& rules();
/// \throws std::out_of_range
[[nodiscard]] const Rule& rule_named(const char* name);

/// Of the squared gap: a cause that leaves less is the main one.
constexpr double rest_of_a_main_cause = 0.2;

/// What a model without physics foresees of what is left.
struct Foreseeable {
    double share = 0.0;        ///< of the squared gap that is left; 0: nothing that is certain
    double left = 0.0;         ///< the gap without it
    double of_closable = 0.0;  ///< of the squared gap that can be closed
    bool is_too_much = false;  ///< to be overlooked
    /// What takes so much of the closable squared gap of a fitted form is its cause, though the rest can be foreseen:
    /// of something else, which is said in per cent.
    [[nodiscard]] bool is_minor() const { return of_closable < rest_of_a_main_cause; }
};
[[nodiscard]] Foreseeable foreseeable(const Evidence& evidence, const Decision& decision);

// choose.cpp
extern const Rule rule_of_clear_advantage;
extern const Rule rule_of_rounded_readings;
// remainder.cpp
extern const Rule rule_of_what_can_be_foreseen;
extern const Rule rule_of_what_is_no_noise;
extern const Rule rule_of_patterns;
// alternatives.cpp
extern const Rule rule_of_what_cannot_be_parted;
extern const Rule rule_of_few_alternatives;
// smooth_laws.cpp
extern const Rule rule_of_smooth_laws;
// doubts.cpp
extern const Rule rule_of_fitted_forms;
extern const Rule rule_of_events_from_outside;
extern const Rule rule_of_what_is_outdone;
extern const Rule rule_of_logs_of_another_drive;
extern const Rule rule_of_inputs_that_never_move;
extern const Rule rule_of_suspects;

}  // namespace gap
