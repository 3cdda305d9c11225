// Exams: manifests and truths that are read or refused, a question that is answered, and every mark by its rule.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/failure.hpp"
#include "gap/drive/verdict.hpp"
#include "gap/exam/ask.hpp"
#include "gap/exam/score.hpp"
#include "stand_case.hpp"

namespace {

namespace exam = gap::exam;
using exam::Mark;
using testing::ElementsAre;
using testing::HasSubstr;

std::string manifest_of(const std::string& question) {
    return R"({"schema": "glsum-exam-1", "questions": [)" + question + "]}";
}

exam::Asked asked_of(const std::string& question) {
    return exam::parse_manifest(manifest_of(question), "m.json").at(0);
}

std::string failure_of(const std::function<void()>& act) {
    try {
        act();
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        return failure.what();
    }
    return "nothing was refused";
}

std::string refused(const std::string& question) {
    return failure_of([&] { (void)exam::parse_manifest(manifest_of(question), "m.json"); });
}

TEST(Manifest, SaysWhatIsAsked) {
    const exam::Asked asked = asked_of(
        R"({"name": "two_heaters", "train": ["a/x.csv", "y.csv"], "split_s": 400.5, "base": "fit:sopdt",
            "domain": "thermal", "metric": "prediction", "refit": true, "time_column": "t",
            "input_columns": ["p", "q", "r"], "output_column": "T", "units": {"p": "%", "T": "K"}})");
    EXPECT_EQ(asked.name, "two_heaters");
    EXPECT_THAT(asked.train, ElementsAre("a/x.csv", "y.csv"));
    EXPECT_TRUE(asked.validate.empty());
    EXPECT_EQ(asked.split_s, 400.5);
    EXPECT_TRUE(asked.is_fitted());
    EXPECT_EQ(asked.domain, "thermal");
    EXPECT_EQ(asked.metric, gap::Metric::prediction);
    EXPECT_TRUE(asked.refit);
    EXPECT_EQ(asked.columns.time, "t");
    EXPECT_EQ(asked.columns.input, "p");
    EXPECT_THAT(asked.columns.more_inputs, ElementsAre("q", "r"));
    EXPECT_EQ(asked.columns.output, "T");
    EXPECT_EQ(asked.units.at("T"), "K");

    const exam::Asked least = asked_of(R"({"name": "a", "train": ["x.csv"], "base": "models/x.json"})");
    EXPECT_FALSE(least.is_fitted());
    EXPECT_FALSE(least.split_s);
    EXPECT_FALSE(least.metric);  // the records decide
    EXPECT_EQ(least.columns.input, "");
    EXPECT_EQ(least.domain, "");
}

TEST(Manifest, RefusesWhatItDoesNotExpect) {
    const std::pair<const char*, const char*> cases[] = {
        {R"({"train": ["x"], "base": "fit"})", "m.json: questions[0]: expected a name of 1 to 64 small letters"},
        {R"({"name": "../a", "train": ["x"], "base": "fit"})", "expected a name"},
        {R"({"name": "a", "train": ["x"], "base": "fit"}, {"name": "a", "train": ["x"], "base": "fit"})",
         "m.json: questions[1]: expected names that differ, found a twice"},
        {R"({"name": "a", "base": "fit"})", "m.json: a: train: expected a value, found none"},
        {R"({"name": "a", "train": [], "base": "fit"})", "train: expected a list of at least 1, found one of 0"},
        {R"({"name": "a", "train": "x", "base": "fit"})", "train: expected a list of at most 64, found \"x\""},
        {R"({"name": "a", "train": ["x", 3], "base": "fit"})", "train[1]: expected a text of 1 to 512 bytes, found 3"},
        {R"({"name": "a", "train": ["../x"], "base": "fit"})",
         "expected paths below the folder of the data, found ../x"},
        {R"({"name": "a", "train": ["/etc/x"], "base": "fit"})", "expected paths below the folder of the data"},
        {R"({"name": "a", "train": ["b/../../x"], "base": "fit"})", "expected paths below the folder of the data"},
        {R"({"name": "a", "train": ["x"], "base": "/m.json"})", "m.json: a: base: expected paths below"},
        {R"({"name": "a", "train": ["x"], "validate": ["x"], "base": "fit"})",
         "validate: expected logs that are not fitted"},
        {R"({"name": "a", "train": ["x"], "validate": ["y"], "split_s": 1, "base": "fit"})",
         "split_s: expected it or validate, found both"},
        {R"({"name": "a", "train": ["x"], "split_s": 0, "base": "fit"})",
         "split_s: expected a number above 0, found 0"},
        {R"({"name": "a", "train": ["x"], "base": ""})", "base: expected a text"},
        {R"({"name": "a", "train": ["x"], "base": "fit", "domain": "magic"})",
         "domain: expected one of mechanical, thermal, hydraulic, electric, found \"magic\""},
        {R"({"name": "a", "train": ["x"], "base": "fit", "refit": 1})", "refit: expected true or false, found 1"},
        {R"({"name": "a", "train": ["x"], "base": "fit", "units": {"x": 3}})", "m.json: a: units: x: expected a text"},
        {R"({"name": "a", "train": ["x"], "base": "fit", "splits": 3})",
         "m.json: a: expected no fields but name, train"},
    };
    for (const auto& [question, expected] : cases) {
        EXPECT_THAT(refused(question), HasSubstr(expected)) << question;
    }
    const auto parse = [](const std::string& text) {
        return failure_of([&] { (void)exam::parse_manifest(text, "m.json"); });
    };
    EXPECT_THAT(parse("{\n\"schema\": \"glsum-exam-1\",\n oops"), HasSubstr("m.json:3: expected JSON"));
    EXPECT_THAT(parse("[]"), HasSubstr("m.json: expected an object"));
    EXPECT_THAT(parse(R"({"schema": "glsum-exam-9", "questions": []})"),
                HasSubstr("schema: expected one of glsum-exam-1"));
    EXPECT_THAT(parse(manifest_of("")), HasSubstr("questions: expected at least one, found none"));
    EXPECT_THAT(parse(std::string(40, '[') + std::string(40, ']')), HasSubstr("nested at most"));
    EXPECT_THAT(parse(std::string(exam::Limits::bytes + 1, ' ')), HasSubstr("expected at most"));
}

exam::Truth truth_of(const std::string& fields) {
    return exam::parse_truth(R"({"schema": "glsum-exam-truth-1", "questions": [{"name": "a", )" + fields + "}]}",
                             "t.json")
        .at(0);
}

TEST(Truth, RefusesWhatItDoesNotExpect) {
    const auto refusal = [](const std::string& fields) { return failure_of([&] { (void)truth_of(fields); }); };
    EXPECT_THAT(refusal(R"("known": "maybe")"),
                HasSubstr("t.json: a: known: expected one of listed, nothing, not_listed"));
    EXPECT_THAT(refusal(R"("known": "listed")"), HasSubstr("causes: expected a main one beside listed, found none"));
    EXPECT_THAT(refusal(R"("known": "listed", "causes": [{"any_of": ["backlash"], "main": false}])"),
                HasSubstr("a main one"));
    EXPECT_THAT(refusal(R"("known": "nothing", "causes": [{"any_of": ["backlash"]}])"),
                HasSubstr("expected none beside nothing"));
    EXPECT_THAT(refusal(R"("known": "listed", "causes": [{"any_of": []}])"),
                HasSubstr("causes[0]: any_of: expected a list of at least 1"));
    EXPECT_THAT(refusal(R"("known": "nothing", "attainable_gap": -1)"),
                HasSubstr("attainable_gap: expected a number above 0"));
    EXPECT_THAT(refusal(R"("known": "nothing", "attainable_gap": 1, "attainable_of_base": 1)"),
                HasSubstr("found both"));
}

exam::Reply reply_of(const std::string& verdict, std::vector<std::vector<std::string>> named,
                     double confidence = 0.95) {
    exam::Reply reply;
    reply.verdict = verdict;
    reply.named = std::move(named);
    reply.confidence = confidence;
    reply.gap_before = 0.5;
    reply.gap_after = 0.1;
    return reply;
}

TEST(Score, GivesEachMarkByItsRule) {
    const exam::Truth listed = truth_of(
        R"("known": "listed", "causes": [{"any_of": ["coulomb_friction", "direction_dependent_friction"]},
                                         {"any_of": ["quadratic_drag"], "main": false}])");
    const exam::Truth nothing = truth_of(R"("known": "nothing")");
    const exam::Truth not_listed = truth_of(R"("known": "not_listed", "causes": [{"any_of": ["load_disturbance"]}])");
    struct Case {
        const exam::Truth& truth;
        exam::Reply reply;
        Mark mark;
        double points;
    };
    const std::vector<Case> cases = {
        {listed, reply_of("attributed", {{"coulomb_friction"}}), Mark::right, 1.0},
        {listed, reply_of("attributed", {{"direction_dependent_friction"}}), Mark::right, 1.0},
        {listed, reply_of("attributed", {{"coulomb_friction", "quadratic_drag"}}), Mark::right, 1.0},
        {listed, reply_of("attributed", {{"coulomb_friction", "backlash"}}), Mark::spurious, 0.5},
        {listed, reply_of("attributed", {{"backlash"}}), Mark::wrong, 0.0},
        // True, but not what makes the gap.
        {listed, reply_of("attributed", {{"quadratic_drag"}}), Mark::wrong, 0.0},
        {listed, reply_of("ambiguous", {{"coulomb_friction"}, {"backlash"}}), Mark::ambiguous, 0.5},
        {listed, reply_of("ambiguous", {{"backlash"}, {"end_stop"}, {"coulomb_friction", "quadratic_drag"}}),
         Mark::ambiguous, 1.0 / 3.0},
        // Two names of one cause are one alternative.
        {listed, reply_of("ambiguous", {{"coulomb_friction"}, {"direction_dependent_friction"}}), Mark::right, 1.0},
        {listed, reply_of("ambiguous", {{"coulomb_friction"}, {"direction_dependent_friction"}, {"backlash"}}),
         Mark::ambiguous, 0.5},
        {listed, reply_of("ambiguous", {{"coulomb_friction"}, {"a"}, {"b"}, {"c"}}), Mark::ambiguous, 0.0},
        {listed, reply_of("ambiguous", {{"coulomb_friction", "backlash"}, {"end_stop"}}), Mark::ambiguous, 0.0},
        {listed, reply_of("ambiguous", {{"backlash"}, {"end_stop"}}), Mark::wrong, 0.0},
        {listed, reply_of("unknown", {}), Mark::missed, 0.0},
        {listed, reply_of("no_gap", {}), Mark::wrong, 0.0},
        {listed, exam::refusal("no input"), Mark::refused, 0.0},
        {nothing, reply_of("no_gap", {}), Mark::right, 1.0},
        {nothing, reply_of("unknown", {}), Mark::missed, 0.0},
        {nothing, reply_of("attributed", {{"backlash"}}), Mark::wrong, 0.0},
        {nothing, reply_of("ambiguous", {{"backlash"}, {"end_stop"}}), Mark::wrong, 0.0},
        {not_listed, reply_of("unknown", {}), Mark::honest_unknown, 1.0},
        {not_listed, reply_of("no_gap", {}), Mark::wrong, 0.0},
        {not_listed, reply_of("attributed", {{"gain_drift"}}), Mark::wrong, 0.0},
        {not_listed, reply_of("attributed", {{"load_disturbance"}}), Mark::right, 1.0},
    };
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const exam::Scored scored = exam::score(cases[i].truth, cases[i].reply);
        EXPECT_EQ(scored.mark, cases[i].mark) << i << ": " << exam::name_of(scored.mark);
        EXPECT_NEAR(scored.points, cases[i].points, 1e-12) << i;
    }
}

TEST(Score, HoldsTheGapAgainstWhatIsAttainable) {
    const auto closed = [](const std::string& attainable, const exam::Reply& reply) {
        return exam::score(truth_of(R"("known": "listed", "causes": [{"any_of": ["backlash"]}])" + attainable), reply)
            .closed;
    };
    const exam::Reply named = reply_of("attributed", {{"backlash"}});  // from 0.5 to 0.1
    EXPECT_NEAR(closed(R"(, "attainable_gap": 0.05)", named).value(), 0.4 / 0.45, 1e-12);
    EXPECT_NEAR(closed(R"(, "attainable_of_base": 0.5)", named).value(), 1.0, 1e-12);  // more than was thought
    EXPECT_FALSE(closed("", named));
    EXPECT_FALSE(closed(R"(, "attainable_gap": 0.6)", named));  // nothing was to be closed
    EXPECT_EQ(closed(R"(, "attainable_gap": 0.05)", reply_of("unknown", {})), 0.0);
}

TEST(Score, SumsUp) {
    const exam::Truth friction =
        truth_of(R"("known": "listed", "causes": [{"any_of": ["coulomb_friction"]}], "attainable_gap": 0.1)");
    const std::vector<exam::Scored> all = {
        exam::score(friction, reply_of("attributed", {{"coulomb_friction"}}, 0.95)),
        exam::score(friction, reply_of("attributed", {{"backlash"}}, 0.9)),
        exam::score(friction, reply_of("ambiguous", {{"backlash"}, {"coulomb_friction"}}, 0.5)),
        exam::score(friction, exam::refusal("x.csv: nothing there")),
    };
    const auto file = nlohmann::json::parse(exam::to_json(all));
    EXPECT_EQ(file["schema"], "glsum-exam-score-1");
    EXPECT_EQ(file["questions"].size(), 4U);
    EXPECT_EQ(file["questions"][3]["reason"], "x.csv: nothing there");
    EXPECT_EQ(file["marks"]["right"], 1);
    EXPECT_EQ(file["marks"]["WRONG"], 1);
    EXPECT_EQ(file["marks"]["refused"], 1);
    EXPECT_NEAR(file["points"].get<double>(), 1.5, 1e-12);
    EXPECT_NEAR(file["closed"].get<double>(), 1.0, 1e-12);
    EXPECT_EQ(file["surely"], 2);
    EXPECT_EQ(file["surely_right"], 1);
    EXPECT_NEAR(file["brier"].get<double>(), (0.05 * 0.05 + 0.9 * 0.9) / 2.0, 1e-12);
    const std::string text = exam::to_text(all);
    EXPECT_THAT(text, HasSubstr("coulomb_friction (0.95) | coulomb_friction"));
    EXPECT_THAT(text, HasSubstr("backlash or coulomb_friction (0.50)"));
    EXPECT_THAT(text, HasSubstr("refused: x.csv: nothing there"));
    EXPECT_THAT(text, HasSubstr("1.50 points of 4"));
    EXPECT_THAT(text, HasSubstr("Brier score 0.406 of 2"));
}

// As it is written: what a scorer refuses would lose the answers of hours.
TEST(Reply, OfASuspectAsItIsWritten) {
    gap::Verdict verdict;
    verdict.outcome = gap::Outcome::unknown;
    verdict.gap = {"simulation", 0.4, 0.3, 0.1};
    gap::OfDrive of;
    of.suspect = gap::Suspect{"backlash + supply_sag", {{"backlash", {}}, {"supply_sag", {}}}, 0.3, 0.5};
    verdict.of = of;
    const exam::Reply reply = exam::parse_reply(gap::to_json(verdict), "v.json");
    EXPECT_EQ(reply.verdict, "unknown");
    EXPECT_THAT(reply.suspect, ElementsAre("backlash", "supply_sag"));
}

TEST(Reply, OfAVerdictsFile) {
    const std::string text = R"({"schema": "glsum-gap-1", "verdict": "ambiguous", "effects": [
        {"effect": "backlash", "alternative": 0, "confidence": 0.6},
        {"effect": "end_stop", "alternative": 1, "confidence": 0.6}, {"effect": "quadratic_drag", "alternative": 1, "confidence": 0.5}],
        "ranking": [], "gap": {"base": 0.4, "after": 0.2}, "more": {}})";
    const exam::Reply reply = exam::parse_reply(text, "v.json");
    EXPECT_THAT(reply.named, ElementsAre(ElementsAre("backlash"), ElementsAre("end_stop", "quadratic_drag")));
    EXPECT_EQ(reply.confidence, 0.5);
    EXPECT_EQ(reply.gap_before, 0.4);
    EXPECT_EQ(reply.gap_after, 0.2);
    const exam::Reply unknown = exam::parse_reply(
        R"({"schema": "glsum-gap-1", "verdict": "unknown", "effects": [], "gap": {}, "suspect": {"effects": [{"effect": "backlash"}]}})",
        "v.json");
    EXPECT_THAT(unknown.suspect, ElementsAre("backlash"));
    EXPECT_FALSE(unknown.gap_before);
    const auto refusal = [](const std::string& text) {
        return failure_of([&] { (void)exam::parse_reply(text, "v.json"); });
    };
    // Of one cause its own confidence; one that is attributed names all of its causes together.
    const exam::Reply one = exam::parse_reply(
        R"({"schema": "glsum-gap-1", "verdict": "attributed", "effects": [{"effect": "x", "confidence": 0.8}, {"effect": "y", "confidence": 0.9}], "gap": {}})",
        "v.json");
    EXPECT_EQ(one.confidence, 0.8);
    EXPECT_THAT(one.named, ElementsAre(ElementsAre("x", "y")));
    EXPECT_THAT(refusal(R"({"schema": "glsum-gap-2", "verdict": "no_gap", "effects": [], "gap": {}})"),
                HasSubstr("v.json: schema: expected"));
    EXPECT_THAT(refusal(R"({"schema": "glsum-gap-1", "verdict": "perhaps"})"),
                HasSubstr("v.json: verdict: expected one of attributed"));
    EXPECT_THAT(refusal(R"({"schema": "glsum-gap-1", "verdict": "attributed", "effects": [], "gap": {}})"),
                HasSubstr("effects: expected at least one"));
    EXPECT_THAT(
        refusal(
            R"({"schema": "glsum-gap-1", "verdict": "attributed", "effects": [{"effect": "x", "confidence": 2}], "gap": {}})"),
        HasSubstr("effects[0]: confidence: expected 0 to 1, found 2"));
}

// One question from the record to the mark.
TEST(Exam, AnswersWhatIsAsked) {
    const exam::Asked asked =
        asked_of(R"({"name": "stand", "train": ["t.csv"], "base": "m.json", "split_s": 12, "units": {"y": "rad"}})");
    const gap::Record record =
        gap_test::log_of({{"input_dead_zone.width", 0.02}}, {.experiment = "prbs", .low_duty = 0.02, .seed = 81});
    const gap::Question question = exam::to_question(asked, {{record}, {}, gap::model_of(gap_test::linear_form())}, 1);
    EXPECT_FALSE(question.refit);
    EXPECT_EQ(question.split_s, 12.0);
    const gap::Answer answer = gap::diagnose(question, [](const std::string&) {});
    const std::string text = exam::to_answer(asked, answer);
    const nlohmann::json verdict = nlohmann::json::parse(text);
    EXPECT_EQ(verdict["question"]["units"]["y"], "rad");
    EXPECT_EQ(verdict["split"], true);
    const exam::Scored scored =
        exam::score(truth_of(R"("known": "listed", "causes": [{"any_of": ["input_dead_zone"]}])"),
                    exam::parse_reply(text, "v.json"));
    EXPECT_EQ(scored.mark, Mark::right) << text;

    exam::Asked late = asked;
    late.split_s = 19.9;
    EXPECT_THAT(failure_of([&] {
                    (void)exam::to_question(late, {{record}, {}, gap::model_of(gap_test::linear_form())}, 1);
                }),
                HasSubstr("stand: split_s 19.9: expected 32 samples or more on both sides"));
}

TEST(Exam, TellsTheAlternativesOfAnAmbiguityApart) {
    const gap::Answer answer = gap_test::ask({{"actuator_lag.tau_s", 0.12}}, 9);
    ASSERT_EQ(answer.decision.outcome, gap::Outcome::ambiguous) << gap::to_text(answer);
    EXPECT_EQ(exam::parse_reply(gap::to_json(answer), "v.json").named.size(), answer.decision.effects.size());
}

std::string read(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Exam, OfTheRealRigsAsksWhatIsKnown) {
    const std::filesystem::path folder = std::filesystem::path(TEST_PROJECT) / "gap" / "exam";
    const auto asked = exam::parse_manifest(read(folder / "real.json"), "real.json");
    const auto known = exam::parse_truth(read(folder / "real_truth.json"), "real_truth.json");
    ASSERT_EQ(asked.size(), known.size());
    for (std::size_t i = 0; i < asked.size(); ++i) {
        EXPECT_EQ(asked[i].name, known[i].name);
    }
    const char* shared = std::getenv("GLSUM_SHARED");
    if (shared == nullptr) {
        GTEST_SKIP() << "GLSUM_SHARED is not set: the logs are not part of the project";
    }
    for (const exam::Asked& question : asked) {
        for (const auto* paths : {&question.train, &question.validate}) {
            for (const std::string& path : *paths) {
                EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(shared) / "data" / "real" / path)) << path;
            }
        }
    }
}

}  // namespace
