// glsum bench horizons: what an error over a longer and longer past costs.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/gnuplot.hpp"
#include "bench/rows/result_file.hpp"
#include "bench/studies/horizons.hpp"
#include "cli/board.hpp"
#include "cli/checks.hpp"
#include "cli/command.hpp"
#include "cli/rising.hpp"
#include "glsum/design/modes.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

struct Options {
    std::vector<std::string> horizons{"600", "5000", "50000", "1000000"};  ///< numbers of samples, in any order
    bench::Horizons wanted;
    std::vector<std::string> targets{"host", "m7"};
    std::filesystem::path out = results_folder() / "horizons.json";
};

void run(Options options) {
    options.wanted.horizons = to_rising(options.horizons, {"--horizons", "samples", 100, 10'000'000});
    for (const double order : options.wanted.orders) {
        if (!glsum::design::has_tail(order)) {
            throw Failure(Exit::bad_input,
                          fmt::format("--orders: expected orders in (-1, 2) that are not whole, found {}", order));
        }
    }
    base::check_writable(options.out);
    bench::Sweep sweep;
    sweep.targets = options.targets;
    for (const base::Machine* machine : sweep.machines()) {
        options.wanted.boards.push_back(built_board(*machine));
    }
    const bench::Study study = bench::measure_horizons(options.wanted);
    fmt::print("{}", study.text);
    bench::write_results(options.out, study.context, study.rows);
    std::filesystem::path stem = options.out;
    stem.replace_extension();
    base::draw(*study.picture, stem);
    fmt::print("\n{} rows in {}, drawn in {}.svg and .png\n", study.rows.size(), options.out.string(), stem.string());
    if (study.wrong > 0) {
        throw Failure(Exit::check_failed,
                      fmt::format("{} designs err more than they promise; they are marked", study.wrong));
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    command.footer(
        "bench --horizons N,N is the same command.\n"
        "Example: glsum bench horizons 600,5000 --orders 0.5 --targets host");
    command.add_option("samples,--horizons", options->horizons, "Pasts, 100 to 10000000 samples")
        .delimiter(',')
        .capture_default_str();
    command.add_option("--orders", options->wanted.orders, "Orders v in (-1, 2) that are not whole")
        .between(-1, 2)
        .delimiter(',')
        .capture_default_str();
    command
        .add_option("--targets", options->targets, "host alone leaves out modelled cycles; m7, m4: beside each other")
        .delimiter(',')
        .capture_default_str();
    command.add_option("--out", options->out,
                       "Result file (default: results/horizons.json); .svg and .png are drawn beside it");
    command.callback([options] {
        check_orders(options->wanted.orders);
        check_targets(options->targets);
        run(*options);
    });
}

}  // namespace cli
