// The next experiment: what training lacked, or the excitation under which alternatives part or named numbers become
// sharper, simulated to prove that they do.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gap/drive/decide.hpp"
#include "gap/verdict/curve.hpp"

namespace gap {

struct Proposal {
    std::string text;
    double apart = 0.0;  ///< rms by which the nearest alternative, refitted, misses the first, over the noise
    std::optional<NextRecord> record = {};  ///< what was simulated, of an excitation that is proposed
};

/// \param alternatives  two or more, as they were fitted \param noise  standard deviation of readings
[[nodiscard]] Proposal part(const Study& study, const std::vector<const Candidate*>& alternatives, double noise);

/// The excitation, beside the records that there are, after which the numbers of a candidate's lasting effects are
/// known best, with the factors by which their intervals shrink: from the slopes of what is simulated there, the base's
/// numbers and a new record's state fitted, too. \param named  as it was fitted \param whitener  of what it leaves in
/// training
[[nodiscard]] Proposal sharpen(const Study& study, const Candidate& named, const Whitener& whitener);

/// What is known when a verdict stands.
struct Finding {
    Outcome outcome;
    const Study& study;
    std::vector<const Candidate*> named;  ///< as they were fitted: the one, or the alternatives
    const Whitener& whitener;
    double noise;  ///< standard deviation of readings
    std::size_t input_levels;
    std::vector<std::string> extrapolated;  ///< what validation has and training lacks
};

[[nodiscard]] Proposal next_experiment(const Finding& finding);

}  // namespace gap
