// Verdicts on logs of the virtual stand whose effect is known.
#include "gap/drive/verdict.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <random>

#include "base/failure.hpp"
#include "gap/drive/question.hpp"
#include "gap/drive/ranking.hpp"
#include "gap/drive/start.hpp"
#include "stand_case.hpp"

namespace {

using gap::Outcome;
using gap_test::ask;
using gap_test::names;
using gap_test::Sizes;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::string text_of(const gap::Answer& answer) { return gap::to_text(answer); }

struct Known {
    const char* effect;
    Sizes sizes;
    const char* parameter;  ///< of the effect
    double expected;
    double tolerance;
};

void PrintTo(const Known& known, std::ostream* out) { *out << known.effect; }

class KnownEffect : public testing::TestWithParam<Known> {};

TEST_P(KnownEffect, IsNamedWithItsSize) {
    const Known& known = GetParam();
    const gap::Answer answer = ask(known.sizes);
    ASSERT_EQ(answer.decision.outcome, Outcome::attributed) << text_of(answer);
    ASSERT_THAT(names(answer), ElementsAre(known.effect)) << text_of(answer);
    const auto* parameter = gap_test::find(answer, std::string(known.effect) + "." + known.parameter);
    ASSERT_NE(parameter, nullptr);
    EXPECT_NEAR(parameter->value, known.expected, known.tolerance) << text_of(answer);
    EXPECT_LT(answer.chosen().gap_after, answer.decision.base_gap);
    EXPECT_LE(answer.decision.noise_floor, answer.chosen().gap_after * (1.0 + 1e-12));
}

INSTANTIATE_TEST_SUITE_P(
    Gap, KnownEffect,
    testing::Values(
        Known{"input_dead_zone", {{"input_dead_zone.width", 0.015}}, "width", 0.015, 1e-3},
        Known{"input_saturation", {{"input_saturation.limit", 0.08}}, "limit", 0.08, 1e-3},
        Known{"gain_error", {{"gain_error.gain", 0.9}}, "gain", 0.9, 5e-3},
        Known{"time_scale_error", {{"time_scale_error.scale", 1.15}}, "scale", 1.15, 0.02},
        Known{"dead_time_error", {{"dead_time_error.extra_s", 0.06}}, "extra_s", 0.06, 5e-3},
        Known{"rate_limit", {{"rate_limit.per_s", 0.1}}, "per_s", 0.1, 0.01},
        Known{"gain_drift", {{"gain_drift.per_s", -0.01}}, "per_s", -0.01, 1e-3},
        Known{"coulomb_friction",
              {{"coulomb_friction.force", 0.006}, {"coulomb_friction.stiction", 1.0}},
              "force",
              0.006,
              6e-4},
        Known{"gravity_nonlinearity", {{"gravity_nonlinearity.angle_per_unit", 1.0}}, "angle_per_unit", 1.0, 0.05},
        Known{"end_stop", {{"end_stop.limit", 0.8}}, "limit", 0.8, 0.01},
        Known{"backlash", {{"backlash.gap", 0.06}}, "gap", 0.06, 6e-3},
        Known{"sensor_offset", {{"sensor_offset.offset", 0.03}}, "offset", 0.03, 2e-3},
        Known{"sensor_drift", {{"sensor_drift.per_s", 0.003}}, "per_s", 0.003, 3e-4},
        Known{"sensor_saturation", {{"sensor_saturation.limit", 0.7}}, "limit", 0.7, 0.01},
        Known{"direction_asymmetry",
              {{"direction_asymmetry.tau_up_s", 0.02}, {"direction_asymmetry.tau_down_s", 0.2}},
              "tau_down_s",
              0.2,
              0.02},
        Known{"sampling_jitter", {{"sampling_jitter.half_width_s", 0.015}}, "half_width_s", 0.015, 3e-3}),
    [](const auto& known) { return std::string(known.param.effect); });

// Each effect may be absent: with it a fit goes as far as without, but for what a narrow valley keeps it from.
TEST(Candidates, NeverFitAFittedBaseMuchWorseThanNoEffectDoes) {
    gap::Question question = gap_test::question_of({{"backlash.gap", 0.1}}, {.seed = 41},
                                                   {.experiment = "prbs", .low_duty = 0.02, .seed = 42});
    question.form = gap::search_form("sopdt", question.train);
    question.refit = true;
    const gap::Answer answer = gap::diagnose(question, [](const std::string&) {});
    for (const gap::Ranked& ranked : answer.ranking) {
        if (ranked.trained.effects.size() == 1 && ranked.trained.name() != "missed_counts") {
            EXPECT_LE(ranked.trained.cost, 1.15 * answer.none().trained.cost) << ranked.trained.name();
        }
    }
}

TEST(Verdict, OfAPerfectModelIsNoGapWhateverTheNoise) {
    for (const double colour : {0.0, 0.9}) {
        for (const char* experiment : {"prbs", "chirp", "ramp"}) {
            const gap::Answer answer = ask({}, {.seed = 3, .colour = colour},
                                           {.experiment = experiment, .duty = 0.12, .seed = 4, .colour = colour});
            EXPECT_EQ(answer.decision.outcome, Outcome::no_gap) << experiment << '\n' << text_of(answer);
        }
    }
}

TEST(Ranking, OfWhatRanAwayIsANumberAndLast) {
    const gap::Question question = gap_test::question_of({}, {.seed = 37}, {.experiment = "prbs", .seed = 38});
    const gap::Ground ground = gap::prepare(question);
    const gap::Candidate none = gap::fit(ground.study, {}, {}, nullptr);
    const gap::Whitener whitener = gap::whitener_of(ground.study, none);
    const gap::Ranked usual = gap::validated(ground.validation, none, whitener, nullptr, false);
    gap::Ranked away = usual;
    for (double& residual : away.residuals.front()) {
        residual = std::nan("");
    }
    gap::judge(away, ground.validation, whitener);
    EXPECT_TRUE(std::isfinite(away.score()));
    EXPECT_LT(away.score(), usual.score());
}

// A likelihood is of every reading that counts, and of no other; what it is worth is that less the penalty.
TEST(Ranking, CountsEveryReadingOnce) {
    const gap::Question question = gap_test::question_of({}, {.seed = 37}, {.experiment = "prbs", .seed = 38});
    gap::Ground ground = gap::prepare(question);
    const gap::Candidate none = gap::fit(ground.study, {}, {}, nullptr);
    const gap::Whitener whitener = gap::whitener_of(ground.study, none);
    const gap::Ranked whole = gap::validated(ground.validation, none, whitener, nullptr, false);
    std::size_t readings = 0;
    for (const auto& counts : ground.validation.counts) {
        readings += static_cast<std::size_t>(std::count(counts.begin(), counts.end(), 1));
    }
    EXPECT_EQ(whole.by_sample.size(), readings);
    EXPECT_NEAR(whole.log_likelihood, std::accumulate(whole.by_sample.begin(), whole.by_sample.end(), 0.0),
                1e-9 * std::fabs(whole.log_likelihood));
    EXPECT_EQ(whole.score(), whole.log_likelihood - whole.penalty);
    // The first and the last left out are theirs, and theirs alone.
    auto& counts = ground.validation.counts.front();
    counts.front() = 0;
    counts.back() = 0;
    gap::Ranked fewer = whole;
    gap::judge(fewer, ground.validation, whitener);
    EXPECT_EQ(fewer.by_sample.size(), readings - 2);
    EXPECT_EQ(fewer.by_sample.front(), whole.by_sample[1]);
}

TEST(Verdict, OfTwoEffectsIsTheirPair) {
    const gap::Answer answer = ask({{"input_dead_zone.width", 0.015}, {"sensor_drift.per_s", 0.005}}, 2);
    ASSERT_EQ(answer.decision.outcome, Outcome::attributed) << text_of(answer);
    EXPECT_THAT(names(answer), ElementsAre(testing::AllOf(HasSubstr("input_dead_zone"), HasSubstr("sensor_drift"))));
}

TEST(Verdict, NamesJitterBesideAnotherEffect) {
    const gap::Answer answer =
        ask({{"input_saturation.limit", 0.08}, {"sampling_jitter.half_width_s", 0.015}},
            {.experiment = "prbs", .low_duty = 0.02, .seed = 61}, {.experiment = "prbs", .low_duty = 0.04, .seed = 62});
    ASSERT_EQ(answer.decision.outcome, Outcome::attributed) << text_of(answer);
    EXPECT_THAT(names(answer), ElementsAre("input_saturation + sampling_jitter"));
}

// A chirp passes a threshold between two logged levels: the misfit must lead there.
TEST(Verdict, FindsAThresholdThatAChirpPasses) {
    const gap::Answer answer = ask({{"start_up_threshold.threshold", 0.0453}}, {.experiment = "chirp", .seed = 63},
                                   {.experiment = "chirp", .duty = 0.09, .seed = 64});
    ASSERT_EQ(answer.decision.outcome, Outcome::attributed) << text_of(answer);
    EXPECT_THAT(names(answer), ElementsAre("start_up_threshold"));
    EXPECT_NEAR(gap_test::find(answer, "start_up_threshold.threshold")->value, 0.0453, 5e-4) << text_of(answer);
}

// A step of a tenth of the output's span hides what moves less, and says exactly which values a reading stands for.
TEST(Verdict, NamesACoarseEncoderAloneAndBesideAnotherEffect) {
    const gap::Answer alone = ask({{"encoder_quantisation.step", 0.1}}, 7);
    EXPECT_THAT(names(alone), ElementsAre("encoder_quantisation")) << text_of(alone);
    const gap::Answer pair = ask({{"encoder_quantisation.step", 0.1}, {"gain_error.gain", 0.85}}, 8);
    ASSERT_EQ(pair.decision.outcome, Outcome::attributed) << text_of(pair);
    EXPECT_THAT(names(pair), ElementsAre(testing::AllOf(HasSubstr("encoder_quantisation"), HasSubstr("gain_error"))));
}

// Nearly every log is one of an encoder: its step is no cause of a gap that is many times larger.
TEST(Verdict, DoesNotNameAFineEncoder) {
    const gap::Answer answer = ask({{"encoder_quantisation.step", 0.00628}, {"input_saturation.limit", 0.08}}, 9);
    ASSERT_EQ(answer.decision.outcome, Outcome::attributed) << text_of(answer);
    EXPECT_THAT(names(answer), ElementsAre("input_saturation"));
}

TEST(Verdict, OnOneLevelCannotPartWhatEqualsAGain) {
    const gap::Answer answer =
        ask({{"input_dead_zone.width", 0.02}}, {.experiment = "step", .seed = 5}, {.experiment = "pulse", .seed = 6});
    EXPECT_EQ(answer.decision.outcome, Outcome::ambiguous) << text_of(answer);
    // Three of many, the gain's own error among them.
    EXPECT_EQ(names(answer).size(), 3U);
    EXPECT_THAT(names(answer), Contains("gain_error"));
    EXPECT_THAT(names(answer),
                testing::IsSubsetOf({"gain_error", "input_dead_zone", "input_saturation", "input_curve", "supply_sag",
                                     "start_up_threshold", "input_hysteresis", "output_curve"}));
    EXPECT_THAT(answer.next_experiment, HasSubstr("staircase"));
}

TEST(Verdict, CannotPartLagsThatCommute) {
    const gap::Answer answer = ask({{"sensor_lag.tau_s", 0.1}}, 3);
    EXPECT_EQ(answer.decision.outcome, Outcome::ambiguous) << text_of(answer);
    EXPECT_THAT(names(answer), testing::IsSupersetOf({"sensor_lag", "actuator_lag"}));
    EXPECT_THAT(answer.next_experiment, HasSubstr("no input parts them"));
}

// Cogging: a force that waves over the angle is on no list.
gap::Record with_cogging(gap::Record record, double size) {
    const gap::Course course(record, 4);
    gap::Scenario scenario;
    scenario.model = gap::model_of(gap_test::linear_form());
    const std::vector<double> nodes = course.nodes_of(scenario);
    const std::vector<double> plain = gap::read_at(course.grid(), nodes, record.time_s);
    for (std::size_t i = 0; i < record.size(); ++i) {
        record.output[i] += size * std::sin(9.0 * plain[i]);
    }
    return record;
}

TEST(Verdict, OfWhatIsNotListedIsUnknown) {
    // The smaller one is neither slow nor a burst beside the noise: that it can be foreseen is all that tells.
    for (const double size : {0.05, 0.02}) {
        gap::Question question =
            gap_test::question_of({}, {.seed = 31}, {.experiment = "prbs", .low_duty = 0.02, .seed = 32});
        for (auto* records : {&question.train, &question.validate}) {
            records->front() = with_cogging(records->front(), size);
        }
        const gap::Answer answer = gap::diagnose(question, [](const std::string&) {});
        EXPECT_EQ(answer.decision.outcome, Outcome::unknown) << text_of(answer);
        EXPECT_TRUE(answer.decision.effects.empty());
        EXPECT_LT(answer.decision.noise_floor, 0.7 * answer.decision.base_gap);
    }
}

// Both records with something added to the readings, a function of time.
template <class Added>
gap::Answer ask_with(const Added& added) {
    gap::Question question =
        gap_test::question_of({}, {.seed = 33}, {.experiment = "prbs", .low_duty = 0.02, .seed = 34});
    for (auto* records : {&question.train, &question.validate}) {
        for (std::size_t i = 0; i < records->front().size(); ++i) {
            records->front().output[i] += added(records->front().time_s[i]);
        }
    }
    return gap::diagnose(question, [](const std::string&) {});
}

TEST(Verdict, OfAWaveThatTheInputDoesNotHaveIsUnknown) {
    const gap::Answer answer =
        ask_with([](double t) { return 0.006 * std::sin(2.0 * std::numbers::pi * 1.3 * t + 0.5); });
    EXPECT_EQ(answer.decision.outcome, Outcome::unknown) << text_of(answer);
    EXPECT_THAT(answer.notes, Contains(HasSubstr("a wave of 1.3 Hz"))) << text_of(answer);
}

TEST(Verdict, OfABurstThatNothingListedMakesIsUnknown) {
    const gap::Answer answer =
        ask_with([](double t) { return t > 5.0 && t < 5.4 ? 0.05 * std::sin(2.0 * std::numbers::pi * 7.0 * t) : 0.0; });
    EXPECT_EQ(answer.decision.outcome, Outcome::unknown) << text_of(answer);
    EXPECT_THAT(answer.notes, Contains(HasSubstr("times as loud from"))) << text_of(answer);
}

// Every order by as much, each in proportion, the highest alone: drives differ in each of these ways.
TEST(Verdict, NamesOrdersThatDifferInAnyWay) {
    const drive::Model given = gap::model_of(gap_test::linear_form());
    const double highest = drive::highest_order(given.denominator);
    for (const double power : {0.0, 1.0, 8.0}) {
        gap::Scenario real;
        real.model = given;
        for (drive::Term& term : real.model.denominator) {
            const double share = power == 0.0 ? 1.0 : power == 1.0 ? term.order / highest : term.order == highest;
            term.order -= term.order > 0.0 ? 0.1 * share : 0.0;
        }
        gap::Question question =
            gap_test::question_of({}, {.seed = 35}, {.experiment = "prbs", .low_duty = 0.02, .seed = 36});
        for (auto* records : {&question.train, &question.validate}) {
            gap::Record& record = records->front();
            const gap::Course course(record, 8);
            gap::Scenario plain;
            plain.model = given;
            const std::vector<double> usual = gap::simulate(plain, course);
            const std::vector<double> moved = gap::simulate(real, course);
            for (std::size_t i = 0; i < record.size(); ++i) {
                record.output[i] += moved[i] - usual[i];
            }
        }
        const gap::Answer answer = gap::diagnose(question, [](const std::string&) {});
        ASSERT_THAT(names(answer), ElementsAre("order_error")) << power << text_of(answer);
        EXPECT_NEAR(gap_test::find(answer, "order_error.shift")->value, -0.1, 0.01) << power;
        EXPECT_EQ(gap_test::find(answer, "order_error.power")->value, power);
    }
}

TEST(Verdict, OfAnEffectThatIsTakenOffTheListIsNotAnother) {
    for (const auto& [effect, sizes] :
         {std::pair<std::string, Sizes>{"backlash", {{"backlash.gap", 0.1}}},
          std::pair<std::string, Sizes>{"sensor_saturation", {{"sensor_saturation.limit", 0.6}}}}) {
        const gap::Answer answer = ask(sizes, 4, {effect});
        EXPECT_THAT(names(answer), Not(Contains(HasSubstr(effect))));
        EXPECT_TRUE(answer.decision.outcome == Outcome::unknown || answer.decision.confidence < 0.97)
            << text_of(answer);
        EXPECT_GT(answer.chosen().gap_after, 1.5 * 0.003 / 0.3) << text_of(answer);  // what is left is reported
    }
}

TEST(Verdict, AsAFileHoldsWhatItPromises) {
    const gap::Answer answer = ask({{"input_dead_zone.width", 0.02}}, 5);
    const auto file = nlohmann::json::parse(gap::to_json(answer));
    EXPECT_EQ(file["schema"], "glsum-gap-1");
    for (const char* list : {"time", "frequency", "input_level", "output_level"}) {
        double sum = 0.0;
        for (const auto& share : file["where"][list]) {
            sum += share["share"].get<double>();
        }
        EXPECT_NEAR(sum, 1.0, 1e-9) << list;
    }
    const auto& direction = file["where"]["direction"];
    EXPECT_NEAR(
        direction["rising"].get<double>() + direction["falling"].get<double>() + direction["still"].get<double>(), 1.0,
        1e-9);
    // The gap is what anyone computes from the log and the model: rms of measured - simulated over the deviation.
    const gap::Record& record = answer.records.front();
    double mean = 0.0;
    for (const double z : record.output) {
        mean += z / static_cast<double>(record.size());
    }
    double squares = 0.0;
    double deviation = 0.0;
    for (std::size_t i = 0; i < record.size(); ++i) {
        squares += answer.none().residuals[0][i] * answer.none().residuals[0][i];
        deviation += (record.output[i] - mean) * (record.output[i] - mean);
    }
    EXPECT_NEAR(file["gap"]["base"].get<double>(), std::sqrt(squares / deviation), 1e-9);
    const auto& effect = file["effects"][0];
    const double base = file["gap"]["base"];
    const double floor = file["gap"]["noise_floor"];
    EXPECT_NEAR(effect["shrink"].get<double>(), (base - effect["gap_after"].get<double>()) / (base - floor), 1e-9);
    const double width = effect["parameters"]["width"];
    EXPECT_LT(effect["interval"]["width"][0], width);
    EXPECT_GT(effect["interval"]["width"][1], width);
    EXPECT_LT(effect["interval"]["width"][0].get<double>(), 0.02);
    EXPECT_GT(effect["interval"]["width"][1].get<double>(), 0.02);
    EXPECT_THAT(gap::improved_model(answer), HasSubstr("input_dead_zone"));
}

std::string message_of(const gap::Question& question) {
    try {
        (void)gap::diagnose(question, [](const std::string&) {});
    } catch (const glsum::Failure& failure) {
        return failure.what();
    }
    return "no failure";
}

// A base that is fitted to y' - y = u, as e^t grows by 20 in the 3 s of the training and by 10^17 in the 40 of the
// other.
TEST(Verdict, IsRefusedWhereAFittedBaseRunsAwayOnTheOtherRecord) {
    std::mt19937_64 engine(1);
    std::normal_distribution<double> noise(0.0, 1e-3);
    gap::Record train;
    train.name = "short";
    train.usual_interval_s = 0.01;
    gap::Record validate = train;
    validate.name = "long";
    double y = 0.0;
    for (int k = 0; k < 300; ++k) {
        const double u = k < 100 ? 0.1 : -0.02;
        train.time_s.push_back(0.01 * k);
        train.input.push_back(u);
        train.output.push_back(y + noise(engine));
        y = y * std::exp(0.01) + u * std::expm1(0.01);
    }
    for (int k = 0; k < 4000; ++k) {
        validate.time_s.push_back(0.01 * k);
        validate.input.push_back(std::sin(0.01 * k));
        validate.output.push_back(std::sin(0.01 * k - 0.5) + noise(engine));
    }
    drive::Model start;  // not far from what it is: whether a fit gets there from elsewhere is no matter here
    start.denominator = {{0.02, 1.9}, {1.0, 0.98}, {-0.9, 0.0}};
    const gap::Question question{
        drive::Form(drive::Kind::niopdt, start), true, {train}, {validate}, {}, gap::Metric::simulation, {}, 2};
    EXPECT_THAT(message_of(question), HasSubstr("runs away"));
}

TEST(Verdict, IsRefusedWhereModelAndLogCannotBelongTogether) {
    gap::Question question{
        gap_test::linear_form(), false, {gap_test::log_of({}, {})}, {}, std::nullopt, gap::Metric::simulation, {}, 1};
    for (double& angle : question.train[0].output) {
        angle *= 1000.0;
    }
    EXPECT_THAT(message_of(question), HasSubstr("expected the model's units"));
    question.train = {gap_test::log_of({}, {})};
    for (double& t : question.train[0].time_s) {
        t *= 1000.0;
    }
    question.train[0].usual_interval_s *= 1000.0;
    EXPECT_THAT(message_of(question), HasSubstr("are the stamps in seconds?"));
    question.train = {gap_test::log_of({}, {})};
    question.form.parameter("delay_s").value = 25.0;
    EXPECT_THAT(message_of(question), HasSubstr("expected a log longer than the model's dead time"));
}

}  // namespace
