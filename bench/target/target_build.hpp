// What the target's firmware was built with, as its build writes it down.
#pragma once

#include <string>

namespace bench {

struct TargetBuild {
    std::string compiler;
    std::string flags;
};

/// Reads {"compiler": "...", "flags": "..."}; further fields are ignored. \param name  what messages call the text
/// \throws glsum::Failure (bad input) for other JSON, or a text of more than 4096 bytes.
[[nodiscard]] TargetBuild parse_target_build(const std::string& text, const std::string& name);

}  // namespace bench
