// Logs of a fractional model as a device runs it, with another kernel or length than the ideal: what it lacks is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

#include "drive/model_file.hpp"
#include "drive/simulation.hpp"
#include "gap/drive/start.hpp"
#include "gap/drive/verdict.hpp"
#include "stand_case.hpp"

namespace {

using testing::ElementsAre;

constexpr double step_s = 0.01;

drive::Model plant() {
    return drive::parse_model(R"({"gain": 1, "numerator": [{"coefficient": 0.2, "order": 0}], "denominator": [
        {"coefficient": 0.18, "order": 1.9909}, {"coefficient": 0.4, "order": 0.98319}, {"coefficient": 0.5, "order": 0}],
        "delay_s": 0, "sample_time_s": 0.01})",
                              "plant");
}

gap::Record log_of(const drive::Scheme& scheme, const char* excitation, std::uint32_t seed) {
    constexpr double noise = 2e-4;
    drive::Log log;
    log.name = excitation;
    log.input = drive::make_input({.name = excitation}, step_s, 20.0);
    log.output = drive::simulate(plant(), scheme, log.input).output;
    boost::random::mt19937 engine(seed);
    boost::random::normal_distribution<double> normal(0.0, noise);
    for (std::size_t i = 0; i < log.output.size(); ++i) {
        log.time_s.push_back(step_s * static_cast<double>(i));
        log.output[i] += normal(engine);
    }
    return gap::to_record(std::move(log));
}

gap::Answer ask(const drive::Scheme& scheme) {
    return gap::diagnose({gap::form_of(plant()),
                          false,
                          {log_of(scheme, "staircase", 1)},
                          {log_of(scheme, "pulse", 2)},
                          std::nullopt,
                          gap::Metric::simulation,
                          {},
                          2},
                         [](const std::string&) {});
}

TEST(Deployed, ShortMemoryIsNamedWithItsLength) {
    const gap::Answer answer = ask({.step_s = step_s, .taps = 60});
    ASSERT_THAT(gap_test::names(answer), ElementsAre("finite_memory")) << gap::to_text(answer);
    EXPECT_NEAR(gap_test::find(answer, "finite_memory.taps")->value, 60.0, 1.0);
    EXPECT_LT(answer.chosen().gap_after, 0.3 * answer.decision.base_gap);
}

TEST(Deployed, SinglePrecisionIsNamed) {
    const gap::Answer answer = ask({.step_s = step_s, .kernel = "ring_plain_f32"});
    ASSERT_THAT(gap_test::names(answer), ElementsAre("single_precision")) << gap::to_text(answer);
    EXPECT_EQ(gap_test::find(answer, "single_precision.oldest_first")->value, 0.0);
    EXPECT_EQ(gap_test::find(answer, "single_precision.increments")->value, 0.0);
    EXPECT_LT(answer.chosen().gap_after, 0.4 * answer.decision.base_gap);
}

TEST(Deployed, FixedPointIsNamedWithItsFormat) {
    const gap::Answer answer = ask({.step_s = step_s, .kernel = "ring_plain_q15"});
    ASSERT_THAT(gap_test::names(answer), ElementsAre("fixed_point")) << gap::to_text(answer);
    EXPECT_EQ(gap_test::find(answer, "fixed_point.format")->value, 15.0);
    EXPECT_LT(answer.chosen().gap_after, 0.01 * answer.decision.base_gap);
}

}  // namespace
