// What is told of a simulation: how it was made, where it ended, and how far that is from the exact response.
#include "drive/simulation_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace {

using testing::HasSubstr;
using testing::Not;

drive::SimulationReport made() {
    drive::SimulationReport report;
    report.method = "double";
    report.record.name = "step";
    report.record.time_s = {0.0, 0.5, 1.0};
    report.record.output = {0.0, 1.0, 2.0};
    return report;
}

TEST(SimulationReport, SaysHowTheOutputCameAbout) {
    drive::Scheme scheme;
    EXPECT_EQ(drive::in_words(scheme), "double, one merged table, full taps, h = 0.001 s");
    scheme.kernel = "ring_plain_f32";
    scheme.taps = 600;
    EXPECT_EQ(drive::in_words(scheme), "ring_plain_f32, 600 taps, h = 0.001 s");
    scheme.increments = scheme.merged = true;
    EXPECT_EQ(drive::in_words(scheme), "ring_plain_f32, increments, one merged table, 600 taps, h = 0.001 s");
}

TEST(SimulationReport, HasTheLargestErrorWhereItIsCompared) {
    drive::SimulationReport report = made();
    report.exact = {0.0, 1.5, 2.0};
    const std::string text = drive::to_text(report, drive::make_fopdt(2.0, 0.5, 0.0));
    EXPECT_THAT(text, HasSubstr("\ndouble, input step: 3 samples, at 1 s the output is 2\n"
                                "exact there: 2; largest error over the record 0.5 (25 % of the largest output)\n"));
    const auto json = nlohmann::json::parse(drive::to_json(report, "m.json"));
    EXPECT_EQ(json["model"], "m.json");
    EXPECT_EQ(json["samples"], 3);
    EXPECT_EQ(json["final_time_s"], 1.0);
    EXPECT_EQ(json["final_output"], 2.0);
    EXPECT_EQ(json["exact_final_output"], 2.0);
    EXPECT_EQ(json["error_max"], 0.5);
    report.exact = {0.0, 0.0, 0.0};  // no share of nothing
    EXPECT_THAT(drive::to_text(report, drive::make_fopdt(2.0, 0.5, 0.0)), HasSubstr("record 2 (0 % of"));
}

TEST(SimulationReport, SaysWhyItIsNotComparedAndWhatWasSaturated) {
    drive::SimulationReport report = made();
    report.why_not = "it grows";
    report.full_scale = 4.0;
    report.saturations = 7;
    report.record.output.back() = std::numeric_limits<double>::quiet_NaN();
    const std::string text = drive::to_text(report, drive::make_fopdt(2.0, 0.5, 0.0));
    EXPECT_THAT(text, HasSubstr("the output is nan\nnot compared with the exact response: it grows\n"
                                "full scale 4, 7 saturations\n"));
    EXPECT_THAT(text, Not(HasSubstr("exact there")));
    const auto json = nlohmann::json::parse(drive::to_json(report, "m.json"));
    EXPECT_TRUE(json["final_output"].is_null());
    EXPECT_EQ(json["saturations"], 7);
    EXPECT_FALSE(json.contains("error_max"));
}

TEST(SimulationReport, IsOfTheSchemeAndComparedWhereThatIsWanted) {
    const drive::Model model = drive::make_fopdt(2.0, 0.5, 0.0);
    const drive::Log step = drive::make_log({}, 0.001, 1.0);
    const drive::SimulationReport exact = drive::simulate_exactly(model, step);
    EXPECT_EQ(exact.method, "exact, by numerical inverse Laplace");
    EXPECT_NEAR(exact.record.output.back(), 2.0 * (1.0 - std::exp(-2.0)), 1e-8);
    EXPECT_TRUE(exact.exact.empty());
    const drive::SimulationReport both = drive::simulate(model, {}, step, true);
    EXPECT_EQ(both.method, drive::in_words({}));
    EXPECT_EQ(both.exact, exact.record.output);
    EXPECT_EQ(both.record.output, drive::simulate(model, {}, step.input).output);
    for (const drive::SimulationReport* report : {&exact, &both}) {  // of the input that was given, at its stamps
        EXPECT_EQ(report->record.name, step.name);
        ASSERT_EQ(report->record.time_s, step.time_s);
        EXPECT_EQ(report->record.input, step.input);
        EXPECT_THAT(drive::to_text(*report, model), HasSubstr(", input step: 1001 samples, at 1 s the output is"));
    }
    EXPECT_EQ(both.full_scale, 0.0);
    EXPECT_TRUE(drive::simulate(model, {}, step, false).exact.empty());
    drive::Scheme fixed;
    fixed.kernel = "ring_plain_q31";
    fixed.taps = 10;
    fixed.increments = true;
    fixed.full_scale = 8.0;
    EXPECT_EQ(drive::simulate(model, fixed, step, false).full_scale, 8.0);
}

TEST(SimulationReport, HasTheOraclesDigits) {
    const std::vector<drive::ExactPoint> points{{0.5, {0.25, "0.250000", 6}}, {2.0, {1.0, "1.0", 18}}};
    EXPECT_EQ(drive::to_text(points), "0.5 s  0.250000  (6 digits agree)\n2 s  1.0  (18 digits agree)\n");
    EXPECT_EQ(nlohmann::json::parse(drive::to_json(points)), nlohmann::json::parse(R"([
        {"time_s": 0.5, "value": 0.25, "digits": "0.250000", "agreed_digits": 6},
        {"time_s": 2.0, "value": 1.0, "digits": "1.0", "agreed_digits": 18}])"));
}

}  // namespace
