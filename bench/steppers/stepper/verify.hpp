// Written controllers and models compiled, here and for the target, and held to the bits of the library's steppers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/steppers/stepper/check_source.hpp"
#include "qemu/emulate/firmware.hpp"

namespace generate {

/// Where a header was stepped, and what came out.
struct CheckedBits {
    std::string where;  ///< "here, compiled by cc" or "on the emulated Cortex-M7"
    std::size_t steps;  ///< of the record, each of them compared
    std::uint32_t
        first_wrong;  ///< 0: all bits are the library's, those of the self-check too; else as an entry returns
    [[nodiscard]] bool good() const { return first_wrong == 0; }
};

/// With this machine's C compiler, `cc`; warnings are errors.
/// \throws glsum::Failure (missing) without one, (check failed) when it refuses the header
[[nodiscard]] CheckedBits check_bits_here(const WrittenStepper& stepper);

/// What a step costs on the target. Cycles are modelled: the mean of 32 steps behind as many others; of a controller
/// they meet no limit.
struct StepCost {
    double cycles = 0.0;
    double low = 0.0;  ///< over the core's rule sets, the nominal one included
    double high = 0.0;
    double instructions = 0.0;
    std::size_t code_bytes = 0;   ///< of the step, its sums in it
    std::size_t table_bytes = 0;  ///< constant
    std::size_t state_bytes = 0;  ///< of an instance
    std::string where = "emulated Cortex-M7";
};

struct OnTarget {
    CheckedBits bits;
    StepCost cost;
};

/// With the target's compiler, on the emulated board. \param timing  of one core
/// \throws glsum::Failure as `link_for_target` and `run_on_target`
[[nodiscard]] std::vector<OnTarget> check_on_target(const std::vector<WrittenStepper>& steppers,
                                                    const qemu::Board& board, const timing::TimingRequest& timing);

/// On one line.
[[nodiscard]] std::string to_text(const CheckedBits& checked);

/// A line for each named cost, under a heading, and what the columns are. \pre there is a cost
[[nodiscard]] std::string cost_table(const std::vector<std::pair<std::string, StepCost>>& rows,
                                     const std::string& core);

}  // namespace generate
