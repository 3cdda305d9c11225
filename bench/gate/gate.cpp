#include "bench/gate/gate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <unordered_map>
#include <unordered_set>

#include "base/glob.hpp"
#include "bench/gate/host_time.hpp"
#include "bench/gate/percent.hpp"
#include "bench/gate/row_table.hpp"
#include "bench/gate/shared_targets.hpp"
#include "bench/rows/key.hpp"

namespace bench::gate {
namespace {

std::optional<double> number(const Json& row, const std::string& counter) {
    const auto found = row.find(counter);
    return found != row.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

std::optional<double> relative_change(double baseline, double current) {
    return baseline != 0.0 ? std::optional(current / baseline - 1.0) : std::nullopt;
}

// Which rules speak of a counter: asked for every counter of every row, so each name is matched once.
class CounterRules {
public:
    explicit CounterRules(const Rules& rules) : rules_(rules) {}
    bool wants(std::size_t rule, const std::string& counter) {
        auto [found, is_new] = known_.try_emplace(counter);
        if (is_new) {
            for (const Rule& other : rules_) {
                found->second.push_back(other.wants_counter(counter));
            }
        }
        return found->second[rule];
    }

private:
    const Rules& rules_;
    std::unordered_map<std::string, std::vector<bool>> known_;
};

class Judge {
public:
    Judge(const Results& baseline, const Results& current, const Rules& rules)
        : rules_(rules),
          counters_(rules),
          selection_(selection_of(baseline.context)),
          baseline_(baseline),
          current_(current) {
        std::vector<std::string> selected;
        std::copy_if(baseline_.names().begin(), baseline_.names().end(), std::back_inserter(selected),
                     [&](const std::string& name) { return base::matches_any(selection_, name); });
        const SharedTargets shared(selected, current_.names(), current.context);
        const auto of_shared = [&](const std::vector<std::string>& names) {
            std::vector<std::string> rows;
            std::copy_if(names.begin(), names.end(), std::back_inserter(rows),
                         [&](const std::string& name) { return shared.has(name); });
            return rows;
        };
        verdict_.rows = of_shared(selected);
        theirs_ = of_shared(current_.names());
        if (shared.none()) {
            verdict_.differences = {{"targets", shared.of_baseline(), shared.of_current(), Effect::incomparable}};
            return;
        }
        verdict_.not_judged = shared.not_judged();
        verdict_.differences = differences({baseline.context, selected}, {current.context, current_.names()});
        advisory_ = has_effect(verdict_.differences, Effect::advisory);
    }

    Verdict verdict() {
        if (has_effect(verdict_.differences, Effect::incomparable)) {
            verdict_.status = glsum::Exit::not_comparable;
            verdict_.not_judged.clear();  // nothing was
            return verdict_;
        }
        lost_and_new_rows();
        answers();
        for (const Layer layer : {Layer::accuracy, Layer::instructions_and_bytes, Layer::model_cycles}) {
            values(layer);
        }
        times();
        if (rules_that_spoke_.empty() && verdict_.with(Level::fail) == 0) {
            throw glsum::Failure(
                glsum::Exit::bad_input,
                "no rule of the thresholds speaks of any counter in the baseline: nothing can be judged");
        }
        std::stable_sort(verdict_.findings.begin(), verdict_.findings.end(), [](const Finding& a, const Finding& b) {
            return std::pair(a.layer, a.level) < std::pair(b.layer, b.level);
        });
        verdict_.status = verdict_.with(Level::fail) > 0 ? glsum::Exit::check_failed : glsum::Exit::good;
        return verdict_;
    }

private:
    void add(Finding finding) {
        LayerCount& count = verdict_.count(finding.layer);
        count.failed += finding.level == Level::fail ? 1 : 0;
        count.warned += finding.level == Level::warn ? 1 : 0;
        count.better += finding.level == Level::improvement ? 1 : 0;
        verdict_.findings.push_back(std::move(finding));
    }

    void note(Layer layer, const std::string& row, const std::string& what) {
        Finding finding;
        finding.level = Level::note;
        finding.layer = layer;
        finding.row = row;
        finding.what = what;
        add(std::move(finding));
    }

    // Rows of a kernel that is gone altogether are one finding; so are those of a new one.
    void lost_and_new_rows() {
        std::unordered_set<std::string> theirs;
        std::vector<std::string> added;
        for (const std::string& name : theirs_) {
            theirs.insert(kernel_of(name));
            if (baseline_.find(name) == nullptr && base::matches_any(selection_, name)) {
                added.push_back(name);
            }
        }
        std::unordered_set<std::string> ours;
        std::map<std::string, std::size_t> lost_kernels;
        for (const std::string& name : verdict_.rows) {
            const std::string kernel = kernel_of(name);
            ours.insert(kernel);
            ++verdict_.count(Layer::rows).compared;
            if (current_.find(name) != nullptr) {
                continue;
            }
            if (!kernel.empty() && !theirs.contains(kernel)) {
                ++lost_kernels[kernel];
            } else {
                lost(name, "the row is missing");
            }
        }
        for (const auto& [kernel, rows] : lost_kernels) {
            lost(rows_of(kernel), fmt::format("the kernel is lost: all {} of its rows are missing", rows));
        }
        std::map<std::string, std::size_t> new_kernels;
        for (const std::string& name : added) {
            const std::string kernel = kernel_of(name);
            if (!kernel.empty() && !ours.contains(kernel)) {
                ++new_kernels[kernel];
            } else {
                note(Layer::rows, name, "a new row, not in the baseline");
            }
        }
        for (const auto& [kernel, rows] : new_kernels) {
            note(Layer::rows, rows_of(kernel), fmt::format("a new kernel: {} rows that are not in the baseline", rows));
        }
    }

    void lost(const std::string& row, const std::string& what) {
        Finding finding;
        finding.level = Level::fail;
        finding.layer = Layer::rows;
        finding.row = row;
        finding.what = what;
        finding.reason = "what is not measured cannot be guarded";
        add(std::move(finding));
    }

    // What the current run says, where it says something that can be judged at this layer.
    const Measured* judged(Layer layer, const std::string& name) {
        const Measured* now = current_.find(name);
        if (now == nullptr || baseline_.find(name)->wrong()) {
            return nullptr;
        }
        if (moot_.contains(subject_of(name))) {
            ++verdict_.count(layer).moot;
            return nullptr;
        }
        return now;
    }

    void answers() {
        for (const std::string& name : verdict_.rows) {
            const Measured* now = current_.find(name);
            if (now == nullptr) {
                continue;
            }
            ++verdict_.count(Layer::answer).compared;
            const bool was_wrong = baseline_.find(name)->wrong();
            if (!now->wrong() && !was_wrong) {
                continue;
            }
            if (now->wrong()) {
                moot_.insert(subject_of(name));
            }
            Finding finding;
            finding.layer = Layer::answer;
            finding.row = name;
            finding.level = now->wrong() ? Level::fail : Level::improvement;
            finding.what = now->wrong() ? now->error() + (was_wrong ? " (in the baseline too)" : "")
                                        : "right now; wrong in the baseline";
            finding.reason = "a wrong answer is of no use at any speed";
            add(std::move(finding));
        }
    }

    // The first rule of a level that speaks of the counter.
    const Rule* first_rule(Layer layer, bool fails, const std::vector<std::size_t>& of_row,
                           const std::string& counter) {
        for (const std::size_t r : of_row) {
            if (rules_[r].layer == layer && rules_[r].fails == fails && counters_.wants(r, counter)) {
                rules_that_spoke_.insert(r);
                return &rules_[r];
            }
        }
        return nullptr;
    }

    std::vector<std::size_t> rules_of_row(Layer layer, const std::string& name) const {
        std::vector<std::size_t> of_row;
        for (std::size_t r = 0; r < rules_.size(); ++r) {
            if (rules_[r].layer == layer && rules_[r].wants_row(name)) {
                of_row.push_back(r);
            }
        }
        return of_row;
    }

    void values(Layer layer) {
        for (const std::string& name : verdict_.rows) {
            const std::vector<std::size_t> of_row = rules_of_row(layer, name);
            if (of_row.empty()) {
                continue;
            }
            for (const auto& [counter, value] : baseline_.find(name)->first().items()) {
                if (!is_counter(counter, value)) {
                    continue;
                }
                const Rule* fails = first_rule(layer, true, of_row, counter);
                const Rule* warns = first_rule(layer, false, of_row, counter);
                const Measured* now = fails != nullptr || warns != nullptr ? judged(layer, name) : nullptr;
                if (now != nullptr) {
                    this->value(layer, name, counter, value.get<double>(), number(now->first(), counter), fails, warns);
                }
            }
        }
    }

    void value(Layer layer, const std::string& row, const std::string& counter, double then, std::optional<double> now,
               const Rule* fails, const Rule* warns) {
        ++verdict_.count(layer).compared;
        const Rule& main = fails != nullptr ? *fails : *warns;
        Finding finding;
        finding.layer = layer;
        finding.row = row;
        finding.counter = counter;
        finding.baseline = then;
        finding.current = now;
        if (!now) {
            finding.level = main.fails ? Level::fail : Level::warn;
            finding.what = fmt::format("the counter is missing; {} in the baseline", then);
            finding.reason = main.reason;
            add(std::move(finding));
            return;
        }
        finding.change = relative_change(then, *now);
        const std::string change = finding.change ? " (" + percent(*finding.change, 3) + ")" : "";
        finding.what = fmt::format("{} -> {}{}", then, *now, change);
        for (const Rule* rule : {fails, warns}) {
            if (rule != nullptr && rule->excess(then, *now) > 0.0) {
                finding.level = rule->fails ? Level::fail : Level::warn;
                finding.reason = rule->reason;
                add(std::move(finding));
                return;
            }
        }
        const bool better =
            (main.better == Better::lower && *now < then) || (main.better == Better::higher && *now > then);
        // What may get worse by so much without a word must get better by more to be worth one.
        double allowed = std::numeric_limits<double>::infinity();
        for (const Rule* rule : {fails, warns}) {
            allowed = rule != nullptr ? std::min(allowed, rule->allowed(then)) : allowed;
        }
        if (better && std::fabs(*now - then) > allowed) {
            finding.level = Level::improvement;
            add(std::move(finding));
        }
    }

    std::optional<Timing> timing(const RowTable& table, const std::string& name, const std::string& anchor_row,
                                 std::string& why_not) const {
        const Measured* anchor = table.find(anchor_row);
        const Measured* kernel = table.find(name);
        if (anchor == nullptr || anchor->wrong()) {
            why_not = "no row of the anchor";
            return std::nullopt;
        }
        Timing timing{kernel->times(), anchor->times()};
        const auto usable = [](const std::vector<double>& times) {
            return times.size() >= least_repetitions &&
                   std::all_of(times.begin(), times.end(), [](double time) { return time > 0.0; });
        };
        if (!usable(timing.kernel) || !usable(timing.anchor)) {
            why_not = fmt::format("fewer than {} repetitions; measure with bench --repetitions", least_repetitions);
            return std::nullopt;
        }
        return timing;
    }

    // The witness of this order and length that moved most, if beyond half of what is allowed to kernels: some suffer
    // more.
    std::string what_moved(const Rule& rule, const std::string& anchor_row) const {
        std::string what;
        double most = 0.5 * rule.relative;
        for (const std::string& name : verdict_.rows) {
            const std::string kernel = kernel_of(name);
            if (kernel == rule.anchor || !base::matches_any(rule.witnesses, kernel) ||
                row_of(rule.anchor, name) != anchor_row) {
                continue;
            }
            std::string why_not;
            const auto then = timing(baseline_, name, anchor_row, why_not);
            const auto now = timing(current_, name, anchor_row, why_not);
            if (!then || !now) {
                continue;
            }
            if (const double moved = movement(*then, *now); moved > most) {
                most = moved;
                what = fmt::format(
                    "{}, whose code is not ours, moved by {:.0f} % against {}: one of the runs shared its core", kernel,
                    100.0 * moved, rule.anchor);
            }
        }
        return what;
    }

    void times() {
        std::map<std::string, std::size_t> not_judged;                         // by reason
        std::map<std::pair<const Rule*, std::string>, std::string> unsettled;  // by the anchor's row: what moved there
        for (const std::string& name : verdict_.rows) {
            const std::vector<std::size_t> of_row = rules_of_row(Layer::host_time, name);
            const Rule* fails = first_rule(Layer::host_time, true, of_row, std::string(name_of(Counter::cpu_time)));
            const Rule* warns = first_rule(Layer::host_time, false, of_row, std::string(name_of(Counter::cpu_time)));
            if (fails == nullptr && warns == nullptr) {
                continue;
            }
            const Rule& rule = fails != nullptr ? *fails : *warns;
            const std::string kernel = kernel_of(name);
            if (kernel.empty() || kernel == rule.anchor || base::matches_any(rule.witnesses, kernel) ||
                judged(Layer::host_time, name) == nullptr) {
                continue;
            }
            const std::string anchor_row = row_of(rule.anchor, name);
            std::string why_not;
            const auto old_times = timing(baseline_, name, anchor_row, why_not);
            const auto new_times = timing(current_, name, anchor_row, why_not);
            if (why_not.empty()) {
                const auto [at, first] = unsettled.try_emplace({&rule, anchor_row});
                if (first) {
                    at->second = what_moved(rule, anchor_row);
                }
                why_not = at->second;
            }
            if (!why_not.empty()) {
                ++verdict_.count(Layer::host_time).not_judged;
                ++not_judged[why_not];
                continue;
            }
            time(name, rule, time_change(*old_times, *new_times, rule.confidence));
        }
        for (const auto& [why, rows] : not_judged) {
            note(Layer::host_time, "*/host", fmt::format("{} rows not judged: {}", rows, why));
            not_judged_besides(fmt::format("{} host times, {}", rows, why));
        }
        const auto any_timed = [&](const std::vector<std::string>& names) {
            return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
                return kind_of(name) == Kind::host && base::matches_any(selection_, name);
            });
        };
        if (!any_timed(verdict_.rows) && any_timed(current_.names())) {
            not_judged_besides("host times, of which the baseline has none");
        }
    }

    void not_judged_besides(const std::string& what) {
        verdict_.not_judged += (verdict_.not_judged.empty() ? "" : "; ") + what;
    }

    void time(const std::string& row, const Rule& rule, const TimeChange& change) {
        ++verdict_.count(Layer::host_time).compared;
        Finding finding;
        finding.layer = Layer::host_time;
        finding.row = row;
        finding.counter = std::string(name_of(Counter::cpu_time));
        finding.change = change.estimate;
        finding.change_low = change.low;
        finding.change_high = change.high;
        finding.reason = rule.reason;
        finding.what = fmt::format("{:+.1f} % ({:+.1f} to {:+.1f} %) of the time of {}", 100.0 * change.estimate,
                                   100.0 * change.low, 100.0 * change.high, rule.anchor);
        if (change.low > rule.relative) {
            finding.level = rule.fails && !advisory_ ? Level::fail : Level::warn;
            add(std::move(finding));
        } else if (change.high < -rule.relative) {
            finding.level = Level::improvement;
            add(std::move(finding));
        } else if (change.high > rule.relative) {
            finding.level = Level::note;
            finding.what += fmt::format("; whether it is beyond {:.3g} % cannot be told; more --repetitions can",
                                        100.0 * rule.relative);
            add(std::move(finding));
        }
    }

    const Rules& rules_;
    CounterRules counters_;
    std::vector<std::string> selection_;
    RowTable baseline_;
    RowTable current_;
    std::vector<std::string> theirs_;  // the current run's rows, of targets that the baseline has too
    Verdict verdict_;
    bool advisory_ = false;
    std::unordered_set<std::string> moot_;  // subjects with a wrong answer
    std::unordered_set<std::size_t> rules_that_spoke_;
};

}  // namespace

std::vector<std::string> selection_of(const Json& context) {
    const auto found = context.find("baseline_rows");
    if (found == context.end()) {
        return {"*"};
    }
    std::vector<std::string> globs;
    for (const Json& glob : *found) {
        if (glob.is_string()) {
            globs.push_back(glob.get<std::string>());
        }
    }
    return globs;
}

Verdict judge(const Results& baseline, const Results& current, const Rules& rules) {
    return Judge(baseline, current, rules).verdict();
}

}  // namespace bench::gate
