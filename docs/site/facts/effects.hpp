// What each effect that the diagnosis looks for does to a log, by simulation: with it, beside without it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gap/drive/effect.hpp"

namespace docs {

/// An effect of the list, on the first of some plants where it can occur.
struct ShownEffect {
    const gap::Effect* effect;
    std::string plant;                  ///< in a sentence
    std::vector<gap::Written> numbers;  ///< as files write them: of its own starts the one that changes the log by
                                        ///< about a fifth of the output's deviation
    std::vector<double> time_s;
    std::vector<double> input;
    std::vector<double> without;
    std::vector<double> with;
    /// Effects whose change of the same log is a multiple of this one's, nearly: the cosine between both, the largest
    /// first, from 0.8 on. What gain, time scale, dead time and offset of a fitted base take up is taken out of either
    /// before, where the effect is not one of these itself. In [0, 1].
    std::vector<std::pair<std::string, double>> alike;
};

/// In the order of effects.def.
[[nodiscard]] std::vector<ShownEffect> shown_effects();

}  // namespace docs
