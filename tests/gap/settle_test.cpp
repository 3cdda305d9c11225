// Numbers that training leaves anywhere within a stretch: between two levels of its input, say.
#include "gap/drive/settle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "gap/drive/cost.hpp"
#include "gap/drive/fit.hpp"
#include "gap/drive/question.hpp"
#include "gap/drive/start.hpp"

namespace {

using Input = double (*)(double time_s);

double stairs(double t) { return t < 2.0 ? 0.0 : t < 12.0 ? 0.4 : t < 22.0 ? 0.8 : t < 32.0 ? 1.2 : 0.4; }
double chirp(double t) { return 0.6 - 0.6 * std::cos(0.004 * t * t + 0.1 * t); }

gap::Record read(Input input, const std::string& effect, const std::vector<double>& values, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 1e-3);
    gap::Record record;
    record.name = "made";
    record.usual_interval_s = 0.1;
    for (int i = 0; i < 400; ++i) {
        record.time_s.push_back(0.1 * i);
        record.input.push_back(input(record.time_s.back()));
        record.output.push_back(0.0);
    }
    gap::Scenario scenario;
    scenario.model = drive::make_fopdt(2.0, 1.0, 0.0);
    gap::effect_named(effect).add_to(scenario, values);
    record.output = gap::simulate(scenario, gap::Course(record, 4));
    for (double& z : record.output) {
        z += noise(engine);
    }
    return record;
}

// A question about an effect that training has seen at a few levels.
gap::Question asked_about(const std::string& effect, const std::vector<double>& values) {
    return {gap::form_of(drive::make_fopdt(2.0, 1.0, 0.0)),
            true,
            {read(stairs, effect, values, 1)},
            {read(chirp, effect, values, 2)},
            {},
            gap::Metric::simulation,
            {},
            1};
}

// What validation makes of it.
gap::Settled settled(const std::string& effect, const std::vector<double>& values) {
    const gap::Question question = asked_about(effect, values);
    const gap::Ground ground = gap::prepare(question);
    const gap::Candidate trained = gap::fit(ground.study, {&gap::effect_named(effect)}, ground.base, nullptr);
    return gap::settle(ground.study, ground.validation, trained);
}

TEST(Settle, TellsAThresholdBetweenTwoLevelsByTheValidation) {
    const gap::Settled told = settled("start_up_threshold", {0.53, 1.0, 0.0});
    EXPECT_EQ(told.numbers, 1U);
    EXPECT_NEAR(told.trained.lasting[0][0].value, 0.53, 0.03);
}

// It is where validation is told best: no other place between the two levels leaves less there.
TEST(Settle, TakesTheBestPlaceOfTheValidation) {
    const gap::Effect& threshold = gap::effect_named("start_up_threshold");
    const gap::Question question = asked_about(threshold.name, {0.47, 1.0, 0.0});
    const gap::Ground ground = gap::prepare(question);
    const gap::Candidate trained = gap::fit(ground.study, {&threshold}, ground.base, nullptr);
    const gap::Settled told = gap::settle(ground.study, ground.validation, trained);
    ASSERT_EQ(told.numbers, 1U);
    gap::Candidate carried = gap::carried_over(ground.validation, trained, nullptr);
    const auto cost_at = [&](double place) {
        carried.lasting[0][0].value = place;
        return gap::cost_of(ground.validation, carried, nullptr);
    };
    double least = std::numeric_limits<double>::infinity();
    for (double place = 0.405; place < 0.795; place += 0.005) {
        least = std::min(least, cost_at(place));
    }
    EXPECT_LE(cost_at(told.trained.lasting[0][0].value), 1.02 * least);
}

TEST(Settle, LeavesWhatTrainingTells) {
    const gap::Settled told = settled("input_saturation", {0.9});
    EXPECT_EQ(told.numbers, 0U);
    EXPECT_NEAR(told.trained.lasting[0][0].value, 0.9, 0.01);
}

// Of a limit above all that training asks for nothing is known, and it may be none.
TEST(Settle, LeavesWhatMayBeNone) { EXPECT_EQ(settled("input_saturation", {1.5}).numbers, 0U); }

// A threshold below the lowest level that training asks for may be none, however well validation tells it.
TEST(Settle, LeavesAThresholdThatMayBeNone) {
    const gap::Effect& threshold = gap::effect_named("start_up_threshold");
    const gap::Question question = asked_about(threshold.name, {0.3, 1.0, 0.0});
    const gap::Ground ground = gap::prepare(question);
    gap::Candidate trained = gap::fit(ground.study, {&threshold}, ground.base, nullptr);
    trained.lasting[0][1].value = 1.0;
    trained.lasting[0][2].value = 0.0;
    // Wherever below the first level the fit has left it, on a hundredth of its range or between two.
    for (const double left_at : {0.0, 0.1, 0.21, 0.3017, 0.38}) {
        trained.lasting[0][0].value = left_at;
        const gap::Settled told = gap::settle(ground.study, ground.validation, trained);
        EXPECT_EQ(told.numbers, 0U) << left_at;
        EXPECT_EQ(told.trained.lasting[0][0].value, left_at);
    }
}

// A given model and a threshold that is known to be one, without noise: training has the levels 0, 0.4, `upper` and
// 1.2, validation a ramp through all of them.
struct Given {
    std::vector<gap::Record> records;
    gap::Study train;
    gap::Study judge;
    Given(double upper, double truth) : train(blank()), judge(blank()) {
        for (const bool ramp : {false, true}) {
            gap::Record& record = records.emplace_back();
            record.name = "given";
            record.usual_interval_s = 0.1;
            for (int i = 0; i < 400; ++i) {
                record.time_s.push_back(0.1 * i);
                record.input.push_back(ramp ? 0.003 * i : i < 100 ? 0.0 : i < 200 ? 0.4 : i < 300 ? upper : 1.2);
                record.output.push_back(0.0);
            }
        }
        for (std::size_t r = 0; r < 2; ++r) {
            gap::Study& study = r == 0 ? train : judge;
            study.courses.emplace_back(records[r], 1);
            study.counts = gap::all_count({records[r]});
            gap::Scenario scenario;
            scenario.model = gap::model_of(study.base.form);
            gap::effect_named("start_up_threshold").add_to(scenario, std::vector{truth, 1.0, 0.0});
            records[r].output = gap::simulate(scenario, study.courses[0]);
        }
        train.scales = judge.scales = gap::scales_of(gap::model_of(train.base.form), {records[0]}, {});
    }
    static gap::Study blank() {
        return {{gap::form_of(drive::make_fopdt(2.0, 1.0, 0.0)), false}, {}, {}, {}, 0.01, 0.001, 0};
    }
    [[nodiscard]] gap::Settled settled(double left_at) const {
        const gap::Effect& threshold = gap::effect_named("start_up_threshold");
        gap::Candidate trained;
        trained.effects = {&threshold};
        trained.lasting = {gap::parameters_of(threshold, train.scales, 0)};
        const double values[] = {left_at, 1.0, 0.0};
        for (std::size_t n = 0; n < 3; ++n) {
            trained.lasting[0][n].value = values[n];
        }
        trained.own.resize(1);
        return gap::settle(train, judge, trained);
    }
};

// To a level of the ramp and a half of a hundredth of the stretch.
TEST(SettleByHand, FindsTheThresholdOnARamp) {
    for (const double truth : {0.45, 0.6, 0.7512}) {
        const gap::Settled told = Given(0.8, truth).settled(0.5);
        EXPECT_EQ(told.numbers, 1U);
        EXPECT_NEAR(told.trained.lasting[0][0].value, truth, 0.005) << truth;
        EXPECT_EQ(told.trained.lasting[0][1].value, 1.0);
    }
}

// The stretch is as many hundredths of the range, of 0.95 of the greatest input, as training says nothing of.
TEST(SettleByHand, StaysWhereTrainingSaysNothing) {
    const double part = 0.01 * 0.95 * 1.2;
    EXPECT_NEAR(Given(0.8, 0.4035).settled(0.5).trained.lasting[0][0].value, 0.5 - 8.0 * part, 1e-9);
    EXPECT_NEAR(Given(0.8, 0.7995).settled(0.5).trained.lasting[0][0].value, 0.5 + 26.0 * part, 1e-9);
    // From one level to the next it is no wider than a hundredth; from 0 on it may be none; above all there is one.
    EXPECT_EQ(Given(0.42, 0.41).settled(0.41).numbers, 0U);
    EXPECT_EQ(Given(0.45, 0.42).settled(0.42).numbers, 1U);
    EXPECT_EQ(Given(0.8, 0.3).settled(0.2).numbers, 0U);
}

}  // namespace
