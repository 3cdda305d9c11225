// glsum bench derivative: what each kernel needs to come within so many percent of the derivative itself.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/nearest_name.hpp"
#include "bench/choose/question.hpp"
#include "bench/rows/result_file.hpp"
#include "bench/run/context.hpp"
#include "bench/run/usual_sweep.hpp"
#include "bench/studies/derivative.hpp"
#include "cli/board.hpp"
#include "cli/checks.hpp"
#include "cli/command.hpp"
#include "cli/derivative_goal.hpp"
#include "glsum/catalogue.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

struct Options {
    Budget asked;  ///< error, band, step and the step size
    bool quick = false;
    std::vector<std::string> kernels{"*"};
    std::vector<double> orders;
    std::vector<std::string> targets{std::string(base::machines.front().word)};
    std::vector<std::string> cores;
    unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
    std::filesystem::path out = results_folder() / "derivative.json";
};

// Those that run on every target.
std::vector<std::string> kernels_of(const Options& options) {
    const bool emulated = std::ranges::any_of(
        options.targets, [](const std::string& word) { return base::machine_called(word) != nullptr; });
    bench::Sweep named;
    bench::take_kernels(named, options.kernels);
    std::erase_if(named.kernels, [&](const std::string& kernel) {
        const glsum::CatalogueEntry& facts = *glsum::find_kernel(kernel);
        return facts.history.empty() || (emulated && facts.host_only);
    });
    if (named.kernels.empty()) {
        throw Failure(
            Exit::bad_input,
            fmt::format("--kernels: no kernel is called {}; the nearest is {}", fmt::join(options.kernels, ", "),
                        base::nearest_name(options.kernels.front(), glsum::catalogue, &glsum::CatalogueEntry::name)));
    }
    return named.kernels;
}

// The goal of each order; orders whose derivative of a step is 0 are refused where a step is asked for.
std::vector<glsum::design::DerivativeGoal> goals_of(const Options& options, const std::vector<double>& orders) {
    std::vector<glsum::design::DerivativeGoal> goals;
    for (const double order : orders) {
        Budget asked = options.asked;
        asked.order = order;
        goals.push_back(derivative_goal(asked).value());
        (void)filter_design(asked);  // refuses an order that a rule has no filter for
    }
    return goals;
}

void run(const Options& options) {
    if (options.asked.derivative_error.empty()) {
        throw Failure(Exit::bad_input, "--derivative-error is required, as in 5%");
    }
    bench::Sweep sweep = bench::usual_sweep(options.quick);
    if (!options.orders.empty()) {
        sweep.orders = options.orders;
    }
    check_orders(sweep.orders);
    sweep.targets = options.targets;
    check_targets(sweep.targets);
    take_cores(sweep, options.cores);
    std::erase(sweep.cores, bench::count_only);
    if (sweep.cores.empty()) {
        throw Failure(Exit::bad_input, "--core: expected cores of the timing model, found count alone");
    }
    bench::DerivativeStudy study;
    study.limit = derivative_error(options.asked);
    study.goals = goals_of(options, sweep.orders);
    Budget first = options.asked;
    first.order = sweep.orders.front();
    study.by = filter_design(first);
    sweep.kernels = study.kernels = kernels_of(options);
    study.jobs = options.jobs;
    base::check_writable(options.out);
    std::vector<qemu::Board> boards;
    for (const base::Machine* machine : sweep.machines()) {
        const qemu::Board board = built_board(*machine);
        boards.push_back(board);
        for (const std::string& core : sweep.cores_on(*machine)) {
            study.targets.push_back({bench::on_target(*machine, core), [=](const choose::CountedOrder& order) {
                                         return std::make_unique<choose::OnTarget>(board, order, sweep.samples,
                                                                                   sweep.seed, options.jobs, core);
                                     }});
        }
    }
    if (sweep.wants("host")) {
        study.targets.push_back({std::string(bench::RowKey::host), [=](const choose::CountedOrder& order) {
                                     return std::make_unique<choose::HostTimes>(order, sweep.samples);
                                 }});
    }
    const bench::DerivativeRun found = bench::measure_derivative(study);
    fmt::print(
        "Each kernel at the fewest coefficients of {} that keep the limit at h = {:g} s: certified "
        "as it holds them,\nits noise included, and measured by running it. * no other is as good in error, cost and "
        "bytes\n{}",
        choose::text_of(study.by), options.asked.step_s, bench::to_table(study, found));
    bench::Json context = bench::make_context(bench::Json(), sweep, boards);
    context["step_s"] = options.asked.step_s;
    context["derivative_error"] = study.limit;
    const std::vector<bench::Json> rows = bench::rows_of_derivative(study, found);
    bench::write_results(options.out, context, rows);
    fmt::print("\n{} rows in {}\n", rows.size(), options.out.string());
    for (const double order : sweep.orders) {
        if (std::ranges::none_of(found.points, [&](const auto& one) { return one.order == order && one.meets; })) {
            throw Failure(Exit::check_failed,
                          fmt::format("order {}: no kernel comes within {:g} %; choose says what would do", order,
                                      100.0 * study.limit));
        }
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    options->asked.step_s = 0.001;
    command.footer(
        "Exit status: 0 some kernel of each order keeps the limit; 1 of an order none does; 2 wrong use; 3 something "
        "is "
        "missing.\n"
        "Example: glsum bench --derivative-error 5% --band 0.05..80 --step-until 60 --orders 0.5");
    add_goal(command, options->asked);
    command.add_option("--step-s", options->asked.step_s, "Seconds from sample to sample")
        .within(0, 1000)
        .capture_default_str();
    command.add_flag("--quick", options->quick, "The 4 orders of bench --quick");
    command.add_option("--kernels", options->kernels, "Globs of kernel names").delimiter(',').capture_default_str();
    command.add_option("--orders", options->orders, "Orders v in (-2, 2]").within(-2, 2).delimiter(',');
    command.add_option("--targets", options->targets, "Where the cost is measured: m7, m4, host")
        .delimiter(',')
        .capture_default_str();
    command
        .add_option("--core", options->cores,
                    fmt::format("Cores of the timing model, files of qemu/cores (default: {})",
                                fmt::join(default_cores(), ", ")))
        .delimiter(',');
    command.add_option("--jobs", options->jobs, "Threads and emulators at once").between(1, 1024);
    command.add_option("--out", options->out, "Result file (default: results/derivative.json)");
    command.callback([options] { run(*options); });
}

}  // namespace cli
