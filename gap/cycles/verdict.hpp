// What was found of cycles, as a file and for people.
#pragma once

#include <string>

#include "gap/cycles/explain.hpp"

namespace gap::cycles {

/// Schema glsum-gap-1.
[[nodiscard]] std::string to_json(const Explanation& explanation);
/// Some lines for a terminal. \param base  the core file that was judged
[[nodiscard]] std::string to_text(const Explanation& explanation, const std::string& base);

}  // namespace gap::cycles
