// Blind cases as folders: written, and read as questions to the diagnosis.
#pragma once

#include <cstdint>
#include <filesystem>

#include "gap/drive/question.hpp"

namespace cli {

/// Writes `count` cases into the folder, which must be new or empty, and prints the hash of the sealed truth first.
void write_blind_cases(std::size_t count, std::uint64_t seed, unsigned jobs, const std::filesystem::path& folder);

/// The same without a model: DIR/NNN/ with case.json, train*.csv and validate*.csv.
void write_open_cases(std::size_t count, std::uint64_t seed, unsigned jobs, const std::filesystem::path& folder);

/// Whether a folder holds a model.json or a case.json.
[[nodiscard]] bool is_blind_case(const std::filesystem::path& folder);

/// A case: its model.json, or without one a base that is found as its case.json says; its train*.csv and validate*.csv
/// in the order of their names.
[[nodiscard]] gap::Question blind_question(const std::filesystem::path& folder);

}  // namespace cli
