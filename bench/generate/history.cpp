#include "bench/generate/parts.hpp"
#include "bench/generate/shared.hpp"
#include "bench/generate/text.hpp"

namespace generate {
namespace {

const char* const clear = R"(    for (i = 0; i < @NAME@_SAMPLES; ++i) {
        S->past[i] = 0;
    }
)";

const Words in_window = {{"T", "@sample@"}};
Words in_push(const std::string& past) {
    return {{"samples", "S->past"}, {"past", past}, {"T", "@sample@"}, {"next_head", "@name@_next_head"}};
}

const Words in_integrator = {{"state.total", "S->total[0]"},
                             {"state.lost", "S->total[1]"},
                             {"state.weight", "@NAME@_INTEGRATOR_WEIGHT"},
                             {"leaving", "added"}};

bool has_head(std::string_view fields) { return fields.find(" head;") != std::string_view::npos; }

}  // namespace

HistoryText stated_history_text(std::string_view summary, std::string_view fields) {
    return {.summary = std::string(summary),
            .fields = std::string(fields),
            .reset = std::string(has_head(fields) ? "    S->head = 0U;\n" : "") + clear};
}

HistoryText window_text(std::string_view word, std::string_view summary, std::string_view fields, bool contiguous) {
    HistoryText text = stated_history_text(summary, fields);
    const std::string name(word);
    text.window = shared(name + " window", in_window);
    text.two_pieces = !contiguous;
    text.push = shared(name + " push", in_push("@NAME@_PAST")) + (has_head(fields) ? "    S->head = head;\n" : "");
    return text;
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
            .push = shared("ring push", in_push("@NAME@_SAMPLES")) + "    S->head = head;\n"};
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
    const Words words = {
        {"Rounded", "@name@_rounded"}, {"saturate(", "@name@_saturate("}, {"state.scale.", "S->"}, {"state.", "S->"}};
    text.before = shared("increment") + shared(fixed ? "increment fixed" : "increment floating", words) +
                  shared("increment kept", words) + "    newest = increment;\n";
    return text;
}

// kernels/glsum/exponentials/integrator.hpp.
std::string integrator_closing() { return shared("integrator closing", in_integrator); }

HistoryText integrator_text(const HistoryText& modes, std::size_t near_samples) {
    HistoryText text = modes;
    text.summary = "the newest samples as they are, all older ones as decaying averages and an integrator";
    text.fields =
        "    @sample@ total[2]; /* x of all samples behind the near ones; what its additions lost */\n" + modes.fields;
    text.reset = modes.reset + "    S->total[0] = 0;\n    S->total[1] = 0;\n";
    text.before = std::string("    const @sample@ added = ") +
                  (near_samples > 0 ? "S->past[@NAME@_PAST - 1U]" : "newest") + ";\n" +
                  shared("integrator", in_integrator);
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
    Words words = {{"state.line.mean.add(", "@name@_carry(S->mean, "},
                   {"state.line.mean.value", "S->mean[0]"},
                   {"state.line.first", "S->first"},
                   {"state.tail.add(", "@name@_carry(S->tail, "},
                   {"state.tail.value", "S->tail[0]"},
                   {"state.in_window", "@NAME@_IN_WINDOW"},
                   {"state.minus_order", "@NAME@_MINUS_ORDER"},
                   {"state.count", "S->count"},
                   {"last_count", "UINT32_MAX"},
                   {"bool", "int"},
                   {"past", "@NAME@_PAST"}};
    if (past == 0) {
        words["past == 0 ? newest : newer[past - 1]"] = "newest";
    }
    text.behind = shared("guess", words) + (to_first ? shared("guess mean", words, 8) : "") +
                  shared("guess weight", words, 8) + shared(to_first ? "guess line" : "guess hold", words, 8) +
                  "    }\n" + (to_first ? shared("guess first", words) : "") + shared("guess count", words);
    return text;
}

}  // namespace generate
