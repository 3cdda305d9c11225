// What holds where nothing is said: pages, committed results and the commands' help rest on it.
#include <gtest/gtest.h>

#include "drive/coverage.hpp"
#include "drive/descend.hpp"
#include "drive/fit.hpp"
#include "drive/log.hpp"
#include "drive/realtime_controller.hpp"
#include "drive/simulation.hpp"
#include "drive/stand/blind/family.hpp"
#include "drive/stand/blind/logger.hpp"
#include "drive/stand/experiment.hpp"

namespace {

// The paper's series: 27 % until 2.6 s, at 10 ms +- 1 ms, 1000 counts a turn with 45 degrees as 1.
TEST(Defaults, ALogIsTakenAsInThePaper) {
    const drive::Acquisition taken;
    EXPECT_EQ(taken.excitation.name, "pulse");
    EXPECT_EQ(taken.excitation.amplitude, 1.0);
    EXPECT_EQ(taken.excitation.off_s, 2.6);
    EXPECT_EQ(taken.until_s, 5.0);
    EXPECT_EQ(taken.interval_s, 0.01);
    EXPECT_EQ(taken.jitter_s, 0.001);
    EXPECT_EQ(taken.noise, 0.01);
    EXPECT_EQ(taken.quantum, 8.0 / 1000.0);
    const stand::Experiment run;
    EXPECT_EQ(run.name, "pulse");
    EXPECT_EQ(run.duty, 0.27);
    EXPECT_EQ(run.low_duty, 0.0);
    EXPECT_EQ(run.off_s, 2.6);
    EXPECT_EQ(run.until_s, 5.0);
    EXPECT_EQ(run.stairs, 4);
    EXPECT_EQ(run.from_hz, 0.05);
    EXPECT_EQ(run.to_hz, 2.0);
    EXPECT_EQ(run.bit_s, 0.25);
    EXPECT_EQ(run.angle_rad, 0.7);
}

TEST(Defaults, AnInputIsAStepAndASchemeTheMicrocontrollers) {
    const drive::Excitation input;
    EXPECT_EQ(input.name, "step");
    EXPECT_EQ(input.amplitude, 1.0);
    EXPECT_EQ(input.off_s, 2.6);
    EXPECT_EQ(input.stairs, 4U);
    const drive::Scheme scheme;
    EXPECT_EQ(scheme.step_s, 0.001);
    EXPECT_FALSE(scheme.taps);
    EXPECT_FALSE(scheme.increments);
    EXPECT_FALSE(scheme.merged);
    EXPECT_EQ(scheme.forcing, drive::Forcing::held);
    EXPECT_EQ(scheme.full_scale, 0.0);
}

TEST(Defaults, AFitStartsOnceAndEndsByItself) {
    const drive::FitOptions fit;
    EXPECT_EQ(fit.accepted_error, 0.0);
    EXPECT_EQ(fit.iterations, 200);
    EXPECT_EQ(fit.starts, 1U);
    EXPECT_EQ(fit.starts_if_poor, 0U);
    EXPECT_EQ(fit.seed, 1U);
    EXPECT_FALSE(fit.prediction_error);
    EXPECT_FALSE(fit.profile);
    EXPECT_EQ(fit.jobs, 1U);
    const drive::Descent descent;
    EXPECT_EQ(descent.accepted_error, 0.0);
    EXPECT_EQ(descent.iterations, 200);
    EXPECT_EQ(descent.tolerance, 1e-10);
}

// Of whole orders, and of what has no gain nothing.
TEST(Defaults, AControllerIsOfWholeOrders) {
    const drive::FractionalPid pid;
    EXPECT_EQ(pid.kp, 0.0);
    EXPECT_EQ(pid.ki, 0.0);
    EXPECT_EQ(pid.kd, 0.0);
    EXPECT_EQ(pid.integral_order, 1.0);
    EXPECT_EQ(pid.derivative_order, 1.0);
}

TEST(Defaults, ALogHasInputAndOutputAndNoCounter) {
    const drive::Columns columns;
    EXPECT_TRUE(columns.needs_input);
    EXPECT_TRUE(columns.needs_output);
    EXPECT_FALSE(columns.takes_reference);
    EXPECT_FALSE(columns.counts_per_unit);
    EXPECT_EQ(columns.counter_bits, 0);
    const drive::StampReport report;
    EXPECT_EQ(report.repeated + report.backward + report.missing, 0U);
    EXPECT_EQ(report.first_repeated, 0U);
    EXPECT_EQ(report.first_backward, 0U);
    EXPECT_EQ(report.first_gap, 0U);
    EXPECT_FALSE(report.spread);
}

// A blind case: 4000 samples at 100 Hz, written as they are.
TEST(Defaults, ABlindCaseIsWrittenAsItIs) {
    const stand::blind::Clock clock;
    EXPECT_EQ(clock.interval_s, 0.01);
    EXPECT_EQ(clock.spread_s, 0.0);
    EXPECT_EQ(clock.until_s, 40.0);
    const stand::blind::Logger logger;
    EXPECT_EQ(logger.stamp_step_s, 1e-6);
    EXPECT_EQ(logger.output_step, 1e-9);
    EXPECT_EQ(logger.input_jump, 0.0);
    EXPECT_EQ(logger.repeated_share, 0.0);
    EXPECT_EQ(logger.missing_share, 0.0);
    EXPECT_FALSE(logger.own_clock);
}

}  // namespace
