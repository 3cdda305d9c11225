// Where a drive and its simulation part, and which effect explains it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gap/drive/candidate.hpp"
#include "gap/locate.hpp"

namespace gap {

struct Question {
    drive::Form form;  ///< of the model that is judged, or of the kind that is fitted
    bool refit = false;
    std::vector<Record> train;
    std::vector<Record> validate;      ///< empty: parts of the training records are kept aside
    std::optional<double> split_s;     ///< the training records up to here, the rest of each for validation
    std::vector<std::string> without;  ///< effects that are taken off the list
    unsigned jobs = 1;
};

/// A candidate with what it leaves on data that it has not fitted.
struct Ranked {
    Candidate candidate;
    std::vector<std::vector<double>> residuals;  ///< of the validation records
    double gap_after;                            ///< rms of what counts over the deviation of the measured output
    double log_likelihood;                       ///< over what counts
    std::vector<double> by_sample;               ///< its summands
    double score;                                ///< higher is better
};

enum class Outcome { attributed, ambiguous, unknown, no_gap };

struct Answer {
    Outcome outcome;
    std::vector<std::size_t> effects;  ///< indices into `ranking`: the one, or the alternatives
    std::vector<Ranked> ranking;       ///< the best first; `none` is among them
    double base_gap;
    double noise_floor;
    double confidence;
    Whitener whitener;
    Where where;  ///< of the base's gap
    bool split;   ///< no validation record was given
    std::string next_experiment;
    std::vector<std::string> notes;
};

[[nodiscard]] Answer diagnose(const Question& question, const std::function<void(const std::string&)>& say);

}  // namespace gap
