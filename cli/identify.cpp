// glsum identify: from logs to a model, with what the data say about each parameter.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/gnuplot.hpp"
#include "base/progress.hpp"
#include "cli/characteristic.hpp"
#include "cli/command.hpp"
#include "cli/coverage.hpp"
#include "cli/drive_files.hpp"
#include "cli/form_options.hpp"
#include "cli/output.hpp"
#include "drive/fit_report.hpp"
#include "drive/model_file.hpp"
#include "drive/pictures.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

struct Options {
    std::vector<std::filesystem::path> logs;
    drive::Columns columns;
    std::string form = "niopdt";
    std::string start = "search";
    FormOptions parameters;
    drive::FitOptions fit;
    std::optional<std::size_t> starts;
    std::filesystem::path controller;
    std::string intervals = "profile";
    std::string method = "least-squares";
    CharacteristicOptions characteristic;
    CoverageOptions coverage;
    Output json;
    std::filesystem::path out;
    std::filesystem::path plot;
};

drive::Model tangent(drive::Kind kind, const drive::Record& record) {
    return drive::tangent_construction(kind == drive::Kind::fopdt ? kind : drive::Kind::sopdt, record);
}

void run(const Options& given) {
    Options options = given;
    options.fit.prediction_error = options.method == "prediction-error";
    options.fit.profile = options.intervals == "profile";
    // Many starts, or the intervals of a long log, take most of a minute.
    std::optional<base::Progress> shown;
    const auto begin = std::chrono::steady_clock::now();
    options.fit.on_progress = [&](const std::string& part, std::size_t done, std::size_t all) {
        if (done == all) {
            shown.reset();
        } else if (shown) {
            shown->advance();
        } else if (std::chrono::steady_clock::now() - begin > std::chrono::seconds(2)) {
            shown.emplace(part, all).advance(done);
        }
    };
    options.fit.starts = options.starts.value_or(1);
    options.fit.starts_if_poor = options.starts ? 0 : 7;
    if (options.coverage.runs > 0) {
        show_coverage(options.coverage,
                      {options.start, options.form, options.fit.seed, options.fit.jobs, options.json, options.out});
        return;
    }
    if (options.characteristic.asked) {
        show_characteristic(options.characteristic, options.logs, options.columns, options.out, options.plot);
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
    const drive::Kind kind = drive::kind_named(options.form);
    if (options.method == "none") {
        if (options.start != "tangent") {
            throw Failure(Exit::bad_input, "--method none: expected --start tangent");
        }
        const drive::Model model = tangent(kind, records.front());
        put(drive::to_json(model), options.out);
        fmt::print(stderr, "{}\n", drive::to_text(model));
        return;
    }
    drive::Fit fit;
    drive::Model start;
    if (options.start == "search") {
        fit = drive::fit_from_nothing(kind, records, options.fit, [&](drive::Form& form) {
            apply(options.parameters, form);
            start = form.to_model(form.values());
        });
    } else {
        start = options.start == "tangent" ? tangent(kind, records.front()) : read_model(options.start);
        drive::Form form(kind, start);
        apply(options.parameters, form);
        fit = drive::fit(form, records, options.fit);
    }
    const drive::Record& record = records.front();
    const std::vector<double> fitted = drive::simulate_fit(fit, record);
    const drive::Indices indices = drive::compute_indices(record.time_s, record.output, fitted);
    if (!options.out.empty()) {
        put(drive::to_json(fit.model), options.out);
    }
    put_either(
        options.json, [&] { return drive::to_json(fit, record.name, indices); },
        [&] { return drive::to_text(fit, record.name, indices); }, {});
    for (const std::string& warning : fit.warnings) {
        fmt::print(stderr, "glsum: warning: {}\n", warning);
    }
    warn_if_unstable(fit.model, "the fitted model");
    if (!options.plot.empty()) {
        base::draw(drive::picture_of_fit(record, drive::respond_to(start, record), fitted, fit.model), options.plot);
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
    add_form_options(command, options->parameters);
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
    add_characteristic_options(command, options->characteristic);
    add_coverage_options(command, options->coverage);
    add_column_options(command, options->columns);
    command.add_option("--jobs", options->fit.jobs, "Threads").at_least(1);
    options->json.add_to(command, "--json", "All of it");
    command.add_option("--out", options->out, "Model JSON");
    command.add_option("--plot", options->plot, "Draw measured, start and fitted: STEM.svg and STEM.png");
    command.callback([options] { run(*options); });
}

}  // namespace cli
