// From measured rows to what explains them: another program, or the core; and what a board would decide with.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gap/cycles/explain.hpp"
#include "qemu/timing/core_file.hpp"

namespace gap::cycles {

/// Predictions of any rows, for each variant of a core.
using PredictRows = std::function<std::vector<std::vector<qemu::PredictedCycles>>(
    const std::vector<qemu::MeasuredCycles>& rows, const std::vector<qemu::CoreVariant>& variants)>;

/// What a question calls the cores that it judges.
[[nodiscard]] std::string name_of_cores(const std::vector<std::string>& cores);

/// \param cores  the core files that are judged, one for each row; of such as pay for every effect the references are
///               themselves alone
/// \throws glsum::Failure as timing::read_named_core, and (bad input) where they pay for different effects
[[nodiscard]] Question question_about(std::vector<qemu::MeasuredCycles> rows, const std::vector<std::string>& cores,
                                      const std::filesystem::path& cores_folder);

/// Counts of instructions that differ need no core: another program was measured. Where rival rule sets explain the
/// same, the micro-loops that tell them apart are the next experiment.
[[nodiscard]] Explanation diagnose(const Question& question, const PredictRows& predict);

}  // namespace gap::cycles
