// Logs: what is read, what is refused and where, and how stamps that do not rise are handled.
#include "drive/log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/failure.hpp"
#include "drive/decimals.hpp"
#include "drive/record.hpp"

namespace {

using drive::Columns;
using drive::Log;
using testing::ElementsAre;
using testing::HasSubstr;

std::string refusal(const std::string& text, const Columns& columns = {}) {
    try {
        Log log = drive::parse_log(text, "l.csv", columns);
        (void)drive::order_stamps(log);
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        return failure.what();
    }
    ADD_FAILURE() << "not refused: " << text.substr(0, 200);
    return "";
}

TEST(Log, TakesItsColumnsByName) {
    const Log log =
        drive::parse_log("# of a rig\n\n note, y ,time_s,duty\nx,1,0,0.27\r\n# pause\ny,2.5,0.01,0\n", "l.csv");
    EXPECT_THAT(log.time_s, ElementsAre(0, 0.01));
    EXPECT_THAT(log.input, ElementsAre(0.27, 0));
    EXPECT_THAT(log.output, ElementsAre(1, 2.5));
    EXPECT_THAT(log.line, ElementsAre(4, 6));
    const Log named =
        drive::parse_log("t,u,a,b\n0,1,2,3\n1,1,2,4\n", "l.csv", {.time = "t", .input = "u", .output = "b"});
    EXPECT_THAT(named.output, ElementsAre(3, 4));
    const Log scaled =
        drive::parse_log("time_s,counts\n0,0\n1,250\n", "l.csv", {.needs_input = false, .counts_per_unit = 125.0});
    EXPECT_THAT(scaled.output, ElementsAre(0, 2));
    EXPECT_TRUE(scaled.input.empty());
}

TEST(Log, RefusesWithFileAndLine) {
    EXPECT_THAT(refusal(""), HasSubstr("l.csv: expected a header"));
    EXPECT_THAT(refusal("# only\n"), HasSubstr("l.csv: expected a header"));
    EXPECT_THAT(refusal("time_s,output\n0,1\n1,2\n"),
                HasSubstr("l.csv:1: expected a column input, duty for the input, found"));
    EXPECT_THAT(refusal("when,input,y\n0,1,1\n"), HasSubstr("expected a column time_s"));
    EXPECT_THAT(refusal("time_s,input,y,output\n0,1,1,1\n"),
                HasSubstr("expected one column for the output, found y and output"));
    EXPECT_THAT(refusal("time_s,input,y\n0,1,1\n1,1\n"),
                HasSubstr("l.csv:3: expected 3 fields, as the header has, found 2"));
    EXPECT_THAT(refusal("time_s,input,y\n0,1,1\n1,1,nan\n"),
                HasSubstr("l.csv:3: y: expected a finite number, found 'nan'"));
    EXPECT_THAT(refusal("time_s,input,y\n0,1,1\n,1,2\n"),
                HasSubstr("l.csv:3: time_s: expected a finite number, found nothing"));
    EXPECT_THAT(refusal("time_s,input,y\n0,1,1\n1,1,2x\n"), HasSubstr("found '2x'"));
    EXPECT_THAT(refusal("time_s,input,y\n0,1,1\n"), HasSubstr("expected at least 2 samples, found 1"));
    EXPECT_THAT(refusal("time_s,duty,y\n0,27,1\n1,27,1\n"),
                HasSubstr("l.csv:2: duty: expected 0 to 1, found 27 (percent?"));
    EXPECT_THAT(refusal("time_s,duty,y\n0,-0.1,1\n1,0,1\n"), HasSubstr("found -0.1"));
    EXPECT_THAT(refusal("time_s,input,y\n" + std::string(70000, '1') + ",1,1\n"), HasSubstr("lines of at most"));
}

TEST(Log, ACounterThatWrapsIsRefusedOrUnwrapped) {
    const std::string text = "time_s,input,counts\n0,1,65530\n1,1,65535\n2,1,4\n3,1,65534\n";
    EXPECT_THAT(refusal(text), HasSubstr("l.csv:4: counts: jumps by -65531"));
    EXPECT_THAT(refusal(text), HasSubstr("--counter-bits 16"));
    const Log log = drive::parse_log(text, "l.csv", {.counts_per_unit = 1.0, .counter_bits = 16});
    EXPECT_THAT(log.output, ElementsAre(65530, 65535, 65540, 65534));
    const std::string fine = "time_s,input,counts\n0,1,10\n1,1,700\n2,1,-30\n";
    EXPECT_NO_THROW((void)drive::parse_log(fine, "l.csv"));
}

TEST(Log, OddUnitsAreWarnedOf) {
    EXPECT_THAT(drive::parse_log("time_s,input,angle_rad\n0,1,0\n1,1,45\n", "l.csv").warnings,
                ElementsAre(HasSubstr("l.csv:3: angle_rad reaches 45")));
    EXPECT_THAT(drive::parse_log("time_s,input,counts\n0,1,0\n1,1,4.5\n", "l.csv", {.counts_per_unit = 1.0}).warnings,
                ElementsAre(HasSubstr("expected whole numbers, found 4.5")));
}

TEST(Stamps, AreMadeToRiseAndReported) {
    Log log = drive::parse_log(
        "time_s,input,y\n0,1,0\n1,1,10\n1,2,20\n1,3,60\n2,3,5\n1.5,3,99\n3,3,6\n6,3,7\n7,3,8\n8,3,8\n9,3,8\n10,3,8\n",
        "l.csv");
    const auto report = drive::order_stamps(log);
    EXPECT_THAT(log.time_s, ElementsAre(0, 1, 2, 3, 6, 7, 8, 9, 10));
    EXPECT_THAT(log.output, ElementsAre(0, 30, 5, 6, 7, 8, 8, 8, 8));
    EXPECT_THAT(log.input, ElementsAre(1, 3, 3, 3, 3, 3, 3, 3, 3));
    EXPECT_EQ(report.repeated, 2U);
    EXPECT_EQ(report.first_repeated, 4U);
    EXPECT_EQ(report.backward, 1U);
    EXPECT_EQ(report.first_backward, 7U);
    EXPECT_EQ(report.missing, 2U);
    EXPECT_EQ(report.first_gap, 9U);
    EXPECT_EQ(report.usual_interval_s, 1.0);
    EXPECT_FALSE(report.clean());
    EXPECT_THAT(report.text(), HasSubstr("1 stamps run backward, from line 7: left out"));
    EXPECT_THAT(refusal("time_s,input,y\n3,1,1\n2,1,1\n4,1,1\n"), HasSubstr("expected stamps that rise; 1 of 3"));
    EXPECT_THAT(refusal("time_s,input,y\n3,1,1\n3,1,1\n"), HasSubstr("expected at least 2 different stamps"));
}

TEST(Resample, InterpolatesAndHolds) {
    const std::string text = "time_s,input,y\n0,0,0\n0.011,1,11\n0.02,1,20\n0.029,0,2\n";
    const auto linear = drive::resample(drive::parse_log(text, "l.csv"), 0.01, drive::Hold::linear);
    ASSERT_EQ(linear.log.output.size(), 3U);
    EXPECT_NEAR(linear.log.output[1], 10.0, 1e-12);
    EXPECT_NEAR(linear.log.output[2], 20.0, 1e-12);
    EXPECT_THAT(linear.log.input, ElementsAre(0, 0, 1));
    const auto held = drive::resample(drive::parse_log(text, "l.csv"), 0.01, drive::Hold::zero_order);
    EXPECT_THAT(held.log.output, ElementsAre(0, 0, 20));
    EXPECT_THROW((void)drive::resample(drive::parse_log(text, "l.csv"), 0.0, drive::Hold::linear), glsum::Failure);
    EXPECT_THROW((void)drive::resample(drive::parse_log(text, "l.csv"), 1.0, drive::Hold::linear), glsum::Failure);
    EXPECT_THROW((void)drive::resample(drive::parse_log(text, "l.csv"), 1e-12, drive::Hold::linear), glsum::Failure);
}

// 10 ms +- 1 ms to 1 kHz, as the paper does: of a slow signal the interpolation leaves its curvature alone.
TEST(Resample, KeepsASlowSignal) {
    Log log;
    log.name = "l.csv";
    double t = 0.0;
    for (int i = 0; i < 500; ++i) {
        log.time_s.push_back(t);
        log.output.push_back(std::sin(t));
        log.line.push_back(static_cast<std::size_t>(i + 2));
        t += 0.01 + 0.001 * std::sin(7.0 * i);
    }
    const auto resampled = drive::resample(log, 0.001, drive::Hold::linear);
    EXPECT_TRUE(resampled.stamps.clean());
    for (std::size_t k = 0; k < resampled.log.time_s.size(); ++k) {
        EXPECT_NEAR(resampled.log.output[k], std::sin(resampled.log.time_s[k]), 0.011 * 0.011 / 8);
    }
}

TEST(Log, IsWrittenAndReadBack) {
    Log log = drive::parse_log("time_s,input,y\n0,0.1,0.30000000000000004\n0.1,0.2,1e-300\n", "l.csv");
    const Log again = drive::parse_log(drive::to_csv(log), "l.csv");
    EXPECT_EQ(again.time_s, log.time_s);
    EXPECT_EQ(again.input, log.input);
    EXPECT_EQ(again.output, log.output);
}

// A field is part of a line: what stands behind it is none of it.
TEST(Decimals, EndWhereTheirFieldDoes) {
    const std::string_view line = "152e3";
    const std::string file = "l.csv";
    drive::Decimals decimals(file, "");
    EXPECT_EQ(decimals.number(line.substr(0, 2), 1, "y"), 15.0);
    EXPECT_EQ(decimals.number(line.substr(1, 2), 1, "y"), 52.0);
    EXPECT_TRUE(drive::looks_like_number(line.substr(0, 3)));
    EXPECT_FALSE(drive::looks_like_number(line.substr(0, 4)));
}

// By it messages and reports say which record they mean.
TEST(Record, HasTheNameOfItsLog) {
    std::string text = "time_s,input,output\n";
    for (int k = 0; k < 20; ++k) {
        text += std::to_string(k) + ",1," + std::to_string(k * k) + "\n";
    }
    EXPECT_EQ(drive::to_record(drive::parse_log(text, "l.csv")).name, "l.csv");
}

}  // namespace
