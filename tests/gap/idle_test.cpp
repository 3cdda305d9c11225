// A drive by pulses stands still at 1000 us: inputs are counted from there, and what is printed is as it was logged.
#include "gap/drive/base/idle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "drive/model_file.hpp"
#include "gap/drive/diagnose.hpp"
#include "gap/drive/improved.hpp"
#include "gap/drive/start.hpp"
#include "gap/drive/verdict.hpp"

namespace {

using testing::Contains;
using testing::HasSubstr;

gap::Question asked_of(bool refit, gap::Record train, gap::Record validate) {
    return {gap::form_of(drive::make_fopdt(0.3, 0.4, 0.0)),
            refit,
            {std::move(train)},
            {std::move(validate)},
            {},
            gap::Metric::simulation,
            {},
            1};
}

gap::Record record_of(std::vector<double> input, std::vector<double> output) {
    gap::Record record{"log", {}, std::move(input), std::move(output), 0.1};
    for (std::size_t i = 0; i < record.input.size(); ++i) {
        record.time_s.push_back(0.1 * static_cast<double>(i));
    }
    return record;
}

// Pulses in us; the rotor follows 50 us behind its idle.
gap::Record pulses() { return record_of({1000, 1000, 1500, 2000, 1200}, {0.0, 0.1, 90.0, 190.0, 100.0}); }

TEST(IdleInput, IsTheLeastLevelWhereADriveIsOff) {
    EXPECT_EQ(gap::idle_input_of({pulses()}, {}), 1000.0);
    EXPECT_EQ(gap::idle_input_of({pulses(), pulses()}, {pulses()}), 1000.0);
    gap::Record backward = pulses();
    for (double& u : backward.input) {
        u = -u;
    }
    EXPECT_EQ(gap::idle_input_of({backward}, {}), -1000.0);
    // Validation may begin anywhere, but not below.
    gap::Record moving = record_of({1500, 1500, 2000}, {100.0, 100.0, 190.0});
    EXPECT_EQ(gap::idle_input_of({pulses()}, {moving}), 1000.0);
    EXPECT_EQ(gap::idle_input_of({pulses(), moving}, {}), 0.0);
    moving.input.back() = 900.0;
    EXPECT_EQ(gap::idle_input_of({pulses()}, {moving}), 0.0);
}

TEST(IdleInput, NeedsReadingsThatRestAtZeroThere) {
    gap::Record warm = pulses();  // of 190 the largest: 2 % are 3.8
    warm.output[1] = 3.7;
    EXPECT_EQ(gap::idle_input_of({warm}, {}), 1000.0);
    warm.output[1] = 3.9;
    EXPECT_EQ(gap::idle_input_of({warm}, {}), 0.0);
    warm.output[1] = -3.9;
    EXPECT_EQ(gap::idle_input_of({warm}, {}), 0.0);
}

TEST(IdleInput, IsNoneOfInputsThatGoDownToATwentieth) {
    for (const auto& [idle, expected] : {std::pair(99.0, 0.0), std::pair(101.0, 101.0), std::pair(0.0, 0.0)}) {
        gap::Record record = pulses();
        record.input[0] = record.input[1] = idle;
        EXPECT_EQ(gap::idle_input_of({record}, {}), expected) << idle;
    }
    gap::Record constant = pulses();
    constant.input.assign(constant.size(), 1000.0);
    EXPECT_EQ(gap::idle_input_of({constant}, {}), 0.0);
    gap::Record both_ways = pulses();
    both_ways.input.back() = -1200.0;
    EXPECT_EQ(gap::idle_input_of({both_ways}, {}), 0.0);
}

TEST(IdleInput, IsNearTheFirstLevel) {
    gap::Record record = pulses();  // from 1000 to 2000: 2 % are 20
    record.input[0] = record.input[1] = 1019.0;
    record.input.back() = 1000.0;
    EXPECT_EQ(gap::idle_input_of({record}, {}), 1000.0);
    record.input[0] = record.input[1] = 1021.0;
    EXPECT_EQ(gap::idle_input_of({record}, {}), 0.0);
}

TEST(IdleInput, RecordsAreCountedFromItAndBack) {
    const gap::Question question = asked_of(true, pulses(), pulses());
    const gap::Question counted = gap::counted_from_idle(question);
    EXPECT_EQ(counted.idle_input, 1000.0);
    EXPECT_THAT(counted.train[0].input, testing::ElementsAre(0, 0, 500, 1000, 200));
    EXPECT_EQ(counted.validate[0].input, counted.train[0].input);
    EXPECT_EQ(counted.train[0].output, pulses().output);
    EXPECT_EQ(gap::as_logged(counted.train, counted.idle_input)[0].input, pulses().input);
}

// A first-order drive that pulses up to 1100 us do not start, at levels that a seed draws.
gap::Record drive_of(unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 0.2);
    std::uniform_int_distribution<int> level(0, 10);
    gap::Record record{"log", {}, {}, {}, 0.05};
    for (int i = 0; i < 800; ++i) {
        record.time_s.push_back(0.05 * i);
        record.input.push_back(i < 40 ? 0.0 : i % 40 == 0 ? 50.0 * level(engine) : record.input.back());
    }
    record.output.assign(record.size(), 0.0);
    gap::Scenario scenario;
    scenario.model = drive::make_fopdt(0.3, 0.4, 0.0);
    gap::effect_named("input_dead_zone").add_to(scenario, std::vector{100.0, 100.0});
    record.output = gap::simulate(scenario, gap::Course(record, 4));
    for (std::size_t i = 0; i < record.size(); ++i) {
        record.output[i] += noise(engine);
        record.input[i] += 1000.0;
    }
    return record;
}

TEST(IdleInput, LetsADeadZoneBeginThere) {
    gap::Question question = asked_of(true, drive_of(1), drive_of(2));
    question.without = {"start_up_threshold", "valve_stiction", "input_hysteresis", "backlash"};
    const gap::Answer answer = gap::diagnose(question, [](const std::string&) {});
    ASSERT_EQ(answer.decision.outcome, gap::Outcome::attributed) << gap::to_text(answer);
    const nlohmann::json verdict = nlohmann::json::parse(gap::to_json(answer));
    EXPECT_EQ(verdict["split"], false);
    ASSERT_EQ(verdict["effects"].size(), 1U);
    EXPECT_EQ(verdict["effects"][0]["effect"], "input_dead_zone");
    EXPECT_NEAR(verdict["effects"][0]["parameters"]["width"].get<double>(), 100.0, 5.0);
    // What is shown is as it was logged, and says where it is counted from.
    EXPECT_EQ(verdict["base"]["idle_input"], 1000.0);
    EXPECT_THAT(verdict["notes"], Contains(HasSubstr("an input of 1000")));
    for (const auto& level : verdict["where"]["input_level"]) {
        EXPECT_GE(level["from"].get<double>(), 1000.0) << level;
    }
    EXPECT_NEAR(verdict["base"]["records"][0]["numbers"]["input_before"].get<double>(), 1000.0, 100.0);
    ASSERT_TRUE(answer.next_record);
    const auto [least, most] = std::minmax_element(answer.next_record->input.begin(), answer.next_record->input.end());
    EXPECT_GE(*least, 1000.0);
    EXPECT_EQ(*most, 1500.0);
    EXPECT_THAT(answer.next_experiment, HasSubstr("from 1000 to 1500"));
    // And the improved model runs on the log.
    const nlohmann::json improved = nlohmann::json::parse(gap::improved_model(answer));
    EXPECT_EQ(improved["idle_input"], 1000.0);
    const gap::Record validate = drive_of(2);
    const gap::Improved run = gap::simulate_improved(drive::parse_model(improved.dump(), "m"), validate, "m");
    double squares = 0.0;
    for (std::size_t i = 0; i < validate.size(); ++i) {
        squares += std::pow(run.output[i] - validate.output[i], 2);
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(validate.size())), 0.6);
}

TEST(IdleInput, IsNotAskedOfAGivenModel) {
    gap::Question question = asked_of(false, drive_of(1), drive_of(2));
    question.without = {"gain_error"};
    const gap::Answer answer = gap::diagnose(question, [](const std::string&) {});
    EXPECT_EQ(answer.idle_input, 0.0);
    EXPECT_FALSE(nlohmann::json::parse(gap::to_json(answer))["base"].contains("idle_input"));
    EXPECT_FALSE(nlohmann::json::parse(gap::improved_model(answer)).contains("idle_input"));
}

}  // namespace
