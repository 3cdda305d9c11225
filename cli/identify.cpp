// glsum identify: from logs to a model, with what the data say about each parameter.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/gnuplot.hpp"
#include "base/progress.hpp"
#include "cli/command.hpp"
#include "cli/drive_files.hpp"
#include "drive/coverage.hpp"
#include "drive/fit.hpp"
#include "drive/indices.hpp"
#include "drive/model_file.hpp"
#include "drive/pictures.hpp"
#include "drive/static_characteristic.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;
using Json = nlohmann::ordered_json;

struct Options {
    std::vector<std::filesystem::path> logs;
    drive::Columns columns;
    std::string form = "niopdt";
    std::string start = "search";
    std::vector<std::string> fix;
    std::vector<std::string> free;
    std::vector<std::string> set;
    std::vector<std::string> bounds;
    drive::FitOptions fit;
    std::optional<std::size_t> starts;
    std::filesystem::path controller;
    std::string intervals = "profile";
    std::string method = "least-squares";
    bool characteristic = false;
    double shortest_hold_s = 1.0;
    std::size_t coverage = 0;
    drive::Acquisition acquisition;
    bool json = false;
    std::filesystem::path out;
    std::filesystem::path plot;
};

drive::Kind to_kind(const std::string& word) {
    for (const drive::Kind kind : {drive::Kind::fopdt, drive::Kind::sopdt, drive::Kind::niopdt}) {
        if (word == name_of(kind)) {
            return kind;
        }
    }
    return drive::Kind::fotf;
}

double to_number(const std::string& text, const std::string& option) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
        throw Failure(Exit::bad_input, fmt::format("{}: expected a finite number, found '{}'", option, text));
    }
    return value;
}

// name=value, or the name alone.
std::pair<std::string, std::string> split_at_equals(const std::string& word) {
    const auto at = word.find('=');
    return at == std::string::npos ? std::pair(word, std::string())
                                   : std::pair(word.substr(0, at), word.substr(at + 1));
}

void apply(const Options& options, drive::Form& form) {
    for (const std::string& word : options.set) {
        const auto [name, value] = split_at_equals(word);
        form.parameter(name).value = to_number(value, "--set " + name);
    }
    for (const std::string& word : options.fix) {
        const auto [name, value] = split_at_equals(word);
        drive::Parameter& parameter = form.parameter(name);
        parameter.fixed = true;
        if (!value.empty()) {
            parameter.value = to_number(value, "--fix " + name);
        }
    }
    for (const std::string& name : options.free) {
        form.parameter(name).fixed = false;
    }
    for (const std::string& word : options.bounds) {
        const auto [name, range] = split_at_equals(word);
        const auto colon = range.find(':');
        if (colon == std::string::npos) {
            throw Failure(Exit::bad_input, fmt::format("--bound: expected NAME=LOW:HIGH, found {}", word));
        }
        drive::Parameter& parameter = form.parameter(name);
        parameter.lower = to_number(range.substr(0, colon), "--bound " + name);
        parameter.upper = to_number(range.substr(colon + 1), "--bound " + name);
        if (!(parameter.lower < parameter.upper)) {
            throw Failure(Exit::bad_input,
                          fmt::format("--bound {}: expected the lower bound below the upper, found {}", name, range));
        }
        parameter.value = std::clamp(parameter.value, parameter.lower, parameter.upper);
        parameter.bounds_are_given = true;
    }
}

Json to_json(const drive::Fit& fit, const drive::Record& record, const drive::Indices& indices) {
    Json json{{"model", Json::parse(drive::to_json(fit.model))}, {"offset", fit.offset}};
    json["parameters"] = Json::array();
    for (const drive::Estimate& estimate : fit.parameters) {
        Json row{{"name", estimate.name}, {"value", estimate.value}, {"fixed", estimate.fixed}};
        if (!estimate.fixed) {
            row["deviation"] = estimate.deviation;  // infinite becomes null
            row["interval"] = {estimate.low, estimate.high};
        }
        json["parameters"].push_back(row);
    }
    Json correlation = Json::array();
    for (Eigen::Index i = 0; i < fit.correlation.rows(); ++i) {
        correlation.push_back(std::vector<double>(fit.correlation.row(i).begin(), fit.correlation.row(i).end()));
    }
    json["correlation"] = {{"names", fit.free_names}, {"matrix", correlation}};
    json["sum_of_squares"] = fit.sum_of_squares;
    json["noise_deviation"] = fit.noise_deviation;
    json["noise_model"] = fit.noise_model;
    json["lag_one"] = fit.lag_one;
    json["iterations"] = fit.iterations;
    json["stopped"] = fit.stopped;
    json["starts"] = fit.starts;
    json["starts_that_agree"] = fit.starts_that_agree;
    json["nrmse_fit"] = indices.nrmse_fit;
    json["nrmse_of"] = record.name;
    json["warnings"] = fit.warnings;
    return json;
}

std::string to_text(const drive::Fit& fit, const drive::Record& record, const drive::Indices& indices) {
    std::string text = fmt::format("{}\n\n{:<16} {:>14} {:>32}\n", drive::to_text(fit.model), "parameter", "estimate",
                                   "95 % interval");
    for (const drive::Estimate& estimate : fit.parameters) {
        if (!estimate.fixed) {
            text += fmt::format("{:<16} {:>14.7g} {:>16.7g} {:>15.7g}\n", estimate.name, estimate.value, estimate.low,
                                estimate.high);
        } else if (estimate.name != "offset" || estimate.value != 0.0) {
            text += fmt::format("{:<16} {:>14.7g} {:>32}\n", estimate.name, estimate.value, "fixed");
        }
    }
    if (fit.free_names.size() > 1) {
        text += "\ncorrelation     ";
        for (const std::string& name : fit.free_names) {
            text += fmt::format(" {:>8.8}", name);
        }
        for (Eigen::Index i = 0; i < fit.correlation.rows(); ++i) {
            text += fmt::format("\n{:<16}", fit.free_names[static_cast<std::size_t>(i)]);
            for (Eigen::Index j = 0; j <= i; ++j) {
                text += fmt::format(" {:>8.3f}", fit.correlation(i, j));
            }
        }
        text += "\n";
    }
    text += fmt::format(
        "\nsum of squares {:.6g}, residuals {:.4g}{}, lag one {:.3f}; fit (NRMSE) {:.2f} % on {}\n{} iterations: {}",
        fit.sum_of_squares, fit.noise_deviation,
        fit.noise_model.empty() ? "" : fmt::format(" after whitening by AR({})", fit.noise_model.size()), fit.lag_one,
        100.0 * indices.nrmse_fit, record.name, fit.iterations, fit.stopped);
    text += fit.starts == 1 ? "\n" : fmt::format("; {} of {} starts end here\n", fit.starts_that_agree, fit.starts);
    return text;
}

void show_coverage(const Options& options) {
    if (options.start == "search" || options.start == "tangent") {
        throw Failure(Exit::bad_input, "--coverage: expected --start MODEL.json, the model that the logs come from");
    }
    const drive::Model truth = read_model(options.start);
    drive::Coverage found;
    {
        base::Progress progress("fitting", options.coverage);
        found = drive::measure_coverage(truth, to_kind(options.form), options.acquisition, options.coverage,
                                        options.fit.seed, options.fit.jobs, [&] { progress.advance(); });
    }
    Json json{{"model", options.start}, {"form", options.form}, {"runs", found.runs}, {"failed", found.failed}};
    json["parameters"] = Json::array();
    std::string text = fmt::format(
        "{} logs of {}: {} for {} s, {} s +- {} s, noise {}, steps of {}\n{:<16} {:>12} {:>12} {:>12} {:>12} {:>8}\n",
        found.runs, drive::to_text(truth), options.acquisition.excitation.name, options.acquisition.until_s,
        options.acquisition.interval_s, options.acquisition.jitter_s, options.acquisition.noise,
        options.acquisition.quantum, "parameter", "truth", "mean", "spread", "claimed", "inside");
    bool good = found.failed == 0;
    for (std::size_t i = 0; i < found.names.size(); ++i) {
        text += fmt::format("{:<16} {:>12.6g} {:>12.6g} {:>12.3g} {:>12.3g} {:>8}\n", found.names[i], found.truth[i],
                            found.mean[i], found.spread[i], found.claimed[i],
                            fmt::format("{}/{}", found.inside[i], found.runs));
        json["parameters"].push_back({{"name", found.names[i]},
                                      {"truth", found.truth[i]},
                                      {"inside", found.inside[i]},
                                      {"mean", found.mean[i]},
                                      {"spread", found.spread[i]},
                                      {"claimed", found.claimed[i]}});
        const double share = static_cast<double>(found.inside[i]) / static_cast<double>(found.runs);
        good = good && share >= 0.90 && share <= 0.995;
    }
    text += fmt::format("{:<16} {:>12} {:>12} {:>12} {:>12} {:>8}\n", "all at once", "", "", "", "",
                        fmt::format("{}/{}", found.jointly_inside, found.runs));
    json["jointly_inside"] = found.jointly_inside;
    put(options.json ? json.dump(2) + "\n" : text, options.out);
    if (!good && found.runs >= 100) {
        throw Failure(Exit::check_failed,
                      "coverage: expected each parameter inside its 95 % interval in 90 to 99 of 100 runs");
    }
}

void show_characteristic(const Options& options) {
    if (options.logs.size() != 1) {
        throw Failure(Exit::bad_input, fmt::format("--static: expected one log, found {}", options.logs.size()));
    }
    const drive::Log log = read_ordered_log(options.logs.front(), options.columns);
    const drive::StaticCharacteristic found = drive::static_characteristic(log, options.shortest_hold_s);
    std::string text =
        fmt::format("{:>10} {:>12} {:>12} {:>10} {:>10}\n", "input", "output", "deviation", "from s", "to s");
    for (const drive::Level& level : found.levels) {
        text += fmt::format("{:>10.5g} {:>12.6g} {:>12.2g} {:>10.2f} {:>10.2f}  {}{}\n", level.input, level.output,
                            level.deviation, level.from_s, level.to_s, level.rising ? "up" : "down",
                            level.settled ? "" : fmt::format(", not settled: still moves by {:.2g}", level.drift));
    }
    text += fmt::format(
        "straight line {:.6g} + {:.6g} input; the output bends away from it by up to {:.1f} % of its range\n",
        found.intercept, found.slope, 100.0 * found.largest_bend);
    fmt::print("{}", text);
    if (!options.out.empty()) {
        base::write_file(options.out, drive::to_csv(found));
    }
    if (!options.plot.empty()) {
        base::draw(drive::picture_of_characteristic(
                       found, "Static characteristic of " + options.logs.front().filename().string()),
                   options.plot);
    }
}

void run(const Options& given) {
    Options options = given;
    options.fit.prediction_error = options.method == "prediction-error";
    options.fit.profile = options.intervals == "profile";
    // Intervals of a long log take most of a minute.
    std::optional<base::Progress> intervals;
    const auto begin = std::chrono::steady_clock::now();
    options.fit.on_interval_end = [&](std::size_t done, std::size_t all) {
        if (intervals) {
            intervals->advance();
        } else if (std::chrono::steady_clock::now() - begin > std::chrono::seconds(2)) {
            intervals.emplace("intervals", all).advance(done);
        }
        if (done == all) {
            intervals.reset();
        }
    };
    options.fit.starts = options.starts.value_or(1);
    options.fit.starts_if_poor = options.starts ? 0 : 7;
    if (options.coverage > 0) {
        show_coverage(options);
        return;
    }
    if (options.characteristic) {
        show_characteristic(options);
        return;
    }
    if (options.logs.empty()) {
        throw Failure(Exit::bad_input, "identify: expected a log");
    }
    std::optional<drive::Model> controller;
    if (!options.controller.empty()) {
        controller = drive::parse_controller(base::read_file(options.controller, drive::most_model_bytes),
                                             options.controller.string());
        options.columns.takes_reference = true;
    } else if (!options.columns.reference.empty()) {
        throw Failure(Exit::bad_input, "--reference-column: expected --controller FILE beside it");
    }
    std::vector<drive::Record> records;
    for (const auto& path : options.logs) {
        records.push_back(drive::to_record(read_ordered_log(path, options.columns), controller));
    }
    const drive::Kind kind = to_kind(options.form);
    const drive::Kind first = kind == drive::Kind::fopdt ? kind : drive::Kind::sopdt;
    drive::Fit fit;
    drive::Model start;
    if (options.start == "search") {
        fit = drive::fit_from_nothing(kind, records, options.fit, [&](drive::Form& form) {
            std::vector<double> values;
            apply(options, form);
            for (const drive::Parameter& parameter : form.parameters()) {
                values.push_back(parameter.value);
            }
            start = form.to_model(values);
        });
    } else {
        start = options.start == "tangent" ? drive::tangent_construction(first, records.front())
                                           : read_model(options.start);
        if (options.method == "none") {
            fit.model = start;
        } else {
            drive::Form form(kind, start);
            apply(options, form);
            fit = drive::fit(form, records, options.fit);
        }
    }
    if (options.method == "none") {
        if (options.start != "tangent") {
            throw Failure(Exit::bad_input, "--method none: expected --start tangent");
        }
        put(drive::to_json(start), options.out);
        fmt::print(stderr, "{}\n", drive::to_text(start));
        return;
    }
    const drive::Record& record = records.front();
    const std::vector<double> fitted = drive::simulate_fit(fit, record);
    const drive::Indices indices = drive::compute_indices(record.time_s, record.output, fitted);
    if (!options.out.empty()) {
        put(drive::to_json(fit.model), options.out);
    }
    fmt::print("{}", options.json ? to_json(fit, record, indices).dump(2) + "\n" : to_text(fit, record, indices));
    for (const std::string& warning : fit.warnings) {
        fmt::print(stderr, "glsum: warning: {}\n", warning);
    }
    warn_if_unstable(fit.model, "the fitted model");
    if (!options.plot.empty()) {
        const std::vector<drive::Curve> curves{{"measured", record.time_s, record.output, true},
                                               {"start", record.time_s, drive::respond_to(start, record)},
                                               {"fitted", record.time_s, fitted}};
        base::draw(drive::picture_of_curves(curves, "fitted: " + drive::short_text(fit.model), "output"), options.plot);
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    options->fit.jobs = std::max(1U, std::thread::hardware_concurrency());
    command.footer(
        "The response is the exact one at the log's own stamps: nothing need be resampled.\n"
        "Example: glsum identify log.csv --form niopdt --out model.json --plot fit\n"
        "Example: glsum identify log.csv --form fopdt --start tangent --method none    (Kuepfmueller's construction "
        "alone)\n"
        "Example: glsum identify loop.csv --controller pi.json --form sopdt --method prediction-error    (closed "
        "loop)\n"
        "Example: glsum identify --coverage 100 --form niopdt --start drive/models/niopdt.json");
    command.add_option("log,--log", options->logs,
                       "Logs, CSV with time_s, input or duty, and the output; all are fitted at once");
    command.add_option("--form", options->form, "fopdt, sopdt, niopdt, or fotf: every coefficient and order of --start")
        .one_of({"fopdt", "sopdt", "niopdt", "fotf"})
        .capture_default_str();
    command
        .add_option(
            "--start", options->start,
            "search (a grid; then SOPDT as the start of fractional forms), tangent (of a step response), or a model")
        .capture_default_str();
    command
        .add_option("--method", options->method,
                    "least-squares, prediction-error (coloured noise), or none (the start itself)")
        .one_of({"least-squares", "prediction-error", "none"})
        .capture_default_str();
    command.add_option("--controller", options->controller,
                       "Closed loop: the controller that made the input, a model or {\"kind\": \"pid\", \"kp\": 2, "
                       "\"ki\": 1.5, \"kd\": 0.1, \"filter_s\": 0.02}; the loop is fitted to the column reference or, "
                       "without one, to what input and output say it was");
    command.add_option("--reference-column", options->columns.reference, "Of a closed loop; usually reference");
    command
        .add_option("--intervals", options->intervals,
                    "profile (of the likelihood) or straight (value +- t deviations, faster)")
        .one_of({"profile", "straight"})
        .capture_default_str();
    command.add_option("--fix", options->fix, "NAME or NAME=VALUE: a parameter that is not fitted").delimiter(',');
    command.add_option("--free", options->free, "NAME: fit a parameter that usually is fixed, such as offset")
        .delimiter(',');
    command.add_option("--set", options->set, "NAME=VALUE: its start").delimiter(',');
    command.add_option("--bound", options->bounds, "NAME=LOW:HIGH").delimiter(',');
    command.add_option("--accept", options->fit.accepted_error, "E_c: stop when the sum of squares is at most this")
        .at_least(0);
    command.add_option("--iterations", options->fit.iterations, "Stop after so many").at_least(1).capture_default_str();
    command
        .add_option("--starts", options->starts,
                    "Also from random starts, so many in all (default: one, and seven more where that ends poorly)")
        .at_least(1);
    command
        .add_option("--seed", options->fit.seed,
                    "Of the random starts, and of the logs of --coverage: another set for each")
        .at_least(0)
        .capture_default_str();
    command.add_flag("--static", options->characteristic,
                     "Instead: the static characteristic, where the output rests for each level of the input");
    command.add_option("--hold-s", options->shortest_hold_s, "Of --static: shorter holds are passed over")
        .above(0)
        .capture_default_str();
    command.add_option("--coverage", options->coverage, "Fit so many noisy logs of --start and count the truths inside")
        .at_least(1);
    command.add_option("--input", options->acquisition.excitation.name, "Of --coverage: step, pulse or staircase")
        .capture_default_str();
    command.add_option("--until-s", options->acquisition.until_s, "Of --coverage").above(0).capture_default_str();
    command.add_option("--interval-s", options->acquisition.interval_s, "Of --coverage").above(0).capture_default_str();
    command.add_option("--jitter-s", options->acquisition.jitter_s, "Of --coverage").at_least(0).capture_default_str();
    command.add_option("--noise", options->acquisition.noise, "Of --coverage: standard deviation")
        .at_least(0)
        .capture_default_str();
    command.add_option("--quantum", options->acquisition.quantum, "Of --coverage: step of the encoder")
        .at_least(0)
        .capture_default_str();
    add_column_options(command, options->columns);
    command.add_option("--jobs", options->fit.jobs, "Threads").at_least(1);
    command.add_flag("--json", options->json, "JSON instead of text");
    command.add_option("--out", options->out, "Model JSON");
    command.add_option("--plot", options->plot, "Draw measured, start and fitted: STEM.svg and STEM.png");
    command.callback([options] { run(*options); });
}

}  // namespace cli
