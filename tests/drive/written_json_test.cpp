// What is written as JSON can be read by people, too: two columns a level, and a line that ends.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "drive/controller_file.hpp"
#include "drive/coverage_report.hpp"
#include "drive/fit_report.hpp"
#include "drive/model_file.hpp"
#include "drive/simulation_report.hpp"
#include "drive/stand/blind/cases.hpp"
#include "drive/stand/blind/facts.hpp"
#include "drive/stand/blind/judge.hpp"
#include "drive/stand/blind/score.hpp"
#include "drive/stand/blind/without_model.hpp"

namespace {

TEST(WrittenJson, IsIndentedByTwo) {
    drive::SimulationReport simulated;
    simulated.record.time_s = {0.0, 1.0};
    simulated.record.output = {0.0, 2.0};
    const std::string texts[] = {
        drive::to_json(drive::make_fopdt(2.0, 0.5, 0.25)),
        drive::to_json(drive::parse_fopid(R"({"kind": "fopid", "kp": 1.0, "sample_time_s": 0.01})", "c.json")),
        drive::to_json(drive::Fit{}, "a.csv", {}),
        drive::to_json(drive::Coverage{}, "m.json", "fopdt"),
        drive::to_json(simulated, "m.json"),
        drive::to_json(std::vector<drive::ExactPoint>{{1.0, {}}}),
        stand::blind::to_json(stand::blind::Facts{"thermal"}),
        stand::blind::to_json(stand::blind::OpenScore{}),
        stand::blind::to_json(std::vector<stand::blind::Scored>{}),
    };
    for (const std::string& text : texts) {
        EXPECT_EQ(text, nlohmann::ordered_json::parse(text).dump(2) + "\n");
    }
}

// Hundreds of cases, which nobody reads but to look one up: a column a level.
TEST(WrittenJson, OfSealedCasesIsIndentedByOne) {
    stand::blind::Truth truth;
    truth.parameters = {{{"gap", 0.5}}};
    truth.plan.effects = {"backlash"};
    truth.plan.sizes = {stand::blind::EffectSize::clear};
    for (const std::string& text :
         {stand::blind::seal(3, {truth}), stand::blind::seal_open(3, {stand::blind::OpenTruth{}})}) {
        EXPECT_EQ(text, nlohmann::ordered_json::parse(text).dump(1) + "\n");
    }
}

}  // namespace
