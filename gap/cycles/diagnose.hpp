// From measured rows to what explains them: another program, or the core; and what a board would decide with.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gap/cycles/explain.hpp"

namespace gap::cycles {

/// Predictions of any rows, for each variant of a core.
using PredictRows = std::function<std::vector<std::vector<qemu::PredictedCycles>>(
    const std::vector<qemu::MeasuredCycles>& rows, const std::vector<qemu::CoreVariant>& variants)>;

/// \param core  the core file that is judged; of one that pays for every effect the references are itself alone
/// \throws glsum::Failure as timing::read_named_core
[[nodiscard]] Question question_about(std::vector<qemu::MeasuredCycles> rows, const std::string& core,
                                      const std::filesystem::path& cores_folder);

/// Counts of instructions that differ need no core: another program was measured. Where rival rule sets explain the
/// same, the micro-loops that tell them apart are the next experiment.
[[nodiscard]] Explanation diagnose(const Question& question, const PredictRows& predict);

}  // namespace gap::cycles
