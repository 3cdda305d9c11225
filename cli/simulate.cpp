// glsum simulate: a model's response, exactly and as a microcontroller would step it.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "base/failure.hpp"
#include "base/gnuplot.hpp"
#include "cli/command.hpp"
#include "cli/drive_files.hpp"
#include "cli/name_value.hpp"
#include "cli/output.hpp"
#include "drive/over_log.hpp"
#include "drive/pictures.hpp"
#include "drive/simulation_report.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

struct Options {
    std::filesystem::path model;
    std::string input = "step";
    drive::Columns columns;
    drive::Excitation excitation;
    drive::Scheme scheme;
    std::string taps = "full";
    bool sampled = false;
    bool exact = false;
    double step_s = 0.0;
    double until_s = 5.0;
    std::vector<double> at_s;
    bool no_compare = false;
    Output json;
    std::filesystem::path out;
    std::filesystem::path plot;
};

std::optional<std::size_t> to_taps(const std::string& word) {
    if (word == "full") {
        return std::nullopt;
    }
    const auto taps = to_number<std::size_t>(word);
    if (!taps || *taps == 0) {
        throw Failure(Exit::bad_input, fmt::format("--taps: expected a number of at least 1 or full, found {}", word));
    }
    return taps;
}

void draw(const Options& options, const drive::Model& model, const std::vector<drive::Curve>& curves) {
    if (!options.plot.empty()) {
        base::draw(drive::picture_of_curves(curves, drive::to_text(model), "output"), options.plot);
    }
}

// The oracle's digits at given times.
void print_exact_values(const drive::Model& model, const Options& options) {
    std::vector<drive::ExactPoint> points;
    for (const double t : options.at_s) {
        points.push_back({t, drive::exact_step_response(model, t)});
    }
    put_either(
        options.json, [&] { return drive::to_json(points); }, [&] { return drive::to_text(points); }, options.out);
}

// What is simulated, and the log that it is of, if it is one.
struct Task {
    drive::Log record;
    std::optional<drive::Log> log = {};
};

Task make_task(const Options& options, double step_s) {
    if (options.input == "step" || options.input == "pulse" || options.input == "staircase") {
        drive::Excitation excitation = options.excitation;
        excitation.name = options.input;
        return {drive::make_log(excitation, step_s, options.until_s)};
    }
    if (!std::filesystem::exists(options.input)) {
        throw Failure(Exit::bad_input,
                      fmt::format("--input: expected step, pulse, staircase or a CSV file, found {}", options.input));
    }
    drive::Columns columns = options.columns;
    columns.needs_output = false;  // it is what is asked for
    drive::Log log = read_ordered_log(options.input, columns);
    log.name = options.input;
    if (!options.exact) {
        return {drive::on_steps(log, step_s), log};
    }
    return {drive::from_start(log), std::move(log)};
}

// A log's simulation is written at the log's own stamps, where it can be compared with what was measured.
void put_series(const Options& options, const Task& task, const drive::Log& simulated) {
    if (!options.out.empty()) {
        put(drive::to_csv(task.log ? drive::at_own_stamps(*task.log, simulated) : simulated), options.out);
    }
}

// A model that diagnose improved: its effects are simulated with it, about its operating point. It takes uneven steps,
// and so keeps a log's own stamps: on a grid, the input of a jittered one would lag half a step. \return  whether it
// is one
bool tell_of_effects(const drive::Model& model, const Task& task, const Options& options) {
    drive::Log record = task.log && options.step_s == 0.0 ? drive::from_start(*task.log) : task.record;
    const gap::Improved improved = simulate_effects(model, record, options.model.string());
    if (improved.output.empty()) {
        return false;
    }
    record.output = improved.output;
    drive::SimulationReport report;
    report.method = improved.effects.empty() ? "about its operating point"
                                             : fmt::format("with {}", fmt::join(improved.effects, ", "));
    report.record = record;
    fmt::print("{}", drive::to_text(report, model));
    put_series(options, task, record);
    draw(options, model, {{"with effects", record.time_s, record.output}});
    return true;
}

void run(Options options) {
    const drive::Model model = read_model(options.model);
    if (!options.at_s.empty()) {
        print_exact_values(model, options);
        return;
    }
    warn_if_unstable(model, options.model.string());
    options.scheme.step_s = options.step_s > 0.0 ? options.step_s : model.sample_time_s.value_or(0.001);
    options.scheme.taps = to_taps(options.taps);
    options.scheme.forcing = options.sampled ? drive::Forcing::sampled : drive::Forcing::held;
    const Task task = make_task(options, options.scheme.step_s);
    if (tell_of_effects(model, task, options)) {
        return;
    }
    const drive::SimulationReport report =
        options.exact ? drive::simulate_exactly(model, task.record)
                      : drive::simulate(model, options.scheme, task.record, !options.no_compare);
    put_series(options, task, report.record);
    put_either(
        options.json, [&] { return drive::to_json(report, options.model.string()); },
        [&] { return drive::to_text(report, model); }, {});
    if (!options.exact && !drive::delay_fits(model, options.scheme.step_s)) {
        fmt::print(stderr,
                   "glsum: warning: the dead time of {} s is no whole number of steps of {} s; rounded up to one\n",
                   model.delay_s, options.scheme.step_s);
    }
    std::vector<drive::Curve> curves{{report.method, report.record.time_s, report.record.output}};
    if (!report.exact.empty()) {
        curves.push_back({"exact", report.record.time_s, report.exact});
    }
    draw(options, model, curves);
    if (!std::isfinite(report.record.output.back())) {
        throw Failure(Exit::check_failed,
                      fmt::format("{}: the simulation left the range of its numbers", options.model.string()));
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    command.footer(
        "The input is held between samples; y_0 = 0, and the first sample forces the second.\n"
        "Example: glsum simulate --model drive/models/niopdt.json --kernel ring_oldest_f32 --increments --taps 600 "
        "--out y.csv\n"
        "Example: glsum simulate --model drive/models/niopdt.json --at 1.5,5   (18 digits, in multi-precision)");
    command.add_option("--model", options->model, "Model JSON").required();
    command.add_option("--input", options->input, "step, pulse, staircase, or a CSV with time_s and input or duty")
        .capture_default_str();
    command.add_option("--amplitude", options->excitation.amplitude, "Of step, pulse and staircase")
        .capture_default_str();
    command.add_option("--off-s", options->excitation.off_s, "When the pulse ends").at_least(0).capture_default_str();
    command.add_option("--stairs", options->excitation.stairs, "Stairs up, and down again")
        .at_least(1)
        .capture_default_str();
    command.add_flag("--exact", options->exact, "The exact response instead of steps");
    command.add_option("--at", options->at_s, "The exact unit step response at these times, to 18 digits")
        .at_least(0)
        .delimiter(',');
    command.add_option("--kernel", options->scheme.kernel,
                       "A kernel's name; double with one merged table if not given");
    command.add_option("--taps", options->taps, "Memory length: a number, or full").capture_default_str();
    command.add_flag("--increments", options->scheme.increments, "Orders v - 1 on the increments of the output");
    command.add_flag("--merged", options->scheme.merged,
                     "With --kernel: one merged table instead of a sum for each order");
    command.add_option("--full-scale", options->scheme.full_scale, "Fixed point: the output that stands for 1")
        .above(0);
    command.add_flag("--sampled", options->sampled,
                     "The input is continuous, given at the samples: force with the newest");
    command
        .add_option(
            "--step-s", options->step_s,
            "Step h; usually the model's sample_time_s, or 0.001; of a log, a model with effects takes its stamps")
        .above(0);
    command.add_option("--until,--until-s", options->until_s, "Length of the record in s")
        .above(0)
        .capture_default_str();
    command.add_flag("--no-compare", options->no_compare, "Leave out the comparison with the exact response");
    add_column_options(command, options->columns);
    options->json.add_to(command, "--json", "The summary");
    command.add_option("--out", options->out, "CSV of time_s, input and output; of a log, at its own stamps");
    command.add_option("--plot", options->plot, "Draw STEM.svg and STEM.png");
    command.callback([options] { run(*options); });
}

}  // namespace cli
