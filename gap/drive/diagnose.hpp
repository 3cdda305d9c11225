// Where a drive and its simulation part, and which effect explains it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gap/drive/decide.hpp"
#include "gap/locate.hpp"

namespace gap {

enum class Metric { simulation, prediction };

struct Question {
    drive::Form form;  ///< of the model that is judged, or of the kind that is fitted
    bool refit = false;
    std::vector<Record> train;
    std::vector<Record> validate;   ///< empty: parts of the training records are kept aside
    std::optional<double> split_s;  ///< the training records up to here, the rest of each for validation
    Metric metric = Metric::simulation;
    std::vector<std::string> without;  ///< effects that are taken off the list
    unsigned jobs = 1;
};

struct Answer {
    Decision decision;
    std::vector<Ranked> ranking;  ///< the best first; `none` is among them
    Whitener whitener;
    Where where;                  ///< of the base's gap
    std::vector<Record> records;  ///< what it was judged on
    std::string metric;
    bool split = false;  ///< no validation record was given
    drive::Model base;   ///< as judged, or as fitted without any effect
    std::string next_experiment;
    std::vector<std::string> notes;
    [[nodiscard]] const Ranked& none() const;
    [[nodiscard]] const Ranked& chosen() const { return ranking[decision.chosen]; }
    /// The model with its parameters as the candidate has them, effects aside.
    [[nodiscard]] drive::Model model_of(const Candidate& candidate) const;
    std::optional<drive::Form> form;
    bool refit = false;
};

/// \throws glsum::Failure (bad input): records and model that cannot belong together: a dead time as long as the
/// record, stamps or readings in other units, a model that runs away. \param say  told of progress
[[nodiscard]] Answer diagnose(const Question& question, const std::function<void(const std::string&)>& say);

}  // namespace gap
