// How far each effect's numbers may go, where fits of them begin, and in which records they can occur at all: in units
// of what the training records hold.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "gap/drive/candidate.hpp"
#include "gap/drive/effect.hpp"
#include "tests/gap/effect_scales.hpp"

namespace {

using scales_test::dt;
using scales_test::far;
using scales_test::force;
using scales_test::high;
using scales_test::length;
using scales_test::low;
using scales_test::pi;
using scales_test::scales;
using scales_test::span;
using scales_test::speed;
using scales_test::tc;
using scales_test::u;
using Values = std::vector<double>;

// A number's bounds, the value that is none, and its starts. Behind `free_starts` of them it stays there.
struct Range {
    const char* name;
    const char* unit;
    double lower;
    double upper;
    double none;
    Values starts;
    bool stays = false;
    std::size_t free_starts = std::numeric_limits<std::size_t>::max();
};

void expect_ranges(const std::string& effect, const gap::Scales& of, const std::vector<Range>& wanted) {
    const auto found = gap::effect_named(effect).parameters(of);
    ASSERT_EQ(found.size(), wanted.size()) << effect;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const std::string name = effect + "." + wanted[i].name;
        const auto near = [&](double a, double b) { return std::fabs(a - b) <= 1e-9 * std::fabs(b); };
        EXPECT_EQ(effect + "." + found[i].name, name);
        EXPECT_EQ(found[i].unit, wanted[i].unit) << name;
        EXPECT_PRED2(near, found[i].lower, wanted[i].lower) << name;
        EXPECT_PRED2(near, found[i].upper, wanted[i].upper) << name;
        EXPECT_PRED2(near, found[i].none, wanted[i].none) << name;
        EXPECT_EQ(found[i].discrete, wanted[i].stays) << name;
        EXPECT_EQ(found[i].free_starts, wanted[i].free_starts) << name;
        ASSERT_EQ(found[i].starts.size(), wanted[i].starts.size()) << name;
        for (std::size_t s = 0; s < found[i].starts.size(); ++s) {
            EXPECT_PRED2(near, found[i].starts[s], wanted[i].starts[s]) << name << " start " << s;
        }
    }
}

void expect_none(const std::string& effect, const gap::Scales& of) {
    EXPECT_TRUE(gap::effect_named(effect).parameters(of).empty()) << effect;
}

TEST(EffectNumbers, OfTheCommandAndTheActuator) {
    expect_ranges("gain_error", scales(), {{"gain", "1", 0.05, 20.0, 1.0, {0.7, 1.4}}});
    expect_ranges("dead_time_error", scales(),
                  {{"extra_s", "s", -4.0 * tc, 4.0 * tc, 0.0, {-0.3 * tc, 0.1 * tc, 0.5 * tc}}});
    expect_ranges("input_saturation", scales(), {{"limit", "u", 0.05 * u, u, u, {0.5 * u, 0.8 * u}}});
    expect_ranges("rate_limit", scales(),
                  {{"per_s", "u/s", 0.02 * u / tc, 2.0 * u / dt, 2.0 * u / dt, {0.5 * u / tc, 3.0 * u / tc}}});
    expect_ranges("actuator_lag", scales(), {{"tau_s", "s", 0.0, 3.0 * tc, 0.0, {0.1 * tc, 0.4 * tc}}});
    expect_ranges("supply_sag", scales(),
                  {{"per_unit_s", "1/(u s)", 0.0, 0.9 / (u * length), 0.0, {0.15 / (u * length), 0.5 / (u * length)}},
                   {"resistance", "1/u", 0.0, 0.6 / u, 0.0, {0.02 / u}}});
    expect_ranges("gain_drift", scales(),
                  {{"per_s", "1/s", -0.9 / length, 2.0 / length, 0.0, {-0.15 / length, 0.15 / length}}});
    const Values thresholds{0.1 * u, 0.2 * u, 0.3 * u, 0.4 * u, 0.5 * u, 0.65 * u};
    Values both = thresholds;
    both.insert(both.end(), thresholds.begin(), thresholds.end());
    expect_ranges("start_up_threshold", scales(),
                  {{"threshold", "u", 0.0, 0.95 * u, 0.0, both},
                   {"stops_below", "1", 0.0, 1.0, 0.0, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}, true},
                   {"width", "u", 0.0, u, 0.0, {0.004 * u}, true}});
    Values phases;
    for (int k = -7; k <= 8; ++k) {
        phases.push_back(k * pi / 8.0);
    }
    expect_ranges("variable_delay", scales(),
                  {{"depth_s", "s", -2.0 * tc, 2.0 * tc, 0.0, {0.1 * tc}},
                   {"period_s",
                    "s",
                    4.0 * dt,
                    2.0 * length,
                    2.0 * length,
                    {0.6 * length, 0.3 * length, 0.15 * length, 0.08 * length}},
                   {"phase_rad", "rad", -4.0 * pi, 4.0 * pi, 0.0, phases}});
}

// A command of two signs has twice the range, and a dead zone two widths.
TEST(EffectNumbers, GoByTheSignsOfTheInput) {
    gap::Scales two = scales();
    two.two_signs = true;
    for (const auto& [of, range] : {std::pair(scales(), u), std::pair(two, 2.0 * u)}) {
        expect_ranges("input_hysteresis", of,
                      {{"width", "u", 0.0, 0.9 * range, 0.0, {0.1 * range, 0.3 * range, 0.6 * range}},
                       {"share", "1", 0.0, 1.0, 0.0, {0.9, 0.6, 0.6}}});
        expect_ranges("valve_stiction", of,
                      {{"band", "u", 0.0, range, 0.0, {0.05 * range, 0.15 * range, 0.4 * range}},
                       {"jump", "u", 0.0, range, 0.0, {0.02 * range, 0.06 * range, 0.16 * range}},
                       {"softness", "u", 0.0, u, 0.0, {0.004 * u}, true}});
    }
    const Range width{"width", "u", 0.0, 0.9 * u, 0.0, {0.08 * u, 0.3 * u}};
    expect_ranges("input_dead_zone", scales(), {width, {"width_down", "u", -1.0, -1.0, -1.0, {-1.0}, true}});
    expect_ranges("input_dead_zone", two, {width, {"width_down", "u", 0.0, 0.9 * u, 0.0, {0.08 * u, 0.3 * u}}});
}

// At two levels, 0 among them, a bend is any gain, and its reference is told by none.
TEST(EffectNumbers, OfABendGoByTheLevels) {
    gap::Scales few = scales();
    few.input_levels = 2;
    expect_ranges("input_curve", few,
                  {{"curvature", "1", -0.9, 1.0, 0.0, {-0.3, 0.3, 0.8, -0.3, 0.3}},
                   {"reference", "u", 0.5 * u, u, u, {u, u, u, 0.5 * u, 0.5 * u}, true}});
    few.input_levels = 3;
    expect_ranges(
        "input_curve", few,
        {{"curvature", "1", -0.9, 1.0, 0.0, {-0.3, 0.3, 0.8}}, {"reference", "u", 0.3 * u, 4.0 * u, u, {u, u, u}}});
}

TEST(EffectNumbers, OfASecondInputGoByItsSize) {
    expect_none("second_input", scales());
    gap::Scales with = scales();
    with.further_max = 3.4;
    const double unit = 0.5;
    expect_ranges("second_input", with,
                  {{"gain", "u/u2", -50.0 * unit, 50.0 * unit, 0.0, {0.2 * unit, -0.2 * unit, 0.2 * unit, -0.2 * unit}},
                   {"tau_s", "s", 0.0, 10.0 * tc, 0.0, {0.1 * tc, 0.1 * tc, 2.0 * tc, 2.0 * tc}}});
    // A lag that outlasts the records is a drift.
    with.length_s = 3.0 * tc;
    expect_ranges("second_input", with,
                  {{"gain", "u/u2", -50.0 * unit, 50.0 * unit, 0.0, {0.2 * unit, -0.2 * unit, 0.2 * unit, -0.2 * unit}},
                   {"tau_s", "s", 0.0, 3.0 * tc, 0.0, {0.075 * tc, 0.075 * tc, 1.5 * tc, 1.5 * tc}}});
}

TEST(EffectNumbers, OfThePlant) {
    gap::Scales drifts = scales();
    drifts.steady = false;
    gap::Scales speeds = scales();
    speeds.maybe_speed = true;
    gap::Scales swings = scales();
    swings.swings = true;
    gap::Scales one = scales();
    one.orders = 1;
    expect_ranges("time_scale_error", scales(), {{"scale", "1", 0.2, 5.0, 1.0, {0.8, 1.25}}});
    const Range shift{"shift", "1", -0.5, 0.5, 0.0, {-0.1, 0.1}};
    expect_ranges("order_error", scales(), {shift, {"power", "1", 0.0, 8.0, 0.0, {0, 0, 1, 1, 8, 8}, true}});
    expect_ranges("order_error", one, {shift, {"power", "1", 0.0, 8.0, 0.0, {0}, true}});
    const Range of_place{"of_speed", "1", 0.0, 1.0, 0.0, {0.0}, true};
    expect_ranges("coulomb_friction", scales(),
                  {{"force", "rhs", 0.0, 0.7 * force, 0.0, {0.02 * force, 0.1 * force}}, of_place});
    expect_ranges("coulomb_friction", speeds,
                  {{"force", "rhs", 0.0, 0.7 * force, 0.0, {0.02 * force, 0.1 * force, 0.02 * force, 0.1 * force}},
                   {"of_speed", "1", 0.0, 1.0, 0.0, {0, 0, 1, 1}, true}});
    const Values up{0.02 * force, 0.1 * force, 0.1 * force};
    const Values down{0.1 * force, 0.02 * force, 0.15 * force};
    expect_ranges("direction_dependent_friction", scales(),
                  {{"force_up", "rhs", 0.0, 0.7 * force, 0.0, up},
                   {"force_down", "rhs", 0.0, 0.7 * force, 0.0, down},
                   {"of_speed", "1", 0.0, 1.0, 0.0, {0, 0, 0}, true}});
    expect_ranges("direction_dependent_friction", speeds,
                  {{"force_up", "rhs", 0.0, 0.7 * force, 0.0, {up[0], up[1], up[2], up[0], up[1], up[2]}},
                   {"force_down", "rhs", 0.0, 0.7 * force, 0.0, {down[0], down[1], down[2], down[0], down[1], down[2]}},
                   {"of_speed", "1", 0.0, 1.0, 0.0, {0, 0, 0, 1, 1, 1}, true}});
    expect_ranges("load_dependent_friction", scales(), {{"share", "1", 0.0, 0.6, 0.0, {0.02, 0.1}}});
    const double drag = force / (speed * speed);
    expect_ranges("quadratic_drag", scales(),
                  {{"coefficient", "rhs/speed^2", 0.0, 5.0 * drag, 0.0, {0.1 * drag, 0.6 * drag}},
                   {"of_speed", "1", 0.0, 1.0, 0.0, {0}, true}});
    const double brake = force / (far * far);
    expect_ranges("quadratic_drag", speeds,
                  {{"coefficient",
                    "rhs/speed^2",
                    0.0,
                    5.0 * drag,
                    0.0,
                    {0.1 * drag, 0.6 * drag, 0.1 * brake, 0.6 * brake, 2.0 * brake}},
                   {"of_speed", "1", 0.0, 1.0, 0.0, {0, 0, 1, 1, 1}, true}});
    gap::Scales released = speeds;
    released.driven = false;
    for (const char* effect : {"gravity_nonlinearity", "cubic_stiffness"}) {
        expect_none(effect, drifts);
        expect_none(effect, speeds);
        EXPECT_TRUE(gap::applies(gap::effect_named(effect), released)) << effect;
    }
    expect_ranges(
        "gravity_nonlinearity", scales(),
        {{"angle_per_unit", "rad/y", 1e-3 / span, 3.0 / far, 1e-3 / span, {0.5 / far, 1.0 / far, 2.0 / far}}});
    const double cube = 1.0 / (far * far);
    expect_ranges("cubic_stiffness", scales(),
                  {{"coefficient", "1/y^2", -0.32 * cube, 20.0 * cube, 0.0, {0.2 * cube, 2.0 * cube, -0.1 * cube}}});
    for (const auto& [of, way, variant] :
         {std::tuple(scales(), span, 0.0), std::tuple(speeds, 0.5 * far * length, 1.0)}) {
        expect_ranges("cogging", of,
                      {{"size", "rhs", -0.6 * force, 0.6 * force, 0.0, {0.05 * force}},
                       {"per_unit",
                        "1/y",
                        3.0 / way,
                        200.0 / way,
                        3.0 / way,
                        {4 / way, 4 / way, 8 / way, 8 / way, 16 / way, 16 / way, 32 / way, 32 / way}},
                       {"phase_rad", "rad", -4.0 * pi, 4.0 * pi, 0.0, {0, pi / 2, 0, pi / 2, 0, pi / 2, 0, pi / 2}},
                       {"of_speed", "1", 0.0, 1.0, 0.0, {variant}, true}});
    }
    // What drains may be the lower one of two tanks: what integrates, swings or moves is none.
    gap::Scales moves = scales();
    moves.drains = false;
    const double near = high - 0.02 * span;
    const double below = high - 0.15 * span;
    for (const gap::Scales& of : {drifts, swings, moves}) {
        expect_ranges("end_stop", of,
                      {{"limit", "y", low + 0.3 * span, high + 0.02 * span, high + 0.02 * span, {near, below}},
                       {"restitution", "1", 0.0, 0.9, 0.0, {0.0}},
                       {"before_s", "s", 0.0, 0.0, 0.0, {0.0}, true},
                       {"spill", "1", 0.0, 0.0, 0.0, {0.0}, true}});
    }
    expect_ranges("end_stop", scales(),
                  {{"limit", "y", low + 0.3 * span, high + 0.02 * span, high + 0.02 * span, {near, below, near, below}},
                   {"restitution", "1", 0.0, 0.9, 0.0, {0.0}, true},
                   {"before_s", "s", 0.0, 3.0 * tc, 0.0, {0.5 * tc, 0.5 * tc, 0.0, 0.0}, false, 2},
                   {"spill", "1", 0.0, 1.0, 0.0, {0.5, 0.5, 0.0, 0.0}, false, 2}});
    expect_ranges("load_disturbance", scales(),
                  {{"from_s", "s", 0.0, length, 0.0, {0.35 * length}},
                   {"to_s", "s", 0.0, length, 0.0, {0.5 * length}},
                   {"size", "rhs", -force, force, 0.0, {0.05 * force}}});
    // An outflow bends what drains: what neither integrates nor swings, nor moves.
    const Range about{"reference", "y", 0.3 * far, 3.0 * far, far, {far}};
    for (const gap::Scales& of : {drifts, swings, moves}) {
        expect_ranges("output_curve", of,
                      {{"curvature", "1", -0.9, 0.9, 0.0, {-0.25, 0.25}},
                       about,
                       {"in_outflow", "1", 0.0, 1.0, 0.0, {0.0}, true}});
    }
    expect_ranges("output_curve", scales(),
                  {{"curvature", "1", -0.9, 0.9, 0.0, {-0.25, 0.25, -0.5, 0.25}},
                   about,
                   {"in_outflow", "1", 0.0, 1.0, 0.0, {0, 0, 1, 1}, true}});
}

TEST(EffectNumbers, OfTheOutputTheSensorAndTheLogger) {
    expect_ranges("backlash", scales(), {{"gap", "y", 0.0, 0.6 * span, 0.0, {0.02 * span, 0.1 * span}}});
    const Values hz{1 / tc, 2.5 / tc, 0.05 / dt, 0.12 / dt};
    expect_ranges(
        "structural_resonance", scales(),
        {{"hz", "Hz", 0.3 / tc, 0.45 / dt, 0.3 / tc, {hz[0], hz[1], hz[2], hz[3], hz[0], hz[1], hz[2], hz[3]}},
         {"damping", "1", 0.002, 0.5, 0.05, {0.05}},
         {"share", "1", -0.8, 0.8, 0.0, {0.03}},
         {"of_speed", "1", 0.0, 1.0, 0.0, {0, 0, 0, 0, 1, 1, 1, 1}, true}});
    expect_ranges("direction_asymmetry", scales(),
                  {{"tau_up_s", "s", 0.0, 3.0 * tc, 0.0, {0.2 * tc, 0.01 * tc}},
                   {"tau_down_s", "s", 0.0, 3.0 * tc, 0.0, {0.01 * tc, 0.2 * tc}}});
    expect_ranges("sensor_offset", scales(), {{"offset", "y", -span, span, 0.0, {0.05 * span}}});
    expect_ranges("sensor_drift", scales(),
                  {{"per_s", "y/s", -0.8 * span / length, 0.8 * span / length, 0.0, {0.05 * span / length}}});
    expect_ranges("sensor_lag", scales(), {{"tau_s", "s", 0.0, 3.0 * tc, 0.0, {0.1 * tc, 0.4 * tc}}});
    expect_ranges("sensor_saturation", scales(),
                  {{"limit",
                    "y",
                    low + 0.2 * span,
                    high + 0.02 * span,
                    high + 0.02 * span,
                    {high - 0.01 * span, high - 0.15 * span}}});
    gap::Scales unclipped = scales();
    unclipped.may_clip = false;
    expect_none("sensor_saturation", unclipped);
    expect_ranges("logger_filter", scales(), {{"window_s", "s", 0.0, 3.0 * tc, 0.0, {0.1 * tc, 0.4 * tc}}});
    expect_ranges(
        "sampling_jitter", scales(),
        {{"half_width_s", "s", 0.0, dt, 0.0, {0.3 * dt}, true}, {"noise_share", "1", 0.0, 1.0, 1.0, {1.0}, true}});
    std::vector<Range> jumps;
    for (const auto& [at, size] :
         {std::pair("at_s", "size"), std::pair("at2_s", "size2"), std::pair("at3_s", "size3")}) {
        jumps.push_back({at, "s", 0.0, length, 0.0, {0.0}, true});
        jumps.push_back({size, "y", -span, span, 0.0, {0.0}});
    }
    expect_ranges("missed_counts", scales(), jumps);
}

// What the audit found is no number to be fitted; what it did not find cannot be there.
TEST(EffectNumbers, AreThoseOfTheAudit) {
    gap::Scales found = scales();
    expect_none("dropped_samples", found);
    expect_none("encoder_quantisation", found);
    found.held_share = 0.07;
    found.quantum = 0.013;
    expect_ranges("dropped_samples", found, {{"rate", "1", 0.07, 0.07, 0.0, {0.07}, true}});
    expect_ranges("encoder_quantisation", found, {{"step", "y", 0.013, 0.013, 0.0, {0.013}, true}});
    // Readings that go below 0, noise of a twentieth of their span aside, have their sign. What is pushed one way only
    // and does not swing never had another.
    found.two_signs = true;
    expect_none("sensor_magnitude", found);
    found.output_low = -0.05 * span;
    expect_ranges("sensor_magnitude", found, {{"there", "1", 1.0, 1.0, 0.0, {1.0}, true}});
    found.two_signs = false;
    expect_none("sensor_magnitude", found);
    found.swings = true;
    expect_ranges("sensor_magnitude", found, {{"there", "1", 1.0, 1.0, 0.0, {1.0}, true}});
    found.swings = found.driven = false;
    expect_ranges("sensor_magnitude", found, {{"there", "1", 1.0, 1.0, 0.0, {1.0}, true}});
    found.driven = found.two_signs = true;
    found.output_low = -0.0501 * span;
    expect_none("sensor_magnitude", found);
}

// A turn of 1, 2 pi or 360 is more likely than one near it. Readings below 0 are half a turn to either side.
TEST(EffectNumbers, OfATurnAreWhatReadingsJumpByOrAUsualOne) {
    expect_none("sensor_wrap", scales());
    gap::Scales jumps = scales();
    const auto expect_turn = [&](double turn, const Values& starts, double begin) {
        jumps.turn = turn;
        expect_ranges("sensor_wrap", jumps,
                      {{"turn", "y", 0.8 * turn, 1.25 * turn, 0.0, starts, false, 1},
                       {"begin", "y", begin, begin, 0.0, {begin}, true}});
    };
    jumps.output_low = 0.0;
    expect_turn(25.0, {25.0}, 0.0);
    expect_turn(1.02, {1.02, 1.0}, 0.0);
    expect_turn(6.3, {6.3, 2.0 * pi}, 0.0);
    expect_turn(351.0, {351.0, 360.0}, 0.0);
    expect_turn(1.031, {1.031}, 0.0);
    jumps.output_low = -0.11;
    expect_turn(1.0, {1.0, 1.0}, -0.5);
    jumps.output_low = -0.1;
    expect_turn(1.0, {1.0, 1.0}, 0.0);
}

// What was deployed ran in steps of its own; a length below 64 of them has no memory to lose.
TEST(EffectNumbers, OfADeployedSimulationGoByItsSteps) {
    for (const char* effect : {"finite_memory", "single_precision", "fixed_point"}) {
        expect_none(effect, scales());
    }
    gap::Scales ran = scales();
    ran.deployed_step_s = 0.5;
    const double samples = 260.0;
    const Range step{"step_s", "s", 0.0, 1e6, 0.0, {0.5}, true};
    expect_ranges(
        "finite_memory", ran,
        {{"taps", "1", 4.0, 0.8 * samples, 0.8 * samples, {0.02 * samples, 0.08 * samples, 0.3 * samples}}, step});
    expect_ranges("single_precision", ran,
                  {{"oldest_first", "1", 0.0, 1.0, 0.0, {0, 1, 0, 1}, true},
                   {"increments", "1", 0.0, 1.0, 0.0, {0, 0, 1, 1}, true},
                   step});
    expect_ranges("fixed_point", ran,
                  {{"format", "bits", 15.0, 31.0, 31.0, {31, 15, 31, 15}, true},
                   {"increments", "1", 0.0, 1.0, 0.0, {0, 0, 1, 1}, true},
                   step});
    ran.length_s = 64.0 * 0.5;
    EXPECT_EQ(gap::effect_named("finite_memory").parameters(ran).size(), 2U);
    ran.length_s = 63.9 * 0.5;
    expect_none("finite_memory", ran);
}

}  // namespace
