#include <fmt/format.h>

#include <algorithm>

#include "bench/generate/parts.hpp"
#include "bench/generate/shared.hpp"
#include "bench/generate/text.hpp"

namespace generate {
namespace {

// The samples x and coefficients a of a piece.
std::string pointers(const std::string& x, const std::string& a) {
    return "        const @sample@ *x = " + x + ";\n        const @coefficient@ *a = @name@_table" +
           (a.empty() ? "" : " + " + a) + ";\n";
}

// Over the pieces, from the newest sample on: the body takes *x and *a, which move on behind it.
std::string newest_first(const HistoryText& history, const std::string& body) {
    std::string text = "    const @coefficient@ *a = @name@_table;\n";
    for (const Piece& piece : history.pieces) {
        // Behind the first piece GCC 14 would make a from x at each turn, which takes two instructions more.
        const bool first = &piece == &history.pieces.front();
        text += (piece.unless_empty.empty() ? "    {\n" : "    if (" + piece.unless_empty + ") {\n") +
                "        const @sample@ *x = " + piece.begin + ";\n        const @sample@ *const end = " + piece.end +
                ";\n" + (first ? "" : "        @NAME@_KEEP_WORD(a);\n") + "@rolled@        do {\n" + body +
                "            ++a;\n            ++x;\n        } while (x != end);\n    }\n";
    }
    return text;
}

// From the oldest on: they move back before it. With the test last, GCC keeps a sum in software double in the wrong
// registers: four more instructions a tap.
std::string oldest_first(const HistoryText& history, const std::string& body, const char* further = "") {
    std::string text;
    for (auto piece = history.pieces.rbegin(); piece != history.pieces.rend(); ++piece) {
        text += "    {\n" + pointers(piece->end, piece->to + further) +
                "        const @sample@ *const begin = " + piece->begin + ";\n" +
                "@rolled@        while (x != begin) {\n            --a;\n            --x;\n" + body + "        }\n" +
                "    }\n";
    }
    return text;
}

// What a kernel's sum is given. The word that is named is hidden from the compiler.
std::string window_of(const HistoryText& history, const std::string& hidden) {
    return "    @sample@ *samples = S->past;\n    size_t past = @NAME@_PAST;\n" +
           (hidden.empty() ? "" : "    @NAME@_KEEP_WORD(" + hidden + ");\n") +
           "    const @coefficient@ *table = @name@_table;\n" + history.window;
}

Words of(bool fused) { return {{"accumulate<Format, fused>", accumulate(fused)}}; }

std::string nest(bool fused) { return fused ? "@name@_fused_nest" : "@name@_nest"; }
// `body`, but on a Cortex-M7 what gives the same by a loop of its own.
std::string or_on_m7(const std::string& on_m7, const std::string& body) {
    return "#if defined(@NAME@_M7)\n" + on_m7 + "#else\n" + body + "#endif\n";
}

std::string unrolled(int turns) {
    return fmt::format("#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 8\n#pragma GCC unroll {}\n#endif\n",
                       turns);
}

}  // namespace

TechniqueText plain_text(const HistoryText& history, bool fused, bool mixed) {
    // Of a known length GCC 12 counts the turns over an older piece, and unrolls four loads of half a word into more
    // instructions than their loop has.
    return {.summary = "newest first, one accumulator" + rounded_once(fused),
            .sum = window_of(history, history.two_pieces || mixed ? "past" : "") + shared("plain", of(fused)) +
                   history.behind_start + shared("plain newer", of(fused)) +
                   (history.two_pieces ? shared("plain older", of(fused)) : ""),
            .fused = fused};
}

TechniqueText oldest_text(const HistoryText& history, bool fused) {
    // Where the samples are known to lie GCC 12 makes up addresses of their own for the ends of both pieces.
    return {.summary = "oldest first, one accumulator" + rounded_once(fused),
            .sum = window_of(history, history.two_pieces ? "samples" : "") + shared("oldest") +
                   (history.two_pieces ? shared("oldest older", of(fused)) : "") + shared("oldest newer", of(fused)),
            .closing = shared("oldest closing"),
            .fused = fused};
}

namespace {

// One accumulator after the other. In software four in turn only cost: each of their additions returns to another place
// than the one before, and a core without a return stack guesses wrong each time. In memory the sum takes two
// instructions a tap, in registers that outlive calls four.
std::string one_by_one(const Piece& piece) {
    return "#if defined(@NAME@_SOFT_DOUBLE)\n    {\n        const @sample@ *const first = " + piece.begin +
           ";\n        double s[4];\n"
           "        for (i = 0; i < 4U; ++i) {\n"
           "            const @sample@ *x = first + i;\n"
           "            const @coefficient@ *a = @name@_table + i;\n"
           "            double part = 0;\n"
           "            __asm__(\"\" : \"+m\"(part));\n@rolled@"
           "            do {\n"
           "                const @sample@ sample = *x;\n"
           "                x += 4;\n"
           "                __asm__(\"\" : \"+r\"(x)); /* moved by the load */\n"
           "                part = @name@_multiply_add(part, *a, sample);\n"
           "                __asm__(\"\" : \"+m\"(part));\n"
           "                a += 4;\n            } while (a < @name@_table + @NAME@_PAST);\n"
           "            s[i] = part;\n        }\n"
           "        s0 = s[0];\n        s1 = s[1];\n        s2 = s[2];\n        s3 = s[3];\n    }\n#else\n";
}

}  // namespace

TechniqueText multi_text(const HistoryText& history, std::size_t past, bool fused, bool in_software,
                         const std::string& m7) {
    // A past of fewer than four has no groups: loops over them would only make compilers warn.
    const bool groups = past >= 4;
    const auto add = [&](int chain, int indent) {
        const std::string at = groups ? (chain == 0 ? "i" : fmt::format("i + {}U", chain)) : fmt::format("{}U", chain);
        return fmt::format("{3:{4}}s{0} = {1}(s{0}, a[{2}], x[{2}]);\n", chain, accumulate(fused), at, "", indent);
    };
    std::string body = "        const size_t rest = count % 4U;\n";
    if (groups) {
        // Unrolled wholly, GCC 12 loads between fused products, each of which holds off the loads behind it.
        body += (fused ? unrolled(1) : "@rolled@") + "        for (i = 0; i != count - rest; i += 4U) {\n";
        for (int chain = 0; chain < 4; ++chain) {
            body += add(chain, 12);
        }
        body += "        }\n";
    }
    std::string closing;
    for (int chain = 0; chain < 3 && static_cast<std::size_t>(chain) < past; ++chain) {
        body += fmt::format("{:{}}if (rest > {}U) {{\n", "", 8 + 4 * chain, chain) + add(chain, 12 + 4 * chain);
        closing = fmt::format("{:{}}}}\n", "", 8 + 4 * chain) + closing;
    }
    body += closing;
    std::string pieces;
    for (const Piece& piece : history.pieces) {
        pieces += "    {\n" + pointers(piece.begin, piece.from) + "        const size_t count = (size_t)(" + piece.end +
                  " - x);\n" + body + "    }\n";
    }
    std::string sum = in_software && past >= 16 ? one_by_one(history.pieces.front()) + pieces + "#endif\n" : pieces;
    const bool on_m7 = !m7.empty() && past >= 16;  // a shorter loop over a constant costs less than to enter the other
    if (on_m7) {
        const bool floats = m7 == "dot_floats";
        std::string own = groups ? "    (void)i;\n" : "";
        own += floats ? "    {\n        float s[4] = {0.0F, 0.0F, 0.0F, 0.0F};\n" : "";
        for (const Piece& piece : history.pieces) {
            own += (floats ? "        @name@_" + m7 + "(s, " : "    s0 = @name@_" + m7 + "_onto(s0, ") +
                   "@name@_table" + (piece.from.empty() ? "" : " + " + piece.from) + ", " + piece.begin +
                   ", (size_t)(" + piece.end + " - (" + piece.begin + ")));\n";
        }
        own += floats ? "        s0 = s[0];\n        s1 = s[1];\n        s2 = s[2];\n        s3 = s[3];\n    }\n" : "";
        sum = or_on_m7(own, sum);
    }
    return {.summary = "newest first, four accumulators in turn" + rounded_once(fused),
            .sum =
                "    @accumulator@ sum;\n    @accumulator@ s0 = 0;\n"
                "    @accumulator@ s1 = 0;\n    @accumulator@ s2 = 0;\n    @accumulator@ s3 = 0;\n" +
                sum,
            .closing = "    sum = @name@_start(newest) + ((s0 + s1) + (s2 + s3));\n",
            .fused = fused,
            .m7 = on_m7 ? m7 : ""};
}

TechniqueText compensated_text(const HistoryText& history) {
    return {.summary = "newest first, with the sum of what the additions lost",
            .sum =
                "    @accumulator@ sum = @name@_start(newest);\n"
                "    @accumulator@ lost = 0;\n" +
                newest_first(history,
                             "            const @accumulator@ term = @name@_multiply(*a, *x);\n"
                             "            const @accumulator@ next = sum + term;\n"
                             "            const @accumulator@ term_part = next - sum;\n"
                             "            lost += (sum - (next - term_part)) + (term - term_part);\n"
                             "            sum = next;\n"),
            .closing = "    sum = sum + lost;\n"};
}

TechniqueText horner_text(const HistoryText& history, bool fused) {
    return {.summary = "nested, oldest first, with the factors (j-1-v)/j" + rounded_once(fused),
            .sum = "    @accumulator@ sum = 0;\n" +
                   oldest_first(history, "            sum = " + nest(fused) + "(*x, *a, sum);\n", " + 1U"),
            .closing = "    sum = " + nest(fused) + "(newest, @name@_table[0], sum);\n",
            .fused = fused};
}

TechniqueText horner_split_text(const HistoryText& history, std::size_t past, bool fused) {
    const bool on_m7 = past >= 40 && !fused;
    std::string chains;
    for (int chain = 0; chain < 4; ++chain) {
        chains += fmt::format("        t{0} = {1}(x[i + {0}U], a[i + {2}U], t{0});\n", chain, nest(fused), chain + 4);
    }
    const std::string loop = "    while (i > 0U) {\n        i -= 4U;\n" + chains + "    }\n";
    return {
        .summary = "nested in four chains, each of every fourth sample" + rounded_once(fused),
        .sum = "    const @sample@ *x = " + history.pieces.front().begin +
               ";\n"
               "    const @coefficient@ *a = @name@_table;\n"
               "    /* The oldest samples, fewer than a group, open their chains. */\n"
               "    @accumulator@ t0 = @NAME@_PAST % 4U > 0U ? x[@NAME@_PAST - @NAME@_PAST % 4U] : (@accumulator@)0;\n"
               "    @accumulator@ t1 = @NAME@_PAST % 4U > 1U ? x[@NAME@_PAST - @NAME@_PAST % 4U + 1U] : "
               "(@accumulator@)0;\n"
               "    @accumulator@ t2 = @NAME@_PAST % 4U > 2U ? x[@NAME@_PAST - @NAME@_PAST % 4U + 2U] : "
               "(@accumulator@)0;\n"
               "    @accumulator@ t3 = 0;\n"
               "    @accumulator@ sum;\n"
               "    i = @NAME@_PAST - @NAME@_PAST % 4U;\n" +
               (on_m7 ? or_on_m7(
                            "    {\n        float t[4] = {0.0F, 0.0F, 0.0F, 0.0F};\n        t[0] = t0;\n        t[1] = "
                            "t1;\n        t[2] = t2;\n        @name@_nest_floats(t, a, x, i / 4U);\n        t0 = "
                            "t[0];\n        t1 = t[1];\n        t2 = t[2];\n        t3 = t[3];\n    }\n",
                            loop)
                      : loop),
        .closing =
            "    sum = @name@_start(newest) + ((@name@_product(a[0], t0) + @name@_product(a[1], t1)) +\n"
            "                                  (@name@_product(a[2], t2) + @name@_product(a[3], t3)));\n",
        .fused = fused,
        .m7 = on_m7 ? "nest_floats" : ""};
}

// In what order GCC 12 loads and stores decides what a tap takes on a Cortex-M7. In floating point the coefficient is
// loaded before the store. In fixed point the count is hidden, or the loop would end on the table's address and not on
// the samples': in Q15 six cycles a tap and not five.
TechniqueText fir_text(bool fused, bool fixed) {
    const std::string open = "    @moved@ moving = newest;\n";
    const std::string product = accumulate(fused);
    std::string loop;
    if (fixed) {
        loop = "    size_t past = @NAME@_PAST;\n" + open +
               "    @NAME@_KEEP(past);\n"
               "    for (i = 0; i < past; ++i) {\n"
               "        const @moved@ kept = S->past[i];\n"
               "        sum = " +
               product +
               "(sum, @name@_table[i], (@sample@)kept);\n"
               "        S->past[i] = (@sample@)moving;\n";
    } else {
        loop = open +
               "    for (i = 0; i < @NAME@_PAST; ++i) {\n"
               "        @moved@ kept = S->past[i];\n"
               "        const @coefficient@ a = @name@_table[i];\n"
               "        @NAME@_KEEP(moving);\n"
               "        S->past[i] = moving;\n"
               "        sum = " +
               product + "(sum, a, kept);\n";
    }
    return {.summary = "newest first, storing each sample one place on in the same pass" + rounded_once(fused),
            .sum = "    @accumulator@ sum = @name@_start(newest);\n" + loop + "        moving = kept;\n    }\n",
            .pushes = true,
            .fused = fused};
}

TechniqueText paired_text(bool wide) {
    const std::string word = wide ? "smlald" : "smlad";
    const std::string loop = "    for (i = 0; i < words; ++i) {\n        sum = @name@_" + word +
                             "(a[i], @name@_load_pair(x + 2U * i), sum);\n    }\n";
    return {.summary = std::string("two products an instruction, into ") + (wide ? "64" : "32") + " bits",
            .sum =
                "    /* Words are read from even samples: a window that begins in the middle of a word has a table of "
                "its own. */\n"
                "    const size_t middle = head & 1U; /* every other time, so no branch */\n"
                "    const @coefficient@ *a = @name@_table + middle * @NAME@_ALIGNED;\n"
                "    const @sample@ *x = S->past + (head - middle);\n"
                "    const size_t words = @NAME@_ALIGNED + middle * (@NAME@_SHIFTED - @NAME@_ALIGNED);\n" +
                std::string(wide ? "    int64_t sum = @name@_start(newest);\n"
                                 : "    int32_t sum = (int32_t)@name@_start(newest);\n") +
                (wide ? or_on_m7("    (void)i;\n    sum = @name@_dot_smlald_onto(sum, a, x, words);\n"
                                 "    head = S->head; /* again, for want of registers */\n",
                                 loop)
                      : loop),
            .pairs = true,
            .m7 = wide ? "dot_smlald" : ""};
}

TechniqueText scaled_text(std::size_t past, const std::vector<int>& shifts) {
    std::string text = "    const @sample@ *x = S->past + head;\n    @accumulator@ sum = @name@_start(newest);\n";
    int before = 0;
    for (std::size_t octave = 0; octave < shifts.size(); ++octave) {
        const std::size_t from = (std::size_t{1} << octave) - 1;
        const std::size_t to = std::min((std::size_t{2} << octave) - 1, past);
        if (shifts[octave] != before) {
            text += fmt::format("    sum *= (int64_t)1 << {};\n", shifts[octave] - before);
        }
        before = shifts[octave];
        text += to - from == 1 ? fmt::format("    sum = @name@_multiply_add(sum, @name@_table[{0}], x[{0}]);\n", from)
                               : fmt::format(
                                     "    for (i = {}U; i < {}U; ++i) {{\n"
                                     "        sum = @name@_multiply_add(sum, @name@_table[i], x[i]);\n    }}\n",
                                     from, to);
    }
    return {.summary = "newest first, the table in octaves, each scaled up by its own power of two", .sum = text};
}

namespace {

// A step of `count` modes side by side, as the kernel orders it: all are moved on before any is stored, so that the
// core finds something to do between the additions of one.
std::string modes_at_once(int count, bool compensated) {
    const int words = compensated ? 2 : 1;
    std::string text;
    std::string sums;
    std::string stores;
    for (int m = 0; m < count; ++m) {
        text += fmt::format("            const @sample@ before{0} = average[{1}];\n", m, words * m);
        sums += fmt::format("            sum = @name@_multiply_add(sum, mode[{1}], before{0});\n", m, 2 * m + 1);
        stores += fmt::format("            average[{1}] = after{0};\n", m, words * m);
        if (compensated) {
            stores += fmt::format("            average[{1}] = step{0} - (after{0} - before{0});\n", m, words * m + 1);
        }
    }
    for (int m = 0; m < count; ++m) {
        text +=
            fmt::format("            const @sample@ step{0} = @name@_multiply(mode[{1}], leaving - before{0}){2};\n", m,
                        2 * m, compensated ? fmt::format(" + average[{}]", words * m + 1) : "");
        text += fmt::format("            const @sample@ after{0} = before{0} + step{0};\n", m);
    }
    return text + sums + stores;
}

// In software nothing can be done meanwhile: one at a time.
std::string floating_modes(std::size_t modes, bool compensated, bool in_software) {
    const auto on = [&](int count) {
        return fmt::format("            mode += {};\n            average += {};\n", 2 * count,
                           (compensated ? 2 : 1) * count);
    };
    std::string text;
    if (in_software) {
        return "@rolled@        for (i = @NAME@_MODES; i > 0U; --i) {\n" + modes_at_once(1, compensated) + on(1) +
               "        }\n";
    }
    if (modes % 2 != 0) {
        text += "        {\n" + modes_at_once(1, compensated) + (modes > 1 ? on(1) : "") + "        }\n";
    }
    if (modes > 1) {
        // Whole, as long as that is short; of many each turn saves less than its instructions cost to fetch.
        text += unrolled(modes < 18    ? 8
                         : compensated ? 10
                                       : 2) +
                "        for (i = @NAME@_MODES / 2U; i > 0U; --i) {\n" + modes_at_once(2, compensated) + on(2) +
                "        }\n";
    }
    return text;
}

}  // namespace

// kernels/glsum/exponentials/modes.hpp.
TechniqueText modes_text(std::size_t near_samples, std::size_t modes, bool compensated, bool fixed, bool in_software) {
    const char* const fixed_step =
        "            const int64_t step = (int64_t)mode[0] * leaving - (int64_t)mode[0] * before;\n"
        "            const int32_t shift = mode[1];\n"
        "            average[0] = (int32_t)(before + ((step + ((int64_t)1 << (shift - 1))) >> shift));\n";
    std::string text = "    @accumulator@ sum = @name@_start(newest);\n";
    if (near_samples > 0) {
        text +=
            "@rolled@    for (i = 0U; i < @NAME@_PAST; ++i) {\n"
            "        sum = @name@_multiply_add(sum, @name@_table[i], S->past[i]);\n    }\n";
    }
    if (modes > 0) {
        text += fmt::format(
            "    {{\n        const @sample@ leaving = {};\n"
            "        const @coefficient@ *mode = @name@_table + @NAME@_PAST;\n"
            "        @sample@ *average = S->past + @NAME@_PAST;\n",
            near_samples > 0 ? "S->past[@NAME@_PAST - 1U]" : "newest");
        text += fixed ? std::string(
                            "        for (i = @NAME@_MODES; i > 0U; --i) {\n"
                            "            const @sample@ before = average[0];\n") +
                            fixed_step +
                            "            sum = @name@_multiply_add(sum, mode[2], before);\n"
                            "            mode += 3;\n            average += 1;\n        }\n"
                      : floating_modes(modes, compensated, in_software);
        text += "    }\n";
    }
    if (near_samples > 1) {
        text += R"(    for (i = @NAME@_PAST - 1U; i > 0U; --i) {
        @moved@ moved = S->past[i - 1U];
        @NAME@_KEEP_WORD(moved);
        S->past[i] = (@sample@)moved;
    }
)";
    }
    text += near_samples > 0 ? "    S->past[0] = newest;\n" : "";
    return {.summary = std::string("newest first, one accumulator; the taps, then the modes, the fastest first") +
                       (compensated ? ", each with what its last step lost" : ""),
            .sum = text,
            .pushes = true};
}

// kernels/glsum/logmemory/nested.hpp. In fixed point GCC 12 must not know that `past` lies behind other members: it
// would add their size in every turn. In software double it must not know how many turns there are.
TechniqueText nested_text(std::size_t near_samples, const glsum::Blocks& blocks, bool fixed, bool in_software) {
    std::string text = "    @accumulator@ sum = @name@_start(newest);\n";
    if (near_samples > 0) {
        text +=
            "    {\n        const size_t newer = @NAME@_SAMPLES - head < @NAME@_PAST ? @NAME@_SAMPLES - head : "
            "@NAME@_PAST;\n"
            "        const @coefficient@ *a = @name@_table;\n"
            "        const @sample@ *x = S->past + head;\n"
            "@rolled@        for (i = newer; i > 0U; --i) {\n"
            "            sum = @name@_multiply_add(sum, *a++, *x++);\n        }\n"
            "        x = S->past;\n"
            "@rolled@        for (i = @NAME@_PAST - newer; i > 0U; --i) {\n"
            "            sum = @name@_multiply_add(sum, *a++, *x++);\n        }\n    }\n";
    }
    const std::string size = in_software ? "size" : "@NAME@_SAMPLES";
    const auto on = [&](const std::string& by, int indent) {
        return fmt::format("{0:{1}}at += {2};\n{0:{1}}at = at >= {3} ? at - {3} : at;\n", "", indent, by, size);
    };
    if (blocks.count > 0) {
        const std::string others =
            blocks.per_level == 1
                ? ""
                : (in_software ? "@rolled@" : unrolled(8)) +
                      "            for (i = (left < @NAME@_PER_LEVEL ? left : @NAME@_PER_LEVEL) - 1U; i > 0U; --i) "
                      "{\n" +
                      on("width", 16) +
                      "                sum = @name@_multiply_add(sum, *weight++, past[at]);\n            }\n";
        const std::string hidden = in_software ? "        size_t size = @NAME@_SAMPLES;\n        "
                                                 "@NAME@_KEEP_WORD(size);\n        @NAME@_KEEP_WORD(left);\n"
                                               : "";
        text +=
            "    {\n        const @coefficient@ *weight = @name@_table + @NAME@_PAST;\n"
            "        size_t at = head;\n        size_t width = 1U;\n"
            "        size_t left = @NAME@_BLOCKS;\n        @sample@ *past = S->past;\n" +
            std::string(fixed ? "        @NAME@_KEEP_WORD(past);\n" : "") + hidden +
            (near_samples > 0 ? on("@NAME@_PAST", 8) : "") +
            "        for (;;) {\n            const @sample@ younger = past[at];\n"
            "            @sample@ block;\n" +
            on("width", 12) + "            block = past[at];\n" +
            (fixed ? "            block = (younger | block) - ((younger ^ block) >> 1);\n"
                   : "            block = younger + block;\n") +
            "            past[at] = block;\n"
            "            sum = @name@_multiply_add(sum, *weight++, block);\n            width *= 2U;\n" +
            others +
            "            if (left <= @NAME@_PER_LEVEL) {\n                break;\n            }\n"
            "            left -= @NAME@_PER_LEVEL;\n" +
            on("width", 12) + "        }\n    }\n";
    }
    return {.summary = "newest first, one accumulator; the taps, then the blocks", .sum = text};
}

}  // namespace generate
