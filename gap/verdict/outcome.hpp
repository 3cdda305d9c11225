// In which of four ways a diagnosis ends.
#pragma once

namespace gap {

enum class Outcome {
    attributed,  ///< the named effect or effects together explain it
    ambiguous,   ///< these data cannot part those that would
    unknown,     ///< something is missing, and nothing listed explains it
    no_gap,
};

/// As files have it.
[[nodiscard]] const char* name_of(Outcome outcome);

}  // namespace gap
