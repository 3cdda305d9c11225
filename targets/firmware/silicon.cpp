// silicon: what does one call of a kernel take? On a board it says so by the core's cycle counter, in rows of measured
// cycles; on the emulated one, which has no cycle counter, the timing model watches the same calls from outside.
//
// Argument: a file of lines `<kernel> <taps>`; without one, the program's own list. A kernel is one of the registry's,
// a loop of published measurements (silicon_loops.S), or a loop that tells rival rules apart (rival_loops.S), whose
// `taps` are its turns. Each is called until caches and branch predictor have settled; the last call is the one that
// counts.
#include "buffers.hpp"
#include "glsum/registry.hpp"
#include "marks.hpp"
#include "plan.hpp"
#include "port.hpp"
#include "shared/silicon_calls.hpp"
#include "watched.hpp"

// Memory at r0, taps at r1, the new sample in r2 or s0.
using Loop = void(void* memory, std::uint32_t taps, std::int32_t newest_q31, float newest_f32);
extern "C" {
#define GLSUM_LOOP(name, most_taps) Loop glsum_silicon_##name;
#include "shared/silicon_loops.def"
#undef GLSUM_LOOP
}

namespace {

constexpr std::size_t most_taps = 1024;  // of a registered kernel
constexpr int calls = firmware::silicon_calls;

struct NamedLoop {
    std::string_view name;
    Loop* call;
    std::uint32_t most_taps;
};
constexpr NamedLoop loops[] = {
#define GLSUM_LOOP(name, most_taps) {#name, glsum_silicon_##name, most_taps},
#include "shared/silicon_loops.def"
#undef GLSUM_LOOP
};

// Makes the calls and says what the last one took.
template <class Call>
void measure(std::string_view kernel, std::size_t taps, Call call) {
    const port::Memories memories = port::memories();
    std::uint32_t cycles = 0;
    glsum_mark_row();
    glsum_mark_on();
    for (int i = 0; i < calls; ++i) {
        const std::uint32_t before = port::cycles();
        call();
        if (memories.maintenance) {
            port::maintain_data_cache();
        }
        cycles = port::cycles() - before;
    }
    glsum_mark_off();
    if (cycles != 0) {
        firmware::Answer row(kernel, ',');
        row.add(",").add(memories.code).add(",").add(memories.data);
        row.number(memories.maintenance ? 1 : 0).number(taps).number(cycles);
        row.add(",").add(memories.setup).write();
    }
}

template <class K>
bool measure_kernel(std::size_t taps) {
    static typename K::State state;
    const auto memory = firmware::buffers<K, most_taps>();
    const glsum::Status status = K::prepare(state, {0.5, taps}, memory.table, memory.past);
    if (status != glsum::Status::ok) {
        return false;
    }
    // Through a pointer that the compiler does not see through: neither inlined nor reached by a veneer.
    typename K::Output (*volatile step)(typename K::State&, typename K::Sample) = &K::step;
    const typename K::Sample newest = K::from_real(0.25);
    if (const port::Memories memories = port::memories();
        reinterpret_cast<std::uintptr_t>(+step) >= memories.code_end) {
        firmware::Answer("# ").add(K::name()).add(": not in ").add(memories.code).write();
        return true;
    }
    measure(K::name(), taps, [&, call = +step] { (void)call(state, newest); });
    return true;
}

bool measure_one(std::string_view kernel, std::uint32_t taps) {
    for (const NamedLoop& loop : loops) {
        if (loop.name == kernel) {
            if (taps > loop.most_taps) {
                return false;
            }
            measure(kernel, taps, [&, call = loop.call] { call(firmware::Memory<most_taps>::past, taps, 1, 1.0F); });
            return true;
        }
    }
    bool done = false;
    if (taps <= most_taps) {
        glsum::Registry::for_each([&]<class K>() {
            if (K::name() == kernel && !done) {
                done = measure_kernel<K>(taps);
            }
        });
    }
    return done;
}

// Everything that this program knows, at some lengths.
void measure_all() {
    for (const NamedLoop& loop : loops) {
        for (const std::uint32_t taps : {5U, 10U, 20U, 50U, 100U, 128U}) {
            measure_one(loop.name, taps);
        }
    }
    glsum::Registry::for_each([]<class K>() {
        for (const std::uint32_t taps : {10U, 50U, 200U, 600U}) {
            measure_one(K::name(), taps);
        }
    });
}

}  // namespace

int firmware_main() {
    firmware::keep_watch_table();
    alignas(8) static std::byte bytes[16 * 1024];
    std::string_view command = port::command_line();
    firmware::take_word(command);
    if (command.empty()) {
        port::write("kernel,code,data,maintenance,taps,cycles,setup\n");
        measure_all();
        port::write("# end\n");
        return 0;
    }
    const auto file = port::read_file(firmware::take_word(command), bytes);
    std::string_view plan{reinterpret_cast<const char*>(file.data()), file.size()};
    if (plan.empty()) {
        port::write("error: no plan, or one of more than 16 KB\n");
        return 2;
    }
    while (!plan.empty()) {
        const std::string_view kernel = firmware::take_word(plan);
        std::uint32_t taps = 0;
        if (!firmware::to_number(firmware::take_word(plan), taps) || taps == 0 || !measure_one(kernel, taps)) {
            port::write("error: no such kernel, or more taps than it takes\n");
            return 2;
        }
    }
    return 0;
}
