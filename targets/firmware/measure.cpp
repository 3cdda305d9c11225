// measure: what does a call of a kernel cost? The counting is done from outside, by the emulator's plugin, which knows
// the entries of `glsum_watched` and sees each of their calls; this program makes the calls, in a known order, and
// hashes their outputs.
//
// First the instrument's own check, `check <loop> <turns>` for loops of known counts (check_loops.S). Then, for each
// row of the plan, `calls` calls from a cleared past and one more on a painted stack:
//   row <n> <status> <hash of the outputs> <bytes of stack> <bytes of state> <bytes of coefficients>
#include "cortex-m7/stack.hpp"
#include "program.hpp"

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

// One after the other in memory, as an array would be: rows of { name, its length, entry }. An array would need casts
// of the entries, which no constant may hold, and the table must be there without running anything.
template <class K, class... Rest>
struct WatchTable {
    const char* name = K::name().data();
    std::uint32_t name_length = K::name().size();
    typename K::Output (*entry)(typename K::State&, typename K::Sample) = &K::step;
    WatchTable<Rest...> rest;
};
template <class K>
struct WatchTable<K> {
    const char* name = K::name().data();
    std::uint32_t name_length = K::name().size();
    typename K::Output (*entry)(typename K::State&, typename K::Sample) = &K::step;
};
template <class... Ks>
constexpr WatchTable<Ks...> make_watch_table(glsum::KernelList<Ks...>) {
    return {};
}
using Watched = decltype(make_watch_table(glsum::Registry{}));
static_assert(sizeof(Watched) == 12 * glsum::Registry::count);

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

// The kernels' names and entries, for the host to read from the ELF.
extern "C" {
extern const Watched glsum_watched;
extern const std::uint32_t glsum_watched_count;
constinit const Watched glsum_watched = make_watch_table(glsum::Registry{});
const std::uint32_t glsum_watched_count = glsum::Registry::count;
}

int firmware_main() {
    asm volatile("" ::"r"(&glsum_watched), "r"(&glsum_watched_count));  // or the linker would drop them
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
            if (!firmware::run_row<K>(row, signal, answer, state, hash)) {
                return;
            }
            const auto last = K::from_real(signal.at(row.calls));
            typename K::Output output;
            const std::size_t stack = cortex_m7::stack_bytes([&] { output = K::step(state, last); });
            hash.add(output);
            answer.number(hash.value(), 16);
            answer.number(stack);
            answer.number(sizeof state + K::past_count(row.taps) * sizeof(typename K::Sample));
            answer.number(K::table_count(row.taps) * sizeof(typename K::Coefficient));
        });
}
