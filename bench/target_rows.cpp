#include "bench/target_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string_view>

#include "bench/parallel.hpp"
#include "bench/progress.hpp"
#include "bench/signals.hpp"
#include "glsum/registry.hpp"

namespace bench {
namespace {

struct Row {
    std::string kernel;
    double order;
    Length length;
    bool software_double;
};

std::vector<Row> rows_of(const Sweep& sweep) {
    std::vector<Row> rows;
    for (const double order : sweep.orders) {
        for (const Length& length : sweep.lengths) {
            glsum::Registry::for_each([&]<class K>() {
                const bool wanted =
                    std::find(sweep.kernels.begin(), sweep.kernels.end(), K::name()) != sweep.kernels.end();
                if (wanted && !K::host_only) {
                    rows.push_back({std::string(K::name()), order, length, sizeof(typename K::Output) == 8});
                }
            });
        }
    }
    return rows;
}

Json to_json(const Row& row, const qemu::MeasuredRow& measured) {
    Json json = make_row(row_name(row.kernel, row.order, row.length, "m7:count"), 32);
    json["label"] = row.software_double ? "instructions only; double precision in software" : "instructions only";
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
    json["code_bytes"] = measured.code_bytes;
    json["stack_bytes"] = measured.stack_bytes;
    json["state_bytes"] = measured.state_bytes;
    json["coefficient_bytes"] = measured.coefficient_bytes;
    return json;
}

// Every n-th row from the first on: neighbours differ in length, so that the shares weigh the same.
template <class T>
std::vector<T> share(const std::vector<T>& all, std::size_t first, std::size_t step) {
    std::vector<T> part;
    for (std::size_t i = first; i < all.size(); i += step) {
        part.push_back(all[i]);
    }
    return part;
}

}  // namespace

std::vector<Json> measure_on_target(const Sweep& sweep, const qemu::Board& board) {
    const std::vector<Row> rows = rows_of(sweep);
    qemu::Signals signals;
    for (const std::string& name : sweep.signals) {
        signals.push_back(make_signal(name, sweep.samples, sweep.seed));
    }
    signals.push_back(make_signal("noise", sweep.samples, sweep.seed + 1));
    const std::size_t noise = signals.size() - 1;

    std::vector<qemu::PlannedRow> measured_plan;
    std::vector<qemu::PlannedRow> replayed_plan;
    for (const Row& row : rows) {
        measured_plan.push_back(
            {row.kernel, row.order, row.length.taps, noise, qemu::calls_to_measure(row.length.taps)});
        // Past the whole window and a wrap of every history.
        const std::size_t calls = std::min(sweep.samples, row.length.taps + 64);
        for (std::size_t signal = 0; signal < noise; ++signal) {
            replayed_plan.push_back({row.kernel, row.order, row.length.taps, signal, calls});
        }
    }

    std::vector<Json> result(rows.size());
    std::vector<char> same_bits(rows.size(), 1);
    const std::size_t shares = std::max<std::size_t>(1, std::min<std::size_t>(sweep.jobs, rows.size()));
    Progress progress("emulated Cortex-M7", measured_plan.size() + replayed_plan.size());
    const auto done = [&] { progress.advance(); };
    parallel_for(shares, sweep.jobs, [&](std::size_t s) {
        const auto measured = qemu::measure(board, share(measured_plan, s, shares), signals, done);
        for (std::size_t i = 0; i < measured.size(); ++i) {
            const std::size_t row = s + i * shares;
            qemu::PlannedRow here = measured_plan[row];
            ++here.calls;  // the firmware makes one more, on a painted stack
            const qemu::ReplayedRow expected = qemu::replay_here(here, signals);
            result[row] = to_json(rows[row], measured[i]);
            same_bits[row] = expected.status == measured[i].status && expected.hash == measured[i].hash ? 1 : 0;
        }
    });
    std::vector<char> replay_same(replayed_plan.size(), 0);
    parallel_for(shares, sweep.jobs, [&](std::size_t s) {
        const auto part = share(replayed_plan, s, shares);
        const auto replayed = qemu::replay(board, part, signals, done);
        for (std::size_t i = 0; i < replayed.size(); ++i) {
            const qemu::ReplayedRow expected = qemu::replay_here(part[i], signals);
            replay_same[s + i * shares] =
                expected.status == replayed[i].status && expected.hash == replayed[i].hash ? 1 : 0;
        }
    });
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t signal = 0; signal < noise; ++signal) {
            same_bits[i] = same_bits[i] && replay_same[i * noise + signal] ? 1 : 0;
        }
        if (same_bits[i] == 0) {
            mark_error(result[i], "the target's outputs differ from the host's");
        }
    }
    return result;
}

}  // namespace bench
