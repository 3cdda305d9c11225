#include "gap/drive/base/jointly.hpp"

#include <cmath>
#include <limits>

#include "gap/drive/fit.hpp"

namespace gap {

double joint_gap(const Question& question) {
    Question all = question;
    const bool split = question.validate.empty();
    const std::vector<std::vector<char>> aside =
        split ? part_counts(question.train, question.split_s, true) : all_count(question.validate);
    all.train.insert(all.train.end(), question.validate.begin(), question.validate.end());
    all.validate = all.train;
    all.split_s.reset();
    Ground ground = prepare(all);
    const Candidate fitted = fit(ground.study, {}, ground.base, nullptr);
    const std::vector<std::vector<double>> left = all_residuals(ground.study, fitted);
    const std::size_t first = split ? 0 : question.train.size();
    for (std::size_t r = 0; r < ground.study.counts.size(); ++r) {
        ground.study.counts[r] = r < first ? std::vector<char>(ground.study.counts[r].size(), 0) : aside[r - first];
    }
    const double gap = rms_of(ground.study, left) / output_deviation(ground.study);
    return std::isfinite(gap) ? gap : std::numeric_limits<double>::infinity();
}

}  // namespace gap
