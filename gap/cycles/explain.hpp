// Where predicted and measured cycles part, and which effects of the timing model explain it.
//
// A core is described by a share of each effect that it pays: 0 for none of it, 1 for what the core file says. The base
// is such a description (m7-ideal pays nothing). From a reference core that pays everything, what these rows do not
// show is taken away; what is left, with costs beside the kernel fitted on half of the rows, is the explanation, told
// as steps from the base, each judged on the other half.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gap/verdict/outcome.hpp"
#include "gap/verdict/where.hpp"
#include "qemu/emulate/silicon.hpp"

namespace gap::cycles {

/// Predictions of all rows, for each variant of a core.
using Predict =
    std::function<std::vector<std::vector<qemu::PredictedCycles>>(const std::vector<qemu::CoreVariant>& variants)>;

struct Question {
    std::vector<qemu::MeasuredCycles> rows;
    std::string base;                     ///< the core file that is judged
    std::vector<std::string> references;  ///< core files that pay all effects; the one that fits best is taken
    std::map<std::string, std::vector<std::string>> sets;     ///< of each reference: its rule sets
    std::map<std::string, std::vector<std::string>> fitting;  ///< of each reference: those that fit silicon
    std::vector<std::string> base_off;                        ///< effects that the base does not pay
};

struct Interval {
    double low;
    double high;
};

/// One step from the base towards the measurement.
struct Step {
    std::string effect;
    std::map<std::string, double> parameters;
    std::map<std::string, Interval> interval;  ///< 95 %, by resampling rows
    double gap_before;
    double gap_after;
    double confidence;
};

struct Explanation {
    Outcome outcome = Outcome::no_gap;
    std::vector<Step> steps;
    std::vector<Step> alternatives;  ///< of the last step of an ambiguous verdict: each explains the same
    std::string apart;               ///< what the alternatives are about, for people
    double base_gap = 0.0;
    double after_gap = 0.0;
    double floor = 0.0;
    std::string reference;
    WhereInRows where;  ///< the base's gap lies
    std::vector<std::string> notes;
    std::string next_experiment;
};

[[nodiscard]] Explanation explain(const Question& question, const Predict& predict);

/// Sum of absolute differences over the sum of what was measured.
[[nodiscard]] double gap_of(const std::vector<double>& measured, const std::vector<double>& predicted,
                            const std::vector<std::size_t>& rows);

}  // namespace gap::cycles
