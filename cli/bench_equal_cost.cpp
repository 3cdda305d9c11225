// glsum bench equal-cost: what a number of multiplications a sample buys, kernel by kernel and beside Oustaloup's
// filter.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "base/files.hpp"
#include "bench/rows/result_file.hpp"
#include "bench/run/context.hpp"
#include "bench/studies/equal_cost.hpp"
#include "bench/sweep/signals.hpp"
#include "bench/sweep/sweep.hpp"
#include "cli/checks.hpp"
#include "cli/command.hpp"
#include "cli/rising.hpp"

namespace cli {
namespace {

struct Options {
    std::vector<std::string> costs{"16", "24", "32"};  ///< multiplications a sample, in any order
    std::vector<double> orders = bench::EqualCost().orders;
    std::vector<std::string> signals{std::begin(bench::signal_names), std::end(bench::signal_names)};
    bool quick = false;
    unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
    std::filesystem::path out = results_folder() / "equal-cost.json";
};

void run(const Options& options) {
    bench::EqualCost wanted;
    wanted.costs = to_rising(options.costs, {"--equal-cost", "multiplications", 4, 600});
    wanted.orders = options.orders;
    wanted.signals = options.signals;
    wanted.samples = options.quick ? 1000 : wanted.samples;
    wanted.jobs = options.jobs;
    base::check_writable(options.out);
    const std::vector<bench::Json> rows = bench::measure_equal_cost(wanted);
    fmt::print(
        "Largest error in {} samples, relative to the largest exact sum, in double. A window of L taps takes L - 1 "
        "multiplications (a_0 = 1),\nK near taps and M modes K - 1 + 2M, Oustaloup's filter 2P + 1 for P poles: its "
        "band and mapping are tuned for each order and cost\nto the sums of all these signals together; in the lines "
        "below it, to the derivative of each signal alone.\n{}",
        wanted.samples, bench::to_table(wanted, rows));
    bench::Sweep sweep;
    sweep.targets = {"host"};
    sweep.cores.clear();
    sweep.samples = wanted.samples;
    sweep.orders = wanted.orders;
    sweep.signals = wanted.signals;
    bench::Json context = bench::make_context(bench::Json(), sweep, {});
    context["equal_cost"] = wanted.costs;
    bench::write_results(options.out, context, rows);
    std::filesystem::path stem = options.out;
    stem.replace_extension();
    bench::plot_equal_cost(wanted, rows, stem);
    fmt::print("\n{} rows in {}, drawn in {}.svg and .png\n", rows.size(), options.out.string(), stem.string());
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    command.footer(
        "bench --equal-cost N,N is the same command.\n"
        "Example: glsum bench equal-cost 16,24,32 --orders 0.5 --out my.json");
    command.add_option("multiplications,--equal-cost", options->costs, "A sample, 4 to 600")
        .delimiter(',')
        .capture_default_str();
    command.add_option("--orders", options->orders, "Orders v in (-2, 2]")
        .within(-2, 2)
        .delimiter(',')
        .capture_default_str();
    command.add_option("--signals", options->signals, "Records: step, ramp, sine1, sine5, sine50, noise, drive")
        .delimiter(',')
        .capture_default_str();
    command.add_flag("--quick", options->quick, "Records of 1000 samples instead of 5000");
    command.add_option("--jobs", options->jobs, "Threads at once").between(1, 1024);
    command.add_option("--out", options->out,
                       "Result file (default: results/equal-cost.json); .svg and .png are drawn beside it");
    command.callback([options] {
        check_orders(options->orders);
        check_signals(options->signals);
        run(*options);
    });
}

}  // namespace cli
