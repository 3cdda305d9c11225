// The score of blind verdicts, on cases and answers that are counted by hand.
#include "drive/stand/blind/score.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/failure.hpp"

namespace {

using stand::blind::Answer;
using stand::blind::is_right;
using stand::blind::Oracle;
using stand::blind::Score;
using stand::blind::SealedCase;
using stand::blind::Share;
using testing::HasSubstr;

SealedCase sealed(const std::string& kind, std::vector<std::string> effects = {}) {
    SealedCase truth;
    truth.name = "001";
    truth.kind = kind;
    truth.effects = std::move(effects);
    truth.size = "clear";
    truth.train = "step";
    truth.validate = "prbs";
    truth.gap_base = 0.5;
    truth.noise_floor = 0.1;
    return truth;
}
Answer answer(const std::string& verdict, std::vector<std::string> effects = {}, double confidence = 0.9) {
    Answer given;
    given.verdict = verdict;
    given.ranking = effects;
    given.effects = std::move(effects);
    given.confidence = confidence;
    return given;
}

TEST(Wilson, IsThePublishedInterval) {
    // Brown, Cai and DasGupta's examples are computed by the same formula: 0.5, and the ends.
    const Share half{5, 10};
    EXPECT_NEAR(half.low(), 0.2366, 1e-4);
    EXPECT_NEAR(half.high(), 0.7634, 1e-4);
    const Share all{20, 20};
    EXPECT_NEAR(all.low(), 0.8389, 1e-4);
    EXPECT_EQ(all.high(), 1.0);
    const Share none{0, 20};
    EXPECT_EQ(none.low(), 0.0);
    EXPECT_NEAR(none.high(), 0.1611, 1e-4);
}

TEST(Score, KnowsTheRightAnswerOfEachClass) {
    EXPECT_TRUE(is_right(sealed("none"), answer("no_gap")));
    EXPECT_FALSE(is_right(sealed("none"), answer("unknown")));
    EXPECT_TRUE(is_right(sealed("single", {"backlash"}), answer("attributed", {"backlash"})));
    EXPECT_FALSE(is_right(sealed("single", {"backlash"}), answer("attributed", {"backlash", "gain_error"})));
    EXPECT_FALSE(is_right(sealed("single", {"backlash"}), answer("ambiguous", {"backlash"})));
    EXPECT_FALSE(is_right(sealed("single", {"backlash"}), answer("no_gap")));
    EXPECT_TRUE(is_right(sealed("pair", {"backlash", "end_stop"}), answer("attributed", {"end_stop", "backlash"})));
    EXPECT_FALSE(is_right(sealed("pair", {"backlash", "end_stop"}), answer("attributed", {"end_stop"})));
    EXPECT_TRUE(is_right(sealed("unlisted", {"cogging"}), answer("unknown")));
    EXPECT_FALSE(is_right(sealed("unlisted", {"cogging"}), answer("attributed", {"backlash"})));
    SealedCase same = sealed("same", {"input_curve"});
    same.required = {"gain_error", "input_curve"};
    same.allowed = {"gain_error", "input_curve", "input_dead_zone"};
    EXPECT_TRUE(is_right(same, answer("ambiguous", {"gain_error", "input_curve"})));
    EXPECT_TRUE(is_right(same, answer("ambiguous", {"input_dead_zone", "input_curve", "gain_error"})));
    EXPECT_FALSE(is_right(same, answer("ambiguous", {"gain_error", "input_dead_zone"})));
    EXPECT_FALSE(is_right(same, answer("ambiguous", {"gain_error", "input_curve", "backlash"})));
    EXPECT_FALSE(is_right(same, answer("attributed", {"gain_error", "input_curve"})));
}

TEST(Score, Counts) {
    std::vector<SealedCase> truths{sealed("none"),
                                   sealed("none"),
                                   sealed("single", {"backlash"}),
                                   sealed("single", {"end_stop"}),
                                   sealed("pair", {"gain_error", "backlash"}),
                                   sealed("unlisted", {"hum"})};
    truths[1].new_profile = true;
    std::vector<Answer> answers{answer("no_gap"),
                                answer("attributed", {"backlash"}, 0.6),
                                answer("attributed", {"backlash"}, 0.97),
                                answer("ambiguous", {"backlash", "end_stop"}),
                                answer("attributed", {"gain_error"}, 0.92),
                                answer("unknown")};
    answers[2].gap_after = 0.14;
    answers[4].gap_after = 0.1;
    const Score found = stand::blind::score(truths, answers);
    EXPECT_EQ(found.top_one.hits, 3U);
    EXPECT_EQ(found.top_one.all, 6U);
    EXPECT_EQ(found.top_two.hits, 2U);  // the ambiguous one too; the pair's second is not there
    EXPECT_EQ(found.top_two.all, 3U);
    EXPECT_EQ(found.detection.hits, 4U);
    EXPECT_EQ(found.false_alarms.hits, 1U);
    EXPECT_EQ(found.false_alarms.all, 2U);
    EXPECT_EQ(found.false_alarms_new_profile.hits, 1U);
    EXPECT_EQ(found.wrong_claims.hits, 2U);
    EXPECT_EQ(found.wrong_claims.all, 3U);
    EXPECT_EQ(found.by_class.at("pair").hits, 0U);
    EXPECT_EQ(found.by_effect.at("backlash").hits, 1U);
    EXPECT_EQ(found.by_effect.at("end_stop").hits, 0U);
    EXPECT_EQ(found.confusion.at("end_stop").at("ambiguous"), 1U);
    EXPECT_EQ(found.confusion.at("none").at("backlash"), 1U);
    EXPECT_EQ(found.confusion.at("pair").at("gain_error"), 1U);
    ASSERT_EQ(found.shrinks.size(), 1U);  // of what is named rightly alone
    EXPECT_NEAR(found.shrinks[0], 0.9, 1e-12);
    EXPECT_EQ(found.identifiable.all, 0U);
    ASSERT_EQ(found.calibration.size(), 6U);
    EXPECT_EQ(found.calibration[1].right.all, 1U);
    EXPECT_EQ(found.calibration[4].right.all, 1U);
    EXPECT_EQ(found.calibration[5].right.hits, 1U);
    EXPECT_NEAR(found.calibration[5].claimed, 0.97, 1e-12);
    EXPECT_THROW((void)stand::blind::score(truths, std::vector<Answer>(2)), glsum::Failure);
}

TEST(Score, HoldsShrinkAgainstTheOracle) {
    const std::vector<SealedCase> truths{sealed("single", {"backlash"}), sealed("single", {"end_stop"}),
                                         sealed("pair", {"end_stop", "backlash"}), sealed("none")};
    std::vector<Answer> answers{answer("attributed", {"backlash"}), answer("no_gap"),
                                answer("attributed", {"backlash"}), answer("no_gap")};
    answers[0].gap_after = 0.18;
    answers[1].gap_after = 0.2;  // nothing named: nothing gained
    answers[2].gap_after = 0.3;  // one of two
    const std::vector<std::optional<Oracle>> oracle{Oracle{true, 0.5, 0.1}, Oracle{false, 0.5, 0.4},
                                                    Oracle{true, 0.5, 0.1}, Oracle{false, 0.1, 0.1}};
    const Score found = stand::blind::score(truths, answers, oracle);
    EXPECT_EQ(found.identifiable.hits, 1U);
    EXPECT_EQ(found.identifiable.all, 1U);
    ASSERT_EQ(found.of_the_oracle.size(), 3U);
    EXPECT_NEAR(found.of_the_oracle[0], 0.0, 1e-12);
    EXPECT_NEAR(found.of_the_oracle[1], 0.5, 1e-12);
    EXPECT_NEAR(found.of_the_oracle[2], 0.8, 1e-12);
    EXPECT_THAT(
        stand::blind::missed_goals(found),
        testing::ElementsAre(HasSubstr("pairs named"), HasSubstr("shrink: expected at least 0.9 of the oracle's")));
}

TEST(Score, SaysHowMuchIsLocatedRightly) {
    std::vector<SealedCase> truths{sealed("single", {"load_disturbance"})};
    truths[0].where = {{10.0, 20.0}};
    std::vector<Answer> answers{answer("attributed", {"load_disturbance"})};
    answers[0].where = {{0.0, 5.0, 0.2}, {5.0, 15.0, 0.8}};
    ASSERT_EQ(stand::blind::score(truths, answers).in_the_stretch.size(), 1U);
    EXPECT_NEAR(stand::blind::score(truths, answers).in_the_stretch[0], 0.4, 1e-12);
}

TEST(Score, NamesTheGoalsThatAreMissed) {
    const std::vector<SealedCase> truths{sealed("none"), sealed("unlisted", {"hum"}), sealed("pair", {"a", "b"})};
    const auto missed =
        stand::blind::missed_goals(stand::blind::score(truths, std::vector<Answer>(3, answer("attributed", {"a"}))));
    EXPECT_THAT(missed, testing::ElementsAre(HasSubstr("unlisted"), HasSubstr("pairs"), HasSubstr("false alarms")));
    const auto guess = stand::blind::constant_guess(3);
    const std::vector<stand::blind::Scored> scored{{"guess", stand::blind::score(truths, guess)}};
    EXPECT_THAT(stand::blind::to_text(scored), HasSubstr("detection                          0/2"));
    EXPECT_THAT(stand::blind::to_json(scored), HasSubstr("\"hits\": 1"));
}

constexpr const char* good =
    R"({"schema": "glsum-gap-1", "verdict": "attributed", "effects": [{"effect": "backlash", "confidence": 0.8},
        {"effect": "end_stop", "confidence": 0.7}], "ranking": [{"effect": "gain_error", "score": 1, "gap_after": 0.2},
        {"effect": "backlash", "score": 5, "gap_after": 0.1}], "gap": {"base": 0.4, "after": 0.1, "noise_floor": 0.05},
        "where": {"time": [{"from_s": 0, "to_s": 2, "share": 1}]}})";

TEST(Verdict, IsRead) {
    const Answer read = stand::blind::parse_answer(good, "verdict.json");
    EXPECT_EQ(read.verdict, "attributed");
    EXPECT_THAT(read.effects, testing::ElementsAre("backlash", "end_stop"));
    EXPECT_DOUBLE_EQ(read.confidence, 0.7);
    EXPECT_THAT(read.ranking, testing::ElementsAre("backlash", "gain_error"));
    EXPECT_DOUBLE_EQ(read.gap_after.value(), 0.1);
    ASSERT_EQ(read.where.size(), 1U);
}

std::string refusal(std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    try {
        (void)stand::blind::parse_answer(text, "v.json");
    } catch (const glsum::Failure& failure) {
        return failure.what();
    }
    return "accepted";
}

TEST(Verdict, IsRefusedWhereItIsNone) {
    EXPECT_THAT(refusal(good, "glsum-gap-1", "glsum-gap-2"), HasSubstr("v.json: schema: expected glsum-gap-1"));
    EXPECT_THAT(refusal(good, "attributed", "perhaps"), HasSubstr("verdict: expected attributed, ambiguous"));
    EXPECT_THAT(refusal(good, "0.7", "1.7"), HasSubstr("confidence: expected 0 to 1, found 1.7"));
    EXPECT_THAT(refusal(good, "\"score\": 5", "\"score\": \"5\""), HasSubstr("score: expected a number"));
    EXPECT_THAT(refusal(good, "{\"schema\"", "[\"schema\""), HasSubstr("expected a JSON object"));
}

TEST(Score, ACriterionNamesOneEffectOrNone) {
    const Answer one = stand::blind::answer_naming("backlash");
    EXPECT_TRUE(is_right(sealed("single", {"backlash"}), one));
    EXPECT_EQ(one.ranking, one.effects);
    const Answer none = stand::blind::answer_naming("none");
    EXPECT_TRUE(is_right(sealed("none"), none));
    EXPECT_TRUE(none.effects.empty());
    EXPECT_TRUE(none.ranking.empty());
}

}  // namespace
