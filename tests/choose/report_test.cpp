// The answer as JSON holds what was asked, what was chosen and what each kernel came to: read back field by field.
#include "bench/choose/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace {

using choose::Answer;
using choose::Candidate;
using choose::Standing;

Candidate candidate(const char* kernel, std::size_t taps, double error, double cost, double high, double bytes) {
    return {kernel, taps, {error, "sine5", ""}, {cost, high, 0.25, bytes, ""}};
}

Answer asked() {
    Answer answer;
    answer.question.conditions.order = 0.5;
    answer.question.conditions.step_s = 2e-3;
    answer.question.conditions.samples = 700;
    answer.question.conditions.signals = {"step", "sine5"};
    answer.question.core = "a-core";
    answer.question.max_error = 0.125;
    answer.question.max_cycles = 5000.0;
    answer.question.max_instructions = 6000.0;
    answer.question.max_bytes = 7000.0;
    answer.question.clock_hz = 216e6;
    answer.question.rate_hz = 1000.0;
    answer.unit = "model cycles";
    answer.limited_unit = "model cycles, upper end of the band";
    answer.notes = {"of this run"};
    answer.context = {{"commit", "c0ffee"}};
    return answer;
}

TEST(ChoiceJson, HoldsTheQuestionTheChoiceAndEveryKernel) {
    Answer answer = asked();
    const Candidate first = candidate("ring_plain_f32", 50, 0.01, 400.0, 420.0, 408.0);
    const Candidate second = candidate("shift_plain_f32", 40, 0.02, 500.0, 540.0, 320.0);
    answer.choice.chosen = first;
    answer.choice.runner_up = second;
    answer.choice.tie = true;
    answer.choice.kernels = {{"ring_plain_f32", Standing::chosen, first, {}, {}, ""},
                             {"shift_plain_f32", Standing::runner_up, second, {}, {}, ""}};
    EXPECT_EQ(to_json(answer), bench::Json::parse(R"({
        "schema": "glsum-choice-1",
        "fits": true,
        "question": {"order": 0.5, "step_s": 0.002, "target": "m7", "core": "a-core", "signals": ["step", "sine5"],
                     "max_error": 0.125, "max_cycles": 5000.0, "max_instructions": 6000.0, "max_bytes": 7000.0,
                     "clock_hz": 216000000.0, "rate_hz": 1000.0},
        "choice": {"kernel": "ring_plain_f32", "taps": 50, "error_max": 0.01, "worst_signal": "sine5",
                   "model_cycles_per_sample": 400.0, "model_cycles_high": 420.0, "bytes": 408.0},
        "real_time": {"cycles_a_sample": 216000.0, "share": 0.0019444444444444444,
                      "text": "216 MHz at 1000 samples a second leave 216000 cycles a sample; the model's upper end takes 0.194 %"},
        "runner_up": {"kernel": "shift_plain_f32", "taps": 40, "error_max": 0.02, "worst_signal": "sine5",
                      "model_cycles_per_sample": 500.0, "model_cycles_high": 540.0, "bytes": 320.0},
        "tie_within_noise": true,
        "kernels": [
            {"kernel": "ring_plain_f32", "taps": 50, "error_max": 0.01, "worst_signal": "sine5",
             "model_cycles_per_sample": 400.0, "model_cycles_high": 420.0, "bytes": 408.0,
             "verdict": "chosen", "why": "the cheapest that meets every limit"},
            {"kernel": "shift_plain_f32", "taps": 40, "error_max": 0.02, "worst_signal": "sine5",
             "model_cycles_per_sample": 500.0, "model_cycles_high": 540.0, "bytes": 320.0,
             "verdict": "runner-up", "why": "as cheap within the noise"}],
        "notes": ["of this run"],
        "context": {"commit": "c0ffee"}
    })"))
        << to_json(answer).dump(1);
}

TEST(ChoiceJson, SaysHowFarNothingFits) {
    Answer answer = asked();
    answer.question.target = choose::Target::host;
    answer.unit = "ns";
    const Candidate near = candidate("modes_plain_f32", 16, 0.2, 30.0, 90.0, 128.0);
    answer.choice.relaxed = {{"max_error", 0.125, 0.2, near}};
    const choose::Outcome outcome{"modes_plain_f32", Standing::inaccurate, {}, near, {}, ""};
    answer.choice.kernels = {outcome};
    const bench::Json json = to_json(answer);
    EXPECT_EQ(json.at("fits"), false);
    EXPECT_EQ(json.at("question").at("target"), "host");
    EXPECT_FALSE(json.contains("choice"));
    EXPECT_FALSE(json.contains("runner_up"));
    const bench::Json wanted =
        bench::Json::parse(R"({"kernel": "modes_plain_f32", "taps": 16, "near_taps": 2, "modes": 7,
        "error_max": 0.2, "worst_signal": "sine5", "ns_per_sample": 30.0, "ns_per_sample_noise": 0.25,
        "cycles_per_sample": 90.0, "bytes": 128.0})");
    ASSERT_EQ(json.at("nearest_misses").size(), 1U);
    const bench::Json& miss = json.at("nearest_misses")[0];
    EXPECT_EQ(miss.at("limit"), "max-error");
    EXPECT_EQ(miss.at("from"), 0.125);
    EXPECT_EQ(miss.at("to"), 0.2);
    EXPECT_EQ(miss.at("factor"), 1.6);
    EXPECT_EQ(miss.at("fits"), wanted) << miss.dump(1);
    EXPECT_EQ(json.at("kernels")[0].at("verdict"), "too inaccurate");
    EXPECT_EQ(json.at("kernels")[0].at("why"), "gets to 2.00e-01 at best, at 2+7 taps");
    // Of instructions, what a core that issues two a cycle needs at least.
    answer.question.target = choose::Target::m7;
    answer.unit = "instructions";
    answer.choice.relaxed.clear();
    answer.choice.chosen = candidate("ring_plain_f32", 50, 0.01, 400.0, 400.0, 408.0);
    EXPECT_EQ(to_json(answer).at("choice").at("instructions_per_sample"), 400.0);
    EXPECT_NEAR(to_json(answer).at("real_time").at("share_at_least").get<double>(), 200.0 / 216000.0, 1e-15);
    answer.question.target = choose::Target::m4;  // issues one: in the file as in the text
    EXPECT_NEAR(to_json(answer).at("real_time").at("share_at_least").get<double>(), 400.0 / 216000.0, 1e-15);
    EXPECT_NE(to_json(answer).at("real_time").at("text").get<std::string>().find("at least 0.185 %"),
              std::string::npos);
}

// A cost that could not be measured, or was not, is none of 0.
TEST(ChoiceJson, HasTheCostsThatAreKnown) {
    Answer answer = asked();
    Candidate candidates[] = {candidate("ring_plain_f32", 50, 0.01, 400.0, 420.0, 408.0),
                              candidate("ring_plain_f32", 50, 0.01, 400.0, 420.0, 408.0),
                              candidate("ring_plain_f32", 50, 0.01, 0.0, 0.0, 0.0)};
    candidates[1].cost.fault = "it crashed";
    for (const Candidate& one : candidates) {
        answer.choice.kernels.push_back({"ring_plain_f32", Standing::costlier, one, {}, {}, ""});
    }
    answer.choice.chosen = candidates[0];
    const bench::Json kernels = to_json(answer).at("kernels");
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(kernels[i].contains("model_cycles_per_sample"), i == 0) << i;
        EXPECT_EQ(kernels[i].contains("bytes"), i == 0) << kernels[i].dump();
    }
}

TEST(ChoiceTable, SaysWhatWasAskedWhatWasChosenAndWhyTheOthersLost) {
    Answer answer = asked();
    const Candidate first = candidate("ring_plain_f32", 50, 0.01, 400.0, 420.0, 408.0);
    const Candidate second = candidate("shift_plain_f32", 40, 0.02, 400.25, 400.25, 1320.0);
    answer.choice.chosen = first;
    answer.choice.runner_up = second;
    answer.choice.kernels = {
        {"mirror_multi_f32",
         Standing::costlier,
         candidate("mirror_multi_f32", 60, 0.01, 800.0, 840.0, 500.0),
         {},
         {},
         ""},
        {"ring_plain_q15", Standing::wrong, {}, {}, {}, "it is broken"},
        {"ring_plain_q31", Standing::inaccurate, {}, candidate("ring_plain_q31", 70, 0.25, 0.0, 0.0, 0.0), {}, ""},
        {"ring_plain_f32", Standing::chosen, first, {}, {}, ""},
        {"shift_plain_f32", Standing::runner_up, second, {}, {}, ""},
        {"ring_horner_f32",
         Standing::dominated,
         candidate("ring_horner_f32", 55, 0.03, 500.0, 540.0, 420.0),
         {},
         {},
         "by ring_plain_f32"},
        {"shift_plain_f64",
         Standing::too_costly,
         candidate("shift_plain_f64", 90, 0.005, 9000.0, 10000.0, 900.0),
         {},
         candidate("shift_plain_f64", 64, 0.0, 6400.0, 6400.0, 700.0),
         ""},
        {"ring_oldest_f32",
         Standing::too_costly,
         candidate("ring_oldest_f32", 90, 0.005, 6000.0, 7500.0, 900.0),
         {},
         {},
         ""},
        {"mirror_plain_f32",
         Standing::too_large,
         candidate("mirror_plain_f32", 90, 0.005, 600.0, 600.0, 14000.0),
         {},
         {},
         ""},
    };
    const std::string text = to_table(answer, false);
    EXPECT_TRUE(
        text.starts_with("order 0.5, h = 0.002 s, error at most 0.125: the worst of step, sine5 over 700 samples\n"
                         "at most 5000 cycles a sample\nat most 6000 instructions a sample\n"
                         "at most 7000 bytes of state and coefficients\n"))
        << text;
    EXPECT_NE(
        text.find(
            "\nchoice     ring_plain_f32 with 50 taps: error 0.01 (sine5), 400 model cycles, at most 420, 408 bytes\n"
            "runner-up  shift_plain_f32 with 40 taps: error 0.02 (sine5), 400.2 model cycles, 1320 bytes\n"
            "real time  216 MHz at 1000 samples a second leave 216000 cycles a sample; the model's upper end "
            "takes 0.194 %\n"),
        std::string::npos)
        << text;
    // By standing, and of one by cost.
    std::vector<std::size_t> places;
    for (const char* line :
         {"ring_plain_f32               50  1.00e-02  sine5          400      408  chosen",
          "shift_plain_f32              40  2.00e-02  sine5        400.2     1320  runner-up",
          "ring_horner_f32              55  3.00e-02  sine5          500      420  dominated: by ring_plain_f32, no "
          "worse in error, cost and bytes",
          "mirror_multi_f32             60  1.00e-02  sine5          800      500  costlier: ",
          "ring_oldest_f32              90  5.00e-03  sine5         6000      900  too costly: 1.5 times the limit",
          "shift_plain_f64              90  5.00e-03  sine5            -        -  too costly: at 64 taps already 6400 "
          "model cycles",
          "mirror_plain_f32             90  5.00e-03  sine5          600    14000  too large: 2 times the limit",
          "ring_plain_q31               70  2.50e-01  sine5            -        -  too inaccurate: gets to 2.50e-01 at "
          "best, at 70 taps",
          "ring_plain_q15                -         -  -                -        -  wrong: it is broken"}) {
        places.push_back(text.find(std::string("\n  ") + line));
        EXPECT_NE(places.back(), std::string::npos) << line << '\n' << text;
    }
    EXPECT_TRUE(std::is_sorted(places.begin(), places.end())) << text;
    EXPECT_NE(text.find("  kernel                     taps     error  worst       cycles    bytes  verdict\n"),
              std::string::npos)
        << text;
    EXPECT_TRUE(text.ends_with("\n\n  of this run\n")) << text;
    // Colours: the choice is strong, what lost is dim, and nothing else changes.
    std::string coloured = to_table(answer, true);
    EXPECT_NE(coloured.find("\033[1mring_plain_f32 with 50 taps\033[0m: error"), std::string::npos) << coloured;
    EXPECT_NE(coloured.find("\033[2m  mirror_multi_f32"), std::string::npos);
    EXPECT_EQ(coloured.find("\033[2m  ring_plain_f32"), std::string::npos);
    EXPECT_EQ(coloured.find("\033[2m  shift_plain_f32"), std::string::npos);
    for (std::size_t at; (at = coloured.find('\033')) != std::string::npos;) {
        coloured.erase(at, coloured.find('m', at) - at + 1);
    }
    EXPECT_EQ(coloured, text);
    answer.choice.tie = true;
    EXPECT_NE(to_table(answer, false).find("1320 bytes; within the noise as cheap\n"), std::string::npos);
}

TEST(ChoiceTable, OfTheHostAndOfInstructionsHasTheirWords) {
    Answer answer = asked();
    answer.question.target = choose::Target::host;
    answer.unit = "ns";
    answer.choice.chosen = candidate("ring_plain_f32", 50, 0.01, 30.0, 90.0, 408.0);
    EXPECT_EQ(choose::cost_text(answer, *answer.choice.chosen), "30.0 +- 0.2 ns, 90 cycles");
    EXPECT_NE(choose::budget_share(answer, *answer.choice.chosen).find("the host's cycle count takes 0.0417 %"),
              std::string::npos);
    EXPECT_NE(to_table(answer, false).find("worst           ns    bytes"), std::string::npos)
        << to_table(answer, false);
    answer.question.target = choose::Target::m7;
    answer.unit = "instructions";
    answer.choice.chosen = candidate("ring_plain_f32", 50, 0.01, 433.0, 433.0, 408.0);
    EXPECT_EQ(choose::cost_text(answer, *answer.choice.chosen), "433 instructions");
    EXPECT_NE(choose::budget_share(answer, *answer.choice.chosen)
                  .find("needs at least 217 of them for 433 instructions: at least 0.1 %, and more by every stall"),
              std::string::npos)
        << choose::budget_share(answer, *answer.choice.chosen);
    answer.question.rate_hz.reset();
    EXPECT_EQ(choose::budget_share(answer, *answer.choice.chosen), "");
    EXPECT_EQ(to_table(answer, false).find("real time"), std::string::npos);
    // Nothing fits: the nearest miss, then what each limit would have to be.
    answer.choice.chosen.reset();
    EXPECT_NE(to_table(answer, false).find("nothing fits, and relaxing any one limit alone does not help"),
              std::string::npos);
    answer.choice.relaxed = {
        {"max_error", 0.125, 0.1375, candidate("ring_plain_f32", 50, 0.1375, 400.0, 400.0, 408.0)}};
    const std::string missed = to_table(answer, false);
    EXPECT_NE(
        missed.find(
            "nothing fits; nearest miss: ring_plain_f32 with 50 taps misses --max-error by 10 %, with --max-error "),
        std::string::npos)
        << missed;
    EXPECT_NE(
        missed.find(
            " instead of 0.125 (times 1.1): ring_plain_f32 with 50 taps, error 0.138, 400 instructions, 408 bytes\n"),
        std::string::npos)
        << missed;
    // Of another limit, by the name of its option: whole cycles, instructions or bytes, upwards.
    const auto misses = [&](const char* limit, const char* unit) {
        Answer other = answer;
        other.unit = unit;
        other.choice.relaxed = {{limit, 400.0, 440.25, candidate("ring_plain_f32", 50, 0.1, 440.25, 440.25, 408.0)}};
        return choose::nearest_miss(other);
    };
    const std::string by = "nothing fits; nearest miss: ring_plain_f32 with 50 taps misses ";
    EXPECT_EQ(misses("max_cost", "instructions"),
              by + "--max-instructions by 10.1 %, with --max-instructions 441 it fits");
    EXPECT_EQ(misses("max_cost", "model cycles"), by + "--max-cycles by 10.1 %, with --max-cycles 441 it fits");
    EXPECT_EQ(misses("max_bytes", "model cycles"), by + "--max-bytes by 10.1 %, with --max-bytes 441 it fits");
    // A limit that may be typed: three digits, upwards; what has no more stays.
    const auto limit = [&](double to) {
        answer.choice.relaxed.front().to = to;
        const std::string table = to_table(answer, false);
        const std::size_t from = table.find("with --max-error ") + 17;
        return table.substr(from, table.find(' ', from) - from);
    };
    EXPECT_EQ(limit(0.5), "0.5");
    EXPECT_EQ(limit(0.25001), "0.251");
    EXPECT_EQ(limit(0.00345), "0.00345");
}

}  // namespace
