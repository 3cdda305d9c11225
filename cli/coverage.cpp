#include "cli/coverage.hpp"

#include "base/failure.hpp"
#include "base/progress.hpp"
#include "cli/drive_files.hpp"
#include "drive/coverage_report.hpp"

namespace cli {

using glsum::Exit;
using glsum::Failure;

void add_coverage_options(Command& command, CoverageOptions& options) {
    drive::Acquisition& acquisition = options.acquisition;
    command.add_option("--coverage", options.runs, "Fit so many noisy logs of --start and count the truths inside")
        .at_least(1);
    command.add_option("--input", acquisition.excitation.name, "Of --coverage: step, pulse or staircase")
        .capture_default_str();
    command.add_option("--until-s", acquisition.until_s, "Of --coverage").above(0).capture_default_str();
    command.add_option("--interval-s", acquisition.interval_s, "Of --coverage").above(0).capture_default_str();
    command.add_option("--jitter-s", acquisition.jitter_s, "Of --coverage").at_least(0).capture_default_str();
    command.add_option("--noise", acquisition.noise, "Of --coverage: standard deviation")
        .at_least(0)
        .capture_default_str();
    command.add_option("--quantum", acquisition.quantum, "Of --coverage: step of the encoder")
        .at_least(0)
        .capture_default_str();
}

void show_coverage(const CoverageOptions& options, const Covered& covered) {
    if (covered.model == "search" || covered.model == "tangent") {
        throw Failure(Exit::bad_input, "--coverage: expected --start MODEL.json, the model that the logs come from");
    }
    const drive::Model truth = read_model(covered.model);
    drive::Coverage found;
    {
        base::Progress progress("fitting", options.runs);
        found = drive::measure_coverage(truth, drive::kind_named(covered.form), options.acquisition, options.runs,
                                        covered.seed, covered.jobs, [&] { progress.advance(); });
    }
    put_either(
        covered.json, [&] { return drive::to_json(found, covered.model, covered.form); },
        [&] { return drive::to_text(found, truth, options.acquisition); }, covered.out);
    if (!drive::holds(found) && found.runs >= 100) {
        throw Failure(Exit::check_failed,
                      "coverage: expected each parameter inside its 95 % interval in 90 to 99 of 100 runs");
    }
}

}  // namespace cli
