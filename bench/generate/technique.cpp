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

Words horner_words(bool fused) {
    return {{"Format::template horner_step<fused>", fused ? "@name@_fused_horner_step" : "@name@_horner_step"}};
}

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

// Of a known length GCC 12 counts the turns over an older piece, and unrolls four loads of half a word into more
// instructions than their loop has. Oldest first it makes up addresses for the ends of both pieces where the samples
// are known to lie.
TechniqueText worded_text(std::string_view word, std::string_view summary, const HistoryText& history, bool fused,
                          bool mixed) {
    const std::string name(word);
    Words words = of(fused);
    words["add("] = "@name@_add(&sum, &lost, ";
    const bool oldest_first = place_of(name + " older") < place_of(name + " newer");
    const Hidden hidden = history.two_pieces || mixed ? Hidden{oldest_first ? "samples" : "past"} : Hidden{};
    return {.summary = std::string(summary) + rounded_once(fused),
            .sum = window_of(history, hidden) + shared(name, words) + history.behind_start +
                   pieces(history, name, words, oldest_first),
            .closing = place_of(name + " closing") != std::string_view::npos ? shared(name + " closing", words) : "",
            .fused = fused};
}

TechniqueText stated_sum_text(std::string_view word, std::string_view summary, bool fused) {
    Words words = of(fused);
    words.insert({{", state.scale)", ")"},
                  {"state.past", "S->past"},
                  {"state.table", "@name@_table"},
                  {"state.", "S->"},
                  {"past", "@NAME@_PAST"}});
    const std::string name(word);
    return {.summary = std::string(summary) + rounded_once(fused),
            .sum = shared(name, words),
            .closing = shared(name + " settle", words),
            .pushes = true,
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
            sum += "    {\n" + shared("multi piece", of_piece, 8) +
                   (past < 4 ? "" : shared("multi groups", of_piece, 8)) + shared("multi rest", of_piece, 8) +
                   "    }\n";
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
    // Unrolled wholly, GCC 12 loads between fused products, each of which holds off the loads behind it. Of two pieces
    // with fewer than four it warns of samples that are not there.
    const Hidden hidden = past < 4 && history.two_pieces ? Hidden{"past", "samples", "table"}
                          : fused || in_software         ? Hidden{"past"}
                                                         : Hidden{};
    return {.summary = "newest first, four accumulators in turn" + rounded_once(fused),
            .sum = window_of(history, hidden) + shared("multi") + sum,
            .closing = shared("multi closing"),
            .fused = fused,
            .m7 = on_m7 ? m7 : ""};
}

TechniqueText horner_text(const HistoryText& history, bool fused, bool in_software) {
    return {.summary = "Horner form, oldest first, with the factors (j-1-v)/j" + rounded_once(fused),
            .sum = window_of(history, in_software ? Hidden{} : Hidden{"samples"}) + shared("horner") +
                   pieces(history, "horner", horner_words(fused), true),
            .closing = shared("horner closing", horner_words(fused)),
            .fused = fused};
}

TechniqueText horner_split_text(const HistoryText& history, std::size_t past, bool fused) {
    const bool on_m7 = past >= 40 && !fused;
    Words words = horner_words(fused);
    words.insert({{"samples", "newer"}, {"past", "newer_count"}, {"chains", "4U"}, {"dsp::", "@name@_"}});
    for (const std::string chain : {"0", "1", "2", "3"}) {
        words["table[" + chain + "] * t" + chain] = "@name@_product(table[" + chain + "], t" + chain + ")";
    }
    const std::string loop = shared("hornersplit loop", words);
    return {.summary = "Horner form in four chains, each of every fourth sample" + rounded_once(fused),
            .sum = window_of(history) + shared("hornersplit", words) +
                   (on_m7 ? or_on_m7(shared("hornersplit floats", words) +
                                         "    t0 = t[0];\n    t1 = t[1];\n    t2 = t[2];\n    t3 = t[3];\n",
                                     loop)
                          : loop),
            .closing = shared("hornersplit closing", words),
            .fused = fused,
            .m7 = on_m7 ? "horner_floats" : ""};
}

TechniqueText fir_text(bool fused, bool fixed) {
    // In fixed point the count is hidden, or GCC 12 would end the loop on the table's address and not on the samples'.
    Words words = of(fused);
    words.insert({{"samples", "S->past"}, {"table", "@name@_table"}});
    return {.summary = "newest first, storing each sample one place on in the same pass" + rounded_once(fused),
            .sum = std::string("    size_t past = @NAME@_PAST;\n") + (fixed ? "    @NAME@_KEEP_WORD(past);\n" : "") +
                   shared("fir", words),
            .pushes = true,
            .fused = fused};
}

TechniqueText paired_text(bool wide) {
    const Words words = {{"Sum", "@wide@"},
                         {"window.first_index", "head"},
                         {"window.newer", "(S->past + head)"},
                         {"table", "@name@_table"},
                         {"past", "@NAME@_PAST"},
                         {"middle * 2 * aligned_words(past)", "middle * @NAME@_ALIGNED"},
                         {"multiply_add(", "@name@_@word@("},
                         {"dsp::load_pair(coefficients + 2 * i)", "(int32_t)coefficients[i]"},
                         {"dsp::", "@name@_"}};
    const std::string loop = shared("paired words", words);
    return {.summary = std::string("two products an instruction, into ") + (wide ? "64" : "32") + " bits",
            .sum =
                "    /* Words are read from even samples: a window that begins in the middle of a word has a table of "
                "its own. */\n" +
                shared("paired", words) +
                (wide ? or_on_m7(shared("paired on a Cortex-M7", words) +
                                     "    head = S->head; /* again, for want of registers */\n",
                                 loop)
                      : loop),
            .pairs = true,
            .m7 = wide ? "dot_smlald" : ""};
}

TechniqueText scaled_text(std::size_t past, const std::vector<int>& shifts) {
    std::string text = "    size_t i = 0;\n" + shared("plain");
    int before = 0;
    for (std::size_t octave = 0; octave < shifts.size(); ++octave) {
        const std::size_t end = std::min((std::size_t{2} << octave) - 1, past);
        const Words words = {{"shift - before", std::to_string(shifts[octave] - before)},
                             {"end", fmt::format("{}U", end)},
                             {"table", "@name@_table"},
                             {"window.newer", "(S->past + head)"}};
        text += (shifts[octave] != before ? shared("scaled up", words) : "") + shared("scaled octave", words);
        before = shifts[octave];
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
    std::string text = shared("plain");
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

// In fixed point GCC 12 must not know that `past` lies behind other members: it would add their size in every turn. In
// software double it must not know how many turns there are.
TechniqueText nested_text(std::size_t near_samples, const glsum::Blocks& blocks, bool fixed, bool in_software) {
    const Words words = {{"state.head", "head"},
                         {"near_samples", "@NAME@_PAST"},
                         {"per_level", "@NAME@_PER_LEVEL"},
                         {"std::uint32_t", "size_t"},
                         {"std::min", "@name@_min"},
                         {"std::min<std::size_t>", "@name@_min"},
                         {"around(", "@name@_around("},
                         {"together<Format>", "@name@_together"},
                         {"accumulate<Format, fused>", accumulate(false)},
                         {"window.", ""}};
    Words in_window = words;
    in_window["size"] = "@NAME@_SAMPLES";
    in_window["near_samples"] = "near_samples";
    const auto kept = [](bool needed, const std::string& word) {
        return needed ? "    @NAME@_KEEP_WORD(" + word + ");\n" : "";
    };
    std::string text = "    @sample@ *past = S->past;\n" + kept(fixed, "past") +
                       (near_samples > 0 ? "    const @coefficient@ *table = @name@_table;\n" : "");
    text += near_samples > 0 ? "    size_t near_samples = @NAME@_PAST;\n" + kept(!fixed, "near_samples") : "";
    text += (near_samples > 0 ? shared("nested window", in_window) : "") + shared("plain", words) +
            (near_samples > 0 ? shared("plain newer", words) + shared("plain older", words) : "");
    if (blocks.count > 0) {
        text +=
            "    {\n        const @coefficient@ *weight = @name@_table + @NAME@_PAST;\n"
            "        size_t size = @NAME@_SAMPLES;\n" +
            kept(in_software, "size") + "        size_t left = @NAME@_BLOCKS;\n" + kept(in_software, "left") +
            shared("nested", words, 8) + (blocks.per_level > 1 ? shared("nested others", words, 12) : "") +
            shared("nested on", words, 12) + "    }\n";
    }
    return {
        .summary = "newest first, one accumulator; the taps, then the blocks",
        .sum = text,
        .helpers = {{"min", helper("size_t", "min", "size_t a, size_t b", "    return b < a ? b : a;\n")},
                    {"around", helper("size_t", "around", "size_t at, size_t far, size_t size", shared("around"))}}};
}

}  // namespace generate
