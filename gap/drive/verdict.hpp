// The verdict on a drive, from what a diagnosis found: as a file, for people, and as a model that runs.
#pragma once

#include <string>

#include "gap/drive/diagnose.hpp"
#include "gap/verdict/page.hpp"
#include "gap/verdict/verdict.hpp"

namespace gap {

[[nodiscard]] Verdict verdict_of(const Answer& answer);
[[nodiscard]] std::string to_json(const Answer& answer);
[[nodiscard]] std::string to_text(const Answer& answer);
/// \param command  how it was asked, for the page; empty: not told
[[nodiscard]] std::string to_html(const Answer& answer, const std::string& command = {});

/// A model file with the chosen candidate's lasting effects in a field `effects`, which `glsum simulate` runs.
[[nodiscard]] std::string improved_model(const Answer& answer);
/// Events that the answer names: each is of one record, so that no model holds it.
[[nodiscard]] std::vector<std::string> events_of(const Answer& answer);

}  // namespace gap
