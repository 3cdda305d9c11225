// What a budget asks of the derivative itself.
#pragma once

#include <optional>

#include "bench/choose/derivative_errors.hpp"
#include "cli/budget.hpp"
#include "glsum/design/derivative.hpp"

namespace cli {

/// Adds the options `--derivative-error`, `--band`, `--step-until` and `--design`.
void add_goal(Command& command, Budget& budget);

/// Its band and step; nothing where --max-error asks about the sum.
/// \throws glsum::Failure (bad input) for options that contradict each other, or that no record can hold.
[[nodiscard]] std::optional<glsum::design::DerivativeGoal> derivative_goal(const Budget& budget);

/// Who says which filters there are. \throws glsum::Failure (bad input) for another word, or where a rule has no filter
[[nodiscard]] choose::FilterDesign filter_design(const Budget& budget);

/// The relative error that it allows: "5%" or "0.05". \throws glsum::Failure (bad input) for anything else
[[nodiscard]] double derivative_error(const Budget& budget);

}  // namespace cli
