// The next experiment: the excitation under which alternatives part, simulated to prove that they do.
#pragma once

#include <string>

#include "gap/drive/ranking.hpp"

namespace gap {

struct Proposal {
    std::string text;
    double apart = 0.0;  ///< rms by which the nearest alternative, refitted, misses the first, over the noise
};

/// \param alternatives  two or more, as they were fitted \param noise  standard deviation of readings
[[nodiscard]] Proposal part(const Study& study, const std::vector<const Candidate*>& alternatives, double noise);

}  // namespace gap
