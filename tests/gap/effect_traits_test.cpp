// What the search has to know of an effect follows from its law.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "gap/drive/effect.hpp"
#include "gap/drive/scenario.hpp"

namespace {

// A law that lets no small level pass shifts the operating point as long as no input lies within it: a fitted base has
// to follow it before its numbers can be told. One that rounds levels lets the rest pass and shifts nothing.
TEST(EffectTraits, LawsThatLetNoSmallLevelPassLeadTheBase) {
    gap::Scales scales;
    scales.input_max = 2.0;
    scales.time_constant_s = 1.0;
    scales.output_span = 1.0;
    std::size_t leading = 0;
    for (const gap::Effect* effect : gap::effects()) {
        if (effect->kind != gap::Kind::lasting || effect->place != gap::Place::actuator) {
            continue;
        }
        std::vector<double> values;
        for (const gap::EffectParameter& parameter : effect->parameters(scales)) {
            values.push_back(parameter.starts.front());
        }
        gap::Scenario scenario;
        if (values.empty()) {
            continue;
        }
        effect->add_to(scenario, values);
        const auto passed = [&](double before, double level) {
            std::vector<double> levels{before, level};
            for (const auto& law : scenario.levels) {
                law(levels);
            }
            return levels.back();
        };
        // What sticks lets none pass that differs little from the last, wherever that was.
        const bool sticks = passed(2.0, 1.99) == passed(2.0, 2.0);
        const bool dead =
            passed(0.01, 0.01) == 0.0 && passed(-0.01, -0.01) == 0.0 && passed(2.0, 2.0) != 0.0 && !sticks;
        EXPECT_EQ(effect->leads_base, dead) << effect->name;
        leading += dead ? 1 : 0;
    }
    EXPECT_EQ(leading, 2U);
}

std::vector<std::string> those(bool gap::Effect::*trait) {
    std::vector<std::string> names;
    for (const gap::Effect* effect : gap::effects()) {
        if (effect->*trait) {
            names.push_back(effect->name);
        }
    }
    return names;
}

// What cuts its signal off, or its sign, leaves a base little to be told from; a curve is a law's first term; only a
// drift grows while nothing moves.
TEST(EffectTraits, SayWhatMisleadsFollowsOrGrows) {
    using testing::ElementsAre;
    EXPECT_THAT(those(&gap::Effect::hides_base),
                ElementsAre("input_saturation", "end_stop", "sensor_saturation", "sensor_magnitude"));
    EXPECT_THAT(those(&gap::Effect::smooth),
                ElementsAre("input_curve", "supply_sag", "quadratic_drag", "cubic_stiffness", "output_curve"));
    EXPECT_THAT(those(&gap::Effect::of_time), ElementsAre("sensor_drift"));
}

// What holds for one way, one sign or one gain holds for both.
TEST(EffectTraits, TheMoreGeneralCoversTheSpecial) {
    const auto covers = [](const char* general, const char* special) {
        return gap::effect_named(general).covers(gap::effect_named(special));
    };
    EXPECT_TRUE(covers("direction_asymmetry", "sensor_lag"));
    EXPECT_TRUE(covers("direction_asymmetry", "actuator_lag"));
    EXPECT_TRUE(covers("direction_dependent_friction", "coulomb_friction"));
    EXPECT_TRUE(covers("input_curve", "gain_error"));
    EXPECT_TRUE(covers("output_curve", "gain_error"));
    EXPECT_FALSE(covers("gain_error", "input_curve"));
    EXPECT_FALSE(covers("sensor_lag", "actuator_lag"));
}

gap::Forces forces_of(const char* effect, const std::vector<double>& values) {
    gap::Scenario scenario;
    scenario.forces.friction_up = scenario.forces.friction_down = scenario.forces.friction_share = 0.125;
    gap::effect_named(effect).add_to(scenario, values);
    return scenario.forces;
}

// Frictions add up, whatever else rubs; a variant says whether they act on a place or on a speed.
TEST(EffectTraits, ForcesHaveTheirNumbers) {
    for (const bool of_speed : {false, true}) {
        const double variant = of_speed ? 1.0 : 0.0;
        const gap::Forces both = forces_of("coulomb_friction", {0.25, variant});
        EXPECT_EQ(both.friction_up, 0.375);
        EXPECT_EQ(both.friction_down, 0.375);
        EXPECT_EQ(both.friction_of_speed, of_speed);
        const gap::Forces each = forces_of("direction_dependent_friction", {0.25, 0.5, variant});
        EXPECT_EQ(each.friction_up, 0.375);
        EXPECT_EQ(each.friction_down, 0.625);
        EXPECT_EQ(each.friction_of_speed, of_speed);
        const gap::Forces drag = forces_of("quadratic_drag", {2.0, variant});
        EXPECT_EQ(drag.drag, of_speed ? 0.0 : 2.0);
        EXPECT_EQ(drag.drag_of_speed, of_speed ? 2.0 : 0.0);
        const gap::Forces cogging = forces_of("cogging", {3.0, 4.0, 0.5, variant});
        EXPECT_EQ(cogging.cogging.at(0).size, 3.0);
        EXPECT_EQ(cogging.cogging.at(0).per_unit, 4.0);
        EXPECT_EQ(cogging.cogging.at(0).phase_rad, 0.5);
        EXPECT_EQ(cogging.cogging.at(0).of_speed, of_speed);
    }
    EXPECT_EQ(forces_of("load_dependent_friction", {0.25}).friction_share, 0.375);
    const gap::Forces stop = forces_of("end_stop", {3.0, 0.5, 0.0, 0.0});
    ASSERT_TRUE(stop.stop);
    EXPECT_EQ(stop.stop->limit, 3.0);
    EXPECT_EQ(stop.stop->restitution, 0.5);
    const gap::Forces outflow = forces_of("output_curve", {0.25, 3.0, 1.0});
    ASSERT_TRUE(outflow.outflow);
    EXPECT_EQ(outflow.outflow->curvature, 0.25);
    EXPECT_EQ(outflow.outflow->reference, 3.0);
    EXPECT_FALSE(forces_of("output_curve", {0.25, 3.0, 0.0}).outflow);
}

// An order that would be none becomes another term: it stays above.
TEST(EffectTraits, AnOrderStaysATwentieth) {
    gap::Scenario scenario;
    scenario.model.denominator = {{1.0, 1.0}, {2.0, 0.25}, {1.0, 0.0}};
    gap::effect_named("order_error").add_to(scenario, std::vector{-0.5, 0.0});
    EXPECT_EQ(scenario.model.denominator[0].order, 0.5);
    EXPECT_EQ(scenario.model.denominator[1].order, 0.05);
    EXPECT_EQ(scenario.model.denominator[2].order, 0.0);
}

// What a file does not say: all of the play, a curve about 1, all of the noise.
TEST(EffectTraits, NumbersThatFilesLeaveOutAreOne) {
    const auto read = [](const char* name, const gap::Contracted& contracted) {
        const gap::Effect& effect = gap::effect_named(name);
        return effect.from_contract(effect, contracted);
    };
    EXPECT_EQ(read("input_hysteresis", {{"width", 0.25}}), (std::vector{0.25, 1.0}));
    EXPECT_EQ(read("output_curve", {{"curvature", 0.25}}), (std::vector{0.25, 1.0, 0.0}));
    EXPECT_EQ(read("sampling_jitter", {{"half_width_s", 0.25}}), (std::vector{0.25, 1.0}));
}

// Of a dead zone the lower width is its own, 0 too, and the upper one where it is not known.
TEST(EffectTraits, ADeadZoneHasAWidthBelow) {
    const gap::Effect& effect = gap::effect_named("input_dead_zone");
    const auto levels_with = [&](double down) {
        gap::Scenario scenario;
        effect.add_to(scenario, std::vector{0.5, down});
        std::vector<double> levels{0.75, -0.25, -0.75};
        scenario.levels.at(0)(levels);
        return levels;
    };
    EXPECT_EQ(levels_with(0.25), (std::vector{0.25, 0.0, -0.5}));
    EXPECT_EQ(levels_with(0.0), (std::vector{0.25, -0.25, -0.75}));
    EXPECT_EQ(levels_with(-1.0), (std::vector{0.25, 0.0, -0.25}));
    // Files leave out what is not known.
    const auto written = [&](double down) {
        std::vector<std::string> names;
        for (const gap::Written& one :
             effect.to_contract(effect, std::vector<gap::Fitted>{{0.5, 0.4, 0.6}, {down, down, down}})) {
            names.push_back(one.name);
        }
        return names;
    };
    using testing::ElementsAre;
    EXPECT_THAT(written(0.25), ElementsAre("width", "width_down"));
    EXPECT_THAT(written(0.0), ElementsAre("width", "width_down"));
    EXPECT_THAT(written(-1.0), ElementsAre("width"));
}

// A motor starts beyond its threshold, not at it; where it has no width, at once.
TEST(EffectTraits, AtItsThresholdAMotorStands) {
    for (const double stops_below : {0.0, 1.0}) {
        gap::Scenario scenario;
        gap::effect_named("start_up_threshold").add_to(scenario, std::vector{0.5, stops_below, 0.0});
        std::vector<double> levels{0.5, -0.5, 0.5001, 0.5};
        scenario.levels.at(0)(levels);
        EXPECT_EQ(levels, (std::vector{0.0, 0.0, 0.5001, stops_below > 0.0 ? 0.0 : 0.5}));
    }
}

// Band 0.4 and jump 0.1: it breaks loose at 0.25, over a softness of 0.1 in part, and then slides 0.15 behind.
TEST(EffectTraits, ASoftValveBreaksLooseInPart) {
    const auto first = [](double level) {
        gap::Scenario scenario;
        gap::effect_named("valve_stiction").add_to(scenario, std::vector{0.4, 0.1, 0.1});
        std::vector<double> levels{level};
        scenario.levels.at(0)(levels);
        return levels[0];
    };
    EXPECT_EQ(first(0.19), 0.0);
    EXPECT_NEAR(first(0.225), 0.25 * 0.075, 1e-12);
    EXPECT_NEAR(first(-0.275), -0.75 * 0.125, 1e-12);
    EXPECT_NEAR(first(0.5), 0.35, 1e-12);
}

// With a jump of a tenth of its band at most it is a play of all of it.
TEST(EffectTraits, AValveWithoutAJumpIsAPlay) {
    const gap::Effect& valve = gap::effect_named("valve_stiction");
    for (const double jump : {0.0, 0.04975, 0.05}) {
        const auto only = valve.is_only(std::vector{0.5, jump, 0.004});
        ASSERT_TRUE(only) << jump;
        EXPECT_EQ(only->effect, "input_hysteresis");
        EXPECT_EQ(only->values, (std::vector{0.5, 1.0}));
    }
    EXPECT_FALSE(valve.is_only(std::vector{0.5, 0.05025, 0.004}));
}

// Readings below 0 by a tenth of a turn are half a turn to either side.
TEST(EffectTraits, ATurnBeginsBelowZeroWhereReadingsDo) {
    gap::Scales scales{};
    scales.turn = 1.0;
    for (const auto& [low, begin] : {std::pair(-0.0995, 0.0), std::pair(-0.1005, -0.5)}) {
        scales.output_low = low;
        EXPECT_EQ(gap::effect_named("sensor_wrap").parameters(scales).at(1).starts, std::vector{begin}) << low;
    }
}

}  // namespace
