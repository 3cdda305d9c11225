#include "bench/generate/parts.hpp"

namespace generate {
namespace {

const char* const clear = R"(    for (i = 0; i < @NAME@_SAMPLES; ++i) {
        S->past[i] = 0;
    }
)";
const char* const next_head = R"(    head = (head == 0U ? @NAME@_PAST : head) - 1U;
)";

}  // namespace

// The value passes through an empty instruction: without it compilers make the loop a call of memmove, which small C
// libraries copy byte by byte.
HistoryText history_text(glsum::Shift) {
    return {.summary = "every sample moves one place on at each step",
            .fields = "    @sample@ past[@NAME@_SAMPLES]; /* x_(k-1), x_(k-2), ... */\n",
            .reset = clear,
            .pieces = {{"S->past", "S->past + @NAME@_PAST", "", "@NAME@_PAST"}},
            .push = R"(    for (i = @NAME@_PAST - 1U; i > 0U; --i) {
        @moved@ moved = S->past[i - 1U];
        @NAME@_KEEP_WORD(moved);
        S->past[i] = (@sample@)moved;
    }
    S->past[0] = newest;
)"};
}

HistoryText history_text(glsum::Ring) {
    return {.summary = "samples stay in place, the head moves down and wraps",
            .fields =
                "    size_t head; /* where x_(k-1) lies; x_(k-2) behind it */\n"
                "    @sample@ past[@NAME@_SAMPLES];\n",
            .reset = std::string("    S->head = 0U;\n") + clear,
            .pieces = {{"S->past + head", "S->past + @NAME@_PAST", "", "(@NAME@_PAST - head)"},
                       {"S->past", "S->past + head", "(@NAME@_PAST - head)", "@NAME@_PAST", true}},
            .push = std::string(next_head) + "    S->past[head] = newest;\n    S->head = head;\n"};
}

HistoryText history_text(glsum::Mirror) {
    return {.summary = "a ring kept twice, so that the past is one piece",
            .fields =
                "    size_t head; /* where x_(k-1) lies; x_(k-2) behind it */\n"
                "    @sample@ past[@NAME@_SAMPLES]; /* twice the same */\n",
            .reset = std::string("    S->head = 0U;\n") + clear,
            .pieces = {{"S->past + head", "S->past + head + @NAME@_PAST", "", "@NAME@_PAST"}},
            .push = std::string(next_head) +
                    "    S->past[head] = newest;\n    S->past[head + @NAME@_PAST] = newest;\n    S->head = head;\n"};
}

HistoryText history_text(glsum::Modes) {
    return {.summary = "the newest samples as they are, all older ones as decaying averages",
            .fields = "    @sample@ past[@NAME@_SAMPLES]; /* x_(k-1), x_(k-2), ...; then of each mode its state */\n",
            .reset = clear,
            .pieces = {},
            .push = {}};
}

}  // namespace generate
