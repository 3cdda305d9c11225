// glsum bench: accuracy of every kernel, its cost on the host and on the emulated Cortex-M7.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <thread>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/nearest_name.hpp"
#include "bench/run/run.hpp"
#include "bench/run/usual_sweep.hpp"
#include "bench/target/target_rows.hpp"
#include "cli/board.hpp"
#include "cli/checks.hpp"
#include "cli/command.hpp"
#include "cli/finish_run.hpp"
#include "glsum/catalogue.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

struct Options {
    bool quick = false;
    std::vector<std::string> kernels{"*"};
    std::vector<double> orders;
    std::vector<std::string> taps;
    std::vector<std::string> signals;
    std::vector<std::string> targets;  ///< empty: all that the rest of the request can be measured on
    std::vector<std::string> cores;    ///< empty: counts, and the fastest core of each emulated machine
    std::string weights{bench::discretisation_names.front()};
    std::optional<std::string> shard;
    std::optional<unsigned> repetitions;
    unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
    std::filesystem::path out;
    std::string table;
};

std::vector<std::string> targets_of(const Options& options) {
    if (!options.targets.empty()) {
        return options.targets;
    }
    const auto weights = bench::parse_discretisation(options.weights);
    return weights && bench::names_weights(*weights) ? std::vector<std::string>{"host"} : bench::Sweep().targets;
}

bench::Discretisation to_weights(const Options& options) {
    const auto weights = bench::parse_discretisation(options.weights);
    if (!weights) {
        throw Failure(Exit::bad_input, fmt::format("--weights: expected one of {}, found {}",
                                                   fmt::join(bench::discretisation_names, ", "), options.weights));
    }
    if (bench::names_weights(*weights) && std::ranges::any_of(options.targets, [](const auto& target) {
            return base::machine_called(target) != nullptr;
        })) {
        throw Failure(Exit::bad_input,
                      fmt::format("--weights {}: only with --targets host; what the emulated target is told to run "
                                  "names an order, no weights",
                                  options.weights));
    }
    return *weights;
}

// Takes those off the sweep that cannot sum its weights, and says so.
void leave_out(bench::Sweep& sweep) {
    const auto by_reason = bench::leave_out_unserved(sweep);
    if (by_reason.empty()) {
        return;
    }
    std::string text;
    for (const auto& [reason, kernels] : by_reason) {
        text += fmt::format("{}{} ({})", text.empty() ? "" : "; ", fmt::join(kernels, ", "), reason);
    }
    fmt::print(stderr, "glsum bench: --weights {} leaves out {}\n", to_text(sweep.weights), text);
    if (sweep.kernels.empty() && sweep.peers.empty()) {
        throw Failure(Exit::bad_input,
                      fmt::format("--weights {}: none of the kernels can sum them", to_text(sweep.weights)));
    }
}

bench::Sweep to_sweep(const Options& options) {
    bench::Sweep sweep = bench::usual_sweep(options.quick);
    sweep.weights = to_weights(options);
    sweep.jobs = options.jobs;
    sweep.repetitions = options.repetitions.value_or(1);
    if (!options.orders.empty()) {
        sweep.orders = options.orders;
    }
    check_orders(sweep.orders);
    if (!options.taps.empty()) {
        sweep.lengths = bench::lengths_of(options.taps, sweep.samples);
    }
    if (!options.signals.empty()) {
        sweep.signals = options.signals;
    }
    check_signals(sweep.signals);
    sweep.targets = targets_of(options);
    check_targets(sweep.targets);
    take_cores(sweep, options.cores);
    bench::take_kernels(sweep, options.kernels);
    if (sweep.kernels.empty() && sweep.peers.empty()) {
        throw Failure(
            Exit::bad_input,
            fmt::format("--kernels: no kernel is called {}; the nearest is {}", fmt::join(options.kernels, ", "),
                        base::nearest_name(options.kernels.front(), glsum::catalogue, &glsum::CatalogueEntry::name)));
    }
    leave_out(sweep);
    return sweep;
}

std::vector<qemu::Board> boards_of(const bench::Sweep& sweep) {
    std::vector<qemu::Board> boards;
    for (const base::Machine* machine : sweep.machines()) {
        boards.push_back(built_board(*machine));
    }
    return boards;
}

std::filesystem::path default_out(const std::optional<bench::Shard>& shard) {
    // Not latest.json: what reads that expects a whole run.
    return results_folder() / (shard ? fmt::format("shard-{}-of-{}.json", shard->index, shard->count) : "latest.json");
}

void run(const Options& options, const std::vector<std::string>& flags) {
    const bench::Sweep sweep = to_sweep(options);
    const std::optional<bench::Shard> shard =
        options.shard ? std::optional(bench::parse_shard(*options.shard)) : std::nullopt;
    const std::filesystem::path out = options.out.empty() ? default_out(shard) : options.out;
    base::check_writable(out);
    const bench::Results results = bench::measure(sweep, shard, boards_of(sweep), flags);
    if (!shard) {
        finish_run(out, results, sweep.jobs, options.table);
        return;
    }
    bench::write_results(out, results.context, results.rows);
    fmt::print("{} rows of shard {}/{} in {}; glsum merge puts all shards together\n", results.rows.size(),
               shard->index, shard->count, out.string());
    check_rows(results);
}

}  // namespace

void add_options(Command& command, const Words& words) {
    auto options = std::make_shared<Options>();
    command.footer(
        "Flags --benchmark_... go to Google Benchmark.\n"
        "With --derivative-error it is `bench derivative`: what each kernel needs for the derivative itself.\n"
        "Example: glsum bench --quick --kernels 'ring_*' --orders 0.5,-0.5 --taps 100,full --out my.json");
    command.add_flag("--quick", options->quick, "1000 samples, 4 orders, 5 lengths");
    command.add_option("--kernels", options->kernels, "Globs of kernel names").delimiter(',').capture_default_str();
    command.add_option("--orders", options->orders, "Orders v in (-2, 2]").within(-2, 2).delimiter(',');
    command
        .add_option("--taps", options->taps,
                    "Lengths: numbers, full (as many as the record has samples), and of kernels with modes 2+7: two "
                    "taps and seven modes (default of these: the shortest that keep 1e-2, 1e-3, 1e-4 and 1e-6; quick: "
                    "1e-4 alone)")
        .delimiter(',');
    command.add_option("--signals", options->signals, "Records: step, ramp, sine1, sine5, sine50, noise, drive")
        .delimiter(',');
    command
        .add_option("--targets", options->targets,
                    "host, m7, m4 (default: host,m7; with --weights that name their own, host)")
        .delimiter(',');
    command
        .add_option(
            "--core", options->cores,
            fmt::format("Cores of the timing model, files of qemu/cores; count: instructions alone. One emulation "
                        "serves all of a machine (default: count, {})",
                        fmt::join(default_cores(), ", ")))
        .delimiter(',');
    command
        .add_option("--weights", options->weights,
                    "Which weights the kernels sum: gl, bdf2, bdf3, bdf4 (of that order for signals that start "
                    "smoothly), or shifted: those of gl, for the derivative v h / 2 earlier")
        .capture_default_str();
    command.add_option("--shard", options->shard,
                       "I/N: measure one of N parts of about equal cost; merge puts them together. The last times the "
                       "host. Writes results/shard-I-of-N.json unless --out is given, and nothing beside it");
    command
        .add_option("--repetitions", options->repetitions,
                    "Time each kernel so often, 2 ms each, all in random turns: what gate and compare judge by")
        .between(1, 10000);
    command.add_option("--jobs", options->jobs, "Threads and emulators at once").between(1, 1024);
    command.add_option("--out", options->out,
                       "Result file (default: results/latest.json); -times.json (rows with a time), .csv (a row each), "
                       "-tidy.csv (a number each), .svg and .png are written beside it");
    add_table_option(command, options->table);
    command.callback([options, &words] { run(*options, words.passed_on); });
}

}  // namespace cli
