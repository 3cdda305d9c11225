// An exam as files: questions answered and hashed, answers scored against a truth that was sealed.
#pragma once

#include <filesystem>

#include "cli/output.hpp"

namespace cli {

/// Answers every question of a manifest: OUT/NAME/verdict.json, or OUT/NAME/refused.txt with the reason, and
/// OUT/answers.sha256 with the hash of each. \param data  the folder of the logs; empty: the manifest's own \param out
/// must be new or empty
void run_exam(const std::filesystem::path& manifest, const std::filesystem::path& data,
              const std::filesystem::path& out, unsigned jobs);

/// Prints the table. \param answers  of `run_exam` \param json  for all numbers; where it is wanted
/// \throws glsum::Failure (bad input): an answer that is not what its hash says, or questions that differ from the
/// truth's
void score_exam(const std::filesystem::path& answers, const std::filesystem::path& truth, const Output& json);

}  // namespace cli
