// The plants that blind cases draw by chance: each number between its bounds, and up to them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "drive/model_file.hpp"
#include "drive/stand/blind/family.hpp"
#include "drive/stand/blind/mechanical.hpp"
#include "tests/drive/seen.hpp"

namespace {

namespace blind = stand::blind;
using stand::Chance;
using test::expect_between;
using test::Seen;

constexpr int plants = 4000;

TEST(Drawn, StandsLieBetweenTheirBounds) {
    Chance chance(1, 5);
    Seen inertia, thrust, gravity, damping, delay, lift, samples;
    std::set<double> spreads;
    for (int k = 0; k < plants; ++k) {
        const auto base = blind::draw_mechanical(true, false, chance);
        const auto& built = base.setup.stand;
        EXPECT_EQ(base.kind, "stand");
        EXPECT_TRUE(base.setup.physical);
        EXPECT_EQ(base.clock.interval_s, 0.01);
        EXPECT_EQ(built.interval_s, base.clock.interval_s);
        EXPECT_EQ(built.spread_s, base.clock.spread_s);
        inertia(built.inertia_kg_m2);
        thrust(built.full_thrust_n);
        gravity(built.gravity_n_m);
        delay(built.delay_s);
        const double own = std::sqrt(built.gravity_n_m / built.inertia_kg_m2);
        damping(built.damping_n_m_s / (2.0 * own * built.inertia_kg_m2));
        EXPECT_DOUBLE_EQ(base.tau_s, std::max(1.0 / own, built.damping_n_m_s / built.gravity_n_m));
        const double spring = built.gravity_n_m / built.full_torque_n_m();
        EXPECT_LE(base.setup.plant.full_input, 0.95);
        lift(base.setup.plant.full_input / spring);
        EXPECT_NEAR(base.setup.plant.full_output, base.setup.plant.full_input / spring, 1e-12);
        spreads.insert(base.clock.spread_s / base.clock.interval_s);
        const double count = base.clock.until_s / base.clock.interval_s;
        EXPECT_TRUE(std::fabs(count / 250.0 - std::round(count / 250.0)) < 1e-9) << count;
        samples(count / 250.0);
        EXPECT_EQ(base.model, stand::linear_model_json(built));
    }
    expect_between(inertia, 0.02, 0.08, "inertia");
    expect_between(thrust, 5.0, 9.0, "thrust");
    expect_between(gravity, 0.4, 1.2, "gravity");
    expect_between(damping, 0.35, 1.2, "damping");
    expect_between(delay, 0.0, 0.15, "delay");
    expect_between(lift, 0.4, 0.95, "the full input, of what turns the bar by a radian");
    expect_between(samples, 8.0, 22.0, "samples, in 250");
    EXPECT_THAT(spreads, testing::ElementsAre(0.0, testing::DoubleNear(0.1, 1e-12)));
}

TEST(Drawn, LinearPlantsLieBetweenTheirBounds) {
    for (const bool fractional : {false, true}) {
        Chance chance(2, 5);
        Seen pace, tau, gain, small_input, large_input, delay, low_order, high_order, lower_part, coefficient, damping;
        std::set<std::size_t> sizes;
        for (int k = 0; k < plants; ++k) {
            const auto base = blind::draw_mechanical(false, fractional, chance);
            const auto& plant = base.setup.plant;
            const double slower = base.clock.interval_s / 0.01;
            EXPECT_EQ(base.kind, fractional ? "fractional" : "whole");
            EXPECT_DOUBLE_EQ(base.step_s, base.clock.interval_s / (fractional ? 5.0 : 10.0));
            pace(slower);
            tau(base.tau_s / slower);
            (plant.full_input <= 1.0 ? small_input : large_input)(plant.full_input);
            if (plant.delay_s > 0.0) {
                delay(plant.delay_s / base.tau_s);
            }
            sizes.insert(plant.terms.size());
            EXPECT_EQ(plant.terms.back().order, 0.0);
            EXPECT_DOUBLE_EQ(plant.full_output, plant.gain * plant.full_input / plant.terms.back().coefficient);
            const double t = base.tau_s;
            if (fractional) {
                EXPECT_EQ(plant.gain, 1.0);
                gain(1.0 / plant.terms.back().coefficient);
                const double high = plant.terms[0].order;
                EXPECT_NEAR(plant.terms[0].coefficient / plant.terms.back().coefficient / std::pow(t, high), 1.0, 3e-3);
                (plant.terms.size() == 2 ? low_order : high_order)(high);
                if (plant.terms.size() == 3) {
                    const double low = plant.terms[1].order;
                    lower_part(low / high);
                    coefficient(plant.terms[1].coefficient / plant.terms.back().coefficient / std::pow(t, low));
                }
            } else {
                gain(plant.gain);
                EXPECT_EQ(plant.terms.back().coefficient, 1.0);
                if (plant.terms.size() == 2) {
                    EXPECT_EQ(plant.terms[0].coefficient, t);
                    EXPECT_EQ(plant.terms[0].order, 1.0);
                } else {
                    EXPECT_EQ(plant.terms[0].order, 2.0);
                    EXPECT_EQ(plant.terms[1].order, 1.0);
                    // Two equal time constants, or any damping.
                    if (plant.terms[1].coefficient == t) {
                        EXPECT_EQ(plant.terms[0].coefficient, 0.25 * t * t);
                    } else {
                        EXPECT_NEAR(plant.terms[0].coefficient / (t * t), 1.0, 1e-3);
                        damping(plant.terms[1].coefficient / (2.0 * t));
                    }
                }
            }
            const auto model = drive::parse_model(base.model, "model.json");
            EXPECT_EQ(model.gain, plant.gain);
            EXPECT_EQ(model.delay_s, plant.delay_s);
            EXPECT_EQ(model.sample_time_s, base.clock.interval_s);
            ASSERT_EQ(model.denominator.size(), plant.terms.size());
            for (std::size_t i = 0; i < plant.terms.size(); ++i) {
                EXPECT_EQ(model.denominator[i].coefficient, plant.terms[i].coefficient);
                EXPECT_EQ(model.denominator[i].order, plant.terms[i].order);
            }
        }
        expect_between(pace, 0.5, 6.0, "pace");
        expect_between(tau, 0.15, 0.9, "time constant");
        expect_between(gain, 0.2, 20.0, "gain");
        expect_between(small_input, 0.3, 1.0, "small inputs");
        expect_between(large_input, 1.0, 12.0, "large inputs");
        expect_between(delay, 0.05, 1.0, "delay");
        EXPECT_THAT(sizes, testing::ElementsAre(2U, 3U));
        if (fractional) {
            expect_between(low_order, 0.55, 0.95, "order of one term");
            expect_between(high_order, 1.5, 1.95, "higher order");
            expect_between(lower_part, 0.45, 0.55, "lower order over it");
            expect_between(coefficient, 1.2, 2.2, "its coefficient");
        } else {
            expect_between(damping, 0.4, 1.3, "damping");
        }
    }
}

// What a family's own effects are measured by tells what its plant is.
TEST(Drawn, OvensLieBetweenTheirBounds) {
    Seen tau, rise, input, ambient, samples, length, alone, with_wall;
    std::set<std::string> kinds, inputs, outputs;
    bool percent = false;
    bool one = false;
    for (std::uint64_t seed = 1; seed <= plants; ++seed) {
        Chance chance(seed, 5);
        const auto rig = blind::thermal_family().draw({}, chance);
        tau(rig->tau_s);
        kinds.insert(rig->plant);
        inputs.insert(rig->input);
        outputs.insert(rig->output);
        const auto drawn = [&](const char* effect) {
            Chance same(seed, 6);
            return rig->draw(effect, blind::EffectSize::clear, false, same);
        };
        const double vary = drawn("dead_time_error").at("extra_s") / (0.15 * rig->tau_s);
        const double rise_k = std::fabs(drawn("sensor_offset").at("offset")) / (0.06 * vary);
        rise(rise_k);
        ambient(drawn("sensor_saturation").at("limit") - rise_k * (1.0 - 0.4 * vary));
        const double loss_w_per_k = std::fabs(drawn("load_disturbance").at("size")) / (0.2 * vary) / rise_k;
        (rig->plant == "body" ? alone : with_wall)(loss_w_per_k);
        if (rig->input == "duty") {
            EXPECT_EQ(rig->full_input, 1.0);
        } else if (rig->full_input == 100.0 || rig->full_input == 1.0) {
            (rig->full_input == 1.0 ? one : percent) = true;
        } else {
            input(rig->full_input);
        }
        samples(rig->tau_s / rig->clock.interval_s);
        length(rig->clock.until_s / rig->clock.interval_s / 250.0);
        EXPECT_FALSE(rig->remembers);
    }
    expect_between(tau, 20.0, 2000.0, "time constant");
    expect_between(rise, 20.0, 350.0, "rise");
    expect_between(alone, 0.2, 20.0, "loss");
    EXPECT_GT(with_wall.least, 0.2);  // what goes through the wall besides, at most as much as the wall lets out
    EXPECT_LT(with_wall.most, 20.0 * (1.0 + 1.0 / (1.0 / 3.0 + 1.0 / 2.0)));
    EXPECT_GT(with_wall.most, 20.0);
    expect_between(ambient, 5.0, 30.0, "ambient");
    expect_between(input, 5.0, 230.0, "full input");
    expect_between(samples, 20.0, 40.0, "samples in a time constant");
    expect_between(length, 6.0, 12.0, "samples, in 250");
    EXPECT_THAT(kinds, testing::ElementsAre("body", "body and wall"));
    EXPECT_THAT(inputs, testing::ElementsAre("duty", "input"));
    EXPECT_THAT(outputs, testing::ElementsAre("output", "y"));
    EXPECT_TRUE(percent && one);
}

TEST(Drawn, TanksLieBetweenTheirBounds) {
    Seen tau, full, zero, input, samples, length, area;
    std::set<std::string> kinds;
    bool ten = false;
    bool percent = false;
    for (std::uint64_t seed = 1; seed <= plants; ++seed) {
        Chance chance(seed, 5);
        const auto rig = blind::hydraulic_family().draw({}, chance);
        tau(rig->tau_s);
        kinds.insert(rig->plant);
        const auto drawn = [&](const char* effect) {
            Chance same(seed, 6);
            return rig->draw(effect, blind::EffectSize::clear, false, same);
        };
        const double vary = drawn("dead_time_error").at("extra_s") / (0.15 * rig->tau_s);
        const double full_cm = std::fabs(drawn("sensor_offset").at("offset")) / (0.06 * vary);
        full(full_cm);
        const double outflow = -drawn("load_disturbance").at("size") / (0.16 * vary) / full_cm;
        area(outflow * rig->tau_s);
        const double zero_cm = drawn("sensor_saturation").at("limit") - full_cm * (1.0 - 0.4 * vary);
        if (std::fabs(zero_cm) > 1e-6 * full_cm) {
            zero(zero_cm / full_cm);
        }
        if (rig->full_input == 10.0 || rig->full_input == 100.0) {
            (rig->full_input == 10.0 ? ten : percent) = true;
        } else {
            input(rig->full_input);
        }
        samples(rig->tau_s / rig->clock.interval_s);
        length(rig->clock.until_s / rig->clock.interval_s / 250.0);
    }
    expect_between(tau, 4.0, 400.0, "time constant");
    expect_between(full, 5.0, 200.0, "level at the full input");
    expect_between(area, 10.0, 2000.0, "area");
    expect_between(zero, -0.3, 0.6, "the gauge's zero");
    expect_between(input, 2.0, 24.0, "full input");
    expect_between(samples, 20.0, 40.0, "samples in a time constant");
    expect_between(length, 6.0, 12.0, "samples, in 250");
    EXPECT_THAT(kinds, testing::ElementsAre("one tank", "two tanks"));
    EXPECT_TRUE(ten && percent);
}

// Until its dead time is over nothing moves.
TEST(Drawn, OvensAndTanksWaitForTheirDeadTime) {
    for (const blind::Family* family : {&blind::thermal_family(), &blind::hydraulic_family()}) {
        Seen delay;
        int none = 0;
        constexpr int rigs = 3000;
        for (std::uint64_t seed = 1; seed <= rigs; ++seed) {
            Chance chance(seed, 11);
            const auto rig = family->draw({}, chance);
            blind::Held held;
            for (int k = 0; k <= 600; ++k) {
                held.time_s.push_back(7e-4 * k * rig->tau_s);
                held.input.push_back(rig->full_input);
            }
            const auto z = rig->read({}, held, {}, 1);
            const auto moves = std::find_if(z.begin(), z.end(), [&](double value) { return value != z.front(); });
            ASSERT_NE(moves, z.end());
            const double share = 7e-4 * static_cast<double>(moves - z.begin() - 1);
            if (share < 1e-3) {
                ++none;
            } else {
                delay(share);
            }
        }
        EXPECT_NEAR(static_cast<double>(none) / rigs, 0.4, 0.01) << family->domain;
        EXPECT_NEAR(delay.least, 0.02, 1.5e-3) << family->domain;
        EXPECT_NEAR(delay.most, 0.4, 2e-3) << family->domain;
    }
}

}  // namespace
