// Generated headers on the emulated Cortex-M7: their bits, and their instructions beside those of the kernels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bench/generate/header.hpp"
#include "qemu/emulate/firmware.hpp"
#include "qemu/stream/call_counter.hpp"

namespace generate {

struct Verified {
    std::string kernel;
    std::size_t taps;
    std::uint32_t first_wrong;   ///< of the self-check on the target: 0 when all bits are the kernel's
    double kernel_instructions;  ///< a sample in the steady state, of the registered kernel
    double header_instructions;  ///< of the header's step, compiled as C99 with the target's own optimisation
    double kernel_stores;
    double header_stores;
    double kernel_cycles;  ///< a sample, modelled, nominal rules
    double header_cycles;

    /// In software double one call is timed, and the branches of its routines depend on the numbers and on where they
    /// are called from: no more than this is a cost.
    static constexpr double place_share = 0.04;
    /// Of few taps, three branches that are foreseen in the one place and not in the other, 8 cycles and a fetch each.
    static constexpr double place_cycles = 30.0;

    /// Beside its calls of some 140 instructions a tap: GCC 14 saves up to six registers more a sample, of few taps
    /// too.
    static constexpr double saved_share = 0.001;
    static constexpr double saved_instructions = 8.0;

    /// An instruction that issues beside another costs nothing: where the cycles are no more, what another compiler
    /// makes of the same statements may have some more of them (GCC 14, 300 taps in blocks: 6 %).
    static constexpr double spare_share = 0.07;

    /// Where one instruction issues a cycle: a product that is kept from being fused with its sum stands right before
    /// it, since the compiler does not know what keeps it, and the sum waits a cycle a tap (of nine to ten).
    static constexpr double kept_share = 0.11;
    bool single_issue = false;  ///< whether it does

    /// But for that, cycles count to the last one.
    [[nodiscard]] bool good() const;
};

/// One C file of all headers, each `<prefix>.h`: for each a function count_<prefix> to be counted and the calls of it.
[[nodiscard]] std::string counted_source(const std::vector<Spec>& specs);

/// Mean counts of a function's steady calls.
struct SteadyCalls {
    static constexpr std::size_t count = 32;
    double instructions = 0.0;
    double stores = 0.0;
    std::uint64_t first_instructions = 0;  ///< of the first call of all
};

/// Of 32 calls once the past is full, those that `qemu::measure` takes a kernel's mean of: the ones behind the first L
/// and one more. \param taps  L of each function in the log, by its address
[[nodiscard]] std::map<std::uint32_t, SteadyCalls> steady_calls_of(const qemu::CallLog& log,
                                                                   const std::map<std::uint32_t, std::size_t>& taps);

/// Compiles every header (warnings are errors), runs its self-check, and counts and times its steps and the kernel's.
/// \param timing  of one core
/// \throws glsum::Failure (missing) without the target's compiler, (check failed) when it refuses a header.
[[nodiscard]] std::vector<Verified> verify_on_target(const std::vector<Spec>& specs, const qemu::Board& board,
                                                     const timing::TimingRequest& timing);

/// As a person reads it. \param core  the one that was modelled
[[nodiscard]] std::string to_table(const std::vector<Verified>& all, const std::string& core, const qemu::Board& board);

}  // namespace generate
