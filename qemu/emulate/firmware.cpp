#include "qemu/emulate/firmware.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <optional>
#include <set>
#include <stdexcept>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "glsum/catalogue.hpp"
#include "qemu/emulate/answers.hpp"
#include "qemu/emulate/elf.hpp"
#include "qemu/emulate/modelled_calls.hpp"
#include "qemu/emulate/software_double.hpp"
#include "qemu/emulate/watched.hpp"
#include "targets/shared/output_hash.hpp"

namespace qemu {
namespace {

using glsum::Exit;
using glsum::Failure;

constexpr std::size_t steady_calls = 32;

void write_plan(const std::filesystem::path& path, const std::filesystem::path& signals_path,
                std::span<const PlannedRow> plan, const Signals& signals) {
    std::ofstream samples(signals_path, std::ios::binary);
    for (const auto& signal : signals) {
        samples.write(reinterpret_cast<const char*>(signal.data()),
                      static_cast<std::streamsize>(signal.size() * sizeof(double)));
    }
    std::ofstream out(path);
    out << fmt::format("glsum-plan-3 {} {}\n", signals_path.string(), signals.at(0).size());
    for (const PlannedRow& row : plan) {
        out << fmt::format("{} {:016x} {} {} {} {} {} {}", row.kernel, std::bit_cast<std::uint64_t>(row.order),
                           row.taps, row.signal, row.calls, row.blocks.count, row.blocks.per_level, row.modes.size());
        for (const glsum::Mode& mode : row.modes) {
            out << fmt::format(" {:016x} {:016x}", std::bit_cast<std::uint64_t>(mode.decay),
                               std::bit_cast<std::uint64_t>(mode.weight));
        }
        out << '\n';
    }
    if (!samples.flush() || !out.flush()) {
        throw Failure(Exit::check_failed, fmt::format("{}: cannot write", path.parent_path().string()));
    }
}

// The loops of targets/firmware/check_loops.S, whose counts its comment derives.
struct KnownLoop {
    const char* name;
    CallCounts per_turn;
    CallCounts once;
};
constexpr KnownLoop known_loops[] = {
    {"glsum_check_steps", {4, 1, 1, 1}, {1, 0, 0, 1}},    {"glsum_check_one_more", {4, 1, 1, 1}, {2, 0, 0, 1}},
    {"glsum_check_multiple", {4, 4, 4, 1}, {3, 2, 2, 1}}, {"glsum_check_wide", {8, 7, 7, 1}, {1, 0, 0, 1}},
    {"glsum_check_edge", {4, 1, 1, 1}, {3, 0, 0, 1}},     {"glsum_check_skipped", {5, 0, 0, 1}, {1, 0, 0, 1}},
    {"glsum_check_nested", {6, 1, 1, 3}, {3, 2, 2, 1}},
};
constexpr std::uint64_t known_turns[] = {1, 10, 1000};

std::string to_text(const CallCounts& counts) {
    return fmt::format("{} instructions, {} loads, {} stores, {} branches", counts.instructions, counts.loads,
                       counts.stores, counts.branches);
}

struct Watch {
    explicit Watch(const Elf& elf) : kernels(watched_kernels(elf)), marks(marks_of(elf)) {
        for (const KnownLoop& loop : known_loops) {
            loops.push_back(address_of(elf, loop.name));
        }
    }
    std::vector<std::uint32_t> loops;
    std::map<std::string, WatchedKernel> kernels;
    Marks marks;
};

// The log's runs, taken call by call in the order in which the program made them.
class Calls {
public:
    explicit Calls(const CallLog& log) : log_(log) {}

    /// The next `count` calls, which must be of this function, as runs.
    std::vector<CallRun> take(std::uint32_t entry, std::uint64_t count) {
        std::vector<CallRun> taken;
        while (count > 0) {
            if (run_ == log_.runs.size() || log_.runs[run_].entry != entry) {
                throw Failure(Exit::check_failed, "the instrument saw other calls than the program made");
            }
            CallRun part = log_.runs[run_];
            part.calls = std::min(count, part.calls - used_);
            count -= part.calls;
            used_ += part.calls;
            if (used_ == log_.runs[run_].calls) {
                ++run_;
                used_ = 0;
            }
            taken.push_back(part);
        }
        return taken;
    }
    [[nodiscard]] bool empty() const { return run_ == log_.runs.size(); }

private:
    const CallLog& log_;
    std::size_t run_ = 0;
    std::uint64_t used_ = 0;
};

void check_instrument(Calls& calls, const Watch& watch) {
    for (std::size_t i = 0; i < watch.loops.size(); ++i) {
        const KnownLoop& loop = known_loops[i];
        for (const std::uint64_t turns : known_turns) {
            const CallCounts expected{loop.per_turn.instructions * turns + loop.once.instructions,
                                      loop.per_turn.loads * turns + loop.once.loads,
                                      loop.per_turn.stores * turns + loop.once.stores,
                                      loop.per_turn.branches * turns + loop.once.branches};
            const CallCounts found = calls.take(watch.loops[i], 1).front().counts;
            if (found != expected) {
                throw Failure(Exit::check_failed,
                              fmt::format("the instrument miscounts: {} with {} turns: expected {}; found {}",
                                          loop.name, turns, to_text(expected), to_text(found)));
            }
        }
    }
}

std::size_t code_bytes(const Elf& elf, const std::set<std::uint32_t>& reached) {
    std::set<const Function*> functions;
    for (const std::uint32_t address : reached) {
        functions.insert(elf.function_at(address));
    }
    std::size_t bytes = 0;
    for (const Function* function : functions) {
        bytes += function != nullptr ? function->bytes : 0;
    }
    return bytes;
}

void summarise(MeasuredRow& row, Calls& calls, std::uint32_t entry, const firmware::TimedCalls& made) {
    row.first = calls.take(entry, 1).front().counts;
    calls.take(entry, made.taps);  // the past fills
    std::size_t seen = 0;
    for (const CallRun& run : calls.take(entry, made.turn())) {
        row.worst_instructions = std::max(row.worst_instructions, run.counts.instructions);
        const auto share =
            static_cast<double>(std::min<std::uint64_t>(run.calls, steady_calls - std::min(seen, steady_calls))) /
            static_cast<double>(steady_calls);
        row.instructions += share * static_cast<double>(run.counts.instructions);
        row.loads += share * static_cast<double>(run.counts.loads);
        row.stores += share * static_cast<double>(run.counts.stores);
        row.branches += share * static_cast<double>(run.counts.branches);
        seen += run.calls;
    }
    calls.take(entry, 1);  // the one on the painted stack
}

bool computes_in_double(const std::string& kernel) {
    const glsum::CatalogueEntry* entry = glsum::find_kernel(kernel);
    return entry != nullptr && entry->in_double;
}

}  // namespace

Board find_board(const std::filesystem::path& build, const std::filesystem::path& plugin,
                 const std::filesystem::path& emulate) {
    Board board{build / "targets" / "measure.elf", build / "targets" / "replay.elf", plugin, {emulate}, {}};
    for (const auto& file : {board.measure_elf, board.replay_elf, board.plugin, board.emulator.command}) {
        if (!std::filesystem::exists(file)) {
            const std::string preset = file == board.plugin ? "host" : build.filename().string();
            throw Failure(
                Exit::missing,
                fmt::format("{}: not found; expected from `cmake --preset {}` and `cmake --build --preset {}`",
                            file.string(), preset, preset));
        }
    }
    return board;
}

firmware::TimedCalls timed_calls(const std::string& kernel, std::size_t taps) {
    return {taps, computes_in_double(kernel)};
}

std::size_t calls_to_measure(const std::string& kernel, std::size_t taps) { return timed_calls(kernel, taps).calls(); }

std::size_t calls_hashed(const std::string& kernel, std::size_t calls) {
    const glsum::CatalogueEntry* entry = glsum::find_kernel(kernel);
    return calls + 1 + (entry != nullptr && entry->in_halves ? firmware::calls_in_halves : 0);
}

ReplayedRow replay_here(const PlannedRow& row, const Signals& signals) {
    const auto& signal = signals.at(row.signal);
    ReplayedRow result{};
    const bool found = glsum::Registry::with(row.kernel, [&]<class K>() {
        std::vector<typename K::Coefficient> table(glsum::table_needed<K>(row.design()));
        std::vector<typename K::Sample> past(glsum::past_needed<K>(row.design()));
        typename K::State state{};
        result.status = K::prepare(state, row.design(), table, past);
        if (result.status != glsum::Status::ok) {
            return;
        }
        firmware::OutputHash hash;
        for (std::size_t k = 0; k < row.calls; ++k) {
            hash.add(K::step(state, K::from_real(signal[k % signal.size()])));
        }
        result.hash = hash.value();
    });
    if (!found) {
        throw std::out_of_range("no kernel " + row.kernel);
    }
    return result;
}

std::vector<ReplayedRow> replay(const Board& board, std::span<const PlannedRow> plan, const Signals& signals,
                                const RowDone& done) {
    const base::Scratch scratch;
    write_plan(scratch.file("plan"), scratch.file("signals"), plan, signals);
    Answers answers(plan.size());
    std::vector<ReplayedRow> rows;
    emulate(board.emulator, board.replay_elf, {scratch.file("plan").string()}, "", [&](const std::string& line) {
        if (const auto row = answers.take_replayed(line)) {
            rows.push_back(*row);
            done();
        }
    });
    answers.check_complete();
    return rows;
}

std::vector<MeasuredRow> measure(const Board& board, std::span<const PlannedRow> plan, const Signals& signals,
                                 const RowDone& done, Counting counting, const timing::TimingRequest& timing) {
    if (!timing.cores.empty()) {
        (void)timing::cores_of(timing);  // says what is wrong with it here, where it can be said well
    }
    const Elf elf(board.measure_elf);
    const Watch watch(elf);
    const base::Scratch scratch;
    write_plan(scratch.file("plan"), scratch.file("signals"), plan, signals);
    {
        std::ofstream list(scratch.file("watch"));
        for (const std::uint32_t loop : watch.loops) {
            list << loop << '\n';
        }
        for (const auto& [name, kernel] : watch.kernels) {
            list << kernel.step << '\n';
            if (kernel.answer != 0) {
                list << kernel.answer << '\n';
            }
        }
        std::ofstream marks(scratch.file("marks"));
        marks << fmt::format("{} {} {}\n", watch.marks.row, watch.marks.on, watch.marks.off);
        std::ofstream request(scratch.file("request"));
        timing::write_timing_request(request, for_program(timing, elf));
        if (!list.flush() || !marks.flush() || !request.flush()) {
            throw Failure(Exit::check_failed, fmt::format("{}: cannot write", scratch.file("").string()));
        }
    }
    Answers answers(plan.size());
    std::vector<MeasuredRow> rows;
    std::string plugin =
        fmt::format("{},watch={},out={},stream={}", board.plugin.string(), scratch.file("watch").string(),
                    scratch.file("calls").string(), counting == Counting::stream ? "on" : "off");
    if (!timing.cores.empty()) {
        plugin += fmt::format(",marks={},timing={},times={}", scratch.file("marks").string(),
                              scratch.file("request").string(), scratch.file("times").string());
    }
    emulate(board.emulator, board.measure_elf, {scratch.file("plan").string()}, plugin, [&](const std::string& line) {
        if (const auto row = answers.take_measured(line)) {
            rows.push_back(*row);
            done();
        }
    });
    answers.check_complete();

    std::ifstream log_file(scratch.file("calls"));
    const CallLog log = read_call_log(log_file);
    Calls calls(log);
    check_instrument(calls, watch);
    std::ifstream times(scratch.file("times"));
    for (std::size_t i = 0; i < plan.size(); ++i) {
        if (rows[i].status == glsum::Status::ok) {
            const auto [entry, answer] = watch.kernels.at(plan[i].kernel);
            const std::size_t halves = answer != 0 ? firmware::calls_in_halves : 0;
            const firmware::TimedCalls made = timed_calls(plan[i].kernel, plan[i].taps);
            summarise(rows[i], calls, entry, made);
            calls.take(answer, halves);
            const auto reached = log.reached.find(entry);
            if (reached == log.reached.end()) {
                throw Failure(Exit::check_failed, "the instrument saw no instruction of " + plan[i].kernel);
            }
            rows[i].code_bytes = code_bytes(elf, reached->second);
            if (!timing.cores.empty()) {
                const timing::TimingLog log_of_row = timing::read_timing_log(times);
                rows[i].cores =
                    modelled_calls(log_of_row, made, plan[i].calls, timing.cores.size(), rows[i].first.instructions,
                                   fmt::format("{} with {} taps", plan[i].kernel, plan[i].taps), halves);
                for (const auto& [address, times_met] : log_of_row.unknown) {
                    rows[i].unknown_encodings.push_back(address);
                }
            }
        }
    }
    if (!calls.empty()) {
        throw Failure(Exit::check_failed, "the instrument saw more calls than the program made");
    }
    return rows;
}

}  // namespace qemu
