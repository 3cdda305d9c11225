#include "bench/target/target_plan.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "bench/sweep/designs.hpp"
#include "bench/target/count_path.hpp"
#include "glsum/catalogue.hpp"

namespace bench {
namespace {

// A replay need not be longer: the counted calls, whose outputs are compared too, go past the whole window and a wrap
// of every history.
constexpr std::size_t longest_replay = 1100;
// Software doubles take a hundred instructions a tap, whatever the call: ten of their replays would take longer than
// all others together.
constexpr std::size_t longest_replay_in_software = 128;

std::vector<std::string> target_kernels(const Sweep& sweep) {
    std::vector<std::string> kernels;
    for (const glsum::CatalogueEntry& kernel : glsum::catalogue) {
        if (!kernel.host_only &&
            std::find(sweep.kernels.begin(), sweep.kernels.end(), kernel.name) != sweep.kernels.end()) {
            kernels.emplace_back(kernel.name);
        }
    }
    return kernels;
}

}  // namespace

TargetPlan make_target_plan(const Sweep& sweep) {
    const std::vector<std::string> kernels = target_kernels(sweep);
    const std::size_t signals = sweep.signals.size();
    TargetPlan plan;
    std::map<std::tuple<std::size_t, std::size_t, CountPath>, std::size_t> known;
    std::vector<std::size_t> places(kernels.size(), 0);  // rows of each
    for (std::size_t k = 0; k < kernels.size(); ++k) {
        for (const double order : sweep.orders) {
            places[k] += lengths_of(sweep, kernels[k], order).size();
        }
    }
    std::vector<std::size_t> place(kernels.size(), 0);
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> piece_of;  // by the kernel and which of its lengths
    for (const double order : sweep.orders) {
        std::vector<std::vector<Length>> lengths;
        std::size_t most = 0;
        for (const std::string& kernel : kernels) {
            lengths.push_back(lengths_of(sweep, kernel, order));
            most = std::max(most, lengths.back().size());
        }
        for (std::size_t l = 0; l < most; ++l) {
            for (std::size_t k = 0; k < kernels.size(); ++k) {
                if (l >= lengths[k].size()) {
                    continue;
                }
                const std::string& kernel = kernels[k];
                const Length& length = lengths[k][l];
                const std::size_t taps = length.taps;
                const glsum::Design design = design_of(kernel, order, length, sweep.samples);
                const std::vector<glsum::Mode> modes(design.modes.begin(), design.modes.end());
                const auto [count, is_new] =
                    known.try_emplace({k, taps, count_path(kernel, design)}, plan.counts.size());
                if (is_new) {
                    plan.counts.push_back(
                        {kernel, order, taps, signals, qemu::calls_to_measure(kernel, taps), modes, design.blocks});
                }
                // With modes the past is never over, with blocks it is longer than the taps.
                const std::size_t longest = double_in_software(kernel) ? longest_replay_in_software : longest_replay;
                const std::size_t calls = std::min({sweep.samples, length.window() ? taps + 64 : longest, longest});
                for (std::size_t turn = place[k]; turn == place[k] || turn < signals; turn += places[k]) {
                    plan.replays.push_back(
                        {plan.rows.size(), {kernel, order, taps, (turn + k) % signals, calls, modes, design.blocks}});
                }
                ++place[k];
                // One for all orders, which share their counts; of a kernel with modes one for all of its designs.
                const std::size_t piece =
                    piece_of.try_emplace({k, length.modes ? 0 : l}, piece_of.size()).first->second;
                plan.rows.push_back({kernel, order, length, double_in_software(kernel), count->second, piece});
            }
        }
    }
    return plan;
}

TargetPlan part_of(const TargetPlan& whole, const std::vector<std::size_t>& pieces) {
    std::vector<std::size_t> kept;
    for (std::size_t row = 0; row < whole.rows.size(); ++row) {
        if (std::binary_search(pieces.begin(), pieces.end(), whole.rows[row].piece)) {
            kept.push_back(row);
        }
    }
    std::stable_sort(kept.begin(), kept.end(),
                     [&](std::size_t a, std::size_t b) { return whole.rows[a].piece < whole.rows[b].piece; });
    TargetPlan part;
    std::map<std::size_t, std::size_t> row_at;
    std::map<std::size_t, std::size_t> count_at;
    for (const std::size_t row : kept) {
        row_at[row] = part.rows.size();
        part.rows.push_back(whole.rows[row]);
        const auto [count, is_new] = count_at.try_emplace(whole.rows[row].count, part.counts.size());
        if (is_new) {
            part.counts.push_back(whole.counts[whole.rows[row].count]);
        }
        part.rows.back().count = count->second;
    }
    for (const TargetPlan::Replay& replay : whole.replays) {
        if (const auto row = row_at.find(replay.row); row != row_at.end()) {
            part.replays.push_back({row->second, replay.planned});
        }
    }
    return part;
}

std::vector<double> piece_costs(const TargetPlan& whole) {
    std::size_t pieces = 0;
    for (const TargetPlan::Row& row : whole.rows) {
        pieces = std::max(pieces, row.piece + 1);
    }
    std::vector<double> costs(pieces, 0.0);
    std::set<std::pair<std::size_t, std::size_t>> counted;
    for (const TargetPlan::Row& row : whole.rows) {
        if (counted.insert({row.piece, row.count}).second) {
            costs[row.piece] += estimated_cost(whole.counts[row.count]);
        }
    }
    for (const TargetPlan::Replay& replay : whole.replays) {
        costs[whole.rows[replay.row].piece] += estimated_cost(replay.planned);
    }
    return costs;
}

double estimated_cost(const qemu::PlannedRow& row) {
    const double per_tap = double_in_software(row.kernel) ? 10.0 : 1.0;
    return static_cast<double>(row.calls) * static_cast<double>(row.taps) * per_tap;
}

}  // namespace bench
