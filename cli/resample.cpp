// glsum resample: a log with stamps as the logger wrote them, to a constant rate.
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "cli/command.hpp"
#include "cli/drive_files.hpp"
#include "drive/log.hpp"

namespace cli {
namespace {

struct Options {
    std::filesystem::path log;
    drive::Columns columns;
    double step_s = 0.001;
    std::string method = "linear";
    std::filesystem::path out;
};

void run(const Options& options) {
    const drive::Resampled resampled =
        drive::resample(read_log(options.log, options.columns), options.step_s,
                        options.method == "zoh" ? drive::Hold::zero_order : drive::Hold::linear);
    put(drive::to_csv(resampled.log), options.out);
    fmt::print(stderr, "{}: {}\n{} samples at {} s, {}\n", resampled.log.name, resampled.stamps.text(),
               resampled.log.time_s.size(), options.step_s, options.method);
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    options->columns.needs_input = false;
    command.footer(
        "Repeated, backward and missing stamps are reported with their lines: repeated ones give their mean, or are "
        "spread where\nthey came in bursts; backward ones are left out, gaps are bridged.\n"
        "Example: glsum resample log.csv --step-s 0.001 --method linear --out even.csv");
    command.add_option("log,--log", options->log, "Log, CSV with time_s and the output").required();
    command.add_option("--step-s", options->step_s, "New sampling time").above(0).capture_default_str();
    command.add_option("--method", options->method, "linear or zoh (zero-order hold); the input is always held")
        .one_of({"linear", "zoh"})
        .capture_default_str();
    add_column_options(command, options->columns);
    command.add_option("--out", options->out, "CSV file; printed if not given");
    command.callback([options] { run(*options); });
}

}  // namespace cli
