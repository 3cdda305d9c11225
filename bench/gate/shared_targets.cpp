#include "bench/gate/shared_targets.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bench/rows/key.hpp"

namespace bench::gate {
namespace {

using Rows = std::map<std::string, std::size_t>;

Rows rows_by_target(const std::vector<std::string>& names) {
    Rows rows;
    for (const std::string& name : names) {
        ++rows[target_of(name)];
    }
    return rows;
}

// What `bench --targets` was; empty where the file does not say.
std::vector<std::string> asked_for(const Json& context) {
    std::vector<std::string> targets;
    const Json::json_pointer at("/sweep/targets");
    if (context.contains(at) && context[at].is_array()) {
        for (const Json& target : context[at]) {
            if (target.is_string()) {
                targets.push_back(target.get<std::string>());
            }
        }
    }
    return targets;
}

std::string listed(const Rows& rows) {
    std::vector<std::string> targets;
    for (const auto& [target, number] : rows) {
        if (!target.empty()) {
            targets.push_back(target);
        }
    }
    return fmt::format("{}", fmt::join(targets, ", "));
}

std::string rows_outside(const Rows& rows, const Rows& others, std::string_view why) {
    std::string text;
    for (const auto& [target, number] : rows) {
        if (!target.empty() && number > 0 && !others.contains(target)) {
            text += fmt::format("{}{} rows of {}, {}", text.empty() ? "" : "; ", number, target, why);
        }
    }
    return text;
}

}  // namespace

std::string target_of(const std::string& name) {
    const auto key = parse_any_key(name);
    if (!key || key->is_accuracy()) {
        return "";
    }
    return key->is_target() ? std::string(key->machine()->word) : key->is_host() ? std::string(RowKey::host) : "";
}

SharedTargets::SharedTargets(const std::vector<std::string>& baseline, const std::vector<std::string>& current,
                             const Json& context)
    : baseline_(rows_by_target(baseline)), current_(rows_by_target(current)) {
    const std::vector<std::string> asked = asked_for(context);
    for (const std::string& target : asked) {
        current_.try_emplace(target, 0);
    }
    for (const auto& [target, rows] : baseline_) {
        if (asked.empty()) {
            current_.try_emplace(target, 0);
        }
    }
}

bool SharedTargets::has(const std::string& name) const {
    const std::string target = target_of(name);
    return target.empty() || (baseline_.contains(target) && current_.contains(target));
}

bool SharedTargets::none() const {
    return !baseline_.empty() && std::none_of(baseline_.begin(), baseline_.end(), [&](const auto& one) {
        return one.first.empty() || current_.contains(one.first);
    });
}

std::string SharedTargets::not_judged() const {
    Rows emulated = current_;
    emulated.erase(std::string(RowKey::host));  // every usual run has times, and few baselines want them
    const std::string of_run = rows_outside(emulated, baseline_, "of which the baseline has none");
    const std::string of_baseline = rows_outside(baseline_, current_, "which this run was not asked for");
    return of_run + (of_run.empty() || of_baseline.empty() ? "" : "; ") + of_baseline;
}

std::string SharedTargets::of_baseline() const { return listed(baseline_); }
std::string SharedTargets::of_current() const { return listed(current_); }

}  // namespace bench::gate
