// The rules for verdicts on cases without a model, one by one.
#include "drive/stand/blind/judge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/failure.hpp"

namespace {

using stand::blind::Claim;
using stand::blind::judge;
using stand::blind::OpenScore;
using stand::blind::SealedCase;
using testing::HasSubstr;

SealedCase open_case(const std::string& kind, std::vector<std::string> effects = {}) {
    SealedCase truth;
    truth.name = "001";
    truth.fitted_base = true;
    truth.domain = "thermal";
    truth.kind = kind;
    truth.effects = std::move(effects);
    truth.size = "clear";
    return truth;
}
stand::blind::Answer says(const std::string& verdict, std::vector<std::string> effects = {}, double confidence = 0.95) {
    stand::blind::Answer given;
    given.verdict = verdict;
    given.effects = std::move(effects);
    given.confidence = confidence;
    return given;
}

void expect(const SealedCase& truth, const stand::blind::Answer& answer, double points, bool wrong) {
    const auto judged = judge(truth, answer);
    EXPECT_NEAR(judged.points, points, 1e-12) << truth.kind << ' ' << answer.verdict;
    EXPECT_EQ(judged.wrong, wrong) << truth.kind << ' ' << answer.verdict;
}

TEST(Judge, WantsNothingNamedWhereThereIsNothing) {
    expect(open_case("none"), says("no_gap"), 1.0, false);
    expect(open_case("none"), says("unknown"), 0.0, false);
    expect(open_case("none"), says("ambiguous", {"backlash", "end_stop"}), 0.0, false);
    expect(open_case("none"), says("attributed", {"backlash"}), 0.0, true);
}

TEST(Judge, TakesWhatAFittedBaseTakesUpAsNothing) {
    expect(open_case("taken_up", {"gain_error"}), says("no_gap"), 1.0, false);
    expect(open_case("taken_up", {"gain_error"}), says("unknown"), 0.0, false);
    expect(open_case("taken_up", {"gain_error"}), says("attributed", {"backlash"}), 0.0, true);
    expect(open_case("taken_up", {"input_dead_zone"}), says("attributed", {"input_dead_zone"}), 0.0, false);
}

TEST(Judge, CountsASingleCause) {
    const SealedCase truth = open_case("single", {"backlash"});
    expect(truth, says("attributed", {"backlash"}), 1.0, false);
    expect(truth, says("attributed", {"backlash", "end_stop"}), 0.5, false);
    expect(truth, says("attributed", {"end_stop"}), 0.0, true);
    expect(truth, says("no_gap"), 0.0, false);
    expect(truth, says("unknown"), 0.0, false);
}

TEST(Judge, SharesAnAmbiguityAmongItsAlternatives) {
    const SealedCase truth = open_case("single", {"backlash"});
    expect(truth, says("ambiguous", {"backlash"}), 1.0, false);
    expect(truth, says("ambiguous", {"end_stop", "backlash"}), 0.5, false);
    expect(truth, says("ambiguous", {"end_stop", "backlash", "cogging"}), 1.0 / 3.0, false);
    expect(truth, says("ambiguous", {"end_stop", "backlash", "cogging", "input_curve"}), 0.0, false);
    expect(truth, says("ambiguous", {"end_stop", "cogging"}), 0.0, false);
}

TEST(Judge, CountsHalfAPairForOneOfIt) {
    const SealedCase truth = open_case("pair", {"backlash", "end_stop"});
    expect(truth, says("attributed", {"end_stop", "backlash"}), 1.0, false);
    expect(truth, says("attributed", {"end_stop"}), 0.5, false);
    expect(truth, says("attributed", {"end_stop", "cogging"}), 1.0 / 3.0, false);
    expect(truth, says("attributed", {"cogging"}), 0.0, true);
    expect(truth, says("ambiguous", {"cogging", "end_stop"}), 0.25, false);
}

TEST(Judge, WantsAnUnlistedEffectCalledUnknown) {
    const SealedCase truth = open_case("unlisted", {"hum"});
    expect(truth, says("unknown"), 1.0, false);
    expect(truth, says("no_gap"), 0.0, false);
    expect(truth, says("attributed", {"backlash"}), 0.0, true);
    expect(truth, says("attributed", {"hum"}), 0.0, true);  // no table has it
    expect(truth, says("ambiguous", {"backlash", "end_stop"}), 0.0, false);
}

TEST(OpenScore, Counts) {
    const std::vector<SealedCase> truths{open_case("none"),
                                         open_case("taken_up", {"gain_error"}),
                                         open_case("single", {"backlash"}),
                                         open_case("single", {"end_stop"}),
                                         open_case("pair", {"backlash", "end_stop"}),
                                         open_case("unlisted", {"hum"})};
    const std::vector<stand::blind::Answer> answers{says("no_gap"),
                                                    says("attributed", {"end_stop"}, 0.6),
                                                    says("attributed", {"backlash"}, 0.9),
                                                    says("ambiguous", {"backlash", "cogging"}),
                                                    says("attributed", {"end_stop"}, 0.95),
                                                    says("unknown")};
    const OpenScore found = stand::blind::score_open(truths, answers);
    EXPECT_DOUBLE_EQ(found.singles.value(), 0.5);
    EXPECT_DOUBLE_EQ(found.pairs.value(), 0.5);
    EXPECT_EQ(found.wrong.hits, 1U);
    EXPECT_EQ(found.wrong.all, 6U);
    EXPECT_EQ(found.unlisted.hits, 1U);
    EXPECT_EQ(found.nothing.hits, 1U);
    EXPECT_EQ(found.nothing.all, 2U);
    EXPECT_EQ(found.ambiguous_without.hits, 1U);
    EXPECT_DOUBLE_EQ(found.by_effect.at("backlash").value(), 1.0);
    EXPECT_EQ(found.by_domain.at("thermal").all, 2U);
    ASSERT_EQ(found.claims.size(), 3U);  // half a pair is no right answer
    EXPECT_EQ(stand::blind::right_of_the_sure(found.claims).hits, 1U);
    EXPECT_EQ(stand::blind::right_of_the_sure(found.claims).all, 2U);
    EXPECT_EQ(stand::blind::sure_of_the_right(found.claims).hits, 1U);
    EXPECT_EQ(found.confusion.at("taken_up: gain_error").at("end_stop"), 1U);
    EXPECT_EQ(found.confusion.at("end_stop").at("backlash or cogging"), 1U);
    ASSERT_EQ(found.cases.size(), 6U);
    EXPECT_DOUBLE_EQ(found.cases[4].judged.points, 0.5);
    EXPECT_THAT(stand::blind::to_text(found), HasSubstr("single causes, points (>= 80 %)                 50.0 %"));
    EXPECT_THAT(stand::blind::to_json(found),
                testing::AllOf(HasSubstr("\"glsum-open-score-1\""), HasSubstr("\"points\": 0.5")));
    EXPECT_THAT(stand::blind::missed_goals(found),
                testing::ElementsAre(HasSubstr("points for single causes"), HasSubstr("wrong: expected at most 3 %"),
                                     HasSubstr("no_gap where"), HasSubstr("right of the answers at 0.9")));
    EXPECT_THROW((void)stand::blind::score_open(truths, std::vector<stand::blind::Answer>(2)), glsum::Failure);
}

TEST(OpenScore, ReachesItsGoals) {
    const std::vector<SealedCase> truths{open_case("none"), open_case("single", {"backlash"}),
                                         open_case("unlisted", {"hum"})};
    const std::vector<stand::blind::Answer> answers{says("no_gap"), says("attributed", {"backlash"}), says("unknown")};
    EXPECT_THAT(stand::blind::missed_goals(stand::blind::score_open(truths, answers)), testing::IsEmpty());
    // Right and never sure is a goal missed.
    const std::vector<stand::blind::Answer> shy{says("no_gap"), says("attributed", {"backlash"}, 0.5), says("unknown")};
    EXPECT_THAT(stand::blind::missed_goals(stand::blind::score_open(truths, shy)),
                testing::ElementsAre(HasSubstr("of the right answers at 0.9 and above: expected at least 60 %")));
}

TEST(Calibration, IsCountedAndDrawn) {
    const std::vector<Claim> claims{{0.95, true}, {0.92, true}, {0.91, false}, {0.6, true}, {1.0, true}};
    EXPECT_NEAR(stand::blind::brier_score(claims), (0.05 * 0.05 + 0.08 * 0.08 + 0.91 * 0.91 + 0.4 * 0.4 + 0.0) / 5.0,
                1e-12);
    EXPECT_EQ(stand::blind::brier_score({}), 0.0);
    EXPECT_EQ(stand::blind::calibrate(claims).back().right.all, 2U);
    const auto picture = stand::blind::picture_of_calibration(claims);
    EXPECT_THAT(picture.script, HasSubstr("Of 4 answers with a confidence of 0.9 or more 3 are right"));
    EXPECT_THAT(picture.script, HasSubstr("\"1 of 2\""));
    EXPECT_THAT(picture.script, HasSubstr("5 answers that name causes"));
}

TEST(SealedTruth, OfAFittedBaseHasItsClasses) {
    const std::string text = R"({"schema": "glsum-blind-truth-1", "base": "fitted", "seed": 1, "cases": [
        {"case": "001", "class": "taken_up", "domain": "hydraulic", "effects": [{"effect": "gain_error", "size": "large"}],
         "train": "step", "validate": "ramp", "gap": {"base": 0.1, "noise_floor": 0.1}}]})";
    EXPECT_EQ(stand::blind::parse_sealed(text, "t.json").front().domain, "hydraulic");
    const auto refusal = [&](const std::string& from, const std::string& to) {
        std::string changed = text;
        changed.replace(changed.find(from), from.size(), to);
        try {
            (void)stand::blind::parse_sealed(changed, "t.json");
        } catch (const glsum::Failure& failure) {
            return std::string(failure.what());
        }
        return std::string("accepted");
    };
    EXPECT_THAT(refusal("taken_up", "same"),
                HasSubstr("class: expected one of none, single, pair, unlisted, taken_up"));
    EXPECT_THAT(refusal("\"fitted\"", "\"given\""), HasSubstr("base: expected fitted, found \"given\""));
    EXPECT_THAT(refusal("\"domain\"", "\"field\""), HasSubstr("domain: expected a text"));
}

}  // namespace
