// QEMU glue: turns the emulator's callbacks into the blocks and the stream of stream.hpp. Nothing is decided here.
// Options:
//   watch=FILE   entry addresses of the functions that are watched, decimal, one a line
//   out=FILE     counts their calls; the call log goes there
//   stream=on    the counter is told every instruction and access; off, the default: blocks, accesses being counted
//                without a call
//   timing=FILE  a timing request: the stream goes to the timing model too, and
//   times=FILE   the timing logs go there
//   marks=FILE   addresses of the program's marks (row, on, off), decimal: only what lies between on and off is timed
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "qemu/plugin/api.h"
#include "qemu/plugin/tally.hpp"
#include "qemu/stream/call_counter.hpp"
#include "qemu/stream/thumb.hpp"
#include "qemu/timing/marked_timer.hpp"

// Told by what the emulator has: it looks here once it has loaded the plugin.
int qemu_plugin_version = qemu_plugin_read_memory_vaddr != nullptr ? 4 : qemu_plugin_scoreboard_new != nullptr ? 2 : 1;

namespace {

// The timing model at work, and its log.
struct Timing {
    std::ofstream log;
    qemu::MarkedTimer timer;
    qemu::Tally executed;      // instructions, but for the first of each block
    std::uint64_t before = 0;  // the present block
    const qemu::TranslationBlock* block = nullptr;
    int log_descriptor = -1;
    // Of the instructions of the present block.
    [[nodiscard]] std::uint64_t done() const { return 1 + executed.value() - before; }
    Timing(const std::set<std::uint32_t>& entries, const timing::TimingRequest& request,
           std::optional<qemu::Marks> marks, const std::string& path)
        : log(path),
          timer(entries, timing::cores_of(request), marks, log, request.double_routines, request.handlers,
                request.fault_handlers, request.stretches, request.unwinding) {}
};

struct Options {
    std::set<std::uint32_t> entries;
    std::string out_path;
    std::string request_path;
    std::string times_path;
    std::optional<qemu::Marks> marks;
    bool stream = false;
};

struct Session {
    Options options;
    int interface;  // its version, of this emulator
    qemu::CallCounter counter;
    std::unique_ptr<Timing> timing;  // or none
    qemu::Tally loads = {};
    qemu::Tally stores = {};
    qemu::AccessTotals of_pairs = {};  // which are not in them
    // One per address for the whole run: translations come and go.
    std::unordered_map<std::uint32_t, std::unique_ptr<qemu::Instruction>> instructions = {};
    // By first address and number of instructions: the emulator may cut the same code elsewhere when it is translated
    // again.
    std::map<std::pair<std::uint32_t, std::size_t>, std::unique_ptr<qemu::TranslationBlock>> blocks = {};
};
// Never deleted: the emulator asks for the last time after this library's static objects are gone.
Session* session = nullptr;

// The first bytes of an instruction, by whichever signature this emulator's function has.
void copy_bytes(const qemu_plugin_insn* translated, void* to, std::size_t bytes) {
    if (session->interface >= 3) {
        qemu_plugin_insn_data(translated, to, bytes);
        return;
    }
    using Pointing = const void* (*)(const qemu_plugin_insn*);
    const auto data = reinterpret_cast<Pointing>(reinterpret_cast<void (*)()>(&qemu_plugin_insn_data));
    std::memcpy(to, data(translated), bytes);
}

qemu::Instruction* instruction_at(const qemu_plugin_insn* translated) {
    const auto address = static_cast<std::uint32_t>(qemu_plugin_insn_vaddr(translated));
    const auto index = static_cast<std::uint32_t>(session->instructions.size());
    auto& slot = session->instructions[address];
    if (!slot) {
        // Not by qemu_plugin_insn_size: at a page's end QEMU looks ahead, and counts what it saw to this instruction.
        std::uint16_t half[2] = {};
        copy_bytes(translated, half, 2);
        const std::uint8_t bytes = qemu::bytes_from(half[0]);
        copy_bytes(translated, half, bytes);
        const std::uint32_t encoding = bytes == 2 ? half[0] : static_cast<std::uint32_t>(half[0]) << 16 | half[1];
        slot = std::make_unique<qemu::Instruction>(qemu::Instruction{address, encoding, bytes, index});
    }
    return slot.get();
}

// \param from, to  of the translated block's instructions
qemu::TranslationBlock* block_at(const qemu_plugin_tb* translated, std::size_t from, std::size_t to) {
    const auto index = static_cast<std::uint32_t>(session->blocks.size());
    auto& slot = session->blocks[{instruction_at(qemu_plugin_tb_get_insn(translated, from))->address, to - from}];
    if (!slot) {
        slot = std::make_unique<qemu::TranslationBlock>(qemu::TranslationBlock{{}, index});
        for (std::size_t i = from; i < to; ++i) {
            slot->instructions.push_back(*instruction_at(qemu_plugin_tb_get_insn(translated, i)));
        }
    }
    return slot.get();
}

qemu::Access to_access(qemu_plugin_meminfo_t info, std::uint64_t address) {
    return {static_cast<std::uint32_t>(address), static_cast<std::uint8_t>(1U << qemu_plugin_mem_size_shift(info)),
            qemu_plugin_mem_is_store(info)};
}

// The accesses of LDRD and STRD as the core makes them, a word each: QEMU 10.0 makes one of eight bytes.
template <class Take>
void take_words(qemu_plugin_meminfo_t info, std::uint64_t address, Take take) {
    qemu::Access access = to_access(info, address);
    if (access.bytes != 8) {
        take(access);
        return;
    }
    access.bytes = 4;
    take(access);
    access.address += 4;
    take(access);
}

void executes(unsigned int, void* instruction) {
    session->counter.executes(*static_cast<qemu::Instruction*>(instruction));
}
void accesses(unsigned int, qemu_plugin_meminfo_t info, std::uint64_t address, void*) {
    session->counter.accesses(to_access(info, address));
}
void accesses_pair(unsigned int, qemu_plugin_meminfo_t info, std::uint64_t address, void*) {
    take_words(info, address, [](const qemu::Access& access) { session->counter.accesses(access); });
}
void counts_pair(unsigned int, qemu_plugin_meminfo_t info, std::uint64_t address, void*) {
    take_words(info, address, [](const qemu::Access& access) {
        ++(access.store ? session->of_pairs.stores : session->of_pairs.loads);
    });
}
void times_block(unsigned int, void* block) {
    Timing& timing = *session->timing;
    if (timing.timer.on()) {
        timing.timer.executes_block(*static_cast<qemu::TranslationBlock*>(block), timing.done());
        timing.before = timing.executed.value();
        timing.block = static_cast<qemu::TranslationBlock*>(block);
    }
}
void times_word(qemu::Access access, void* nth) {
    access.by = static_cast<std::uint16_t>(reinterpret_cast<std::uintptr_t>(nth));
    session->timing->timer.accesses(access);
}
void times_access(unsigned int, qemu_plugin_meminfo_t info, std::uint64_t address, void* nth) {
    if (session->timing->timer.on()) {
        times_word(to_access(info, address), nth);
    }
}
void times_pair(unsigned int, qemu_plugin_meminfo_t info, std::uint64_t address, void* nth) {
    if (session->timing->timer.on()) {
        take_words(info, address, [&](const qemu::Access& access) { times_word(access, nth); });
    }
}
void meets_mark(unsigned int, void* instruction) {
    session->timing->timer.meets_mark(static_cast<qemu::Instruction*>(instruction)->address);
}

void take_totals() {
    const qemu::AccessTotals& pairs = session->of_pairs;
    session->counter.totals() = {session->loads.value() + pairs.loads, session->stores.value() + pairs.stores};
}
void executes_block(unsigned int, void* block) {
    take_totals();
    session->counter.executes_block(*static_cast<qemu::TranslationBlock*>(block));
}

void counts_by_stream(qemu_plugin_tb* block) {
    for (std::size_t i = 0; i < qemu_plugin_tb_n_insns(block); ++i) {
        qemu_plugin_insn* translated = qemu_plugin_tb_get_insn(block, i);
        qemu_plugin_register_vcpu_insn_exec_cb(translated, executes, QEMU_PLUGIN_CB_NO_REGS,
                                               instruction_at(translated));
        qemu_plugin_register_vcpu_mem_cb(translated,
                                         qemu::moves_pair(*instruction_at(translated)) ? accesses_pair : accesses,
                                         QEMU_PLUGIN_CB_NO_REGS, QEMU_PLUGIN_MEM_RW, nullptr);
    }
}

void counts_by_blocks(qemu_plugin_tb* block) {
    qemu_plugin_register_vcpu_tb_exec_cb(block, executes_block, QEMU_PLUGIN_CB_NO_REGS,
                                         block_at(block, 0, qemu_plugin_tb_n_insns(block)));
    for (std::size_t i = 0; i < qemu_plugin_tb_n_insns(block); ++i) {
        qemu_plugin_insn* translated = qemu_plugin_tb_get_insn(block, i);
        // Not by QEMU_PLUGIN_MEM_R and _W: QEMU 7.2 counts stores for the first, and every access for the second.
        if (const qemu::Instruction& instruction = *instruction_at(translated); qemu::moves_pair(instruction)) {
            qemu_plugin_register_vcpu_mem_cb(translated, counts_pair, QEMU_PLUGIN_CB_NO_REGS, QEMU_PLUGIN_MEM_RW,
                                             nullptr);
        } else {
            (qemu::stores(instruction) ? session->stores : session->loads).count_accesses(translated);
        }
    }
}

// Cut where a watched function or a mark begins, and around the mark of a stretch. What is counted without a call tells
// how far a block came that a fault ended.
void times_blocks(qemu_plugin_tb* block) {
    const std::size_t count = qemu_plugin_tb_n_insns(block);
    const auto address = [&](std::size_t i) { return instruction_at(qemu_plugin_tb_get_insn(block, i))->address; };
    Timing& timing = *session->timing;
    const auto alone = [&](std::size_t i) {
        return timing.timer.stands_alone(*instruction_at(qemu_plugin_tb_get_insn(block, i)));
    };
    for (std::size_t from = 0, to = 0; from < count; from = to) {
        const bool mark = timing.timer.is_mark(address(from));
        to = from + 1;
        while (!mark && !alone(from) && to < count && !alone(to) && !timing.timer.is_mark(address(to)) &&
               !session->options.entries.contains(address(to))) {
            ++to;
        }
        qemu_plugin_insn* first = qemu_plugin_tb_get_insn(block, from);
        void* data = mark ? static_cast<void*>(instruction_at(first)) : block_at(block, from, to);
        qemu_plugin_register_vcpu_insn_exec_cb(first, mark ? meets_mark : times_block, QEMU_PLUGIN_CB_NO_REGS, data);
        for (std::size_t i = from; i < to; ++i) {
            qemu_plugin_insn* translated = qemu_plugin_tb_get_insn(block, i);
            qemu_plugin_register_vcpu_mem_cb(
                translated, qemu::moves_pair(*instruction_at(translated)) ? times_pair : times_access,
                QEMU_PLUGIN_CB_NO_REGS, QEMU_PLUGIN_MEM_RW, reinterpret_cast<void*>(i - from));
            if (i > from) {
                timing.executed.count_executions(translated);
            }
        }
    }
}

// The emulator's threads block all signals, and since glibc 2.41 abort() no longer unblocks its own before it raises
// it.
void hear_aborts() {
    sigset_t aborted;
    sigemptyset(&aborted);
    sigaddset(&aborted, SIGABRT);
    pthread_sigmask(SIG_UNBLOCK, &aborted, nullptr);
}

// In the thread of the core.
void translates(qemu_plugin_id_t, qemu_plugin_tb* block) {
    if (session->blocks.empty() && session->timing) {
        hear_aborts();
    }
    if (!session->options.out_path.empty()) {
        session->options.stream ? counts_by_stream(block) : counts_by_blocks(block);
    }
    if (session->timing) {
        times_blocks(block);
    }
}

// The emulator dies of a core that locks up without telling its plugins: a log of where it faulted and where it was, by
// what a signal allows.
void aborts(int) {
    const Timing& timing = *session->timing;
    std::array<char, 64> text{};
    char* end = text.data();
    const auto add = [&](std::string_view words) { end = std::copy(words.begin(), words.end(), end); };
    const auto tell = [&](std::string_view what, std::uint32_t address) {
        add(what);
        end = std::to_chars(end, text.data() + text.size(), address).ptr;
        add("\n");
    };
    const std::optional<std::uint32_t> fault = timing.timer.fault();
    if (fault) {
        tell("fault ", *fault);
    }
    if (timing.block != nullptr) {
        const std::vector<qemu::Instruction>& instructions = timing.block->instructions;
        const std::uint32_t last =
            instructions[std::min<std::uint64_t>(timing.done(), instructions.size()) - 1].address;
        if (last != fault) {
            tell("at ", last);
        }
    }
    if (end != text.data()) {
        add("end\n");
        static_cast<void>(!write(timing.log_descriptor, text.data(), static_cast<std::size_t>(end - text.data())));
    }
}

void ends(qemu_plugin_id_t, void*) {
    if (session->timing) {
        Timing& timing = *session->timing;
        timing.timer.finish();
        if (!timing.log.flush()) {
            std::fprintf(stderr, "plugin: cannot write %s\n", session->options.times_path.c_str());
        }
    }
    if (!session->options.out_path.empty()) {
        if (!session->options.stream) {
            take_totals();
        }
        std::ofstream out(session->options.out_path);
        session->counter.write(out);
        if (!out.flush()) {
            std::fprintf(stderr, "plugin: cannot write %s\n", session->options.out_path.c_str());
        }
    }
}

// \return whether the options are whole.
bool read_options(int argc, char** argv, Options& options) {
    for (int i = 0; i < argc; ++i) {
        const std::string_view argument = argv[i];
        const std::string value(argument.substr(std::min(argument.find('=') + 1, argument.size())));
        if (argument.starts_with("watch=")) {
            std::ifstream watch(value);
            for (std::uint32_t entry = 0; watch >> entry;) {
                options.entries.insert(entry);
            }
        } else if (argument.starts_with("out=")) {
            options.out_path = value;
        } else if (argument.starts_with("timing=")) {
            options.request_path = value;
        } else if (argument.starts_with("times=")) {
            options.times_path = value;
        } else if (argument.starts_with("marks=")) {
            std::ifstream file(value);
            qemu::Marks marks{};
            if (!(file >> marks.row >> marks.on >> marks.off)) {
                std::fprintf(stderr, "plugin: %s: expected three addresses\n", value.c_str());
                return false;
            }
            options.marks = marks;
        } else if (argument == "stream=on" || argument == "stream=off") {
            options.stream = argument == "stream=on";
        } else {
            std::fprintf(stderr, "plugin: expected watch=, out=, stream=, timing=, times= or marks=, found %s\n",
                         argv[i]);
            return false;
        }
    }
    if ((options.entries.empty() && options.request_path.empty()) ||
        (options.out_path.empty() && options.times_path.empty()) ||
        options.times_path.empty() != options.request_path.empty()) {
        std::fprintf(stderr,
                     "plugin: expected watch=FILE with at least one address, unless stretches are timed, and out=FILE, "
                     "timing= and times=, or all\n");
        return false;
    }
    return true;
}

}  // namespace

int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t* info, int argc, char** argv) {
    if (std::string_view(info->target_name) != "arm") {
        std::fprintf(stderr, "plugin: expected the target arm, found %s\n", info->target_name);
        return 1;
    }
    Options options;
    if (!read_options(argc, argv, options)) {
        return 1;
    }
    std::unique_ptr<Timing> timing;
    if (!options.request_path.empty()) {
        try {
            std::ifstream request(options.request_path);
            timing = std::make_unique<Timing>(options.entries, timing::read_timing_request(request), options.marks,
                                              options.times_path);
        } catch (const std::exception& error) {
            std::fprintf(stderr, "plugin: %s\n", error.what());
            return 1;
        }
    }
    qemu::CallCounter counter(options.entries);
    session = new Session{std::move(options), info->version.cur, std::move(counter), std::move(timing)};
    if (session->timing) {
        session->timing->log_descriptor = open(session->options.times_path.c_str(), O_WRONLY | O_APPEND);
        std::signal(SIGABRT, aborts);
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, translates);
    qemu_plugin_register_atexit_cb(id, ends, nullptr);
    return 0;
}
