// Rows and tables of what kernels need for a derivative, of points that are made by hand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/studies/derivative.hpp"
#include "tests/choose/costs_by.hpp"

namespace {

using bench::DerivativePoint;
using bench::DerivativeRun;
using bench::DerivativeStudy;
using bench::Json;
using glsum::design::Band;

DerivativePoint point_of(double order, const std::string& kernel, const std::string& taps, double band, double step,
                         std::vector<choose::Cost> costs = {}) {
    DerivativePoint point{};
    point.order = order;
    point.kernel = kernel;
    point.taps = taps;
    point.report.certified.band = band;
    point.report.certified.step = step;
    point.report.measured.band = 0.015625;
    point.report.measured.step = 0.0078125;
    point.meets = !costs.empty();
    point.costs = std::move(costs);
    return point;
}

// Of order 0.5 a band and a step, of order -0.5 the step alone; on this machine and on a modelled one.
DerivativeStudy two_goals() {
    DerivativeStudy study;
    study.goals = {{0.5, 0.001, Band{0.5, 80.0}, 60.0}, {-0.5, 0.001, {}, 20.0}};
    study.limit = 0.05;
    study.targets = {{"host", {}}, {"m7:stm32f746-itcm", {}}};
    return study;
}

// Behind each kernel its costs: what is ranked, what a limit holds against, half the spread, bytes.
DerivativeRun made_run() {
    DerivativeRun run;
    run.points = {
        point_of(0.5, "modes_plain_f32", "1+5", 0.03125, 0.015625, {{20, 60, 0, 48, ""}, {30, 33.5, 0, 48, ""}}),
        point_of(0.5, "ring_plain_f32", "12", 0.046875, 0.03125, {{10, 30, 0, 96, ""}, {40, 44, 0, 96, ""}}),
        point_of(0.5, "modesdelta_plain_f32", "2+4", 0.04296875, 0.015625,
                 {{15, 45, 0, 52, ""}, {1, 1, 0, 1, "it is broken"}}),
        point_of(0.5, "cascade_df2t_f32", "2+3", 0.25, 0.125),
        point_of(0.5, "ring_oldest_f32", "16", 0.125, 0.1875),
        point_of(0.5, "modes_plain_f64", "1+1", 0.1875, 0.125),
        point_of(-0.5, "modessum_plain_f32", "1+4", 0.0, 0.03125, {{8, 24, 0, 40, ""}, {9, 12, 0, 40, ""}}),
        point_of(-0.5, "modessum_plain_f32", "2+4", 0.0, 0.015625, {{7, 21, 0, 44, ""}, {9.5, 12.5, 0, 44, ""}}),
    };
    return run;
}

TEST(DerivativeRows, AreOneForEachTargetAndOneOfAccuracyForWhatMisses) {
    const std::vector<Json> rows = bench::rows_of_derivative(two_goals(), made_run());
    std::vector<std::string> names;
    for (const Json& row : rows) {
        names.push_back(row.at("name").get<std::string>());
    }
    const std::string both = "/hz:0.5..80/until:60";
    EXPECT_EQ(names, (std::vector<std::string>{
                         "derivative/modes_plain_f32/order:0.5/taps:1+5/host" + both,
                         "derivative/modes_plain_f32/order:0.5/taps:1+5/m7:stm32f746-itcm" + both,
                         "derivative/ring_plain_f32/order:0.5/taps:12/host" + both,
                         "derivative/ring_plain_f32/order:0.5/taps:12/m7:stm32f746-itcm" + both,
                         "derivative/modesdelta_plain_f32/order:0.5/taps:2+4/host" + both,
                         "derivative/modesdelta_plain_f32/order:0.5/taps:2+4/m7:stm32f746-itcm" + both,
                         "derivative/cascade_df2t_f32/order:0.5/taps:2+3/accuracy" + both,
                         "derivative/ring_oldest_f32/order:0.5/taps:16/accuracy" + both,
                         "derivative/modes_plain_f64/order:0.5/taps:1+1/accuracy" + both,
                         "derivative/modessum_plain_f32/order:-0.5/taps:1+4/host/until:20",
                         "derivative/modessum_plain_f32/order:-0.5/taps:1+4/m7:stm32f746-itcm/until:20",
                         "derivative/modessum_plain_f32/order:-0.5/taps:2+4/host/until:20",
                         "derivative/modessum_plain_f32/order:-0.5/taps:2+4/m7:stm32f746-itcm/until:20",
                     }));
    for (const Json& row : rows) {
        EXPECT_EQ(row.at("iterations"), 1) << row;
    }
}

TEST(DerivativeRows, HaveTheErrorsThatWereAskedForAndTheTargetsOwnCosts) {
    const std::vector<Json> rows = bench::rows_of_derivative(two_goals(), made_run());
    ASSERT_EQ(rows.size(), 13U);
    const auto has_none = [](const Json& row, const std::vector<std::string>& fields) {
        for (const std::string& field : fields) {
            EXPECT_FALSE(row.contains(field)) << field << ' ' << row;
        }
    };
    for (const std::size_t i : {0U, 1U}) {
        EXPECT_EQ(rows[i].at("band_error"), 0.03125);
        EXPECT_EQ(rows[i].at("measured_band_error"), 0.015625);
        EXPECT_EQ(rows[i].at("step_error"), 0.015625);
        EXPECT_EQ(rows[i].at("measured_step_error"), 0.0078125);
        EXPECT_EQ(rows[i].at("memory_bytes"), 48.0);
        EXPECT_FALSE(rows[i].contains("error_message"));
    }
    EXPECT_EQ(rows[0].at("real_time"), 20.0);
    EXPECT_EQ(rows[0].at("cpu_time"), 20.0);
    EXPECT_EQ(rows[0].at("cycles_per_sample"), 60.0);
    has_none(rows[0], {"model_cycles_per_sample", "model_cycles_high"});
    EXPECT_EQ(rows[1].at("real_time"), 0.0);
    EXPECT_EQ(rows[1].at("model_cycles_per_sample"), 30.0);
    EXPECT_EQ(rows[1].at("model_cycles_high"), 33.5);
    has_none(rows[1], {"cycles_per_sample"});
    // What is broken has its errors and no cost.
    EXPECT_EQ(rows[5].at("error_message"), "it is broken");
    EXPECT_EQ(rows[5].at("band_error"), 0.04296875);
    has_none(rows[5], {"model_cycles_per_sample", "model_cycles_high", "cycles_per_sample", "memory_bytes"});
    EXPECT_EQ(rows[4].at("memory_bytes"), 52.0);
    // What misses the limit likewise, and is not wrong.
    EXPECT_EQ(rows[7].at("step_error"), 0.1875);
    has_none(rows[7], {"model_cycles_per_sample", "cycles_per_sample", "memory_bytes", "error_message"});
    for (const std::size_t i : {9U, 10U, 11U, 12U}) {
        has_none(rows[i], {"band_error", "measured_band_error"});
        EXPECT_EQ(rows[i].at("step_error"), i < 11 ? 0.03125 : 0.015625);
    }
}

// Percentages are rounded up; starred is what no other betters in cost, error and bytes.
TEST(DerivativeTable, HasTheCheapestFirstAndTheNearestOfThoseThatMiss) {
    DerivativeRun run = made_run();
    const std::string expected = R"(
Order 0.5, within 5 %, from 0.5 to 80 Hz, a step from 0.01 s until 60 s: 3 of 6 kernels
  kernel                         taps          certified           measured         ns   at most   bytes  host
  ring_plain_f32                   12     4.69 %, 3.13 %    1.57 %, 0.782 %       10.0                96  *
  modesdelta_plain_f32            2+4      4.3 %, 1.57 %    1.57 %, 0.782 %       15.0                52  *
  modes_plain_f32                 1+5     3.13 %, 1.57 %    1.57 %, 0.782 %       20.0                48  *
  kernel                         taps          certified           measured     cycles   at most   bytes  m7:stm32f746-itcm
  modes_plain_f32                 1+5     3.13 %, 1.57 %    1.57 %, 0.782 %       30.0      33.5      48  *
  ring_plain_f32                   12     4.69 %, 3.13 %    1.57 %, 0.782 %       40.0      44.0      96
  of the others the nearest: ring_oldest_f32 with 16 taps, 12.5 %, 18.8 % at best

Order -0.5, within 5 %, a step from 0.01 s until 20 s: 1 of 1 kernels
  kernel                         taps          certified           measured         ns   at most   bytes  host
  modessum_plain_f32              2+4             1.57 %            0.782 %        7.0                44  *
  modessum_plain_f32              1+4             3.13 %            0.782 %        8.0                40  *
  kernel                         taps          certified           measured     cycles   at most   bytes  m7:stm32f746-itcm
  modessum_plain_f32              1+4             3.13 %            0.782 %        9.0      12.0      40  *
  modessum_plain_f32              2+4             1.57 %            0.782 %        9.5      12.5      44  *
)";
    EXPECT_EQ(bench::to_table(two_goals(), run), expected);
    run.left_out = {"left out, since one", "left out, since another"};
    EXPECT_EQ(bench::to_table(two_goals(), run), expected + "\nleft out, since one\nleft out, since another\n");
}

// One near tap, or two, and modes, of whatever order; a sum of order 0.9 would keep more near taps.
TEST(DerivativeStudy, LengthsAreThoseOfFittedFiltersAndSoAreTheirCosts) {
    std::vector<std::pair<double, std::size_t>> asked;
    DerivativeStudy study;
    study.goals = {{0.9, 0.001, Band{8.0, 80.0}, {}}};
    study.limit = 0.1;
    study.kernels = {"modes_plain_f32"};
    study.targets = {{"host", [&](const choose::CountedOrder& order) {
                          EXPECT_TRUE(order.fitted);
                          return std::make_unique<test::CostsBy>([&, order](const std::string&, std::size_t taps) {
                              asked.emplace_back(order.order, taps);
                              return choose::Cost{static_cast<double>(taps), 0.0, 0.0, 0.0, ""};
                          });
                      }}};
    const DerivativeRun run = bench::measure_derivative(study);
    ASSERT_FALSE(run.points.empty());
    std::vector<std::pair<double, std::size_t>> expected;
    for (const DerivativePoint& point : run.points) {
        ASSERT_TRUE(point.meets);
        const std::size_t modes = (point.coefficients - 1) / 2;
        EXPECT_EQ(point.taps, fmt::format("{}+{}", point.coefficients - 2 * modes, modes));
        expected.emplace_back(0.9, point.coefficients);
        ASSERT_EQ(point.costs.size(), 1U);
        EXPECT_EQ(point.costs.front().value, static_cast<double>(point.coefficients));
    }
    EXPECT_EQ(asked, expected);
    EXPECT_TRUE(run.left_out.empty());
}

TEST(DerivativeStudy, IsOfFittedFiltersByOneAtATime) {
    EXPECT_EQ(DerivativeStudy().by, choose::FilterDesign::fitted);
    EXPECT_EQ(DerivativeStudy().jobs, 1U);
}

}  // namespace
