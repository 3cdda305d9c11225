// Records that could be taken next, on a rig as it is known.
#pragma once

#include <string>
#include <vector>

#include "gap/drive/candidate.hpp"
#include "gap/verdict/curve.hpp"

namespace gap {

/// A record that could be taken, its output not yet simulated.
struct Trial {
    std::string text;
    Record record;
    double released_at = 0.0;  ///< where nothing is put in: from here, in parts of the furthest that it has been
};

/// Those of 32 samples and more: excitations over the levels that the records have, further inputs at rest; of a rig
/// without an input, releases from no further out than it has been.
[[nodiscard]] std::vector<Trial> trials_of(const Study& study);

/// A candidate as it begins in a trial: at rest before it, nothing happening to it.
[[nodiscard]] Candidate begun(const Study& study, const Candidate& fitted, const Trial& trial);

/// The trial as it is drawn, without outputs; its input as logged.
[[nodiscard]] NextRecord drawn_of(const Study& study, const Trial& trial);

}  // namespace gap
