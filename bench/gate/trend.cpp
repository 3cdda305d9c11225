#include "bench/gate/trend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "bench/gate/row_table.hpp"

namespace bench::gate {
namespace {

using Key = std::pair<std::string, std::string>;  // kernel, counter

// A change of one pair of runs, and the step of its series.
struct Step {
    Change change;
    double sum = 0.0;  // of the logarithms of the ratios, over all rows
};

bool has_changed(const Pair& pair) { return pair.to_anchor ? pair.low > 0.0 || pair.high < 0.0 : pair.a != pair.b; }

std::map<Key, Step> steps_of(const Comparison& comparison, std::size_t run) {
    std::map<Key, Step> steps;
    for (const Pair& pair : comparison.pairs) {
        const std::string kernel = kernel_of(pair.row);
        Key key{kernel.empty() ? pair.row : kernel, pair.counter};
        Step& step = steps[key];
        Change& change = step.change;
        if (change.of == 0) {
            change.run = run;
            change.kernel = key.first;
            change.counter = key.second;
        }
        ++change.of;
        if (!has_changed(pair)) {
            continue;
        }
        ++change.rows;
        change.better += pair.better > 0 ? 1 : 0;
        change.worse += pair.better < 0 ? 1 : 0;
        if (!pair.to_anchor && (pair.a <= 0.0 || pair.b <= 0.0)) {
            ++change.without_ratio;
            continue;
        }
        const bool first = change.rows == change.without_ratio + 1;
        step.sum += pair.log_ratio;
        change.lowest = first ? pair.log_ratio : std::min(change.lowest, pair.log_ratio);
        change.highest = first ? pair.log_ratio : std::max(change.highest, pair.log_ratio);
    }
    for (auto& [key, step] : steps) {
        const std::size_t with_ratio = step.change.rows - step.change.without_ratio;
        step.change.log_ratio = with_ratio > 0 ? step.sum / static_cast<double>(with_ratio) : 0.0;
    }
    return steps;
}

double furthest(const Series& series) {
    double most = 0.0;
    for (const double level : series.level) {
        most = std::max(most, std::fabs(std::log(level)));
    }
    return most;
}

std::string text_of(const Json& context, const char* field) {
    const auto found = context.find(field);
    return found != context.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

Trend trend(const std::vector<NamedResults>& runs, const Rules& rules, const std::vector<std::string>& rows,
            const std::vector<std::string>& counters) {
    Trend all;
    std::map<Key, Series> series;
    for (std::size_t run = 0; run < runs.size(); ++run) {
        const Results& now = runs[run].results;
        TrendRun& told = all.runs.emplace_back();
        told.name = runs[run].name;
        told.commit = text_of(now.context, "commit").substr(0, 9);
        told.date = text_of(now.context, "date").substr(0, 10);
        told.rows = now.rows.size();
        if (run == 0) {
            continue;
        }
        const Comparison comparison = compare(runs[run - 1].results, now, rules, rows, counters);
        if (const std::string why_not = incomparable(comparison.differences, runs[run - 1].name, told.name);
            !why_not.empty()) {
            all.incomparable.push_back(why_not);
        }
        std::vector<Change> changes;
        for (const auto& [key, step] : steps_of(comparison, run)) {
            auto [found, is_new] = series.try_emplace(key);
            if (is_new) {
                found->second = {key.first, key.second, std::vector<double>(runs.size(), 1.0),
                                 std::vector<bool>(runs.size())};
            }
            const double ratio = std::exp(step.sum / static_cast<double>(step.change.of));
            for (double& level : std::span(found->second.level).subspan(run)) {  // from now on
                level *= ratio;
            }
            if (step.change.rows > 0) {
                found->second.changed[run] = true;
                told.changed += step.change.rows;
                told.better += step.change.better;
                told.worse += step.change.worse;
                changes.push_back(step.change);
            }
        }
        std::stable_sort(changes.begin(), changes.end(), [](const Change& one, const Change& other) {
            return std::fabs(one.log_ratio) > std::fabs(other.log_ratio);
        });
        all.changes.insert(all.changes.end(), changes.begin(), changes.end());
    }
    for (auto& [key, one] : series) {
        if (std::find(one.changed.begin(), one.changed.end(), true) != one.changed.end()) {
            all.series.push_back(std::move(one));
        }
    }
    std::stable_sort(all.series.begin(), all.series.end(),
                     [](const Series& one, const Series& other) { return furthest(one) > furthest(other); });
    return all;
}

}  // namespace bench::gate
