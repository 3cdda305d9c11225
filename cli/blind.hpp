// `stand --blind`: cases whose effect a sealed file alone names.
#pragma once

#include <cstdint>
#include <filesystem>

namespace cli {

/// Writes `count` cases into the folder, which must be new or empty, and prints the hash of the sealed truth first.
void write_blind_cases(std::size_t count, std::uint64_t seed, unsigned jobs, const std::filesystem::path& folder);

}  // namespace cli
