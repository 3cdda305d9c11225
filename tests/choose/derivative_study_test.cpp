// What each kernel needs to come near a derivative: which lengths, which rows, what the table says.
#include "bench/studies/derivative.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/rows/key.hpp"
#include "tests/choose/costs_by.hpp"

namespace {

using bench::DerivativePoint;
using bench::DerivativeStudy;
using glsum::design::Band;
using testing::HasSubstr;

// A mode costs two cycles and a near tap five, as nearly on a Cortex-M7; a byte a coefficient.
std::unique_ptr<choose::CostSource> made_costs(const choose::CountedOrder& order) {
    return std::make_unique<test::CostsBy>([order](const std::string& kernel, std::size_t taps) {
        const auto modes = static_cast<double>(order.length(kernel, taps, 1000).modes.value_or(0));
        const double cycles = 2.0 * modes + 5.0 * (static_cast<double>(taps) - 2.0 * modes);
        return choose::Cost{cycles, cycles + 1.0, 0.0, static_cast<double>(taps),
                            kernel == "modes_plain_f64" ? "it is broken" : ""};
    });
}

DerivativeStudy study_of(double limit, std::vector<std::string> kernels) {
    DerivativeStudy study;
    for (const double order : {0.5, -0.5}) {
        study.goals.push_back({order, 0.001, Band{0.5, 80.0}, {}});
    }
    study.limit = limit;
    study.kernels = std::move(kernels);
    study.targets = {{"m7:stm32f746-itcm", made_costs}};
    return study;
}

TEST(DerivativeStudy, EachKernelStandsAtTheShortestLengthThatKeepsTheLimit) {
    const DerivativeStudy study = study_of(
        0.05, {"modes_plain_f32", "modes_plain_f64", "modessum_plain_f32", "ring_plain_f32", "nested_plain_f32"});
    const bench::DerivativeRun run = bench::measure_derivative(study);
    choose::DerivativeErrors errors(study.goals.front());
    const DerivativePoint& first = run.points.front();
    EXPECT_EQ(first.kernel, "modes_plain_f32");
    EXPECT_TRUE(first.meets);
    EXPECT_TRUE(errors.meets("modes_plain_f32", first.coefficients, 0.05));
    EXPECT_FALSE(errors.meets("modes_plain_f32", first.coefficients - 1, 0.05));
    EXPECT_LE(first.report.certified.band, 0.05);
    EXPECT_LE(first.report.measured.band, first.report.certified.band + 1e-5);
    ASSERT_EQ(first.costs.size(), 1U);
    // The length behind it, too.
    EXPECT_EQ(run.points[1].kernel, "modes_plain_f32");
    EXPECT_EQ(run.points[1].coefficients, first.coefficients + 1);
    const auto count = [&](const std::string& kernel, double order) {
        return std::ranges::count_if(
            run.points, [&](const DerivativePoint& point) { return point.kernel == kernel && point.order == order; });
    };
    EXPECT_EQ(count("ring_plain_f32", 0.5), 1);
    EXPECT_EQ(count("modessum_plain_f32", 0.5), 0);
    EXPECT_GE(count("modessum_plain_f32", -0.5), 1);
    EXPECT_EQ(count("nested_plain_f32", 0.5), 0);
    ASSERT_EQ(run.left_out.size(), 1U);
    EXPECT_THAT(run.left_out.front(), HasSubstr("nested_plain_f32"));
}

TEST(DerivativeStudy, RowsAndTableTellWhatMeetsAndHowNearTheOthersCome) {
    const DerivativeStudy study = study_of(0.05, {"modes_plain_f32", "modes_plain_f64", "ring_plain_f32"});
    const bench::DerivativeRun run = bench::measure_derivative(study);
    const std::vector<bench::Json> rows = bench::rows_of_derivative(study, run);
    std::size_t costed = 0;
    for (const bench::Json& row : rows) {
        const auto key = bench::parse_any_key(row.at("name").get<std::string>());
        ASSERT_TRUE(key) << row;
        EXPECT_EQ(key->hz, "0.5..80");
        EXPECT_EQ(key->until, "");
        EXPECT_GT(row.at("band_error").get<double>(), 0.0);
        EXPECT_TRUE(row.contains("measured_band_error"));
        EXPECT_FALSE(row.contains("step_error"));
        EXPECT_EQ(bench::is_wrong(row), key->kernel == "modes_plain_f64") << row;
        EXPECT_EQ(key->is_accuracy(), key->kernel == "ring_plain_f32") << row;
        if (row.contains("model_cycles_per_sample")) {
            EXPECT_EQ(row.at("model_cycles_high").get<double>(), row.at("model_cycles_per_sample").get<double>() + 1.0);
            EXPECT_GT(row.at("memory_bytes").get<double>(), 0.0);
            ++costed;
        }
    }
    EXPECT_GE(costed, 2U);
    const std::string table = bench::to_table(study, run);
    EXPECT_THAT(table, HasSubstr("Order 0.5, within 5 %, from 0.5 to 80 Hz: 2 of 3 kernels"));
    EXPECT_THAT(table, HasSubstr("Order -0.5, within 5 %"));
    EXPECT_THAT(table, HasSubstr("of the others the nearest: ring_plain_f32"));
    EXPECT_THAT(table, HasSubstr("  *\n"));
    // Nothing keeps it: no rows of costs, and the nearest is told.
    const DerivativeStudy strict = study_of(1e-12, {"modes_plain_f32"});
    const bench::DerivativeRun none = bench::measure_derivative(strict);
    EXPECT_FALSE(none.points.front().meets);
    EXPECT_TRUE(none.points.front().costs.empty());
    EXPECT_THAT(bench::to_table(strict, none), HasSubstr("0 of 1 kernels\n  of the others the nearest: modes_plain"));
}

}  // namespace
