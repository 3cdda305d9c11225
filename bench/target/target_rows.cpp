#include "bench/target/target_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "bench/sweep/signals.hpp"
#include "bench/target/shares.hpp"
#include "bench/target/target_plan.hpp"

namespace bench {
namespace {

// An outcome of the target and whether the host's is the same.
template <class Outcome>
struct Compared {
    Outcome target;
    bool same;
};

// Runs the plan in shares of about equal cost: run(plan) gives the target's outcomes, expected(planned) the host's.
template <class Outcome, class Run, class Expected>
std::vector<Compared<Outcome>> run_in_shares(const std::vector<qemu::PlannedRow>& plan, unsigned jobs, Run run,
                                             Expected expected) {
    std::vector<double> costs;
    for (const qemu::PlannedRow& planned : plan) {
        costs.push_back(estimated_cost(planned));
    }
    const auto shares = balanced_shares(costs, jobs);
    std::vector<Compared<Outcome>> compared(plan.size());
    base::parallel_for(shares.size(), jobs, [&](std::size_t s) {
        const std::vector<Outcome> outcomes = run(pick(plan, shares[s]));
        for (std::size_t i = 0; i < outcomes.size(); ++i) {
            const std::size_t at = shares[s][i];
            const qemu::ReplayedRow host = expected(plan[at]);
            compared[at] = {outcomes[i], host.status == outcomes[i].status && host.hash == outcomes[i].hash};
        }
    });
    return compared;
}

// The row of one of the sweep's cores, which `aspect` names. \param clock_hz  of a modelled one
Json to_json(const TargetPlan::Row& row, double counted_at, const qemu::MeasuredRow& measured,
             const std::string& aspect, const qemu::ModelledCall* modelled, double clock_hz) {
    Row made(row_key(row.kernel, row.order, row.length, aspect), 32);
    made.set_text("label",
                  label_of(modelled != nullptr, fmt::format("; counted at order {}", counted_at), row.software_double));
    if (measured.status != glsum::Status::ok) {
        made.mark_error(to_text(measured.status));
        return std::move(made).take();
    }
    add_instructions(made, measured);
    made.set(Counter::counted_at_order, counted_at);
    if (modelled != nullptr) {
        add_modelled(made, *modelled, clock_hz);
    }
    add_bytes(made, measured);
    if (modelled != nullptr) {
        mark_unknown_encodings(made, measured);
    }
    return std::move(made).take();
}

}  // namespace

std::string label_of(bool modelled, const std::string& more, bool software_double) {
    return fmt::format("{}{}{}", modelled ? "modelled cycles" : "instructions only", more,
                       software_double ? "; double precision in software, where the count depends on the data" : "");
}

void add_instructions(Row& row, const qemu::MeasuredRow& counted) {
    row.set(Counter::instructions_per_sample, counted.instructions);
    row.set(Counter::loads_per_sample, counted.loads);
    row.set(Counter::stores_per_sample, counted.stores);
    row.set(Counter::branches_per_sample, counted.branches);
    row.set(Counter::first_instructions, counted.first.instructions);
    row.set(Counter::worst_instructions, counted.worst_instructions);
}

void add_modelled(Row& row, const qemu::ModelledCall& call, double clock_hz) {
    row.set_time(call.cycles / clock_hz * 1e9);
    row.set(Counter::model_cycles_per_sample, call.cycles);
    row.set(Counter::model_cycles_low, call.low);
    row.set(Counter::model_cycles_high, call.high);
    row.set(Counter::first_model_cycles, call.first_cycles);
    row.set(Counter::worst_model_cycles, call.worst_cycles);
    row.set(Counter::latency_model_cycles, call.latency_cycles);
    for (std::size_t e = 0; e < timing::effect_count; ++e) {
        row.set(CounterFamily::stall, timing::effect_names[e], call.lost[e]);
    }
    row.set(CounterFamily::stall, timing::double_in_software, call.double_in_software);
}

void add_bytes(Row& row, const qemu::MeasuredRow& counted) {
    row.set(Counter::code_bytes, counted.code_bytes);
    row.set(Counter::stack_bytes, counted.stack_bytes);
    row.set(Counter::state_bytes, counted.state_bytes);
    row.set(Counter::coefficient_bytes, counted.coefficient_bytes);
}

void mark_unknown_encodings(Row& row, const qemu::MeasuredRow& counted) {
    if (!counted.unknown_encodings.empty()) {
        row.mark_error(fmt::format("the timing model does not know {} encodings, the first at {:#010x}",
                                   counted.unknown_encodings.size(), counted.unknown_encodings.front()));
    }
}

std::vector<double> clocks_of(const timing::TimingRequest& request) {
    std::vector<double> clocks;
    for (const timing::CoreFile& core : timing::cores_of(request)) {
        clocks.push_back(static_cast<double>(core.sets.front().figures.memory_clock_hz));
    }
    return clocks;
}

timing::TimingRequest timing_request(const std::filesystem::path& folder, const std::vector<std::string>& cores) {
    timing::TimingRequest request;
    request.cores_folder = folder.string();
    for (const std::string& core : cores) {
        request.cores.push_back({core, "", ""});
    }
    return request;
}

std::vector<Counted> count_on_target(const std::vector<qemu::PlannedRow>& plan, const qemu::Signals& signals,
                                     const qemu::Board& board, unsigned jobs, const qemu::RowDone& done,
                                     const timing::TimingRequest& timing) {
    const auto compared = run_in_shares<qemu::MeasuredRow>(
        plan, jobs,
        [&](const auto& share) { return qemu::measure(board, share, signals, done, qemu::Counting::blocks, timing); },
        [&](qemu::PlannedRow planned) {
            planned.calls = qemu::calls_hashed(planned.kernel, planned.calls);
            return qemu::replay_here(planned, signals);
        });
    std::vector<Counted> counted;
    for (const auto& [row, same] : compared) {
        counted.push_back({row, same});
    }
    return counted;
}

std::vector<std::vector<Json>> measure_on_target(const Sweep& sweep, const qemu::Board& board,
                                                 const std::vector<std::size_t>& pieces) {
    const TargetPlan plan = part_of(make_target_plan(sweep), pieces);
    qemu::Signals signals;
    for (const std::string& name : sweep.signals) {
        signals.push_back(make_signal(name, sweep.samples, sweep.seed));
    }
    signals.push_back(make_signal("noise", sweep.samples, sweep.seed + 1));  // the one that counts are taken on
    std::vector<qemu::PlannedRow> replay_plan;
    for (const TargetPlan::Replay& replay : plan.replays) {
        replay_plan.push_back(replay.planned);
    }

    base::Progress progress(board.name(), plan.counts.size() + replay_plan.size());
    const auto done = [&] { progress.advance(); };
    const std::vector<std::string> cores = sweep.cores_on(*board.machine);
    std::vector<std::string> modelled_cores = cores;
    std::erase(modelled_cores, count_only);
    const timing::TimingRequest request = timing_request(board.cores, modelled_cores);
    const std::vector<double> clocks = clocks_of(request);
    const auto counts = count_on_target(plan.counts, signals, board, sweep.jobs, done, request);
    const auto replays = run_in_shares<qemu::ReplayedRow>(
        replay_plan, sweep.jobs, [&](const auto& share) { return qemu::replay(board, share, signals, done); },
        [&](const qemu::PlannedRow& planned) { return qemu::replay_here(planned, signals); });

    std::vector<bool> same_bits;
    for (const TargetPlan::Row& row : plan.rows) {
        same_bits.push_back(counts[row.count].same_bits);
    }
    for (std::size_t i = 0; i < replays.size(); ++i) {
        const std::size_t row = plan.replays[i].row;
        same_bits[row] = same_bits[row] && replays[i].same;
    }
    std::vector<std::vector<Json>> result(pieces.size());
    for (std::size_t i = 0; i < plan.rows.size(); ++i) {
        const TargetPlan::Row& row = plan.rows[i];
        auto& rows = result[static_cast<std::size_t>(std::lower_bound(pieces.begin(), pieces.end(), row.piece) -
                                                     pieces.begin())];
        const qemu::MeasuredRow& measured = counts[row.count].row;
        std::size_t modelled = 0;
        for (const std::string& core : cores) {
            const bool counted = core == count_only;
            const qemu::ModelledCall* call = counted || measured.cores.empty() ? nullptr : &measured.cores[modelled];
            rows.push_back(to_json(row, plan.counts[row.count].order, measured, on_target(*board.machine, core), call,
                                   counted ? 1.0 : clocks[modelled]));
            modelled += counted ? 0 : 1;
            if (!same_bits[i]) {
                mark_error(rows.back(), other_bits);
            }
        }
    }
    return result;
}

}  // namespace bench
