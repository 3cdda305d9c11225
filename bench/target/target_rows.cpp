#include "bench/target/target_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "bench/sweep/signals.hpp"
#include "bench/target/deal.hpp"
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
    const auto shares = deal(costs, jobs);
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

// The row of one of the sweep's cores. \param clock_hz  of a modelled one
Json to_json(const TargetPlan::Row& row, double counted_at, const qemu::MeasuredRow& measured, const std::string& core,
             const qemu::ModelledCall* modelled, double clock_hz) {
    const std::string software =
        row.software_double ? "; double precision in software, where the count depends on the data" : "";
    Json json = make_row(row_name(row.kernel, row.order, row.length, "m7:" + core), 32);
    json["label"] = fmt::format("{}; counted at order {}{}",
                                modelled != nullptr ? "modelled cycles" : "instructions only", counted_at, software);
    if (measured.status != glsum::Status::ok) {
        mark_error(json, to_text(measured.status));
        return json;
    }
    json["instructions_per_sample"] = measured.instructions;
    json["loads_per_sample"] = measured.loads;
    json["stores_per_sample"] = measured.stores;
    json["branches_per_sample"] = measured.branches;
    json["first_instructions"] = measured.first.instructions;
    json["worst_instructions"] = measured.worst_instructions;
    if (modelled != nullptr) {
        add_modelled(json, *modelled, clock_hz);
    }
    json["code_bytes"] = measured.code_bytes;
    json["stack_bytes"] = measured.stack_bytes;
    json["state_bytes"] = measured.state_bytes;
    json["coefficient_bytes"] = measured.coefficient_bytes;
    if (modelled != nullptr && !measured.unknown_encodings.empty()) {
        mark_error(json, fmt::format("the timing model does not know {} encodings, the first at {:#010x}",
                                     measured.unknown_encodings.size(), measured.unknown_encodings.front()));
    }
    return json;
}

}  // namespace

void add_modelled(Json& row, const qemu::ModelledCall& call, double clock_hz) {
    row["real_time"] = row["cpu_time"] = call.cycles / clock_hz * 1e9;
    row["model_cycles_per_sample"] = call.cycles;
    row["model_cycles_low"] = call.low;
    row["model_cycles_high"] = call.high;
    row["first_model_cycles"] = call.first_cycles;
    row["worst_model_cycles"] = call.worst_cycles;
    row["latency_model_cycles"] = call.latency_cycles;
    for (std::size_t e = 0; e < timing::effect_count; ++e) {
        row[fmt::format("stall_{}", timing::effect_names[e])] = call.lost[e];
    }
    row[fmt::format("stall_{}", timing::double_in_software)] = call.double_in_software;
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

    base::Progress progress("emulated Cortex-M7", plan.counts.size() + replay_plan.size());
    const auto done = [&] { progress.advance(); };
    const timing::TimingRequest request = timing_request(board.cores, sweep.modelled_cores());
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
        for (const std::string& core : sweep.cores) {
            const bool counted = core == count_only;
            const qemu::ModelledCall* call = counted || measured.cores.empty() ? nullptr : &measured.cores[modelled];
            rows.push_back(
                to_json(row, plan.counts[row.count].order, measured, core, call, counted ? 1.0 : clocks[modelled]));
            modelled += counted ? 0 : 1;
            if (!same_bits[i]) {
                mark_error(rows.back(), "the target's outputs differ from the host's");
            }
        }
    }
    return result;
}

}  // namespace bench
