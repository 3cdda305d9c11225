#include "bench/choose/brute_force.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "bench/parallel.hpp"
#include "bench/progress.hpp"

namespace choose {
namespace {

// Everything about one kernel at one length.
struct Entry {
    std::string kernel;
    std::size_t taps;
    std::vector<double> errors;  // of each signal; infinite where there is no answer
    Cost cost;
};

// Costs that are known already.
class Table : public CostSource {
public:
    Table(CostSource& source, const std::vector<Entry>& entries) : source_(source) {
        for (const Entry& entry : entries) {
            known_[{entry.kernel, entry.taps}] = entry.cost;
        }
    }
    [[nodiscard]] std::string unit() const override { return source_.unit(); }
    [[nodiscard]] std::string limited_unit() const override { return source_.limited_unit(); }
    [[nodiscard]] bool exact() const override { return true; }
    [[nodiscard]] bool dear(const std::string& kernel) const override { return source_.dear(kernel); }
    [[nodiscard]] std::vector<Cost> costs(const std::vector<Case>& cases) override {
        std::vector<Cost> costs;
        for (const Case& wanted : cases) {
            costs.push_back(known_.at(wanted));
        }
        return costs;
    }

private:
    CostSource& source_;
    std::map<Case, Cost> known_;
};

std::vector<Entry> measure_all(const Question& question, CostSource& costs, const std::vector<Record>& records) {
    std::vector<Entry> entries;
    std::vector<Case> cases;
    const MeasuredErrors lengths(question.conditions.order, records);
    for (const std::string& kernel : question.kernels) {
        const std::size_t longest = lengths.longest_of(kernel);
        for (std::size_t taps = 1; taps <= longest; ++taps) {
            entries.push_back({kernel, taps, {}, {}});
            cases.emplace_back(kernel, taps);
        }
    }
    const std::vector<Cost> found = costs.costs(cases);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        entries[i].cost = found[i];
    }
    bench::Progress progress("every length", records.size());
    for (const Record& record : records) {
        MeasuredErrors errors(question.conditions.order, {record});
        std::vector<double> of_signal(entries.size());
        bench::parallel_for(entries.size(), question.jobs, [&](std::size_t i) {
            const ErrorAt at = errors.error(entries[i].kernel, entries[i].taps);
            of_signal[i] = at.fault.empty() ? at.error : std::numeric_limits<double>::infinity();
        });
        for (std::size_t i = 0; i < entries.size(); ++i) {
            entries[i].errors.push_back(of_signal[i]);
        }
        progress.advance();
    }
    return entries;
}

struct Budget {
    std::vector<std::size_t> signals;
    Limits limits;
};

double error_of(const Entry& entry, const Budget& budget) {
    double worst = 0.0;
    for (const std::size_t signal : budget.signals) {
        worst = std::max(worst, entry.errors[signal]);
    }
    return worst;
}

// The plain loop. \return the best entry that fits, or null, and then the least factor by which one limit must be
// relaxed.
const Entry* loop(const std::vector<Entry>& entries, const Budget& budget, double& nearest) {
    const Entry* best = nullptr;
    nearest = std::numeric_limits<double>::infinity();
    for (const Entry& entry : entries) {
        const double error = error_of(entry, budget);
        if (!entry.cost.fault.empty() || !std::isfinite(error)) {
            continue;
        }
        const double beyond[] = {error / budget.limits.max_error,
                                 budget.limits.max_cost ? entry.cost.limited / *budget.limits.max_cost : 0.0,
                                 budget.limits.max_bytes ? entry.cost.bytes / *budget.limits.max_bytes : 0.0};
        const auto broken =
            std::count_if(std::begin(beyond), std::end(beyond), [](double factor) { return factor > 1.0; });
        if (broken == 1) {
            nearest = std::min(nearest, *std::max_element(std::begin(beyond), std::end(beyond)));
        }
        if (broken > 0) {
            continue;
        }
        if (best == nullptr || entry.cost.value < best->cost.value ||
            (entry.cost.value == best->cost.value &&
             (entry.cost.bytes < best->cost.bytes ||
              (entry.cost.bytes == best->cost.bytes && error < error_of(*best, budget))))) {
            best = &entry;
        }
    }
    return best;
}

class Draw {
public:
    explicit Draw(std::uint64_t seed) : generator_(seed) {}
    double unit() { return static_cast<double>(generator_() >> 11) * 0x1p-53; }
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(unit() * static_cast<double>(count)); }
    double between(double low, double high) { return low * std::pow(high / low, unit()); }

private:
    std::mt19937_64 generator_;
};

// Limits near those of a random entry: some can be met, some cannot.
Budget draw(Draw& random, const std::vector<Entry>& entries, std::size_t signals) {
    Budget budget;
    if (random.below(3) == 0) {
        budget.signals = {random.below(signals)};
    } else {
        for (std::size_t i = 0; i < signals; ++i) {
            budget.signals.push_back(i);
        }
    }
    const Entry& near = entries[random.below(entries.size())];
    const double error = error_of(near, budget);
    budget.limits.max_error =
        std::isfinite(error) && error > 0.0 ? error * random.between(0.7, 3.0) : random.between(1e-6, 1.0);
    if (random.below(2) == 0) {
        budget.limits.max_cost = near.cost.limited * random.between(0.6, 2.0);
    }
    if (random.below(2) == 0) {
        budget.limits.max_bytes = near.cost.bytes * random.between(0.6, 2.0);
    }
    return budget;
}

}  // namespace

Agreement check_against_brute_force(const Question& question, CostSource& costs, std::size_t budgets,
                                    std::uint64_t seed) {
    const std::vector<Record> records = make_records(question.conditions, question.jobs);
    const std::vector<Entry> entries = measure_all(question, costs, records);
    Table table(costs, entries);
    Draw random(seed);
    Agreement agreement;
    agreement.candidates = entries.size();
    for (; agreement.budgets < budgets; ++agreement.budgets) {
        const Budget budget = draw(random, entries, records.size());
        std::vector<Record> chosen_records;
        for (const std::size_t signal : budget.signals) {
            chosen_records.push_back(records[signal]);
        }
        MeasuredErrors errors(question.conditions.order, std::move(chosen_records));
        const Choice found = choose(errors, table, question.kernels, budget.limits, question.jobs, false);
        double nearest = 0.0;
        const Entry* expected = loop(entries, budget, nearest);
        const bool same = expected == nullptr ? !found.chosen
                                              : found.chosen && found.chosen->cost.value == expected->cost.value &&
                                                    found.chosen->cost.bytes == expected->cost.bytes &&
                                                    found.chosen->error.error == error_of(*expected, budget);
        agreement.same += same ? 1 : 0;
        if (expected == nullptr && same) {
            ++agreement.nothing;
            const double relaxed =
                found.relaxed.empty() ? std::numeric_limits<double>::infinity() : found.relaxed.front().factor();
            agreement.same_miss += relaxed <= nearest * (1.0 + 1e-12) ? 1 : 0;
        }
        if (!same) {
            const auto text = [](const std::string& kernel, std::size_t taps) {
                return fmt::format("{} with {} taps", kernel, taps);
            };
            agreement.differences +=
                fmt::format("budget {}: error {}, cost {}, bytes {}, {} signals: the search has {}, the loop {}\n",
                            agreement.budgets, budget.limits.max_error, budget.limits.max_cost.value_or(0.0),
                            budget.limits.max_bytes.value_or(0.0), budget.signals.size(),
                            found.chosen ? text(found.chosen->kernel, found.chosen->taps) : "nothing",
                            expected != nullptr ? text(expected->kernel, expected->taps) : "nothing");
        }
    }
    return agreement;
}

Agreement check_against_brute_force(const Question& question, const qemu::Board& board, std::size_t budgets,
                                    std::uint64_t seed) {
    OnTarget costs(board, question.conditions.order, question.conditions.samples, question.conditions.seed,
                   question.jobs, question.core);
    return check_against_brute_force(question, costs, budgets, seed);
}

}  // namespace choose
