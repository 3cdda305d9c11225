// glsum silicon: the timing model held against cycles that were measured on silicon.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <thread>

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "base/files.hpp"
#include "cli/board.hpp"
#include "cli/command.hpp"
#include "cli/output.hpp"
#include "qemu/emulate/foreign_program.hpp"
#include "qemu/emulate/measured_calls.hpp"
#include "qemu/emulate/predicted_calls.hpp"
#include "qemu/emulate/rows_fit.hpp"
#include "qemu/emulate/silicon.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

struct Options {
    std::filesystem::path file =
        std::filesystem::path(build_info::source_folder) / "results" / "silicon" / "h747_per_sample_fir.csv";
    std::string core = "stm32h747-dtcm";
    std::vector<std::string> without;
    std::filesystem::path rows;
    Output json;
    unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
    unsigned timeout = 120;
};

[[noreturn]] void fail_by(std::size_t missed, std::size_t rows) {
    throw Failure(Exit::check_failed, fmt::format("{} of {} rows are missed by more than {:.0f} % and {:.0f} cycles",
                                                  missed, rows, 100 * qemu::allowed_share, qemu::allowed_cycles));
}

// How well each rule set of the core fits: which rivals these rows cannot part.
// \param all  of all sets together, then of each alone
void print_sets(const timing::CoreFile& core, const std::vector<qemu::MeasuredCycles>& rows,
                const std::vector<std::vector<qemu::PredictedCycles>>& all) {
    fmt::print("\n{:<12} {:>8} {:>8} {:>8}  {}\n", "rule set", "median", "worst", "missed", "");
    for (std::size_t s = 0; s < core.sets.size(); ++s) {
        std::vector<double> errors;
        std::size_t missed = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const double predicted = all[1 + s][i].nominal;
            errors.push_back(std::abs(predicted / rows[i].cycles - 1.0));
            missed += qemu::misses(predicted, rows[i].cycles) ? 1 : 0;
        }
        std::sort(errors.begin(), errors.end());
        fmt::print("{:<12} {:>7.1f}% {:>7.1f}% {:>8}  {}\n", core.sets[s].name, 100 * errors[errors.size() / 2],
                   100 * errors.back(), fmt::format("{} of {}", missed, rows.size()), core.sets[s].note);
    }
}

void run(const Options& options) {
    const std::vector<qemu::MeasuredCycles> rows = read_measured_cycles(options.file);
    const qemu::SiliconProgram program =
        built_silicon(qemu::machine_of(timing::core_asked_for(options.core), cores_folder()));
    const timing::CoreFile core = timing::read_named_core(program.cores_folder, options.core);
    std::vector<qemu::CoreVariant> variants{{options.core, "", options.without}};
    for (const timing::RuleSet& set : core.sets) {
        variants.push_back({options.core, set.name, options.without});
    }
    const auto all = qemu::predict(program, options.file, rows, variants);
    const std::vector<qemu::PredictedCycles>& predicted = all.front();

    fmt::print("{}: {} rows, predicted with the core file {}\n\n", options.file.filename().string(), rows.size(),
               options.core);
    fmt::print("{:<26} {:<13} {:<5} {:>5} {:>9} {:>9} {:>17} {:>8} {:>8}\n", "kernel", "code", "data", "taps",
               "measured", "predicted", "band", "error", "cycles");
    struct Group {
        std::vector<double> taps;
        std::vector<double> measured;
        std::vector<double> predicted;
    };
    std::map<std::string, Group> groups;
    std::vector<double> errors;
    std::size_t missed = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const qemu::MeasuredCycles& row = rows[i];
        const qemu::PredictedCycles& p = predicted[i];
        const double error = p.nominal / row.cycles - 1.0;
        const bool missing = qemu::misses(p.nominal, row.cycles);
        missed += missing ? 1 : 0;
        errors.push_back(std::abs(error));
        fmt::print("{:<26} {:<13} {:<5} {:>5} {:>9} {:>9.1f} {:>17} {:>+7.1f}% {:>+8.1f}{}\n", row.kernel, row.code,
                   row.data, row.taps, row.cycles, p.nominal, fmt::format("{:.1f} to {:.1f}", p.low, p.high),
                   100 * error, p.nominal - row.cycles, missing ? "  MISSED" : "");
        Group& group = groups[fmt::format("{:<26} {:<13} {:<5}", row.kernel, row.code, row.data)];
        group.taps.push_back(row.taps);
        group.measured.push_back(row.cycles);
        group.predicted.push_back(p.nominal);
    }
    fmt::print("\n{:<46} {:>10} {:>10} {:>10} {:>10}\n", "cycles a tap and beside them", "measured", "predicted",
               "measured", "predicted");
    for (const auto& [name, group] : groups) {
        const qemu::FittedLine measured = qemu::fit_line(group.taps, group.measured);
        const qemu::FittedLine model = qemu::fit_line(group.taps, group.predicted);
        fmt::print("{:<46} {:>10.3f} {:>10.3f} {:>10.1f} {:>10.1f}\n", name, measured.slope, model.slope,
                   measured.constant, model.constant);
    }
    print_sets(core, rows, all);
    std::sort(errors.begin(), errors.end());
    fmt::print("\nmedian error {:.1f} %, worst {:.1f} %; {} of {} rows within {:.0f} % or {:.0f} cycles\n",
               100 * errors[errors.size() / 2], 100 * errors.back(), rows.size() - missed, rows.size(),
               100 * qemu::allowed_share, qemu::allowed_cycles);
    if (missed > 0) {
        fail_by(missed, rows.size());
    }
}

// Rows of any program.
void run_rows(const Options& options) {
    const std::string name = options.rows.string();
    const std::vector<qemu::MeasuredCall> rows = qemu::parse_measured_calls(
        base::read_file(options.rows, qemu::MeasuredLimits::bytes), name, options.rows.parent_path());
    options.json.check();
    const std::vector<qemu::PredictedCall> predicted =
        qemu::predict_calls(calls_program(options.timeout), rows, name, {{"", "", options.without}}, options.jobs)
            .front();
    const qemu::RowsFit fit = qemu::fit_of(rows, predicted);
    fmt::print("{}", qemu::to_text(options.rows.filename().string(), rows, predicted, fit));
    if (options.json.wanted()) {
        options.json.write(qemu::to_json(name, rows, predicted, fit));
    }
    if (fit.missed > 0) {
        fail_by(fit.missed, rows.size());
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    command.footer(
        "Exit status 1 when a row is missed by more than 5 % and 8 cycles of a call.\n"
        "Rows of --rows: elf, a path from the CSV's folder; function and core as `glsum time` takes them; code itcm, "
        "flash or\n"
        "axi, data dtcm or axi, or nothing for the core's own; measured, the cycles of a call divided by per. With a\n"
        "column group, each group is judged by the band, and by one as wide as 95 % of the others ask; so is each "
        "author\n"
        "of several groups, whose name stands before a \"/\".\n"
        "Examples: glsum silicon results/silicon/h747_per_sample_fir.csv\n"
        "          glsum silicon --rows mine.csv --json fit.json");
    Option file = command.add_option("file", options->file, "CSV: kernel,code,data,maintenance,taps,cycles");
    Option core =
        command.add_option("--core", options->core, "Core file, a name or a path; each row's placement beats its own");
    core.capture_default_str();
    command.add_option("--without", options->without, "Effects that cost nothing: single_issue, load_use, ...")
        .delimiter(',');
    Option rows = command.add_option("--rows", options->rows,
                                     "CSV of any programs' functions: elf,function,core,code,data,measured,per");
    options->json.add_to(command, "--json", "The fit of --rows").needs(rows);
    command.add_option("--jobs", options->jobs, "Emulators at once, with --rows").between(1, 1024);
    command.add_option("--timeout", options->timeout, "Seconds that a program of --rows may stay silent")
        .at_least(1)
        .capture_default_str();
    command.callback([options, file, core, rows] {
        if (rows.given() && (file.given() || core.given())) {
            throw Failure(Exit::bad_input,
                          "--rows: expected neither FILE nor --core beside it: its rows name their core");
        }
        rows.given() ? run_rows(*options) : run(*options);
    });
}

}  // namespace cli
