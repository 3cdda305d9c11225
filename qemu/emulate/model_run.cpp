#include "qemu/emulate/model_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "glsum/catalogue.hpp"
#include "qemu/emulate/answers.hpp"
#include "qemu/emulate/elf.hpp"
#include "qemu/emulate/software_double.hpp"
#include "qemu/emulate/watched.hpp"
#include "targets/shared/output_hash.hpp"

namespace qemu {
namespace {

using glsum::Exit;
using glsum::Failure;

constexpr std::uint64_t steady_steps = firmware::steady_steps;

bool computes_in_double(const std::string& kernel) {
    const glsum::CatalogueEntry* const entry = glsum::find_kernel(kernel);
    return entry != nullptr && entry->in_double;
}

// Tables and inputs, each kept once however many rows have it.
class Numbers {
public:
    std::string add(std::span<const double> piece) {
        const auto key = std::pair(piece.data(), piece.size());
        const auto [at, fresh] = places_.try_emplace(key, all_.size());
        if (fresh) {
            all_.insert(all_.end(), piece.begin(), piece.end());
        }
        return fmt::format("{} {}", at->second, piece.size());
    }
    [[nodiscard]] const std::vector<double>& all() const { return all_; }

private:
    std::vector<double> all_;
    std::map<std::pair<const double*, std::size_t>, std::size_t> places_;
};

std::string bits(double value) { return fmt::format("{:016x}", std::bit_cast<std::uint64_t>(value)); }

std::string to_line(const PlannedModel& planned, Numbers& numbers) {
    const glsum::ModelDesign& design = *planned.design;
    std::string line =
        fmt::format("{} {} {} {} {} {} {} {} {} {} {} {}", planned.kernel, design.increments ? 1 : 0,
                    design.half_input ? 1 : 0, design.delay, planned.steps, numbers.add(planned.input),
                    bits(design.input), bits(design.constant), bits(design.input_full_scale),
                    bits(design.stored_full_scale), bits(design.output_full_scale), design.tables.size());
    for (const glsum::PastTable& table : design.tables) {
        // A mode is two numbers, and an empty piece lies anywhere.
        static_assert(sizeof(glsum::Mode) == 2 * sizeof(double));
        const std::span<const double> modes{table.modes.empty() ? nullptr : &table.modes[0].decay,
                                            2 * table.modes.size()};
        line += fmt::format(" {} {} {}", bits(table.factor), numbers.add(table.ratios), numbers.add(modes));
    }
    return line + "\n";
}

// The kernels' steps, by name.
std::map<std::string, std::uint32_t> entries_of(const Elf& elf) {
    const auto table = elf.symbol("glsum_watched");
    const auto count = elf.symbol("glsum_watched_count");
    if (!table || !count) {
        throw Failure(Exit::bad_input, fmt::format("{}: expected the symbols glsum_watched and glsum_watched_count",
                                                   elf.path().string()));
    }
    std::map<std::string, std::uint32_t> entries;
    for (std::uint32_t i = 0; i < elf.word(*count); ++i) {
        const std::uint32_t row = *table + 12 * i;
        entries[elf.text(elf.word(row), elf.word(row + 4))] = elf.word(row + 8) & ~1U;
    }
    return entries;
}

// The last of the row's runs; `steps` steps and one on the painted stack, which is left out.
void summarise(MeasuredRow& row, const CallLog& log, std::size_t& run, std::uint64_t& used, std::uint32_t entry,
               std::uint64_t steps) {
    std::uint64_t seen = 0;
    for (std::uint64_t left = steps + 1; left > 0;) {
        if (run == log.runs.size() || log.runs[run].entry != entry) {
            throw Failure(Exit::check_failed, "the instrument saw other steps than the program made");
        }
        const CallRun& now = log.runs[run];
        const std::uint64_t taken = std::min(left, now.calls - used);
        row.first = seen == 0 ? now.counts : row.first;
        const std::uint64_t counted = std::min(seen + taken, steps) - std::min(seen, steps);
        if (counted > 0) {
            row.worst_instructions = std::max(row.worst_instructions, now.counts.instructions);
        }
        // Of these steps, those from steps - 32 on.
        const std::uint64_t steady = std::min(counted, seen + counted - std::min(seen + counted, steps - steady_steps));
        const double share = static_cast<double>(steady) / static_cast<double>(steady_steps);
        row.instructions += share * static_cast<double>(now.counts.instructions);
        row.loads += share * static_cast<double>(now.counts.loads);
        row.stores += share * static_cast<double>(now.counts.stores);
        row.branches += share * static_cast<double>(now.counts.branches);
        seen += taken;
        left -= taken;
        used += taken;
        if (used == now.calls) {
            ++run;
            used = 0;
        }
    }
}

}  // namespace

std::filesystem::path model_elf(const Board& board) {
    const auto path = board.measure_elf.parent_path() / "model.elf";
    if (!std::filesystem::exists(path)) {
        throw Failure(Exit::missing, fmt::format("{}: not found; expected from the firmware's build", path.string()));
    }
    return path;
}

std::vector<MeasuredRow> step_models(const Board& board, std::span<const PlannedModel> plan, const RowDone& done,
                                     const timing::TimingRequest& timing) {
    if (!timing.cores.empty()) {
        (void)timing::cores_of(timing);  // says what is wrong with it here, where it can be said well
    }
    const std::filesystem::path elf_path = model_elf(board);
    const Elf elf(elf_path);
    const auto entries = entries_of(elf);
    const base::Scratch scratch;
    Numbers numbers;
    {
        std::string text = fmt::format("glsum-model-2 {}\n", scratch.file("numbers").string());
        for (const PlannedModel& planned : plan) {
            if (planned.steps < firmware::least_timed_steps) {
                throw Failure(Exit::bad_input,
                              fmt::format("expected at least {} steps to count", firmware::least_timed_steps));
            }
            text += to_line(planned, numbers);
        }
        std::ofstream(scratch.file("plan")) << text;
        std::ofstream binary(scratch.file("numbers"), std::ios::binary);
        binary.write(reinterpret_cast<const char*>(numbers.all().data()),
                     static_cast<std::streamsize>(numbers.all().size() * sizeof(double)));
        std::ofstream watch(scratch.file("watch"));
        for (const auto& [name, entry] : entries) {
            watch << entry << '\n';
        }
        const Marks marked = marks_of(elf);
        std::ofstream(scratch.file("marks")) << fmt::format("{} {} {}\n", marked.row, marked.on, marked.off);
        std::ofstream request(scratch.file("request"));
        timing::write_timing_request(request, for_program(timing, elf));
    }
    Answers answers(plan.size());
    std::vector<MeasuredRow> rows;
    std::string plugin = fmt::format("{},watch={},out={},stream=off", board.plugin.string(),
                                     scratch.file("watch").string(), scratch.file("calls").string());
    if (!timing.cores.empty()) {
        plugin += fmt::format(",marks={},timing={},times={}", scratch.file("marks").string(),
                              scratch.file("request").string(), scratch.file("times").string());
    }
    emulate(board.emulator, elf_path, {scratch.file("plan").string()}, plugin, [&](const std::string& line) {
        if (const auto row = answers.take_measured(line)) {
            rows.push_back(*row);
            done();
        }
    });
    answers.check_complete();
    std::ifstream log_file(scratch.file("calls"));
    const CallLog log = read_call_log(log_file);
    std::ifstream times(scratch.file("times"));
    std::size_t run = 0;
    std::uint64_t used = 0;
    for (std::size_t i = 0; i < plan.size(); ++i) {
        if (rows[i].status != glsum::Status::ok) {
            continue;
        }
        const std::uint32_t entry = entries.at(plan[i].kernel);
        summarise(rows[i], log, run, used, entry, plan[i].steps);
        std::set<const Function*> functions;
        for (const std::uint32_t address : log.reached.at(entry)) {
            functions.insert(elf.function_at(address));
        }
        for (const Function* function : functions) {
            rows[i].code_bytes += function != nullptr ? function->bytes : 0;
        }
        if (!timing.cores.empty()) {
            const timing::TimingLog log_of_row = timing::read_timing_log(times);
            rows[i].cores = modelled_calls(
                log_of_row, firmware::timed_steps(plan[i].steps, computes_in_double(plan[i].kernel)), plan[i].steps,
                timing.cores.size(), rows[i].first.instructions, fmt::format("{} in steps of a model", plan[i].kernel));
            for (const auto& [address, times_met] : log_of_row.unknown) {
                rows[i].unknown_encodings.push_back(address);
            }
        }
    }
    if (run != log.runs.size()) {
        throw Failure(Exit::check_failed, "the instrument saw more steps than the program made");
    }
    return rows;
}

SteppedModel step_model_here(const PlannedModel& planned) {
    SteppedModel stepped{};
    const bool found = glsum::ModelKernels::with(planned.kernel, [&]<class K>() {
        using Stepper = glsum::Stepper<K>;
        std::size_t coefficients = 1;
        std::size_t samples = 1;
        for (const glsum::PastTable& table : planned.design->tables) {
            coefficients += Stepper::table_count(table);
            samples += Stepper::past_count(table);
        }
        std::vector<typename K::Coefficient> table(coefficients);
        std::vector<typename K::Sample> past(samples);
        std::vector<typename K::Sample> line(Stepper::line_count(planned.design->delay));
        typename Stepper::State state{};
        stepped.status = Stepper::prepare(state, *planned.design, table, past, line);
        if (stepped.status != glsum::Status::ok) {
            return;
        }
        firmware::OutputHash hash;
        for (std::size_t k = 0; k <= planned.steps; ++k) {
            const auto output =
                Stepper::step(state, Stepper::from_real(*planned.design, planned.input[k % planned.input.size()]));
            hash.add(output);
            stepped.output.push_back(Stepper::to_real(*planned.design, output));
        }
        stepped.hash = hash.value();
        stepped.saturations = state.saturations;
        stepped.multiplications = Stepper::multiplications(*planned.design);
    });
    if (!found) {
        throw std::out_of_range("no kernel for models is called " + planned.kernel);
    }
    return stepped;
}

}  // namespace qemu
