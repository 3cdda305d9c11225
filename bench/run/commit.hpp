// Which sources results are of.
#pragma once

#include <filesystem>
#include <string>

namespace bench {

struct Commit {
    std::string hash = "unknown";   ///< 40 digits
    std::string dirty = "unknown";  ///< "true": what is tracked has changed since; without git nobody knows
};

/// Of a checkout; without git, as on an empty Debian, from what git keeps in it.
[[nodiscard]] Commit commit_of(const std::filesystem::path& checkout);

}  // namespace bench
