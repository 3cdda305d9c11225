// glsum gate: holds a run against a baseline, for continuous integration.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/scratch.hpp"
#include "base/sha256.hpp"
#include "bench/gate/baseline.hpp"
#include "bench/gate/gate.hpp"
#include "bench/gate/outputs.hpp"
#include "cli/command.hpp"
#include "cli/timed_elf.hpp"
#include "qemu/emulate/foreign_program.hpp"
#include "qemu/emulate/function_gate.hpp"

namespace cli {
namespace {

using bench::gate::Verdict;
using glsum::Exit;
using glsum::Failure;

const std::filesystem::path results_folder = std::filesystem::path(build_info::source_folder) / "results";

struct Options {
    std::filesystem::path baseline;
    std::filesystem::path current = results_folder / "latest.json";
    std::filesystem::path thresholds = results_folder / "thresholds.toml";
    bool annotations = false;
    bool update = false;
    std::string reason;
    std::vector<std::string> rows;
    TimedElf timed;  // of functions in place of rows
    std::vector<std::string> functions;
};

// An output that goes to a file where one is named and to standard output where none is.
struct Output {
    std::optional<Option> option;
    std::string file;
    std::string (*text)(const Verdict&) = nullptr;
};

Verdict judge(const Options& options) {
    const bench::gate::Rules rules = bench::gate::read_rules(options.thresholds);
    const bench::Results baseline = bench::read_results(options.baseline);
    const bench::Results current = bench::read_results(options.current);
    return bench::gate::judge(baseline, current, rules);
}

// Of the baseline's neighbours whose names begin as its own, m7-gnu14.json beside m7.json: one that the run can be held
// against; empty where none can.
std::string comparable_neighbour(Options options) {
    const std::filesystem::path asked = options.baseline;
    std::vector<std::filesystem::path> neighbours;
    for (const auto& entry : std::filesystem::directory_iterator(asked.has_parent_path() ? asked.parent_path() : ".")) {
        if (entry.path().filename() != asked.filename() && entry.path().extension() == ".json" &&
            entry.path().stem().string().starts_with(asked.stem().string() + "-")) {
            neighbours.push_back(entry.path());
        }
    }
    std::sort(neighbours.begin(), neighbours.end());
    for (const std::filesystem::path& neighbour : neighbours) {
        options.baseline = neighbour;
        try {
            if (judge(options).status != Exit::not_comparable) {
                return neighbour.string();
            }
        } catch (const Failure&) {  // a broken one is none
        }
    }
    return "";
}

// Where two core files model other cycles of the same instructions, what is left to do; else empty.
std::string way_on(const Verdict& verdict) {
    const bool other_core = std::any_of(verdict.differences.begin(), verdict.differences.end(),
                                        [](const auto& one) { return one.field.starts_with("core_file"); });
    return !other_core
               ? ""
               : "; to go on: model the baseline's commit with this core file, and hold this run against that; or "
                 "record this run by --update-baseline --reason TEXT";
}

void update_baseline(const Options& options) {
    if (options.reason.find_first_not_of(" \t\n") == std::string::npos) {
        throw Failure(Exit::bad_input, "--update-baseline: expected --reason TEXT, which the baseline's history keeps");
    }
    const bench::Results current = bench::read_results(options.current);
    bench::Json previous = bench::Json::object();
    std::vector<std::string> rows = options.rows.empty() ? std::vector<std::string>{"*"} : options.rows;
    std::string changed = "first recording";
    if (std::filesystem::exists(options.baseline)) {
        previous = bench::read_results(options.baseline).context;
        if (options.rows.empty()) {
            rows = bench::gate::selection_of(previous);
        }
        Verdict verdict = judge(options);
        verdict.baseline_name = options.baseline.string();
        verdict.current_name = options.current.string();
        fmt::print("{}", bench::gate::to_table(verdict, isatty(STDOUT_FILENO) == 1));
        changed = bench::gate::summary_of_changes(verdict);
    }
    const bench::Results baseline = bench::gate::make_baseline(current, rows, previous, options.reason, changed);
    bench::gate::write_baseline(options.baseline, baseline);
    fmt::print("\n{}: {} rows recorded; changed: {}\n", options.baseline.string(), baseline.rows.size(), changed);
}

qemu::GatedProgram gated_program(const Options& options) {
    const qemu::Elf elf(options.timed.elf);
    const timing::TimingRequest request = to_request(options.timed, elf);
    const timing::CoreFile core = timing::cores_of(request).front();
    qemu::check_runs_on_board(elf);
    const std::vector<qemu::Function> functions = elf.functions_like(options.functions);
    const std::vector<timing::TimingLog> logs = time_functions(options.timed, functions, request, true);
    std::string placed = core.text + timing::name_of(core.placement.code) + timing::name_of(core.placement.data);
    for (const timing::PlacedRange& range : core.placement.ranges) {
        placed += timing::name_of(range.place);  // addresses move with the program
    }
    const base::Scratch scratch;
    base::write_file(scratch.file("core"), placed);
    qemu::GatedProgram program{
        base::sha256_of(options.timed.elf), core.name, base::sha256_of(scratch.file("core")), {}};
    for (std::size_t f = 0; f < functions.size(); ++f) {
        program.functions.push_back(qemu::gated_function(
            functions[f], elf, logs[f].runs.empty() ? std::nullopt : std::optional(qemu::function_time(logs[f]))));
    }
    std::sort(program.functions.begin(), program.functions.end(),
              [](const auto& a, const auto& b) { return a.name < b.name; });
    return program;
}

// Functions of anybody's program in place of the rows of a run.
void run_functions(const Options& options) {
    constexpr std::size_t most_bytes = 64U << 20;
    if (options.update && options.reason.find_first_not_of(" \t\n") == std::string::npos) {
        throw Failure(Exit::bad_input, "--update-baseline: expected --reason TEXT, which the baseline keeps");
    }
    if (!options.update && !std::filesystem::exists(options.baseline)) {
        throw Failure(Exit::bad_input, fmt::format("{}: no such baseline; --update-baseline --reason TEXT records one",
                                                   options.baseline.string()));
    }
    const qemu::GatedProgram now = gated_program(options);
    if (options.update) {
        base::write_file(options.baseline, qemu::to_json(now, options.reason));
        fmt::print("{}: {} functions recorded\n", options.baseline.string(), now.functions.size());
        return;
    }
    const qemu::GatedProgram before =
        qemu::parse_gated_program(base::read_file(options.baseline, most_bytes), options.baseline.string());
    std::string worse;
    const std::vector<qemu::FunctionChange> changes = qemu::changes(before, now);
    for (const qemu::FunctionChange& change : changes) {
        fmt::print("{:<6} {}: {}\n", change.worse ? "worse" : "passes", change.name, change.text);
        worse += change.worse ? (worse.empty() ? "" : ", ") + change.name : "";
    }
    fmt::print("{} functions on {}, {} changed\n", now.functions.size(), now.core, changes.size());
    if (!worse.empty()) {
        throw Failure(Exit::check_failed, "gate: worse: " + worse);
    }
}

void run(const Options& options, const std::vector<Output>& outputs) {
    if (!options.timed.elf.empty()) {
        for (const Output& output : outputs) {
            if (output.option->given() || options.annotations) {
                throw Failure(Exit::bad_input,
                              "--elf: expected no --json, --junit, --markdown or --annotations beside it");
            }
        }
        run_functions(options);
        return;
    }
    if (options.update) {
        update_baseline(options);
        return;
    }
    Verdict verdict;
    std::string failure;
    try {
        verdict = judge(options);
    } catch (const Failure& refused) {
        // A gate that cannot judge must not look like one that did not run: the outputs say why.
        verdict.status = refused.status();
        verdict.refusal = refused.what();
    }
    verdict.baseline_name = options.baseline.string();
    verdict.current_name = options.current.string();
    bool to_stdout = false;
    for (const Output& output : outputs) {
        if (!output.option->given()) {
            continue;
        }
        if (output.file.empty()) {
            to_stdout = true;
            fmt::print("{}", output.text(verdict));
        } else {
            base::write_file(output.file, output.text(verdict));
        }
    }
    if (!to_stdout && verdict.refusal.empty()) {
        fmt::print("{}", bench::gate::to_table(verdict, isatty(STDOUT_FILENO) == 1));
    }
    if (options.annotations) {
        fmt::print("{}", bench::gate::to_annotations(verdict));
    }
    if (verdict.status != Exit::good) {
        const std::string word = verdict.refusal.empty() ? "gate: " + verdict.word() + ": " : "";
        const std::string neighbour =
            verdict.status == Exit::not_comparable && verdict.refusal.empty() ? comparable_neighbour(options) : "";
        throw Failure(
            verdict.status,
            word + verdict.headline() + (neighbour.empty() ? way_on(verdict) : "; " + neighbour + " can be compared"));
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    auto outputs = std::make_shared<std::vector<Output>>(3);
    command.footer(
        "Layers: rows, right answer, accuracy, instructions and bytes, modelled cycles, host time.\n"
        "Exit status: 0 pass, 1 worse, 2 a file is broken, 4 the two runs cannot be compared.\n"
        "With --elf the cycles, instructions, code and stack of a program's functions are held to a baseline that\n"
        "--update-baseline recorded of an earlier build: any growth is worse.\n"
        "Example: glsum gate --baseline results/baselines/m7.json --current my.json --junit gate.xml\n"
        "Example: glsum gate --elf app.elf --functions 'ctrl_*' --baseline app.json");
    command.add_option("--baseline", options->baseline, "What to hold the run against").required();
    command.add_option("--current", options->current, "The run's result file").default_str("results/latest.json");
    command.add_option("--thresholds", options->thresholds, "Rules: what may change by how much, and why")
        .default_str("results/thresholds.toml");
    const auto add_output = [&](std::size_t i, const char* name, const char* help,
                                std::string (*text)(const Verdict&)) {
        Output& output = (*outputs)[i];
        output.text = text;
        output.option = command.add_option(name, output.file, help).expected(0, 1).type_name("[FILE]");
    };
    add_output(0, "--json", "Everything, for programs; to standard output without FILE", bench::gate::to_json);
    add_output(1, "--junit", "Test report, likewise", bench::gate::to_junit);
    add_output(2, "--markdown", "Step summary, likewise", bench::gate::to_markdown);
    command.add_flag("--annotations", options->annotations, "GitHub annotations on standard output");
    Option update = command.add_flag("--update-baseline", options->update,
                                     "Record the run as the new baseline instead (needs --reason)");
    command.add_option("--reason", options->reason, "Why the baseline changes: kept in its history").needs(update);
    command
        .add_option("--rows", options->rows, "Globs of the rows that a new baseline keeps (default: as before, or all)")
        .delimiter(',')
        .needs(update);
    Option elf = command.add_option("--elf", options->timed.elf, "Holds functions of this program to the baseline");
    Option functions = command.add_option("--functions", options->functions, "Globs of their names");
    functions.delimiter(',').needs(elf);
    elf.needs(functions);
    add_timing_options(command, options->timed);
    command.callback([options, outputs] { run(*options, *outputs); });
}

}  // namespace cli
