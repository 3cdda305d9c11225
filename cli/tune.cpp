// glsum tune: from a plant to a controller's gains.
#include <fmt/format.h>

#include <memory>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/gnuplot.hpp"
#include "cli/command.hpp"
#include "cli/drive_files.hpp"
#include "cli/output.hpp"
#include "drive/tune/tune_picture.hpp"
#include "drive/tune/tune_report.hpp"

namespace cli {
namespace {

struct Options {
    std::filesystem::path model;
    tune::Request request;
    std::optional<double> sample_time_s;
    std::optional<double> low;
    std::optional<double> high;
    bool integer = false;
    Output json;
    std::filesystem::path out;
    std::filesystem::path plot;
};

void run(const Options& options) {
    const drive::Model model = read_model(options.model);
    tune::Request request = options.request;
    if (!options.sample_time_s && !model.sample_time_s) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("{}: has no sample_time_s; expected --sample-time-s", options.model.string()));
    }
    request.sample_time_s = options.sample_time_s ? *options.sample_time_s : *model.sample_time_s;
    request.low = options.low.value_or(request.low);
    request.high = options.high.value_or(request.high);
    const tune::Tuned tuned = tune::tune(model, request, options.model.string());
    if (!tuned.fractional && !tuned.integer) {
        throw glsum::Failure(glsum::Exit::check_failed,
                             fmt::format("{}: no PID, fractional or not, was found with {} and a stable loop; {}",
                                         options.model.string(), wish_text(tuned), tuned.nearest));
    }
    if (options.integer && !tuned.integer) {
        throw glsum::Failure(glsum::Exit::check_failed,
                             fmt::format("{}: no integer PID was found with {} and a stable loop; a fractional one was",
                                         options.model.string(), wish_text(tuned)));
    }
    put_either(
        options.json, [&] { return to_json(tuned, options.model.string()); },
        [&] { return to_text(tuned, options.model.string()); }, {});
    if (!options.out.empty()) {
        const bool integer = options.integer || !tuned.fractional;
        base::write_file(options.out, drive::to_json((integer ? tuned.integer : tuned.fractional)->controller));
    }
    if (!options.plot.empty()) {
        base::draw(picture_of(tuned, options.model.string()), options.plot);
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    tune::Request& request = options->request;
    command.footer(
        "With --margin and --crossover the phase is flat at the crossover where that can be had, so that the margin\n"
        "holds when the plant's gain changes. What is left free is chosen for the least integral of |error| after a\n"
        "step of the load. The best integer PID for the same wish stands beside it, with what the fraction saves.\n"
        "Exit status: 0 found; 1 nothing meets the wish, with what would; 2 wrong use.\n"
        "Example: glsum tune --model drive/models/fopdt.json --margin 60 --crossover 0.6 --out pid.json --plot tuned\n"
        "         glsum tune --model drive/models/niopdt.json --sensitivity 1.6 --low 0 --high 2");
    command.add_option("--model", options->model, "Model JSON of the plant: stable or integrating").required();
    command.add_option("--margin", request.margin_deg, "Phase margin in degrees, with --crossover").between(5, 120);
    command.add_option("--crossover", request.crossover, "Where |L| = 1, in rad/s").above(0);
    command
        .add_option("--sensitivity", request.sensitivity,
                    "Largest |S| = |1 / (1 + L)|; with --margin usually 2, or 1.3 times what the margin alone has")
        .above(1);
    command.add_option("--out", options->out, "Writes the controller there, for generate --controller");
    command.add_flag("--integer", options->integer, "Write the integer PID in place of the fractional one");
    command.add_option("--sample-time-s", options->sample_time_s, "Of the controller; usually the model's").above(0);
    command
        .add_option("--filter-s", request.filter_s,
                    "Lag of the derivative; usually a tenth of 1 / crossover, or of the plant's time")
        .above(0);
    command.add_option("--low", options->low, "Lower limit of the controller's output");
    command.add_option("--high", options->high, "Upper limit");
    command
        .add_option("--setpoint-weight", request.setpoint_weight,
                    "Weight of the set point in what acts at once: kp (b r - y); the derivative likewise")
        .between(0, 1)
        .capture_default_str();
    command.add_option("--setpoint", request.setpoint, "Step of the set point that is tried").capture_default_str();
    command.add_option("--load", request.load,
                       "Step of the load that is tried; usually half of the input that holds the set point");
    command
        .add_option("--until-s", request.until_s,
                    "So long for the set point, and again for the load; usually 20 / crossover")
        .above(0);
    options->json.add_to(command, "--json", "All of it");
    command.add_option("--plot", options->plot,
                       "Also draw gain, phase, |S| and the steps of both: STEM.svg and STEM.png");
    command.callback([options] { run(*options); });
}

}  // namespace cli
