#include "qemu/emulate/silicon_loops.hpp"

#include <algorithm>
#include <iterator>

namespace qemu {
namespace {

#define GLSUM_LOOP(name, most_taps) {#name, most_taps},
constexpr SiliconLoop loops[] = {
#include "targets/shared/silicon_loops.def"
};
constexpr SiliconLoop rivals[] = {
#include "targets/shared/rival_loops.def"
};
#undef GLSUM_LOOP

}  // namespace

const SiliconLoop* find_loop(std::string_view name) {
    const auto* const found =
        std::find_if(std::begin(loops), std::end(loops), [&](const SiliconLoop& loop) { return loop.name == name; });
    return found == std::end(loops) ? nullptr : found;
}

std::span<const SiliconLoop> rival_loops() { return rivals; }

}  // namespace qemu
