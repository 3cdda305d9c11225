// The verdict as a file and for people.
#pragma once

#include <string>

#include "gap/drive/diagnose.hpp"

namespace gap {

/// Schema glsum-gap-1.
[[nodiscard]] std::string to_json(const Answer& answer);
/// A model file with the chosen candidate's lasting effects in a field `effects`, which `glsum simulate` runs.
[[nodiscard]] std::string improved_model(const Answer& answer);

/// Events that the answer names: each is of one record, so that no model holds it.
[[nodiscard]] std::vector<std::string> events_of(const Answer& answer);
/// The base with its numbers, how linear the records are, and each record's operating point; empty: a model was given.
[[nodiscard]] std::string base_line(const Answer& answer);
/// What leads where nothing is named, and what stays unexplained; empty: something is named, or nothing leads.
[[nodiscard]] std::string suspect_line(const Answer& answer);
/// Some lines for a terminal.
[[nodiscard]] std::string to_text(const Answer& answer);
[[nodiscard]] const char* name_of(Outcome outcome);

}  // namespace gap
