// Blind cases put to the diagnosis. The one place where the stand's cases and the diagnosis meet.
#pragma once

#include <filesystem>

#include "gap/drive/question.hpp"

namespace cli {

/// A case: its model.json, or without one a base that is found as its case.json says; its train*.csv and validate*.csv
/// in the order of their names.
[[nodiscard]] gap::Question blind_question(const std::filesystem::path& folder);

/// Judges every case of a set, and hashes what was said: DIR/NNN/verdict.json and DIR/verdicts.sha256. One that cannot
/// be read is told and left out. \throws glsum::Failure (bad input) after all, where there was such a case
void judge_blind_cases(const std::filesystem::path& set, unsigned jobs);

}  // namespace cli
