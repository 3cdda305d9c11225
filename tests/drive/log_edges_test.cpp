// Logs at the edges of their rules: exactly at, one below, one above.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "drive/log.hpp"
#include "drive/model_file.hpp"
#include "drive/static_characteristic.hpp"
#include "tests/drive/refused.hpp"

namespace {

using drive::Log;
using test::refusal_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Log log_at(const std::vector<double>& time_s, const std::vector<double>& output = {}) {
    Log log;
    log.name = "l.csv";
    for (std::size_t i = 0; i < time_s.size(); ++i) {
        log.time_s.push_back(time_s[i]);
        log.input.push_back(1.0);
        log.output.push_back(output.empty() ? static_cast<double>(i) : output[i]);
        log.line.push_back(i + 2);
    }
    return log;
}

TEST(LogEdges, AGapIsBeyondOneAndThreeQuartersOfTheUsualInterval) {
    const auto report = [](double interval_s) {
        Log log = log_at({0.0, 4.0, 8.0, 12.0, 12.0 + interval_s, 16.0 + interval_s});
        return drive::order_stamps(log);
    };
    EXPECT_EQ(report(7.0).missing, 0U);
    EXPECT_TRUE(report(7.0).clean());
    EXPECT_EQ(report(7.03125).missing, 1U);  // 1.7578 intervals
    EXPECT_EQ(report(7.03125).first_gap, 6U);
    EXPECT_EQ(report(9.9).missing, 1U);
    EXPECT_EQ(report(10.1).missing, 2U);
    EXPECT_EQ(report(7.0).largest_interval_s, 7.0);
    EXPECT_EQ(report(3.0).smallest_interval_s, 3.0);
    EXPECT_EQ(report(7.0).usual_interval_s, 4.0);
    EXPECT_EQ(report(7.0).text(), "intervals 4 to 7 s, usually 4 s");
    EXPECT_EQ(report(10.1).text(),
              "intervals 4 to 10.1 s, usually 4 s; about 2 samples missing, from line 6: the gaps are bridged");
}

TEST(LogEdges, ATenthMayRunBackward) {
    Log tenth = log_at({0, 1, 2, 3, 4, 5, 6, 5.5, 7, 8});
    const auto report = drive::order_stamps(tenth);
    EXPECT_EQ(report.backward, 1U);
    EXPECT_EQ(report.first_backward, 9U);
    EXPECT_EQ(tenth.time_s.size(), 9U);
    EXPECT_THAT(report.text(), HasSubstr("; 1 stamps run backward, from line 9: left out"));
    Log more = log_at({0, 1, 2, 3, 4, 5, 6, 5.5, 7});
    EXPECT_THAT(refusal_of([&] { (void)drive::order_stamps(more); }),
                HasSubstr("l.csv:9: expected stamps that rise; 1 of 9"));
    // The first of several is named.
    std::vector<double> many;
    for (int i = 0; i < 30; ++i) {
        many.push_back(i == 12 || i == 20 ? 5.5 : i);
    }
    Log two = log_at(many);
    const auto both = drive::order_stamps(two);
    EXPECT_EQ(both.backward, 2U);
    EXPECT_EQ(both.first_backward, 14U);
}

// Stamps of reception: at least three, at least half of all stamps repeat, and the samples of more than a tenth differ.
TEST(LogEdges, BurstsAreThoseOfWhichHalfRepeat) {
    const auto spreads = [](const std::vector<int>& sizes) {
        std::vector<double> time_s;
        double stamp = 0.0;
        for (const int size : sizes) {
            time_s.insert(time_s.end(), static_cast<std::size_t>(size), stamp);
            stamp += 1.0;
        }
        Log log = log_at(time_s);
        return drive::order_stamps(log).spread;
    };
    EXPECT_TRUE(spreads({2, 2, 2}));
    EXPECT_FALSE(spreads({3, 3}));
    EXPECT_TRUE(spreads({3, 1, 2, 2}));   // 8 samples, 4 stamps
    EXPECT_FALSE(spreads({3, 1, 2, 1}));  // 7 samples, 4 stamps
    // Bursts of so many samples, of which the last's differ, behind so many samples alone.
    const auto differing = [](std::size_t bursts, std::size_t size, std::size_t alone) {
        std::vector<double> time_s;
        std::vector<double> output;
        for (std::size_t i = 0; i < bursts + alone; ++i) {
            time_s.insert(time_s.end(), i < alone ? 1 : size, static_cast<double>(i));
            output.insert(output.end(), i < alone ? 1 : size, static_cast<double>(i));
        }
        output.back() = 77.0;
        Log log = log_at(time_s, output);
        return drive::order_stamps(log).spread;
    };
    EXPECT_TRUE(differing(9, 3, 0));
    EXPECT_FALSE(differing(10, 3, 0));
    EXPECT_TRUE(differing(9, 2, 0));
    EXPECT_FALSE(differing(10, 2, 0));
    EXPECT_TRUE(differing(9, 3, 3));  // what stands alone is no burst
    EXPECT_FALSE(differing(10, 3, 3));
}

TEST(LogEdges, TheFirstOfWhatIsOddIsNamedWhereverItStands) {
    // Of a pair the second is named, though longer bursts follow; of intervals the first may be a gap, and the usual
    // one of 1, 1, 2, 3, 3 is 2.
    Log repeated = log_at({0, 1, 1, 3, 3, 3, 4, 7, 10});
    const auto bursts = drive::order_stamps(repeated);
    EXPECT_EQ(bursts.repeated, 3U);
    EXPECT_EQ(bursts.first_repeated, 4U);
    EXPECT_EQ(bursts.usual_interval_s, 2.0);
    Log late = log_at({0, 4, 5, 6, 7});
    const auto gap = drive::order_stamps(late);
    EXPECT_EQ(gap.missing, 3U);
    EXPECT_EQ(gap.first_gap, 3U);
}

TEST(LogEdges, OneOddStampIsSaidToo) {
    drive::StampReport report;
    report.repeated = report.backward = report.missing = 1;
    report.first_repeated = 3;
    report.first_backward = 5;
    report.first_gap = 7;
    report.smallest_interval_s = 0.5;
    report.usual_interval_s = 1.0;
    report.largest_interval_s = 2.0;
    EXPECT_EQ(
        report.text(),
        "intervals 0.5 to 2 s, usually 1 s; 1 repeated stamps, from line 3: their mean output stays; 1 stamps run "
        "backward, from line 5: left out; about 1 samples missing, from line 7: the gaps are bridged");
}

TEST(LogEdges, WhatIsMadeOfALogKeepsItsNameAndItsWarnings) {
    Log log = log_at({0, 1, 2, 2, 3, 6}, {0, 1, 2, 4, 4, 4});
    log.warnings = {"l.csv: odd"};
    const auto even = drive::resample(log, 1.0, drive::Hold::zero_order);
    EXPECT_EQ(even.log.name, "l.csv");
    EXPECT_THAT(even.log.warnings, ElementsAre("l.csv: odd"));
    EXPECT_THAT(even.log.output, ElementsAre(0, 1, 3, 4, 4, 4, 4));
    EXPECT_EQ(even.stamps.repeated, 1U);
    EXPECT_EQ(even.stamps.missing, 2U);
    EXPECT_EQ(even.stamps.first_gap, 7U);
    drive::order_stamps(log);
    EXPECT_EQ(log.name, "l.csv");
    EXPECT_THAT(log.warnings, ElementsAre("l.csv: odd"));
}

// Beside a gap samples lie as far apart as they usually do, and no gap is one of exactly 1.75 usual intervals.
TEST(LogEdges, BurstsAreSpreadUpToAGap) {
    const auto spread = [](double interval_s) {
        std::vector<double> time_s;
        for (int i = 0; i < 20; ++i) {
            time_s.insert(time_s.end(), 4, 4.0 * i + (i >= 10 ? interval_s - 4.0 : 0.0));
        }
        Log log = log_at(time_s);
        EXPECT_TRUE(drive::order_stamps(log).spread);
        return log.time_s;
    };
    const auto wide = spread(8.0);
    EXPECT_NEAR(wide[39] - wide[36], 3.0, 1e-9);
    EXPECT_NEAR(wide[40], 44.0, 1e-9);
    EXPECT_NEAR(wide[79] - wide[76], 3.0, 1e-9);  // the last burst, behind which nothing comes
}

TEST(LogEdges, ACounterWrapsByNineTenthsOfItsRange) {
    const auto read = [](double from, double to) {
        return refusal_of([&] {
            (void)drive::parse_log(fmt::format("time_s,input,counts\n0,1,{}\n1,1,{}\n", from, to), "l.csv",
                                   {.counts_per_unit = 1.0});
        });
    };
    // 0.9 of 65536 are 58982.4.
    EXPECT_EQ(read(58982, 0), "accepted");
    EXPECT_EQ(read(58982.4, 0), "accepted");
    EXPECT_THAT(read(58983, 0), HasSubstr("--counter-bits 16"));
    EXPECT_THAT(read(65535, 0), HasSubstr("--counter-bits 16"));
    EXPECT_EQ(read(65536, 0), "accepted");  // no counter of 16 bits
    EXPECT_THAT(read(-32768, 32767), HasSubstr("jumps by 65535"));
    EXPECT_EQ(read(-32769, 32767), "accepted");
    EXPECT_EQ(read(-32768, 32768), "accepted");
    // Of 4294967296: 3865470566.4.
    EXPECT_EQ(read(3865470566, 0), "accepted");
    EXPECT_THAT(read(3865470567, 0), HasSubstr("--counter-bits 32"));
    EXPECT_THAT(read(-2147483648, 2147483647), HasSubstr("--counter-bits 32"));
    // Whatever is no counter may jump.
    EXPECT_NO_THROW((void)drive::parse_log("time_s,input,y\n0,1,65535\n1,1,0\n", "l.csv"));
    // Of a known width a step of half a turn is one, a longer one is a wrap; and so on, either way.
    const auto unwrapped = [](const std::string& counts) {
        std::string text = "time_s,input,counts\n";
        int k = 0;
        std::string number;
        for (const char c : counts + " ") {
            if (c != ' ') {
                number += c;
                continue;
            }
            text += fmt::format("{},1,{}\n", k++, number);
            number.clear();
        }
        return drive::parse_log(text, "l.csv", {.counts_per_unit = 1.0, .counter_bits = 8}).output;
    };
    EXPECT_THAT(unwrapped("0 128 0"), ElementsAre(0, 128, 0));
    EXPECT_THAT(unwrapped("0 129 2"), ElementsAre(0, -127, -254 + 256 - 256 + 0));
    EXPECT_THAT(unwrapped("200 40 250 100"), ElementsAre(200, 296, 250, 356));
}

TEST(LogEdges, UnitsAreDoubtedBeyondTheirBounds) {
    const auto said = [](const std::string& header, const std::string& value) {
        return refusal_of([&] { (void)drive::parse_log(header + "\n0," + value + "\n1,0,0\n", "l.csv"); });
    };
    EXPECT_EQ(said("time_s,duty,y", "1,1"), "accepted");
    EXPECT_EQ(said("time_s,duty,y", "0,1"), "accepted");
    EXPECT_EQ(said("time_s,duty,y", "1.5,1"), "l.csv:2: duty: expected 0 to 1, found 1.5 (percent? divide by 100)");
    EXPECT_EQ(said("time_s,duty,y", "100,1"), "l.csv:2: duty: expected 0 to 1, found 100 (percent? divide by 100)");
    EXPECT_EQ(said("time_s,duty,y", "1.005,1"), "l.csv:2: duty: expected 0 to 1, found 1.005 (percent? divide by 100)");
    EXPECT_EQ(said("time_s,duty,y", "101,1"), "l.csv:2: duty: expected 0 to 1, found 101");
    EXPECT_EQ(said("time_s,duty,y", "-1e-9,1"), "l.csv:2: duty: expected 0 to 1, found -1e-09");
    const auto warnings = [](double angle) {
        return drive::parse_log(fmt::format("time_s,input,angle_rad\n0,1,{}\n1,1,0\n", angle), "l.csv").warnings;
    };
    EXPECT_THAT(warnings(4.0 * std::numbers::pi), IsEmpty());
    EXPECT_THAT(warnings(-4.0 * std::numbers::pi), IsEmpty());
    EXPECT_THAT(warnings(12.6),
                ElementsAre("l.csv:2: angle_rad reaches 12.6: more than two turns; are these degrees?"));
    EXPECT_THAT(warnings(-12.6), ElementsAre(HasSubstr("reaches -12.6")));
    EXPECT_THAT(drive::parse_log("time_s,input,counts\n0,1,0.5\n1,1,2\n", "l.csv", {.counts_per_unit = 1.0}).warnings,
                ElementsAre("l.csv:2: counts: expected whole numbers, found 0.5"));
    for (const double per_unit : {0.0, double{INFINITY}, double{NAN}}) {
        EXPECT_THAT(refusal_of([&] {
                        (void)drive::parse_log("time_s,input,counts\n0,1,0\n1,1,2\n", "l.csv",
                                               {.counts_per_unit = per_unit});
                    }),
                    HasSubstr("--counts-per-unit: expected a number other than 0"));
    }
}

TEST(LogEdges, FurtherInputsAndASimulatedOutputAreReadByName) {
    const Log log = drive::parse_log("time_s,a,input,s,b,y\n0,1,2,3,4,5\n1,6,7,8,9,10\n", "l.csv",
                                     {.more_inputs = {"b", "a"}, .simulated = "s"});
    EXPECT_THAT(log.input, ElementsAre(2, 7));
    EXPECT_THAT(log.more_inputs, ElementsAre(ElementsAre(4, 9), ElementsAre(1, 6)));
    EXPECT_THAT(log.simulated, ElementsAre(3, 8));
    EXPECT_THAT(log.output, ElementsAre(5, 10));
}

TEST(LogEdges, CentriesOfSecondsAreSince1970) {
    const auto first = [](const std::string& stamp, const std::string& next, const char* unit = "") {
        return drive::parse_log("t,y\n" + stamp + ",1\n" + next + ",2\n", "l.csv",
                                {.needs_input = false, .time_unit = unit})
            .time_s[0];
    };
    EXPECT_EQ(first("999999999", "1000000001"), 999999999.0);
    EXPECT_EQ(first("1000000000", "1000000001"), 0.0);
    EXPECT_EQ(first("4199999999", "4200000001"), 0.0);
    EXPECT_EQ(first("4200000000", "4200000001"), 4200000000.0);
    EXPECT_EQ(first("999999999", "1000000001", "s"), 999999999.0);
    // 1e12 is that in milliseconds, 1e15 in microseconds, 1e18 in nanoseconds.
    EXPECT_EQ(first("1000000000000", "1000000000001"), 0.0);
    EXPECT_EQ(first("1000000000000000", "1000000000000001"), 0.0);
    EXPECT_EQ(first("1000000000000000000", "1000000000000000001"), 0.0);
    EXPECT_EQ(first("999999999999", "1000000000001"), 999999999999.0);
    // A number that is not written out is split where its seconds end.
    const Log written = drive::parse_log("t_s,y\n1.5e9,1\n1.50000000025e9,2\n", "l.csv", {.needs_input = false});
    EXPECT_NEAR(written.time_s[1], 0.25, 1e-6);
}

TEST(LogEdges, DatesMeanTheirParts) {
    const auto apart = [](const std::string& from, const std::string& to) {
        return drive::parse_log("t,y\n" + from + ",1\n" + to + ",2\n", "l.csv", {.needs_input = false}).time_s[1];
    };
    EXPECT_EQ(apart("2024-05-01T00:00:00", "2024-05-01T00:00:01"), 1.0);
    EXPECT_EQ(apart("2024-05-01T00:00:00", "2024-05-01T00:01:00"), 60.0);
    EXPECT_EQ(apart("2024-05-01T00:00:00", "2024-05-01T01:00:00"), 3600.0);
    EXPECT_EQ(apart("2024-05-01T00:00:00", "2024-05-02T00:00:00"), 86400.0);
    EXPECT_EQ(apart("2024-12-31T23:59:59", "2025-01-01T00:00:00"), 1.0);
    EXPECT_EQ(apart("2024-05-01T23:59:60", "2024-05-02T00:00:01"), 1.0);  // a leap second
    EXPECT_EQ(apart("2024-05-01T00:00:00.25", "2024-05-01T00:00:01.5"), 1.25);
    EXPECT_EQ(apart("2024-05-01T12:00:00+00:00", "2024-05-01T12:00:00-23:59"), 86340.0);
    EXPECT_EQ(apart("2024-05-01T12:00:00+01:30", "2024-05-01T12:00:00+00:00"), 5400.0);
}

TEST(LogEdges, LinesAreAtMostSoLong) {
    const auto row = [](std::size_t bytes) {
        const std::string text = "time_s,input,y,note\n0,1,1,\n1,1,1,";
        return text + std::string(bytes - std::string("1,1,1,").size(), 'x') + "\n";
    };
    EXPECT_NO_THROW((void)drive::parse_log(row(65536), "l.csv"));
    EXPECT_THAT(refusal_of([&] { (void)drive::parse_log(row(65537), "l.csv"); }),
                HasSubstr("l.csv:3: expected lines of at most 65536 bytes, found one of 65537"));
}

TEST(LogEdges, ResamplingEndsAtTheLastStamp) {
    const Log log = log_at({1.0, 1.5, 2.0});
    const auto at = drive::resample(log, 0.25, drive::Hold::linear);
    EXPECT_THAT(at.log.time_s, ElementsAre(1.0, 1.25, 1.5, 1.75, 2.0));
    EXPECT_THAT(at.log.output, ElementsAre(0.0, 0.5, 1.0, 1.5, 2.0));
    EXPECT_THAT(at.log.line, ElementsAre(2U, 2U, 3U, 3U, 4U));
    EXPECT_EQ(drive::resample(log, 1.0, drive::Hold::zero_order).log.output.size(), 2U);
    EXPECT_THAT(refusal_of([&] { (void)drive::resample(log, 1.01, drive::Hold::linear); }), HasSubstr("at most 1 s"));
    EXPECT_THAT(refusal_of([&] { (void)drive::resample(log, 1e-7, drive::Hold::linear); }),
                HasSubstr("at most 10000000 samples"));
    EXPECT_THAT(refusal_of([&] { (void)drive::resample(log, INFINITY, drive::Hold::linear); }), Not("accepted"));
}

TEST(LogEdges, StepsAreNumbersAboveZero) {
    const Log log = log_at({1.0, 1.5, 2.0});
    for (const double step_s : {0.0, -1.0, double{INFINITY}, double{NAN}}) {
        EXPECT_THAT(refusal_of([&] { (void)drive::resample(log, step_s, drive::Hold::linear); }),
                    HasSubstr("l.csv: expected a step above 0 s"));
    }
}

// What differs by rounding is what differs by less than 1e-9 of a step, at the end of a log and at each of its stamps.
TEST(LogEdges, ABillionthOfAStepIsRounding) {
    const auto samples = [](double to_s, drive::End end) {
        return drive::resample(log_at({0.0, 1.0, to_s}), 1.0, drive::Hold::linear, end).log.time_s.size();
    };
    EXPECT_EQ(samples(2.0 - 0.995e-9, drive::End::within), 3U);
    EXPECT_EQ(samples(2.0 - 1.005e-9, drive::End::within), 2U);
    EXPECT_EQ(samples(2.0 + 0.995e-9, drive::End::behind), 3U);
    EXPECT_EQ(samples(2.0 + 1.005e-9, drive::End::behind), 4U);
    const auto at_once = [](double second_s) {
        return drive::resample(log_at({0.0, second_s, 4.0, 8.0}), 4.0, drive::Hold::zero_order).log.output[0];
    };
    EXPECT_EQ(at_once(3.98e-9), 1.0);
    EXPECT_EQ(at_once(4e-9), 1.0);
    EXPECT_EQ(at_once(4.02e-9), 0.0);
}

// Also of stamps below 0.
TEST(LogEdges, BehindItsLastStampALogStaysAsItIs) {
    const auto behind =
        drive::resample(log_at({-8.0, -6.0, -4.5}, {1.0, 2.0, 5.0}), 1.0, drive::Hold::linear, drive::End::behind).log;
    EXPECT_THAT(behind.time_s, ElementsAre(-8.0, -7.0, -6.0, -5.0, -4.0));
    EXPECT_THAT(behind.output, ElementsAre(1.0, 1.5, 2.0, 4.0, 5.0));
}

// What is shown of a wrong value is at most its first 60 characters, and of a fault what lies about it.
TEST(ModelFileEdges, ShowWhatTheyFoundCutShort) {
    const auto said = [](const std::string& text) {
        return refusal_of([&] { (void)drive::parse_model(text, "m.json"); });
    };
    const std::string letters = std::string(80, 'a');
    EXPECT_EQ(said("{\"gain\": \"" + letters + "\"}"),
              "m.json: gain: expected a number, found \"" + std::string(59, 'a'));
    EXPECT_EQ(refusal_of([&] {
                  (void)drive::parse_controller("{\"kind\": \"pid\", \"kp\": 1, \"x\": \"" + letters + "\"}", "c.json");
              }),
              "c.json: expected kp, ki, kd, filter_s, integral_order and derivative_order, found {\"x\":\"" +
                  std::string(54, 'a'));
    EXPECT_EQ(said("{\"kind\": \"fotf\",   \"gain\": 12345 oops, 1}"),
              "m.json:1: expected JSON, found 'in\": 12345 oops, 1}'");
    EXPECT_EQ(said("oops"), "m.json:1: expected JSON, found 'oops'");
}

// A hold counts from its shortest time and 16 samples on; its last quarter is the level, its last eighth tells whether
// it settled: by a fiftieth of the range at most.
TEST(StaticCharacteristicEdges, HoldsCountAndSettleAtTheirBounds) {
    const auto stairs = [](std::size_t samples, double interval_s, double creep) {
        Log log;
        log.name = "l.csv";
        for (std::size_t k = 0; k < 2 * samples; ++k) {
            const bool second = k >= samples;
            const std::size_t at = second ? k - samples : k;
            log.time_s.push_back(interval_s * static_cast<double>(k));
            log.input.push_back(second ? 2.0 : 1.0);
            const bool in_last_eighth = 8 * at >= 7 * samples;
            log.output.push_back(second ? (in_last_eighth ? 10.0 : 10.0 - creep) : 0.0);
            log.line.push_back(k + 2);
        }
        return log;
    };
    EXPECT_EQ(drive::static_characteristic(stairs(16, 1.0, 0.0), 1.0).levels.size(), 2U);
    EXPECT_THAT(refusal_of([&] { (void)drive::static_characteristic(stairs(15, 1.0, 0.0), 1.0); }),
                HasSubstr("at least 1 s and 16 samples, the longest has 15 s"));
    EXPECT_EQ(drive::static_characteristic(stairs(64, 0.25, 0.0), 16.0).levels.size(), 1U);  // the last ends sooner
    EXPECT_EQ(drive::static_characteristic(stairs(64, 0.25, 0.0), 15.75).levels.size(), 2U);
    const auto settled = drive::static_characteristic(stairs(64, 1.0, 0.199), 1.0);
    EXPECT_TRUE(settled.levels[1].settled);  // a fiftieth of a range of 10 is 0.2
    EXPECT_NEAR(settled.levels[1].drift, 0.199, 1e-9);
    EXPECT_FALSE(drive::static_characteristic(stairs(64, 1.0, 0.201), 1.0).levels[1].settled);
    EXPECT_TRUE(settled.levels[1].rising);
    // The mean of the last quarter and its deviation: half of it 0.2 lower.
    EXPECT_NEAR(settled.levels[1].output, 9.9, 0.01);
    EXPECT_NEAR(settled.levels[1].deviation, 0.1, 0.01);
    EXPECT_NEAR(settled.slope, settled.levels[1].output, 1e-9);
    EXPECT_NEAR(settled.intercept, -settled.slope, 1e-9);
    const auto csv = drive::to_csv(settled);
    EXPECT_THAT(csv, HasSubstr("input,output,deviation,from_s,to_s,settled,rising\n1,0,0,0,64,1,1\n2,9.89"));
}

TEST(StaticCharacteristicEdges, BendsByItsFarthestLevel) {
    Log log;
    log.name = "l.csv";
    const double levels[] = {0.0, 1.0, 2.0, 1.0};
    const double outputs[] = {0.0, 1.5, 2.0, 1.5};
    for (std::size_t k = 0; k < 4 * 40; ++k) {
        log.time_s.push_back(static_cast<double>(k));
        log.input.push_back(levels[k / 40]);
        log.output.push_back(outputs[k / 40]);
        log.line.push_back(k + 2);
    }
    const auto found = drive::static_characteristic(log, 5.0);
    ASSERT_EQ(found.levels.size(), 4U);
    // Least squares of (0, 0), (1, 1.5) twice, (2, 2): slope 1, intercept 0.25; bent by 0.25 of 2.
    EXPECT_NEAR(found.slope, 1.0, 1e-12);
    EXPECT_NEAR(found.intercept, 0.25, 1e-12);
    EXPECT_NEAR(found.largest_bend, 0.125, 1e-12);
    EXPECT_TRUE(found.levels[0].rising);
    EXPECT_TRUE(found.levels[2].rising);
    EXPECT_FALSE(found.levels[3].rising);
    const auto picture = drive::picture_of_characteristic(found, "a \"title\"");
    EXPECT_THAT(picture.script, HasSubstr("$up << EOD\n0 0 0\n1 1.5 0\n2 2 0\nEOD\n$down << EOD\n1 1.5 0\nEOD\n"));
    EXPECT_THAT(picture.script, HasSubstr("plot 0.25 + 1 * x"));
}

// Where decimal commas may be meant three readings are shown, however many there are.
TEST(LogEdges, ThreeReadingsAreShown) {
    const auto said = refusal_of([] { (void)drive::parse_log("time_s,input,y,z\n1,5,2,3,4\n", "l.csv"); });
    EXPECT_THAT(said, HasSubstr("with decimal commas it may be '1,5 2 3 4' or '1 5,2 3 4' or '1 5 2,3 4'; quote such"));
    EXPECT_THAT(said, Not(HasSubstr("'1 5 2 3,4'")));
    EXPECT_THAT(
        refusal_of([] { (void)drive::parse_log("0,2\n1,4\n", "l.csv"); }),
        HasSubstr("l.csv:1: expected a header such as time_s,input,output or a column 3 for the output, found 2 "
                  "columns without a header; --output-column N names one by its number"));
    EXPECT_THAT(drive::parse_log("0,7,2\n1,7,4\n", "l.csv").warnings,
                ElementsAre("l.csv: read with no header, column 1 as time, column 2 as input, column 3 as output"));
}

// Of what may be read in two ways the first three fields are shown, and that there are more.
TEST(LogEdges, ThreeFieldsOfAReadingAreShown) {
    const auto said = [](const std::string& row) {
        return refusal_of([&] { (void)drive::parse_log(row + "\n" + row + "\n", "l.csv"); });
    };
    EXPECT_EQ(said("1,a,b,1;2;a;b"),
              "l.csv:2: 4 fields by comma: '1', 'a', 'b', ..., or 4 fields by semicolon: '1,a,b,1', '2', 'a', ...? "
              "--separator comma or semicolon decides");
    EXPECT_EQ(said("1,a,1;2;a"),
              "l.csv:2: 3 fields by comma: '1', 'a', '1;2;a', or 3 fields by semicolon: '1,a,1', '2', 'a'? "
              "--separator comma or semicolon decides");
}

}  // namespace
