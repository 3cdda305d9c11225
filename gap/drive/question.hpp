// What is asked: a model, the records that are fitted and those that are judged; and what a diagnosis makes of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gap/drive/candidate.hpp"

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
    double operating_output = 0.0;         ///< of a given model: the point that its output is about
    std::optional<Domain> domain = {};     ///< what the plant is: effects that cannot be there are left out
    std::string base_name = {};            ///< of a fitted form
    bool given_form = false;               ///< of a model that is refitted: a linear effect is no other form of it
    bool find = false;                     ///< the base is looked for: `form` is none yet
    bool metric_free = false;              ///< predictions where the base that is found rests nowhere
    bool past_ends = false;                ///< what is at an end is not counted: a base is looked for
    bool from_no_input = false;            ///< Base::from_no_input
    double idle_input = 0.0;               ///< Base::idle_input
    std::optional<double> horizon_s = {};  ///< of predictions; a fiftieth of the record unless it is given
};

/// The studies of a question.
struct Ground {
    Audit found;
    Study study;                      ///< what is fitted
    Study sketch;                     ///< the same records, thinner and on coarser grids, for first looks
    Study validation;                 ///< what is judged
    Candidate base;                   ///< the base as first fitted, or as it is given
    bool same_records;                ///< judged are parts of the fitted records that were kept aside
    std::vector<const Effect*> list;  ///< effects that can occur in these records and are asked for
    std::vector<Record> thin;         ///< those of the sketch
};

/// \throws glsum::Failure (bad input): records and model that cannot belong together.
/// The question must outlive the ground, which looks at its records.
[[nodiscard]] Ground prepare(const Question& question);

/// Whether effects are off the list only because the base is one lag, whose output may be a speed: a speed has no place
/// where a spring or a weight would pull.
[[nodiscard]] bool speed_hides_effects(const Question& question, Scales scales);

}  // namespace gap
