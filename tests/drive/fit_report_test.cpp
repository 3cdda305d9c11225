// What is told of a fit, of a measurement of coverage and of a static characteristic: every number in its place.
#include "drive/fit_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "drive/coverage_report.hpp"
#include "drive/static_characteristic.hpp"

namespace {

using testing::HasSubstr;
using testing::Not;

drive::Fit made_fit() {
    drive::Fit fit;
    fit.model = drive::make_fopdt(2.0, 0.5, 0.0);
    fit.parameters = {{"gain", 2.0, 0.25, 1.5, 2.5, false},
                      {"time_constant_s", 0.5, std::numeric_limits<double>::infinity(), 0.4, 0.75, false},
                      {"delay_s", 0.0, 0.0, 0.0, 0.0, true},
                      {"offset", 0.0, 0.0, 0.0, 0.0, true}};
    fit.free_names = {"gain", "time_constant_s"};
    fit.correlation = Eigen::MatrixXd{{1.0, -0.25}, {-0.25, 1.0}};
    fit.offset = 0.375;
    fit.sum_of_squares = 0.125;
    fit.noise_deviation = 0.01;
    fit.noise_model = {0.5, 0.25};
    fit.lag_one = -0.0625;
    fit.iterations = 7;
    fit.stopped = "converged";
    fit.warnings = {"a warning"};
    return fit;
}
drive::Indices made_indices() {
    drive::Indices indices;
    indices.nrmse_fit = 0.9;
    return indices;
}

TEST(FitReport, IsATableOfTheEstimates) {
    drive::Fit fit = made_fit();
    const std::string text = drive::to_text(fit, "a.csv", made_indices());
    EXPECT_THAT(text, HasSubstr("gain                          2              1.5             2.5\n"));
    EXPECT_THAT(text, HasSubstr("delay_s                       0                            fixed\n"));
    EXPECT_THAT(text, Not(HasSubstr("offset")));  // as it usually is
    EXPECT_THAT(text, HasSubstr("correlation          gain time_con\n"
                                "gain                1.000\n"
                                "time_constant_s    -0.250    1.000\n"));
    EXPECT_THAT(text, HasSubstr("sum of squares 0.125, residuals 0.01 after whitening by AR(2), lag one -0.062; "
                                "fit (NRMSE) 90.00 % on a.csv\n7 iterations: converged\n"));
    fit.parameters.back().value = 0.5;
    fit.noise_model.clear();
    fit.free_names.resize(1);
    fit.starts = 8;
    fit.starts_that_agree = 5;
    const std::string other = drive::to_text(fit, "a.csv", made_indices());
    EXPECT_THAT(other, HasSubstr("offset                      0.5                            fixed\n"));
    EXPECT_THAT(other, HasSubstr("residuals 0.01, lag one"));
    EXPECT_THAT(other, Not(HasSubstr("correlation")));
    EXPECT_THAT(other, HasSubstr("converged; 5 of 8 starts end here\n"));
}

TEST(FitReport, AsAFileHasAllThatWasFound) {
    const auto json = nlohmann::json::parse(drive::to_json(made_fit(), "a.csv", made_indices()));
    EXPECT_TRUE(json["model"].is_object());
    EXPECT_EQ(json["offset"], 0.375);
    EXPECT_EQ(json["sum_of_squares"], 0.125);
    EXPECT_EQ(json["noise_deviation"], 0.01);
    ASSERT_EQ(json["parameters"].size(), 4U);
    EXPECT_EQ(json["parameters"][0]["interval"], nlohmann::json({1.5, 2.5}));
    EXPECT_EQ(json["parameters"][0]["deviation"], 0.25);
    EXPECT_TRUE(json["parameters"][1]["deviation"].is_null());  // the record does not tell
    EXPECT_TRUE(json["parameters"][2]["fixed"]);
    EXPECT_FALSE(json["parameters"][2].contains("interval"));
    EXPECT_EQ(json["correlation"]["names"], nlohmann::json({"gain", "time_constant_s"}));
    EXPECT_EQ(json["correlation"]["matrix"], nlohmann::json::parse("[[1.0, -0.25], [-0.25, 1.0]]"));
    EXPECT_EQ(json["noise_model"], nlohmann::json({0.5, 0.25}));
    EXPECT_EQ(json["lag_one"], -0.0625);
    EXPECT_EQ(json["iterations"], 7);
    EXPECT_EQ(json["stopped"], "converged");
    EXPECT_EQ(json["starts"], 1);
    EXPECT_EQ(json["starts_that_agree"], 1);
    EXPECT_EQ(json["nrmse_fit"], 0.9);
    EXPECT_EQ(json["nrmse_of"], "a.csv");
    EXPECT_EQ(json["warnings"], nlohmann::json({"a warning"}));
}

drive::Coverage made_coverage() {
    drive::Coverage found;
    found.names = {"gain", "delay_s"};
    found.truth = {2.0, 0.1};
    found.inside = {95, 99};
    found.mean = {2.01, 0.1};
    found.spread = {0.02, 0.003};
    found.claimed = {0.025, 0.004};
    found.jointly_inside = 94;
    found.runs = 100;
    return found;
}

TEST(CoverageReport, CountsTheTruthsInside) {
    const drive::Coverage found = made_coverage();
    const std::string text = drive::to_text(found, drive::make_fopdt(2.0, 0.5, 0.1), {});
    EXPECT_THAT(text, testing::StartsWith("100 logs of "));
    EXPECT_THAT(text, HasSubstr(": pulse for 5 s, 0.01 s +- 0.001 s, noise 0.01, steps of 0.008\n"));
    EXPECT_THAT(text, HasSubstr("gain                        2         2.01         0.02        0.025   95/100\n"));
    EXPECT_THAT(text, testing::EndsWith("all at once                                                           "
                                        " 94/100\n"));
    const auto json = nlohmann::json::parse(drive::to_json(found, "m.json", "fopdt"));
    EXPECT_EQ(json["model"], "m.json");
    EXPECT_EQ(json["form"], "fopdt");
    EXPECT_EQ(json["runs"], 100);
    EXPECT_EQ(json["failed"], 0);
    EXPECT_EQ(json["jointly_inside"], 94);
    EXPECT_EQ(json["parameters"][1], nlohmann::json::parse(R"({"name": "delay_s", "truth": 0.1, "inside": 99,
        "mean": 0.1, "spread": 0.003, "claimed": 0.004})"));
}

TEST(CoverageReport, HoldsWithinNinetyTo99AndAHalfPercent) {
    drive::Coverage found = made_coverage();
    EXPECT_TRUE(drive::holds(found));
    found.inside = {90, 99};
    EXPECT_TRUE(drive::holds(found));
    found.inside = {89, 99};
    EXPECT_FALSE(drive::holds(found));
    found.inside = {95, 100};
    EXPECT_FALSE(drive::holds(found));
    found.inside = {95, 99};
    found.failed = 1;
    EXPECT_FALSE(drive::holds(found));
}

TEST(StaticCharacteristicText, HasALineForEachLevel) {
    drive::StaticCharacteristic found;
    found.levels = {{0.25, 0.5, 0.01, 1.0, 3.0, 0.001, true, true}, {0.5, 0.75, 0.02, 3.0, 5.5, 0.125, false, false}};
    found.slope = 2.0;
    found.intercept = -0.5;
    found.largest_bend = 0.125;
    EXPECT_EQ(drive::to_text(found),
              "     input       output    deviation     from s       to s\n"
              "      0.25          0.5         0.01       1.00       3.00  up\n"
              "       0.5         0.75         0.02       3.00       5.50  down, not settled: still moves by 0.12\n"
              "straight line -0.5 + 2 input; the output bends away from it by up to 12.5 % of its range\n");
}

TEST(Kind, IsFoundByItsName) {
    for (const drive::Kind kind : {drive::Kind::fopdt, drive::Kind::sopdt, drive::Kind::niopdt, drive::Kind::fotf}) {
        EXPECT_EQ(drive::kind_named(drive::name_of(kind)), kind);
    }
    EXPECT_EQ(drive::kind_named("fotp"), drive::Kind::fotf);
}

}  // namespace
