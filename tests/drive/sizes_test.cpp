// How large small, clear and large are of each effect of a machine in blind cases, and between which bounds the rest is
// drawn.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "drive/stand/blind/effects.hpp"
#include "drive/stand/blind/family.hpp"
#include "drive/stand/blind/without_model.hpp"
#include "tests/drive/sizes.hpp"

namespace {

namespace blind = stand::blind;
using blind::EffectSize;
using blind::Parameters;
using stand::Chance;
using test::expect_fills;
using test::expect_sizes;
using test::expect_spreads;
using test::growth;
using test::larger;
using test::number;
using test::one_over;
using test::Row;
using test::Seen;
using test::share_off;
using test::Sides;
using test::smaller_part;

constexpr blind::Scale scale{.full_input = 3.0,
                             .full_output = 7.0,
                             .force = 11.0,
                             .tau_s = 0.5,
                             .interval_s = 0.01,
                             .until_s = 40.0,
                             .charge = 60.0};

Parameters of_a_machine(const std::string& effect, EffectSize size, Chance& chance) {
    return blind::draw_parameters(effect, size, scale, false, chance);
}

TEST(EffectSizes, OfAMachineAreInItsOwnUnits) {
    const double u = scale.full_input;
    const double y = scale.full_output;
    const double force = scale.force;
    const double tau_s = scale.tau_s;
    const double until_s = scale.until_s;
    const double speed = 0.4 * y / tau_s;
    const std::vector<Row> rows{
        {"gain_error", 0.03, 0.08, 0.2, Sides::both, [](const Parameters& p) { return p.at("gain") - 1.0; }},
        {"time_scale_error", 0.06, 0.15, 0.35, Sides::both, growth("scale")},
        {"dead_time_error", 0.05, 0.15, 0.4, Sides::one, number("extra_s", tau_s)},
        {"order_error", 0.02, 0.05, 0.1, Sides::one, number("shift", -1.0)},
        {"input_saturation", 0.1, 0.25, 0.4, Sides::one, share_off("limit", u)},
        {"input_dead_zone", 0.04, 0.1, 0.2, Sides::one, number("width", u)},
        {"start_up_threshold", 0.2, 0.35, 0.5, Sides::one, number("threshold", u)},
        {"input_curve", 0.15, 0.4, 0.8, Sides::one, number("curvature", 1.0)},
        {"rate_limit", 0.6, 1.5, 3.0, Sides::one, one_over("per_s", u / tau_s)},
        {"actuator_lag", 0.1, 0.3, 0.7, Sides::one, number("tau_s", tau_s)},
        {"sensor_lag", 0.1, 0.3, 0.7, Sides::one, number("tau_s", tau_s)},
        {"supply_sag", 0.05, 0.12, 0.3, Sides::one, number("per_unit_s", 1.0 / scale.charge)},
        {"gain_drift", 0.05, 0.12, 0.3, Sides::both, number("per_s", 1.0 / until_s)},
        {"coulomb_friction", 0.02, 0.06, 0.15, Sides::one, number("force", force)},
        {"direction_dependent_friction", 0.04, 0.1, 0.2, Sides::both, larger("force_up", "force_down", force)},
        {"quadratic_drag", 0.1, 0.3, 0.9, Sides::one, number("coefficient", force / (speed * speed))},
        {"end_stop", 0.08, 0.2, 0.4, Sides::one, share_off("limit", y)},
        {"backlash", 0.02, 0.06, 0.15, Sides::one, number("gap", y)},
        {"structural_resonance", 0.03, 0.08, 0.2, Sides::one, number("share", 1.0)},
        {"direction_asymmetry", 0.1, 0.3, 0.7, Sides::both, larger("tau_up_s", "tau_down_s", tau_s)},
        {"output_curve", 0.06, 0.15, 0.35, Sides::both, number("curvature", 1.0)},
        {"load_disturbance", 0.06, 0.15, 0.35, Sides::both, number("size", force)},
        {"sensor_offset", 0.01, 0.04, 0.1, Sides::both, number("offset", y)},
        {"sensor_drift", 0.02, 0.06, 0.2, Sides::both, number("per_s", y / until_s)},
        {"sensor_saturation", 0.08, 0.2, 0.4, Sides::one, share_off("limit", y)},
        {"encoder_quantisation", 0.015, 0.04, 0.1, Sides::one, number("step", y)},
        {"missed_counts", 0.015, 0.05, 0.12, Sides::both, number("sizes", y)},
        {"sampling_jitter", 0.3, 0.6, 0.86, Sides::one, number("half_width_s", scale.interval_s)},
        {"dropped_samples", 0.06, 0.15, 0.35, Sides::one, number("rate", 1.0)},
        {"cogging", 0.5, 0.9, 1.5, Sides::one,
         [=](const Parameters& p) { return p.at("cogging_force") * p.at("cogging_per_unit") * y / force; }},
        {"hum", 0.03, 0.07, 0.15, Sides::one, number("hum_force", force)},
        {"ground_effect", 0.15, 0.3, 0.6, Sides::one, number("near_gain", 1.0)},
        {"stiffening", 0.15, 0.35, 0.8, Sides::one, number("stiffening", force / (y * y * y))},
        {"level_dependent_delay", 0.2, 0.5, 1.0, Sides::one, number("delay_at_rest_s", tau_s)},
        {"input_hysteresis", 0.05, 0.12, 0.25, Sides::one, number("hysteresis", u)},
        {"damping_growth", 0.5, 1.2, 2.5, Sides::one, number("damping_growth", force * tau_s / y / until_s)},
        {"input_step", 0.08, 0.14, 0.2, Sides::one, number("input_step", u)},
        {"falling_gain", 0.06, 0.14, 0.25, Sides::one, number("falling_gain", 1.0)},
        {"slipping_belt", 0.08, 0.2, 0.4, Sides::one, number("slip_per_unit", 1.0)},
        {"start_up_time", 0.3, 0.7, 1.5, Sides::one, number("duration_s", tau_s)},
    };
    expect_sizes(rows, of_a_machine);
    // Each effect but this one, whose largest is cut off before the pendulum could stand upright.
    std::set<std::string> sized{"gravity_nonlinearity"};
    for (const Row& row : rows) {
        sized.insert(row.effect);
    }
    std::set<std::string> all(blind::listed_effects().begin(), blind::listed_effects().end());
    all.insert(blind::unlisted_effects().begin(), blind::unlisted_effects().end());
    EXPECT_EQ(sized, all);
    const auto angle = number("angle_per_unit", 1.0 / y);
    for (const auto& [size, low, high] :
         {std::tuple(EffectSize::small, 0.85 * 0.45, 1.15 * 0.45),
          std::tuple(EffectSize::clear, 0.85 * 0.65, 1.15 * 0.65), std::tuple(EffectSize::large, 0.85 * 0.82, 0.92)}) {
        Chance chance(5, 17);
        Seen drawn;
        for (int k = 0; k < 1500; ++k) {
            drawn(angle(of_a_machine("gravity_nonlinearity", size, chance)));
        }
        expect_fills(drawn, low, high, "gravity_nonlinearity");
    }
    expect_spreads({{"direction_dependent_friction", 0.1, 0.35, smaller_part("force_up", "force_down")},
                    {"end_stop", 0.0, 0.5, number("restitution", 1.0)},
                    {"structural_resonance", 2.0, 5.0, number("hz", 1.0 / tau_s)},
                    {"structural_resonance", 0.015, 0.06, number("damping", 1.0)},
                    {"direction_asymmetry", 0.1, 0.4, smaller_part("tau_up_s", "tau_down_s")},
                    {"cogging", 2.0, 5.0, number("cogging_per_unit", 2.0 * std::numbers::pi / y)},
                    {"hum", 0.08, 0.4, number("hum_hz", 1.0 / tau_s)}},
                   of_a_machine);
}

// Of a machine that was drawn: of its own input, time constant and record. A record's mean input is half of the full
// one.
TEST(EffectSizes, AreInTheUnitsOfTheMachineThatWasDrawn) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        Chance chance(seed, 5);
        const auto rig = blind::mechanical_family().draw({}, chance);
        const auto one = [&](const char* effect) {
            return rig->draw(effect, EffectSize::clear, false, chance).begin()->second;
        };
        const double until_s = rig->clock.until_s;
        EXPECT_NEAR(one("supply_sag") * 0.5 * rig->full_input * until_s, 0.12, 0.15 * 0.12) << seed;
        EXPECT_NEAR(std::fabs(one("gain_drift")) * until_s, 0.12, 0.15 * 0.12) << seed;
        EXPECT_NEAR(one("rate_limit") * rig->tau_s / rig->full_input, 1.0 / 1.5, 0.18 / 1.5) << seed;
        EXPECT_NEAR(one("actuator_lag") / rig->tau_s, 0.3, 0.15 * 0.3) << seed;
    }
}

TEST(EffectSizes, AtOneLevelBendWhereTheLevelIsNot) {
    const auto at_one_level = [](const std::string& effect, EffectSize size, Chance& chance) {
        return blind::draw_parameters(effect, size, scale, true, chance);
    };
    expect_sizes({{"supply_sag", 0.05, 0.12, 0.25, Sides::one, number("resistance", 1.0 / scale.full_input)}},
                 at_one_level);
    Chance chance(1, 1);
    EXPECT_DOUBLE_EQ(at_one_level("input_curve", EffectSize::clear, chance).at("reference"), 1.6 * scale.full_input);
    EXPECT_EQ(of_a_machine("input_curve", EffectSize::clear, chance).at("reference"), scale.full_input);
    EXPECT_EQ(of_a_machine("output_curve", EffectSize::clear, chance).at("reference"), scale.full_output);
    // A resonance that a sampled record could not show is slower: a fifth of the samples at most.
    blind::Scale quick = scale;
    quick.tau_s = 0.01;
    EXPECT_EQ(blind::draw_parameters("structural_resonance", EffectSize::clear, quick, false, chance).at("hz"),
              0.2 / scale.interval_s);
}

TEST(EffectSizes, EventsLieWithinTheirRecord) {
    const auto event = [](const std::string& effect, EffectSize, Chance& chance) {
        Parameters drawn;
        blind::draw_event(effect, drawn, scale, chance);
        return drawn;
    };
    expect_spreads({{"load_disturbance", 0.15, 0.65, number("from_s", scale.until_s)},
                    {"load_disturbance", 0.08, 0.25,
                     [](const Parameters& p) { return (p.at("to_s") - p.at("from_s")) / scale.until_s; }},
                    {"missed_counts", 0.15, 0.75, number("at_s", scale.until_s)}},
                   event);
    Chance chance(1, 1);
    EXPECT_TRUE(event("backlash", EffectSize::clear, chance).empty());
}

// Without a model: from the record's first stamp on, here 3 s.
TEST(EffectSizes, EventsWithoutAModelLieWithinTheirRecord) {
    constexpr double first_s = 3.0;
    const auto event = [](const std::string& effect, EffectSize, Chance& chance) {
        blind::Fault fault{effect, {}};
        blind::place_event(fault, first_s, scale.until_s, chance);
        return fault.parameters;
    };
    const auto behind = [](const char* from, const char* to) {
        return
            [=](const Parameters& p) { return (p.at(to) - (from != nullptr ? p.at(from) : first_s)) / scale.until_s; };
    };
    expect_spreads({{"load_disturbance", 0.15, 0.6, behind(nullptr, "from_s")},
                    {"load_disturbance", 0.1, 0.25, behind("from_s", "to_s")},
                    {"missed_counts", 0.15, 0.6, behind(nullptr, "at_s")}},
                   event);
}

TEST(EffectSizes, GoToTheirPlace) {
    blind::Setup setup;
    setup.plant.terms = {{1.0, 1.9}, {1.0, 0.1}, {1.0, 0.0}};
    blind::apply("order_error", {{"shift", -0.08}}, setup);
    EXPECT_DOUBLE_EQ(setup.plant.terms[0].order, 1.82);
    EXPECT_DOUBLE_EQ(setup.plant.terms[1].order, 0.05);  // not below
    EXPECT_EQ(setup.plant.terms[2].order, 0.0);
    blind::apply("missed_counts", {{"at_s", 3.0}, {"sizes", 0.25}}, setup);
    EXPECT_EQ(setup.missed_at_s, 3.0);
    EXPECT_EQ(setup.missed_size, 0.25);
    blind::apply("hum", {{"hum_force", 0.5}, {"hum_hz", 2.0}}, setup);
    EXPECT_EQ(setup.unlisted.hum_force, 0.5);
    EXPECT_EQ(setup.unlisted.hum_hz, 2.0);
    blind::apply("backlash", {{"gap", 0.125}}, setup);
    EXPECT_EQ(setup.stand.backlash_rad, 0.125);
}

}  // namespace
