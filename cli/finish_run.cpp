#include "cli/finish_run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "base/failure.hpp"
#include "bench/report/discretisation_table.hpp"
#include "bench/report/front_table.hpp"
#include "bench/report/plot.hpp"
#include "bench/report/table.hpp"
#include "bench/rows/csv.hpp"
#include "bench/sweep/truncation_bound.hpp"

namespace cli {

namespace {

constexpr std::ptrdiff_t screen_lines = 60;

std::string tables(const std::vector<bench::Group>& groups, const bench::Results& results, const std::string& table) {
    std::string all = bench::to_table(groups, isatty(STDOUT_FILENO) == 1) +
                      bench::discretisation_table(results.context, results.rows);
    if (table == "all" || (table.empty() && std::count(all.begin(), all.end(), '\n') <= screen_lines)) {
        return all;
    }
    const auto costs = bench::report::costs_of(groups);
    const std::string front = bench::report::front_table(bench::report::curve_points(groups, costs), costs);
    return front.empty() ? all : front;
}

}  // namespace

void add_table_option(Command& command, std::string& table) {
    command.add_option("--table", table, "front: the cheapest kernels of each order; all: every kernel at every length")
        .one_of({"front", "all"})
        .default_str("all where it fits a screen");
}

void finish_run(const std::filesystem::path& out, const bench::Results& results, unsigned jobs,
                const std::string& table) {
    const std::vector<bench::Group> groups = bench::group(results.rows);
    if (groups.empty()) {
        throw glsum::Failure(glsum::Exit::bad_input,
                             fmt::format("{}: not written: the sweep has no rows of kernels (peers are timed on the "
                                         "host alone)",
                                         out.string()));
    }
    bench::write_results(out, results.context, results.rows);
    std::filesystem::path stem = out;
    stem.replace_extension();
    const auto beside = [&](const char* end) { return std::filesystem::path(stem) += end; };
    // Dashboards of Google Benchmark's files draw every row's time: a row of accuracy would be a line at 0.
    std::vector<bench::Json> timed;
    std::ranges::copy_if(results.rows, std::back_inserter(timed), bench::is_timed);
    bench::write_results(beside("-times.json"), results.context, timed);
    bench::write_csv(beside(".csv"), results.rows);
    bench::write_tidy_csv(beside("-tidy.csv"), results.rows);
    bench::plot_error(groups, worst_of_signals(bench::truncation_bounds(results.context, results.rows, jobs)), stem);
    fmt::print(
        "{}\n{} rows in {}\nbeside it: -times.json, .csv, -tidy.csv, .svg and .png; glsum report makes a page of it\n",
        tables(groups, results, table), results.rows.size(), out.string());
    check_rows(results);
}

void check_rows(const bench::Results& results) {
    const auto wrong = std::count_if(results.rows.begin(), results.rows.end(), bench::is_wrong);
    if (wrong > 0) {
        throw glsum::Failure(glsum::Exit::check_failed,
                             fmt::format("{} of {} rows are wrong or impossible; they are marked and not ranked", wrong,
                                         results.rows.size()));
    }
}

}  // namespace cli
