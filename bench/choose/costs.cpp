#include "bench/choose/costs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/progress.hpp"
#include "bench/choose/earlier.hpp"
#include "bench/host/host_timing.hpp"
#include "bench/rows/key.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/signals.hpp"
#include "bench/target/count_path.hpp"
#include "bench/target/target_rows.hpp"

namespace choose {
namespace {

double number(const bench::Json& row, bench::Counter counter) { return bench::value_of(row, counter).value_or(0.0); }

// Of values in any order, at least one.
double quantile(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    const double at = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

}  // namespace

// The signal that bench counts on.
OnTarget::OnTarget(qemu::Board board, const CountedOrder& order, std::size_t samples, std::uint64_t seed, unsigned jobs,
                   const std::string& core)
    : board_(std::move(board)), order_(order), signals_{bench::make_signal("noise", samples, seed + 1)}, jobs_(jobs) {
    if (!core.empty()) {
        timing_ = bench::timing_request(board_.cores, {core});
    }
}

void OnTarget::remember(const Case& of, const Cost& cost) { given_[of] = cost; }

bool OnTarget::costly(const std::string& kernel) const { return bench::double_in_software(kernel); }

std::vector<Cost> OnTarget::costs(const std::vector<Case>& cases) {
    std::vector<qemu::PlannedRow> plan;
    std::vector<Case> planned;
    for (const Case& wanted : cases) {
        if (const auto given = given_.find(wanted); given != given_.end() && !known_.contains(wanted)) {
            known_[wanted] = given->second;
            ++remembered_;
        }
        if (!known_.contains(wanted) && std::find(planned.begin(), planned.end(), wanted) == planned.end()) {
            const auto& [kernel, taps] = wanted;
            const std::size_t samples = signals_.front().size();
            const double order = order_.of(kernel);
            const glsum::Design design = bench::design_of(kernel, order, order_.length(kernel, taps, samples), samples);
            plan.push_back({kernel,
                            order,
                            taps,
                            0,
                            qemu::calls_to_measure(kernel, taps),
                            {design.modes.begin(), design.modes.end()},
                            design.blocks});
            planned.push_back(wanted);
        }
    }
    if (!plan.empty()) {
        base::Progress progress(board_.name(), plan.size());
        const auto counted = bench::count_on_target(
            plan, signals_, board_, jobs_, [&] { progress.advance(); }, timing_);
        for (std::size_t i = 0; i < plan.size(); ++i) {
            const qemu::MeasuredRow& row = counted[i].row;
            Cost cost{.bytes = static_cast<double>(row.state_bytes + row.coefficient_bytes), .fault = {}};
            cost.value = modelled() && !row.cores.empty() ? row.cores.front().cycles : row.instructions;
            cost.limited = modelled() && !row.cores.empty() ? row.cores.front().high : row.instructions;
            if (row.status != glsum::Status::ok) {
                cost.fault = bench::to_text(row.status);
            } else if (!counted[i].same_bits) {
                cost.fault = bench::other_bits;
            }
            known_[planned[i]] = cost;
        }
        measured_ += plan.size();
    }
    std::vector<Cost> costs;
    for (const Case& wanted : cases) {
        costs.push_back(known_.at(wanted));
    }
    return costs;
}

std::vector<Cost> HostTimes::costs(const std::vector<Case>& cases) {
    if (cases.empty()) {
        return {};
    }
    std::vector<bench::Timed> timed;
    for (const auto& [kernel, taps] : cases) {
        timed.push_back({kernel, order_.length(kernel, taps, samples_), order_.of(kernel)});
    }
    const bench::HostTiming timing = bench::time_on_host(timed, samples_, repetitions, {});
    cycle_counter_ = timing.context.value("cycle_counter", "unknown");
    std::vector<Cost> costs;
    for (const bench::Timed& one : timed) {
        costs.push_back(
            cost_of_times(timing.rows, to_name(bench::row_key(one.name, one.order, one.length, bench::RowKey::host))));
    }
    return costs;
}

Cost cost_of_times(const std::vector<bench::Json>& rows, const std::string& name) {
    Cost cost;
    std::vector<double> ns;
    std::vector<double> cycles;
    for (const bench::Json& row : rows) {
        if (row.value("run_name", "") != name || row.value("run_type", "iteration") != "iteration") {
            continue;
        }
        if (bench::is_wrong(row)) {
            cost.fault = row.value("error_message", "wrong");
            continue;
        }
        ns.push_back(number(row, bench::Counter::real_time));
        cycles.push_back(number(row, bench::Counter::cycles_per_sample));
        cost.bytes = number(row, bench::Counter::state_bytes) + number(row, bench::Counter::coefficient_bytes);
    }
    if (ns.empty()) {
        cost.fault = cost.fault.empty() ? "not timed" : cost.fault;
        return cost;
    }
    cost.value = quantile(ns, 0.5);
    cost.noise = (quantile(ns, 0.75) - quantile(ns, 0.25)) / 2.0;
    cost.limited = quantile(cycles, 0.5);
    return cost;
}

}  // namespace choose
