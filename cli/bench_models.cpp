// glsum bench models: whole models stepped in real time, on this machine and on emulated ones.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "bench/rows/result_file.hpp"
#include "bench/studies/models.hpp"
#include "bench/sweep/sweep.hpp"
#include "cli/board.hpp"
#include "cli/checks.hpp"
#include "cli/command.hpp"
#include "qemu/emulate/model_run.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

struct Options {
    bench::Models wanted;
    std::vector<std::string> taps;   ///< numbers, full, or 2+7 of kernels with modes; empty: the usual ones
    std::vector<std::string> cores;  ///< of the timing model; empty: the usual ones
    std::filesystem::path out = results_folder() / "drive.json";
};

bench::ModelLengths asked_lengths(const Options& options) {
    bench::ModelLengths lengths;
    for (const std::string& word : options.taps) {
        const auto length = bench::parse_length(word, bench::model_response_steps + 1);
        if (!length || length->taps > bench::model_response_steps + 1) {
            throw Failure(Exit::bad_input, fmt::format("--taps: expected numbers of 1 to {}, full, or of kernels with "
                                                       "modes 2+7, found {}",
                                                       bench::model_response_steps, word));
        }
        lengths.push_back(length->full ? std::nullopt
                                       : std::optional(drive::Memory{length->taps, length->modes.value_or(0)}));
    }
    return lengths;
}

void run(Options options) {
    bench::Models& wanted = options.wanted;
    bench::Sweep sweep;
    sweep.targets = wanted.targets;
    take_cores(sweep, options.cores);
    for (const base::Machine* machine : sweep.machines()) {
        std::vector<std::string> cores = sweep.cores_on(*machine);
        std::erase(cores, bench::count_only);
        wanted.boards.push_back({built_board(*machine), std::move(cores)});
        (void)qemu::model_elf(wanted.boards.back().board);
    }
    wanted.models = std::filesystem::path(build_info::source_folder) / "drive" / "models";
    wanted.lengths = asked_lengths(options);
    const bench::Study study =
        bench::measure_models(wanted, [](const std::string& what) { fmt::print(stderr, "{}\n", what); });
    fmt::print("{}", study.text);
    bench::write_results(options.out, study.context, study.rows);
    fmt::print("\n{} rows in {}\n", study.rows.size(), options.out.string());
    if (study.wrong > 0) {
        throw Failure(Exit::check_failed, fmt::format("{} rows are wrong or impossible; they are marked", study.wrong));
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    options->wanted.jobs = std::max(1U, std::thread::hardware_concurrency());
    command.footer(
        "bench --drive is the same command.\n"
        "Example: glsum bench models --kernels 'modes*,*delta_*f32' --taps 2+7,5+11,600,full");
    command.add_flag("--drive").hidden();
    command.add_flag("--quick", options->wanted.quick, "Fewer lengths, and no records of an hour");
    command.add_option("--kernels", options->wanted.kernels, "Globs of kernel names")
        .delimiter(',')
        .capture_default_str();
    command.add_option("--taps", options->taps, "Lengths: numbers, full, or 2+7: two near taps and seven modes")
        .delimiter(',');
    command.add_option("--targets", options->wanted.targets, "Some of host, m7, m4: machines stand beside each other")
        .delimiter(',')
        .capture_default_str();
    command
        .add_option(
            "--core", options->cores,
            fmt::format("Cores of the timing model, files of qemu/cores; count: instructions alone (default: {})",
                        fmt::join(default_cores(), " or ")))
        .delimiter(',');
    command.add_option("--jobs", options->wanted.jobs, "Threads and emulators at once").between(1, 1024);
    command.add_option("--out", options->out, "Result file (default: results/drive.json)");
    command.callback([options] {
        check_targets(options->wanted.targets);
        run(*options);
    });
}

}  // namespace cli
