// Forms of a few coefficients that are fitted to rigs which have more: what takes most of the gap is named, though the
// form's own misfit stays. The rigs are integrated here, in small steps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "gap/drive/start.hpp"
#include "stand_case.hpp"

namespace {

using testing::Contains;
using testing::Each;
using testing::HasSubstr;

gap::Record record_of(const char* name, double interval_s) {
    gap::Record record;
    record.name = name;
    record.usual_interval_s = interval_s;
    return record;
}

// A mass with Coulomb friction, pushed to and fro by a smooth force, a constant one beside it: amplifiers drift.
gap::Record carriage(double constant_force, double turned_by, unsigned seed) {
    constexpr double friction = 0.6;
    constexpr int substeps = 50;
    constexpr double step_s = 0.01 / substeps;
    gap::Record record = record_of("carriage", 0.01);
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 2e-4);
    double position = 0.0;
    double speed = 0.0;
    for (int k = 0; k < 1500; ++k) {
        const double t = 0.01 * k;
        const double force = 2.5 * std::sin(turned_by + 1.5 * t + 0.2 * t * t);
        record.time_s.push_back(t);
        record.input.push_back(force);
        record.output.push_back(position + noise(engine));
        for (int i = 0; i < substeps; ++i) {
            const double pushed = speed + step_s * (force + constant_force - speed) / 0.2;
            const double held = step_s * friction / 0.2;
            speed = std::fabs(pushed) <= held ? 0.0 : pushed - std::copysign(held, pushed);
            position += step_s * speed;
        }
    }
    return record;
}

// Lags behind a thrust that grows with the square of the duty and falls with the motor's warmth. The duty changes every
// 2.5 s.
struct Propeller {
    double square = 0.6;  // share of the thrust
    double heat = 0.15;
    double lags_s[3] = {0.25, 0.2, 0.15};
    double noise = 1e-3;
};
gap::Record propeller(const Propeller& of, const std::vector<double>& duties, unsigned seed) {
    constexpr int substeps = 40;
    constexpr double step_s = 0.04 / substeps;
    gap::Record record = record_of("propeller", 0.04);
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, of.noise);
    double lags[3] = {};
    double warmth = 0.0;  // of the motor, which loses thrust by it: what no effect of the list does
    for (std::size_t k = 0; k < 62 * duties.size(); ++k) {
        const double duty = duties[k / 62];
        record.time_s.push_back(0.04 * static_cast<double>(k));
        record.input.push_back(duty);
        record.output.push_back(lags[2] + noise(engine));
        for (int i = 0; i < substeps; ++i) {
            warmth += step_s / 5.0 * (duty * duty - warmth);
            const double thrust = duty * (1.0 - of.square + of.square * duty) * (1.0 - of.heat * warmth);
            lags[0] += step_s / of.lags_s[0] * (thrust - lags[0]);
            lags[1] += step_s / of.lags_s[1] * (lags[0] - lags[1]);
            lags[2] += step_s / of.lags_s[2] * (lags[1] - lags[2]);
        }
    }
    return record;
}

gap::Answer diagnosed(const std::string& form, gap::Record train, gap::Record validate, gap::Metric metric) {
    const drive::Form start = gap::search_form(form, {train});
    const gap::Question question{start, true, {std::move(train)}, {std::move(validate)}, {}, metric, {}, 2};
    return gap::diagnose(question, [](const std::string&) {});
}

std::string text_of(const gap::Answer& answer) {
    std::string text;
    for (const gap::Ranked& ranked : answer.ranking) {
        text += ranked.trained.name() + ' ' + std::to_string(ranked.gap_after) + ' ' + std::to_string(ranked.score()) +
                '\n';
    }
    return text;
}

TEST(FittedBase, TakesAConstantForceForEachRecordsOwnWhereThePlantIntegrates) {
    const gap::Answer answer =
        diagnosed("integrator", carriage(0.15, 0.0, 1), carriage(-0.1, 1.3, 2), gap::Metric::prediction);
    ASSERT_NE(answer.decision.outcome, gap::Outcome::unknown) << text_of(answer);
    ASSERT_NE(answer.decision.outcome, gap::Outcome::no_gap) << text_of(answer);
    EXPECT_THAT(gap_test::names(answer), Each(HasSubstr("friction")));
    const gap::Ranked& chosen = answer.ranking[answer.decision.chosen];
    EXPECT_LT(chosen.gap_after, 0.3 * answer.none().gap_after) << text_of(answer);
}

const std::vector<double> climb = {0, 0.2, 0.4, 0.6, 0.8, 1.0, 0.7, 0.3, 0.1, 0.5, 0.9, 0};
const std::vector<double> steps = {0, 0.9, 0.3, 0.6, 0.1, 0.8, 0.2, 1.0, 0.5, 0};

TEST(FittedBase, NamesWhatTakesMostOfTheGapThoughItsOwnMisfitStays) {
    const gap::Answer answer =
        diagnosed("fopdt", propeller({}, climb, 1), propeller({}, steps, 2), gap::Metric::simulation);
    const gap::Ranked& chosen = answer.ranking[answer.decision.chosen];
    EXPECT_GT(chosen.gap_after, 0.1 * answer.none().gap_after) << "expected a misfit that stays";
    ASSERT_NE(answer.decision.outcome, gap::Outcome::unknown) << text_of(answer);
    EXPECT_THAT(gap_test::names(answer), Contains(HasSubstr("input_curve"))) << text_of(answer);
}

// Two lags whose input somebody else disturbs: what he does is filtered as the input is, and is no error of a model.
gap::Record disturbed(unsigned seed) {
    constexpr int substeps = 5;
    constexpr double step_s = 0.5 / substeps;
    gap::Record record = record_of("disturbed", 0.5);
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise;
    std::uniform_int_distribution<int> coin(0, 1);
    double level = 0.0;
    double lags[2] = {};
    for (int k = 0; k < 1200; ++k) {
        level = k % 20 == 0 ? coin(engine) : level;
        record.time_s.push_back(0.5 * k);
        record.input.push_back(level);
        record.output.push_back(lags[1] + 1e-3 * noise(engine));
        const double pushed = level + 0.5 * noise(engine);
        for (int i = 0; i < substeps; ++i) {
            lags[0] += step_s / 6.0 * (pushed - lags[0]);
            lags[1] += step_s / 3.0 * (lags[0] - lags[1]);
        }
    }
    return record;
}

TEST(FittedBase, HasNoGapWhereThePlantIsDisturbed) {
    const gap::Answer answer = diagnosed("second_order", disturbed(1), disturbed(2), gap::Metric::simulation);
    EXPECT_EQ(answer.decision.outcome, gap::Outcome::no_gap) << text_of(answer);
    EXPECT_TRUE(answer.decision.disturbed) << text_of(answer);
    EXPECT_FALSE(answer.leaves_noise);
    EXPECT_GT(answer.none().gap_after, 0.1);
}

// Two unequal lags, of which a form has two equal ones: what that leaves is a part of the noise.
TEST(FittedBase, HasNoGapWhereItsMisfitIsBelowTheNoise) {
    const Propeller linear{0.0, 0.0, {0.35, 0.2, 0.001}, 5e-3};
    const gap::Answer answer =
        diagnosed("sopdt", propeller(linear, climb, 3), propeller(linear, steps, 4), gap::Metric::simulation);
    EXPECT_EQ(answer.decision.outcome, gap::Outcome::no_gap) << text_of(answer);
}

// A second-order plant that swings, taken for one lag: what the form lacks is no effect.
TEST(FittedBase, NamesNothingForAFormThatIsTheWrongOne) {
    const gap::Answer answer =
        diagnosed("fopdt", gap_test::log_of({}, {.seed = 11}),
                  gap_test::log_of({}, {.experiment = "prbs", .low_duty = 0.02, .seed = 12}), gap::Metric::simulation);
    EXPECT_GT(answer.none().gap_after, 0.05);
    EXPECT_EQ(answer.decision.outcome, gap::Outcome::unknown) << text_of(answer);
    // The numbers of the base that is told have their intervals, whatever is suspected beside it: here a second lag, so
    // that the first one is any.
    EXPECT_TRUE(answer.decision.suspect) << text_of(answer);
    for (const gap::FreeParameter& number : answer.chosen().trained.base) {
        if (number.name != "delay_s") {
            EXPECT_LT(number.low, number.value) << number.name;
            EXPECT_GT(number.high, number.value) << number.name;
        }
        if (number.name == "gain") {
            EXPECT_GT(number.low, 0.5 * number.value);
            EXPECT_LT(number.high, 1.5 * number.value);
        }
    }
}

}  // namespace
