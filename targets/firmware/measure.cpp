// measure: what does a call of a kernel cost? The counting is done from outside, by the emulator's plugin, which knows
// the entries of `glsum_watched` and sees each of their calls; this program makes the calls, in a known order, and
// hashes their outputs.
//
// First the instrument's own check, `check <loop> <turns>` for loops of known counts (check_loops.S). Then, for each
// row of the plan, `calls` calls from a cleared past, one more on a painted stack and, of a kernel in two halves, 32 in
// halves:
//   row <n> <status> <hash of the outputs> <bytes of stack> <bytes of state> <bytes of coefficients>
// Marks (marks.S) tell the timing model where a row begins and which of its calls it is to time.
#include "cortex-m7/stack.hpp"
#include "glsum/computes_in_double.hpp"
#include "marker.hpp"
#include "program.hpp"
#include "watched.hpp"

extern "C" {
void glsum_check_steps(std::uint32_t turns, std::uint32_t* word);
void glsum_check_one_more(std::uint32_t turns, std::uint32_t* word);
void glsum_check_multiple(std::uint32_t turns, std::uint32_t* words);
void glsum_check_wide(std::uint32_t turns, std::uint32_t* words);
void glsum_check_edge(std::uint32_t turns, std::uint32_t* word);
void glsum_check_skipped(std::uint32_t turns, std::uint32_t* word);
void glsum_check_nested(std::uint32_t turns, std::uint32_t* word);
}

namespace {

using Check = void (*)(std::uint32_t, std::uint32_t*);
struct NamedCheck {
    const char* name;
    Check call;
};
constexpr NamedCheck checks[] = {
    {"steps", glsum_check_steps},   {"one_more", glsum_check_one_more}, {"multiple", glsum_check_multiple},
    {"wide", glsum_check_wide},     {"edge", glsum_check_edge},         {"skipped", glsum_check_skipped},
    {"nested", glsum_check_nested},
};

}  // namespace

int firmware_main() {
    firmware::keep_watch_table();
    std::uint32_t words[4] = {};
    for (const NamedCheck& check : checks) {
        for (const std::uint32_t turns : {1U, 10U, 1000U}) {
            check.call(turns, words);
            firmware::Answer("check ").add(check.name).number(turns).write();
        }
    }
    return firmware::run_plan(
        []<class K>(const firmware::PlanRow& row, firmware::Signal signal, firmware::Answer& answer) {
            typename K::State state;
            firmware::OutputHash hash;
            {
                firmware::Marker marker({row.taps, glsum::computes_in_double<K>()});
                if (!firmware::run_row<K>(row, signal, answer, state, hash,
                                          [&](std::size_t call) { marker.before(call); })) {
                    return;
                }
            }
            const auto last = K::from_real(signal.at(row.calls));
            typename K::Output output;
            const std::size_t stack = cortex_m7::stack_bytes([&] { output = K::step(state, last); });
            hash.add(output);
            if constexpr (glsum::InHalves<K>) {
                glsum_mark_on();
                for (std::size_t call = 1; call <= firmware::calls_in_halves; ++call) {
                    const auto sample = K::from_real(signal.at(row.calls + call));
                    hash.add(K::answer(state, sample));
                    K::settle(state, sample);
                }
                glsum_mark_off();
            }
            answer.number(hash.value(), 16);
            answer.number(stack);
            answer.number(sizeof state + glsum::past_needed<K>(row.design()) * sizeof(typename K::Sample));
            answer.number(glsum::table_needed<K>(row.design()) * sizeof(typename K::Coefficient));
        });
}
