// Stamps in other units than seconds, dates, and times since 1970.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "base/failure.hpp"
#include "drive/log.hpp"
#include "drive/stamps.hpp"

namespace {

using drive::Columns;
using drive::Log;
using testing::AllOf;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

Log read(const std::string& text, Columns columns = {}) {
    columns.needs_input = false;
    return drive::parse_log(text, "l.csv", columns);
}

std::string refusal(const std::string& text, Columns columns = {}) {
    try {
        (void)read(text, std::move(columns));
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        return failure.what();
    }
    ADD_FAILURE() << "not refused: " << text;
    return "";
}

TEST(LogStamps, TakeTheirUnitFromTheHeader) {
    for (const char* name : {"time_ms", "t_ms", "time [ms]", "Time (ms)", "timestamp/ms", "t ms", "millis"}) {
        const Log log = read(std::string(name) + ",y\n0,1\n10,2\n30,3\n");
        EXPECT_THAT(log.time_s, ElementsAre(0, 0.01, 0.03)) << name;
        EXPECT_THAT(log.warnings, ElementsAre(HasSubstr("stamps in milliseconds"))) << name;
    }
    for (const char* name : {"timestamp_us", "t [us]", "t [\xC2\xB5s]", "micros"}) {
        EXPECT_THAT(read(std::string(name) + ",y\n0,1\n10000,2\n").time_s, ElementsAre(0, 0.01)) << name;
    }
    EXPECT_THAT(read("time_min,y\n0,1\n2,2\n").time_s, ElementsAre(0, 120));
    EXPECT_THAT(read("t_h,y\n0,1\n2,2\n").time_s, ElementsAre(0, 7200));
    EXPECT_THAT(read("clock_ms,y\n0,1\n10,2\n", {.time = "clock_ms"}).time_s, ElementsAre(0, 0.01));
    EXPECT_THAT(read("t [s],y\n0,1\n10,2\n").time_s, ElementsAre(0, 10));
    // Names alone say nothing of the unit: seconds, however large the values.
    EXPECT_THAT(read("time,y\n0,1\n10000,2\n").time_s, ElementsAre(0, 10000));
}

TEST(LogStamps, TakeTheirUnitFromTheRowOfUnits) {
    const Log log = read("time;y\nms;mm\n0;1\n10;2\n");
    EXPECT_THAT(log.time_s, ElementsAre(0, 0.01));
    EXPECT_THAT(log.warnings, ElementsAre(HasSubstr("semicolons, a row of units, stamps in milliseconds")));
    EXPECT_THAT(read("time,y,z\n[us],[V],\n0,1,\n10,2,\n").time_s, ElementsAre(0, 1e-5));
    EXPECT_THAT(refusal("time_s,y\nms,mm\n0,1\n10,2\n"), HasSubstr("--time-unit s or ms decides"));
    EXPECT_THAT(read("time_s,y\nms,mm\n0,1\n10,2\n", {.time_unit = "ms"}).time_s, ElementsAre(0, 0.01));
    EXPECT_THAT(refusal("time,y\n[ticks],[V]\n0,1\n10,2\n"),
                AllOf(HasSubstr("found '[ticks]' in the row of units"), HasSubstr("--time-unit")));
    EXPECT_THAT(refusal("time,y,z\n[ms],[V]\n0,1,1\n10,2,1\n"), HasSubstr("l.csv:2: expected 3 fields"));
}

TEST(LogStamps, AnOptionDecidesTheUnit) {
    const Log log = read("t_ms,y\n0,1\n10,2\n", {.time_unit = "us"});
    EXPECT_THAT(log.time_s, ElementsAre(0, 1e-5));
    EXPECT_THAT(refusal("t,y\n0,1\n10,2\n", {.time_unit = "ticks"}), HasSubstr("--time-unit: expected ns, us, ms"));
    EXPECT_THAT(refusal("t,y\n1e308,1\n1.1e308,2\n", {.time_unit = "h"}), HasSubstr("finite number of seconds"));
}

TEST(LogStamps, DatesCountFromTheFirst) {
    for (const char* zone : {"", "Z", "+02:00", "-0330", "+05", " +02:00"}) {
        for (const char* between : {"T", " "}) {
            std::string text = "timestamp,y\n";
            for (const auto& [day, time] :
                 {std::pair{"2024-02-29", "23:59:59.123"}, {"2024-02-29", "23:59:59,5"}, {"2024-03-01", "00:00:01"}}) {
                text += fmt::format("\"{}{}{}{}\",1\n", day, between, time, zone);
            }
            const Log log = read(text);
            EXPECT_THAT(log.time_s, ElementsAre(0, DoubleNear(0.377, 1e-12), DoubleNear(1.877, 1e-12))) << text;
            EXPECT_THAT(log.warnings, ElementsAre(HasSubstr("dates as stamps, 0 s at the first"))) << text;
        }
    }
    EXPECT_THAT(read("2024-05-01 12:00,1\n2024-05-01 12:01,2\n").time_s, ElementsAre(0, 60));
    // The same moment, told at two places.
    EXPECT_THAT(read("time,y\n2024-05-01T12:00:00Z,1\n2024-05-01T14:00:00.25+02:00,2\n").time_s, ElementsAre(0, 0.25));
    EXPECT_THAT(read("time,y\n2024-05-01T12:00:00Z,1\n2024-05-01T08:30:01-03:30,2\n").time_s, ElementsAre(0, 1));
    EXPECT_THAT(refusal("time,y\n2024-05-01T12:00:00Z,1\n2024-05-01T14:00:01,2\n"),
                HasSubstr("l.csv:3: time: expected dates with an offset from UTC"));
    EXPECT_THAT(refusal("time,y\n2024-05-01T12:00:00,1\n5,2\n"), HasSubstr("l.csv:3: time: expected a date"));
    EXPECT_THAT(refusal("time,y\n0,1\n2024-05-01T12:00:00,1\n"), HasSubstr("expected a finite number, found '2024-"));
    for (const char* date : {"2023-02-29T12:00:00", "2024-13-01T12:00:00", "2024-05-01T24:00:00", "2024-05-01T12:60",
                             "2024-05-01T12:00:00.", "2024-05-01T12:00:00+1", "2024-05-01T12:00:00Zx", "2024-05-01",
                             "2024-05-01T12:00:61", "2024-05-01T12:00:00+24:00", "2024-05-01T12:00:00+02:60"}) {
        EXPECT_THAT(refusal(std::string("time,y\n") + date + ",1\n"), HasSubstr("expected a finite number")) << date;
    }
    EXPECT_THAT(refusal("time,y\n2024-05-01T12:00,1\n", {.time_unit = "ms"}), HasSubstr("found a date"));
}

// Each part has its two digits, and nothing stands for none.
TEST(LogStamps, DatesHaveAllTheirDigits) {
    for (const char* text :
         {"2024-05-01T12:", "2024-05-01T12:5", "2024-05-01T12:xx", "2024-05-01T12:+02:00", "2024-05-01T12: +02",
          "2024-05-01T12:00:", "2024-05-01T12:00:5", "2024-05-01T12:00: Z", "2024-05-01T12:00+", "2024-05-01T12:00+0",
          "2024-05-01T12:00+x", "2024-05-01T12:00x", "2024-05-01T12:00+02:", "2024-05-01T12:00+02:0",
          "2024-05-01T12:00+02:xx", "2024-05-01T:00", "2024-05-T12:00", "2024--01T12:00", "-05-01T12:00"}) {
        EXPECT_FALSE(drive::looks_like_date(text)) << text;
    }
    // A field is part of a line: digits behind it are none of it.
    const std::string_view line = "2024-05-01T12:00:00.25";
    EXPECT_EQ(drive::date_of(line.substr(0, 21)).value().part, 0.2);
    EXPECT_EQ(drive::date_of(line).value().part, 0.25);
}

TEST(LogStamps, TimesSince1970CountFromTheFirst) {
    const Log seconds = read("time_s,y\n1714564800.25,1\n1714564800.5,2\n1714564799,2\n");
    EXPECT_THAT(seconds.time_s, ElementsAre(0, 0.25, -1.25));
    EXPECT_THAT(seconds.warnings, ElementsAre(HasSubstr("stamps in seconds since 1970, 0 s at the first")));
    EXPECT_THAT(read("timestamp_us,y\n1714564800123456,1\n1714564800123457,2\n").time_s, ElementsAre(0, 1e-6));
    // Exact, though no double holds these numbers apart.
    EXPECT_THAT(read("t_ns,y\n1714564800123456789,1\n1714564800123456790,2\n").time_s, ElementsAre(0, 1e-9));
    EXPECT_THAT(read("time,y\n1.714564801e9,1\n1.714564802e9,2\n").time_s, ElementsAre(0, 1));
    // Written out or not, before 1970 or after.
    EXPECT_THAT(read("time_s,y\n1714564800.25,1\n1.7145648005e9,2\n-5.5,2\n").time_s,
                ElementsAre(0, 0.25, -1714564805.75));
    EXPECT_THAT(read("timestamp,y\n1714564800,1\n1714564801,2\n").warnings,
                ElementsAre(HasSubstr("stamps in seconds since 1970, 0 s at the first")));
    EXPECT_THAT(read("t_ms,y\n1714564800123,1\n1714564800133,2\n").warnings,
                ElementsAre(HasSubstr("stamps in milliseconds since 1970, 0 s at the first")));
    // Thirteen digits are milliseconds of this century, or seconds in fifty thousand years.
    const Log by_size = read("timestamp,y\n1714564800123,1\n1714564800133,2\n");
    EXPECT_THAT(by_size.time_s, ElementsAre(0, 0.01));
    EXPECT_THAT(by_size.warnings, ElementsAre(HasSubstr("stamps in milliseconds since 1970 by their size")));
    EXPECT_THAT(read("time_s,y\n1714564800123,1\n1714564800133,2\n").time_s, ElementsAre(1714564800123, 1714564800133));
    EXPECT_THAT(read("timestamp,y\n1714564800123,1\n1714564800133,2\n", {.time_unit = "us"}).time_s[0], 1714564.800123);
}

}  // namespace
