#include <fmt/format.h>

#include <string>

#include "bench/generate/parts.hpp"
#include "bench/generate/shared.hpp"
#include "bench/generate/text.hpp"

namespace generate {
namespace {

// The products of so many groups with neighbouring outputs; the last `kept` coefficients are there.
std::pair<std::string, std::string> groups_text(const std::string& name, int outputs, int groups, int kept, bool fused,
                                                bool loads_first) {
    const Words words = {{"count", fmt::format("{}", 4 * groups)},
                         {"outputs", fmt::format("{}", outputs)},
                         {"kept", fmt::format("{}", kept)},
                         {"accumulate<Format, fused>", accumulate(fused)}};
    const std::string first =
        loads_first
            ? "#if defined(__ARM_ARCH_7EM__) && defined(__GNUC__) && defined(__ARM_FP)\n    /* All loads before "
              "the first product, which holds off those behind it for three cycles. */\n" +
                  shared("load all") + "#endif\n"
            : "";
    return {name,
            helper("void", name, "@accumulator@ *s, @coefficient@ *c, const @coefficient@ *a, const @sample@ *samples",
                   shared("groups", words) + first + shared("groups added", words))};
}

}  // namespace

// kernels/glsum/lookahead/block_body.hpp.
TechniqueText block_text(bool fused, bool fixed) {
    const int outputs = fixed ? 2 : 4;
    const Words words = {{", state.scale)", ")"},
                         {"phases", "4U"},
                         {"outputs", fmt::format("{}U", outputs)},
                         {"state.groups", "@NAME@_GROUPS"},
                         {"groups", "@NAME@_GROUPS"},
                         {"state.table", "@name@_table"},
                         {"state.", "S->"},
                         {"std::min", "@name@_min"},
                         {"add_groups<outputs, 1, outputs - 1>", "@name@_add_group"},
                         {"add_groups<outputs, 1, 0>", "@name@_add_group"},
                         {"add_groups<outputs, 2, 0>", "@name@_add_two_groups"},
                         {"add_share<outputs>", "@name@_add_share"},
                         {"accumulate<Format, fused>", accumulate(fused)}};
    return {.summary = "oldest first, one accumulator for each of four coming outputs" + rounded_once(fused),
            .sum = "    const size_t phase = S->phase;\n" + shared("block", words) + shared("block ahead", words),
            .closing = shared("block closing", words),
            .pushes = true,
            .fused = fused,
            .helpers = {
                groups_text("add_group", outputs, 1, fixed ? outputs - 1 : 0, fused, false),
                groups_text("add_two_groups", outputs, 2, 0, fused, fused),
                {"add_share", helper("void", "add_share",
                                     "@accumulator@ *sums, const @coefficient@ *a, const @sample@ *samples, "
                                     "size_t count",
                                     shared("share", words) + shared(fixed ? "share fixed" : "share floating", words) +
                                         shared("share kept", words))},
                {"min", helper("size_t", "min", "size_t a, size_t b", "    return b < a ? b : a;\n")}}};
}

}  // namespace generate
