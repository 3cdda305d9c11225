// The loops that `silicon` calls beside the registered kernels (targets/shared/silicon_loops.def).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace qemu {

struct SiliconLoop {
    std::string_view name;
    std::uint32_t most_taps;
};

/// The loop of this name; null if there is none.
[[nodiscard]] const SiliconLoop* find_loop(std::string_view name);

/// Those that tell rival rules of the timing model apart.
[[nodiscard]] std::span<const SiliconLoop> rival_loops();

}  // namespace qemu
