#include "bench/generate/parts.hpp"
#include "bench/generate/shared.hpp"

namespace generate {
namespace {

const char* const clear = R"(    for (i = 0; i < @NAME@_SAMPLES; ++i) {
        S->past[i] = 0;
    }
)";
const char* const next_head = R"(    head = (head == 0U ? @NAME@_PAST : head) - 1U;
    @NAME@_KEEP_WORD(head);
)";

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
        text.replace(at, what.size(), with);
    }
    return text;
}

const Words in_window = {{"T", "@sample@"}};
const Words in_push = {
    {"samples", "S->past"}, {"past", "@NAME@_PAST"}, {"T", "@sample@"}, {"next_head", "@name@_next_head"}};

}  // namespace

HistoryText history_text(glsum::Shift) {
    return {.summary = "every sample moves one place on at each step",
            .fields = "    @sample@ past[@NAME@_SAMPLES]; /* x_(k-1), x_(k-2), ... */\n",
            .reset = clear,
            .window = shared("shift window", in_window),
            .push = shared("shift push", in_push)};
}

HistoryText history_text(glsum::Ring) {
    return {.summary = "samples stay in place, the head moves down and wraps",
            .fields =
                "    uint32_t head; /* where x_(k-1) lies; x_(k-2) behind it */\n"
                "    @sample@ past[@NAME@_SAMPLES];\n",
            .reset = std::string("    S->head = 0U;\n") + clear,
            .window = shared("ring window", in_window),
            .two_pieces = true,
            .push = shared("ring push", in_push) + "    S->head = head;\n"};
}

HistoryText history_text(glsum::Mirror) {
    return {.summary = "a ring kept twice, so that the past is one piece",
            .fields =
                "    uint32_t head; /* where x_(k-1) lies; x_(k-2) behind it */\n"
                "    @sample@ past[@NAME@_SAMPLES]; /* twice the same */\n",
            .reset = std::string("    S->head = 0U;\n") + clear,
            .window = shared("mirror window", in_window),
            .push = shared("mirror push", in_push) + "    S->head = head;\n"};
}

HistoryText history_text(glsum::Modes) {
    return {.summary = "the newest samples as they are, all older ones as decaying averages",
            .fields = "    @sample@ past[@NAME@_SAMPLES]; /* x_(k-1), x_(k-2), ...; then of each mode its state */\n",
            .reset = clear};
}

// kernels/glsum/lookahead/block.hpp.
HistoryText history_text(glsum::Block) {
    return {.summary = "in groups of four as they come; summed for the next four outputs at once",
            .fields =
                "    size_t phase; /* samples of the newest group that are there */\n"
                "    size_t own; /* where it lies */\n"
                "    size_t left; /* groups that the next outputs lack */\n"
                "    @accumulator@ ready[4]; /* of this group's outputs: all products with older groups */\n"
                "    @accumulator@ coming[4]; /* of the next group's, as far as they are */\n"
                "    @sample@ past[@NAME@_SAMPLES];\n",
            .reset = std::string(clear) +
                     "    for (i = 0U; i < 4U; ++i) {\n        S->ready[i] = 0;\n        S->coming[i] = 0;\n    }\n"
                     "    S->phase = 0U;\n    S->own = 0U;\n    S->left = @NAME@_GROUPS;\n"};
}

// kernels/glsum/logmemory/nested.hpp.
HistoryText history_text(glsum::Nested) {
    return {.summary = "the newest samples as they are, all older ones as sliding sums over blocks of 2, 4, 8, ...",
            .formula =
                "  S_k = sum_{j=0..K-1} a_j x_(k-j) + sum_b w_b s_b,   a_0 = 1,   a_j = a_(j-1) (1 - (1+v)/j)\n"
                "  s_b the sum of x_(k-j), w_b the mean of a_j over the lags j of block b\n\n"
                "one sum a sample;",
            .fields =
                "    uint32_t head; /* where x_(k-1) lies; x_(k-2) behind it */\n"
                "    @sample@ past[@NAME@_SAMPLES]; /* behind the samples the sums of 2, of 4, ...: one ring */\n",
            .reset = std::string("    S->head = 0U;\n") + clear,
            .push = replaced(next_head, "_PAST", "_SAMPLES") + "    S->head = head;\n    S->past[head] = newest;\n"};
}

// kernels/glsum/wrap/delta.hpp.
HistoryText increments_text(const HistoryText& kept, bool fixed) {
    HistoryText text = kept;
    text.summary = "of increments d_k = x_k - x_(k-1): " + kept.summary;
    text.formula =
        "  S_k = sum_{j=0..min(k, L-1)} b_j (x_(k-j) - x_(k-j-1)),   b_0 = 1,   b_j = b_(j-1) (1 - v/j)\n\n"
        "one sum a sample, of the order v - 1 over the increments;";
    text.fields = "    @sample@ before; /* x_(k-1) */\n" + replaced(kept.fields, "x_(k", "d_(k");
    text.reset = kept.reset + "    S->before = 0;\n";
    text.before = fixed ? R"(    int64_t increment = (int64_t)newest - S->before;
    S->before = newest;
    if (increment > INT32_MAX || increment < INT32_MIN) {
        increment = increment < 0 ? INT32_MIN : INT32_MAX;
        ++S->saturations;
    }
    newest = (int32_t)increment;
)"
                        : R"(    const @sample@ increment = newest - S->before;
    S->before = newest;
    newest = increment;
)";
    return text;
}

// kernels/glsum/exponentials/integral.hpp.
HistoryText running_sum_text(const HistoryText& modes, std::size_t near_samples) {
    HistoryText text = modes;
    text.summary = "the newest samples as they are, all older ones as decaying averages and a running sum";
    text.fields =
        "    @sample@ total[2]; /* x of all samples behind the near ones; what its additions lost */\n" + modes.fields;
    text.reset = modes.reset + "    S->total[0] = 0;\n    S->total[1] = 0;\n";
    text.before = std::string("    const @sample@ added = ") +
                  (near_samples > 0 ? "S->past[@NAME@_PAST - 1U]" : "newest") +
                  ";\n    const @sample@ total = S->total[0];\n    const @sample@ lost = S->total[1];\n"
                  "    const @sample@ grown = total + added;\n    const @sample@ part = grown - total;\n";
    text.before += "    S->total[0] = grown;\n    S->total[1] = lost + ((total - (grown - part)) + (added - part));\n";
    return text;
}

// kernels/glsum/wrap/tail.hpp.
HistoryText guess_text(const HistoryText& window, std::size_t past, bool to_first) {
    HistoryText text = window;
    text.summary =
        window.summary + (to_first ? "; what it dropped is taken on the line from its oldest to the first sample"
                                   : "; what it dropped is taken as its oldest sample");
    text.formula = std::string("  S_k = sum_{j=0..min(k, L-1)} a_j x_(k-j)") +
                   (to_first ? " + (T_k - U_k) x_(k-L+1) + U_k x_0" : " + T_k x_(k-L+1)") +
                   ",   a_0 = 1,   a_j = a_(j-1) (1 - (1+v)/j)\n" + "  T_k = sum_{j=L..k} a_j" +
                   (to_first ? ",   U_k = sum_{j=L..k} a_j (j-L+1)/(k-L+1)" : "") + "\n\none sum a sample;";
    // Before the past: behind it they would lie beyond the reach of a load with an immediate offset.
    text.fields =
        std::string(
            "    uint32_t count; /* samples since init */\n"
            "    @sample@ tail[2]; /* T_k, and what its last step lost */\n") +
        (to_first ? "    @sample@ mean[2]; /* T_k - U_k, the mean of all T before; what its last step lost */\n"
                    "    @sample@ first; /* x_0 */\n"
                  : "") +
        window.fields;
    text.reset = window.reset + "    S->count = 0U;\n    S->tail[0] = 0;\n    S->tail[1] = 0;\n" +
                 (to_first ? "    S->mean[0] = 0;\n    S->mean[1] = 0;\n    S->first = 0;\n" : "");
    text.behind =
        std::string("    {\n        const uint32_t k = S->count;\n        if (k > @NAME@_PAST) {\n") +
        "            const @sample@ oldest = " + (past > 0 ? "S->past[head + @NAME@_PAST - 1U]" : "newest") + ";\n" +
        (to_first ? "            @sample@ mean;\n" : "") +
        "            if (k != UINT32_MAX) {\n                S->count = k + 1U;\n" +
        (to_first ? "                @name@_carry(S->mean, (S->tail[0] - S->mean[0]) / (@sample@)(k - @NAME@_PAST));\n"
                  : "") +
        "                @name@_carry(S->tail, @name@_product(@NAME@_IN_WINDOW + S->tail[0], @NAME@_MINUS_ORDER) / "
        "(@sample@)k);\n            }\n" +
        (to_first ? "            mean = S->mean[0];\n"
                    "            sum = @name@_multiply_add(sum, mean, oldest);\n"
                    "            sum = @name@_multiply_add(sum, S->tail[0] - mean, S->first);\n        } else {\n"
                    "            S->count = k + 1U;\n        }\n"
                    "        if (k == 0U) {\n            S->first = newest;\n        }\n"
                  : "            sum = @name@_multiply_add(sum, S->tail[0], oldest);\n        } else {\n"
                    "            S->count = k + 1U;\n        }\n") +
        "    }\n";
    return text;
}

}  // namespace generate
