// The answer to a question about a derivative: errors in per cent, where they are, what was certified and measured, and
// what would do in its place. And how numbers are told in any answer.
#include "bench/choose/report.hpp"

#include <gtest/gtest.h>

#include <string>

namespace {

using choose::Answer;
using choose::Candidate;
using choose::Standing;
using glsum::design::Band;
using glsum::design::DerivativeGoal;

Candidate candidate(const char* kernel, std::size_t taps, double error, double cost, double high, double bytes) {
    return {kernel, taps, {error, "7.5 Hz", ""}, {cost, high, 0.25, bytes, ""}};
}

Answer asked() {
    Answer answer;
    answer.question.conditions.order = 1.7;
    answer.question.conditions.step_s = 1e-3;
    answer.question.goal = DerivativeGoal{.order = 1.7, .step_s = 1e-3, .band = Band{0.5, 80.0}, .step_until_s = 60.0};
    answer.question.max_error = 0.05;
    answer.question.core = "a-core";
    answer.unit = "model cycles";
    answer.limited_unit = "model cycles, upper end of the band";
    return answer;
}

void expect_has(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
}

TEST(GoalTable, TellsErrorsInPerCentAndWhereTheyAre) {
    Answer answer = asked();
    answer.choice.chosen = candidate("modes_plain_f32", 13, 0.045, 53.0, 57.5, 92.0);
    answer.derivative = {{31.5, {}, {}, {}}, {0.045, 7.5, 0.03, 1.0}, {0.0432, 8.0, 0.0219, 2.0}};
    const std::string text = to_table(answer, false);
    EXPECT_TRUE(
        text.starts_with("derivative of order 1.7, h = 0.001 s, within 5 %, from 0.5 to 80 Hz, a step from "
                         "0.01 s until 60 s\n"))
        << text;
    // Fitted modes are counted as those of half an order: one near tap.
    expect_has(
        text,
        "\nchoice     modes_plain_f32 with 1+6 taps: error 4.5 % (7.5 Hz), 53 model cycles, at most 57.5, 92 "
        "bytes\n"
        "certified  within 4.5 % from 0.5 to 80 Hz (worst at 7.5 Hz), 3 % of a step's response until 60 s (worst "
        "at 1 s)\n"
        "measured   4.32 % from 0.5 to 80 Hz (worst at 8 Hz), 2.19 % of a step's response until 60 s (worst at 2 "
        "s)\n"
        "factor     derivative = 31.5 S_k\n");
}

TEST(GoalTable, SaysWhatWouldDoInstead) {
    Answer answer = asked();
    const Candidate near = candidate("modes_plain_f32", 13, 0.0625, 53.0, 57.5, 92.0);
    answer.choice.relaxed = {{"max_error", 0.05, 0.0625, near}};
    DerivativeGoal half = *answer.question.goal;
    half.band->high_hz = 40.0;
    answer.would_do = {{"--band 0.5..40", half, candidate("ring_plain_f32", 50, 0.04, 400.0, 400.0, 408.0)}};
    const std::string text = to_table(answer, false);
    expect_has(
        text,
        "\nnothing fits; nearest miss: modes_plain_f32 with 1+6 taps misses --derivative-error by 25 %, with "
        "--derivative-error 6.25% it fits\n"
        "  --derivative-error 6.25% instead of 5 % (times 1.25): modes_plain_f32 with 1+6 taps, error 6.25 %, 53 "
        "model cycles, at most 57.5, 92 bytes\n"
        "  --band 0.5..40: ring_plain_f32 with 50 taps, error 4 %, 400 model cycles, 408 bytes\n");
}

TEST(GoalJson, HasTheGoalAndWhatWasCertified) {
    Answer answer = asked();
    answer.choice.chosen = candidate("modes_plain_f32", 13, 0.045, 53.0, 57.5, 92.0);
    answer.derivative = {{31.5, {}, {}, {}}, {0.045, 7.5, 0.03, 1.0}, {0.0432, 8.0, 0.0219, 2.0}};
    const bench::Json json = to_json(answer);
    EXPECT_EQ(json.at("question"),
              bench::Json::parse(R"({"order": 1.7, "step_s": 0.001, "target": "m7", "core": "a-core",
                                     "derivative_error": 0.05, "band_hz": [0.5, 80.0], "step_until_s": 60.0})"));
    EXPECT_EQ(json.at("choice"),
              bench::Json::parse(R"({"kernel": "modes_plain_f32", "taps": 13, "near_taps": 1, "modes": 6,
                                     "derivative_error": 0.045, "worst_at": "7.5 Hz", "model_cycles_per_sample": 53.0,
                                     "model_cycles_high": 57.5, "bytes": 92.0})"));
    EXPECT_EQ(json.at("certified"),
              bench::Json::parse(R"({"band_error": 0.045, "worst_hz": 7.5, "step_error": 0.03, "worst_s": 1.0})"));
    EXPECT_EQ(json.at("measured"),
              bench::Json::parse(R"({"band_error": 0.0432, "worst_hz": 8.0, "step_error": 0.0219, "worst_s": 2.0})"));
    EXPECT_EQ(json.at("factor"), 31.5);
    EXPECT_FALSE(json.contains("nearest_misses") || json.contains("would_do") || json.contains("real_time"));
}

TEST(GoalJson, HasWhatWouldDoInstead) {
    Answer answer = asked();
    answer.choice.relaxed = {{"max_error", 0.05, 0.0625, candidate("ring_plain_f32", 50, 0.0625, 53.0, 57.5, 92.0)}};
    DerivativeGoal half = *answer.question.goal;
    half.step_s = 5e-4;
    half.step_until_s.reset();
    answer.would_do = {{"--step-s 0.0005", half, candidate("ring_plain_f32", 50, 0.04, 400.0, 420.0, 408.0)}};
    const bench::Json json = to_json(answer);
    EXPECT_EQ(json.at("nearest_misses")[0].at("limit"), "derivative-error");
    EXPECT_EQ(json.at("nearest_misses")[0].at("fits").at("derivative_error"), 0.0625);
    EXPECT_EQ(json.at("would_do"), bench::Json::parse(R"([{"instead": "--step-s 0.0005",
                  "fits": {"kernel": "ring_plain_f32", "taps": 50, "derivative_error": 0.04, "worst_at": "7.5 Hz",
                           "model_cycles_per_sample": 400.0, "model_cycles_high": 420.0, "bytes": 408.0},
                  "step_s": 0.0005, "band_hz": [0.5, 80.0]}])"));
}

// The layout of 32 coefficients of order 0.5 over 5000 samples: 11 near taps, 21 blocks, two of each size.
TEST(ChoiceJson, CountsBlocksBesideNearTaps) {
    Answer answer = asked();
    answer.question.goal.reset();
    answer.question.conditions.order = 0.5;
    answer.question.conditions.samples = 5000;
    answer.choice.chosen = candidate("nested_plain_f32", 32, 0.01, 400.0, 420.0, 408.0);
    const bench::Json choice = to_json(answer).at("choice");
    EXPECT_EQ(choice.at("near_taps"), 11);
    EXPECT_EQ(choice.at("blocks"), 21);
    EXPECT_EQ(choice.at("blocks_per_level"), 2);
    EXPECT_FALSE(choice.contains("modes"));
}

// Of kernels that are too inaccurate the one that comes nearest is first.
TEST(ChoiceTable, TheNearestOfThoseThatAreTooInaccurateIsFirst) {
    Answer answer = asked();
    answer.choice.kernels = {
        {"ring_oldest_f32", Standing::inaccurate, {}, candidate("ring_oldest_f32", 70, 0.75, 0.0, 0.0, 0.0), {}, ""},
        {"ring_plain_f32", Standing::inaccurate, {}, candidate("ring_plain_f32", 70, 0.5, 0.0, 0.0, 0.0), {}, ""},
        {"ring_horner_f32", Standing::inaccurate, {}, candidate("ring_horner_f32", 70, 0.25, 0.0, 0.0, 0.0), {}, ""},
    };
    const std::string text = to_table(answer, false);
    EXPECT_LT(text.find("\n  ring_horner_f32"), text.find("\n  ring_plain_f32")) << text;
    EXPECT_LT(text.find("\n  ring_plain_f32"), text.find("\n  ring_oldest_f32")) << text;
}

// Clocks in the largest unit that they have one of, counts without a fraction that is below a twentieth.
TEST(ChoiceTable, NumbersAreToldInTheirUnits) {
    Answer answer = asked();
    answer.question.target = choose::Target::m4;
    answer.unit = "instructions";
    answer.question.rate_hz = 100.0;
    const auto share = [&](double hz, double cost) {
        answer.question.clock_hz = hz;
        return choose::budget_share(answer, candidate("ring_plain_f32", 50, 0.01, cost, cost, 408.0));
    };
    expect_has(share(1e6, 400.0),
               "1 MHz at 100 samples a second leave 10000 cycles a sample; a core that issues one "
               "instruction a cycle needs at least 400 of them for 400 instructions: at least 4 %");
    expect_has(share(999e3, 400.0), "999 kHz at 100 samples a second leave 9990 cycles");
    expect_has(share(1e3, 400.0), "1 kHz at 100 samples");
    expect_has(share(999.0, 400.0), "999 Hz at 100 samples a second leave 10 cycles");
    const auto cost = [&](double value) {
        return choose::cost_text(answer, candidate("ring_plain_f32", 50, 0.01, value, value, 408.0));
    };
    EXPECT_EQ(cost(400.0499), "400 instructions");
    EXPECT_EQ(cost(400.0503), "400.1 instructions");
    EXPECT_EQ(cost(399.9503), "400 instructions");
    EXPECT_EQ(cost(399.9497), "399.9 instructions");
}

}  // namespace
