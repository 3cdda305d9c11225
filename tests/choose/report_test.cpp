// The answer as JSON holds what was asked, what was chosen and what each kernel came to: read back field by field.
#include "bench/choose/report.hpp"

#include <gtest/gtest.h>

namespace {

using choose::Answer;
using choose::Candidate;
using choose::Fate;

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
    answer.choice.kernels = {{"ring_plain_f32", Fate::chosen, first, {}, {}, ""},
                             {"shift_plain_f32", Fate::runner_up, second, {}, {}, ""}};
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
    const choose::Fared fared{"modes_plain_f32", Fate::inaccurate, {}, near, {}, ""};
    answer.choice.kernels = {fared};
    const bench::Json json = to_json(answer);
    EXPECT_EQ(json.at("fits"), false);
    EXPECT_EQ(json.at("question").at("target"), "host");
    EXPECT_FALSE(json.contains("choice"));
    EXPECT_FALSE(json.contains("runner_up"));
    const bench::Json wanted = bench::Json::parse(R"({"kernel": "modes_plain_f32", "taps": 16, "near_taps": 2, "modes": 7,
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
}

}  // namespace
