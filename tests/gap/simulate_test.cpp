// The simulation with effects against exact responses and closed forms; the audit; the whitener.
#include "gap/drive/simulate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "drive/response.hpp"
#include "drive/simulation.hpp"
#include "gap/drive/audit.hpp"
#include "gap/drive/effect.hpp"
#include "gap/drive/residuals/flexible.hpp"
#include "gap/drive/residuals/whiten.hpp"
#include "stand_case.hpp"

namespace {

drive::Model plant_12() {
    drive::Model model;
    model.denominator = {{0.18234, 1.9909}, {0.65536, 0.98319}, {0.9992, 0.0}};
    model.delay_s = 1.0;
    return model;
}

gap::Record pulses(double interval_s, double until_s) {
    gap::Record record;
    record.name = "pulses";
    record.usual_interval_s = interval_s;
    for (double t = 0.0; t < until_s; t += interval_s) {
        record.time_s.push_back(t);
        record.input.push_back(std::fmod(t, 5.0) < 2.6 ? 0.3 + 0.1 * std::floor(t / 5.0) : 0.0);
        record.output.push_back(0.0);
    }
    return record;
}

double rms(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    }
    return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(GapSimulation, IsTheExactResponse) {
    const gap::Record record = pulses(0.01, 20.0);
    gap::Scenario plain;
    plain.model = plant_12();
    const std::vector<double> exact =
        drive::respond(plain.model, drive::changes_of(record.time_s, record.input), record.time_s);
    EXPECT_LT(rms(gap::simulate(plain, gap::Course(record, 1)), exact), 5e-5);
    const gap::Course corrected = gap::make_course(record, plain, 1e-2);
    EXPECT_EQ(corrected.grid().count, gap::Course(record, 1).grid().count);
    EXPECT_LT(rms(gap::simulate(plain, corrected), exact), 5e-6);
}

// The largest difference but at stamps of which the input jumps at one of the two before: there first orders are not.
double smooth_difference(const gap::Record& record, const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0.0;
    for (std::size_t i = 3; i < a.size(); ++i) {
        if (record.input[i] == record.input[i - 3]) {
            largest = std::max(largest, std::fabs(a[i] - b[i]));
        }
    }
    return largest;
}

// Half the step, a quarter of the error: of first and second order, with and without a zero.
TEST(GapSimulation, IsSecondOrderFromTheFirstStampOn) {
    gap::Record record = pulses(0.02, 8.0);
    const std::vector<std::vector<drive::Term>> denominators = {
        {{0.5, 1.0}, {1.0, 0.0}}, {{0.25, 2.0}, {0.3, 1.0}, {1.0, 0.0}}, {{0.3, 1.5}, {1.0, 0.0}}};
    const std::vector<drive::Term> zero = {{0.1, 1.0}, {1.0, 0.0}};
    const auto expect_second_order = [&](const gap::Scenario& scenario, const std::vector<double>& wanted) {
        const auto off = [&](double per_interval) {
            return smooth_difference(record, gap::simulate(scenario, gap::Course(record, per_interval)), wanted);
        };
        EXPECT_LT(off(8.0), 0.35 * off(4.0)) << drive::to_text(scenario.model);
        EXPECT_LT(off(8.0), 2e-5) << drive::to_text(scenario.model);
    };
    gap::Scenario driven;
    for (const auto& denominator : denominators) {
        driven.model.denominator = denominator;
        expect_second_order(
            driven, drive::respond(driven.model, drive::changes_of(record.time_s, record.input), record.time_s));
    }
    driven.model.denominator = denominators[1];
    driven.model.numerator = zero;
    expect_second_order(driven,
                        drive::respond(driven.model, drive::changes_of(record.time_s, record.input), record.time_s));
    // Released from 1: 1 less the response to a step.
    std::fill(record.input.begin(), record.input.end(), 1.0);
    for (const auto& denominator : denominators) {
        gap::Scenario released;
        released.model.denominator = denominator;
        auto wanted = drive::respond(released.model, drive::changes_of(record.time_s, record.input), record.time_s);
        for (double& y : wanted) {
            y = 1.0 - y;
        }
        released.model.gain = 0.0;
        released.initial_output = 1.0;
        expect_second_order(released, wanted);
    }
    // At rest under an input that was there before, nothing happens.
    driven.initial_output = driven.input_before = 1.0;
    for (const double y : gap::simulate(driven, gap::Course(record, 1))) {
        ASSERT_NEAR(y, 1.0, 1e-11);
    }
}

TEST(GapSimulation, OnACoarseGridReadsTheSame) {
    const gap::Record record = pulses(0.01, 20.0);
    gap::Scenario plain;
    plain.model = plant_12();
    const gap::Course fine = gap::make_course(record, plain, 1e-4);
    const gap::Course sketch = gap::make_sketch(fine, record, 1, plain, 1e-2);
    EXPECT_LT(2 * sketch.grid().count, fine.grid().count);
    const std::vector<double> wanted = gap::simulate(plain, fine);
    EXPECT_LT(rms(gap::simulate(plain, sketch), wanted), 1e-12);
    gap::Scenario other = plain;  // and nearly so for a model that is another one
    other.model.denominator[1].coefficient *= 1.1;
    EXPECT_LT(rms(gap::simulate(other, sketch), gap::simulate(other, fine)), 2e-3);
    // Nothing coarser is near enough.
    EXPECT_EQ(gap::make_sketch(fine, record, 1, plain, 0.0).grid().count, gap::Course(record, 1).grid().count);
}

TEST(GapSimulation, KeepsDeployedReadingsOfEachModelApart) {
    const gap::Record record = pulses(0.02, 6.0);
    const gap::Course course(record, 1);
    drive::Model model = plant_12();
    const gap::Deployed deployed{0.02, 50.0, ""};
    const std::vector<double> first = course.deployed(model, deployed, 50);
    EXPECT_EQ(course.deployed(model, deployed, 50), first);
    EXPECT_GT(rms(course.deployed(model, deployed, 0), first), 1e-4);
    model.denominator[1].coefficient *= 1.2;
    EXPECT_GT(rms(course.deployed(model, deployed, 50), first), 1e-4);
}

TEST(GapSimulation, SticksUntilTheForceIsOvercome) {
    gap::Record record = pulses(0.01, 4.0);
    gap::Scenario scenario;
    scenario.model = plant_12();
    scenario.model.delay_s = 0.0;
    scenario.forces.friction_up = scenario.forces.friction_down = 0.31;
    for (const double y : gap::Course(record, 1).nodes_of(scenario)) {
        ASSERT_EQ(y, 0.0);
    }
    scenario.forces.friction_up = 0.1;
    scenario.forces.friction_down = 0.1;
    std::fill(record.input.begin(), record.input.end(), 0.3);
    // It stops where the force that is left balances the weight, or short of it by at most the friction.
    const double end = gap::Course(record, 1).nodes_of(scenario).back();
    EXPECT_GE(end, (0.3 - 0.1) / 0.9992 - 1e-3);
    EXPECT_LE(end, (0.3 + 0.1) / 0.9992 + 1e-3);
}

TEST(GapSimulation, TakesWhatWasDeployedExactly) {
    const gap::Record record = pulses(0.01, 10.0);
    gap::Scenario plain;
    plain.model = plant_12();
    gap::Scenario forgetful = plain;
    forgetful.deployed = gap::Deployed{0.01, 60.0, ""};
    const gap::Course course = gap::make_course(record, plain, 1e-3);
    drive::Scheme scheme;
    scheme.step_s = 0.01;
    scheme.taps = 60;
    const std::vector<double> ran = drive::simulate(plain.model, scheme, record.input).output;
    EXPECT_LT(rms(gap::simulate(forgetful, course), ran), 1e-9);
    EXPECT_GT(rms(gap::simulate(plain, course), ran), 1e-3);
}

TEST(GapEffects, AreTheContractsAndChangeNothingAtTheirNeutralValue) {
    const gap::Record record = gap_test::log_of({}, {});
    const gap::Audit found = gap::audit({record});
    gap::Scenario plain;
    plain.model = gap::model_of(gap_test::linear_form());
    const gap::Scales scales = gap::scales_of(plain.model, {record}, found);
    const gap::Course course(record, 1);
    const std::vector<double> usual = gap::simulate(plain, course);
    EXPECT_EQ(gap::effects().size(), 43U);
    for (const gap::Effect* effect : gap::effects()) {
        const auto parameters = effect->parameters(scales);
        if (parameters.empty()) {
            continue;  // it cannot occur in this record
        }
        std::vector<double> values;
        for (const gap::EffectParameter& parameter : parameters) {
            EXPECT_LE(parameter.lower, parameter.upper) << effect->name;
            values.push_back(parameter.none);
        }
        gap::Scenario scenario = plain;
        effect->add_to(scenario, values);
        EXPECT_LT(rms(gap::simulate(scenario, course), usual), 2e-4) << effect->name;
    }
}

TEST(GapAudit, FindsTheQuantumAndTheHeldSamples) {
    const gap::Record quantised = gap_test::log_of({{"encoder_quantisation.step", 0.0063}}, {.seed = 8});
    EXPECT_NEAR(gap::audit({quantised}).quantum, 0.0063, 1e-6);
    EXPECT_EQ(gap::audit({gap_test::log_of({}, {.seed = 8})}).quantum, 0.0);
    // As a logger prints it, in kelvin, of a sensor that counts from 0 degrees.
    gap::Record printed = quantised;
    for (double& value : printed.output) {
        value = std::round((value * 51.157 + 273.15) * 100.0) / 100.0;
    }
    EXPECT_NEAR(gap::audit({printed}).quantum, 0.0063 * 51.157, 1e-4);
    const gap::Record dropping = gap_test::log_of({{"dropped_samples.rate", 0.1}}, {.seed = 9});
    EXPECT_NEAR(gap::audit({dropping}).held_share, 0.1, 0.05);
    EXPECT_EQ(gap::audit({gap_test::log_of({}, {.seed = 9})}).held_share, 0.0);
    EXPECT_NEAR(gap::audit({gap_test::log_of({}, {.seed = 10})}).noise, 0.003, 3e-4);
}

TEST(GapWhitener, MakesColouredNoiseWhite) {
    std::mt19937_64 engine(1);
    std::normal_distribution<double> normal;
    std::vector<double> coloured(4000);
    double value = 0.0;
    for (double& one : coloured) {
        one = value = 0.9 * value + normal(engine);
    }
    const gap::Whitener whitener = gap::fit_whitener({coloured}, 8, 1e-9);
    EXPECT_NEAR(whitener.coefficients.at(0), 0.9, 0.03);
    EXPECT_NEAR(whitener.deviation, 1.0, 0.05);
    const std::vector<double> white = whitener.apply(coloured);
    double along = 0.0;
    double square = 0.0;
    for (std::size_t i = 1; i < white.size(); ++i) {
        along += white[i] * white[i - 1];
        square += white[i] * white[i];
    }
    EXPECT_LT(std::fabs(along / square), 0.05);
}

TEST(GapFlexible, ForeseesWhatDependsOnTheInputAndNothingElse) {
    gap::Record record = pulses(0.02, 40.0);
    for (std::size_t i = 0; i < record.size(); ++i) {
        record.input[i] = std::fmod(record.time_s[i], 5.0) < 2.6 ? 0.9 : 0.2;
    }
    gap::Scenario plain;
    plain.model = plant_12();
    gap::Remainder remainder{
        &record, gap::simulate(plain, gap::Course(record, 1)), {}, std::vector<char>(record.size(), 1)};
    std::mt19937_64 engine(2);
    std::normal_distribution<double> normal;
    double noise = 0.0;
    for (std::size_t i = 0; i < record.size(); ++i) {
        noise = 0.8 * noise + 0.01 * normal(engine);
        remainder.residuals.push_back(noise);
    }
    EXPECT_LT(gap::explain({remainder}, {}, 1.0, 0.5).explained, 0.1);
    for (std::size_t i = 0; i < record.size(); ++i) {
        remainder.residuals[i] += 0.05 * remainder.simulated[i] * remainder.simulated[i] * remainder.simulated[i];
    }
    const gap::Flexible found = gap::explain({remainder}, {}, 1.0, 0.5);
    EXPECT_TRUE(found.certain);
}

}  // namespace
