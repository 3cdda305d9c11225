#include "bench/choose/plain_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace choose {

double error_of(const Entry& entry, const Budget& budget) {
    double worst = 0.0;
    for (const std::size_t signal : budget.signals) {
        worst = std::max(worst, entry.errors[signal]);
    }
    return worst;
}

const Entry* best_of(const std::vector<Entry>& entries, const Budget& budget, double& nearest) {
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
        const auto rank = [&](const Entry& one) {
            return std::tuple(one.cost.value, one.cost.bytes, error_of(one, budget));
        };
        if (best == nullptr || rank(entry) < rank(*best)) {
            best = &entry;
        }
    }
    return best;
}

// Not the library's distributions: their results are its choice.
double Budgets::unit() { return static_cast<double>(generator_() >> 11) * 0x1p-53; }

std::size_t Budgets::below(std::size_t count) { return static_cast<std::size_t>(unit() * static_cast<double>(count)); }

double Budgets::between(double low, double high) { return low * std::pow(high / low, unit()); }

Budget Budgets::next(const std::vector<Entry>& entries, std::size_t signals) {
    Budget budget;
    if (below(3) == 0) {
        budget.signals = {below(signals)};
    } else {
        for (std::size_t i = 0; i < signals; ++i) {
            budget.signals.push_back(i);
        }
    }
    const Entry& near = entries[below(entries.size())];
    const double error = error_of(near, budget);
    budget.limits.max_error = std::isfinite(error) && error > 0.0 ? error * between(0.7, 3.0) : between(1e-6, 1.0);
    if (below(2) == 0) {
        budget.limits.max_cost = near.cost.limited * between(0.6, 2.0);
    }
    if (below(2) == 0) {
        budget.limits.max_bytes = near.cost.bytes * between(0.6, 2.0);
    }
    return budget;
}

}  // namespace choose
