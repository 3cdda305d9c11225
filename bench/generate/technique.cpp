#include <fmt/format.h>

#include <algorithm>

#include "bench/generate/parts.hpp"
#include "bench/generate/shared.hpp"
#include "bench/generate/text.hpp"

namespace generate {
namespace {

using Hidden = std::vector<std::string>;

// What a kernel's sum is given. The words that are named are hidden from the compiler.
std::string window_of(const HistoryText& history, const Hidden& hidden = {}) {
    const auto declared = [&](const std::string& declaration, const std::string& word) {
        const bool hides = std::find(hidden.begin(), hidden.end(), word) != hidden.end();
        return "    " + declaration + ";\n" + (hides ? "    @NAME@_KEEP_WORD(" + word + ");\n" : "");
    };
    return declared("@sample@ *samples = S->past", "samples") + declared("size_t past = @NAME@_PAST", "past") +
           declared("const @coefficient@ *table = @name@_table", "table") + history.window;
}

Words of(bool fused) { return {{"accumulate<Format, fused>", accumulate(fused)}}; }

Words nest(bool fused) { return {{"Format::template nest<fused>", fused ? "@name@_fused_nest" : "@name@_nest"}}; }

// Texts of the kernel's that end with "newer" and "older", in the order in which it has them.
std::string pieces(const HistoryText& history, const std::string& name, const Words& words, bool oldest_first = false) {
    const std::string newer = shared(name + " newer", words);
    const std::string older = history.two_pieces ? shared(name + " older", words) : "";
    return oldest_first ? older + newer : newer + older;
}

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
            .sum = window_of(history, history.two_pieces || mixed ? Hidden{"past"} : Hidden{}) +
                   shared("plain", of(fused)) + history.behind_start + pieces(history, "plain", of(fused)),
            .fused = fused};
}

TechniqueText oldest_text(const HistoryText& history, bool fused) {
    // Where the samples are known to lie GCC 12 makes up addresses of their own for the ends of both pieces.
    return {.summary = "oldest first, one accumulator" + rounded_once(fused),
            .sum = window_of(history, history.two_pieces ? Hidden{"samples"} : Hidden{}) + shared("oldest") +
                   pieces(history, "oldest", of(fused), true),
            .closing = shared("oldest closing"),
            .fused = fused};
}

TechniqueText multi_text(const HistoryText& history, std::size_t past, bool fused, bool in_software,
                         const std::string& m7) {
    const Words words = of(fused);
    std::string sum;
    for (const std::string piece : {"newer", "older"}) {
        if (piece == "newer" || history.two_pieces) {
            Words of_piece = words;
            of_piece.insert({{"samples", piece}, {"count", piece + "_count"}, {"chains", "4U"}});
            sum += "    {\n" + shared("multi piece", of_piece, 8) + "    }\n";
        }
    }
    const bool on_m7 = !m7.empty() && past >= 16;  // a shorter loop over a constant costs less than to enter the other
    if (on_m7) {
        const bool floats = m7 == "dot_floats";
        const Words own = {{"sum", "s0"}, {"dsp::", "@name@_"}, {"chains", "4U"}};
        sum = or_on_m7(pieces(history, floats ? "multi floats" : "multi words", own) +
                           (floats ? "    s0 = s[0];\n    s1 = s[1];\n    s2 = s[2];\n    s3 = s[3];\n" : ""),
                       sum);
    }
    // Unrolled wholly, GCC 12 loads between fused products, each of which holds off the loads behind it. Of fewer than
    // four it warns of groups that are not there.
    const Hidden hidden = past < 4               ? Hidden{"past", "samples", "table"}
                          : fused || in_software ? Hidden{"past"}
                                                 : Hidden{};
    return {.summary = "newest first, four accumulators in turn" + rounded_once(fused),
            .sum = window_of(history, hidden) + shared("multi") + sum,
            .closing = shared("multi closing"),
            .fused = fused,
            .m7 = on_m7 ? m7 : ""};
}

TechniqueText compensated_text(const HistoryText& history) {
    return {.summary = "newest first, with the sum of what the additions lost",
            .sum = window_of(history, history.two_pieces ? Hidden{"past"} : Hidden{}) + shared("compensated") +
                   pieces(history, "compensated", {{"add(", "@name@_add(&sum, &lost, "}}),
            .closing = shared("compensated closing")};
}

TechniqueText horner_text(const HistoryText& history, bool fused, bool in_software) {
    return {.summary = "nested, oldest first, with the factors (j-1-v)/j" + rounded_once(fused),
            .sum = window_of(history, in_software ? Hidden{} : Hidden{"samples"}) + shared("horner") +
                   pieces(history, "horner", nest(fused), true),
            .closing = shared("horner closing", nest(fused)),
            .fused = fused};
}

TechniqueText horner_split_text(const HistoryText& history, std::size_t past, bool fused) {
    const bool on_m7 = past >= 40 && !fused;
    Words words = nest(fused);
    words.insert({{"samples", "newer"}, {"past", "newer_count"}, {"chains", "4U"}, {"dsp::", "@name@_"}});
    for (const std::string chain : {"0", "1", "2", "3"}) {
        words["table[" + chain + "] * t" + chain] = "@name@_product(table[" + chain + "], t" + chain + ")";
    }
    const std::string loop = shared("hornersplit loop", words);
    return {.summary = "nested in four chains, each of every fourth sample" + rounded_once(fused),
            .sum = window_of(history) + shared("hornersplit", words) +
                   (on_m7 ? or_on_m7(shared("hornersplit floats", words) +
                                         "    t0 = t[0];\n    t1 = t[1];\n    t2 = t[2];\n    t3 = t[3];\n",
                                     loop)
                          : loop),
            .closing = shared("hornersplit closing", words),
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

// kernels/glsum/exponentials/modes_body.hpp.
TechniqueText modes_text(std::size_t near_samples, std::size_t modes, bool compensated, bool fixed, bool in_software) {
    const Words words = {{"move(", "@name@_move("},
                         {"keep(", "@name@_keep("},
                         {"Averaged", "@name@_averaged"},
                         {"compensated", compensated ? "1" : "0"},
                         {"coefficients_of_mode", fixed ? "3" : "2"},
                         {"words_of_mode", compensated ? "2" : "1"}};
    std::string text = "    @accumulator@ sum = @name@_start(newest);\n";
    if (near_samples > 0) {
        text += shared("plain newer", {{"table", "@name@_table"},
                                       {"newer", "S->past"},
                                       {"newer_count", "@NAME@_PAST"},
                                       {"accumulate<Format, fused>", accumulate(false)}});
    }
    if (modes > 0) {
        const std::string leaving = near_samples > 0 ? "S->past[@NAME@_PAST - 1U]" : "newest";
        const std::string one = "        {\n" + shared("mode one", words, 12) + "        }\n";
        text += "    {\n        const @sample@ leaving = " + leaving +
                ";\n        const @coefficient@ *table = @name@_table + @NAME@_PAST;\n"
                "        @sample@ *average = S->past + @NAME@_PAST;\n";
        if (fixed || in_software) {  // one at a time: nothing can be done meanwhile
            text += "@rolled@        for (i = @NAME@_MODES; i > 0U; --i)" + one.substr(7);
        } else {
            text += modes % 2 != 0 ? one : "";
            // Whole, as long as that is short; of many each turn saves less than its instructions cost to fetch.
            text += modes == 1 ? ""
                               : unrolled(modes < 18    ? 8
                                          : compensated ? 10
                                                        : 2) +
                                     "        for (i = @NAME@_MODES / 2U; i > 0U; --i) {\n" +
                                     shared("mode two", words, 12) + "        }\n";
        }
        text += "    }\n";
    }
    text += near_samples > 0
                ? shared("shift push", {{"samples", "S->past"}, {"past", "@NAME@_PAST"}, {"T", "@sample@"}})
                : "";
    const std::string averaged = "typedef struct {\n    @sample@ average;\n    @sample@ lost;\n} @name@_averaged;\n";
    return {.summary = std::string("newest first, one accumulator; the taps, then the modes, the fastest first") +
                       (compensated ? ", each with what its last step lost" : ""),
            .sum = text,
            .pushes = true,
            .helpers = {{"move", averaged + helper("@name@_averaged", "move",
                                                   "const @coefficient@ *of_mode, const @sample@ *average, "
                                                   "@sample@ leaving",
                                                   shared("mode", words) + shared(fixed         ? "mode fixed"
                                                                                  : compensated ? "mode compensated"
                                                                                                : "mode plain",
                                                                                  words))},
                        {"keep", helper("void", "keep", "@sample@ *average, @name@_averaged moved",
                                        shared("mode kept", words))}}};
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
