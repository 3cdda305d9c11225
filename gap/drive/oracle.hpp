// What could have been known of records whose effect is known: that effect fitted as any candidate is, beside every
// other one; and what a plain criterion on the training records alone would have named.
#pragma once

#include <string>
#include <vector>

#include "gap/drive/question.hpp"

namespace gap {

struct Foresight {
    double gap_base = 0.0;   ///< without any effect, on the validation records
    double gap_after = 0.0;  ///< with the true effects
    /// Validation log-likelihood over that of the next best of `none` and all other single effects, each whitened by
    /// what the true effects leave in training.
    double lead = 0.0;
    std::string nearest;       ///< that one
    std::string by_plain_bic;  ///< `none`, or the single effect with the least criterion of the residuals as they are
    std::string by_whitened_bic;  ///< the same of residuals that each candidate's own autoregressive model whitens
};

/// \param truth  names of the effects that are there; those that no list has are left out, and without any `lead` is 0
/// \throws glsum::Failure (bad input) as `prepare`
[[nodiscard]] Foresight foresee(const Question& question, const std::vector<std::string>& truth);

}  // namespace gap
