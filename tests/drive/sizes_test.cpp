// How large small, clear and large are of each effect of blind cases, and between which bounds the rest is drawn: held
// to the extremes of many draws. A size is meant up to 15 % more or less.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "drive/stand/blind/effects.hpp"
#include "drive/stand/blind/family.hpp"
#include "drive/stand/blind/without_model.hpp"

namespace {

namespace blind = stand::blind;
using blind::EffectSize;
using blind::Parameters;
using stand::Chance;

/// The least and the largest of what was seen.
struct Range {
    double least = std::numeric_limits<double>::infinity();
    double most = -std::numeric_limits<double>::infinity();
    void see(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    }
};

// Within the bounds, and up to them: by less than half a per cent of a bound, as plants are made of rounded numbers.
void expect_fills(const Range& range, double low, double high, const std::string& what) {
    const double near_low = 4e-3 * std::max(std::fabs(low), 0.5 * (high - low));
    const double near_high = 4e-3 * std::max(std::fabs(high), 0.5 * (high - low));
    EXPECT_GE(range.least, low - 3e-3 * std::fabs(low)) << what;
    EXPECT_LE(range.least, low + near_low) << what;
    EXPECT_LE(range.most, high + 3e-3 * std::fabs(high)) << what;
    EXPECT_GE(range.most, high - near_high) << what;
}

using Draw = std::function<Parameters(const std::string& effect, EffectSize size, Chance& chance)>;
using Measure = std::function<double(const Parameters& drawn)>;

enum class Sides { one, both };

struct Row {
    const char* effect;
    double small, clear, large;
    Sides sides;
    Measure size_of;  // in the unit of the sizes beside it
};

/// What is drawn evenly between two bounds, whatever the size.
struct Spread {
    const char* effect;
    double low, high;
    Measure of;
};

void expect_sizes(const std::vector<Row>& rows, const Draw& draw) {
    for (const Row& row : rows) {
        Chance chance(5, 17);
        for (const auto& [size, middle] :
             {std::pair(EffectSize::small, row.small), std::pair(EffectSize::clear, row.clear),
              std::pair(EffectSize::large, row.large)}) {
            Range drawn;
            int above = 0;
            constexpr int draws = 800;
            for (int k = 0; k < draws; ++k) {
                const double value = row.size_of(draw(row.effect, size, chance));
                drawn.see(std::fabs(value));
                above += value > 0.0 ? 1 : 0;
            }
            expect_fills(drawn, 0.85 * middle, 1.15 * middle, row.effect);
            if (row.sides == Sides::one) {
                EXPECT_EQ(above, draws) << row.effect;
            } else {
                EXPECT_NEAR(above, draws / 2, draws / 16) << row.effect;
            }
        }
    }
}

void expect_spreads(const std::vector<Spread>& spreads, const Draw& draw) {
    for (const Spread& spread : spreads) {
        Chance chance(7, 17);
        Range drawn;
        for (int k = 0; k < 3000; ++k) {
            drawn.see(spread.of(draw(spread.effect, EffectSize::clear, chance)));
        }
        expect_fills(drawn, spread.low, spread.high, spread.effect);
    }
}

Measure number(const char* name, double unit) {
    return [=](const Parameters& drawn) { return drawn.at(name) / unit; };
}
Measure share_off(const char* name, double unit) {
    return [=](const Parameters& drawn) { return 1.0 - drawn.at(name) / unit; };
}
Measure larger(const char* one, const char* other, double unit) {
    return [=](const Parameters& drawn) {
        const double a = drawn.at(one);
        const double b = drawn.at(other);
        return std::max(a, b) / unit * (a > b ? 1.0 : -1.0);
    };
}
Measure smaller_part(const char* one, const char* other) {
    return [=](const Parameters& drawn) {
        return std::min(drawn.at(one), drawn.at(other)) / std::max(drawn.at(one), drawn.at(other));
    };
}
Measure growth(const char* name) {
    return [=](const Parameters& drawn) { return std::log(drawn.at(name)); };
}
Measure one_over(const char* name, double unit) {
    return [=](const Parameters& drawn) { return unit / drawn.at(name); };
}

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
        Range drawn;
        for (int k = 0; k < 1500; ++k) {
            drawn.see(angle(of_a_machine("gravity_nonlinearity", size, chance)));
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

// A family's plant as its own records show it: what it reads in rest and at its full input.
struct Shown {
    double rest;
    double rise;
    double force_per_size;  // the share of the rise that a disturbance of size 1 takes away
};

blind::Held held_at(const blind::Rig& rig, double level) {
    blind::Held held;
    for (double t = 0.0; t < 120.0 * rig.tau_s; t += rig.clock.interval_s) {
        held.time_s.push_back(t);
        held.input.push_back(level);
    }
    return held;
}

Shown shown_by(const blind::Rig& rig) {
    const double until_s = 1000.0 * rig.tau_s;
    const blind::Held full = held_at(rig, rig.full_input);
    const double rest = rig.read({}, full, {}, 1).front();
    const double top = rig.read({}, full, {}, 1).back();
    // As small as a thousandth of the clear size, so that nothing is empty.
    Chance chance(1, 1);
    const double size = 0.001 * rig.draw("load_disturbance", EffectSize::clear, false, chance).at("size");
    const blind::Fault disturbed{"load_disturbance", {{"size", size}, {"from_s", 0.0}, {"to_s", until_s}}};
    const double less = rig.read(std::vector{disturbed}, full, {}, 1).back();
    return {rest, top - rest, (top - less) / (top - rest) / size};
}

Draw drawn_by(const blind::Rig& rig) {
    return [&](const std::string& effect, EffectSize size, Chance& chance) {
        return rig.draw(effect, size, false, chance);
    };
}

std::vector<Row> common_rows(const blind::Rig& rig, const Shown& shown) {
    const double u = rig.full_input;
    const double tau_s = rig.tau_s;
    const double until_s = rig.clock.until_s;
    return {
        {"gain_error", 0.05, 0.15, 0.3, Sides::both, [](const Parameters& p) { return p.at("gain") - 1.0; }},
        {"time_scale_error", 0.1, 0.2, 0.4, Sides::both, growth("scale")},
        {"dead_time_error", 0.05, 0.15, 0.4, Sides::one, number("extra_s", tau_s)},
        {"actuator_lag", 0.05, 0.15, 0.3, Sides::one, number("tau_s", tau_s)},
        {"sensor_lag", 0.05, 0.15, 0.3, Sides::one, number("tau_s", tau_s)},
        {"sensor_offset", 0.02, 0.06, 0.15, Sides::both, number("offset", shown.rise)},
        {"input_saturation", 0.2, 0.35, 0.5, Sides::one, share_off("limit", u)},
        {"input_dead_zone", 0.06, 0.12, 0.2, Sides::one, number("width", u)},
        {"start_up_threshold", 0.2, 0.3, 0.4, Sides::one, number("threshold", u)},
        {"input_curve", 0.2, 0.45, 0.8, Sides::one, number("curvature", 1.0)},
        {"rate_limit", 0.8, 1.6, 3.0, Sides::one, one_over("per_s", u / tau_s)},
        {"gain_drift", 0.1, 0.2, 0.4, Sides::both, number("per_s", 1.0 / until_s)},
        {"sensor_saturation", 0.25, 0.4, 0.55, Sides::one,
         [=](const Parameters& p) { return 1.0 - (p.at("limit") - shown.rest) / shown.rise; }},
        {"encoder_quantisation", 0.03, 0.06, 0.1, Sides::one, number("step", shown.rise)},
        {"dropped_samples", 0.1, 0.2, 0.35, Sides::one, number("rate", 1.0)},
    };
}

void expect_every_effect_is_sized(const blind::Family& family, const std::vector<Row>& rows) {
    std::set<std::string> sized;
    for (const Row& row : rows) {
        sized.insert(row.effect);
    }
    std::set<std::string> all(family.listed.begin(), family.listed.end());
    all.insert(family.unlisted.begin(), family.unlisted.end());
    all.insert(family.taken_up.begin(), family.taken_up.end());
    EXPECT_EQ(sized, all);
}

TEST(EffectSizes, OfAnOvenAreInItsOwnUnits) {
    bool radiated = false;
    bool bent = false;
    for (std::uint64_t seed = 1; seed <= 20 && !(radiated && bent); ++seed) {
        Chance chance(seed, 3);
        const auto rig = blind::thermal_family().draw({}, chance);
        const Shown shown = shown_by(*rig);
        const bool radiates = shown.rise > 100.0;
        if (radiates ? radiated : bent) {
            continue;
        }
        (radiates ? radiated : bent) = true;
        const double tau_s = rig->tau_s;
        const double until_s = rig->clock.until_s;
        std::vector<Row> rows = common_rows(*rig, shown);
        const double full_w = 1.0 / shown.force_per_size;
        const double hot_k = shown.rest + shown.rise + 273.15;
        const double fourth = std::pow(hot_k, 4) - std::pow(shown.rest + 273.15, 4);
        rows.insert(
            rows.end(),
            {{"direction_asymmetry", 0.2, 0.4, 0.8, Sides::both, larger("tau_up_s", "tau_down_s", tau_s)},
             {"load_disturbance", 0.1, 0.2, 0.35, Sides::both, number("size", full_w)},
             {"sensor_drift", 0.05, 0.1, 0.2, Sides::both,
              [=](const Parameters& p) { return p.begin()->second * until_s / shown.rise; }},
             {"ambient_swing", 0.05, 0.1, 0.2, Sides::one, number("swing_k", shown.rise)},
             {"melting", 2.0, 4.0, 8.0, Sides::one, number("share", 1.0)},
             {"thermostat_fan", 0.4, 0.8, 1.5, Sides::one, number("fan_share", 1.0)},
             {"mains_swing", 0.08, 0.15, 0.3, Sides::one, number("mains_share", 1.0)},
             radiates ? Row{"output_curve", 0.4, 0.8, 1.5, Sides::one, number("radiation_w_per_k4", full_w / fourth)}
                      : Row{"output_curve", 0.1, 0.2, 0.4, Sides::both, number("curvature", 1.0)}});
        expect_sizes(rows, drawn_by(*rig));
        expect_every_effect_is_sized(blind::thermal_family(), rows);
        const auto on = [=](const Parameters& p) { return (p.at("on_c") - shown.rest) / shown.rise; };
        expect_spreads({{"direction_asymmetry", 0.1, 0.35, smaller_part("tau_up_s", "tau_down_s")},
                        {"ambient_swing", 3.0, 8.0, one_over("period_s", until_s)},
                        {"melting", 0.25, 0.45,
                         [=](const Parameters& p) { return (p.at("melting_c") - shown.rest) / shown.rise; }},
                        {"melting", 0.04, 0.08, number("width_k", shown.rise)},
                        {"thermostat_fan", 0.35, 0.5, on},
                        {"thermostat_fan", 0.1, 0.2,
                         [=](const Parameters& p) { return (p.at("on_c") - p.at("off_c")) / shown.rise; }},
                        {"mains_swing", 2.0, 6.0, number("period_s", tau_s)}},
                       drawn_by(*rig));
        Chance once(1, 1);
        EXPECT_DOUBLE_EQ(rig->draw("input_curve", EffectSize::clear, true, once).at("reference"),
                         1.6 * rig->full_input);
        EXPECT_EQ(rig->draw("input_curve", EffectSize::clear, false, once).at("reference"), rig->full_input);
    }
    EXPECT_TRUE(radiated && bent);
}

TEST(EffectSizes, OfTanksAreInTheirOwnUnits) {
    Chance chance(4, 3);
    const auto rig = blind::hydraulic_family().draw({}, chance);
    const Shown shown = shown_by(*rig);
    const double u = rig->full_input;
    const double tau_s = rig->tau_s;
    const double full_flow = 1.0 / shown.force_per_size;
    std::vector<Row> rows = common_rows(*rig, shown);
    rows.insert(rows.end(),
                {{"valve_stiction", 0.05, 0.1, 0.18, Sides::one, number("band", u)},
                 {"input_hysteresis", 0.12, 0.25, 0.4, Sides::one, number("width", u)},
                 {"variable_delay", 0.3, 0.6, 1.0, Sides::one, number("depth_s", tau_s)},
                 {"end_stop", 0.25, 0.4, 0.55, Sides::one, share_off("limit", shown.rise)},
                 {"load_disturbance", 0.08, 0.16, 0.3, Sides::one, number("size", -full_flow)},  // is added
                 {"sensor_drift", 0.05, 0.1, 0.2, Sides::both, number("per_s", shown.rise / rig->clock.until_s)},
                 {"stepped_area", 1.0, 2.0, 4.0, Sides::one, number("wider_share", 1.0)},
                 {"siphon", 0.3, 0.6, 1.0, Sides::one, number("flow", full_flow)},
                 {"pulsing_inflow", 0.05, 0.08, 0.15, Sides::one, number("flow", full_flow)},
                 {"priming_time", 0.4, 0.8, 1.5, Sides::one, number("duration_s", tau_s)},
                 {"bubbles", 0.2, 0.4, 0.6, Sides::one, number("bubbles_share", 1.0)}});
    expect_sizes(rows, drawn_by(*rig));
    // Each effect but this one, which ends at a hole.
    rows.push_back({"output_curve", 0.4, 0.7, 0.95, Sides::one, number("root_share", 1.0)});
    expect_every_effect_is_sized(blind::hydraulic_family(), rows);
    Range small, large;
    for (int k = 0; k < 1500; ++k) {
        small.see(rig->draw("output_curve", EffectSize::small, false, chance).at("root_share"));
        large.see(rig->draw("output_curve", EffectSize::large, false, chance).at("root_share"));
    }
    expect_fills(small, 0.85 * 0.4, 1.15 * 0.4, "output_curve");
    expect_fills(large, 0.85 * 0.95, 1.0, "output_curve");
    expect_spreads({{"input_hysteresis", 0.6, 1.0, number("share", 1.0)},
                    {"variable_delay", 6.0, 14.0, number("period_s", tau_s)},
                    {"stepped_area", 0.25, 0.45, number("from_cm", shown.rise)},
                    {"siphon", 0.35, 0.5, number("on_cm", shown.rise)},
                    {"siphon", 0.2, 0.6, [](const Parameters& p) { return p.at("off_cm") / p.at("on_cm"); }},
                    {"pulsing_inflow", 3.0, 9.0, number("period_s", tau_s)},
                    {"bubbles", 0.8, 2.5, number("for_s", tau_s)}},
                   drawn_by(*rig));
    EXPECT_DOUBLE_EQ(rig->draw("input_curve", EffectSize::clear, true, chance).at("reference"), 1.6 * u);
    EXPECT_EQ(rig->draw("input_curve", EffectSize::clear, false, chance).at("reference"), u);
    const Parameters stiction = rig->draw("valve_stiction", EffectSize::clear, false, chance);
    EXPECT_EQ(stiction.at("jump"), stiction.at("band"));  // it moves all the way
}

// Where each number goes: gain and dead time as they are, time scale by all that stores, and what takes away takes
// away.
TEST(EffectSizes, GoToTheirPlaceInOvensAndTanks) {
    for (const blind::Family* family : {&blind::thermal_family(), &blind::hydraulic_family()}) {
        Chance chance(11, 3);
        const auto rig = family->draw({}, chance);
        const blind::Held full = held_at(*rig, rig->full_input);
        const auto plain = rig->read({}, full, {}, 1);
        const auto with = [&](const char* effect, Parameters parameters) {
            return rig->read(std::vector{blind::Fault{effect, std::move(parameters)}}, full, {}, 1);
        };
        const double rise = plain.back() - plain.front();
        EXPECT_NEAR((with("gain_error", {{"gain", 1.25}}).back() - plain.front()) / rise, 1.25, 1e-4) << family->domain;
        const auto late = with("dead_time_error", {{"extra_s", 10.0 * rig->clock.interval_s}});
        for (std::size_t k = 10; k < 400; ++k) {
            EXPECT_NEAR(late[k], plain[k - 10], 2e-3 * rise) << family->domain << ' ' << k;
        }
        // How long it takes for half of the rise grows evenly with the scale.
        const auto half_way = [&](const std::vector<double>& readings) {
            const double half = 0.5 * (readings.front() + readings.back());
            return static_cast<double>(
                std::find_if(readings.begin(), readings.end(), [&](double z) { return z > half; }) - readings.begin());
        };
        const double once = half_way(plain);
        const double twice = half_way(with("time_scale_error", {{"scale", 2.0}}));
        const double thrice = half_way(with("time_scale_error", {{"scale", 3.0}}));
        EXPECT_GT(twice, once + 5.0);
        EXPECT_NEAR((thrice - twice) / (twice - once), 1.0, 0.1) << family->domain;
        // Lags come later to half of the rise, and end where it does.
        for (const char* lag : {"actuator_lag", "sensor_lag"}) {
            const auto lagging = with(lag, {{"tau_s", rig->tau_s}});
            EXPECT_GT(half_way(lagging), once + 5.0) << lag;
            EXPECT_NEAR(lagging.back(), plain.back(), 2e-3 * rise) << lag;
        }
        const auto ends = [&](const char* effect, Parameters parameters) {
            return (with(effect, std::move(parameters)).back() - plain.front()) / rise;
        };
        const double u = rig->full_input;
        EXPECT_NEAR(ends("input_saturation", {{"limit", 0.6 * u}}), 0.6, 1e-3);
        EXPECT_NEAR(ends("input_dead_zone", {{"width", 0.2 * u}}), 0.8, 1e-3);
        EXPECT_NEAR(ends("start_up_threshold", {{"threshold", 1.1 * u}}), 0.0, 1e-3);
        EXPECT_NEAR(ends("input_curve", {{"curvature", 0.5}, {"reference", 2.0 * u}}), 0.75, 1e-3);
        EXPECT_GT(ends("gain_drift", {{"per_s", 0.1 / full.time_s.back()}}), 1.08);
        EXPECT_LT(ends("gain_drift", {{"per_s", 0.1 / full.time_s.back()}}), 1.101);
        EXPECT_GT(half_way(with("rate_limit", {{"per_s", u / (4.0 * rig->tau_s)}})), once + 20.0);
    }
}

}  // namespace
