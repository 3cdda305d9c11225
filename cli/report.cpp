// glsum report: result files as a page to look at.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "base/build_info.hpp"
#include "base/failure.hpp"
#include "base/files.hpp"
#include "bench/report/best.hpp"
#include "bench/report/classic.hpp"
#include "bench/report/report.hpp"
#include "bench/rows/result_file.hpp"
#include "cli/command.hpp"

namespace cli {
namespace {

struct Options {
    std::vector<std::filesystem::path> files;
    std::filesystem::path out;
    unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
};

bench::report::Input read(const std::filesystem::path& path, unsigned jobs) {
    bench::Results results = bench::read_results(path);
    auto bounds = bench::truncation_bounds(results.context, results.rows, jobs);
    return {path.filename().string(), std::move(results), std::move(bounds)};
}

void run(Options options) {
    if (options.files.empty()) {
        options.files = {std::filesystem::path(build_info::source_folder) / "results" / "latest.json"};
    }
    if (options.out.empty()) {
        options.out = options.files[0];
        options.out.replace_extension(".html");
    }
    for (const auto& file : options.files) {
        if (std::filesystem::weakly_canonical(file) == std::filesystem::weakly_canonical(options.out)) {
            throw glsum::Failure(glsum::Exit::bad_input,
                                 fmt::format("--out: {} is a result file; it would be overwritten", file.string()));
        }
    }
    if (options.out.extension() != ".html" && options.out.extension() != ".htm") {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("--out: expected a name that ends in .html, found {}", options.out.string()));
    }
    base::check_writable(options.out);
    const bench::report::Input input = read(options.files[0], options.jobs);
    const auto other = options.files.size() > 1 ? std::optional(read(options.files[1], options.jobs)) : std::nullopt;
    const auto written = bench::report::write_report(input, other ? &*other : nullptr, options.out);
    fmt::print("{} rows of {}", input.results.rows.size(), options.files[0].string());
    if (other) {
        fmt::print(" and {} of {}", other->results.rows.size(), options.files[1].string());
    }
    fmt::print("\n");
    for (const auto& file : written) {
        fmt::print("  {} ({:.0f} kB)\n", file.string(), static_cast<double>(std::filesystem::file_size(file)) / 1e3);
    }
    const auto groups = bench::group(input.results.rows);
    const auto costs = bench::report::costs_of(groups);
    const auto points = bench::report::curve_points(groups, costs);
    for (const std::string& table :
         {bench::report::best_table(points, costs), bench::report::gain_table(points, costs)}) {
        if (!table.empty()) {
            fmt::print("\n{}", table);
        }
    }
}

}  // namespace

void add_options(Command& command, const Words&) {
    auto options = std::make_shared<Options>();
    command.footer(
        "The page is one file, loads nothing and opens in any browser.\n"
        "Example: glsum report results/latest.json other.json --out compared.html");
    command
        .add_option("files", options->files, "Result files: A (default results/latest.json), then B to hold against it")
        .expected(0, 2);
    command.add_option("--out", options->out,
                       "The page; .csv, .svg and .png are written beside it (default: beside A)");
    command.add_option("--jobs", options->jobs, "Threads").at_least(1);
    command.callback([options] { run(*options); });
}

}  // namespace cli
