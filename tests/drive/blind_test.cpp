// Blind cases: the plant against exact responses and closed forms of its effects, what is planned, what is sealed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/failure.hpp"
#include "drive/log.hpp"
#include "drive/model_file.hpp"
#include "drive/response.hpp"
#include "drive/stand/blind/cases.hpp"
#include "drive/stand/blind/score.hpp"

namespace {

namespace blind = stand::blind;
using blind::Class;
using blind::Held;
using blind::Plant;
using blind::Unlisted;
using stand::Stand;

constexpr double interval_s = 0.01;

Plant second_order() {
    return {.gain = 2.0,
            .terms = {{0.09, 2.0}, {0.42, 1.0}, {1.0, 0.0}},
            .delay_s = 0.123,
            .full_input = 1.0,
            .full_output = 2.0};
}
Plant fractional() {
    return {.gain = 1.0, .terms = {{0.18234, 1.9909}, {0.65536, 0.98319}, {0.9992, 0.0}}, .delay_s = 0.2};
}
Plant half_order() { return {.gain = 1.0, .terms = {{0.5, 0.6}, {1.0, 0.0}}, .delay_s = 0.05}; }
Plant first_order() {
    return {.gain = 1.0, .terms = {{0.5, 1.0}, {1.0, 0.0}}, .delay_s = 0.0, .full_input = 1.0, .full_output = 1.0};
}

Held profile(const std::string& kind, double until_s = 20.0, double high = 1.0) {
    stand::Chance chance(5, 3);
    return blind::make_profile(kind, {interval_s, 0.001, until_s}, high, 0.4, chance);
}
Held constant(double level, double until_s) {
    Held held;
    for (int k = 0; k * interval_s <= until_s; ++k) {
        held.time_s.push_back(k * interval_s);
        held.input.push_back(level);
    }
    return held;
}

double largest_error(const Plant& plant, const Held& held, double step_s) {
    drive::Model model;
    model.gain = plant.gain;
    for (const auto& term : plant.terms) {
        model.denominator.push_back({term.coefficient, term.order});
    }
    model.delay_s = plant.delay_s;
    const auto exact = drive::respond(model, drive::changes_of(held.time_s, held.input), held.time_s);
    const auto stepped = blind::respond(plant, blind::no_effects(), {}, held, held.time_s, step_s);
    double largest = 0.0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
        largest = std::max(largest, std::fabs(exact[k] - stepped[k]));
    }
    return largest / blind::static_output(plant, 1.0);
}

// Well below a tenth of the smallest noise, 0.2 % of a deviation of about a third of the range.
TEST(BlindPlant, IsItsModelWithoutEffects) {
    EXPECT_LT(largest_error(second_order(), profile("levels"), 0.001), 2e-5);
    EXPECT_LT(largest_error(second_order(), profile("prbs"), 0.001), 2e-5);
    EXPECT_LT(largest_error(fractional(), profile("levels"), 0.002), 5e-5);
    EXPECT_LT(largest_error(half_order(), profile("staircase"), 0.002), 3e-3);  // starts like t^0.6
    EXPECT_LT(largest_error(first_order(), profile("staircase"), 0.001), 1e-3);
    // Of second order in the step.
    const double coarse = largest_error(second_order(), profile("levels"), 0.004);
    const double fine = largest_error(second_order(), profile("levels"), 0.002);
    EXPECT_NEAR(coarse / fine, 4.0, 1.0);
}

// Where the first order rests under a constant input of 0.8, 12 time constants on.
double rests_at(const std::function<void(Stand&)>& change, const Unlisted& unlisted = {}) {
    Stand effects = blind::no_effects();
    change(effects);
    const Held held = constant(0.8, 6.0);
    return blind::respond(first_order(), effects, unlisted, held, held.time_s, 0.001).back();
}

TEST(BlindPlant, ItsEffectsMeanWhatTheTableSays) {
    EXPECT_NEAR(rests_at([](Stand&) {}), 0.8, 1e-5);
    EXPECT_NEAR(rests_at([](Stand& s) { s.gain = 1.2; }), 0.96, 1e-5);
    EXPECT_NEAR(rests_at([](Stand& s) { s.input_limit = 0.5; }), 0.5, 1e-5);
    EXPECT_NEAR(rests_at([](Stand& s) { s.dead_zone = 0.1; }), 0.7, 1e-5);
    EXPECT_NEAR(rests_at([](Stand& s) { s.threshold = 0.9; }), 0.0, 1e-12);
    EXPECT_NEAR(rests_at([](Stand& s) { s.threshold = 0.7; }), 0.8, 1e-5);
    EXPECT_NEAR(rests_at([](Stand& s) { s.thrust_curvature = 0.5; }), 0.8 * (0.5 + 0.5 * 0.8), 1e-5);
    EXPECT_NEAR(rests_at([](Stand& s) { s.battery_resistance = 0.25; }), 0.8 * (1.0 - 0.25 * 0.8), 1e-5);
    EXPECT_NEAR(rests_at([](Stand& s) { s.friction = 0.1; }), 0.7, 1e-4);
    EXPECT_NEAR(rests_at([](Stand& s) { s.friction_up = 0.2; }), 0.6, 1e-4);
    EXPECT_NEAR(rests_at([](Stand& s) { s.friction_down = 0.2; }), 0.8, 1e-4);
    EXPECT_NEAR(rests_at([](Stand& s) { s.upper_stop_rad = 0.6; }), 0.6, 1e-12);
    EXPECT_NEAR(rests_at([](Stand& s) { s.backlash_rad = 0.1; }), 0.75, 1e-5);
    EXPECT_NEAR(rests_at([](Stand& s) { s.output_curvature = 0.5; }), 0.8 * (0.5 + 0.5 * 0.8), 1e-5);
    // sin(kappa y) / kappa = 0.8 w
    EXPECT_NEAR(rests_at([](Stand& s) { s.sine_per_unit = 1.0; }), std::asin(0.8), 1e-3);
    EXPECT_NEAR(rests_at([](Stand& s) {
                    s.disturbance_size = 0.3;
                    s.disturbance_to_s = 100.0;
                }),
                0.5, 1e-5);
    EXPECT_NEAR(rests_at([](Stand&) {}, {.stiffening = 1.0}), 0.59227, 1e-4);  // y + y^3 = 0.8
    EXPECT_NEAR(rests_at([](Stand&) {}, {.input_step = 0.5}), 1.0, 1e-5);
    EXPECT_NEAR(rests_at([](Stand&) {}, {.hysteresis = 0.2}), 0.7, 1e-5);
    // A resonance adds its share of the static deflection.
    EXPECT_NEAR(rests_at([](Stand& s) {
                    s.resonance_share = 0.1;
                    s.resonance_damping = 0.5;
                }),
                0.88, 1e-4);
}

double at(double t, const std::function<void(Stand&)>& change) {
    Stand effects = blind::no_effects();
    change(effects);
    const Held held = constant(1.0, 3.0);
    const std::vector<double> when{t};
    return blind::respond(first_order(), effects, {}, held, when, 0.001).front();
}

TEST(BlindPlant, ItsEffectsTakeTheirTime) {
    const auto first = [](double t) { return 1.0 - std::exp(-t / 0.5); };
    EXPECT_NEAR(at(1.0, [](Stand&) {}), first(1.0), 1e-5);
    EXPECT_NEAR(at(1.0, [](Stand& s) { s.extra_delay_s = 0.3; }), first(0.7), 1e-4);
    EXPECT_NEAR(at(1.0, [](Stand& s) { s.time_scale = 2.0; }), first(0.5), 1e-4);
    // Two lags, of 0.5 and 0.2 s, wherever the second one lies.
    const double two = 1.0 - (0.5 * std::exp(-1.0 / 0.5) - 0.2 * std::exp(-1.0 / 0.2)) / 0.3;
    EXPECT_NEAR(at(1.0, [](Stand& s) { s.motor_tau_s = 0.2; }), two, 1e-4);
    EXPECT_NEAR(at(1.0, [](Stand& s) { s.sensor_tau_s = 0.2; }), two, 1e-4);
    EXPECT_NEAR(at(1.0,
                   [](Stand& s) {
                       s.tau_up_s = 0.2;
                       s.tau_down_s = 0.05;
                   }),
                two, 1e-4);
    // A ramp of 0.5 /s into a first order: slope (t - tau (1 - exp(-t/tau))).
    EXPECT_NEAR(at(1.0, [](Stand& s) { s.rate_per_s = 0.5; }), 0.5 * (1.0 - 0.5 * first(1.0)), 1e-4);
    // Gain that grows by 0.1 /s: the same with a ramp added.
    EXPECT_NEAR(at(1.0, [](Stand& s) { s.drift_per_s = 0.1; }), first(1.0) + 0.1 * (1.0 - 0.5 * first(1.0)), 1e-4);
    EXPECT_NEAR(at(1.0, [](Stand& s) { s.sag_per_unit_s = 0.1; }), first(1.0) - 0.1 * (1.0 - 0.5 * first(1.0)), 1e-4);
}

TEST(BlindPlans, HoldTheirShares) {
    for (const std::uint64_t seed : {1U, 2U}) {
        const auto plans = blind::plan_cases(100, seed);
        std::map<Class, int> count;
        int new_profiles = 0;
        std::map<std::string, int> single;
        for (const auto& plan : plans) {
            ++count[plan.kind];
            new_profiles += plan.new_profile ? 1 : 0;
            if (plan.kind == Class::single) {
                ++single[plan.effects.front()];
            }
        }
        EXPECT_EQ(plans.size(), 100U);
        EXPECT_EQ(count[Class::none], 25);
        EXPECT_EQ(count[Class::unlisted], 15);
        EXPECT_EQ(count[Class::pair], 15);
        EXPECT_EQ(count[Class::same], 8);
        EXPECT_EQ(count[Class::single], 37);
        EXPECT_EQ(new_profiles, 13);
        EXPECT_GT(single.size(), 18U);  // of 28: dealt like cards
        for (const auto& [effect, times] : single) {
            EXPECT_LE(times, 3) << effect;
        }
    }
    // The place of a case says nothing.
    EXPECT_NE(blind::plan_cases(100, 1)[0].kind, Class::none);
    EXPECT_THROW((void)blind::plan_cases(0, 1), glsum::Failure);
    EXPECT_THROW((void)blind::plan_cases(1000, 1), glsum::Failure);
}

std::vector<double> column(const drive::Log& log, const std::vector<double>& exact) {
    std::vector<double> difference;
    for (std::size_t k = 0; k < exact.size(); ++k) {
        difference.push_back(log.output[k] - exact[k]);
    }
    return difference;
}
double rms(const std::vector<double>& values) {
    double square = 0.0;
    for (const double value : values) {
        square += value * value / static_cast<double>(values.size());
    }
    return std::sqrt(square);
}

// Of each kind of plant: without an effect the logs are the model's exact response and noise of the size that is
// sealed.
TEST(BlindCases, WithoutAnEffectAreTheirModelAndNoise) {
    std::map<std::string, int> seen;
    for (std::size_t number = 1; number <= 6; ++number) {
        const blind::Case made = blind::make_case({}, 11, number);
        ++seen[made.truth.plant];
        const drive::Model model = drive::parse_model(made.model, "model.json");
        const drive::Log log = drive::parse_log(made.validate, "validate.csv");
        if (made.truth.validate == "chirp" || made.truth.validate == "ramp") {
            continue;  // thousands of changes: the exact response takes long
        }
        const auto exact = drive::respond(model, drive::changes_of(log.time_s, log.input), log.time_s);
        EXPECT_NEAR(rms(column(log, exact)) / made.truth.noise, 1.0, 0.25) << number << ' ' << made.truth.plant;
        EXPECT_NEAR(made.truth.gap_base, made.truth.noise_floor, 1e-12);
    }
    EXPECT_EQ(seen.size(), 3U);
}

TEST(BlindCases, AreFixedByTheirSeed) {
    const blind::Plan plan{Class::single, {"backlash"}, {blind::EffectSize::clear}, false};
    const blind::Case once = blind::make_case(plan, 3, 7);
    const blind::Case again = blind::make_case(plan, 3, 7);
    EXPECT_EQ(once.train, again.train);
    EXPECT_EQ(once.validate, again.validate);
    EXPECT_EQ(once.model, again.model);
    EXPECT_NE(once.train, blind::make_case(plan, 3, 8).train);
    EXPECT_NE(once.train, blind::make_case(plan, 4, 7).train);
}

// Every effect shows in its logs, and more than the noise does; excitations differ.
TEST(BlindCases, ShowTheirEffects) {
    std::vector<std::string> all = blind::listed_effects();
    all.insert(all.end(), blind::unlisted_effects().begin(), blind::unlisted_effects().end());
    std::size_t number = 0;
    std::map<std::string, int> plants;
    for (const std::string& effect : all) {
        ++number;
        const bool listed = number <= blind::listed_effects().size();
        const blind::Plan plan{listed ? Class::single : Class::unlisted, {effect}, {blind::EffectSize::clear}, false};
        const blind::Case made = blind::make_case(plan, 21, number);
        EXPECT_GE(made.truth.train_deviation, 1.0) << effect;
        EXPECT_GE(made.truth.validate_deviation, 1.0) << effect;
        EXPECT_GT(made.truth.gap_base, made.truth.noise_floor) << effect;
        EXPECT_NE(made.truth.train, made.truth.validate);
        const drive::Log train = drive::parse_log(made.train, "train.csv");
        EXPECT_GE(train.output.size(), 1000U);
        EXPECT_NO_THROW((void)drive::parse_log(made.validate, "validate.csv"));
        const drive::Model model = drive::parse_model(made.model, "model.json");
        ++plants[made.truth.plant];
        const bool whole = std::ranges::all_of(
            model.denominator, [](const drive::Term& term) { return term.order == std::round(term.order); });
        EXPECT_EQ(whole, made.truth.plant != "fractional") << made.truth.plant << ' ' << made.model;
    }
    EXPECT_GE(plants["whole"], 3);
    EXPECT_GE(plants["fractional"], 3);
}

TEST(BlindCases, ThatAreTheSameAsOthersHoldOneLevel) {
    const blind::Plan plan{Class::same, {"input_dead_zone"}, {blind::EffectSize::clear}, false};
    const blind::Case made = blind::make_case(plan, 5, 1);
    EXPECT_THAT(made.truth.required, testing::UnorderedElementsAre("gain_error", "input_dead_zone"));
    std::map<double, int> levels;
    for (const std::string& text : {made.train, made.validate}) {
        for (const double u : drive::parse_log(text, "log.csv").input) {
            ++levels[u];
        }
    }
    EXPECT_EQ(levels.size(), 2U);
    for (const char* effect : {"gain_error", "input_saturation", "input_curve", "supply_sag"}) {
        EXPECT_GE(
            blind::make_case({Class::same, {effect}, {blind::EffectSize::clear}, false}, 5, 3).truth.train_deviation,
            1.0)
            << effect;
    }
    const blind::Case lag = blind::make_case({Class::same, {"sensor_lag"}, {blind::EffectSize::large}, false}, 5, 2);
    EXPECT_THAT(lag.truth.required, testing::UnorderedElementsAre("actuator_lag", "sensor_lag"));
}

TEST(BlindCases, PairsAreSeenEachBesideTheOther) {
    const blind::Plan plan{
        Class::pair, {"backlash", "input_dead_zone"}, {blind::EffectSize::clear, blind::EffectSize::clear}, false};
    const blind::Case made = blind::make_case(plan, 9, 4);
    EXPECT_EQ(made.truth.parameters.size(), 2U);
    EXPECT_TRUE(made.truth.parameters[0].contains("gap"));
    EXPECT_TRUE(made.truth.parameters[1].contains("width"));
}

TEST(BlindCases, AreSealedAsTheyAreOpened) {
    std::vector<blind::Truth> truths{
        blind::make_case({}, 2, 1).truth,
        blind::make_case({Class::single, {"load_disturbance"}, {blind::EffectSize::large}, false}, 2, 2).truth,
        blind::make_case({Class::same, {"gain_error"}, {blind::EffectSize::large}, false}, 2, 3).truth};
    const auto opened = blind::parse_sealed(blind::seal(2, truths), "truth.sealed.json");
    ASSERT_EQ(opened.size(), 3U);
    EXPECT_EQ(opened[0].name, "001");
    EXPECT_EQ(opened[0].kind, "none");
    EXPECT_EQ(opened[1].effects, std::vector<std::string>{"load_disturbance"});
    EXPECT_EQ(opened[1].size, "large");
    ASSERT_EQ(opened[1].where.size(), 1U);
    EXPECT_LT(opened[1].where[0].from_s, opened[1].where[0].to_s);
    EXPECT_EQ(opened[2].required, std::vector<std::string>{"gain_error"});
    EXPECT_DOUBLE_EQ(opened[1].gap_base, truths[1].gap_base);
}

}  // namespace
