#include "bench/choose/brute_force.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "bench/choose/plain_loop.hpp"

namespace choose {
namespace {

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
    [[nodiscard]] bool costly(const std::string& kernel) const override { return source_.costly(kernel); }
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
    base::Progress progress("every length", records.size());
    for (const Record& record : records) {
        MeasuredErrors errors(question.conditions.order, {record});
        std::vector<double> of_signal(entries.size());
        base::parallel_for(entries.size(), question.jobs, [&](std::size_t i) {
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

}  // namespace

Agreement check_against_brute_force(const Question& question, CostSource& costs, std::size_t budgets,
                                    std::uint64_t seed) {
    const std::vector<Record> records = make_records(question.conditions, question.jobs);
    const std::vector<Entry> entries = measure_all(question, costs, records);
    Table table(costs, entries);
    Budgets random(seed);
    Agreement agreement;
    agreement.candidates = entries.size();
    for (; agreement.budgets < budgets; ++agreement.budgets) {
        const Budget budget = random.next(entries, records.size());
        std::vector<Record> chosen_records;
        for (const std::size_t signal : budget.signals) {
            chosen_records.push_back(records[signal]);
        }
        MeasuredErrors errors(question.conditions.order, std::move(chosen_records));
        const Choice found = choose(errors, table, question.kernels, budget.limits, question.jobs, false);
        double nearest = 0.0;
        const Entry* expected = best_of(entries, budget, nearest);
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
