#include <fmt/format.h>

#include <string>
#include <vector>

#include "bench/generate/parts.hpp"
#include "bench/generate/text.hpp"

namespace generate {
namespace {

// The products of so many groups with neighbouring outputs, each number loaded once; the last `kept` coefficients are
// there.
std::string groups_text(std::size_t outputs, std::size_t groups, std::size_t kept, bool fused, int indent) {
    const std::size_t count = 4 * groups;
    const std::size_t coefficients = count - 1 + outputs;
    std::string text;
    const auto line = [&](const std::string& of) { text += fmt::format("{:{}}{}\n", "", indent, of); };
    for (std::size_t i = 0; i < coefficients - kept; ++i) {
        line(i < count ? fmt::format("c{} = *(a - {});", i, count - i) : fmt::format("c{} = a[{}];", i, i - count));
    }
    for (std::size_t r = 0; r < count; ++r) {
        line(fmt::format("x{0} = x[{0}];", r));
    }
    if (fused && groups == 2) {
        text += "#if defined(__ARM_ARCH_7EM__) && defined(__GNUC__)\n";
        const auto barrier = [&](const std::vector<std::string>& names) {
            std::string of;
            for (const std::string& name : names) {
                of += (of.empty() ? "\"+t\"(" : ", \"+t\"(") + name + ")";
            }
            line("__asm__ volatile(\"\" : " + of + ");");
        };
        std::vector<std::string> first;
        std::vector<std::string> second;
        for (std::size_t i = 0; i < coefficients; ++i) {
            first.push_back(fmt::format("c{}", i));
        }
        for (std::size_t r = 0; r < count; ++r) {
            second.push_back(fmt::format("x{}", r));
        }
        for (std::size_t q = 0; q < outputs; ++q) {
            second.push_back(fmt::format("s{}", q));
        }
        line("/* All loads before the first product, which holds off those behind it for three cycles. */");
        barrier(first);
        barrier(second);
        text += "#endif\n";
    }
    for (std::size_t r = 0; r < count; ++r) {
        for (std::size_t q = 0; q < outputs; ++q) {
            line(fmt::format("s{0} = {1}(s{0}, c{2}, x{3});", q, accumulate(fused), count - 1 + q - r, r));
        }
    }
    for (std::size_t i = kept; i > 0; --i) {
        line(fmt::format("c{} = c{};", 4 + i - 1, i - 1));
    }
    line(fmt::format("a -= {};", count));
    line(fmt::format("x += {};", count));
    return text;
}

std::string declared(const std::string& type, const char* name, std::size_t count, int indent) {
    std::string text = fmt::format("{:{}}{} ", "", indent, type);
    for (std::size_t i = 0; i < count; ++i) {
        text += fmt::format("{}{}{}", i == 0 ? "" : ", ", name, i);
    }
    return text + ";\n";
}

}  // namespace

// kernels/glsum/lookahead/block.hpp.
TechniqueText block_text(bool fused, bool fixed) {
    std::string text =
        "    const size_t phase = S->phase;\n"
        "    @accumulator@ sum = S->ready[phase];\n"
        "    size_t share = (@NAME@_GROUPS + phase) / 4U;\n"
        "    {\n"
        "        const @sample@ *own = S->past + 4U * S->own;\n"
        "        const @coefficient@ *direct = @name@_table + phase;\n"
        "        for (i = 0U; i < phase; ++i) {\n            --direct;\n            sum = " +
        accumulate(fused) +
        "(sum, *direct, own[i]);\n        }\n    }\n"
        "    S->past[4U * S->own + phase] = newest;\n"
        "    while (share != 0U) {\n"
        "        const size_t left = S->left;\n"
        "        size_t from = S->own + 1U + @NAME@_GROUPS - left;\n"
        "        size_t count;\n"
        "        from = from >= @NAME@_GROUPS ? from - @NAME@_GROUPS : from;\n"
        "        count = share < @NAME@_GROUPS - from ? share : @NAME@_GROUPS - from;\n";
    const std::string begin = "const @sample@ *x = S->past + 4U * from;\n";
    if (fixed) {
        text +=
            "        {\n            size_t q;\n            for (q = 0U; q < 4U; q += 2U) {\n"
            "                const @coefficient@ *a = @name@_table + 4U * left + q;\n                " +
            begin + declared("@coefficient@", "c", 5, 16) + declared("@sample@", "x", 4, 16) +
            "                @accumulator@ s0 = S->coming[q], s1 = S->coming[q + 1U];\n"
            "                c4 = a[0];\n"
            "                for (i = count; i > 0U; --i) {\n" +
            groups_text(2, 1, 1, false, 20) +
            "                }\n                S->coming[q] = s0;\n                S->coming[q + 1U] = s1;\n"
            "            }\n        }\n";
    } else {
        const auto tile = [&](std::size_t groups) {
            return declared("@coefficient@", "c", 4 * groups + 3, 16) + declared("@sample@", "x", 4 * groups, 16) +
                   groups_text(4, groups, 0, fused, 16);
        };
        text +=
            "        {\n            const @coefficient@ *a = @name@_table + 4U * left;\n            " + begin +
            "            @accumulator@ s0 = S->coming[0], s1 = S->coming[1], s2 = S->coming[2], s3 = S->coming[3];\n"
            "            if (count % 2U != 0U) {\n" +
            tile(1) + "            }\n            for (i = count / 2U; i > 0U; --i) {\n" + tile(2) +
            "            }\n            S->coming[0] = s0;\n            S->coming[1] = s1;\n            S->coming[2] = "
            "s2;\n            S->coming[3] = s3;\n        }\n";
    }
    text +=
        "        S->left = left - count;\n        share -= count;\n    }\n"
        "    if (phase != 3U) {\n        S->phase = phase + 1U;\n    } else {\n";
    for (int q = 0; q < 4; ++q) {  // a loop would become a call of memset
        text += fmt::format("        S->ready[{0}] = S->coming[{0}];\n        S->coming[{0}] = 0;\n", q);
    }
    text +=
        "        S->phase = 0U;\n        S->left = @NAME@_GROUPS;\n"
        "        S->own = S->own + 1U == @NAME@_GROUPS ? 0U : S->own + 1U;\n    }\n";
    return {.summary = "oldest first, one accumulator for each of four coming outputs" + rounded_once(fused),
            .sum = text,
            .closing = "    sum = @name@_start(newest) + sum;\n",
            .pushes = true,
            .fused = fused};
}

}  // namespace generate
