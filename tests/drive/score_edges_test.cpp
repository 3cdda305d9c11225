// What a blind verdict and a sealed case may leave out, what they may not, and how ties are told.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "base/failure.hpp"
#include "drive/stand/blind/judge.hpp"
#include "drive/stand/blind/score.hpp"

namespace {

namespace blind = stand::blind;
using blind::Answer;
using blind::Score;
using blind::SealedCase;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Answer read(const std::string& rest, const char* verdict = "unknown") {
    return blind::parse_answer(fmt::format(R"({{"schema": "glsum-gap-1", "verdict": "{}", {}}})", verdict, rest),
                               "v.json");
}
std::string refusal(const std::string& rest, const char* verdict) {
    try {
        (void)read(rest, verdict);
    } catch (const glsum::Failure& failure) {
        return failure.what();
    }
    return "accepted";
}
std::string sure(const char* confidence) {
    return fmt::format(R"("effects": [{{"effect": "backlash", "confidence": {}}}], "ranking": [], "gap": {{}})",
                       confidence);
}

TEST(ScoreEdges, AVerdictNamesEffectsWhereItClaimsSome) {
    const char* nothing = R"("effects": [], "ranking": [], "gap": {})";
    EXPECT_THAT(refusal(nothing, "attributed"), HasSubstr("expected at least one beside the verdict attributed"));
    EXPECT_THAT(refusal(nothing, "ambiguous"), HasSubstr("expected at least one beside the verdict ambiguous"));
    EXPECT_EQ(refusal(nothing, "unknown"), "accepted");
    EXPECT_EQ(refusal(nothing, "no_gap"), "accepted");
    EXPECT_EQ(read(nothing).confidence, 0.0);
}

TEST(ScoreEdges, ConfidencesAreSharesOfOne) {
    EXPECT_EQ(read(sure("0"), "attributed").confidence, 0.0);
    EXPECT_EQ(read(sure("1"), "attributed").confidence, 1.0);
    EXPECT_THAT(refusal(sure("1.005"), "attributed"), HasSubstr("confidence: expected 0 to 1, found 1.005"));
    EXPECT_THAT(refusal(sure("-0.005"), "attributed"), HasSubstr("confidence: expected 0 to 1, found -0.005"));
}

TEST(ScoreEdges, EffectsOfEqualPointsStayInTheirOrder) {
    const char* ranked =
        R"("effects": [], "gap": {}, "ranking": [{"effect": "b", "score": 1}, {"effect": "a", "score": 1},
        {"effect": "c", "score": 2}])";
    EXPECT_THAT(read(ranked).ranking, ElementsAre("c", "b", "a"));
}

TEST(ScoreEdges, WhatAVerdictDoesNotSayIsNotThere) {
    const auto with_gap = [](const char* gap) {
        return read(fmt::format(R"("effects": [], "ranking": [], "gap": {})", gap)).gap_after;
    };
    EXPECT_EQ(with_gap(R"({"after": 0.25})"), 0.25);
    EXPECT_FALSE(with_gap(R"({"base": 0.25})"));
    EXPECT_FALSE(with_gap(R"({"after": null})"));
    EXPECT_FALSE(with_gap("null"));
    // A verdict may say in which frequencies, and not when.
    for (const char* where : {"{}", "null", R"({"frequency": [{"from_hz": 1, "to_hz": 2}]})"}) {
        EXPECT_THAT(read(fmt::format(R"("effects": [], "ranking": [], "gap": {{}}, "where": {})", where)).where,
                    IsEmpty());
    }
}

TEST(ScoreEdges, ASealedCaseOfAFittedBaseSaysSo) {
    const auto sealed = [](const char* base, const char* profile) {
        return blind::parse_sealed(
                   fmt::format(R"({{"schema": "glsum-blind-truth-1"{}, "cases": [{{"case": "1", "domain": "thermal",
            "class": "none", "effects": [], "train": "a", "validate": "b", "gap": {{"base": 1, "noise_floor": 1}}{}}}]}})",
                               base, profile),
                   "t.json")
            .front();
    };
    EXPECT_FALSE(sealed("", "").fitted_base);
    EXPECT_TRUE(sealed(R"(, "base": "fitted")", "").fitted_base);
    EXPECT_EQ(sealed(R"(, "base": "fitted")", "").domain, "thermal");
    EXPECT_FALSE(sealed("", "").new_profile);
    EXPECT_FALSE(sealed("", R"(, "new_profile": false)").new_profile);
    EXPECT_TRUE(sealed("", R"(, "new_profile": true)").new_profile);
}

TEST(ScoreEdges, AnEffectThatIsNamedTwiceIsOne) {
    SealedCase truth;
    truth.kind = "single";
    truth.effects = {"backlash"};
    truth.size = "large";
    truth.train = "ramp";
    Answer answer;
    answer.verdict = "attributed";
    answer.effects = {"backlash", "backlash"};
    EXPECT_TRUE(is_right(truth, answer));
    EXPECT_EQ(blind::column_of(answer), "backlash");
    const Score found = blind::score(std::vector{truth}, std::vector{answer});
    EXPECT_EQ(found.by_size.at("large").hits, 1U);
    EXPECT_EQ(found.by_training.at("ramp").hits, 1U);
}

TEST(ScoreEdges, IsToldWithItsTiesItsSingleClaimsAndItsMedian) {
    Score score;
    score.confusion = {{"backlash", {{"end_stop", 2}, {"no_gap", 3}, {"unknown", 2}}}};
    score.calibration = {{0.5, 0.7, {1, 1}, 0.625}};
    score.shrinks = {0.1, 0.2, 0.4, 0.7, 0.9};
    const std::vector<blind::Scored> scored{{"own", score}};
    const std::string text = blind::to_text(scored);
    EXPECT_THAT(text, HasSubstr(" 3 no_gap; 2 end_stop; 2 unknown\n"));
    EXPECT_THAT(text, HasSubstr("0.50 to 0.70, mean 0.625"));
    EXPECT_THAT(text, HasSubstr("median 0.400, a tenth below 0.100 (5 cases)"));
    // A table without a row is one.
    const auto row = nlohmann::json::parse(blind::to_json(scored))["scores"][0];
    for (const char* key : {"by_class", "by_effect", "by_size", "by_training"}) {
        EXPECT_EQ(row.at(key), nlohmann::json::object()) << key;
    }
}

// Somebody who leaves it open between causes is counted among those who leave the true one out, where it is not among
// them or where there is none to name.
TEST(ScoreEdges, AnAmbiguityIsHeldAgainstWhatThereIsToName) {
    const auto without = [](const char* kind, std::vector<std::string> effects) {
        SealedCase truth;
        truth.fitted_base = true;
        truth.kind = kind;
        truth.effects = std::move(effects);
        truth.size = "small";
        Answer answer;
        answer.verdict = "ambiguous";
        answer.effects = {"backlash", "cogging"};
        return blind::score_open(std::vector{truth}, std::vector{answer});
    };
    EXPECT_EQ(without("single", {"backlash"}).ambiguous_without.hits, 0U);
    EXPECT_EQ(without("single", {"end_stop"}).ambiguous_without.hits, 1U);
    EXPECT_EQ(without("pair", {"end_stop", "backlash"}).ambiguous_without.hits, 0U);
    EXPECT_EQ(without("pair", {"end_stop", "gain_drift"}).ambiguous_without.hits, 1U);
    EXPECT_EQ(without("unlisted", {"cogging"}).ambiguous_without.hits, 1U);
    EXPECT_EQ(without("none", {}).ambiguous_without.hits, 1U);
    EXPECT_EQ(without("single", {"backlash"}).by_size.at("small").all, 1U);
    EXPECT_THAT(blind::to_text(without("none", {})), HasSubstr("reached  counted, with Wilson's 95 % interval"));
}

TEST(ScoreEdges, OneClaimIsEnoughForItsBin) {
    const std::vector<blind::Claim> one{{0.96, true}};
    EXPECT_THAT(blind::picture_of_calibration(one).script, HasSubstr("\"1 of 1\"\nEOD"));
    EXPECT_THAT(blind::picture_of_calibration(one).script,
                HasSubstr("Of 1 answers with a confidence of 0.9 or more 1 are right"));
    for (const blind::Confidence& bin : blind::calibrate({})) {
        EXPECT_EQ(bin.claimed, 0.0) << bin.from;
    }
    // An interval of shares ends at 1, whatever is rounded.
    for (std::size_t n = 1; n < 200; ++n) {
        EXPECT_LE((blind::Share{n, n}).high(), 1.0) << n;
        EXPECT_GE((blind::Share{0, n}).low(), 0.0) << n;
    }
}

}  // namespace
