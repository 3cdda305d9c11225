#pragma once

#include <string>

namespace bench {

/// The first line that a shell's command prints, or an empty text.
[[nodiscard]] std::string first_line(const std::string& command);

}  // namespace bench
