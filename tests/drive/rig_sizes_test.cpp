// How large small, clear and large are of each effect of an oven or of tanks in blind cases, and what each number does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "drive/stand/blind/family.hpp"
#include "tests/drive/sizes.hpp"

namespace {

namespace blind = stand::blind;
using blind::EffectSize;
using blind::Parameters;
using stand::Chance;
using test::Draw;
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
    Seen small, large;
    for (int k = 0; k < 1500; ++k) {
        small(rig->draw("output_curve", EffectSize::small, false, chance).at("root_share"));
        large(rig->draw("output_curve", EffectSize::large, false, chance).at("root_share"));
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
