// What the emulated target is to run for a sweep: nothing twice that must come out the same.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/sweep/sweep.hpp"
#include "qemu/emulate/firmware.hpp"

namespace bench {

struct TargetPlan {
    struct Row {
        std::string kernel;
        double order;
        Length length;
        bool software_double;
        std::size_t count;  ///< index into `counts`
        /// The same for all orders of a kernel and length, or of a kernel with modes, which share counts: numbered from
        /// 0.
        std::size_t piece;
    };
    struct Replay {
        std::size_t row;  ///< index into `rows`
        qemu::PlannedRow planned;
    };
    std::vector<Row> rows;  ///< every order, length and target kernel of the sweep
    /// One for each kernel, length and `CountPath`, at the first order of the sweep that takes it, on the signal behind
    /// the sweep's last.
    std::vector<qemu::PlannedRow> counts;
    /// At least one for each row. The signal rotates from row to row, so that every kernel meets every signal; where
    /// the sweep has fewer orders and lengths than signals, rows replay several.
    std::vector<Replay> replays;
};

[[nodiscard]] TargetPlan make_target_plan(const Sweep& sweep);

/// The part of a plan that some pieces need: each row with the count and the replays that it has in the whole.
/// \param pieces  rising
/// \return  its rows sorted by piece
[[nodiscard]] TargetPlan part_of(const TargetPlan& whole, const std::vector<std::size_t>& pieces);

/// For each piece of a whole plan the sum of `estimated_cost`.
[[nodiscard]] std::vector<double> piece_costs(const TargetPlan& whole);

/// The first order of the sweep: counts are taken there wherever those of all orders are equal, and in software double.
[[nodiscard]] inline double count_order(const Sweep& sweep) { return sweep.orders.front(); }

/// How long the emulator works at a row, in taps of hardware arithmetic.
[[nodiscard]] double estimated_cost(const qemu::PlannedRow& row);

}  // namespace bench
