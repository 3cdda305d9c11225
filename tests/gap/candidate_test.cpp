// A base with effects: which numbers it has, how far they may go, and what a scenario makes of them.
#include "gap/drive/candidate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "gap/drive/determined.hpp"
#include "gap/drive/deviations.hpp"
#include "gap/drive/fit.hpp"
#include "gap/drive/jitter.hpp"
#include "gap/drive/start.hpp"

namespace {

using testing::ElementsAre;

// 30 s of half-second samples: at rest for 8 of them, then a step.
gap::Record stepped(std::size_t rest = 8) {
    gap::Record record;
    record.name = "stepped";
    record.usual_interval_s = 0.5;
    for (std::size_t i = 0; i <= 60; ++i) {
        record.time_s.push_back(0.5 * static_cast<double>(i));
        record.input.push_back(i < rest ? 0.0 : 2.0);
        record.output.push_back(i < rest ? 1.0 : 1.0 + 4.0 * (1.0 - std::exp(-0.25 * static_cast<double>(i - rest))));
    }
    return record;
}

struct Made {
    std::vector<gap::Record> records;
    gap::Study study;
    Made(const drive::Model& model, std::vector<gap::Record> of, bool refit)
        : records(std::move(of)), study{{gap::form_of(model), refit},
                                        gap::scales_of(model, records, {}),
                                        {},
                                        gap::all_count(records),
                                        0.01,
                                        0.004,
                                        0} {
        for (const gap::Record& record : records) {
            study.courses.emplace_back(record, 1);
        }
    }
};

drive::Model lag() { return drive::make_fopdt(2.0, 3.0, 0.0); }

const gap::FreeParameter& named(const std::vector<gap::FreeParameter>& list, const std::string& name) {
    return *std::find_if(list.begin(), list.end(), [&](const gap::FreeParameter& one) { return one.name == name; });
}

void expect_range(const gap::FreeParameter& found, double value, double lower, double upper, double scale) {
    EXPECT_NEAR(found.value, value, 1e-12) << found.name;
    EXPECT_NEAR(found.lower, lower, 1e-12 * std::fabs(lower)) << found.name;
    EXPECT_NEAR(found.upper, upper, 1e-12 * std::fabs(upper)) << found.name;
    EXPECT_NEAR(found.scale, scale, 1e-12) << found.name;
}

TEST(CandidateBase, HasNoNumbersUnlessItIsFitted) {
    EXPECT_TRUE(gap::base_of(Made(lag(), {stepped()}, false).study).empty());
    const Made made(lag(), {stepped()}, true);
    const auto base = gap::base_of(made.study);
    ASSERT_EQ(base.size(), 3U);
    // Thirty times its size to either side, as far as the form allows.
    expect_range(named(base, "gain"), 2.0, -58.0, 62.0, 2.0);
    EXPECT_NEAR(named(base, "time_constant_s").upper, 93.0, 1e-9);
    EXPECT_GE(named(base, "time_constant_s").lower, 0.0);
    // A dead time up to a fifth of the record; of none the steps are a time constant.
    expect_range(named(base, "delay_s"), 0.0, 0.0, 6.0, 3.0);
}

TEST(CandidateState, OfARecordThatRestsIsItsLevel) {
    const Made made(lag(), {stepped()}, true);
    const auto state = gap::state_of(made.study, made.records.front());
    ASSERT_EQ(state.size(), 4U);
    const double known = 3.0 * 0.01 / std::sqrt(8.0);
    const double span = made.study.scales.output_span;
    expect_range(state[0], 1.0, 1.0 - known, 1.0 + known, span);
    EXPECT_EQ(state[0].name, "offset");
    expect_range(state[1], 1.0, 1.0 - known, 1.0 + known, span);
    EXPECT_EQ(state[1].name, "initial_output");
    EXPECT_FALSE(state[1].fixed);
    EXPECT_TRUE(state[2].fixed);
    EXPECT_TRUE(state[3].fixed);
}

TEST(CandidateState, IsFreeWhereNothingShowsThatItRests) {
    for (const bool brief : {true, false}) {
        gap::Record record = stepped(brief ? 7 : 8);
        if (!brief) {
            record.output[3] = 1.0 + 8.1 * 0.01;  // it moves
        }
        const Made made(lag(), {record}, true);
        const auto state = gap::state_of(made.study, made.records.front());
        const double span = made.study.scales.output_span;
        expect_range(state[0], 1.0, -1000.0 * span - 1.0, 1000.0 * span + 1.0, span);
        expect_range(state[1], 1.0, 1.0 - 3.0 * span, 1.0 + 3.0 * span, span);
        const double speed = made.study.scales.speed_max;
        expect_range(state[2], 0.0, -3.0 * speed, 3.0 * speed, speed);
        expect_range(state[3], 0.0, -2.0, 2.0, 2.0);
        EXPECT_FALSE(state[2].fixed || state[3].fixed);
    }
    // Eight times the noise is still.
    gap::Record still = stepped();
    still.output[3] = 1.0 + 7.9 * 0.01;
    EXPECT_TRUE(gap::state_of(Made(lag(), {still}, true).study, still)[2].fixed);
    // A record that is driven from its first sample on was somewhere else: it rests without input at 0.
    const gap::Record driven = stepped(0);
    EXPECT_EQ(gap::state_of(Made(lag(), {driven}, true).study, driven)[0].value, 0.0);
    // And what drives it did so before.
    ASSERT_NE(driven.input.front(), 0.0);
    EXPECT_EQ(gap::state_of(Made(lag(), {driven}, true).study, driven)[3].value, driven.input.front());
}

TEST(CandidateState, OfWhatIntegratesHasAForceOfItsOwn) {
    drive::Model model;
    model.gain = 3.0;
    model.denominator = {{1.0, 1.0}};
    const Made made(model, {stepped()}, true);
    const auto state = gap::state_of(made.study, made.records.front());
    EXPECT_EQ(state[0].name, "bias");
    expect_range(state[0], 0.0, -6.0, 6.0, 0.6);
    EXPECT_FALSE(state[2].fixed);
}

TEST(CandidateState, OfAFreeMotionRestsWhereItEnds) {
    gap::Record record = stepped();
    std::fill(record.input.begin(), record.input.end(), 0.0);
    const Made made(lag(), {record}, true);
    const auto state = gap::state_of(made.study, made.records.front());
    double last = 0.0;
    for (std::size_t i = 55; i <= 60; ++i) {
        last += record.output[i] / 6.0;
    }
    EXPECT_NEAR(state[0].value, last, 1e-12);
    EXPECT_EQ(state[1].value, 1.0);
    EXPECT_TRUE(state[3].fixed);  // there is no input before it
    EXPECT_FALSE(state[2].fixed);
}

TEST(CandidateEffects, BeginAtEachOfTheirStarts) {
    const Made made(lag(), {stepped()}, false);
    const gap::Scales& scales = made.study.scales;
    const gap::Effect& curve = gap::effect_named("output_curve");
    EXPECT_EQ(gap::starts_of(curve, scales), 4U);
    EXPECT_EQ(gap::starts_of(gap::effect_named("sensor_offset"), scales), 1U);
    EXPECT_TRUE(gap::applies(curve, scales));
    EXPECT_FALSE(gap::applies(gap::effect_named("second_input"), scales));
    const auto first = gap::parameters_of(curve, scales, 0);
    EXPECT_EQ(first[0].name, "output_curve.curvature");
    expect_range(first[0], -0.25, -0.9, 0.9, 0.25);
    expect_range(first[2], 0.0, 0.0, 1.0, 0.02);
    EXPECT_FALSE(first[0].fixed || first[1].fixed);
    EXPECT_TRUE(first[2].fixed);
    EXPECT_FALSE(gap::parameters_of(curve, scales, 1)[1].fixed);
    const auto third = gap::parameters_of(curve, scales, 2);
    EXPECT_TRUE(third[1].fixed);  // of an outflow the reference stays
    EXPECT_FALSE(third[0].fixed);
    EXPECT_EQ(third[2].value, 1.0);
    EXPECT_EQ(gap::parameters_of(curve, scales, 5)[0].value, 0.25);  // around
}

gap::Candidate both(const Made& made) {
    gap::Candidate candidate;
    candidate.effects = {&gap::effect_named("load_disturbance"), &gap::effect_named("output_curve")};
    candidate.base = gap::base_of(made.study);
    candidate.lasting = {gap::parameters_of(*candidate.effects[1], made.study.scales, 0)};
    for (const gap::Record& record : made.records) {
        candidate.own.push_back(gap::state_of(made.study, record));
        const auto event = gap::parameters_of(*candidate.effects[0], made.study.scales, 0);
        candidate.own.back().insert(candidate.own.back().end(), event.begin(), event.end());
    }
    return candidate;
}

TEST(Candidate, CountsItsNumbers) {
    const Made made(lag(), {stepped(), stepped()}, true);
    gap::Candidate candidate = both(made);
    EXPECT_EQ(candidate.name(), "load_disturbance + output_curve");
    EXPECT_EQ(gap::Candidate{}.name(), "none");
    EXPECT_TRUE(candidate.has("output_curve"));
    EXPECT_FALSE(candidate.has("backlash"));
    EXPECT_EQ(candidate.event_parameters(), 6U);   // three in each record
    EXPECT_EQ(candidate.effect_parameters(), 5U);  // three, and two of the curve
    EXPECT_EQ(candidate.effect_parameters_in_all(), 8U);
    EXPECT_EQ(gap::Candidate{}.effect_parameters(), 0U);
    // The base's three, two of the curve, offset and output and event of each record.
    EXPECT_EQ(gap::free_numbers(candidate, false).size(), 3U + 2U + 2U * 5U);
    const auto own = gap::free_numbers(candidate, true);
    EXPECT_EQ(own.size(), 10U);
    EXPECT_EQ(own.front()->name, "offset");
    EXPECT_EQ(gap::free_numbers(candidate, false).front()->name, "gain");
    EXPECT_EQ(gap::free_numbers(candidate, false)[3]->name, "output_curve.curvature");
}

TEST(Candidate, IsAScenarioOfItsNumbers) {
    const Made made(lag(), {stepped(), stepped()}, true);
    gap::Candidate candidate = both(made);
    candidate.base[0].value = 7.0;
    candidate.own[1][0].value = 0.25;
    candidate.own[1][1].value = 0.75;
    candidate.own[1][2].value = -0.5;
    candidate.own[1][3].value = 1.5;
    candidate.own[1][4].value = 2.0;
    candidate.own[1][5].value = 3.0;
    candidate.own[1][6].value = 0.125;
    candidate.lasting[0][2].value = 1.0;
    const gap::Scenario scenario = gap::scenario_of(made.study, candidate, 1);
    EXPECT_NEAR(drive::static_gain(scenario.model), 7.0, 1e-12);
    EXPECT_EQ(scenario.operating_output, 0.25);
    EXPECT_EQ(scenario.initial_output, 0.5);  // beside it
    EXPECT_EQ(scenario.initial_velocity, -0.5);
    EXPECT_EQ(scenario.input_before, 1.5);
    ASSERT_EQ(scenario.forces.pushes.size(), 1U);
    EXPECT_EQ(scenario.forces.pushes[0].from_s, 2.0);
    EXPECT_EQ(scenario.forces.pushes[0].to_s, 3.0);
    EXPECT_EQ(scenario.forces.pushes[0].size, 0.125);
    ASSERT_TRUE(scenario.forces.outflow);
    EXPECT_EQ(scenario.forces.outflow->curvature, -0.25);
    const drive::Form filled = gap::with_values(made.study.base.form, candidate);
    EXPECT_EQ(drive::Form(filled).parameter("gain").value, 7.0);
    EXPECT_EQ(drive::Form(filled).parameter("time_constant_s").value, 3.0);
}

// A prediction goes on from the reading a horizon ago; before that from the first.
TEST(Candidate, LeavesWhatIsMeasuredLessSimulated) {
    Made made(lag(), {stepped()}, false);
    gap::Candidate none;
    none.own.resize(1);
    const auto simulated = gap::simulate(gap::scenario_of(made.study, none, 0), made.study.courses[0]);
    const auto left = gap::residuals_of(made.study, none, 0);
    const auto& z = made.records[0].output;
    for (std::size_t i = 0; i < z.size(); ++i) {
        EXPECT_NEAR(left[i], z[i] - simulated[i], 1e-12) << i;
    }
    made.study.horizon = 4;
    const auto ahead = gap::residuals_of(made.study, none, 0);
    for (std::size_t i = 0; i < z.size(); ++i) {
        EXPECT_NEAR(ahead[i], left[i] - left[i > 4 ? i - 4 : 0], 1e-12) << i;
    }
    EXPECT_THAT(gap::all_residuals(made.study, none), ElementsAre(ahead));
}

// A given model's output is about its operating point.
TEST(Candidate, OfAGivenModelIsAboutItsOperatingPoint) {
    Made made(lag(), {stepped()}, false);
    made.study.base.operating_output = 5.0;
    gap::Candidate none;
    none.own.resize(1);
    EXPECT_EQ(gap::scenario_of(made.study, none, 0).operating_output, 5.0);
    EXPECT_EQ(gap::scenario_of(made.study, none, 0).initial_output, 0.0);
}

// --- Deviations of what was fitted: a straight line through noise, whose slope's is known.

TEST(FitDeviations, OfAGainAreThoseOfALine) {
    std::vector<gap::Record> records = {stepped(0)};
    gap::Record& record = records[0];
    for (std::size_t i = 0; i < record.size(); ++i) {
        record.input[i] = 0.1 * static_cast<double>(i % 7);
    }
    drive::Model model = drive::make_fopdt(2.0, 0.01, 0.0);
    Made made(model, records, false);
    const gap::Effect& gain = gap::effect_named("sensor_drift");
    gap::Candidate candidate;
    candidate.effects = {&gain};
    candidate.own.resize(1);
    candidate.lasting = {gap::parameters_of(gain, made.study.scales, 0)};
    candidate.lasting[0][0].value = 0.03;
    const auto simulated = gap::simulate(gap::scenario_of(made.study, candidate, 0), made.study.courses[0]);
    // Residuals of 0.02 that turn from sample to sample: blocks of them hardly pull.
    double squares = 0.0;
    for (std::size_t i = 0; i < record.size(); ++i) {
        made.records[0].output[i] = simulated[i] + (i % 2 == 0 ? 0.02 : -0.02);
        squares += record.time_s[i] * record.time_s[i];
    }
    gap::add_deviations(made.study, candidate, nullptr);
    const double n = static_cast<double>(record.size());
    const double expected = std::sqrt(0.02 * 0.02 * n / (n - 1.0) / squares);
    EXPECT_NEAR(candidate.lasting[0][0].deviation, expected, 0.02 * expected);
    EXPECT_FALSE(candidate.lasting[0][0].moves_nothing);
    // What says the same again and again tells less than so many samples: the pull of blocks is larger.
    for (std::size_t i = 0; i < record.size(); ++i) {
        made.records[0].output[i] = simulated[i] + (i < 30 ? 0.02 : -0.02);
    }
    gap::add_deviations(made.study, candidate, nullptr);
    EXPECT_GT(candidate.lasting[0][0].deviation, 1.3 * expected);
    // A perfect simulation of rounded readings: as far off as these are, at least.
    for (std::size_t i = 0; i < record.size(); ++i) {
        made.records[0].output[i] = simulated[i];
    }
    gap::add_deviations(made.study, candidate, nullptr);
    EXPECT_NEAR(candidate.lasting[0][0].deviation, 0.004 / std::sqrt(squares), 1e-3 * expected);
}

TEST(FitDeviations, OfWhatNothingTellsAreInfinite) {
    const Made made(lag(), {stepped()}, false);
    gap::Candidate candidate;
    candidate.effects = {&gap::effect_named("input_saturation")};
    candidate.own.resize(1);
    candidate.lasting = {gap::parameters_of(*candidate.effects[0], made.study.scales, 0)};
    candidate.lasting[0][0].value = 2.0;  // what it never reaches beyond
    candidate.lasting[0][0].upper = 9.0;
    gap::add_deviations(made.study, candidate, nullptr);
    EXPECT_TRUE(std::isinf(candidate.lasting[0][0].deviation));
    EXPECT_TRUE(candidate.lasting[0][0].moves_nothing);
    // Two numbers of which the sum alone tells.
    gap::Candidate two;
    two.effects = {&gap::effect_named("sensor_offset"), &gap::effect_named("sensor_offset")};
    two.own.resize(1);
    two.lasting = {gap::parameters_of(*two.effects[0], made.study.scales, 0),
                   gap::parameters_of(*two.effects[0], made.study.scales, 0)};
    gap::add_deviations(made.study, two, nullptr);
    EXPECT_FALSE(two.lasting[0][0].moves_nothing);
    EXPECT_GT(two.lasting[0][0].deviation, 0.0);
    // Half of each lies in their difference.
    EXPECT_THAT(gap::untold_shares(made.study, two),
                testing::ElementsAre(testing::DoubleNear(0.5, 1e-6), testing::DoubleNear(0.5, 1e-6)));
    EXPECT_TRUE(gap::leaves_open(made.study, two));
    two.effects.pop_back();
    two.lasting.pop_back();
    EXPECT_THAT(gap::untold_shares(made.study, two), testing::ElementsAre(0.0));
    EXPECT_FALSE(gap::leaves_open(made.study, two));
}

// Friction of two levels beside an operating point: what one has more than the other moves the point, unless the record
// shows it by resting, and goes both ways.
TEST(FitDeviations, OfTwoLevelsOfFrictionAreOfTheirMean) {
    gap::Record both_ways = stepped();
    for (std::size_t i = 8; i < both_ways.size(); ++i) {
        both_ways.input[i] = i < 20 ? 2.0 : i < 32 ? 0.5 : i < 44 ? 3.0 : 1.0;
    }
    Made made(lag(), {both_ways}, true);
    gap::Candidate uneven;
    uneven.effects = {&gap::effect_named("direction_dependent_friction")};
    uneven.base = gap::base_of(made.study);
    uneven.own = {gap::state_of(made.study, made.records[0])};
    uneven.lasting = {gap::parameters_of(*uneven.effects[0], made.study.scales, 2)};
    const std::vector<double> left = gap::residuals_of(made.study, uneven, 0);
    for (std::size_t i = 0; i < left.size(); ++i) {
        made.records[0].output[i] -= left[i];
    }
    EXPECT_FALSE(gap::leaves_open(made.study, uneven));
    gap::FreeParameter& offset = uneven.own[0][0];
    offset.lower = -10.0;
    offset.upper = 10.0;
    EXPECT_TRUE(gap::leaves_open(made.study, uneven));
}

// One step up hardly parts a force from the gain: by less than a hundredth.
TEST(FitDeviations, OfAForceAndAGainAreHardlyToldByAStep) {
    const Made made(lag(), {stepped()}, true);
    gap::Candidate even;
    even.effects = {&gap::effect_named("coulomb_friction")};
    even.base = gap::base_of(made.study);
    even.own = {gap::state_of(made.study, made.records[0])};
    even.lasting = {gap::parameters_of(*even.effects[0], made.study.scales, 1)};
    for (gap::FreeParameter& own : even.own[0]) {
        own.fixed = true;  // the record shows them by resting
    }
    const auto open = [&](double untold) {
        const auto shares = gap::untold_shares(made.study, even, untold);
        return std::ranges::any_of(shares, [](double share) { return share > 0.05; });
    };
    EXPECT_TRUE(gap::leaves_open(made.study, even));
    EXPECT_TRUE(open(1e-4));
    EXPECT_FALSE(open(0.0));
}

// --- Jitter: what shifts of a stamp by up to a half width make of a speed.

TEST(Jitter, SpreadsReadingsByTheirSpeed) {
    Made made(lag(), {stepped()}, false);
    gap::Candidate candidate;
    candidate.effects = {&gap::effect_named("sampling_jitter")};
    candidate.own.resize(1);
    candidate.lasting = {gap::parameters_of(*candidate.effects[0], made.study.scales, 0)};
    candidate.lasting[0][0].value = 0.2;   // s
    candidate.lasting[0][1].value = 0.25;  // of the variance is noise
    gap::Whitener whitener;
    whitener.deviation = whitener.stationary_deviation = 0.1;
    whitener.coefficients = {0.5};
    const auto left = gap::residuals_of(made.study, candidate, 0);
    const auto& z = made.records[0].output;
    const auto simulated = [&](std::size_t i) { return z[i] - left[i]; };
    const auto spread = gap::spread_of(made.study, candidate, 0, left, whitener);
    for (std::size_t i = 1; i + 1 < z.size(); ++i) {
        const double speed = (simulated(i + 1) - simulated(i - 1)) / 1.0;
        const double by = 0.2 * speed / 0.1;
        EXPECT_NEAR(spread[i], std::sqrt(0.25 + 1.25 * by * by / 3.0), 1e-9) << i;
    }
    EXPECT_NEAR(spread[0], std::sqrt(0.25 + 1.25 * std::pow(0.2 * (simulated(1) - simulated(0)) / 0.5 / 0.1, 2) / 3.0),
                1e-9);
    // What a likely shift explains is taken off: as much of it as is jitter's, and no more than the half width.
    const auto without = gap::without_jitter(made.study, candidate, 0, left, whitener);
    for (std::size_t i = 1; i + 1 < z.size(); ++i) {
        const double speed = (simulated(i + 1) - simulated(i - 1)) / 1.0;
        const double moved = speed * speed * 0.04 / 3.0;
        const double noise = 0.01 * 0.25;
        const double shift = speed == 0.0 ? 0.0 : std::clamp(left[i] / speed * moved / (moved + noise), -0.2, 0.2);
        EXPECT_NEAR(without[i], left[i] - speed * shift, 1e-9) << i;
    }
    // Of the first reading, too, by its one neighbour.
    std::vector<double> off = left;
    off[0] = 0.05;
    const double speed = (z[1] - off[1] - (z[0] - off[0])) / 0.5;
    const double moved = speed * speed * 0.04 / 3.0;
    ASSERT_NE(speed, 0.0);
    EXPECT_NEAR(gap::without_jitter(made.study, candidate, 0, off, whitener)[0],
                off[0] - speed * std::clamp(off[0] / speed * moved / (moved + 0.0025), -0.2, 0.2), 1e-9);
    // What a sensor's end holds has no noise whenever it is read.
    gap::Record& held = made.records[0];
    std::fill_n(held.output.begin() + 10, 12, 9.0);
    for (std::size_t i = 25; i < held.output.size(); ++i) {
        held.output[i] += 1e-6 * static_cast<double>(i * i % 7);
    }
    const auto at_end = gap::spread_of(made.study, candidate, 0, left, whitener);
    EXPECT_EQ(at_end[15], 1.0);
    EXPECT_NE(at_end[30], 1.0);
    candidate.lasting[0][0].value = 0.0;
    EXPECT_EQ(gap::without_jitter(made.study, candidate, 0, left, whitener), left);
    candidate.effects.clear();
    EXPECT_TRUE(gap::spread_of(made.study, candidate, 0, left, whitener).empty());
    EXPECT_EQ(gap::without_jitter(made.study, candidate, 0, left, whitener), left);
}

// A plant that always moves, read at other times than its stamps say.
struct Shifted {
    Made made;
    gap::Candidate candidate;
    gap::Whitener whitener;
    std::vector<double> left;
    Shifted(double half_width_s, double noise, double coloured)
        : made(lag(), {[] {
                   gap::Record record;
                   record.name = "moves";
                   record.usual_interval_s = 0.5;
                   for (int i = 0; i < 800; ++i) {
                       record.time_s.push_back(0.5 * i);
                       record.input.push_back(2.0 * std::sin(0.31 * i) + std::sin(0.173 * i));
                       record.output.push_back(0.0);
                   }
                   return record;
               }()},
               false) {
        gap::Candidate none;
        none.own.resize(1);
        const auto simulated = gap::simulate(gap::scenario_of(made.study, none, 0), made.study.courses[0]);
        std::mt19937_64 engine(5);
        std::uniform_real_distribution<double> even(-1.0, 1.0);
        std::normal_distribution<double> normal(0.0, noise);
        double squares = 0.0;
        double shift = 0.0;
        for (std::size_t i = 0; i < simulated.size(); ++i) {
            const std::size_t from = i == 0 ? 0 : i - 1;
            const std::size_t to = std::min(simulated.size() - 1, i + 1);
            const double speed = (simulated[to] - simulated[from]) / (0.5 * static_cast<double>(to - from));
            shift = coloured * shift + (1.0 - coloured) * half_width_s * even(engine);
            const double off = shift * speed + normal(engine);
            made.records[0].output[i] = simulated[i] + off;
            squares += off * off;
        }
        whitener.deviation = whitener.stationary_deviation = std::sqrt(squares / 800.0);
        candidate.effects = {&gap::effect_named("sampling_jitter")};
        candidate.own.resize(1);
        candidate.lasting = {gap::parameters_of(*candidate.effects[0], made.study.scales, 0)};
        left = gap::residuals_of(made.study, candidate, 0);
        gap::fit_jitter(made.study, candidate, whitener);
    }
    [[nodiscard]] double width() const { return candidate.lasting[0][0].value; }
    [[nodiscard]] double noise_share() const { return candidate.lasting[0][1].value; }
};

TEST(Jitter, IsFoundByTheSpreadOfReadings) {
    const Shifted jitters(0.2, 0.01, 0.0);
    EXPECT_NEAR(jitters.width(), 0.2, 0.02);
    const double noise = std::sqrt(jitters.noise_share()) * jitters.whitener.deviation;
    EXPECT_NEAR(noise, 0.01, 0.004);
    // Of 800 second moments of even shifts a width is known to some per cent.
    EXPECT_GT(jitters.candidate.lasting[0][0].deviation, 0.002);
    EXPECT_LT(jitters.candidate.lasting[0][0].deviation, 0.015);
}

// Of normal residuals that spread by both.
double likelihood_of(const Shifted& of, double half_width_s, double noise_share) {
    gap::Candidate candidate = of.candidate;
    candidate.lasting[0][0].value = half_width_s;
    candidate.lasting[0][1].value = noise_share;
    const auto spread = gap::spread_of(of.made.study, candidate, 0, of.left, of.whitener);
    const auto white = of.whitener.apply(of.left);
    double sum = 0.0;
    for (std::size_t i = 0; i < white.size(); ++i) {
        sum -= 0.5 * std::pow(white[i] / spread[i], 2) + std::log(spread[i]);
    }
    return sum;
}

// The most likely width, to a hundredth, with the deviation that its likelihood tells: fallen by 1.92 at 1.96 of them.
TEST(Jitter, IsAsWideAsIsMostLikely) {
    for (const double noise : {0.01, 0.05}) {
        const Shifted jitters(0.2, noise, 0.0);
        const double best = likelihood_of(jitters, jitters.width(), jitters.noise_share());
        for (double factor = 0.5; factor < 2.0; factor *= 1.004) {
            EXPECT_LT(likelihood_of(jitters, factor * jitters.width(), jitters.noise_share()), best + 0.02) << factor;
        }
        const auto falls = [&](double by) {
            double factor = 1.0;
            while (likelihood_of(jitters, factor * jitters.width(), jitters.noise_share()) > best - 1.92) {
                factor *= by;
            }
            return factor;
        };
        const double expected = 0.5 * (falls(1.001) - falls(0.999)) * jitters.width() / 1.96;
        const gap::FreeParameter& width = jitters.candidate.lasting[0][0];
        EXPECT_NEAR(width.deviation, expected, 0.2 * expected) << noise;
        EXPECT_NEAR(width.low, falls(0.999) * width.value, 0.02 * width.value) << noise;
        EXPECT_NEAR(width.high, falls(1.001) * width.value, 0.02 * width.value) << noise;
        const gap::FreeParameter& share = jitters.candidate.lasting[0][1];
        EXPECT_GT(share.low, 0.0) << noise;
        EXPECT_LE(share.low, share.value) << noise;
        EXPECT_GE(share.high, share.value) << noise;
        EXPECT_GT(likelihood_of(jitters, width.value, share.low), best - 1.92) << noise;
        EXPECT_GT(likelihood_of(jitters, width.value, share.high), best - 1.92) << noise;
    }
}

// Four units of likelihood, or there is none.
TEST(Jitter, IsNoneThatIsHardlyKnown) {
    std::size_t found = 0;
    std::size_t none = 0;
    for (double half_width_s = 0.004; half_width_s < 0.02; half_width_s *= 1.04) {
        const Shifted jitters(half_width_s, 0.02, 0.0);
        double best = -1e9;
        for (double width = 4e-3; width < 0.1; width *= 1.05) {
            for (const double share : {0.5, 0.7, 0.85, 1.0}) {
                best = std::max(best, likelihood_of(jitters, width, share));
            }
        }
        const double gain = best - likelihood_of(jitters, 0.0, 1.0);
        if (std::fabs(gain - 4.0) > 0.03) {
            EXPECT_EQ(jitters.width() > 0.0, gain > 4.0) << half_width_s << " " << gain;
            EXPECT_EQ(jitters.noise_share() < 1.0, gain > 4.0) << half_width_s << " " << gain;
        }
        (gain > 4.0 ? found : none) += 1;
    }
    EXPECT_GT(found, 5U);
    EXPECT_GT(none, 5U);
}

// Beside it noise is one of eleven shares of the variance: the nearest to what there is.
TEST(Jitter, LeavesNoiseOneOfElevenShares) {
    const std::vector<double> shares{0.003, 0.01, 0.03, 0.06, 0.1, 0.2, 0.3, 0.5, 0.7, 0.85, 1.0};
    std::set<double> seen;
    for (double noise = 0.004; noise < 0.5; noise *= 1.15) {
        const Shifted jitters(0.2, noise, 0.0);
        seen.insert(jitters.noise_share());
        EXPECT_TRUE(std::find(shares.begin(), shares.end(), jitters.noise_share()) != shares.end())
            << noise << " " << jitters.noise_share();
        if (jitters.width() > 0.0) {
            const double share = noise * noise / (jitters.whitener.deviation * jitters.whitener.deviation);
            EXPECT_LT(jitters.noise_share(), 2.0 * share) << noise;
            EXPECT_GT(jitters.noise_share(), 0.5 * share) << noise;
        }
    }
    EXPECT_EQ(seen, std::set<double>(shares.begin(), shares.end()));
}

TEST(Jitter, IsNoneOfEvenNoiseAndOfWhatIsColoured) {
    const Shifted quiet(0.0, 0.02, 0.0);
    EXPECT_EQ(quiet.width(), 0.0);
    EXPECT_EQ(quiet.noise_share(), 1.0);
    const Shifted slow(0.2, 1e-4, 0.9);
    EXPECT_EQ(slow.width(), 0.0);
    EXPECT_EQ(slow.noise_share(), 1.0);
    const Shifted little(0.2, 1e-4, 0.1);  // a tenth of the shift stays
    EXPECT_GT(little.width(), 0.1);
}

}  // namespace
