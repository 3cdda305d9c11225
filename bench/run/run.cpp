#include "bench/run/run.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "bench/host/host_timing.hpp"
#include "bench/run/context.hpp"
#include "bench/sweep/accuracy.hpp"
#include "bench/target/target_rows.hpp"

namespace bench {

Results measure(const Sweep& sweep, const std::optional<Shard>& shard, const std::vector<qemu::Board>& boards,
                const std::vector<std::string>& flags) {
    const std::vector<Piece> pieces = make_pieces(sweep);
    const std::vector<std::size_t> share = pieces_of(pieces, shard.value_or(Shard{}));
    const auto numbers = [&](Piece::Kind kind, const base::Machine* machine = nullptr) {
        std::vector<std::size_t> of_kind;
        for (const std::size_t piece : share) {
            if (pieces[piece].kind == kind && pieces[piece].machine == machine) {
                of_kind.push_back(pieces[piece].number);
            }
        }
        return of_kind;
    };
    std::vector<std::vector<Json>> rows;  // of each piece of the share
    const auto append = [&](std::vector<std::vector<Json>> more) {
        std::move(more.begin(), more.end(), std::back_inserter(rows));
    };
    if (const auto cases = numbers(Piece::Kind::accuracy); !cases.empty()) {
        append(measure_accuracy(sweep, cases));
    }
    for (const qemu::Board& board : boards) {
        if (const auto on_target = numbers(Piece::Kind::target, board.machine); !on_target.empty()) {
            append(measure_on_target(sweep, board, on_target));
        }
    }
    Json google;
    if (!numbers(Piece::Kind::host).empty()) {
        // Last and alone: nothing else of this run is at work.
        HostTiming timing = time_on_host(sweep, flags);
        google = std::move(timing.context);
        append({std::move(timing.rows)});
    }
    Results results;
    results.context = make_context(std::move(google), sweep, boards);
    if (shard) {
        Json counts = Json::array();
        for (std::size_t i = 0; i < share.size(); ++i) {
            counts.push_back({share[i], rows[i].size()});
        }
        results.context["shard"] = {
            {"index", shard->index}, {"count", shard->count}, {"pieces", pieces.size()}, {"rows_of_pieces", counts}};
    }
    for (auto& of_piece : rows) {
        std::move(of_piece.begin(), of_piece.end(), std::back_inserter(results.rows));
    }
    return results;
}

}  // namespace bench
