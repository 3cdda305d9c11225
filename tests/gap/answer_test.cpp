// What files and pages are told of an answer, from one that is made by hand: which number stands where.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "drive/model_file.hpp"
#include "gap/drive/start.hpp"
#include "gap/drive/verdict.hpp"
#include "gap/exam/ask.hpp"
#include "gap/exam/score.hpp"

namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

gap::FreeParameter number(const std::string& name, double value, double low, double high) {
    return {name, value, -1e9, 1e9, 1.0, false, 0.1, false, low, high};
}

gap::Record record(const std::string& name) {
    gap::Record made;
    made.name = name;
    made.time_s = {0.0, 1.0, 2.0};
    made.input = {0.0, 1.0, 1.0};
    made.output = {0.5, 0.75, 1.0};
    made.usual_interval_s = 1.0;
    return made;
}

class OfAnAnswer : public testing::Test {
protected:
    OfAnAnswer() {
        answer_.form = gap::form_of(drive::make_fopdt(2.0, 3.0, 0.5));
        answer_.refit = true;
        answer_.base_name = "first_order";
        answer_.metric = "simulation";
        answer_.records = {record("a.csv"), record("b.csv")};
        answer_.linear_share = 0.9;
        answer_.next_experiment = "rest";
        rank({}, 0.5);
        rank({"gain_error"}, 0.2);
        rank({"gain_error", "load_disturbance"}, 0.1);
        answer_.decision.outcome = gap::Outcome::attributed;
        answer_.decision.effects = {2};
        answer_.decision.chosen = 2;
        answer_.decision.base_gap = 0.5;
        answer_.decision.noise_floor = 0.1;
        answer_.decision.confidence = 0.875;
    }

    void rank(const std::vector<std::string>& effects, double gap_after) {
        gap::Ranked ranked;
        ranked.trained.base = {number("gain", 2.123456, 2.0, 2.25), number("time_constant_s", 3.5, 3.75, 3.25),
                               number("delay_s", 0.5, 0.5, 0.5)};
        ranked.trained.base[2].fixed = true;
        ranked.trained.base[2].deviation = 0.0;
        for (const std::string& name : effects) {
            const gap::Effect& effect = gap::effect_named(name);
            ranked.trained.effects.push_back(&effect);
            if (effect.kind == gap::Kind::lasting) {
                ranked.trained.lasting.push_back({number("gain_error.gain", 1.5, 1.25, 1.75)});
            }
        }
        ranked.candidate = ranked.trained;
        for (const double offset : {0.125, 0.25}) {
            ranked.candidate.own.push_back({number("offset", offset, 0.0, 1.0)});
            if (ranked.trained.has_events()) {
                ranked.candidate.own.back().push_back(number("load_disturbance.from_s", 1.0 + offset, 1.0, 2.0));
                ranked.candidate.own.back().push_back(number("load_disturbance.to_s", 3.0, 2.5, 3.5));
                ranked.candidate.own.back().push_back(number("load_disturbance.size", 4.0, 3.0, 5.0));
            }
        }
        ranked.trained.own = ranked.candidate.own;
        ranked.gap_after = gap_after;
        ranked.log_likelihood = 10.0 * static_cast<double>(effects.size());
        ranked.penalty = 3.0;
        ranked.residuals = {{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}};
        answer_.ranking.push_back(ranked);
    }

    json file() const { return json::parse(gap::to_json(answer_)); }

    gap::Answer answer_{};
};

// The base's numbers are those beside what was found, with their intervals about them.
TEST_F(OfAnAnswer, TheBaseHasItsNumbers) {
    const json base = file().at("base");
    EXPECT_EQ(base.at("form"), "first_order");
    EXPECT_EQ(base.at("linear_share"), 0.9);
    EXPECT_EQ(base.at("parameters"), (json{{"gain", 2.123456}, {"time_constant_s", 3.5}, {"delay_s", 0.5}}));
    EXPECT_EQ(base.at("interval").at("gain"), (json{2.0, 2.25}));
    // An interval holds its number, wherever it was found.
    EXPECT_EQ(base.at("interval").at("time_constant_s"), (json{3.5, 3.5}));
    EXPECT_EQ(base.at("interval").at("delay_s"), (json{0.5, 0.5}));
    EXPECT_THAT(base.at("model").get<std::string>(), HasSubstr("2.123456"));
    EXPECT_THAT(gap::to_text(answer_), HasSubstr("2.123 / (3.5 s + 1) exp(-0.5 s)"));
}

// What was not moved, and what nothing was told of, has no interval but itself.
TEST_F(OfAnAnswer, WhatStaysHasNoInterval) {
    gap::FreeParameter& constant = answer_.ranking[2].trained.base[1];
    constant.fixed = true;
    constant.deviation = 0.0;
    constant.low = 0.0;
    constant.high = 9.0;
    EXPECT_EQ(file()["base"]["interval"]["time_constant_s"], (json{3.5, 3.5}));
    constant.deviation = 0.25;
    EXPECT_EQ(file()["base"]["interval"]["time_constant_s"], (json{0.0, 9.0}));
}

// Each record that was judged has its own, as far as it has any.
TEST_F(OfAnAnswer, EachRecordHasItsNumbers) {
    const auto records = [&] { return file()["base"].value("records", json::array()); };
    ASSERT_EQ(records().size(), 2U);
    EXPECT_EQ(records()[0]["record"], "a.csv");
    EXPECT_EQ(records()[0]["numbers"]["offset"], 0.125);
    EXPECT_EQ(records()[0]["numbers"]["load_disturbance.size"], 4.0);
    EXPECT_EQ(records()[1]["record"], "b.csv");
    EXPECT_EQ(records()[1]["numbers"]["offset"], 0.25);
    answer_.decision.effects = {1};
    answer_.decision.chosen = 1;
    answer_.ranking[1].candidate.own.resize(1);
    EXPECT_EQ(records().size(), 1U);
    answer_.ranking[1].candidate.own.resize(3, {number("offset", 1.0, 1.0, 1.0)});
    EXPECT_EQ(records().size(), 2U);  // there is no third record
    answer_.ranking[1].candidate.own[0].clear();
    EXPECT_THAT(records(), IsEmpty());
}

// A cause's numbers are those that were trained; an event's those of the first record judged.
TEST_F(OfAnAnswer, CausesHaveTheirNumbersAndWhatTheyTake) {
    const json effects = file().at("effects");
    ASSERT_EQ(effects.size(), 2U);
    EXPECT_EQ(effects[0]["parameters"], (json{{"gain", 1.5}}));
    EXPECT_EQ(effects[0]["interval"]["gain"], (json{1.25, 1.75}));
    EXPECT_EQ(effects[1]["parameters"]["from_s"], 1.125);
    EXPECT_EQ(effects[1]["interval"]["size"], (json{3.0, 5.0}));
    for (const json& one : effects) {
        EXPECT_EQ(one["gap_before"], 0.5);
        EXPECT_EQ(one["gap_after"], 0.1);
        EXPECT_EQ(one["confidence"], 0.875);
        EXPECT_EQ(one["shrink"], 1.0);
    }
    // Without the event the gain error alone was tried, and not the other way round.
    EXPECT_FALSE(effects[0].contains("gap_without"));
    EXPECT_EQ(effects[1]["gap_without"], 0.2);
    // Of what can be closed, from the base down to the noise; never more than all, or as much worse.
    const auto shrink = [&](double after) {
        answer_.ranking[2].gap_after = after;
        return file()["effects"][0]["shrink"].get<double>();
    };
    EXPECT_DOUBLE_EQ(shrink(0.2), 0.75);
    EXPECT_DOUBLE_EQ(shrink(0.05), 1.0);
    EXPECT_DOUBLE_EQ(shrink(0.6), -0.25);
    EXPECT_DOUBLE_EQ(shrink(1.0), -1.0);
    answer_.decision.noise_floor = 0.5;
    EXPECT_DOUBLE_EQ(shrink(0.2), 0.0);
}

TEST_F(OfAnAnswer, TheRankingHasScores) {
    const json ranking = file().at("ranking");
    ASSERT_EQ(ranking.size(), 3U);
    EXPECT_EQ(ranking[1]["effect"], "gain_error");
    EXPECT_EQ(ranking[1]["gap_after"], 0.2);
    EXPECT_EQ(ranking[1]["score"], 7.0);
    EXPECT_EQ(file()["gap"], (json{{"metric", "simulation"}, {"base", 0.5}, {"after", 0.1}, {"noise_floor", 0.1}}));
}

// Of the base's squared gap so much stays: all at most, and nothing of none.
TEST_F(OfAnAnswer, ASuspectLeavesItsShareOfTheSquaredGap) {
    answer_.decision.outcome = gap::Outcome::unknown;
    answer_.decision.effects.clear();
    answer_.decision.suspect = 1;
    const auto unexplained = [&] { return file()["suspect"]["unexplained"].get<double>(); };
    EXPECT_DOUBLE_EQ(unexplained(), 0.04 / 0.25);
    EXPECT_EQ(file()["suspect"]["gap_after"], 0.2);
    EXPECT_EQ(file()["suspect"]["effects"][0]["parameters"]["gain"], 1.5);
    answer_.ranking[1].gap_after = 0.7;
    EXPECT_EQ(unexplained(), 1.0);
    answer_.decision.base_gap = 0.0;
    EXPECT_EQ(unexplained(), 0.0);
}

// The page draws the base beside what was chosen; where nothing was, the base alone.
TEST_F(OfAnAnswer, ThePageDrawsWhatWasChosen) {
    const std::string with = gap::to_html(answer_);
    EXPECT_THAT(with, HasSubstr("a.csv"));
    EXPECT_THAT(with, HasSubstr("b.csv"));
    answer_.decision.effects.clear();
    answer_.decision.outcome = gap::Outcome::no_gap;
    answer_.decision.chosen = 0;
    const std::string without = gap::to_html(answer_);
    const auto curves = [](const std::string& page) {
        std::size_t count = 0;
        for (std::size_t at = 0; (at = page.find("<polyline", at)) != std::string::npos; ++at) {
            ++count;
        }
        return count;
    };
    EXPECT_GT(curves(with), curves(without));
}

// A model that `simulate` runs: what lasts goes with it, events are named and left out.
TEST_F(OfAnAnswer, TheImprovedModelHasWhatLasts) {
    json model = json::parse(gap::improved_model(answer_));
    EXPECT_EQ(model["effects"], json::parse(R"([{"effect": "gain_error", "parameters": {"gain": 1.5}}])"));
    EXPECT_EQ(model["left_out"], (json{"load_disturbance"}));
    EXPECT_EQ(model["operating_output"], 0.125);
    EXPECT_EQ(drive::parse_model(model.dump(), "m").gain, 2.123456);
    EXPECT_THAT(gap::events_of(answer_), ElementsAre("load_disturbance"));
    answer_.decision.chosen = 1;
    model = json::parse(gap::improved_model(answer_));
    EXPECT_FALSE(model.contains("left_out"));
    answer_.refit = false;
    model = json::parse(gap::improved_model(answer_));
    EXPECT_FALSE(model.contains("operating_output"));
    EXPECT_EQ(drive::parse_model(model.dump(), "m").gain, 2.0);  // the given one's, whatever was fitted
}

// What is written as JSON can be read by people, too: two columns a level, and a line that ends.
TEST_F(OfAnAnswer, ItsFilesAreIndentedByTwo) {
    gap::exam::Asked asked;
    asked.name = "rig";
    for (const std::string& text : {gap::to_json(answer_), gap::improved_model(answer_),
                                    gap::exam::to_answer(asked, answer_), gap::exam::to_json({})}) {
        EXPECT_EQ(text, nlohmann::ordered_json::parse(text).dump(2) + "\n");
    }
}

TEST(LinearShare, IsOfTheVariance) {
    EXPECT_DOUBLE_EQ(gap::linear_share_of(0.5), 0.75);
    EXPECT_EQ(gap::linear_share_of(0.0), 1.0);
    EXPECT_EQ(gap::linear_share_of(1.5), 0.0);
}

}  // namespace
