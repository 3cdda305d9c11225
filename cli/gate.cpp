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
#include "bench/gate/baseline.hpp"
#include "bench/gate/gate.hpp"
#include "bench/gate/outputs.hpp"
#include "cli/command.hpp"
#include "cli/gate_functions.hpp"
#include "cli/output.hpp"

namespace cli {
namespace {

using bench::gate::Verdict;
using glsum::Exit;
using glsum::Failure;

const std::filesystem::path results_folder = std::filesystem::path(build_info::source_folder) / "results";

struct Options {
    std::filesystem::path baseline;
    std::string target;  // whose own baseline is meant
    std::filesystem::path current = results_folder / "latest.json";
    std::filesystem::path thresholds = results_folder / "thresholds.toml";
    bool annotations = false;
    bool update = false;
    std::string reason;
    std::vector<std::string> rows;
    TimedElf timed;  // of functions in place of rows
    std::vector<std::string> functions;
};

struct Written {
    Output output;
    std::string (*text)(const Verdict&) = nullptr;
};

std::filesystem::path baseline_of(const Options& options) {
    if (options.baseline.empty() == options.target.empty()) {
        throw Failure(Exit::bad_input, options.target.empty()
                                           ? "--baseline or --target is required"
                                           : "--target: the baseline that --baseline names is another");
    }
    if (options.target.empty()) {
        return options.baseline;
    }
    const std::filesystem::path own = results_folder / "baselines" / (options.target + ".json");
    if (!std::filesystem::exists(own)) {
        throw Failure(Exit::bad_input, fmt::format("--target: expected one that results/baselines has a baseline of, "
                                                   "as host, found {}",
                                                   options.target));
    }
    return own;
}

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

bool goes_to_stdout(const std::vector<Written>& outputs) {
    return std::any_of(outputs.begin(), outputs.end(), [](const Written& one) { return one.output.to_stdout(); });
}

void write(const Verdict& verdict, const std::vector<Written>& outputs) {
    for (const Written& one : outputs) {
        if (one.output.wanted()) {
            one.output.write(one.text(verdict));
        }
    }
}

void annotate(const Verdict& verdict, const Options& options) {
    if (options.annotations) {
        fmt::print("{}", bench::gate::to_annotations(verdict));
    }
}

void run(Options options, const std::vector<Written>& outputs) {
    options.baseline = baseline_of(options);
    if (!options.timed.elf.empty()) {
        gate_functions(
            {options.timed, options.functions, options.baseline, options.update, options.reason},
            [&](const Verdict& verdict) { write(verdict, outputs), annotate(verdict, options); },
            !goes_to_stdout(outputs));
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
    write(verdict, outputs);
    if (!goes_to_stdout(outputs) && verdict.refusal.empty()) {
        fmt::print("{}", bench::gate::to_table(verdict, isatty(STDOUT_FILENO) == 1));
    }
    annotate(verdict, options);
    if (verdict.status != Exit::good) {
        const std::string word = verdict.refusal.empty() ? "gate: " + verdict.word() + ": " : "";
        const std::string neighbour =
            verdict.status == Exit::not_comparable && verdict.refusal.empty() ? comparable_neighbour(options) : "";
        throw Failure(verdict.status,
                      word + verdict.headline() +
                          (neighbour.empty() ? bench::gate::way_on(verdict) : "; " + neighbour + " can be compared"));
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    auto outputs = std::make_shared<std::vector<Written>>(3);
    command.footer(
        "Layers: rows, right answer, accuracy, instructions and bytes, modelled cycles, host time.\n"
        "Exit status: 0 pass, 1 worse, 2 a file is broken, 4 the two runs cannot be compared.\n"
        "With --elf the cycles, instructions, code and stack of a program's functions are held to a baseline that\n"
        "--update-baseline recorded of an earlier build: any growth is worse.\n"
        "Example: glsum gate --baseline results/baselines/m7.json --current my.json --junit gate.xml\n"
        "Example: glsum gate --target host --current my.json\n"
        "Example: glsum gate --elf app.elf --functions 'ctrl_*' --baseline app.json");
    command.add_option("--baseline", options->baseline, "What to hold the run against");
    command.add_option("--target", options->target,
                       "Against this project's own baseline of it: results/baselines/TARGET.json");
    command.add_option("--current", options->current, "The run's result file").default_str("results/latest.json");
    command.add_option("--thresholds", options->thresholds, "Rules: what may change by how much, and why")
        .default_str("results/thresholds.toml");
    const auto add_output = [&](std::size_t i, const char* name, const char* help,
                                std::string (*text)(const Verdict&)) {
        (*outputs)[i].text = text;
        (*outputs)[i].output.add_to(command, name, help);
    };
    add_output(0, "--json", "Everything, for programs", bench::gate::to_json);
    add_output(1, "--junit", "Test report", bench::gate::to_junit);
    add_output(2, "--markdown", "Step summary", bench::gate::to_markdown);
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
