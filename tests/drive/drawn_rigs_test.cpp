// Plants of blind cases number by number, as their seed draws them: a published score names its seed, so a seed keeps
// its cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "drive/model_file.hpp"
#include "drive/stand/blind/family.hpp"
#include "drive/stand/blind/hydraulic/tanks.hpp"
#include "drive/stand/blind/mechanical.hpp"
#include "drive/stand/blind/series.hpp"
#include "drive/stand/blind/thermal/oven.hpp"
#include "drive/stand/blind/without_model.hpp"

namespace {

namespace blind = stand::blind;
using blind::digits;
using stand::Chance;

// On, half and on again, over one and a half time constants.
blind::Held held_for(double tau_s, double full_input) {
    return {{0.0, 0.25 * tau_s, 0.5 * tau_s, tau_s, 1.5 * tau_s},
            {full_input, full_input, 0.5 * full_input, full_input, full_input}};
}

TEST(DrawnRigs, OvensAreMadeOfTheirDraws) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        Chance chance(seed, 5);
        const auto rig = blind::thermal_family().draw({}, chance);
        Chance same(seed, 5);
        stand::thermal::Oven oven;
        const double tau_s = digits(same.scaled(20.0, 2000.0));
        const double rise_k = digits(same.scaled(20.0, 350.0));
        const double full = same.happens(0.4) ? 100.0 : same.happens(0.5) ? 1.0 : digits(same.between(5.0, 230.0));
        oven.body_loss_w_per_k = digits(same.scaled(0.2, 20.0));
        const bool wall = same.happens(0.5);
        double loss_w_per_k = oven.body_loss_w_per_k;
        if (wall) {
            oven.coupling_w_per_k = digits(oven.body_loss_w_per_k * same.between(0.5, 3.0));
            oven.wall_loss_w_per_k = digits(oven.body_loss_w_per_k * same.between(0.2, 2.0));
            // Through the wall: into it and out of it, one after the other.
            loss_w_per_k += 1.0 / (1.0 / oven.coupling_w_per_k + 1.0 / oven.wall_loss_w_per_k);
        }
        // Body and wall share what stores as much as the time constant asks for.
        const double wall_share = same.scaled(0.1, 0.6);
        const double stores = tau_s * (oven.body_loss_w_per_k + oven.wall_loss_w_per_k);
        oven.body_j_per_k = digits(wall ? stores * (1.0 - wall_share) : stores);
        oven.wall_j_per_k = wall ? digits(stores * wall_share) : 0.0;
        oven.power_w_per_unit = digits(rise_k * loss_w_per_k / full);
        oven.delay_s = same.happens(0.4) ? 0.0 : digits(tau_s * same.between(0.02, 0.4));
        oven.sensor_tau_s = same.happens(0.5) ? 0.0 : digits(tau_s * same.between(0.05, 0.2));
        oven.ambient_c = digits(same.between(5.0, 30.0));
        oven.start_c = oven.ambient_c;
        if (!same.happens(0.5)) {  // a duty, of the full power
            oven.power_w_per_unit *= full;
        }
        const blind::Held held = held_for(tau_s, rig->full_input);
        const auto shown = rig->read({}, held, {}, 1);
        const auto expected = stand::thermal::measure(oven, held, held.time_s, 0.1 * rig->clock.interval_s);
        ASSERT_EQ(shown.size(), expected.size());
        for (std::size_t k = 0; k < shown.size(); ++k) {
            EXPECT_NEAR(shown[k], expected[k], 1e-8 * rise_k) << seed << ' ' << k;
        }
    }
}

TEST(DrawnRigs, TanksAreMadeOfTheirDraws) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        Chance chance(seed, 5);
        const auto rig = blind::hydraulic_family().draw({}, chance);
        Chance same(seed, 5);
        stand::hydraulic::Tanks tanks;
        const double tau_s = digits(same.scaled(4.0, 400.0));
        tanks.reference_cm = digits(same.scaled(5.0, 200.0));
        const double full = same.happens(0.4) ? 10.0 : same.happens(0.5) ? 100.0 : digits(same.between(2.0, 24.0));
        tanks.two = same.happens(0.5);
        tanks.area_cm2 = digits(same.scaled(10.0, 2000.0));
        tanks.outflow_cm2_per_s = digits(tanks.area_cm2 / tau_s);
        tanks.first_area_cm2 = digits(tanks.area_cm2 * same.between(0.3, 1.0));
        tanks.first_outflow_cm2_per_s = tanks.outflow_cm2_per_s;
        // At the full input as much flows in as flows out at the full level.
        tanks.inflow_per_unit = digits(tanks.outflow_cm2_per_s * tanks.reference_cm / full);
        tanks.pump_tau_s = same.happens(0.5) ? 0.0 : digits(tau_s * same.between(0.03, 0.2));
        tanks.delay_s = same.happens(0.4) ? 0.0 : digits(tau_s * same.between(0.02, 0.4));
        const double zero_cm = same.happens(0.5) ? 0.0 : digits(tanks.reference_cm * same.between(-0.3, 0.6));
        const blind::Held held = held_for(tau_s, rig->full_input);
        const auto shown = rig->read({}, held, {}, 1);
        const auto expected = stand::hydraulic::gauge(tanks, held, held.time_s, 0.1 * rig->clock.interval_s);
        ASSERT_EQ(shown.size(), expected.size());
        for (std::size_t k = 0; k < shown.size(); ++k) {
            EXPECT_NEAR(shown[k], expected[k] + zero_cm, 1e-8 * tanks.reference_cm) << seed << ' ' << k;
        }
    }
}

void expect_terms(const std::vector<blind::PlantTerm>& found, const std::vector<blind::PlantTerm>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_DOUBLE_EQ(found[i].coefficient, expected[i].coefficient) << i;
        EXPECT_EQ(found[i].order, expected[i].order) << i;
    }
}

TEST(DrawnRigs, LinearPlantsAreMadeOfTheirDraws) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const bool fractional = seed % 2 == 0;
        Chance chance(seed, 5);
        const blind::Mechanical base = blind::draw_mechanical(false, fractional, chance);
        const blind::Plant& plant = base.setup.plant;
        Chance same(seed, 5);
        const double pace = same.happens(0.75) ? 1.0 : digits(same.scaled(0.5, 6.0));
        const double samples = same.happens(0.7) ? 4000.0 : 250.0 * std::round(same.between(8.0, 22.0));
        EXPECT_DOUBLE_EQ(base.clock.interval_s, 0.01 * pace);
        EXPECT_DOUBLE_EQ(base.clock.until_s, 0.01 * pace * samples);
        EXPECT_DOUBLE_EQ(base.clock.spread_s, same.happens(0.5) ? 0.001 * pace : 0.0);
        const double t = digits(pace * same.scaled(0.15, 0.9));
        EXPECT_EQ(base.tau_s, t);
        const double gain = digits(same.scaled(0.2, 20.0));
        EXPECT_EQ(plant.full_input,
                  same.happens(0.5) ? digits(same.between(0.3, 1.0)) : digits(same.between(1.0, 12.0)));
        EXPECT_EQ(plant.delay_s, same.happens(0.3) ? 0.0 : digits(t * same.between(0.05, 1.0))) << seed;
        const std::size_t shape = same.below(3);
        if (fractional) {
            const double high = shape == 0 ? same.between(0.55, 0.95) : same.between(1.5, 1.95);
            std::vector<blind::PlantTerm> terms{{digits(std::pow(t, high) / gain), digits(high)}};
            if (shape != 0) {
                const double low = high * same.between(0.45, 0.55);
                const double middle = digits(same.between(1.2, 2.2) * std::pow(t, low) / gain);
                terms.push_back({middle, digits(low)});
            }
            terms.push_back({digits(1.0 / gain), 0.0});
            expect_terms(plant.terms, terms);
            EXPECT_EQ(plant.gain, 1.0);
            EXPECT_EQ(base.kind, "fractional");
        } else {
            const double damping = same.between(0.4, 1.3);
            if (shape == 0) {
                expect_terms(plant.terms, {{t, 1.0}, {1.0, 0.0}});
            } else if (shape == 1) {  // (1 + t/2 s)^2
                expect_terms(plant.terms, {{t * t / 4.0, 2.0}, {t, 1.0}, {1.0, 0.0}});
            } else {
                expect_terms(plant.terms, {{digits(t * t), 2.0}, {digits(2.0 * damping * t), 1.0}, {1.0, 0.0}});
            }
            EXPECT_EQ(plant.gain, gain);
            EXPECT_EQ(base.kind, "whole");
        }
        EXPECT_DOUBLE_EQ(base.step_s, 0.01 * pace / (fractional ? 5.0 : 10.0));
        EXPECT_NEAR(plant.full_output / (plant.gain * plant.full_input / plant.terms.back().coefficient), 1.0, 1e-9);
        // What is written down is the plant.
        const drive::Model model = drive::parse_model(base.model, "model.json");
        EXPECT_DOUBLE_EQ(model.gain, plant.gain);
        EXPECT_DOUBLE_EQ(model.delay_s, plant.delay_s);
        ASSERT_EQ(model.denominator.size(), plant.terms.size());
        for (std::size_t i = 0; i < plant.terms.size(); ++i) {
            EXPECT_DOUBLE_EQ(model.denominator[i].coefficient, plant.terms[i].coefficient);
            EXPECT_DOUBLE_EQ(model.denominator[i].order, plant.terms[i].order);
        }
    }
}

TEST(DrawnRigs, StandsAreMadeOfTheirDraws) {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        Chance chance(seed, 5);
        const blind::Mechanical base = blind::draw_mechanical(true, false, chance);
        Chance same(seed, 5);
        const double samples = same.happens(0.7) ? 4000.0 : 250.0 * std::round(same.between(8.0, 22.0));
        EXPECT_DOUBLE_EQ(base.clock.until_s, 0.01 * samples);
        stand::Stand built = blind::no_effects();
        built.interval_s = 0.01;
        built.spread_s = same.happens(0.5) ? 0.001 : 0.0;
        built.inertia_kg_m2 = digits(same.scaled(0.02, 0.08));
        built.full_thrust_n = digits(same.between(5.0, 9.0));
        built.gravity_n_m = digits(same.scaled(0.4, 1.2));
        // A damping ratio of b / (2 sqrt(J M)).
        const double ratio = same.between(0.35, 1.2);
        built.damping_n_m_s = digits(2.0 * ratio * std::sqrt(built.inertia_kg_m2 * built.gravity_n_m));
        built.delay_s = digits(same.between(0.0, 0.15));
        EXPECT_DOUBLE_EQ(base.setup.stand.spread_s, built.spread_s);
        built.spread_s = base.setup.stand.spread_s;
        EXPECT_TRUE(base.setup.stand == built) << seed;
        EXPECT_EQ(base.kind, "stand");
        EXPECT_NEAR(
            base.tau_s,
            std::max(std::sqrt(built.inertia_kg_m2 / built.gravity_n_m), built.damping_n_m_s / built.gravity_n_m),
            1e-12);
        // So much that the bar stays below about a radian.
        const double of_thrust = built.gravity_n_m / (0.25 * built.full_thrust_n);
        const double full = digits(std::min(0.95, same.between(0.4, 0.95) * of_thrust));
        EXPECT_DOUBLE_EQ(base.setup.plant.full_input, full) << seed;
        EXPECT_NEAR(base.setup.plant.full_output, full / of_thrust, 1e-9) << seed;
        EXPECT_EQ(base.model, stand::linear_model_json(built));
        EXPECT_TRUE(base.setup.physical);
    }
}

TEST(DrawnRigs, EventsHaveThePlaceOfTheirDraws) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Chance chance(seed, 9);
        Chance same(seed, 9);
        blind::Fault pushed{"load_disturbance", {{"size", 0.5}}};
        blind::place_event(pushed, 2.0, 40.0, chance);
        const double from_s = 2.0 + 40.0 * same.between(0.15, 0.6);
        EXPECT_DOUBLE_EQ(pushed.parameters.at("from_s"), from_s);
        EXPECT_DOUBLE_EQ(pushed.parameters.at("to_s"), from_s + 40.0 * same.between(0.1, 0.25));
        EXPECT_EQ(pushed.parameters.size(), 3U);
        blind::Fault missed{"missed_counts", {{"sizes", 5.0}}};
        blind::place_event(missed, 2.0, 40.0, chance);
        EXPECT_DOUBLE_EQ(missed.parameters.at("at_s"), 2.0 + 40.0 * same.between(0.15, 0.6));
        EXPECT_EQ(missed.parameters.size(), 2U);
    }
}

}  // namespace
