// The verdict on cycles, from what explains them.
#pragma once

#include <string>

#include "gap/cycles/explain.hpp"
#include "gap/verdict/verdict.hpp"

namespace gap::cycles {

/// \param base  the core file that was judged
[[nodiscard]] Verdict verdict_of(const Explanation& found, const std::string& base);

}  // namespace gap::cycles
