// Numbers that training leaves anywhere within a stretch.
#pragma once

#include "gap/drive/candidate.hpp"

namespace gap {

struct Settled {
    Candidate trained;
    std::size_t numbers = 0;  ///< that were told by the validation
};

/// A threshold between two levels of the training's input leaves the same wherever it lies between them, and a fit ends
/// there by chance. The validation, which may pass there, tells it.
[[nodiscard]] Settled settle(const Study& study, const Study& validation, const Candidate& trained);

}  // namespace gap
