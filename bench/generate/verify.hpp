// Generated headers on the emulated Cortex-M7: their bits, and their instructions beside those of the kernels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/generate/header.hpp"
#include "qemu/firmware.hpp"

namespace generate {

struct Verified {
    std::string kernel;
    std::size_t taps;
    std::uint32_t first_wrong;   ///< of the self-check on the target: 0 when all bits are the kernel's
    double kernel_instructions;  ///< a sample in the steady state, of the registered kernel
    double header_instructions;  ///< of the header's step, compiled as C99 with the target's own optimisation
    double kernel_stores;
    double header_stores;
    [[nodiscard]] bool good() const { return first_wrong == 0 && header_instructions <= kernel_instructions; }
};

/// Compiles every header (warnings are errors), runs its self-check, and counts its steps and the kernel's on the same
/// samples. \throws glsum::Failure (missing) without the target's compiler, (check failed) when it refuses a header.
[[nodiscard]] std::vector<Verified> verify_on_target(const std::vector<Spec>& specs, const qemu::Board& board);

/// As a person reads it.
[[nodiscard]] std::string to_table(const std::vector<Verified>& all);

}  // namespace generate
