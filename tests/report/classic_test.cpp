// What windows of samples cost beside all kernels: the two fronts, how many times the cost, their picture.
#include "bench/report/classic.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "bench/report/best.hpp"
#include "bench/report/columns.hpp"
#include "bench/report/curves.hpp"
#include "tests/bench/pretend_gnuplot.hpp"
#include "tests/report/pretend_results.hpp"

namespace {

using namespace bench::report;

// Of one signal: what each costs and errs. The newer order comes first and has no classic window.
std::vector<bench::Json> old_and_new() {
    std::vector<bench::Json> rows;
    const auto add = [&](const std::string& kernel, const std::string& order, const std::string& taps, double error,
                         double cycles, double bytes) {
        const std::string name = "gl/" + kernel + "/order:" + order + "/taps:" + taps;
        rows.emplace_back(bench::make_row(name + "/accuracy/signal:step", 1))["error_max"] = error;
        auto& cost = rows.emplace_back(bench::make_row(name + "/m7:f746", 1));
        cost["instructions_per_sample"] = cycles;
        cost["model_cycles_per_sample"] = cycles;
        cost["state_bytes"] = bytes - 40;
        cost["coefficient_bytes"] = 40;
    };
    add("modes_plain_f32", "1.5", "2+7", 5e-3, 60, 100);
    add("shift_plain_f32", "0.5", "600", 5e-3, 900, 4800);
    add("ring_plain_f32", "0.5", "600", 5e-3, 600, 4900);
    add("mirror_multi_f32", "0.5", "full", 5e-5, 5000, 60000);
    add("mirrordelta_plain_f32", "0.5", "200", 5e-3, 300, 2000);
    add("block_oldestfma_f32", "0.5", "full", 5e-5, 3000, 40000);
    add("modes_plain_f32", "0.5", "2+7", 5e-3, 60, 100);
    add("modes_plain_f32", "0.5", "2+11", 1e-4, 90, 160);
    add("ring_plain_f32", "-0.5", "50", 5e-4, 300, 3000);
    add("modes_plain_f32", "-0.5", "2+5", 5e-4, 100, 60);
    return rows;
}

TEST(Classic, IsAWindowOfSamplesAsTheyCame) {
    const bench::Group window{"0.5", "full", {}};
    const bench::Group modes{"0.5", "2+7", {}};
    const auto classic = [](const bench::Group& group, const char* kernel) {
        bench::Entry entry;
        entry.kernel = kernel;
        return is_classic({&group, &entry, {}});
    };
    for (const char* kernel : {"shift_fir_q31", "ring_plain_f32", "mirror_smlaldshaped_q15"}) {
        EXPECT_TRUE(classic(window, kernel)) << kernel;
        EXPECT_FALSE(classic(modes, kernel)) << kernel;
    }
    for (const char* kernel : {"mirrordelta_plain_f32", "mirrorhold_plain_f32", "mirrorlinear_multi_f32",
                               "block_plain_q31", "peer_std_f32", "mirro", "a_ring_f32", ""}) {
        EXPECT_FALSE(classic(window, kernel)) << kernel;
    }
}

TEST(Classic, HasAFrontOfItsOwn) {
    const auto groups = bench::group(old_and_new());
    const auto costs = costs_of(groups);
    const auto cost = *deciding_cost(costs);
    std::vector<std::string> front;
    for (const auto& point : classic_points(curve_points(groups, costs), costs)) {
        front.push_back(point.entry->kernel + (point.front[cost] ? " is on it" : " is not"));
    }
    EXPECT_EQ(front, (std::vector<std::string>{"shift_plain_f32 is not", "ring_plain_f32 is on it",
                                               "mirror_multi_f32 is on it", "ring_plain_f32 is on it"}));
}

TEST(Classic, ItsCostsAreHeldAgainstThoseOfAllKernels) {
    const auto groups = bench::group(old_and_new());
    const auto costs = costs_of(groups);
    const auto points = curve_points(groups, costs);
    const std::vector<std::size_t> wanted = gain_costs(points, costs);
    ASSERT_EQ(wanted.size(), 2U);
    EXPECT_EQ(costs[wanted[0]].name, "model_cycles:f746");
    EXPECT_EQ(costs[wanted[1]].name, "bytes");
    const auto classic = classic_points(points, costs);
    std::vector<double> factors;
    for (const Gain& gain : gains(classic, points, costs, wanted[0])) {
        factors.push_back(factor(gain, costs[wanted[0]]).value_or(0.0));
    }
    EXPECT_EQ(factors, (std::vector<double>{0, 0, 0, 0, 600.0 / 60, 5000.0 / 90, 5000.0 / 90, 0, 3, 3, 0, 0}));
    const std::string table = gain_table(points, costs);
    for (const char* line : {"       1.5  1e-02             none             60                            none"
                             "            100\n",
                             "       0.5  1e-02              600             60           10.0             4800"
                             "            100           48.0\n",
                             "       0.5  1e-06             none           none                            none"
                             "           none\n",
                             "       all  1e-03              3.0           29.3           55.6             50.0"
                             "          212.5          375.0\n",
                             "       all  1e-06             none           none           none"}) {
        EXPECT_NE(table.find(line), std::string::npos) << line << table;
    }
    EXPECT_EQ(gain_table({}, costs), "");
}

TEST(Classic, ThePictureShowsBothFrontsAndTheirFactors) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "report_fronts";
    std::filesystem::create_directories(folder);
    const auto groups = bench::group(old_and_new());
    const auto costs = costs_of(groups);
    plot_gains(folder / "fronts", curve_points(groups, costs), costs);
    const std::string svg = base::read_file(folder / "fronts.svg", 1'000'000);
    const auto count = [&](const std::string& text) {
        std::size_t found = 0;
        for (std::size_t at = svg.find(text); at != std::string::npos; at = svg.find(text, at + 1)) {
            ++found;
        }
        return found;
    };
    for (const char* once : {">before: shift, ring and mirror windows</tspan>", ">after: all kernels</tspan>", ">10×<",
                             ">56×<", ">3.0×<", ">48×<", ">375×<", ">50×<"}) {
        EXPECT_EQ(count(once), 1U) << once;
    }
    EXPECT_EQ(count("×<"), 6U);
    EXPECT_EQ(count(">error / largest exact sum<"), 2U);
    for (const char* of_each_order : {"f746, modelled cycles per sample", "bytes of state and coefficients"}) {
        EXPECT_EQ(count(of_each_order), 3U + 1U) << of_each_order;  // and in the title
    }
    for (const char* of_each_cost : {">order 1.5<", ">order 0.5<", ">order -0.5<"}) {
        EXPECT_EQ(count(of_each_cost), 2U) << of_each_cost;
    }
    EXPECT_GT(std::filesystem::file_size(folder / "fronts.png"), 0U);
    std::filesystem::remove_all(folder);
}

class GainPlot : public PretendGnuplot {};

// Three panels to a row. A cost begins a row of its own: what is left of the last one stays empty.
TEST_F(GainPlot, EachCostBeginsItsOwnRow) {
    std::vector<bench::Json> rows;
    for (const char* order : {"0.3", "0.5", "0.7", "0.9"}) {
        for (bench::Json row : old_and_new()) {
            std::string name = row["name"];
            if (const std::size_t at = name.find("/order:0.5/"); at != std::string::npos) {
                row["name"] = name.replace(at, 11, std::string("/order:") + order + "/");
                rows.push_back(row);
            }
        }
    }
    const auto groups = bench::group(rows);
    const auto costs = costs_of(groups);
    const auto points = curve_points(groups, costs);
    ASSERT_EQ(gain_costs(points, costs).size(), 2U);
    plot_gains(stem(), points, costs);
    const std::string script = sent();
    EXPECT_NE(script.find("set multiplot layout 4,3 "), std::string::npos);
    std::string cells;
    std::istringstream lines(script);
    for (std::string line; std::getline(lines, line);) {
        cells += line.starts_with("plot ") ? "p" : line == "set multiplot next" ? "." : "";
    }
    EXPECT_EQ(cells, "pppp..pppp..");
}

}  // namespace
