// Where a wave stands when a record begins is that record's own: no logger waits for it.
#include "gap/drive/own_start.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "gap/drive/fit.hpp"
#include "gap/drive/start.hpp"

namespace {

constexpr double pi = std::numbers::pi;
constexpr double depth_s = 0.3;
constexpr double period_s = 9.0;

const gap::Effect& swinging() { return gap::effect_named("variable_delay"); }

drive::Model plant() { return drive::make_fopdt(2.0, 1.0, 0.5); }

gap::Record logged(unsigned seed, double phase_rad) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 2e-3);
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    gap::Record record;
    record.name = "made";
    record.usual_interval_s = 0.1;
    for (int i = 0; i < 400; ++i) {
        record.time_s.push_back(0.1 * i);
        record.input.push_back(i % 20 == 0 ? even(engine) : record.input.back());
        record.output.push_back(0.0);
    }
    gap::Scenario scenario;
    scenario.model = plant();
    swinging().add_to(scenario, std::vector{depth_s, period_s, phase_rad});
    record.output = gap::simulate(scenario, gap::Course(record, 4));
    for (double& z : record.output) {
        z += noise(engine);
    }
    return record;
}

struct Rig {
    std::vector<gap::Record> records;
    gap::Study study;
    Rig(std::vector<gap::Record> of, bool refit)
        : records(std::move(of)), study{{gap::form_of(plant()), refit}, {}, {}, {}, 2e-3, 2e-3, 0} {
        study.scales = gap::scales_of(plant(), records, {});
        study.counts = gap::all_count(records);
        for (const gap::Record& record : records) {
            study.courses.emplace_back(record, 4);
        }
    }
};

gap::FreeParameter& phase_in(gap::Candidate& candidate, std::size_t record) {
    return *std::ranges::find(candidate.own[record], "variable_delay.phase_rad", &gap::FreeParameter::name);
}

// The difference to the wave's phase, whichever half the depth's sign has.
double off_by(double found_rad, double found_depth_s, double wanted_rad) {
    return std::fabs(std::remainder(found_rad + (found_depth_s < 0.0 ? pi : 0.0) - wanted_rad, 2.0 * pi));
}

TEST(OwnNumbers, OfASwingingDelayAreThePhaseOfEachRecord) {
    const Rig rig({logged(1, 0.0)}, true);
    const auto own = gap::own_parameters_of(swinging(), rig.study.scales);
    ASSERT_EQ(own.size(), 1U);
    EXPECT_EQ(own[0].name, "variable_delay.phase_rad");
    EXPECT_FALSE(own[0].fixed);
    const auto all = gap::parameters_of(swinging(), rig.study.scales, 0);
    EXPECT_FALSE(all[0].fixed || all[1].fixed);
    EXPECT_TRUE(all[2].fixed);
    EXPECT_EQ(gap::starts_of(swinging(), rig.study.scales), 4U);  // of the period: phases are tried in each record
    // An event is a record's own in whole, any other lasting effect all records'.
    const gap::Effect& event = gap::effect_named("load_disturbance");
    EXPECT_EQ(gap::own_parameters_of(event, rig.study.scales).size(), event.parameters(rig.study.scales).size());
    EXPECT_TRUE(gap::own_parameters_of(gap::effect_named("backlash"), rig.study.scales).empty());
}

// Beside an event, whose numbers are the record's, too.
TEST(OwnNumbers, AreWhatTheRecordIsSimulatedWith) {
    const Rig rig({logged(1, 0.4), logged(2, 2.1)}, false);
    gap::Candidate candidate = gap::fit(rig.study, {}, {}, nullptr);
    const gap::Effect& event = gap::effect_named("load_disturbance");
    candidate.effects = {&swinging(), &event};
    candidate.lasting = {gap::parameters_of(swinging(), rig.study.scales, 0)};
    candidate.lasting[0][0].value = depth_s;
    candidate.lasting[0][1].value = period_s;
    for (auto& own : candidate.own) {
        for (const gap::Effect* effect : candidate.effects) {
            const auto more = gap::own_parameters_of(*effect, rig.study.scales);
            own.insert(own.end(), more.begin(), more.end());
        }
        for (gap::FreeParameter& parameter : own) {
            parameter.value = parameter.name.starts_with("load_disturbance.") ? 0.0 : parameter.value;
        }
    }
    phase_in(candidate, 0).value = 0.4;
    phase_in(candidate, 1).value = 2.1;
    const auto rms = [&](std::size_t record) {
        double sum = 0.0;
        for (const double one : gap::residuals_of(rig.study, candidate, record)) {
            sum += one * one / 400.0;
        }
        return std::sqrt(sum);
    };
    EXPECT_LT(rms(0), 2.5e-3);
    EXPECT_LT(rms(1), 2.5e-3);
    phase_in(candidate, 1).value = 0.4;
    EXPECT_LT(rms(0), 2.5e-3);
    EXPECT_GT(rms(1), 0.03);
}

TEST(OwnNumbers, BeginAtTheBestOfTheirStartsInEachRecord) {
    const Rig rig({logged(1, 0.25 * pi), logged(2, -0.5 * pi)}, false);
    gap::Candidate candidate = gap::fit(rig.study, {}, {}, nullptr);
    candidate.effects = {&swinging()};
    candidate.lasting = {gap::parameters_of(swinging(), rig.study.scales, 0)};
    candidate.lasting[0][0].value = depth_s;
    candidate.lasting[0][1].value = period_s;
    for (auto& own : candidate.own) {
        own = gap::own_parameters_of(swinging(), rig.study.scales);
    }
    gap::begin_own(rig.study, candidate);
    EXPECT_NEAR(phase_in(candidate, 0).value, 0.25 * pi, 1e-12);
    EXPECT_NEAR(phase_in(candidate, 1).value, -0.5 * pi, 1e-12);
    EXPECT_EQ(candidate.lasting[0][0].value, depth_s);
    // Where it is better than any start it stays. All of a wave is tried.
    candidate.lasting[0][1].value = period_s;
    phase_in(candidate, 0).value = 0.251 * pi + 2.0 * pi;
    phase_in(candidate, 1).value = 1.2;
    const Rig late({logged(1, 0.251 * pi), logged(2, pi)}, false);
    gap::begin_own(late.study, candidate);
    EXPECT_NEAR(phase_in(candidate, 0).value, 0.251 * pi + 2.0 * pi, 1e-12);
    EXPECT_NEAR(phase_in(candidate, 1).value, pi, 1e-12);
    // What files are told is the first record's.
    EXPECT_EQ(candidate.lasting[0][2].name, "variable_delay.phase_rad");
    gap::take_first_records(candidate);
    EXPECT_EQ(candidate.lasting[0][2].value, phase_in(candidate, 0).value);
    EXPECT_EQ(candidate.lasting[0][0].value, depth_s);
    candidate.own.clear();
    gap::take_first_records(candidate);
    EXPECT_NEAR(candidate.lasting[0][2].value, 0.251 * pi + 2.0 * pi, 1e-12);
}

// One depth and one period over records that begin at other places of the wave; so does what is judged.
TEST(OwnNumbers, AreFittedInEachRecordAndAfreshWhereItIsJudged) {
    const Rig rig({logged(1, 0.4), logged(2, 2.1)}, true);
    const gap::Candidate none = gap::fit(rig.study, {}, {}, nullptr);
    gap::Candidate found = gap::fit(rig.study, {&swinging()}, none, nullptr);
    const double depth = found.lasting[0][0].value;
    EXPECT_NEAR(std::fabs(depth), depth_s, 0.02);
    EXPECT_NEAR(found.lasting[0][1].value, period_s, 0.1);
    EXPECT_LT(off_by(phase_in(found, 0).value, depth, 0.4), 0.1);
    EXPECT_LT(off_by(phase_in(found, 1).value, depth, 2.1), 0.1);
    EXPECT_EQ(found.lasting[0][2].value, phase_in(found, 0).value);
    // Fitted anew, it stays where it was found.
    gap::Candidate again = gap::fit(rig.study, {&swinging()}, found, nullptr);
    EXPECT_NEAR(phase_in(again, 1).value, phase_in(found, 1).value, 0.02);
    for (const double phase_rad : {-2.8, 0.3, 0.5, 2.0}) {
        const Rig other({logged(3, phase_rad)}, true);
        gap::Candidate carried = gap::carried_over(other.study, found, nullptr);
        EXPECT_EQ(carried.lasting[0][0].value, depth);
        EXPECT_LT(off_by(phase_in(carried, 0).value, depth, phase_rad), 0.1) << phase_rad;
        // It is fitted wherever it is judged, and pays for it as an event's numbers do.
        EXPECT_EQ(carried.event_parameters(), 1U);
    }
    EXPECT_EQ(found.effect_parameters(), 3U);
    EXPECT_FALSE(found.has_events());
}

}  // namespace
