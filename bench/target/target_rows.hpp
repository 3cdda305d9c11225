// Rows of an emulated machine, with the proof that it computes the host's bits.
#pragma once

#include <cstddef>
#include <vector>

#include "bench/rows/row.hpp"
#include "bench/sweep/sweep.hpp"
#include "qemu/emulate/firmware.hpp"

namespace bench {

/// One counted row, and whether the target computed the host's bits.
struct Counted {
    qemu::MeasuredRow row;
    bool same_bits;
};

/// A request for the timing model: cores of a folder, placed as their files say.
[[nodiscard]] timing::TimingRequest timing_request(const std::filesystem::path& folder,
                                                   const std::vector<std::string>& cores);

/// What a target's row is: modelled or counted alone, `more` that is to be said, and where double is in software.
[[nodiscard]] std::string label_of(bool modelled, const std::string& more, bool software_double);

/// Instructions, loads, stores and branches of a counted row.
void add_instructions(Row& row, const qemu::MeasuredRow& counted);
/// The counters of a modelled call, its time in ns at the core's clock.
void add_modelled(Row& row, const qemu::ModelledCall& call, double clock_hz);
/// Code, stack, state and coefficients.
void add_bytes(Row& row, const qemu::MeasuredRow& counted);
/// Marks a modelled row where the timing model does not know an encoding.
void mark_unknown_encodings(Row& row, const qemu::MeasuredRow& counted);

/// What marks a row whose outputs are not the host's.
inline constexpr const char* other_bits = "the target's outputs differ from the host's";

/// The clock of each core of a request, in Hz.
[[nodiscard]] std::vector<double> clocks_of(const timing::TimingRequest& request);

/// Counts the plan's rows on the emulated board, in shares of about equal cost. \param done  called after each row
/// \param timing  cores to be modelled in the same runs; may have none
[[nodiscard]] std::vector<Counted> count_on_target(const std::vector<qemu::PlannedRow>& plan,
                                                   const qemu::Signals& signals, const qemu::Board& board,
                                                   unsigned jobs, const qemu::RowDone& done,
                                                   const timing::TimingRequest& timing = {});

/// For each kernel that runs on the target, order and length: instructions, loads, stores and branches of the first
/// call and of a steady one, the worst of a whole turn, bytes of code, stack, state and coefficients. Named
/// ".../m7:count", or ".../m4:count" by the board's machine: counts of instructions, never called cycles. For each core
/// of the sweep that is modelled there the same row again, named ".../m7:<core>", with the cycles that the timing model
/// gives the same calls; its time is theirs at the core's clock.
///
/// Which instructions a kernel executes follows from its length and, in fixed point, the scale; each such case is
/// counted once, and the rows of every order have it, their labels saying at which order it was taken. In software
/// double, where the data decides too, the count is that of the sweep's first order.
///
/// The outputs of the counted calls must have the host's hash, and so must those of a replay of each row, over up to
/// 1100 samples of a signal of the sweep: from row to row another one, so that every kernel meets every signal. A row
/// whose outputs differ is marked wrong.
/// \param pieces  which pieces of the sweep's `TargetPlan`, rising; their rows are those of a run of all
/// \return  the rows of each piece, in their order
[[nodiscard]] std::vector<std::vector<Json>> measure_on_target(const Sweep& sweep, const qemu::Board& board,
                                                               const std::vector<std::size_t>& pieces);

}  // namespace bench
