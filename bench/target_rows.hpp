// Rows of the emulated Cortex-M7, with the proof that it computes the host's bits.
#pragma once

#include <vector>

#include "bench/row.hpp"
#include "bench/sweep.hpp"
#include "qemu/firmware.hpp"

namespace bench {

/// For each kernel that runs on the target, order and length: instructions, loads, stores and branches of the first
/// call and of a steady one, the worst of a whole turn, bytes of code, stack, state and coefficients. Named
/// ".../m7:count": counts of instructions, never called cycles. The outputs of these calls, and of the same kernel on
/// every signal of the sweep, must have the host's hash; a row whose outputs differ is marked wrong.
[[nodiscard]] std::vector<Json> measure_on_target(const Sweep& sweep, const qemu::Board& board);

}  // namespace bench
