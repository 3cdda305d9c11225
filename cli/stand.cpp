// glsum stand: logs of the virtual stand.
#include "drive/stand/stand.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/gnuplot.hpp"
#include "base/progress.hpp"
#include "cli/command.hpp"
#include "cli/drive_files.hpp"
#include "cli/name_value.hpp"
#include "drive/pictures.hpp"
#include "drive/stand/blind/set_folder.hpp"
#include "drive/stand/experiment.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

struct Options {
    std::filesystem::path stand;
    std::vector<std::string> set;
    std::vector<std::string> without;
    std::vector<std::string> only;
    bool ideal = false;
    stand::Experiment experiment;
    std::uint64_t seed = 1;
    bool truth = false;
    bool show = false;
    std::size_t blind = 0;
    bool no_model = false;
    unsigned jobs = 1;
    std::filesystem::path model;
    std::filesystem::path out;
    std::filesystem::path plot;
};

stand::Stand build_stand(const Options& options) {
    stand::Stand built;
    if (!options.stand.empty()) {
        built = stand::parse_stand(base::read_file(options.stand, 1U << 20U), options.stand.string());
    }
    for (const std::string& effect : options.without) {
        stand::remove_effect(built, effect);
    }
    if (options.ideal || !options.only.empty()) {
        stand::keep_effects(built, options.only);
    }
    for (const std::string& word : options.set) {
        const auto [name, value] = split_at_equals(word);
        const auto number = to_number<double>(value);
        if (!number || std::isnan(*number)) {
            throw Failure(Exit::bad_input, fmt::format("--set: expected NAME=NUMBER, found {}", word));
        }
        stand::set_size(built, name, *number);
    }
    stand::check(built, options.stand.empty() ? "stand" : options.stand.string());
    return built;
}

// The hash of the truth is told before there is any case.
void write_blind(const Options& options) {
    if (options.out.empty()) {
        throw Failure(Exit::bad_input, "stand --blind: expected --out FOLDER");
    }
    base::check_new_or_empty(options.out);
    stand::blind::Set set;
    {
        base::Progress progress("blind cases", options.blind);
        set = (options.no_model ? stand::blind::make_open_set : stand::blind::make_set)(
            options.blind, options.seed, options.jobs, [&] { progress.advance(); });
    }
    stand::blind::write_set(set, options.out, [](const std::string& hash) {
        fmt::print("sha256 of the sealed truth: {}\n", hash);
        std::fflush(stdout);
    });
    fmt::print("{} cases, seed {}, in {}\n", set.cases.size(), options.seed, options.out.string());
}

void run(const Options& options) {
    if (options.blind > 0) {
        write_blind(options);
        return;
    }
    if (options.no_model) {
        throw Failure(Exit::bad_input, "stand --no-model: expected --blind N beside it");
    }
    const stand::Stand built = build_stand(options);
    if (!options.model.empty()) {
        base::write_file(options.model, stand::linear_model_json(built));
    }
    if (options.show) {
        put(stand::to_toml(built), options.out);
        return;
    }
    const bool series = options.experiment.name == "series";
    std::vector<stand::Record> records;
    stand::Experiment experiment = options.experiment;
    if (series) {
        if (options.out.empty()) {
            throw Failure(Exit::bad_input, "stand: expected --out FOLDER for the logs of a series");
        }
        experiment.name = "pulse";
        records = stand::run_series(built, experiment, options.seed);
        std::error_code error;
        std::filesystem::create_directories(options.out, error);
    } else {
        records.push_back(stand::run(built, experiment, options.seed));
    }
    std::vector<drive::Curve> curves;
    for (std::size_t i = 0; i < records.size(); ++i) {
        const auto path = series ? options.out / fmt::format("series-{}.csv", i + 1) : options.out;
        put(stand::to_csv(records[i], options.truth), path);
        if (!path.empty()) {
            fmt::print(stderr, "{}: {}\n", path.string(), stand::to_text(records[i]));
        }
        curves.push_back(
            {series ? fmt::format("series {}", i + 1) : "read", records[i].time_s, records[i].angle_rad, !series});
    }
    if (!options.plot.empty()) {
        if (!series) {
            std::vector<double> angle;
            for (const stand::Point& point : records[0].truth.points) {
                angle.push_back(point.angle_rad);
            }
            curves.push_back({"true angle", records[0].time_s, angle});
        }
        base::draw(drive::picture_of_curves(curves, "Virtual stand: " + options.experiment.name, "angle [rad]"),
                   options.plot);
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    options->experiment.name = "series";
    command.footer(
        "Each effect has sizes (--show prints all) and can be absent. The same seed gives the same logs.\n"
        "Example: glsum stand --out build/stand                               (series 1 to 4 of the paper's Fig. 3)\n"
        "Example: glsum stand --experiment chirp --duty 0.4 --until-s 60 --seed 7 --out chirp.csv\n"
        "Example: glsum stand --only coulomb_friction,encoder_quantisation --experiment staircase --out log.csv\n"
        "Example: glsum stand --ideal --model linear.json --experiment prbs --out linear.csv\n"
        "Example: glsum stand --blind 100 --seed 7 --out build/blind    (then diagnose --batch and score)\n"
        "Example: glsum stand --blind 100 --no-model --seed 7 --out build/open");
    command.add_option("--stand", options->stand, "TOML with parts and effects; what it leaves out has its usual size");
    command.add_option("--set", options->set, "EFFECT.SIZE=NUMBER, or a part's NAME=NUMBER; repeatable");
    command.add_option("--without", options->without, "Effects that are absent").delimiter(',');
    command.add_option("--only", options->only, "All others are absent").delimiter(',');
    command.add_flag("--ideal", options->ideal, "All effects are absent: a linear plant; --set brings one back");
    command.add_flag("--show", options->show, "Print the stand with all sizes, as TOML, and run nothing");
    command.add_option("--model", options->model, "Also write the linear plant without effects as a model file");
    command
        .add_option("--experiment", options->experiment.name,
                    "series (four pulses into a folder), pulse, step, staircase, ramp, chirp, prbs or release")
        .capture_default_str();
    command.add_option("--duty", options->experiment.duty, "Of step and pulse; the highest of others")
        .between(0, 1)
        .capture_default_str();
    command.add_option("--low-duty", options->experiment.low_duty, "The lowest of staircase, ramp, chirp and prbs")
        .between(0, 1)
        .capture_default_str();
    command.add_option("--off-s", options->experiment.off_s, "When the pulse ends").at_least(0).capture_default_str();
    command.add_option("--until,--until-s", options->experiment.until_s, "Length of the record in s")
        .above(0)
        .capture_default_str();
    command.add_option("--stairs", options->experiment.stairs, "Stairs up, and down again")
        .at_least(1)
        .capture_default_str();
    command.add_option("--from-hz", options->experiment.from_hz, "Of the chirp").above(0).capture_default_str();
    command.add_option("--to-hz", options->experiment.to_hz, "Of the chirp").above(0).capture_default_str();
    command.add_option("--bit-s", options->experiment.bit_s, "Of the PRBS").above(0).capture_default_str();
    command.add_option("--angle", options->experiment.angle_rad, "Release: where the bar is held, in rad")
        .capture_default_str();
    command.add_option("--seed", options->seed, "Of stamps, noise and bits").at_least(0).capture_default_str();
    command.add_flag("--truth", options->truth, "Further columns: what nobody measured");
    command.add_option("--out", options->out, "CSV file, or the folder of a series; printed if not given");
    command.add_option("--plot", options->plot, "Draw STEM.svg and STEM.png");
    command
        .add_option("--blind", options->blind,
                    "Instead: so many cases for a diagnosis, each with a model, two logs and an effect that only "
                    "the sealed truth names, into the folder --out")
        .between(1, 999);
    command.add_flag("--no-model", options->no_model,
                     "Of --blind: cases without a model, of mechanical, thermal and hydraulic plants");
    command.add_option("--jobs", options->jobs, "Threads, of --blind").at_least(1);
    command.callback([options] { run(*options); });
}

}  // namespace cli
