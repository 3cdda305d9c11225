// A log on steps of another rate, and what is simulated there back at the log's stamps.
#include "drive/over_log.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

drive::Log log_from(double first_s) {
    drive::Log log;
    log.name = "made";
    log.time_s = {first_s, first_s + 0.1, first_s + 0.25, first_s + 0.5};
    log.input = {1.0, 2.0, 3.0, 4.0};
    log.output = {9.0, 9.0, 9.0, 9.0};
    log.more_inputs = {{5.0, 6.0, 7.0, 8.0}};
    log.line = {2, 3, 4, 5};
    return log;
}

TEST(OverLog, FromTheStartItKeepsItsIntervals) {
    for (const double first_s : {0.0, 7.0, -3.0}) {
        const drive::Log log = drive::from_start(log_from(first_s));
        ASSERT_EQ(log.time_s.size(), 4U);
        EXPECT_EQ(log.time_s[0], 0.0);
        EXPECT_NEAR(log.time_s[1], 0.1, 1e-12);
        EXPECT_NEAR(log.time_s[2], 0.25, 1e-12);
        EXPECT_NEAR(log.time_s[3], 0.5, 1e-12);
        EXPECT_EQ(log.input, log_from(first_s).input);
        EXPECT_EQ(log.output, log_from(first_s).output);
    }
}

TEST(OverLog, TheStepsBeginAtZeroAndReachTheLastStamp) {
    for (const double first_s : {0.0, 7.0, -3.0}) {
        const drive::Log steps = drive::on_steps(log_from(first_s), 0.2);  // no multiple of it is the last stamp
        ASSERT_EQ(steps.time_s.size(), 4U) << first_s;
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_NEAR(steps.time_s[k], 0.2 * static_cast<double>(k), 1e-12);
        }
        // What was applied stays until the next stamp, in every input.
        EXPECT_EQ(steps.input, (std::vector<double>{1.0, 2.0, 3.0, 4.0}));
        EXPECT_EQ(steps.more_inputs[0], (std::vector<double>{5.0, 6.0, 7.0, 8.0}));
    }
}

TEST(OverLog, ALastStampThatIsAStepIsTheLastStep) {
    EXPECT_EQ(drive::on_steps(log_from(0.0), 0.05).time_s.size(), 11U);
    EXPECT_EQ(drive::on_steps(log_from(0.0), 0.25).time_s.size(), 3U);
}

// A straight line is the same between the steps, wherever the log begins.
TEST(OverLog, TheOutputIsReadAtTheLogsOwnStamps) {
    for (const double first_s : {0.0, 7.0, -3.0}) {
        for (const double step_s : {0.03, 0.2, 0.5}) {
            const drive::Log log = log_from(first_s);
            drive::Log simulated = drive::on_steps(log, step_s);
            for (std::size_t k = 0; k < simulated.time_s.size(); ++k) {
                simulated.output[k] = 2.0 - 3.0 * simulated.time_s[k];
            }
            const drive::Log found = drive::at_own_stamps(log, simulated);
            EXPECT_EQ(found.time_s, log.time_s);
            EXPECT_EQ(found.input, log.input);
            ASSERT_EQ(found.output.size(), 4U);
            for (std::size_t k = 0; k < 4; ++k) {
                EXPECT_NEAR(found.output[k], 2.0 - 3.0 * (log.time_s[k] - first_s), 1e-12) << first_s << " " << step_s;
            }
        }
    }
}

}  // namespace
