// Where a drive and one base part, and which effect explains it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gap/drive/base/find.hpp"
#include "gap/drive/decide.hpp"
#include "gap/drive/question.hpp"
#include "gap/drive/residuals/locate.hpp"
#include "gap/verdict/curve.hpp"

namespace gap {

struct Answer {
    Decision decision;
    std::vector<Ranked> ranking;  ///< the best first; `none` is among them
    Whitener whitener;
    Where where;                  ///< of the base's gap
    std::vector<Record> records;  ///< what it was judged on
    std::string metric;
    bool split = false;                     ///< judged by parts of the training records that were kept aside
    drive::Model base;                      ///< as judged, or as fitted without any effect
    std::vector<std::string> extrapolated;  ///< what validation has and training lacks, in words
    std::string next_experiment;
    std::optional<NextRecord> next_record;  ///< of the experiment, where one was simulated
    std::vector<std::string> notes;
    [[nodiscard]] const Ranked& none() const;
    [[nodiscard]] const Ranked& chosen() const { return ranking[decision.chosen]; }
    /// The model with its parameters as the candidate has them, effects aside.
    [[nodiscard]] drive::Model model_of(const Candidate& candidate) const;
    std::optional<drive::Form> form;
    bool refit = false;
    double idle_input = 0.0;              ///< Base::idle_input: the numbers of effects are counted from it, too
    std::string base_name;                ///< of a base that was found or fitted; empty: a model was given
    double linear_share = 0.0;            ///< of the validation output's variance, by the best linear description
    std::vector<Described> descriptions;  ///< of a base that was looked for, the best first
    bool lag_wanted = false;              ///< what helps most is linear, beside a fitted base: a richer one has it
    bool place_wanted = false;            ///< half more than the noise is left, and `speed_hides_effects`
    bool leaves_noise = false;            ///< alone: no other base leaves less
};

/// Of the output's variance, that a description explains which leaves such a gap.
[[nodiscard]] double linear_share_of(double gap);

/// Beside the question's form. \throws glsum::Failure (bad input): a base that runs away. \param say  told of progress
[[nodiscard]] Answer answer_to(const Question& question, const std::function<void(const std::string&)>& say);

}  // namespace gap
