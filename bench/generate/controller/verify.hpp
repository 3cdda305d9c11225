// Written controllers compiled, here and for the target, and held to the bits of the library's float stepper.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/generate/controller/check_source.hpp"
#include "qemu/emulate/firmware.hpp"

namespace generate {

/// Where a controller was stepped, and what came out.
struct CheckedBits {
    std::string where;  ///< "here, compiled by cc" or "on the emulated Cortex-M7"
    std::size_t steps;  ///< of the record, each of them compared
    std::uint32_t
        first_wrong;  ///< 0: all bits are the library's, those of the self-check too; else as an entry returns
    [[nodiscard]] bool good() const { return first_wrong == 0; }
};

/// With this machine's C compiler, `cc`; warnings are errors.
/// \throws glsum::Failure (missing) without one, (check failed) when it refuses the header
[[nodiscard]] CheckedBits check_bits_here(const WrittenController& controller);

/// With the target's, on the emulated board. \throws glsum::Failure as `link_for_target` and `run_on_target`
[[nodiscard]] CheckedBits check_bits_on_target(const WrittenController& controller, const qemu::Board& board,
                                               const timing::TimingRequest& timing);

/// On one line.
[[nodiscard]] std::string to_text(const CheckedBits& checked);

}  // namespace generate
