// glsum simulate: a model's response, exactly and as a microcontroller would step it.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/failure.hpp"
#include "base/gnuplot.hpp"
#include "cli/command.hpp"
#include "cli/drive_files.hpp"
#include "drive/exact_step_response.hpp"
#include "drive/pictures.hpp"
#include "drive/response.hpp"
#include "drive/simulation.hpp"

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
    bool json = false;
    std::filesystem::path out;
    std::filesystem::path plot;
};

std::optional<std::size_t> to_taps(const std::string& word) {
    std::size_t taps = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), taps);
    if (word == "full") {
        return std::nullopt;
    }
    if (error != std::errc{} || end != word.data() + word.size() || taps == 0) {
        throw Failure(Exit::bad_input, fmt::format("--taps: expected a number of at least 1 or full, found {}", word));
    }
    return taps;
}

// The oracle's digits at given times.
void print_exact_values(const drive::Model& model, const Options& options) {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    std::string text;
    for (const double t : options.at_s) {
        const drive::ExactValue value = drive::exact_step_response(model, t);
        text += fmt::format("{} s  {}  ({} digits agree)\n", t, value.digits, value.agreed_digits);
        all.push_back(
            {{"time_s", t}, {"value", value.value}, {"digits", value.digits}, {"agreed_digits", value.agreed_digits}});
    }
    put(options.json ? all.dump(2) + "\n" : text, options.out);
}

drive::Log make_record(const Options& options, double step_s) {
    if (options.input == "step" || options.input == "pulse" || options.input == "staircase") {
        drive::Excitation excitation = options.excitation;
        excitation.name = options.input;
        drive::Log record;
        record.name = options.input;
        record.input = drive::make_input(excitation, step_s, options.until_s);
        for (std::size_t k = 0; k < record.input.size(); ++k) {
            record.time_s.push_back(static_cast<double>(k) * step_s);
        }
        return record;
    }
    if (!std::filesystem::exists(options.input)) {
        throw Failure(Exit::bad_input,
                      fmt::format("--input: expected step, pulse, staircase or a CSV file, found {}", options.input));
    }
    drive::Columns columns = options.columns;
    columns.needs_output = false;  // it is what is asked for
    drive::Log record = read_ordered_log(options.input, columns);
    if (!options.exact) {
        record = drive::resample(std::move(record), step_s, drive::Hold::zero_order).log;
    }
    record.name = options.input;
    const double first_s = record.time_s.front();
    for (double& t : record.time_s) {
        t -= first_s;
    }
    return record;
}

// A model that diagnose improved: its effects are simulated with it. \return  whether it has any
bool tell_of_effects(const drive::Model& model, drive::Log record, const Options& options) {
    const gap::Improved improved = simulate_effects(model, record, options.model.string());
    if (improved.effects.empty()) {
        return false;
    }
    record.output = improved.output;
    fmt::print("{}\nwith {}, input {}: {} samples, at {:.6g} s the output is {:.10g}\n", drive::to_text(model),
               fmt::join(improved.effects, ", "), options.input, record.output.size(), record.time_s.back(),
               record.output.back());
    if (!options.out.empty()) {
        put(drive::to_csv(record), options.out);
    }
    if (!options.plot.empty()) {
        base::draw(
            drive::picture_of_curves({{"with effects", record.time_s, record.output}}, drive::to_text(model), "output"),
            options.plot);
    }
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
    drive::Log record = make_record(options, options.scheme.step_s);
    if (tell_of_effects(model, record, options)) {
        return;
    }
    const std::string method =
        options.exact
            ? "exact, by numerical inverse Laplace"
            : fmt::format("{}{}{}, {} taps, h = {} s", options.scheme.kernel.empty() ? "double" : options.scheme.kernel,
                          options.scheme.increments ? ", increments" : "",
                          options.scheme.merged || options.scheme.kernel.empty() ? ", one merged table" : "",
                          options.taps, options.scheme.step_s);
    drive::Simulated simulated;
    std::vector<double> exact;
    std::string why_not;
    if (options.exact || !options.no_compare) {
        try {
            exact = drive::respond(model, drive::changes_of(record.time_s, record.input), record.time_s);
        } catch (const Failure& failure) {
            if (options.exact) {
                throw;
            }
            why_not = failure.what();
        }
    }
    if (options.exact) {
        simulated.output = exact;
    } else {
        simulated = drive::simulate(model, options.scheme, record.input);
    }
    record.output = simulated.output;
    if (!options.out.empty()) {
        put(drive::to_csv(record), options.out);
    }
    double largest = 0.0;
    double size = 0.0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
        largest = std::max(largest, std::fabs(record.output[k] - exact[k]));
        size = std::max(size, std::fabs(exact[k]));
    }
    const bool compared = !exact.empty() && !options.exact;
    if (options.json) {
        nlohmann::ordered_json json{{"model", options.model.string()},
                                    {"method", method},
                                    {"input", options.input},
                                    {"samples", record.output.size()},
                                    {"final_time_s", record.time_s.back()},
                                    {"saturations", simulated.saturations}};
        json["final_output"] = record.output.back();  // not a number becomes null: JSON has none
        if (compared) {
            json["exact_final_output"] = exact.back();
            json["error_max"] = largest;
        }
        fmt::print("{}\n", json.dump(2));
    } else {
        fmt::print("{}\n{}, input {}: {} samples, at {:.6g} s the output is {:.10g}\n", drive::to_text(model), method,
                   options.input, record.output.size(), record.time_s.back(), record.output.back());
        if (compared) {
            fmt::print("exact there: {:.10g}; largest error over the record {:.4g} ({:.3g} % of the largest output)\n",
                       exact.back(), largest, size > 0.0 ? 100.0 * largest / size : 0.0);
        }
        if (!why_not.empty()) {
            fmt::print("not compared with the exact response: {}\n", why_not);
        }
        if (simulated.full_scale > 0.0) {
            fmt::print("full scale {}, {} saturations\n", simulated.full_scale, simulated.saturations);
        }
    }
    if (!options.exact && !drive::delay_fits(model, options.scheme.step_s)) {
        fmt::print(stderr,
                   "glsum: warning: the dead time of {} s is no whole number of steps of {} s; rounded up to one\n",
                   model.delay_s, options.scheme.step_s);
    }
    if (!options.plot.empty()) {
        std::vector<drive::Curve> curves{{method, record.time_s, record.output}};
        if (compared) {
            curves.push_back({"exact", record.time_s, exact});
        }
        base::draw(drive::picture_of_curves(curves, drive::to_text(model), "output"), options.plot);
    }
    if (!std::isfinite(record.output.back())) {
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
    command.add_option("--step-s", options->step_s, "Step h; usually the model's sample_time_s, or 0.001").above(0);
    command.add_option("--until,--until-s", options->until_s, "Length of the record in s")
        .above(0)
        .capture_default_str();
    command.add_flag("--no-compare", options->no_compare, "Leave out the comparison with the exact response");
    add_column_options(command, options->columns);
    command.add_flag("--json", options->json, "The summary as JSON");
    command.add_option("--out", options->out, "CSV of time_s, input and output");
    command.add_option("--plot", options->plot, "Draw STEM.svg and STEM.png");
    command.callback([options] { run(*options); });
}

}  // namespace cli
