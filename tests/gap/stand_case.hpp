// Cases from the virtual stand, which shares no code and no formula with the effects: a linear model, and logs of a
// stand with something else in it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "drive/stand/experiment.hpp"
#include "gap/drive/diagnose.hpp"

namespace gap_test {

using Sizes = std::vector<std::pair<std::string, double>>;

/// Inertia, damping and weight alone, read every 20 ms.
[[nodiscard]] stand::Stand linear_stand();

/// What that stand is as a model.
[[nodiscard]] drive::Form linear_form();

struct Run {
    std::string experiment = "staircase";
    double duty = 0.1;
    double low_duty = 0.0;
    double until_s = 20.0;
    std::uint64_t seed = 1;
    double noise_rad = 0.003;
    double colour = 0.0;  ///< of the noise: from sample to sample, so much of it stays
};

/// A log of the linear stand with these sizes set.
[[nodiscard]] gap::Record log_of(const Sizes& sizes, const Run& run);

/// The linear model, with logs of a stand that has these sizes.
[[nodiscard]] gap::Question question_of(const Sizes& sizes, const Run& train, const Run& validate,
                                        const std::vector<std::string>& without = {});

/// The linear model judged by a staircase and by bits that it has not been fitted to.
[[nodiscard]] gap::Answer ask(const Sizes& sizes, const Run& train, const Run& validate,
                              const std::vector<std::string>& without = {});
[[nodiscard]] gap::Answer ask(const Sizes& sizes, std::uint64_t seed = 1, const std::vector<std::string>& without = {});

/// The names that the verdict gives: one for an attribution, several for an ambiguity.
[[nodiscard]] std::vector<std::string> names(const gap::Answer& answer);

/// A lasting parameter of the chosen candidate, "effect.parameter"; not a number if there is none.
[[nodiscard]] const gap::FreeParameter* find(const gap::Answer& answer, const std::string& name);

}  // namespace gap_test
