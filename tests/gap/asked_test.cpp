// A question of an exam as the diagnosis takes it: each field where it belongs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/failure.hpp"
#include "gap/exam/ask.hpp"
#include "gap/exam/manifest.hpp"
#include "gap/exam/score.hpp"
#include "gap/exam/truth.hpp"
#include "gap/verdict/verdict.hpp"

namespace {

namespace exam = gap::exam;
using testing::HasSubstr;

exam::Asked asked_of(const std::string& fields) {
    return exam::parse_manifest(
               R"({"schema": "glsum-exam-1", "questions": [{"name": "rig", "train": ["t.csv"], )" + fields + "}]}",
               "m.json")
        .front();
}

gap::Record record_of(std::size_t count) {
    gap::Record record;
    record.name = "t.csv";
    record.usual_interval_s = 0.5;
    double y = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        record.time_s.push_back(0.5 * static_cast<double>(i));
        record.input.push_back((i / 20) % 2 == 0 ? 1.0 : 0.25);
        record.output.push_back(y);
        y += 0.2 * (record.input.back() - y);
    }
    return record;
}

gap::Question question_of(const std::string& fields, std::size_t count = 200, bool model = false) {
    exam::Given given;
    given.train = {record_of(count)};
    if (model) {
        given.model = drive::make_fopdt(2.0, 3.0, 0.0);
    }
    return exam::to_question(asked_of(fields), std::move(given), 3);
}

TEST(Asked, OfAModelIsThatModel) {
    const gap::Question given = question_of(R"("base": "m.json")", 200, true);
    EXPECT_FALSE(given.refit);
    EXPECT_TRUE(given.given_form);
    EXPECT_FALSE(given.find);
    EXPECT_EQ(given.jobs, 3U);
    EXPECT_EQ(given.train.size(), 1U);
    EXPECT_EQ(gap::model_of(given.form).gain, 2.0);
    EXPECT_EQ(given.metric, gap::Metric::simulation);
    EXPECT_TRUE(given.metric_free);
    EXPECT_FALSE(given.domain);
    const gap::Question refitted = question_of(R"("base": "m.json", "refit": true, "domain": "thermal")", 200, true);
    EXPECT_TRUE(refitted.refit);
    EXPECT_EQ(refitted.domain, gap::Domain::thermal);
}

TEST(Asked, OfAFormIsFittedToTheTraining) {
    const gap::Question found = question_of(R"("base": "fit")");
    EXPECT_TRUE(found.find);
    EXPECT_TRUE(found.refit);
    EXPECT_FALSE(found.given_form);
    const gap::Question form = question_of(R"("base": "fit:first_order", "metric": "prediction")");
    EXPECT_FALSE(form.find);
    EXPECT_TRUE(form.refit);
    EXPECT_EQ(form.base_name, "first_order");
    EXPECT_EQ(form.metric, gap::Metric::prediction);
    EXPECT_FALSE(form.metric_free);
    drive::Form start = form.form;
    EXPECT_NEAR(start.parameter("gain").value, 1.0, 0.05);
}

// 32 samples on either side, at least.
TEST(Asked, IsSplitWhereBothSidesAreLongEnough) {
    EXPECT_EQ(question_of(R"("base": "fit", "split_s": 16)", 64).split_s, 16.0);
    const auto refusal = [](const std::string& split, std::size_t count) -> std::string {
        try {
            (void)question_of(R"("base": "fit", "split_s": )" + split, count);
        } catch (const glsum::Failure& failure) {
            EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
            return failure.what();
        }
        return "";
    };
    EXPECT_THAT(
        refusal("15.5", 64),
        HasSubstr("rig: split_s 15.5: expected 32 samples or more on both sides, found 31 of 64 before it in t.csv"));
    EXPECT_THAT(refusal("16", 63), HasSubstr("found 32 of 63 before it"));
}

// An unknown's file, as the diagnosis writes it, is read with its suspect.
TEST(Asked, IsAnsweredByAFileThatNamesASuspect) {
    gap::OfDrive of{};
    of.where.time = of.where.frequency = of.where.input_level = of.where.output_level = {{0.0, 1.0, 1.0, ""}};
    of.suspect = gap::Suspect{
        "backlash + gain_drift", {{"backlash", {{"gap", 0.5, {{0.4, 0.6}}}}}, {"gain_drift", {}}}, 0.25, 0.25};
    const gap::Verdict unknown{
        gap::Outcome::unknown, {"simulation", 0.5, 0.25, 0.1}, {{"none", 0.5, 0.0}}, of, "rest", {}};
    const exam::Reply reply = exam::parse_reply(gap::to_json(unknown), "v.json");
    EXPECT_EQ(reply.verdict, "unknown");
    EXPECT_THAT(reply.suspect, testing::ElementsAre("backlash", "gain_drift"));
}

std::vector<exam::Truth> known(const std::string& questions) {
    return exam::parse_truth(R"({"schema": "glsum-exam-truth-1", "questions": [)" + questions + "]}", "t.json");
}

TEST(Known, HasEachFieldOfEachQuestion) {
    const auto all = known(R"({"name": "arm", "known": "listed", "attainable_gap": 0.05, "source": "its authors",
        "causes": [{"any_of": ["gravity_nonlinearity"]}, {"any_of": ["coulomb_friction", "backlash"], "main": false}]},
        {"name": "oven", "known": "not_listed", "attainable_of_base": 0.25, "causes": [{"any_of": ["gain_drift"],
         "main": false}]}, {"name": "mass", "known": "nothing"})");
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(all[0].name, "arm");
    EXPECT_EQ(all[0].known, exam::Known::listed);
    EXPECT_EQ(all[0].attainable_gap, 0.05);
    EXPECT_FALSE(all[0].attainable_of_base);
    EXPECT_EQ(all[0].source, "its authors");
    ASSERT_EQ(all[0].causes.size(), 2U);
    EXPECT_THAT(all[0].causes[0].any_of, testing::ElementsAre("gravity_nonlinearity"));
    EXPECT_TRUE(all[0].causes[0].main);
    EXPECT_THAT(all[0].causes[1].any_of, testing::ElementsAre("coulomb_friction", "backlash"));
    EXPECT_FALSE(all[0].causes[1].main);
    EXPECT_EQ(all[1].name, "oven");
    EXPECT_EQ(all[1].known, exam::Known::not_listed);
    EXPECT_FALSE(all[1].attainable_gap);
    EXPECT_EQ(all[1].attainable_of_base, 0.25);
    EXPECT_EQ(all[1].causes.size(), 1U);
    EXPECT_EQ(all[2].name, "mass");
    EXPECT_EQ(all[2].known, exam::Known::nothing);
    EXPECT_EQ(all[2].source, "");
    EXPECT_TRUE(all[2].causes.empty());
}

TEST(Known, RefusesFieldsByTheirPlace) {
    const auto refusal = [](const std::string& fields) -> std::string {
        try {
            (void)known(R"({"name": "arm", )" + fields + "}");
        } catch (const glsum::Failure& failure) {
            EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
            return failure.what();
        }
        return "";
    };
    EXPECT_EQ(refusal(R"("known": "nothing", "sources": "x")"),
              "t.json: arm: expected no fields but name, known, causes, attainable_gap, attainable_of_base and source, "
              "found sources");
    EXPECT_EQ(refusal(R"("known": "listed", "causes": [{"any_of": ["a"]}, {"any_of": ["b"], "mian": true}])"),
              "t.json: arm: causes[1]: expected no fields but any_of and main, found mian");
    EXPECT_EQ(refusal(R"("known": "nothing", "causes": [{"any_of": ["a"]}])"),
              "t.json: arm: causes: expected none beside nothing, found 1");
    EXPECT_EQ(refusal(R"("known": "listed", "causes": [{"any_of": ["a"], "main": false}])"),
              "t.json: arm: causes: expected a main one beside listed, found none");
}

}  // namespace
