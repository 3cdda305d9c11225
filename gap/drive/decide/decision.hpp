// What a diagnosis answers.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "gap/verdict/outcome.hpp"

namespace gap {

struct Decision {
    Outcome outcome = Outcome::no_gap;
    std::vector<std::size_t> effects;         ///< into the ranking: the one, or the alternatives
    std::size_t chosen = 0;                   ///< into the ranking: what helps most, be it `none`
    std::optional<std::size_t> suspect = {};  ///< of an unknown: what leads, and is not enough to be named
    double base_gap = 0.0;
    double noise_floor = 0.0;  ///< as a gap
    double confidence = 0.0;
    bool disturbed = false;  ///< what is left is slow, and comes from no input
    std::vector<std::string> notes;

    void at_most(double bound) { confidence = confidence < bound ? confidence : bound; }
    /// Nothing is named, and the confidence is at most that.
    void refuse(double bound) {
        outcome = Outcome::unknown;
        effects.clear();
        at_most(bound);
    }
};

}  // namespace gap
