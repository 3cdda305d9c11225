// The rows, what a core as it is described would take for them, and how far that is off.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "gap/cycles/explain.hpp"

namespace gap::cycles {

using Rows = std::vector<std::size_t>;
using Cycles = std::vector<double>;

[[nodiscard]] double median(std::vector<double> values);
[[nodiscard]] std::string placement_of(const qemu::MeasuredCycles& row);
/// Whether the call's code or data come over a bus that others use too.
[[nodiscard]] bool on_bus(const qemu::MeasuredCycles& row);

/// What a core pays.
struct State {
    std::string core;
    std::string set = {};
    std::set<std::string> off = {};
    std::map<std::string, double> factor = {};  // of what is not off and not 1
    double ratio = 1.0;                         // measured clock over the core's
    double overhead = 0.0;                      // cycles a call
    double maintenance = 0.0;                   // and beside them where caches are maintained
    double contention = 0.0;                    // a part of the call's cycles where it is on the bus
};

class Evidence {
public:
    Evidence(const Question& question, const Predict& predict);

    [[nodiscard]] const std::vector<qemu::MeasuredCycles>& rows() const { return question_.rows; }
    [[nodiscard]] const Cycles& measured() const { return measured_; }
    /// Every other row of each kernel and placement is fitted, the rest judge.
    [[nodiscard]] const Rows& to_fit() const { return fit_; }
    [[nodiscard]] const Rows& to_judge() const { return judge_; }
    [[nodiscard]] bool judged_by_itself() const { return judged_by_itself_; }
    /// Of the gap: from rows that were measured more than once; half a cycle otherwise, as counters are whole.
    [[nodiscard]] double floor() const;
    /// Sum of absolute differences over the sum of what was measured, each row divided by its `per`.
    [[nodiscard]] double gap(const Cycles& predicted, const Rows& rows) const;
    /// Of the rows that judge.
    [[nodiscard]] double judged_gap(const Cycles& predicted) const { return gap(predicted, judge_); }

    /// Those that are not known yet, all in one emulation.
    void simulate(const std::vector<State>& states);
    [[nodiscard]] const std::vector<qemu::PredictedCycles>& predicted(const State& state);
    /// Cycles of each row, without what lies beside the call.
    [[nodiscard]] Cycles inside(const State& state);
    [[nodiscard]] Cycles whole(const State& state);
    /// Sets the costs beside the call to what the rows say: medians, as counts have outliers to one side.
    void fit_beside(State& state, const Rows& rows);
    /// The gap of the rows to fit, the costs beside the call fitted to them.
    [[nodiscard]] double fitted_gap(State& state);

private:
    const Question& question_;
    const Predict& predict_;
    Cycles measured_;
    Rows fit_;
    Rows judge_;
    bool judged_by_itself_ = false;
    std::map<std::string, std::vector<qemu::PredictedCycles>> known_;
};

}  // namespace gap::cycles
