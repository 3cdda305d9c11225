// The verdict as one page, offline: measured, base and base with the effect; the gap by segment; the ranking.
#pragma once

#include <string>

#include "gap/drive/diagnose.hpp"

namespace gap {

/// HTML with inline SVG; follows the reader's light or dark scheme.
[[nodiscard]] std::string to_html(const Answer& answer);

}  // namespace gap
