#include "bench/gate/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "base/glob.hpp"
#include "bench/gate/host_time.hpp"
#include "bench/gate/row_table.hpp"
#include "bench/rows/counters.hpp"
#include "bench/rows/median.hpp"

namespace bench::gate {
namespace {

std::vector<std::string> rows_of_both(const RowTable& a, const RowTable& b) {
    std::vector<std::string> rows;
    std::copy_if(a.names().begin(), a.names().end(), std::back_inserter(rows),
                 [&](const std::string& name) { return b.find(name) != nullptr; });
    return rows;
}

void set_ratio(Pair& pair, std::optional<Better> better) {
    if (pair.a > 0.0 && pair.b > 0.0) {
        pair.log_ratio = pair.low = pair.high = std::log(pair.b / pair.a);
    }
    if (better && pair.a != pair.b) {
        const bool lower = pair.b < pair.a;
        pair.better = *better == Better::equal ? -1 : lower == (*better == Better::lower) ? 1 : -1;
    }
}

// What the clock decides: of two runs only repetitions tell.
bool is_of_the_clock(const std::string& counter) {
    const CounterFacts* facts = find_counter(counter);
    return facts != nullptr && facts->layer == CounterLayer::host_time;
}

// Repeated host times, by the gate's statistics; the first rule of host times names the anchor.
void add_times(const RowTable& a, const RowTable& b, const std::string& name, const Rules& rules,
               std::vector<Pair>& pairs) {
    Pair pair;
    pair.row = name;
    pair.counter = name_of(Counter::cpu_time);
    const std::vector<double> times_a = a.find(name)->times();
    const std::vector<double> times_b = b.find(name)->times();
    if (times_a.empty() || times_b.empty()) {
        return;
    }
    pair.a = median_of(times_a);
    pair.b = median_of(times_b);
    const auto rule = std::find_if(rules.begin(), rules.end(), [&](const Rule& candidate) {
        return candidate.layer == Layer::host_time && candidate.wants_row(name);
    });
    const std::string kernel = kernel_of(name);
    if (rule != rules.end() && !kernel.empty() && kernel != rule->anchor) {
        const std::string anchor = row_of(rule->anchor, name);
        const Measured* anchor_a = a.find(anchor);
        const Measured* anchor_b = b.find(anchor);
        const auto enough = [](const std::vector<double>& times) {
            return times.size() >= least_repetitions && *std::min_element(times.begin(), times.end()) > 0.0;
        };
        if (anchor_a != nullptr && anchor_b != nullptr && enough(times_a) && enough(times_b) &&
            enough(anchor_a->times()) && enough(anchor_b->times())) {
            const TimeChange change =
                time_change({times_a, anchor_a->times()}, {times_b, anchor_b->times()}, rule->confidence);
            pair.to_anchor = true;
            pair.log_ratio = std::log1p(change.estimate);
            pair.low = std::log1p(change.low);
            pair.high = std::log1p(change.high);
            pair.better = pair.high < 0.0 ? 1 : pair.low > 0.0 ? -1 : 0;
            pairs.push_back(std::move(pair));
            return;
        }
    }
    set_ratio(pair, std::nullopt);  // single times of two runs: a ratio, but nobody's judgement
    pairs.push_back(std::move(pair));
}

std::string ratio_text(double log_ratio) { return fmt::format("x{:.4g}", std::exp(log_ratio)); }

std::string_view word(int better) { return better > 0 ? "better" : better < 0 ? "worse" : ""; }

}  // namespace

Comparison compare(const Results& results_a, const Results& results_b, const Rules& rules,
                   const std::vector<std::string>& rows, const std::vector<std::string>& counters) {
    const RowTable a(results_a);
    const RowTable b(results_b);
    Comparison comparison;
    const std::vector<std::string> both = rows_of_both(a, b);
    comparison.differences = differences({results_a.context, both}, {results_b.context, both});
    std::map<std::pair<Kind, std::string>, std::optional<Better>> directions;  // alike for all rows of a kind
    for (const std::string& name : a.names()) {
        if (!base::matches_any(rows, name)) {
            continue;
        }
        const Measured* in_a = a.find(name);
        const Measured* in_b = b.find(name);
        if (in_b == nullptr) {
            comparison.only_a.push_back(name);
            continue;
        }
        if (in_a->wrong() || in_b->wrong()) {
            comparison.wrong.push_back(name);
            continue;
        }
        const Kind kind = kind_of(name);
        for (const auto& [counter, value] : in_a->first().items()) {
            const auto other = in_b->first().find(counter);
            if (!is_counter(counter, value) || other == in_b->first().end() || !other->is_number() ||
                !base::matches_any(counters, counter) || (kind == Kind::host && is_of_the_clock(counter))) {
                continue;
            }
            const auto [direction, is_new] = directions.try_emplace({kind, counter});
            if (is_new) {
                direction->second = better_of(rules, name, counter);
            }
            Pair pair;
            pair.row = name;
            pair.counter = counter;
            pair.a = value.get<double>();
            pair.b = other->get<double>();
            set_ratio(pair, direction->second);
            comparison.pairs.push_back(std::move(pair));
        }
        if (kind == Kind::host && base::matches_any(counters, std::string(name_of(Counter::cpu_time)))) {
            add_times(a, b, name, rules, comparison.pairs);
        }
    }
    for (const std::string& name : b.names()) {
        if (base::matches_any(rows, name) && a.find(name) == nullptr) {
            comparison.only_b.push_back(name);
        }
    }
    return comparison;
}

std::string to_table(const Comparison& comparison, std::size_t shown) {
    std::string text;
    for (const Difference& difference : comparison.differences) {
        text += fmt::format("  {}: {} in A, {} in B{}\n", difference.field, difference.baseline, difference.current,
                            difference.effect == Effect::incomparable ? ": not comparable" : "");
    }
    struct Sum {
        std::size_t all = 0;
        std::size_t better = 0;
        std::size_t worse = 0;
        double sum = 0.0;
        double squares = 0.0;
    };
    std::map<std::string, Sum> sums;
    std::vector<const Pair*> changed;
    for (const Pair& pair : comparison.pairs) {
        Sum& sum = sums[pair.counter];
        ++sum.all;
        sum.better += pair.better > 0 ? 1 : 0;
        sum.worse += pair.better < 0 ? 1 : 0;
        sum.sum += pair.log_ratio;
        sum.squares += pair.log_ratio * pair.log_ratio;
        if (pair.a != pair.b) {
            changed.push_back(&pair);
        }
    }
    text += fmt::format("\n  {:<26} {:>7} {:>7} {:>7}  {:>14} {:>12}\n", "counter", "rows", "better", "worse",
                        "geometric mean", "geometric sd");
    for (const auto& [counter, sum] : sums) {
        const auto n = static_cast<double>(sum.all);
        const double mean = sum.sum / n;
        const double deviation = std::sqrt(std::max(0.0, sum.squares / n - mean * mean));
        text += fmt::format("  {:<26} {:>7} {:>7} {:>7}  {:>14} {:>12}\n", counter, sum.all, sum.better, sum.worse,
                            ratio_text(mean), ratio_text(deviation));
    }
    std::stable_sort(changed.begin(), changed.end(), [](const Pair* one, const Pair* other) {
        return std::fabs(one->log_ratio) > std::fabs(other->log_ratio);
    });
    if (!changed.empty()) {
        text +=
            fmt::format("\n  largest changes, B over A ({} of {})\n", std::min(shown, changed.size()), changed.size());
    }
    for (std::size_t i = 0; i < std::min(shown, changed.size()); ++i) {
        const Pair& pair = *changed[i];
        const std::string interval =
            pair.to_anchor ? fmt::format(" ({} to {} of the anchor)", ratio_text(pair.low), ratio_text(pair.high)) : "";
        text += fmt::format("  {} {}: {:.6g} -> {:.6g}, {}{} {}\n", pair.row, pair.counter, pair.a, pair.b,
                            ratio_text(pair.log_ratio), interval, word(pair.better));
    }
    for (const auto& [rows, what] :
         {std::pair(&comparison.only_a, "only in A"), std::pair(&comparison.only_b, "only in B"),
          std::pair(&comparison.wrong, "wrong in A or B, not compared")}) {
        if (!rows->empty()) {
            text += fmt::format("\n  {} rows {}: {}{}\n", rows->size(), what, rows->front(),
                                rows->size() > 1 ? ", ..." : "");
        }
    }
    return text;
}

std::string to_json(const Comparison& comparison) {
    Json json;
    json["schema"] = "glsum-compare-1";
    json["conditions"] = Json::array();
    for (const Difference& difference : comparison.differences) {
        json["conditions"].push_back({{"field", difference.field},
                                      {"a", difference.baseline},
                                      {"b", difference.current},
                                      {"comparable", difference.effect != Effect::incomparable}});
    }
    json["pairs"] = Json::array();
    for (const Pair& pair : comparison.pairs) {
        Json one{{"row", pair.row}, {"counter", pair.counter}, {"a", pair.a}, {"b", pair.b}};
        if (pair.a > 0.0 && pair.b > 0.0) {
            one["ratio"] = std::exp(pair.log_ratio);
        }
        if (pair.to_anchor) {
            one["ratio_low"] = std::exp(pair.low);
            one["ratio_high"] = std::exp(pair.high);
        }
        if (pair.better != 0) {
            one["change"] = word(pair.better);
        }
        json["pairs"].push_back(std::move(one));
    }
    json["only_a"] = comparison.only_a;
    json["only_b"] = comparison.only_b;
    json["wrong"] = comparison.wrong;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace bench::gate
