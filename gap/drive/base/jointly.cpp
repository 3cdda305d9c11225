#include "gap/drive/base/jointly.hpp"

#include <cmath>
#include <limits>

#include "gap/drive/fit.hpp"

namespace gap {
namespace {

// A candidate as it stands on its training and on its validation records, in this order.
Candidate in_both(const Ranked& ranked, bool split) {
    Candidate both = ranked.trained;
    if (!split) {
        both.own.insert(both.own.end(), ranked.candidate.own.begin(), ranked.candidate.own.end());
    }
    return both;
}

double joint_gap_with(const Question& question, const Ranked* with) {
    Question all = question;
    const bool split = question.validate.empty();
    const std::vector<std::vector<char>> aside =
        split ? part_counts(question.train, question.split_s, true) : all_count(question.validate);
    all.train.insert(all.train.end(), question.validate.begin(), question.validate.end());
    all.validate = all.train;
    all.split_s.reset();
    Ground ground = prepare(all);
    const Candidate fitted = with != nullptr ? fit(ground.study, with->trained.effects, in_both(*with, split), nullptr)
                                             : fit(ground.study, {}, ground.base, nullptr);
    const std::vector<std::vector<double>> left = all_residuals(ground.study, fitted);
    const std::size_t first = split ? 0 : question.train.size();
    for (std::size_t r = 0; r < ground.study.counts.size(); ++r) {
        ground.study.counts[r] = r < first ? std::vector<char>(ground.study.counts[r].size(), 0) : aside[r - first];
    }
    const double gap = rms_of(ground.study, left) / output_deviation(ground.study);
    return std::isfinite(gap) ? gap : std::numeric_limits<double>::infinity();
}

}  // namespace

double joint_gap(const Question& question) { return joint_gap_with(question, nullptr); }
double joint_gap(const Question& question, const Ranked& with) { return joint_gap_with(question, &with); }

}  // namespace gap
