#include "bench/studies/equal_cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "bench/studies/tuned_oustaloup.hpp"
#include "bench/sweep/accuracy.hpp"
#include "bench/sweep/derivative_limits.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/host_line.hpp"
#include "bench/sweep/signals.hpp"
#include "bench/sweep/sweep.hpp"
#include "bench/sweep/with_kernel.hpp"
#include "glsum/registry.hpp"

namespace bench {
namespace {

using FullMemory = glsum::Sum<glsum::Mirror, glsum::Multi, glsum::F64>;

// The largest L whose length costs no more.
template <class K>
std::size_t taps_within(std::size_t cost) {
    std::size_t taps = 1;
    while (K::multiplications(taps + 1) <= cost) {
        ++taps;
    }
    return taps;
}

// What a kernel buys of a cost: a window, or near taps and blocks or modes. Empty for an order that it does not take.
std::optional<Length> length_within(const std::string& kernel, double order, std::size_t cost, std::size_t samples) {
    if (!serves(kernel, order)) {
        return std::nullopt;
    }
    std::size_t taps = 0;
    with_kernel(kernel, [&]<class K>() { taps = taps_within<K>(cost); });
    const Length length = length_of(kernel, order, taps, samples);
    return length.modes && *length.modes == 0 ? std::nullopt : std::optional(length);
}

// A signal, what the full memory makes of it, and its exact derivative, the whole and its second half. Nothing is
// wanted of these two where the signal has no formula.
struct Targets {
    FilterTarget sum;
    FilterTarget derivative;
    FilterTarget late;
};

Targets targets_of(const std::string& signal, double order, std::size_t samples) {
    FilterTarget sum{make_signal(signal, samples, Sweep().seed), {}, 0.0};
    // In double, 1e-13 from the exact sum: nothing beside what is compared.
    HostLine<FullMemory> line(glsum::Design{order, samples});
    for (std::size_t k = 0; k < samples; ++k) {
        sum.wanted.emplace_back(k, line.step(sum.record[k]));
        sum.peak = std::max(sum.peak, std::fabs(sum.wanted.back().second));
    }
    Targets made{sum, {sum.record, {}, sum.peak}, {sum.record, {}, sum.peak}};
    for (const DerivativeLimit& limit : derivative_limits(signal, samples, order)) {
        made.derivative.wanted.emplace_back(limit.sample, limit.value);
        if (limit.late) {
            made.late.wanted.emplace_back(limit.sample, limit.value);
        }
    }
    return made;
}

void add_tuning(Row& row, const TunedOustaloup& tuned) {
    row.set_text("mapping", to_text(tuned.mapping));
    row.set(Counter::low_rad_s, tuned.band.low_rad_s);
    row.set(Counter::high_rad_s, tuned.band.high_rad_s);
}

void add_late_tuning(Row& row, const TunedOustaloup& tuned) {
    row.set_text("late_mapping", to_text(tuned.mapping));
    row.set(Counter::late_low_rad_s, tuned.band.low_rad_s);
    row.set(Counter::late_high_rad_s, tuned.band.high_rad_s);
}

// Of one order and cost: the filter that is tuned once for all signals, then those tuned to one derivative.
std::vector<Json> filter_rows(const EqualCost& wanted, const std::vector<Targets>& targets, double order,
                              std::size_t cost) {
    const std::size_t poles = (cost - 1) / 2;
    const auto row_of = [&](std::string_view way, std::size_t signal) {
        RowKey key;
        key.kind = RowKind::filter;
        key.kernel = way;
        key.order = fmt::format("{}", order);
        key.poles = std::to_string(poles);
        key.aspect = RowKey::accuracy;
        key.signal = wanted.signals[signal];
        Row row(key, wanted.samples);
        row.set(Counter::macs_per_sample, Oustaloup::multiplications(poles));
        row.set(Counter::cost, cost);
        row.set_text("way", way);
        return row;
    };
    std::vector<FilterTarget> sums;
    for (const Targets& target : targets) {
        sums.push_back(target.sum);
    }
    const TunedOustaloup once = tune_oustaloup(order, step_s, poles, sums);
    const Oustaloup filter(order, step_s, poles, once.band, once.mapping);
    std::vector<Json> rows;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const bool has_formula = !targets[i].derivative.wanted.empty();
        Row row = row_of(oustaloup_of_sums, i);
        row.set(Counter::error_max, error_of(filter, targets[i].sum));
        if (has_formula) {
            row.set(Counter::derivative_error_max, error_of(filter, targets[i].derivative));
            row.set(Counter::derivative_error_late_max, error_of(filter, targets[i].late));
        }
        add_tuning(row, once);
        rows.push_back(std::move(row).take());
        if (has_formula) {
            const TunedOustaloup whole = tune_oustaloup(order, step_s, poles, {&targets[i].derivative, 1});
            const TunedOustaloup late = tune_oustaloup(order, step_s, poles, {&targets[i].late, 1});
            Row own = row_of(oustaloup_of_derivative, i);
            own.set(Counter::derivative_error_max, whole.error);
            add_tuning(own, whole);
            own.set(Counter::derivative_error_late_max, late.error);
            add_late_tuning(own, late);
            rows.push_back(std::move(own).take());
        }
    }
    return rows;
}

}  // namespace

std::vector<Json> measure_filters(const EqualCost& wanted) {
    std::vector<double> orders = wanted.orders;
    std::erase_if(orders, [](double v) { return !Oustaloup::takes(v); });
    base::Progress progress("filters", orders.size());
    std::vector<std::vector<Json>> of_orders(orders.size());
    base::parallel_for(orders.size(), wanted.jobs, [&](std::size_t i) {
        std::vector<Targets> targets;
        for (const std::string& signal : wanted.signals) {
            targets.push_back(targets_of(signal, orders[i], wanted.samples));
        }
        for (const std::size_t cost : wanted.costs) {
            std::ranges::move(filter_rows(wanted, targets, orders[i], cost), std::back_inserter(of_orders[i]));
        }
        progress.advance();
    });
    std::vector<Json> rows;
    for (std::vector<Json>& of_order : of_orders) {
        std::ranges::move(of_order, std::back_inserter(rows));
    }
    return rows;
}

std::vector<Json> measure_equal_cost(const EqualCost& wanted) {
    Sweep sweep;
    sweep.orders = wanted.orders;
    sweep.signals = wanted.signals;
    sweep.samples = wanted.samples;
    sweep.jobs = wanted.jobs;
    // Costs and ways that a measured row is there for, by its subject.
    std::map<std::string, std::vector<std::pair<std::size_t, std::string_view>>> asked;
    std::set<std::size_t> windows;
    std::set<std::pair<std::size_t, std::size_t>> with_modes;
    for (const EqualCostWay& way : equal_cost_ways()) {
        if (way.is_filter) {
            continue;
        }
        const std::string kernel(way.name);
        sweep.kernels.push_back(kernel);
        for (const double order : wanted.orders) {
            const auto ask = [&](std::size_t cost, const Length& length) {
                asked[subject_of(row_key(kernel, order, length, ""))].emplace_back(cost, way.name);
            };
            if (kernel == FullMemory::name()) {
                ask(wanted.samples - 1, {wanted.samples, true});
                continue;
            }
            for (const std::size_t cost : wanted.costs) {
                if (const auto length = length_within(kernel, order, cost, wanted.samples)) {
                    ask(cost, *length);
                    if (length->modes) {
                        with_modes.emplace(length->taps, *length->modes);
                    } else {
                        windows.insert(length->taps);
                    }
                }
            }
        }
    }
    for (const std::size_t taps : windows) {
        sweep.lengths.push_back({taps});
    }
    for (const auto& [taps, modes] : with_modes) {
        sweep.lengths.push_back({taps, false, modes});
    }
    sweep.lengths.push_back({wanted.samples, true});
    std::vector<std::size_t> cases(wanted.orders.size() * wanted.signals.size());
    std::iota(cases.begin(), cases.end(), std::size_t{0});
    std::vector<Json> rows;
    for (const std::vector<Json>& of_case : measure_accuracy(sweep, cases)) {
        for (const Json& row : of_case) {
            const auto found = asked.find(subject_of(parse_key(row.at("name").get<std::string>()).value()));
            if (found == asked.end()) {
                continue;  // of a length that is another kernel's
            }
            for (const auto& [cost, way] : found->second) {
                Row at_cost(row);
                at_cost.set(Counter::cost, cost);
                at_cost.set_text("way", way);
                rows.push_back(std::move(at_cost).take());
            }
        }
    }
    std::ranges::move(measure_filters(wanted), std::back_inserter(rows));
    return rows;
}

}  // namespace bench
