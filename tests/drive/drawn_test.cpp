// What blind cases draw by chance: plants between their bounds, excitations by the closed form of their kind, and what
// the acquisition makes of a reading.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

#include "drive/model_file.hpp"
#include "drive/stand/blind/family.hpp"
#include "drive/stand/blind/mechanical.hpp"
#include "drive/stand/blind/series.hpp"

namespace {

namespace blind = stand::blind;
using stand::Chance;

struct Seen {
    double least = std::numeric_limits<double>::infinity();
    double most = -std::numeric_limits<double>::infinity();
    void operator()(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    }
};

// Within the bounds but for the rounding to four digits, and up to them: within half a per cent of them or of what lies
// between.
void expect_between(const Seen& seen, double low, double high, const char* what) {
    const double near_low = 4e-3 * std::max(std::fabs(low), high - low);
    const double near_high = 4e-3 * std::max(std::fabs(high), high - low);
    EXPECT_GE(seen.least, low - 1.1e-3 * std::fabs(low)) << what;
    EXPECT_LE(seen.least, low + near_low) << what;
    EXPECT_LE(seen.most, high + 1.1e-3 * std::fabs(high)) << what;
    EXPECT_GE(seen.most, high - near_high) << what;
}

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

constexpr blind::Clock clock{.interval_s = 0.01, .spread_s = 0.0, .until_s = 40.0};
constexpr double tau_s = 0.4;
constexpr double high = 2.0;

struct Excitation {
    std::vector<double> u;  // over the highest, from the end of the rest on
    double rest_s = 0.0;
    double length_s = 0.0;
};

Excitation excited(const char* kind, std::uint64_t seed) {
    Chance chance(seed, 3);
    const auto held = blind::make_profile(kind, clock, high, tau_s, chance);
    EXPECT_EQ(held.time_s.size(), 4001U);
    Excitation found;
    std::size_t k = 0;
    // The rest ends where the input begins; a chirp of the widest swing and a ramp begin at 0 themselves.
    while (k < held.input.size() && held.input[k] == 0.0) {
        ++k;
    }
    found.rest_s = 0.01 * static_cast<double>(k);
    found.length_s = clock.until_s - found.rest_s;
    for (; k < held.input.size(); ++k) {
        found.u.push_back(held.input[k] / high);
    }
    return found;
}

// Where a sequence changes, in samples.
std::vector<double> holds_of(const std::vector<double>& u) {
    std::vector<double> holds;
    std::size_t from = 0;
    for (std::size_t k = 1; k < u.size(); ++k) {
        if (u[k] != u[k - 1]) {
            holds.push_back(static_cast<double>(k - from));
            from = k;
        }
    }
    return holds;
}

TEST(Profiles, RestAndThenStep) {
    Seen rest;
    for (std::uint64_t seed = 1; seed <= 800; ++seed) {
        const Excitation step = excited("step", seed);
        rest(step.rest_s / clock.until_s);
        EXPECT_EQ(step.u, std::vector<double>(step.u.size(), 1.0));
    }
    EXPECT_NEAR(rest.least, 0.01, 3e-4);
    EXPECT_NEAR(rest.most, 0.04, 3e-4);
    EXPECT_TRUE(blind::has_one_level("step"));
    EXPECT_TRUE(blind::has_one_level("on_off"));
    EXPECT_FALSE(blind::has_one_level("prbs"));
}

TEST(Profiles, SwitchOnAndOff) {
    Seen on;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        const Excitation found = excited("on_off", seed);
        const auto holds = holds_of(found.u);
        ASSERT_GE(holds.size(), 3U);
        for (std::size_t i = 0; i < holds.size(); ++i) {
            EXPECT_NEAR(holds[i], holds[0], 1.0);
        }
        on(holds[0] * 0.01 / tau_s);
        for (const double u : found.u) {
            EXPECT_TRUE(u == 0.0 || u == 1.0);
        }
    }
    EXPECT_NEAR(on.least, 6.0, 0.05);
    EXPECT_NEAR(on.most, 14.0, 0.05);
    // Of a slow plant at most two fifths of the record.
    Chance chance(1, 3);
    const auto slow = blind::make_profile("on_off", clock, 1.0, 100.0, chance);
    const auto first = std::find(slow.input.begin(), slow.input.end(), 1.0) - slow.input.begin();
    const auto last = std::find(slow.input.begin() + first, slow.input.end(), 0.0) - slow.input.begin();
    EXPECT_NEAR(static_cast<double>(last - first), 0.4 * static_cast<double>(4001 - first), 2.0);
}

TEST(Profiles, ClimbStairs) {
    std::set<double> stairs;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const Excitation found = excited("staircase", seed);
        const double n = std::round(1.0 / found.u.front());
        stairs.insert(n);
        const double hold = std::min(found.length_s / (2.0 * n), std::max(8.0 * tau_s, found.length_s / (6.0 * n)));
        for (std::size_t k = 0; k < found.u.size(); ++k) {
            const double along = static_cast<double>(k) * 0.01 / hold;
            if (std::fabs(along - std::round(along)) * hold > 0.025) {  // beside a step
                const int place = static_cast<int>(along) % static_cast<int>(2.0 * n) + 1;
                ASSERT_NEAR(found.u[k], std::min<double>(place, 2.0 * n - place) / n, 5.1e-5) << seed << ' ' << k;
            }
        }
    }
    EXPECT_THAT(stairs, testing::ElementsAre(4.0, 5.0, 6.0));
}

TEST(Profiles, HoldLevelsAtRandom) {
    Seen level, hold;
    std::size_t none = 0;
    std::size_t all = 0;
    for (std::uint64_t seed = 1; seed <= 500; ++seed) {
        const Excitation found = excited("levels", seed);
        for (const double u : found.u) {
            if (u != 0.0) {
                level(u);
                ASSERT_NEAR(100.0 * u, std::round(100.0 * u), 1e-9);
            }
        }
        double at = 0.0;
        for (const double samples : holds_of(found.u)) {
            ++all;
            none += found.u[static_cast<std::size_t>(at)] == 0.0 ? 1 : 0;
            at += samples;
            hold(samples * 0.01 / tau_s);
        }
    }
    EXPECT_NEAR(level.least, 0.15, 1e-9);
    EXPECT_NEAR(level.most, 1.0, 1e-9);
    EXPECT_NEAR(hold.least, 3.0, 0.06);
    EXPECT_GT(hold.most, 7.97);  // two equal levels in a row hold longer
    // One in seven is 0: as runs of such holds, 0.15 0.85 of them beside 0.85 others.
    EXPECT_NEAR(static_cast<double>(none) / static_cast<double>(all), 0.1275 / 0.9775, 0.01);
}

TEST(Profiles, AreRandomBinarySignals) {
    Seen low, bit;
    for (std::uint64_t seed = 1; seed <= 500; ++seed) {
        const Excitation found = excited("prbs", seed);
        std::set<double> levels(found.u.begin(), found.u.end());
        ASSERT_EQ(levels.size(), 2U);
        EXPECT_EQ(*levels.rbegin(), 1.0);
        low(*levels.begin());
        const auto holds = holds_of(found.u);
        bit(*std::min_element(holds.begin() + 1, holds.end()) * 0.01 / tau_s);
    }
    EXPECT_NEAR(low.least, 0.2, 2e-3);
    EXPECT_NEAR(low.most, 0.5, 2e-3);
    EXPECT_NEAR(bit.least, 0.7, 0.03);
    EXPECT_NEAR(bit.most, 2.0, 0.03);
}

// Up and down as straight lines, one to three times.
TEST(Profiles, RampUpAndDown) {
    std::set<int> turns;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const Excitation found = excited("ramp", seed);
        EXPECT_NEAR(*std::max_element(found.u.begin(), found.u.end()), 1.0, 2e-3);
        const double slope = (found.u[101] - found.u[1]) / 1.0;
        const double ups = 0.5 * slope * found.length_s;
        turns.insert(static_cast<int>(std::lround(ups)));
        EXPECT_NEAR(ups, std::round(ups), 0.01);
        std::size_t falls = 0;
        for (std::size_t k = 1; k < found.u.size(); ++k) {
            EXPECT_NEAR(std::fabs(found.u[k] - found.u[k - 1]), 0.01 * slope, 0.02 * slope + 2e-4);
            falls += found.u[k] < found.u[k - 1] ? 1 : 0;
        }
        EXPECT_NEAR(static_cast<double>(falls), 0.5 * static_cast<double>(found.u.size()), 10.0);
    }
    EXPECT_THAT(turns, testing::ElementsAre(1, 2, 3));
}

// From 0.02 over the time constant on, 8 to 20 times faster at the end: the phase is f (e^(r t) - 1) / r.
TEST(Profiles, ChirpFromSlowToFast) {
    Seen swing, faster;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        const Excitation found = excited("chirp", seed);
        const double least = *std::min_element(found.u.begin(), found.u.end());
        EXPECT_NEAR(*std::max_element(found.u.begin(), found.u.end()), 1.0, 1e-3);
        const double own = 0.5 * (1.0 - least);
        swing(own);
        std::vector<double> crossings_s;  // of the middle: quarter, three quarters, ... of a turn
        for (std::size_t k = 1; k < found.u.size(); ++k) {
            const double a = found.u[k - 1] - (1.0 - own);
            const double b = found.u[k] - (1.0 - own);
            if ((a < 0.0) != (b < 0.0)) {
                crossings_s.push_back(0.01 * (static_cast<double>(k - 1) + a / (a - b)));
            }
        }
        ASSERT_GE(crossings_s.size(), 4U);
        // Five times the phase of the first crossing at the third.
        double low = 1e-6;
        double top = 1.0;
        for (int i = 0; i < 60; ++i) {
            const double r = 0.5 * (low + top);
            (std::expm1(r * crossings_s[2]) < 5.0 * std::expm1(r * crossings_s[0]) ? low : top) = r;
        }
        if (own < 0.49) {  // where it begins is seen
            EXPECT_NEAR(0.25 * low / std::expm1(low * crossings_s[0]), 0.02 / tau_s, 2.5e-3);
            faster(std::exp(low * found.length_s));
        }
    }
    EXPECT_NEAR(swing.least, 0.3, 2e-3);
    EXPECT_NEAR(swing.most, 0.5, 2e-3);
    EXPECT_NEAR(faster.least, 8.0, 0.5);
    EXPECT_NEAR(faster.most, 20.0, 1.5);
}

// Stamps are whole microseconds beside the even ones, the first is 0.
TEST(Profiles, StampAsTheirClockDoes) {
    Chance chance(1, 3);
    const auto held =
        blind::make_profile("step", {.interval_s = 0.01, .spread_s = 0.001, .until_s = 40.0}, 1.0, 0.4, chance);
    Seen beside;
    ASSERT_EQ(held.time_s.size(), 4001U);
    EXPECT_EQ(held.time_s[0], 0.0);
    for (std::size_t k = 1; k < held.time_s.size(); ++k) {
        beside(held.time_s[k] - 0.01 * static_cast<double>(k));
        EXPECT_NEAR(held.time_s[k] * 1e6, std::round(held.time_s[k] * 1e6), 1e-4);
    }
    expect_between(beside, -0.001, 0.001, "spread");
}

blind::Moved readings(std::size_t count) {
    blind::Moved moved;
    for (std::size_t k = 0; k < count; ++k) {
        moved.at_s.push_back(0.01 * static_cast<double>(k));
        moved.z.push_back(0.001 * static_cast<double>(k) - 1.0);
    }
    return moved;
}

TEST(Acquisition, AddsWhatItsSensorDoes) {
    const blind::Moved moved = readings(2001);
    const auto acquired = [&](const std::function<void(blind::Setup&)>& change, const std::vector<double>& noise = {}) {
        blind::Setup setup;
        setup.stand = blind::no_effects();
        change(setup);
        return blind::acquire(setup, moved, noise, 1);
    };
    const auto plain = acquired([](blind::Setup&) {});
    EXPECT_EQ(plain, moved.z);
    const auto shifted = acquired(
        [](blind::Setup& s) {
            s.stand.offset_rad = 0.25;
            s.stand.drift_rad_per_s = 0.125;
        },
        std::vector<double>(2001, 0.5));
    const auto limited = acquired([](blind::Setup& s) { s.stand.sensor_limit_rad = 0.7; });
    const auto counted = acquired([](blind::Setup& s) { s.stand.encoder_step_rad = 0.05; });
    const auto missed = acquired([](blind::Setup& s) {
        s.missed_at_s = 10.0;
        s.missed_size = -0.3;
    });
    for (std::size_t k = 0; k < moved.z.size(); ++k) {
        EXPECT_NEAR(shifted[k], moved.z[k] + 0.75 + 0.125 * moved.at_s[k], 1e-12);
        EXPECT_EQ(limited[k], std::clamp(moved.z[k], -0.7, 0.7));
        EXPECT_NEAR(counted[k], 0.05 * std::round(moved.z[k] / 0.05), 1e-12);
        EXPECT_NEAR(missed[k], moved.z[k] - (moved.at_s[k] >= 10.0 ? 0.3 : 0.0), 1e-12);
    }
}

// Lengths of stretches in which a reading that never rests is held.
std::vector<std::size_t> stretches_of(const std::vector<double>& z) {
    std::vector<std::size_t> lengths;
    std::size_t length = 0;
    for (std::size_t k = 1; k < z.size(); ++k) {
        if (z[k] == z[k - 1]) {
            ++length;
        } else if (length > 0) {
            lengths.push_back(std::exchange(length, 0));
        }
    }
    return lengths;
}

void expect_stretches(const std::vector<double>& z, double rate, double within) {
    const auto lengths = stretches_of(z);
    std::size_t held = 0;
    std::size_t single = 0;  // of 5 to 25; two may follow one another
    std::size_t longest = 0;
    for (const std::size_t length : lengths) {
        held += length;
        EXPECT_GE(length, 5U);
        single += length <= 25 ? 1 : 0;
        longest = std::max(longest, length <= 25 ? length : 0);
    }
    EXPECT_EQ(*std::min_element(lengths.begin(), lengths.end()), 5U);
    EXPECT_EQ(longest, 25U);
    EXPECT_GE(10 * single, 9 * lengths.size());
    EXPECT_NEAR(static_cast<double>(held) / static_cast<double>(z.size()), rate, within);
}

TEST(Acquisition, HoldsSamplesInStretches) {
    const blind::Moved moved = readings(200'000);
    for (const double rate : {0.1, 0.3}) {
        blind::Setup setup;
        setup.stand = blind::no_effects();
        setup.stand.dropped_rate = rate;
        expect_stretches(blind::acquire(setup, moved, {}, 3), rate, 0.01);
    }
}

TEST(Acquisition, OfOvensAndTanksIsTheSame) {
    for (const blind::Family* family : {&blind::thermal_family(), &blind::hydraulic_family()}) {
        Chance chance(3, 7);
        const auto rig = family->draw({}, chance);
        blind::Held held;
        std::vector<double> noise;  // never twice the same
        for (int k = 0; k < 40'000; ++k) {
            held.time_s.push_back(1e-3 * k * rig->clock.interval_s);
            held.input.push_back(0.0);
            noise.push_back(0.01 * k);
        }
        const auto plain = rig->read({}, held, noise, 1);
        EXPECT_NEAR(plain[5000] - plain[0], 50.0, 1e-6);
        const auto with = [&](const char* effect, blind::Parameters parameters) {
            return rig->read(std::vector{blind::Fault{effect, std::move(parameters)}}, held, noise, 1);
        };
        const auto drifts = with("sensor_drift", {{"per_s", 0.25}});
        const auto shifted = with("sensor_offset", {{"offset", -3.0}});
        const auto limited = with("sensor_saturation", {{"limit", plain[0] + 60.0}});
        const auto counted = with("encoder_quantisation", {{"step", 0.75}});
        for (std::size_t k = 0; k < plain.size(); k += 97) {
            // The thermometer's bend has no part in it.
            EXPECT_NEAR(drifts[k], plain[k] + 0.25 * held.time_s[k], 1e-9);
            EXPECT_NEAR(shifted[k], plain[k] - 3.0, 1e-9);
            EXPECT_NEAR(limited[k], std::min(plain[k], plain[0] + 60.0), 1e-9);
            EXPECT_NEAR(counted[k], 0.75 * std::round(plain[k] / 0.75), 1e-9);
        }
        expect_stretches(with("dropped_samples", {{"rate", 0.3}}), 0.3, 0.03);
        // Bend is none at rest nor at the full input, and c / 4 of the rise below in the middle.
        if (family == &blind::thermal_family()) {
            blind::Held warm;
            for (int k = 0; k < 3000; ++k) {
                warm.time_s.push_back(k * rig->clock.interval_s);
                warm.input.push_back(0.5 * rig->full_input);
            }
            const double half = rig->read({}, warm, {}, 1).back() - plain[0];
            const double bent =
                rig->read(std::vector{blind::Fault{"output_curve", {{"curvature", 0.4}}}}, warm, {}, 1).back() -
                plain[0];
            EXPECT_NEAR(bent / half, 1.0 + 0.4 * (0.5 - 1.0), 1e-3);
        }
    }
}

TEST(Noise, HasItsDeviationAndItsMemory) {
    for (const double memory : {0.0, 0.9}) {
        Chance chance(1, 9);
        const auto noise = blind::make_noise(100'000, 0.5, memory, chance);
        EXPECT_NEAR(blind::deviation_of(noise), 0.5, memory == 0.0 ? 0.005 : 0.02);
        double product = 0.0;
        for (std::size_t k = 1; k < noise.size(); ++k) {
            product += noise[k] * noise[k - 1] / static_cast<double>(noise.size());
        }
        EXPECT_NEAR(product / 0.25, memory, memory == 0.0 ? 0.015 : 0.08);
    }
    EXPECT_EQ(blind::digits(123456.0), 123500.0);
    EXPECT_EQ(blind::digits(0.00123456), 0.001235);
    EXPECT_DOUBLE_EQ(blind::rms({1.0, 2.0}, {1.0, 4.0}), std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(blind::deviation_of({1.0, 3.0}), 1.0);
}

TEST(Noise, HidesWhatIsLessThanTwiceAsLarge) {
    const std::vector<double> zero(3, 0.0);
    EXPECT_FALSE(blind::stands_out({0.5, -0.5, 0.5}, zero, 0.25));
    EXPECT_TRUE(blind::stands_out({0.501, -0.501, 0.501}, zero, 0.25));
    EXPECT_TRUE(blind::stands_out({0.25, 0.25, 1.0}, zero, 0.3));
}

TEST(Chance, IsEvenBetweenItsBounds) {
    Chance chance(1, 1);
    Seen between, around, scaled;
    double logarithm = 0.0;
    std::set<std::size_t> below;
    for (int k = 0; k < 4000; ++k) {
        between(chance.between(2.0, 5.0));
        around(chance.around(0.5));
        const double s = chance.scaled(1.0, 100.0);
        scaled(s);
        logarithm += std::log10(s) / 4000.0;
        below.insert(chance.below(3));
    }
    expect_between(between, 2.0, 5.0, "between");
    expect_between(around, -0.5, 0.5, "around");
    EXPECT_NEAR(scaled.least, 1.0, 0.01);
    EXPECT_NEAR(scaled.most, 100.0, 0.5);
    EXPECT_NEAR(logarithm, 1.0, 0.03);
    EXPECT_THAT(below, testing::ElementsAre(0U, 1U, 2U));
}

}  // namespace
