// Blind cases as folders: written, and read as questions to the diagnosis.
#pragma once

#include <cstdint>
#include <filesystem>

#include "gap/drive/question.hpp"

namespace cli {

/// Writes `count` cases into the folder, which must be new or empty, and prints the hash of the sealed truth first.
void write_blind_cases(std::size_t count, std::uint64_t seed, unsigned jobs, const std::filesystem::path& folder);

/// A case: its model.json, and its train*.csv and validate*.csv in the order of their names.
[[nodiscard]] gap::Question blind_question(const std::filesystem::path& folder);

}  // namespace cli
