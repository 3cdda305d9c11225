// The base that records have by themselves: plants integrated here in small steps, with a little noise.
#include "gap/drive/base/find.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "gap/drive/base/filtered.hpp"
#include "gap/drive/base/jointly.hpp"
#include "gap/drive/base/signs.hpp"
#include "gap/drive/base/structure.hpp"
#include "gap/drive/diagnose.hpp"
#include "gap/drive/verdict.hpp"

namespace {

constexpr double interval_s = 0.05;

// y'' = acceleration(u late, y, y'), read every 50 ms.
using Acceleration = std::function<double(double u, double y, double speed)>;

struct Run {
    std::function<double(double time_s)> input = {};
    double length_s = 60.0;
    double delay_s = 0.0;
    double y = 0.0;
    double speed = 0.0;
    double noise = 1e-3;
    unsigned seed = 1;
};

gap::Record run(const Acceleration& acceleration, const Run& of) {
    constexpr int substeps = 50;
    constexpr double step_s = interval_s / substeps;
    gap::Record record;
    record.name = "run";
    record.usual_interval_s = interval_s;
    std::mt19937_64 engine(of.seed);
    std::normal_distribution<double> noise;
    double y = of.y;
    double speed = of.speed;
    for (int k = 0; k * interval_s < of.length_s; ++k) {
        const double from_s = k * interval_s;
        record.time_s.push_back(from_s);
        record.input.push_back(of.input(from_s));
        record.output.push_back(y + of.noise * noise(engine));
        for (int i = 0; i < substeps; ++i) {
            const double late_s = from_s + (i + 0.5) * step_s - of.delay_s;
            // Held from its stamp to the next; nothing before the record.
            const double u = late_s < 0.0 ? 0.0 : of.input(std::floor(late_s / interval_s + 1e-9) * interval_s);
            const double middle = speed + 0.5 * step_s * acceleration(u, y, speed);
            y += step_s * middle;
            speed += step_s * acceleration(u, y - 0.5 * step_s * middle, middle);
        }
    }
    return record;
}

double levels(double time_s) {
    constexpr double held[] = {0.0, 1.0, 0.3, 0.8, -0.5, 0.6, -1.0, 0.2, 0.9, -0.3, 0.5, 0.0};
    return held[static_cast<int>(time_s / 5.0) % 12];
}
double other_levels(double time_s) { return levels(7.0 + 1.7 * time_s) - 0.2; }

gap::Question question_of(gap::Record train, gap::Record validate) {
    gap::Question question{
        gap::form_to_find(), true, {std::move(train)}, {std::move(validate)}, {}, gap::Metric::simulation, {}, 2};
    question.find = true;
    return question;
}

std::vector<gap::Described> found(const Acceleration& plant, Run train, Run validate) {
    train.input = train.input ? train.input : levels;
    validate.input = validate.input ? validate.input : other_levels;
    validate.seed = 2;
    return gap::find_base(question_of(run(plant, train), run(plant, validate)), [](const std::string&) {});
}

double value_of(drive::Form form, const std::string& name) { return form.parameter(name).value; }

TEST(Base, OfTwoLagsIsFoundWithItsDeadTime) {
    // 2 / ((1 + 0.5 s)(1 + 1.5 s)) = 2 / (1 + 2 s + 0.75 s^2)
    const auto plant = [](double u, double y, double speed) { return (2.0 * u - y - 2.0 * speed) / 0.75; };
    const auto all = found(plant, {.delay_s = 0.4}, {.delay_s = 0.4});
    ASSERT_EQ(all.front().name, "second_order");
    EXPECT_NEAR(value_of(all.front().form, "gain"), 2.0, 0.01);
    EXPECT_NEAR(value_of(all.front().form, "a1"), 2.0, 0.03);
    EXPECT_NEAR(value_of(all.front().form, "a2"), 0.75, 0.03);
    EXPECT_NEAR(value_of(all.front().form, "delay_s"), 0.4, 0.02);
    EXPECT_LT(all.front().validation, 0.003);
}

// A step of 1 / (1 + (T s)^0.5) goes by 1 - exp(t/T) erfc(sqrt(t/T)), a Mittag-Leffler function.
TEST(Base, OfHalfALagIsFoundWithItsOrder) {
    constexpr double lag_s = 1.3;
    const auto step = [](double time_s) {
        const double x = std::sqrt(std::max(time_s, 0.0) / lag_s);
        // Its asymptotic series beyond where the factors leave the range of doubles.
        return x < 20.0 ? 1.0 - std::exp(x * x) * std::erfc(x) : 1.0 - (1.0 - 0.5 / (x * x)) / (x * std::sqrt(M_PI));
    };
    const auto record = [&](const std::function<double(double)>& input, unsigned seed) {
        gap::Record made;
        made.name = "creeps";
        made.usual_interval_s = interval_s;
        std::mt19937_64 engine(seed);
        std::normal_distribution<double> noise(0.0, 1e-3);
        std::vector<std::pair<double, double>> moves;  // when, by how much
        for (int k = 0; k < 1200; ++k) {
            const double time_s = k * interval_s;
            const double u = input(time_s);
            const double before = made.input.empty() ? 0.0 : made.input.back();
            if (u != before) {
                moves.emplace_back(time_s, u - before);
            }
            double y = 0.0;
            for (const auto& [when_s, size] : moves) {
                y += size * step(time_s - when_s);
            }
            made.time_s.push_back(time_s);
            made.input.push_back(u);
            made.output.push_back(2.0 * y + noise(engine));
        }
        return made;
    };
    const auto all = gap::find_base(question_of(record(levels, 1), record(other_levels, 2)), [](const std::string&) {});
    ASSERT_EQ(all.front().name, "fractional_lag");
    EXPECT_NEAR(value_of(all.front().form, "alpha1"), 0.5, 0.01);
    EXPECT_NEAR(value_of(all.front().form, "a1"), std::sqrt(lag_s), 0.03);
    EXPECT_NEAR(value_of(all.front().form, "gain"), 2.0, 0.02);
    EXPECT_LT(all.front().validation, 0.01);
}

TEST(Base, OfAnOscillatorIsFound) {
    // wn = 4 rad/s, d = 0.05: 1 / (1 + 0.025 s + 0.0625 s^2)
    const auto plant = [](double u, double y, double speed) { return 16.0 * (u - y) - 0.4 * speed; };
    const auto all = found(plant, {}, {});
    ASSERT_EQ(all.front().name, "second_order");
    EXPECT_NEAR(value_of(all.front().form, "a2"), 0.0625, 5e-4);
    EXPECT_NEAR(value_of(all.front().form, "a1"), 0.025, 2e-3);
}

// 1 / (1 + 0.05 s + 0.25 s^2) and a quarter of 1 / (1 + 0.02 s + 0.02 s^2) beside it: an arm that bends.
TEST(Base, OfTwoModesIsFound) {
    const auto both = [](const std::function<double(double)>& input, unsigned seed) {
        gap::Record sum = run([](double u, double y, double speed) { return (u - y - 0.05 * speed) / 0.25; },
                              {.input = input, .seed = seed});
        const gap::Record second = run([](double u, double y, double speed) { return (u - y - 0.02 * speed) / 0.02; },
                                       {.input = input, .noise = 0.0});
        for (std::size_t i = 0; i < sum.size(); ++i) {
            sum.output[i] += 0.25 * second.output[i];
        }
        return sum;
    };
    const auto all = gap::find_base(question_of(both(levels, 1), both(other_levels, 2)), [](const std::string&) {});
    ASSERT_EQ(all.front().name, "two_modes");
    EXPECT_NEAR(value_of(all.front().form, "gain"), 1.25, 0.01);
    EXPECT_NEAR(value_of(all.front().form, "a4"), 0.25 * 0.02, 1e-4);
    EXPECT_LT(all.front().validation, 0.01);
    EXPECT_LT(20.0 * all.front().validation, all[1].validation);  // which has one mode
}

TEST(Base, ThatIntegratesIsToldFromOneThatRests) {
    const auto plant = [](double u, double, double speed) { return (0.5 * u - speed) / 0.8; };
    const auto all = found(plant, {}, {});
    ASSERT_EQ(all.front().name, "integrator_lag");
    EXPECT_NEAR(value_of(all.front().form, "gain"), 0.5, 0.01);
    EXPECT_NEAR(value_of(all.front().form, "a1"), 0.8, 0.05);
}

// Up a bent staircase a long dead time and a long lag do as well as the quick lag that there is: only the steps tell.
TEST(Base, OfABentStaircaseIsAsQuickAsItsSteps) {
    const auto plant = [](double u, double y, double speed) { return (std::sqrt(u) - y - 0.17 * speed) / 3e-3; };
    const auto up = [](double t) { return 0.1 * (1.0 + std::floor(t / 6.0)); };
    const auto down = [](double t) { return 1.0 - 0.1 * std::floor(t / 6.0); };
    const auto all = found(plant, {.input = up, .y = std::sqrt(0.1)}, {.input = down, .y = 1.0});
    const auto one_lag =
        std::find_if(all.begin(), all.end(), [](const gap::Described& one) { return one.name == "first_order"; });
    ASSERT_NE(one_lag, all.end());
    EXPECT_NEAR(value_of(one_lag->form, "a1") + value_of(one_lag->form, "delay_s"), 0.17, 0.02);
    // A drag makes of a long lag at rest a quick one where the steps are: beside it the lag may be eight times as long.
    const auto numbers = one_lag->form.parameters();
    const auto lag =
        std::find_if(numbers.begin(), numbers.end(), [](const drive::Parameter& one) { return one.name == "a1"; });
    EXPECT_NEAR(lag->upper / lag->lower, 8.0 * 8.0, 1e-9);
    EXPECT_NEAR(lag->upper / lag->value, 8.0, 2.0);
}

// A sensor that drifts is no lag that outlasts the record, with a zero beside it.
TEST(Base, OfADriftingSensorHasNoLagBeyondTheRecord) {
    const auto plant = [](double u, double y, double speed) { return (u - y - 2.01 * speed) / 0.02; };
    gap::Record train = run(plant, {.input = levels});
    gap::Record validate = run(plant, {.input = other_levels, .seed = 2});
    for (gap::Record* record : {&train, &validate}) {
        for (std::size_t i = 0; i < record->size(); ++i) {
            record->output[i] += 0.01 * record->time_s[i];
        }
    }
    const auto all = gap::find_base(question_of(train, validate), [](const std::string&) {});
    for (const gap::Described& one : all) {
        const auto numbers = one.form.parameters();
        for (const drive::Parameter& number : numbers) {
            EXPECT_TRUE(number.name != "a1" || number.value < 90.0) << one.name << ": " << number.value;
        }
    }
    EXPECT_EQ(all.front().name, "first_order");
}

TEST(Base, OfOneLagIsNoRicherOne) {
    // A second lag of 10 ms, far below the interval.
    const auto plant = [](double u, double y, double speed) { return (u - y - 2.01 * speed) / 0.02; };
    EXPECT_EQ(found(plant, {.noise = 0.01}, {.noise = 0.01}).front().name, "first_order");
}

TEST(Base, OfAFreeMotionIsItsSwing) {
    const auto plant = [](double, double y, double speed) { return -9.0 * y - 0.2 * speed; };
    const auto nothing = [](double) { return 0.0; };
    const auto all =
        found(plant, {.input = nothing, .length_s = 20.0, .y = 1.0}, {.input = nothing, .length_s = 20.0, .y = -0.6});
    ASSERT_EQ(all.front().name, "second_order");
    EXPECT_NEAR(value_of(all.front().form, "a2"), 1.0 / 9.0, 2e-3);
    EXPECT_NEAR(value_of(all.front().form, "a1"), 0.2 / 9.0, 2e-3);
    EXPECT_LT(all.front().validation, 0.02);
}

// What files and people are told of it.
TEST(Base, StandsInTheVerdictWithItsNumbers) {
    const auto plant = [](double u, double y, double speed) { return (2.0 * u - y - 2.0 * speed) / 0.75; };
    gap::Question question = question_of(run(plant, {.input = levels}), run(plant, {.input = other_levels, .seed = 2}));
    const gap::Answer answer = gap::diagnose(question, [](const std::string&) {});
    EXPECT_EQ(answer.decision.outcome, gap::Outcome::no_gap);
    const nlohmann::json base = nlohmann::json::parse(gap::to_json(answer)).at("base");
    EXPECT_EQ(base.at("form"), "second_order");
    EXPECT_NEAR(base.at("parameters").at("gain").get<double>(), 2.0, 0.01);
    EXPECT_LT(base.at("interval").at("gain")[0].get<double>(), 2.0);
    EXPECT_GT(base.at("interval").at("gain")[1].get<double>(), 2.0);
    EXPECT_GT(base.at("linear_share").get<double>(), 0.9999);
    EXPECT_LE(base.at("linear_share").get<double>(), 1.0);
    EXPECT_NEAR(base.at("records")[0].at("numbers").at("offset").get<double>(), 0.0, 0.01);
    EXPECT_THAT(gap::to_text(answer),
                testing::HasSubstr("the best linear description explains 100.0 % of the variance"));
    EXPECT_THAT(gap::to_html(answer), testing::HasSubstr("base: second_order"));
}

TEST(Base, IsRefusedByName) {
    EXPECT_EQ(gap::structure_named("second_ordre"), nullptr);
    EXPECT_EQ(gap::structure_named("third_order_zero")->numbers(), 5);
}

TEST(FilteredEstimates, OfACleanRecordAreItsCoefficients) {
    const auto plant = [](double u, double y, double speed) { return (2.0 * u - y - 2.0 * speed) / 0.75; };
    const gap::Record record = run(plant, {.input = levels, .noise = 0.0});
    double nearest = 1.0;
    for (const gap::Coefficients& one :
         gap::filtered_estimates(*gap::structure_named("second_order"), {record}, true)) {
        nearest = std::min(nearest, std::fabs(one.gain - 2.0) + std::fabs(one.denominator[0] - 2.0) +
                                        std::fabs(one.denominator[1] - 0.75));
    }
    EXPECT_LT(nearest, 0.02);
}

TEST(Signs, OfReadingsThatLostThemAreTheInputs) {
    const auto plant = [](double u, double y, double speed) { return (u - y - 0.6 * speed) / 0.05; };
    const gap::Record truth = run(plant, {.input = levels, .noise = 0.0});
    gap::Record lost = truth;
    for (double& z : lost.output) {
        z = std::fabs(z);
    }
    EXPECT_TRUE(gap::may_have_lost_signs({lost}));
    EXPECT_FALSE(gap::may_have_lost_signs({truth}));
    const gap::Record restored = gap::with_signs({lost}).front();
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        wrong += std::fabs(restored.output[i] - truth.output[i]) > 0.02 ? 1 : 0;
    }
    EXPECT_LT(wrong, truth.size() / 50);
}

// A record that ends before the plant has settled tells a slope: what it is on the way to, the validation alone says.
TEST(JointGap, GoesWhereTrainingAloneDoesNotTellTheBase) {
    const auto plant = [](double u, double y, double speed) { return (u - y - 60.0 * speed) / 1e-1; };
    const auto on = [](double t) { return t > 1.0 ? 1.0 : 0.0; };
    const auto off = [](double t) { return t > 1.0 && t < 200.0 ? 1.0 : 0.0; };
    gap::Question question = question_of(run(plant, {.input = on, .length_s = 8.0, .noise = 5e-3}),
                                         run(plant, {.input = off, .length_s = 400.0, .noise = 5e-3, .seed = 2}));
    question.form = gap::starts_of(*gap::structure_named("first_order"), question.train).whole;
    EXPECT_LT(gap::joint_gap(question), 0.03);
}

}  // namespace
