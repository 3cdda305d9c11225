// Exams at their limits: what a manifest may hold, to the last letter, and every field of a score by what was asked.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/failure.hpp"
#include "gap/exam/manifest.hpp"
#include "gap/exam/score.hpp"

namespace {

namespace exam = gap::exam;
using exam::Mark;
using testing::HasSubstr;

// What is said of a manifest; "read" where nothing is wrong.
std::string said_of_text(const std::string& text) {
    try {
        (void)exam::parse_manifest(text, "m.json");
    } catch (const glsum::Failure& failure) {
        return failure.what();
    }
    return "read";
}

std::string said_of(const std::string& question) {
    return said_of_text(R"({"schema": "glsum-exam-1", "questions": [)" + question + "]}");
}

std::string named(const std::string& name) { return R"({"name": ")" + name + R"(", "train": ["x"], "base": "fit"})"; }

std::string with(const std::string& fields) {
    return R"({"name": "a", "train": ["x"], "base": "fit", )" + fields + "}";
}

std::string list_of(std::size_t count, const std::string& item) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) {
        text += (i > 0 ? ", \"" : "\"") + item + std::to_string(i) + '"';
    }
    return "[" + text + "]";
}

TEST(ManifestLimits, NamesAreOfSmallLettersDigitsAndTwoSigns) {
    EXPECT_EQ(said_of(named("az09_-")), "read");
    EXPECT_EQ(said_of(named(std::string(64, 'a'))), "read");
    for (const std::string& name : {std::string(65, 'a'), std::string(), std::string("A"), std::string("`"),
                                    std::string("{"), std::string("/"), std::string(":"), std::string("a b")}) {
        EXPECT_THAT(said_of(named(name)), HasSubstr("expected a name of 1 to 64")) << name;
    }
    EXPECT_THAT(said_of(named("a") + ", " + named("a")), HasSubstr("expected names that differ, found a twice"));
}

TEST(ManifestLimits, TextsListsAndQuestionsEnd) {
    EXPECT_EQ(said_of(with(R"("time_column": ")" + std::string(512, 't') + '"')), "read");
    EXPECT_THAT(said_of(with(R"("time_column": ")" + std::string(513, 't') + '"')), HasSubstr("a text of 1 to 512"));
    EXPECT_THAT(said_of(with(R"("time_column": "")")), HasSubstr("a text of 1 to 512"));
    EXPECT_EQ(said_of(with(R"("time_column": " ")")), "read");
    EXPECT_THAT(said_of(with(R"("time_column": "\u001f")")), HasSubstr("a text of 1 to 512"));
    EXPECT_EQ(said_of(with(R"("input_columns": )" + list_of(64, "u"))), "read");
    EXPECT_THAT(said_of(with(R"("input_columns": )" + list_of(65, "u"))), HasSubstr("at most 64, found one of 65"));
    const auto units = [](std::size_t count) {
        std::string text;
        for (std::size_t i = 0; i < count; ++i) {
            text += (i > 0 ? ", \"c" : "\"c") + std::to_string(i) + R"(": "rad")";
        }
        return R"("units": {)" + text + "}";
    };
    EXPECT_EQ(said_of(with(units(64))), "read");
    EXPECT_THAT(said_of(with(units(65))), HasSubstr("units: expected at most 64, found 65"));
    const auto questions = [](std::size_t count) {
        std::string text;
        for (std::size_t i = 0; i < count; ++i) {
            text += (i > 0 ? ", " : "") + named("q" + std::to_string(i));
        }
        return text;
    };
    EXPECT_EQ(said_of(questions(1000)), "read");
    EXPECT_THAT(said_of(questions(1001)), HasSubstr("at most 1000, found one of 1001"));
    EXPECT_THAT(said_of(""), HasSubstr("questions: expected at least one, found none"));
}

TEST(ManifestLimits, BytesAndDepthEnd) {
    const std::string whole = R"({"schema": "glsum-exam-1", "questions": [)" + named("a") + "]}";
    EXPECT_EQ(said_of_text(whole + std::string((4U << 20) - whole.size(), ' ')), "read");
    EXPECT_THAT(said_of_text(whole + std::string((4U << 20) - whole.size() + 1, ' ')),
                HasSubstr("expected at most 4194304 bytes, found 4194305"));
    // Twelve within the outermost.
    const auto nested = [](int depth) { return std::string(depth, '[') + std::string(depth, ']'); };
    EXPECT_THAT(said_of_text(nested(13)), testing::Not(HasSubstr("nested")));
    EXPECT_THAT(said_of_text(nested(14)), HasSubstr("nested at most 12 deep"));
    // The line of what is no JSON.
    EXPECT_THAT(said_of_text("{\n\n x"), testing::StartsWith("m.json:3: expected JSON"));
}

TEST(ManifestLimits, PathsStayBelowTheFolder) {
    EXPECT_EQ(said_of(R"({"name": "a", "train": ["b/../c.csv"], "base": "d/e.json"})"), "read");
    for (const char* path : {"/c.csv", "../c.csv", "b/../../c.csv"}) {
        const std::string text = path;
        EXPECT_THAT(said_of(R"({"name": "a", "train": [")" + text + R"("], "base": "fit"})"), HasSubstr("train: "))
            << path;
        EXPECT_THAT(said_of(R"({"name": "a", "train": ["x"], "validate": [")" + text + R"("], "base": "fit"})"),
                    HasSubstr("validate: "))
            << path;
        EXPECT_THAT(said_of(R"({"name": "a", "train": ["x"], "base": ")" + text + R"("})"), HasSubstr("base: "))
            << path;
    }
    EXPECT_THAT(said_of(with(R"("validate": ["x"])")), HasSubstr("logs that are not fitted"));
    EXPECT_THAT(said_of(with(R"("validate": ["y"], "split_s": 3)")), HasSubstr("split_s: expected it or validate"));
    EXPECT_THAT(said_of(with(R"("split_s": 0)")), HasSubstr("a number above 0"));
    EXPECT_EQ(said_of(with(R"("split_s": 1e-9)")), "read");
    const exam::Asked asked =
        exam::parse_manifest(
            R"({"schema": "glsum-exam-1", "questions": [{"name": "a", "train": ["x"], "base": "fit:sopdt",
            "input_columns": ["u", "v", "w"], "output_column": "y", "metric": "prediction"}]})",
            "m.json")
            .front();
    EXPECT_EQ(asked.columns.input, "u");
    EXPECT_EQ(asked.columns.more_inputs, (std::vector<std::string>{"v", "w"}));
    EXPECT_EQ(asked.columns.output, "y");
    EXPECT_EQ(asked.metric, gap::Metric::prediction);
    EXPECT_TRUE(asked.is_fitted());
    EXPECT_FALSE(asked.refit);
    EXPECT_FALSE(asked.split_s);
}

TEST(ReplyLimits, ConfidencesAreZeroToOne) {
    const auto said = [](const std::string& confidence) {
        try {
            const exam::Reply reply = exam::parse_reply(
                R"({"schema": "glsum-gap-1", "verdict": "attributed", "gap": {}, "effects": [{"effect": "backlash",
                    "confidence": 0.75}, {"effect": "end_stop", "confidence": )" +
                    confidence + "}]}",
                "v.json");
            return std::to_string(reply.confidence);
        } catch (const glsum::Failure& failure) {
            return std::string(failure.what());
        }
    };
    EXPECT_EQ(said("0"), std::to_string(0.0));
    EXPECT_EQ(said("1"), std::to_string(0.75));  // the lowest of the named
    EXPECT_THAT(said("-0.001"), HasSubstr("effects[1]: confidence: expected 0 to 1"));
    EXPECT_THAT(said("1.001"), HasSubstr("effects[1]: confidence: expected 0 to 1"));
    EXPECT_THAT(said("\"1\""), HasSubstr("effects[1]: confidence: expected 0 to 1"));
}

exam::Reply reply(const std::string& verdict, std::vector<std::vector<std::string>> named, double confidence) {
    exam::Reply made;
    made.verdict = verdict;
    made.named = std::move(named);
    made.confidence = confidence;
    made.gap_before = 0.5;
    made.gap_after = 0.25;
    return made;
}

TEST(ScoreFile, HasEachFieldOfAQuestionWhereThereIsOne) {
    exam::Truth truth;
    truth.name = "rig";
    truth.causes = {{{"backlash", "play"}, true}, {{"gain_drift"}, false}};
    truth.attainable_of_base = 0.25;
    exam::Reply unknown = reply("unknown", {}, 0.0);
    unknown.suspect = {"end_stop", "backlash"};
    unknown.gap_after.reset();
    const std::vector<exam::Scored> all = {exam::score(truth, reply("attributed", {{"backlash", "gain_drift"}}, 0.8)),
                                           exam::score(truth, unknown)};
    const auto file = nlohmann::json::parse(exam::to_json(all));
    const auto& first = file["questions"][0];
    EXPECT_EQ(first["name"], "rig");
    EXPECT_EQ(first["mark"], "right");
    EXPECT_EQ(first["points"], 1.0);
    EXPECT_EQ(first["verdict"], "attributed");
    EXPECT_EQ(first["named"], (std::vector<std::vector<std::string>>{{"backlash", "gain_drift"}}));
    EXPECT_EQ(first["confidence"], 0.8);
    EXPECT_EQ(first["known"], "backlash, (gain_drift)");
    EXPECT_EQ(first["gap_before"], 0.5);
    EXPECT_EQ(first["gap_after"], 0.25);
    EXPECT_EQ(first["attainable_gap"], 0.125);
    EXPECT_NEAR(first["closed"].get<double>(), 0.25 / 0.375, 1e-12);
    EXPECT_FALSE(first.contains("reason") || first.contains("suspect"));
    const auto& second = file["questions"][1];
    EXPECT_EQ(second["mark"], "unknown, though known");
    EXPECT_EQ(second["suspect"], (std::vector<std::string>{"end_stop", "backlash"}));
    EXPECT_FALSE(second.contains("gap_after") || second.contains("closed"));
    EXPECT_EQ(file["marks"].size(), exam::all_marks.size());
    EXPECT_EQ(file["marks"]["unknown, though known"], 1);
    EXPECT_EQ(file["marks"]["refused"], 0);
    EXPECT_EQ(file["points"], 1.0);
    EXPECT_EQ(file["surely"], 0);  // from 0.9 on
    EXPECT_NEAR(file["brier"].get<double>(), 0.04, 1e-12);
    const std::string text = exam::to_text(all);
    EXPECT_THAT(text, HasSubstr("rig                right                           1.00   0.500   0.250      0.125  "
                                "backlash + gain_drift (0.80) | backlash, (gain_drift)\n"));
    EXPECT_THAT(text,
                HasSubstr("unknown, though known           0.00   0.500       -      0.125  unknown, suspect end_stop "
                          "+ backlash | "));
    EXPECT_THAT(text, HasSubstr("\nunknown, though known           1\n"));
    EXPECT_THAT(text, HasSubstr("67 % of the attainable closed, mean of 1 questions"));
    // Without a question that is attributed, or attainable, there are no such sums.
    truth.attainable_of_base.reset();
    const auto bare = nlohmann::json::parse(exam::to_json(std::vector{exam::score(truth, unknown)}));
    EXPECT_FALSE(bare.contains("closed") || bare.contains("brier") || bare.contains("surely"));
}

TEST(ScoreFile, SaysWhatIsKnownAndWhatWasNamed) {
    const auto known = [](exam::Known known, std::vector<exam::Cause> causes) {
        exam::Truth truth;
        truth.known = known;
        truth.causes = std::move(causes);
        const auto file =
            nlohmann::json::parse(exam::to_json(std::vector{exam::score(truth, reply("no_gap", {}, 0.0))}));
        return file["questions"][0]["known"].get<std::string>() + '/' + file["questions"][0]["mark"].get<std::string>();
    };
    EXPECT_EQ(known(exam::Known::nothing, {}), "nothing large/right");
    EXPECT_EQ(known(exam::Known::not_listed, {}), "not listed/WRONG");
    EXPECT_EQ(known(exam::Known::not_listed, {{{"hum"}, true}}), "not listed, or hum/WRONG");
    // Of three alternatives one right is a third, of four nothing; where all are right it is all.
    exam::Truth truth;
    truth.causes = {{{"a"}, true}, {{"b"}, true}, {{"c"}, true}, {{"d"}, true}};
    const auto points = [&](std::vector<std::vector<std::string>> named) {
        return exam::score(truth, reply("ambiguous", std::move(named), 0.5)).points;
    };
    EXPECT_NEAR(points({{"a"}, {"x"}, {"y"}}), 1.0 / 3.0, 1e-12);
    EXPECT_NEAR(points({{"a"}, {"b"}, {"y"}}), 0.5, 1e-12);
    EXPECT_EQ(points({{"a"}, {"b"}, {"c"}}), 1.0);
    EXPECT_EQ(points({{"a"}, {"b"}, {"c"}, {"d"}}), 0.0);
    EXPECT_EQ(points({{"a"}, {"x"}, {"y"}, {"z"}}), 0.0);
    EXPECT_EQ(points({{"a", "x"}, {"y"}}), 0.0);
    EXPECT_EQ(exam::score(truth, reply("ambiguous", {{"a", "x"}, {"y"}}, 0.5)).mark, Mark::ambiguous);
    EXPECT_EQ(exam::score(truth, reply("ambiguous", {{"x"}, {"y"}}, 0.5)).mark, Mark::wrong);
    EXPECT_EQ(exam::score(truth, reply("attributed", {{"a", "x"}}, 0.5)).points, 0.5);
}

}  // namespace
