#include "bench/run/pieces.hpp"

#include <algorithm>

#include "bench/target/shares.hpp"
#include "bench/target/target_plan.hpp"

namespace bench {
namespace {

// Of one core at 2.5 GHz: the exact sums go with the square of the record, the kernels with their taps.
constexpr double seconds_per_exact_product = 4.6e-8;
constexpr double seconds_per_tap = 1.1e-9;
constexpr double seconds_per_emulated_tap = 3.5e-8;
constexpr double seconds_per_timing = 0.09;
constexpr double seconds_per_repetition = 0.002;

double accuracy_cost(const Sweep& sweep) {
    const auto samples = static_cast<double>(sweep.samples);
    double taps = 0.0;
    for (const Length& length : sweep.lengths) {
        taps += static_cast<double>(length.taps);
    }
    return seconds_per_exact_product * samples * samples +
           seconds_per_tap * samples * taps * static_cast<double>(sweep.kernels.size());
}

}  // namespace

std::vector<Piece> make_pieces(const Sweep& sweep) {
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < sweep.orders.size() * sweep.signals.size(); ++i) {
        pieces.push_back({Piece::Kind::accuracy, i, accuracy_cost(sweep)});
    }
    for (const base::Machine* machine : sweep.machines()) {
        const std::vector<double> costs = piece_costs(make_target_plan(sweep));
        for (std::size_t i = 0; i < costs.size(); ++i) {
            pieces.push_back({Piece::Kind::target, i, seconds_per_emulated_tap * costs[i], machine});
        }
    }
    if (sweep.wants("host")) {
        const std::size_t timings = (sweep.kernels.size() + sweep.peers.size()) * sweep.lengths.size();
        const double each = sweep.repetitions > 1 ? seconds_per_repetition * sweep.repetitions : seconds_per_timing;
        pieces.push_back({Piece::Kind::host, 0, each * static_cast<double>(timings)});
    }
    return pieces;
}

std::vector<std::size_t> pieces_of(const std::vector<Piece>& pieces, const Shard& shard) {
    std::vector<double> costs;
    for (const Piece& piece : pieces) {
        costs.push_back(piece.cost);
    }
    std::vector<std::vector<std::size_t>> shares = balanced_shares(costs, shard.count);
    shares.resize(shard.count);
    const auto times_host = std::find_if(shares.begin(), shares.end(), [&](const auto& share) {
        return !share.empty() && pieces[share.back()].kind == Piece::Kind::host;
    });
    if (times_host != shares.end()) {
        std::swap(*times_host, shares.back());
    }
    return shares[shard.index - 1];
}

}  // namespace bench
