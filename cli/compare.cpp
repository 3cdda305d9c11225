// glsum compare: two runs side by side.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "base/files.hpp"
#include "bench/gate/compare.hpp"
#include "cli/command.hpp"
#include "cli/output.hpp"

namespace cli {
namespace {

struct Options {
    std::filesystem::path a;
    std::filesystem::path b;
    std::filesystem::path thresholds = std::filesystem::path(build_info::source_folder) / "results" / "thresholds.toml";
    std::vector<std::string> rows{"*"};
    std::vector<std::string> counters{"*"};
    std::size_t shown = 20;
    bool force = false;
    Output json;
};

void run(const Options& options) {
    const bench::gate::Rules rules = bench::gate::read_rules(options.thresholds);
    const bench::Results a = bench::read_results(options.a);
    const bench::Results b = bench::read_results(options.b);
    const bench::gate::Comparison comparison = bench::gate::compare(a, b, rules, options.rows, options.counters);
    const std::string why_not = bench::gate::incomparable(comparison.differences, "A", "B");
    if (!why_not.empty() && !options.force) {
        throw glsum::Failure(glsum::Exit::not_comparable, "compare: " + why_not + "; --force compares nevertheless");
    }
    if (comparison.pairs.empty()) {
        throw glsum::Failure(glsum::Exit::bad_input, "compare: the two files share no counter of what was asked for");
    }
    if (options.json.wanted()) {
        options.json.write(bench::gate::to_json(comparison));
    }
    if (options.json.to_stdout()) {
        return;
    }
    fmt::print("compare: A is {}, B is {}\n{}", options.a.string(), options.b.string(),
               bench::gate::to_table(comparison, options.shown));
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    command.footer(
        "Host times with repetitions in both files are compared as the gate does: against its anchor, with bounds.\n"
        "Exit status: 0 compared, 2 a file is broken, 4 the two runs cannot be compared.\n"
        "Example: glsum compare before.json after.json --counters '*instructions*'");
    command.add_option("A", options->a, "Result file").required();
    command.add_option("B", options->b, "Result file").required();
    command.add_option("--rows", options->rows, "Globs of row names").delimiter(',').capture_default_str();
    command.add_option("--counters", options->counters, "Globs of counters").delimiter(',').capture_default_str();
    command.add_option("--show", options->shown, "How many of the largest changes").at_least(0).capture_default_str();
    command.add_option("--thresholds", options->thresholds, "Rules that say which direction is better");
    command.add_flag("--force", options->force, "Compare what is not comparable");
    options->json.add_to(command, "--json", "Every pair");
    command.callback([options] { run(*options); });
}

}  // namespace cli
