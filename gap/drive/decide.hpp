// From a ranking to a verdict.
#pragma once

#include <optional>

#include "gap/drive/ranking.hpp"

namespace gap {

enum class Outcome { attributed, ambiguous, unknown, no_gap };

struct Decision {
    Outcome outcome = Outcome::no_gap;
    std::vector<std::size_t> effects;         ///< into the ranking: the one, or the alternatives
    std::size_t chosen = 0;                   ///< into the ranking: what helps most, be it `none`
    std::optional<std::size_t> suspect = {};  ///< of an unknown: what leads, and is not enough to be named
    double base_gap = 0.0;
    double noise_floor = 0.0;  ///< as a gap
    double confidence = 0.0;
    std::vector<std::string> notes;
};

/// \param ranking  the best first, `none` among them
/// \param whitener  of the ranking's likelihoods
[[nodiscard]] Decision decide(const std::vector<Ranked>& ranking, const Whitener& whitener, const Study& study,
                              const Study& validation, bool same_records);

}  // namespace gap
