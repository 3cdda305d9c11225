// What a score is written down as: every field of its JSON and line of its text, and goals at their very edges.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "base/failure.hpp"
#include "drive/stand/blind/judge.hpp"
#include "drive/stand/blind/score.hpp"

namespace {

namespace blind = stand::blind;
using blind::Answer;
using blind::Claim;
using blind::OpenScore;
using blind::Score;
using blind::SealedCase;
using blind::Share;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Score told_apart() {
    Score score;
    score.top_one = {11, 20};
    score.identifiable = {3, 7};
    score.top_two = {12, 16};
    score.detection = {13, 15};
    score.false_alarms = {1, 5};
    score.false_alarms_new_profile = {1, 2};
    score.wrong_claims = {2, 9};
    score.by_class = {{"pair", {1, 3}}, {"unlisted", {2, 4}}};
    score.by_effect = {{"backlash", {4, 6}}};
    score.by_size = {{"clear", {5, 8}}};
    score.by_training = {{"prbs", {6, 10}}};
    score.calibration = {{0.0, 0.5, {0, 0}, 0.0}, {0.5, 0.7, {1, 2}, 0.625}, {0.95, 1.0 + 1e-12, {3, 4}, 0.975}};
    score.confusion = {{"backlash", {{"end_stop", 1}, {"no_gap", 3}}}};
    score.shrinks = {0.5, 0.75, 0.875};
    score.of_the_oracle = {0.25, 0.5};
    score.in_the_stretch = {0.125};
    return score;
}

json counted(std::size_t hits, std::size_t all) {
    const Share share{hits, all};
    return {{"hits", hits},
            {"of", all},
            {"share", static_cast<double>(hits) / static_cast<double>(all)},
            {"interval", {share.low(), share.high()}}};
}

TEST(Score, IsWrittenWithEveryField) {
    const json file = json::parse(blind::to_json(std::vector<blind::Scored>{{"own", told_apart()}, {"guess", {}}}));
    EXPECT_EQ(file["schema"], "glsum-blind-score-1");
    ASSERT_EQ(file["scores"].size(), 2U);
    const json expected{
        {"name", "own"},
        {"top_one", counted(11, 20)},
        {"identifiable", counted(3, 7)},
        {"top_two", counted(12, 16)},
        {"detection", counted(13, 15)},
        {"false_alarms", counted(1, 5)},
        {"false_alarms_new_profile", counted(1, 2)},
        {"wrong_claims", counted(2, 9)},
        {"by_class", {{"pair", counted(1, 3)}, {"unlisted", counted(2, 4)}}},
        {"by_effect", {{"backlash", counted(4, 6)}}},
        {"by_size", {{"clear", counted(5, 8)}}},
        {"by_training", {{"prbs", counted(6, 10)}}},
        {"calibration",
         {{{"from", 0.0}, {"to", 0.5}, {"claimed", 0.0}, {"right", json::parse(R"({"hits": 0, "of": 0, "share": 0.0,
            "interval": [0.0, 1.0]})")}},
          {{"from", 0.5}, {"to", 0.7}, {"claimed", 0.625}, {"right", counted(1, 2)}},
          {{"from", 0.95}, {"to", 1.0}, {"claimed", 0.975}, {"right", counted(3, 4)}}}},
        {"confusion", {{"backlash", {{"end_stop", 1}, {"no_gap", 3}}}}},
        {"shrink", {0.5, 0.75, 0.875}},
        {"shrink_of_the_oracle", {0.25, 0.5}},
        {"located_in_the_true_stretch", {0.125}}};
    EXPECT_EQ(file["scores"][0], expected);
    EXPECT_EQ(file["scores"][1]["name"], "guess");
}

TEST(Score, IsToldToPeople) {
    Score guess;
    guess.top_one = {1, 4};
    const std::string text = blind::to_text(std::vector<blind::Scored>{{"own", told_apart()}, {"guess", guess}});
    for (const auto& [what, share] :
         {std::pair("top-1, all cases", Share{11, 20}), std::pair("top-1, the identifiable", Share{3, 7}),
          std::pair("top-2, listed effects", Share{12, 16}), std::pair("detection", Share{13, 15}),
          std::pair("false alarms", Share{1, 5}), std::pair("  on a new profile", Share{1, 2}),
          std::pair("wrong among the attributed", Share{2, 9}), std::pair("  pair", Share{1, 3}),
          std::pair("  backlash", Share{4, 6}), std::pair("  clear", Share{5, 8}), std::pair("  prbs", Share{6, 10})}) {
        EXPECT_THAT(text, HasSubstr(fmt::format("{:<32} {:>3}/{:<3} {:5.1f} %  [", what, share.hits, share.all,
                                                100.0 * share.value())));
    }
    EXPECT_THAT(text, testing::Not(HasSubstr("0.00 to 0.50")));  // nobody was so unsure
    EXPECT_THAT(text, HasSubstr("0.50 to 0.70, mean 0.625"));
    EXPECT_THAT(text, HasSubstr("0.95 to 1.00, mean 0.975"));
    EXPECT_THAT(text, HasSubstr("backlash                       3 no_gap; 1 end_stop\n"));  // the most first
    EXPECT_THAT(text, HasSubstr("shrink of the rightly named      median 0.750, a tenth below 0.500 (3 cases)"));
    EXPECT_THAT(text, HasSubstr("shrink over the oracle's         median 0.375, a tenth below 0.250 (2 cases)"));
    EXPECT_THAT(text, HasSubstr("located gap in the true stretch  median 0.125, a tenth below 0.125 (1 cases)"));
    EXPECT_THAT(
        text,
        HasSubstr("own                        55.0 %        42.9 %     86.7 %        20.0 %    50.0 %    33.3 %"));
    EXPECT_THAT(
        text,
        HasSubstr("guess                      25.0 %             -          -             -         -         -"));
    // Of twenty values the third from below: a tenth of them lies below it.
    Score twenty;
    for (int i = 0; i < 20; ++i) {
        twenty.shrinks.push_back(0.01 * i);
    }
    EXPECT_THAT(blind::to_text(std::vector<blind::Scored>{{"own", twenty}}), HasSubstr("a tenth below 0.020"));
    EXPECT_THAT(blind::to_text(std::vector<blind::Scored>{{"own", twenty}}), HasSubstr("median 0.095"));
}

// At the goal it is reached, and by the least that can be counted below it is not.
TEST(Score, ReachesItsGoalsAtTheirEdges) {
    const auto missed = [](const std::function<void(Score&)>& set) {
        Score score;
        set(score);
        return blind::missed_goals(score);
    };
    EXPECT_THAT(missed([](Score&) {}), IsEmpty());
    EXPECT_THAT(missed([](Score& s) { s.identifiable = {900, 1000}; }), IsEmpty());
    EXPECT_THAT(missed([](Score& s) {
                    s.identifiable = {899, 1000};
                }),
                ElementsAre("the identifiable named: expected at least 90 %, found 89.9 %"));
    EXPECT_THAT(missed([](Score& s) { s.by_class["unlisted"] = {800, 1000}; }), IsEmpty());
    EXPECT_THAT(missed([](Score& s) {
                    s.by_class["unlisted"] = {799, 1000};
                }),
                ElementsAre("unlisted effects called unknown: expected at least 80 %, found 79.9 %"));
    EXPECT_THAT(missed([](Score& s) { s.by_class["pair"] = {700, 1000}; }), IsEmpty());
    EXPECT_THAT(missed([](Score& s) {
                    s.by_class["pair"] = {699, 1000};
                }),
                ElementsAre("pairs named: expected at least 70 %, found 69.9 %"));
    EXPECT_THAT(missed([](Score& s) { s.false_alarms = {50, 1000}; }), IsEmpty());
    EXPECT_THAT(missed([](Score& s) {
                    s.false_alarms = {51, 1000};
                }),
                ElementsAre("false alarms: expected at most 5 %, found 5.1 %"));
    EXPECT_THAT(missed([](Score& s) { s.of_the_oracle = {0.1, 0.9, 2.0}; }), IsEmpty());
    EXPECT_THAT(missed([](Score& s) {
                    s.of_the_oracle = {0.1, 0.8, 0.98, 2.0};
                }),
                ElementsAre("shrink: expected at least 0.9 of the oracle's in the median, found 0.89"));
}

TEST(OpenScore, ReachesItsGoalsAtTheirEdges) {
    const auto missed = [](const std::function<void(OpenScore&)>& set) {
        OpenScore score;
        set(score);
        return blind::missed_goals(score);
    };
    const auto claims = [](std::size_t right_sure, std::size_t wrong_sure, std::size_t right_unsure) {
        std::vector<Claim> all(right_sure, {0.9, true});
        all.insert(all.end(), wrong_sure, {0.9, false});
        all.insert(all.end(), right_unsure, {std::nextafter(0.9, 0.0), true});
        return all;
    };
    EXPECT_THAT(missed([](OpenScore&) {}), IsEmpty());
    EXPECT_THAT(missed([](OpenScore& s) { s.singles = {800.0, 1000}; }), IsEmpty());
    EXPECT_THAT(missed([](OpenScore& s) {
                    s.singles = {799.0, 1000};
                }),
                ElementsAre("points for single causes: expected at least 80 %, found 79.9 %"));
    EXPECT_THAT(missed([](OpenScore& s) { s.wrong = {30, 1000}; }), IsEmpty());
    EXPECT_THAT(missed([](OpenScore& s) {
                    s.wrong = {31, 1000};
                }),
                ElementsAre("wrong: expected at most 3 % of all cases, found 3.1 %"));
    EXPECT_THAT(missed([](OpenScore& s) { s.unlisted = {850, 1000}; }), IsEmpty());
    EXPECT_THAT(missed([](OpenScore& s) {
                    s.unlisted = {849, 1000};
                }),
                ElementsAre("unlisted effects called unknown: expected at least 85 %, found 84.9 %"));
    EXPECT_THAT(missed([](OpenScore& s) { s.nothing = {950, 1000}; }), IsEmpty());
    EXPECT_THAT(missed([](OpenScore& s) {
                    s.nothing = {949, 1000};
                }),
                ElementsAre("no_gap where there is nothing to find: expected at least 95 %, found 94.9 %"));
    EXPECT_THAT(missed([&](OpenScore& s) { s.claims = claims(900, 100, 600); }), IsEmpty());
    EXPECT_THAT(missed([&](OpenScore& s) { s.claims = claims(899, 101, 0); }),
                ElementsAre("right of the answers at 0.9 and above: expected at least 90 %, found 89.9 %"));
    EXPECT_THAT(missed([&](OpenScore& s) { s.claims = claims(599, 0, 401); }),
                ElementsAre("of the right answers at 0.9 and above: expected at least 60 %, found 59.9 %"));
}

OpenScore open_told_apart() {
    OpenScore score;
    SealedCase truth;
    truth.name = "007";
    truth.domain = "thermal";
    truth.kind = "pair";
    truth.effects = {"backlash", "end_stop"};
    Answer answer;
    answer.verdict = "attributed";
    answer.effects = {"backlash"};
    answer.confidence = 0.625;
    score.cases = {{truth, answer, {0.5, true}}};
    score.singles = {5.5, 11};
    score.pairs = {1.5, 4};
    score.wrong = {2, 21};
    score.unlisted = {3, 5};
    score.nothing = {4, 6};
    score.by_effect = {{"backlash", {2.0, 3}}};
    score.by_domain = {{"thermal", {3.0, 7}}};
    score.by_size = {{"large", {4.0, 9}}};
    score.ambiguous_without = {1, 8};
    score.claims = {{0.95, true}, {0.925, false}, {0.625, true}};
    score.confusion = {{"pair: backlash+end_stop", {{"backlash", 2}, {"unknown", 1}}}};
    return score;
}

TEST(OpenScore, IsWrittenWithEveryField) {
    const json file = json::parse(blind::to_json(open_told_apart()));
    const auto earned = [](double points, int all) {
        return json{{"points", points}, {"of", all}, {"share", points / all}};
    };
    const double brier = (0.05 * 0.05 + 0.925 * 0.925 + 0.375 * 0.375) / 3.0;
    EXPECT_NEAR(file["brier_score"].get<double>(), brier, 1e-12);
    EXPECT_EQ(file["calibration"].size(), 6U);
    EXPECT_EQ(file["calibration"][1]["from"], 0.5);
    EXPECT_EQ(file["calibration"][1]["to"], 0.7);
    EXPECT_EQ(file["calibration"][1]["claimed"], 0.625);
    EXPECT_EQ(file["calibration"][1]["right"], counted(1, 1));
    EXPECT_EQ(file["calibration"][5]["to"], 1.0);
    json rest = file;
    rest.erase("brier_score");
    rest.erase("calibration");
    const json expected{{"schema", "glsum-open-score-1"},
                        {"single_points", earned(5.5, 11)},
                        {"pair_points", earned(1.5, 4)},
                        {"wrong", counted(2, 21)},
                        {"unlisted_unknown", counted(3, 5)},
                        {"nothing_no_gap", counted(4, 6)},
                        {"right_of_the_sure", counted(1, 2)},
                        {"sure_of_the_right", counted(1, 2)},
                        {"ambiguous_without_the_truth", counted(1, 8)},
                        {"by_domain", {{"thermal", earned(3.0, 7)}}},
                        {"by_effect", {{"backlash", earned(2.0, 3)}}},
                        {"by_size", {{"large", earned(4.0, 9)}}},
                        {"confusion", {{"pair: backlash+end_stop", {{"backlash", 2}, {"unknown", 1}}}}},
                        {"cases",
                         {{{"case", "007"},
                           {"domain", "thermal"},
                           {"class", "pair"},
                           {"truth", {"backlash", "end_stop"}},
                           {"verdict", "attributed"},
                           {"named", {"backlash"}},
                           {"confidence", 0.625},
                           {"points", 0.5},
                           {"wrong", true}}}}};
    EXPECT_EQ(rest, expected);
}

TEST(OpenScore, IsToldToPeople) {
    const std::string text = blind::to_text(open_told_apart());
    const auto line = [](const char* what, const std::string& value) {
        return HasSubstr(fmt::format("{:<46} {}", what, value));
    };
    EXPECT_THAT(text, line("single causes, points (>= 80 %)", " 50.0 %  5.50 of 11\n"));
    EXPECT_THAT(text, line("pairs, points", " 37.5 %  1.50 of 4\n"));
    EXPECT_THAT(text, line("wrong, of all cases (<= 3 %)", "  9.5 %    2 of 21  ["));
    EXPECT_THAT(text, line("unlisted effects called unknown (>= 85 %)", " 60.0 %    3 of 5   ["));
    EXPECT_THAT(text, line("nothing to find or taken up: no_gap (>= 95 %)", " 66.7 %    4 of 6   ["));
    EXPECT_THAT(text, line("answers at 0.9 and above, right (>= 90 %)", " 50.0 %    1 of 2   ["));
    EXPECT_THAT(text, line("right answers, at 0.9 and above (>= 60 %)", " 50.0 %    1 of 2   ["));
    EXPECT_THAT(text, line("Brier score of the attributed", "0.333    3 answers\n"));
    EXPECT_THAT(text, line("ambiguous without the truth, of the ambiguous", " 12.5 %    1 of 8   ["));
    EXPECT_THAT(text, line("  backlash", " 66.7 %  2.00 of 3\n"));
    EXPECT_THAT(text, line("  thermal", " 42.9 %  3.00 of 7\n"));
    EXPECT_THAT(text, line("  large", " 44.4 %  4.00 of 9\n"));
    EXPECT_THAT(text, line("  0.50 to 0.70, mean 0.625", "100.0 %    1 of 1   ["));
    EXPECT_THAT(text, line("  0.90 to 0.95, mean 0.925", "  0.0 %    0 of 1   ["));
    EXPECT_THAT(text, line("  0.95 to 1.00, mean 0.950", "100.0 %    1 of 1   ["));
    EXPECT_THAT(text, testing::Not(HasSubstr("0.00 to 0.50")));  // nobody was so unsure
    EXPECT_THAT(text, HasSubstr("  pair: backlash+end_stop                      2 backlash; 1 unknown\n"));
    // Wilson's interval of 1 of 8, in per cent.
    EXPECT_THAT(text,
                HasSubstr(fmt::format("[{:4.1f}, {:5.1f}]", 100.0 * Share{1, 8}.low(), 100.0 * Share{1, 8}.high())));
    EXPECT_THAT(blind::to_text(OpenScore{}), line("single causes, points (>= 80 %)", "none to count"));
    EXPECT_THAT(blind::to_text(OpenScore{}), line("Brier score of the attributed", "none to count"));
}

// Each confidence has one bin, which it opens or lies in; 1 is in the last.
TEST(Calibration, HasSixBins) {
    std::vector<Claim> claims;
    for (const double confidence : {0.0, 0.499, 0.5, 0.699, 0.7, 0.799, 0.8, 0.899, 0.9, 0.9499, 0.95, 1.0}) {
        claims.push_back({confidence, confidence > 0.4999 && confidence < 0.7});
    }
    const auto bins = blind::calibrate(claims);
    const double from[] = {0.0, 0.5, 0.7, 0.8, 0.9, 0.95};
    ASSERT_EQ(bins.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(bins[i].from, from[i]);
        EXPECT_EQ(bins[i].right.all, 2U) << i;
        EXPECT_EQ(bins[i].right.hits, i == 1 ? 2U : 0U);
        EXPECT_NEAR(bins[i].claimed, 0.5 * (claims[2 * i].confidence + claims[2 * i + 1].confidence), 1e-12);
    }
    const Share none;
    EXPECT_EQ(none.value(), 0.0);
    EXPECT_EQ(none.low(), 0.0);
    EXPECT_EQ(none.high(), 1.0);
}

// The picture's rows are the bins: claimed, right, and the ends of the interval.
TEST(Calibration, IsDrawnByItsBins) {
    const auto picture = blind::picture_of_calibration(std::vector<Claim>{{0.6, true}, {0.65, false}});
    const Share half{1, 2};
    EXPECT_THAT(picture.script,
                HasSubstr(fmt::format("0.625 0.5 {:.6g} {:.6g} \"1 of 2\"\nEOD", half.low(), half.high())));
    EXPECT_THAT(picture.script, HasSubstr("None of 2 answers has a confidence of 0.9 or more"));
    EXPECT_THAT(blind::picture_of_calibration({}).script, HasSubstr("-1 -1 -1 -1 \"\"\nEOD"));
}

// What is located beyond its cells, or nowhere, counts for nothing; where ranks decide, two places do, and of a pair
// four.
TEST(Score, LooksAtAsManyPlacesAsItSays) {
    SealedCase single;
    single.kind = "single";
    single.effects = {"backlash"};
    SealedCase pair;
    pair.kind = "pair";
    pair.effects = {"backlash", "end_stop"};
    const auto near = [](const SealedCase& truth, std::vector<std::string> ranking, const char* verdict = "unknown") {
        Answer answer;
        answer.verdict = verdict;
        answer.ranking = std::move(ranking);
        return blind::score(std::vector{truth}, std::vector{answer}).top_two.hits;
    };
    EXPECT_EQ(near(single, {"a", "backlash"}), 1U);
    EXPECT_EQ(near(single, {"a", "b", "backlash"}), 0U);
    EXPECT_EQ(near(single, {"backlash"}), 1U);
    EXPECT_EQ(near(single, {"backlash"}, "no_gap"), 0U);
    EXPECT_EQ(near(pair, {"a", "backlash", "b", "end_stop"}), 1U);
    EXPECT_EQ(near(pair, {"a", "backlash", "b", "c", "end_stop"}), 0U);
    EXPECT_EQ(near(pair, {"backlash"}), 0U);
}

TEST(Score, CountsAGapThatShrinksOnlyWhereThereIsRoom) {
    SealedCase truth;
    truth.kind = "single";
    truth.effects = {"backlash"};
    truth.gap_base = 0.2;
    truth.noise_floor = 0.2;
    Answer answer;
    answer.verdict = "attributed";
    answer.effects = {"backlash"};
    answer.gap_after = 0.1;
    const auto shrinks = [&] { return blind::score(std::vector{truth}, std::vector{answer}).shrinks; };
    EXPECT_THAT(shrinks(), IsEmpty());
    truth.noise_floor = 0.1;
    EXPECT_THAT(shrinks(), ElementsAre(testing::DoubleNear(1.0, 1e-12)));
    const auto of_the_oracle = [&](double base, double after) {
        const std::vector<std::optional<blind::Oracle>> oracle{blind::Oracle{true, base, after}};
        return blind::score(std::vector{truth}, std::vector{answer}, oracle).of_the_oracle;
    };
    EXPECT_THAT(of_the_oracle(0.3, 0.3), IsEmpty());
    EXPECT_THAT(of_the_oracle(0.3, 0.2), ElementsAre(testing::DoubleNear(2.0, 1e-12)));
    answer.gap_after.reset();
    EXPECT_THAT(of_the_oracle(0.3, 0.2), ElementsAre(0.0));
    // Where it lies: shares of cells that reach beyond the true stretch, or have no width.
    truth.where = {{2.0, 4.0}};
    answer.where = {{1.0, 3.0, 0.5}, {3.0, 3.0, 0.25}, {5.0, 6.0, 0.25}};
    EXPECT_THAT(blind::score(std::vector{truth}, std::vector{answer}).in_the_stretch,
                ElementsAre(testing::DoubleNear(0.25, 1e-12)));
    answer.where = {{1.0, 3.0, 0.0}};
    EXPECT_THAT(blind::score(std::vector{truth}, std::vector{answer}).in_the_stretch, IsEmpty());
    const std::vector<std::optional<blind::Oracle>> too_many(2);
    EXPECT_THROW((void)blind::score(std::vector{truth}, std::vector{answer}, too_many), glsum::Failure);
}

TEST(SealedTruth, IsReadWhole) {
    const std::string text = R"({"schema": "glsum-blind-truth-1", "seed": 1, "cases": [
        {"case": "004", "class": "same", "effects": [{"effect": "input_curve", "size": "large"}], "new_profile": true,
         "required": ["gain_error", "input_curve"], "allowed": ["gain_error", "input_curve", "supply_sag"],
         "train": "step", "validate": "on_off", "gap": {"base": 0.25, "noise_floor": 0.125},
         "where": {"time": [{"from_s": 1.5, "to_s": 2.5}, {"from_s": 3, "to_s": 4, "share": 0.5}]}},
        {"case": "005", "class": "none", "effects": [], "train": "ramp", "validate": "prbs",
         "gap": {"base": 0.1, "noise_floor": 0.1}}]})";
    const auto read = blind::parse_sealed(text, "t.json");
    ASSERT_EQ(read.size(), 2U);
    const SealedCase& same = read[0];
    EXPECT_EQ(same.name, "004");
    EXPECT_EQ(same.kind, "same");
    EXPECT_FALSE(same.fitted_base);
    EXPECT_EQ(same.size, "large");
    EXPECT_TRUE(same.new_profile);
    EXPECT_EQ(same.required, (std::vector<std::string>{"gain_error", "input_curve"}));
    EXPECT_EQ(same.allowed, (std::vector<std::string>{"gain_error", "input_curve", "supply_sag"}));
    EXPECT_EQ(same.train, "step");
    EXPECT_EQ(same.validate, "on_off");
    EXPECT_EQ(same.gap_base, 0.25);
    EXPECT_EQ(same.noise_floor, 0.125);
    ASSERT_EQ(same.where.size(), 2U);
    EXPECT_EQ(same.where[0].from_s, 1.5);
    EXPECT_EQ(same.where[0].to_s, 2.5);
    EXPECT_EQ(same.where[0].share, 0.0);
    EXPECT_EQ(same.where[1].share, 0.5);
    EXPECT_FALSE(read[1].new_profile);
    const auto refusal = [&](const std::string& from, const std::string& to) {
        std::string changed = text;
        changed.replace(changed.find(from), from.size(), to);
        try {
            (void)blind::parse_sealed(changed, "t.json");
        } catch (const glsum::Failure& failure) {
            return std::string(failure.what());
        }
        return std::string("accepted");
    };
    EXPECT_THAT(refusal("\"effects\": []", "\"effects\": [{\"effect\": \"backlash\"}]"),
                HasSubstr("t.json: case 005: effects: expected 0 for the class none, found 1"));
    EXPECT_THAT(refusal("\"class\": \"none\"", "\"class\": \"pair\""),
                HasSubstr("expected 2 for the class pair, found 0"));
    EXPECT_THAT(refusal("\"class\": \"none\"", "\"class\": \"single\""),
                HasSubstr("expected 1 for the class single, found 0"));
    EXPECT_THAT(refusal("\"effects\": []", "\"effects\": 3"), HasSubstr("effects: expected a list, found 3"));
    EXPECT_THAT(refusal("\"base\": 0.25", "\"base\": \"x\""), HasSubstr("base: expected a number, found \"x\""));
    EXPECT_THAT(refusal("\"train\": \"ramp\"", "\"train\": 7"), HasSubstr("train: expected a text, found 7"));
    EXPECT_THAT(refusal("{\"schema\"", std::string(20, '[') + "{\"schema\""),
                HasSubstr("t.json: expected a JSON object"));
    // Sixteen deep is read, seventeen is not.
    const auto nested = [&](std::size_t deep) {
        return refusal("\"seed\": 1", "\"seed\": " + std::string(deep, '[') + std::string(deep, ']'));
    };
    EXPECT_EQ(nested(15), "accepted");
    EXPECT_THAT(nested(17), HasSubstr("nested 17 deep"));
}

}  // namespace
