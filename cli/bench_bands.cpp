// glsum bench bands: what cycles buy of a derivative over a band, beside Oustaloup's and Charef's filters.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "bench/rows/result_file.hpp"
#include "bench/run/context.hpp"
#include "bench/studies/bands.hpp"
#include "bench/studies/oustaloup.hpp"
#include "bench/sweep/sweep.hpp"
#include "cli/band.hpp"
#include "cli/board.hpp"
#include "cli/checks.hpp"
#include "cli/command.hpp"
#include "cli/rising.hpp"

namespace cli {
namespace {

struct Options {
    bench::BandStudy study;
    std::vector<std::string> bands{"8..80", "0.8..80", "0.08..80", "0.008..80"};
    std::vector<std::string> poles{"2", "3", "4", "5", "6", "7", "8"};
    std::filesystem::path out = results_folder() / "bands.json";
};

void run(Options options) {
    bench::BandStudy& study = options.study;
    check_orders(study.orders);
    for (const double order : study.orders) {
        if (!bench::Oustaloup::takes(order)) {
            throw glsum::Failure(
                glsum::Exit::bad_input,
                fmt::format("--orders: expected orders in (-1, 2) that are not whole, found {}", order));
        }
    }
    study.bands.clear();
    for (const std::string& band : options.bands) {
        study.bands.push_back(to_band("bands", band, study.step_s));
    }
    study.poles = to_rising(options.poles, {"--poles", "poles", 1, 12});
    base::check_writable(options.out);
    const qemu::Board board = built_board();
    const std::vector<bench::BandPoint> points = bench::measure_bands(study, board);
    fmt::print(
        "Largest |H - (jw)^v| / w^v over each band at h = {:g} s, and modelled cycles of {}. Oustaloup's and Charef's "
        "filters are tuned to\neach band: its edges, the mapping (matched, Tustin's, impulse-invariant) and the gain; "
        "in "
        "parallel form they stand in the cheapest\nkernel that can hold as many poles, and as a cascade of "
        "second-order "
        "sections in cascade_df2t_f32, above order 1 in\ncascadedelta_df2t_f32. The fitted filter is the best within "
        "these cycles. All are certified as the kernel holds them in single\nprecision, with the noise of its "
        "arithmetic. Bytes are of state and coefficients.\n{}",
        study.step_s, study.core, bench::to_table(study, points));
    bench::Sweep sweep;
    sweep.targets = {"m7"};
    sweep.cores = {study.core};
    sweep.orders = study.orders;
    bench::Json context = bench::make_context(bench::Json(), sweep, {board});
    context["step_s"] = study.step_s;
    const std::vector<bench::Json> rows = bench::rows_of_bands(points);
    bench::write_results(options.out, context, rows);
    std::filesystem::path stem = options.out;
    stem.replace_extension();
    bench::plot_bands(study, points, stem);
    fmt::print("\n{} rows in {}, drawn in {}.svg and .png\n", rows.size(), options.out.string(), stem.string());
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    options->study.core = default_core;
    options->study.jobs = std::max(1U, std::thread::hardware_concurrency());
    command.footer("Example: glsum bench bands 0.05..80 --orders 0.5 --out my.json");
    command.add_option("bands", options->bands, "LOW..HIGH in Hz").delimiter(',').capture_default_str();
    command.add_option("--orders", options->study.orders, "Orders v in (-1, 2) that are not whole")
        .between(-1, 2)
        .delimiter(',')
        .capture_default_str();
    command.add_option("--poles", options->poles, "Of Oustaloup's and Charef's filters, 1 to 12")
        .delimiter(',')
        .capture_default_str();
    command.add_option("--step-s", options->study.step_s, "Seconds from sample to sample")
        .within(0, 1000)
        .capture_default_str();
    command.add_option("--core", options->study.core, "Core of the timing model, a file of qemu/cores")
        .capture_default_str();
    command.add_option("--jobs", options->study.jobs, "Threads and emulators at once").between(1, 1024);
    command.add_option("--out", options->out,
                       "Result file (default: results/bands.json); .svg and .png are drawn beside it");
    command.callback([options] { run(*options); });
}

}  // namespace cli
