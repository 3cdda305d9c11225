// What training tells of numbers, on logs of the virtual stand.
#include "gap/drive/determined.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "gap/drive/fit.hpp"
#include "gap/drive/question.hpp"
#include "gap/drive/start.hpp"
#include "stand_case.hpp"

namespace {

using testing::HasSubstr;
using testing::StartsWith;

// Fitted to training alone, with its intervals.
gap::Candidate trained(const gap::Ground& ground, const std::string& effect) {
    gap::Candidate candidate = gap::fit(ground.study, {&gap::effect_named(effect)}, ground.base, nullptr);
    gap::add_intervals(ground.study, candidate, nullptr);
    return candidate;
}

TEST(Untold, IsNothingOfAnEffectThatIsThere) {
    const gap::Question question =
        gap_test::question_of({{"input_saturation.limit", 0.08}}, {.seed = 71}, {.seed = 72});
    const gap::Ground ground = gap::prepare(question);
    const gap::Candidate candidate = trained(ground, "input_saturation");
    EXPECT_EQ(gap::untold_of(ground.study, candidate), "");
    const gap::FreeParameter& limit = candidate.lasting.front().front();
    EXPECT_LE(limit.low, limit.value);
    EXPECT_GE(limit.high, limit.value);
    EXPECT_LT(limit.high - limit.low, 0.01);
    EXPECT_NEAR(limit.value, 0.08, 0.002);
}

TEST(Untold, IsTheSizeOfAnEffectThatIsNot) {
    const gap::Question question = gap_test::question_of({}, {.seed = 73}, {.seed = 74});
    const gap::Ground ground = gap::prepare(question);
    for (const char* effect : {"coulomb_friction", "gain_drift", "backlash", "sensor_drift"}) {
        EXPECT_THAT(gap::untold_of(ground.study, trained(ground, effect)),
                    StartsWith("training leaves " + std::string(effect)));
    }
}

// A width moves no reading: its deviation is the likelihood's.
TEST(Untold, IsAWidthOfJitterThatMayBeNone) {
    const gap::Question question = gap_test::question_of({}, {.seed = 73}, {.seed = 74});
    const gap::Ground ground = gap::prepare(question);
    gap::Candidate candidate = gap::fit(ground.study, {&gap::effect_named("sampling_jitter")}, ground.base, nullptr);
    gap::FreeParameter& width = candidate.lasting.front().front();
    width.upper = 3.0;
    width.value = 1.98;
    width.deviation = 1.0;
    EXPECT_EQ(gap::untold_of(ground.study, candidate), "");
    width.deviation = 1.02;
    EXPECT_THAT(gap::untold_of(ground.study, candidate), StartsWith("training leaves sampling_jitter.half_width_s"));
    width.deviation = 0.01;
    width.value = 2.84;
    EXPECT_EQ(gap::untold_of(ground.study, candidate), "");
    width.value = 2.86;
    EXPECT_THAT(gap::untold_of(ground.study, candidate), StartsWith("training leaves sampling_jitter.half_width_s"));
}

// Beside a fitted form some hundred candidates are tried, and one that is two deviations from none is no rarity.
TEST(Untold, IsWhatChanceLeavesAsFarFromNoneBesideAFittedForm) {
    gap::Question question = gap_test::question_of({{"input_saturation.limit", 0.08}}, {.seed = 71}, {.seed = 72});
    for (const bool refit : {false, true}) {
        question.refit = refit;
        const gap::Ground ground = gap::prepare(question);
        gap::Candidate candidate = trained(ground, "quadratic_drag");
        gap::FreeParameter& drag = candidate.lasting.front().front();
        const auto told = [&](double deviations) {
            drag.deviation = drag.value / deviations;
            return gap::untold_of(ground.study, candidate).empty();
        };
        drag.value = 0.5;
        drag.low = 0.4, drag.high = 0.6;
        EXPECT_TRUE(told(4.02));
        EXPECT_EQ(told(3.96), !refit);
        // What moves nothing has no deviation, but an interval from what is as likely.
        drag.moves_nothing = true;
        EXPECT_TRUE(told(3.96));
    }
}

// A step that only rises tells nothing of a lag downwards: whatever validation makes of it is a guess.
TEST(Untold, IsALagInADirectionThatTrainingLacks) {
    const gap::Question question =
        gap_test::question_of({}, {.experiment = "step", .seed = 75}, {.experiment = "pulse", .seed = 76});
    const gap::Ground ground = gap::prepare(question);
    gap::Candidate candidate =
        gap::fit(ground.study, {&gap::effect_named("direction_asymmetry")}, ground.base, nullptr);
    candidate.lasting.front()[1].value = 0.3;  // the lag downwards, as if validation had told it
    gap::add_intervals(ground.study, candidate, nullptr);
    EXPECT_THAT(gap::untold_of(ground.study, candidate), HasSubstr("is no effect"));
}

// Another lag up than down is no lag; the same one is, and a fitted base of another form has it.
TEST(Linear, IsAnAsymmetryOfTheSameLags) {
    const gap::Study study{{gap::form_of(drive::make_fopdt(1.0, 1.0, 0.0))}, {}, {}, {}, 0.01, 0.001, 0};
    gap::Candidate candidate;
    candidate.effects = {&gap::effect_named("load_disturbance"), &gap::effect_named("direction_asymmetry")};
    candidate.lasting = {
        {{"direction_asymmetry.tau_up_s", 0.5, 0.0, 1.0, 1.0}, {"direction_asymmetry.tau_down_s", 0.6, 0.0, 1.0, 1.0}}};
    gap::FreeParameter& up = candidate.lasting[0][0];
    gap::FreeParameter& down = candidate.lasting[0][1];
    up.low = 0.4, up.high = 0.54;
    down.low = 0.55, down.high = 0.65;
    EXPECT_EQ(gap::linear_of(study, candidate), "");
    up.high = 0.55;
    EXPECT_THAT(gap::linear_of(study, candidate), StartsWith("direction_asymmetry: "));
    std::swap(up, down);
    EXPECT_THAT(gap::linear_of(study, candidate), StartsWith("direction_asymmetry: "));
    candidate.effects[1] = &gap::effect_named("supply_sag");
    EXPECT_EQ(gap::linear_of(study, candidate), "");
}

// An upper tank that may never run over is one lag more; the lower one's own limit is no lag.
TEST(Linear, IsAnUpperTankThatMayNotRunOver) {
    gap::Study study{{gap::form_of(drive::make_fopdt(1.0, 1.0, 0.0))}, {}, {}, {}, 0.01, 0.001, 0};
    study.scales.output_high = 5.0;
    study.scales.output_span = 4.0;
    gap::Candidate candidate;
    candidate.effects = {&gap::effect_named("end_stop")};
    candidate.lasting = {{{"end_stop.limit", 4.9, 0.0, 5.08, 1.0},
                          {"end_stop.restitution", 0.0, 0.0, 0.9, 1.0},
                          {"end_stop.before_s", 2.0, 0.0, 9.0, 1.0},
                          {"end_stop.spill", 0.5, 0.0, 1.0, 1.0}}};
    gap::FreeParameter& limit = candidate.lasting[0][0];
    limit.high = 5.07;
    EXPECT_EQ(gap::linear_of(study, candidate), "");
    limit.high = 5.08;
    EXPECT_THAT(gap::linear_of(study, candidate), StartsWith("end_stop: its level may never reach"));
    candidate.lasting[0][2].value = 0.0;
    EXPECT_EQ(gap::linear_of(study, candidate), "");
}

// Between two levels of a staircase a threshold may lie anywhere: it moves no reading, and is known to the levels.
TEST(Intervals, OfAThresholdReachToTheLevelsBesideIt) {
    const gap::Question question = gap_test::question_of({{"start_up_threshold.threshold", 0.05}}, {.seed = 77},
                                                         {.experiment = "prbs", .low_duty = 0.02, .seed = 78});
    const gap::Ground ground = gap::prepare(question);
    gap::Candidate candidate = trained(ground, "start_up_threshold");
    EXPECT_EQ(gap::untold_of(ground.study, candidate), "");
    const gap::FreeParameter& threshold = candidate.lasting.front().front();
    std::set<double> levels;
    for (const gap::Course& course : ground.study.courses) {
        levels.insert(course.record().input.begin(), course.record().input.end());
    }
    const auto above = levels.upper_bound(0.05);
    ASSERT_NE(above, levels.begin());
    EXPECT_GT(threshold.low, *std::prev(above) - 0.01);
    EXPECT_LT(threshold.high, *above + 0.01);
    EXPECT_GT(threshold.high - threshold.low, 0.0);
}

TEST(Events, AreNeededOnlyWhereTheyHappened) {
    const gap_test::Sizes sizes = {
        {"load_disturbance.size", 0.02}, {"load_disturbance.from_s", 7.0}, {"load_disturbance.to_s", 9.0}};
    gap::Question question = gap_test::question_of(sizes, {.seed = 79}, {.seed = 80});
    question.train.push_back(gap_test::log_of({}, {.seed = 81}));
    const gap::Ground ground = gap::prepare(question);
    const gap::Candidate candidate = trained(ground, "load_disturbance");
    EXPECT_TRUE(gap::needs_event(ground.study, candidate.own[0], gap::effect_named("load_disturbance"), 0.0));
    EXPECT_FALSE(gap::needs_event(ground.study, candidate.own[1], gap::effect_named("load_disturbance"), 0.0));
}

}  // namespace
