// glsum trend: every counter over several runs.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "base/files.hpp"
#include "bench/gate/trend.hpp"
#include "cli/command.hpp"
#include "cli/output.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

struct Options {
    std::vector<std::filesystem::path> runs;
    std::filesystem::path thresholds = std::filesystem::path(build_info::source_folder) / "results" / "thresholds.toml";
    std::vector<std::string> rows{"*"};
    std::vector<std::string> counters{"*"};
    std::size_t shown = 30;
    bool force = false;
    std::string plot;
    Output json;
};

void run(const Options& options) {
    if (options.runs.size() < 2) {
        throw Failure(Exit::bad_input, fmt::format("RUN: expected two result files or more, the oldest first, found {}",
                                                   options.runs.size()));
    }
    const bench::gate::Rules rules = bench::gate::read_rules(options.thresholds);
    std::vector<bench::NamedResults> runs;
    for (const auto& path : options.runs) {
        runs.push_back({path.string(), bench::read_results(path)});
    }
    const bench::gate::Trend trend = bench::gate::trend(runs, rules, options.rows, options.counters);
    if (!trend.incomparable.empty() && !options.force) {
        throw Failure(Exit::not_comparable,
                      "trend: " + trend.incomparable.front() + "; --force puts them into one row nevertheless");
    }
    if (options.json.wanted()) {
        options.json.write(bench::gate::to_json(trend));
    }
    if (!options.json.to_stdout()) {
        fmt::print("trend of {} runs, the oldest first\n{}", runs.size(), to_table(trend, options.shown));
    }
    if (!options.plot.empty()) {
        if (const auto picture = bench::gate::picture(trend)) {
            base::draw(*picture, options.plot);
            fmt::print("\n{0}.svg and {0}.png\n", options.plot);
        } else {
            fmt::print("\nno picture: nothing changed\n");
        }
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    command.footer(
        "Counters are compared run by run as `compare` does it; a change point is a run that differs from the one "
        "before.\n"
        "Exit status: 0 compared, 2 a file is broken, 4 two runs cannot be compared.\n"
        "Example: glsum trend monday.json tuesday.json today.json --counters '*cycles*' --plot trend");
    command.add_option("RUN", options->runs, "Result files, the oldest first").required();
    command.add_option("--rows", options->rows, "Globs of row names").delimiter(',').capture_default_str();
    command.add_option("--counters", options->counters, "Globs of counters").delimiter(',').capture_default_str();
    command.add_option("--show", options->shown, "How many changes").at_least(0).capture_default_str();
    command.add_option("--plot", options->plot, "Writes FILE.svg and FILE.png").type_name("FILE");
    command.add_option("--thresholds", options->thresholds, "Rules that say which direction is better");
    command.add_flag("--force", options->force, "Put into one row what is not comparable");
    options->json.add_to(command, "--json", "All of it");
    command.callback([options] { run(*options); });
}

}  // namespace cli
