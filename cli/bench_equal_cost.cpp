#include "cli/bench_equal_cost.hpp"

#include <fmt/format.h>

#include "bench/context.hpp"
#include "bench/equal_cost.hpp"
#include "bench/files.hpp"
#include "bench/result_file.hpp"
#include "bench/signals.hpp"
#include "bench/sweep.hpp"
#include "cli/rising.hpp"

namespace cli {
void run_equal_cost_bench(const EqualCostBench& options) {
    bench::EqualCost wanted;
    wanted.costs = to_rising(options.costs, {"--equal-cost", "multiplications", 4, 600});
    wanted.orders = options.orders.empty() ? wanted.orders : options.orders;
    wanted.signals = options.signals;
    if (wanted.signals.empty()) {
        wanted.signals.assign(std::begin(bench::signal_names), std::end(bench::signal_names));
    }
    wanted.samples = options.quick ? 1000 : wanted.samples;
    wanted.jobs = options.jobs;
    bench::check_writable(options.out);
    const std::vector<bench::Json> rows = bench::measure_equal_cost(wanted);
    fmt::print(
        "Largest error of the sum in {} samples, relative to the largest exact sum, in double. Of Oustaloup's filter "
        "the "
        "best band\nand mapping for each figure.\n{}",
        wanted.samples, bench::to_table(wanted, rows));
    bench::Sweep sweep;
    sweep.targets = {"host"};
    sweep.cores.clear();
    sweep.samples = wanted.samples;
    sweep.orders = wanted.orders;
    sweep.signals = wanted.signals;
    bench::Json context = bench::make_context(bench::Json(), sweep, nullptr);
    context["equal_cost"] = wanted.costs;
    bench::write_results(options.out, context, rows);
    std::filesystem::path stem = options.out;
    stem.replace_extension();
    bench::plot_equal_cost(wanted, rows, stem);
    fmt::print("\n{} rows in {}, drawn in {}.svg and .png\n", rows.size(), options.out.string(), stem.string());
}

}  // namespace cli
