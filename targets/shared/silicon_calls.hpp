// What the program `silicon` and the host that watches it agree on.
#pragma once

namespace firmware {

/// Calls of each row, one after the other; the last is what counts.
inline constexpr int silicon_calls = 12;

}  // namespace firmware
