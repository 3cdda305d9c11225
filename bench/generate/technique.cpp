#include <fmt/format.h>

#include "bench/generate/parts.hpp"

namespace generate {
namespace {

// A block over one piece: the samples x, their coefficients a, their count.
std::string over(const Piece& piece, const std::string& body) {
    return "    {\n"
           "        const @sample@ *x = " +
           piece.samples +
           ";\n"
           "        const @coefficient@ *a = @name@_table" +
           (piece.offset == "0U" ? "" : " + (" + piece.offset + ")") +
           ";\n"
           "        const size_t count = " +
           piece.count + ";\n" + body + "    }\n";
}

std::string newest_first(const HistoryText& history, const std::string& body) {
    std::string text;
    for (const Piece& piece : history.pieces) {
        text += over(piece, body);
    }
    return text;
}

std::string oldest_first(const HistoryText& history, const std::string& body) {
    std::string text;
    for (auto piece = history.pieces.rbegin(); piece != history.pieces.rend(); ++piece) {
        text += over(*piece, body);
    }
    return text;
}

std::string accumulate(bool fused) { return fused ? "@name@_fused_multiply_add" : "@name@_multiply_add"; }
std::string nest(bool fused) { return fused ? "@name@_fused_nest" : "@name@_nest"; }
std::string rounded_once(bool fused) { return fused ? ", product and addition rounded once" : ""; }

}  // namespace

TechniqueText plain_text(const HistoryText& history, bool fused) {
    return {.summary = "newest first, one accumulator" + rounded_once(fused),
            .sum = "    @accumulator@ sum = @name@_start(newest);\n" +
                   newest_first(history,
                                "        for (i = 0; i < count; ++i) {\n"
                                "            sum = " +
                                    accumulate(fused) +
                                    "(sum, a[i], x[i]);\n"
                                    "        }\n"),
            .fused = fused};
}

TechniqueText oldest_text(const HistoryText& history, bool fused) {
    return {.summary = "oldest first, one accumulator" + rounded_once(fused),
            .sum = "    @accumulator@ sum = 0;\n" +
                   oldest_first(history,
                                "        for (i = count; i > 0U; --i) {\n"
                                "            sum = " +
                                    accumulate(fused) +
                                    "(sum, a[i - 1U], x[i - 1U]);\n"
                                    "        }\n") +
                   "    sum = @name@_start(newest) + sum;\n",
            .fused = fused};
}

TechniqueText multi_text(const HistoryText& history, bool fused) {
    std::string body = "        for (i = 0; i + 4U <= count; i += 4U) {\n";
    for (int chain = 0; chain < 4; ++chain) {
        body += fmt::format("            s{0} = {1}(s{0}, a[i + {0}U], x[i + {0}U]);\n", chain, accumulate(fused));
    }
    body += "        }\n";
    for (int chain = 0; chain < 3; ++chain) {
        body += fmt::format(
            "        if (i + {0}U < count) {{\n            s{0} = {1}(s{0}, a[i + {0}U], x[i + {0}U]);\n        }}\n",
            chain, accumulate(fused));
    }
    return {
        .summary = "newest first, four accumulators in turn" + rounded_once(fused),
        .sum =
            "    @accumulator@ sum;\n    @accumulator@ s0 = 0;\n    @accumulator@ s1 = 0;\n    @accumulator@ s2 = 0;\n"
            "    @accumulator@ s3 = 0;\n" +
            newest_first(history, body) + "    sum = @name@_start(newest) + ((s0 + s1) + (s2 + s3));\n",
        .fused = fused};
}

TechniqueText compensated_text(const HistoryText& history) {
    return {.summary = "newest first, with the sum of what the additions lost",
            .sum = "    @accumulator@ sum = @name@_start(newest);\n    @accumulator@ lost = 0;\n" +
                   newest_first(history,
                                "        for (i = 0; i < count; ++i) {\n"
                                "            const @accumulator@ term = @name@_multiply(a[i], x[i]);\n"
                                "            const @accumulator@ next = sum + term;\n"
                                "            const @accumulator@ term_part = next - sum;\n"
                                "            lost += (sum - (next - term_part)) + (term - term_part);\n"
                                "            sum = next;\n"
                                "        }\n") +
                   "    sum = sum + lost;\n"};
}

TechniqueText horner_text(const HistoryText& history, bool fused) {
    return {.summary = "nested, oldest first, with the factors (j-1-v)/j" + rounded_once(fused),
            .sum = "    @accumulator@ sum = 0;\n" +
                   oldest_first(history,
                                "        for (i = count; i > 0U; --i) {\n"
                                "            sum = " +
                                    nest(fused) +
                                    "(x[i - 1U], a[i], sum);\n"
                                    "        }\n") +
                   "    sum = " + nest(fused) + "(newest, @name@_table[0], sum);\n",
            .fused = fused};
}

TechniqueText horner_split_text(const HistoryText& history, bool fused) {
    std::string chains;
    for (int chain = 0; chain < 4; ++chain) {
        chains += fmt::format("        t{0} = {1}(x[i + {0}U], a[i + {2}U], t{0});\n", chain, nest(fused), chain + 4);
    }
    return {
        .summary = "nested in four chains, each of every fourth sample" + rounded_once(fused),
        .sum = "    const @sample@ *x = " + history.pieces.front().samples +
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
               "    i = @NAME@_PAST - @NAME@_PAST % 4U;\n"
               "    while (i > 0U) {\n        i -= 4U;\n" +
               chains +
               "    }\n"
               "    sum = @name@_start(newest) + ((@name@_product(a[0], t0) + @name@_product(a[1], t1)) +\n"
               "                                  (@name@_product(a[2], t2) + @name@_product(a[3], t3)));\n",
        .fused = fused};
}

TechniqueText fir_text(bool fused) {
    return {.summary = "newest first, storing each sample one place on in the same pass" + rounded_once(fused),
            .sum =
                "    @accumulator@ sum = @name@_start(newest);\n"
                "    @moved@ moving = newest;\n"
                "    for (i = 0; i < @NAME@_PAST; ++i) {\n"
                "        @moved@ kept = S->past[i];\n"
                "        sum = " +
                accumulate(fused) +
                "(sum, @name@_table[i], (@sample@)kept);\n"
                "        @NAME@_KEEP(moving);\n"
                "        S->past[i] = (@sample@)moving;\n"
                "        moving = kept;\n"
                "    }\n",
            .pushes = true,
            .fused = fused};
}

TechniqueText paired_text(bool wide) {
    const std::string word = wide ? "smlald" : "smlad";
    return {.summary = std::string("two products an instruction, into ") + (wide ? "64" : "32") + " bits",
            .sum =
                "    /* Words are read from even samples: a window that begins in the middle of a word has a table of "
                "its own. */\n"
                "    const int middle = (head & 1U) != 0U;\n"
                "    const @coefficient@ *a = middle ? @name@_table + @NAME@_ALIGNED : @name@_table;\n"
                "    const @sample@ *x = S->past + head - (middle ? 1 : 0);\n"
                "    const size_t words = middle ? @NAME@_SHIFTED : @NAME@_ALIGNED;\n" +
                std::string(wide ? "    int64_t sum = @name@_start(newest);\n"
                                 : "    int32_t sum = (int32_t)@name@_start(newest);\n") +
                "    for (i = 0; i < words; ++i) {\n"
                "        sum = @name@_" +
                word +
                "(a[i], @name@_load_pair(x + 2U * i), sum);\n"
                "    }\n",
            .pairs = true};
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

}  // namespace generate
