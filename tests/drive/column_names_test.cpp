// What the names of a log's columns say: units of time, roles, and what is near to a name that is not there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drive/log_columns.hpp"
#include "drive/time_unit.hpp"
#include "tests/drive/refused.hpp"

namespace {

using drive::Columns;
using drive::Field;
using drive::LogColumns;
using test::refusal_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr std::size_t none = LogColumns::none;

TEST(TimeUnits, AreKnownByTheirUsualNames) {
    struct Known {
        const char* symbol;
        const char* name;
        double in_a_second, seconds;
        std::vector<std::string_view> words;
    };
    const std::vector<Known> all = {
        {"ns", "nanoseconds", 1e9, 1.0, {"ns", "nsec", "nanos", "nanoseconds"}},
        {"us", "microseconds", 1e6, 1.0, {"us", "usec", "micros", "microseconds", "\xC2\xB5s", "\xCE\xBCs", "\xB5s"}},
        {"ms", "milliseconds", 1e3, 1.0, {"ms", "msec", "millis", "milliseconds", "MS", "[ms]", "( ms )", " ms\t"}},
        {"s", "seconds", 1.0, 1.0, {"s", "sec", "secs", "seconds", "S", "[s]", "(s)"}},
        {"min", "minutes", 1.0, 60.0, {"min", "minutes", "Min"}},
        {"h", "hours", 1.0, 3600.0, {"h", "hours", "HOURS"}},
    };
    for (const Known& known : all) {
        for (const std::string_view word : known.words) {
            const auto unit = drive::time_unit_of(word);
            ASSERT_TRUE(unit) << word;
            EXPECT_STREQ(unit->symbol, known.symbol);
            EXPECT_STREQ(unit->name, known.name);
            EXPECT_EQ(unit->seconds(3.0), 3.0 * known.seconds / known.in_a_second) << word;
            EXPECT_TRUE(*unit == (drive::TimeUnit{"", "", known.seconds, known.in_a_second}));
        }
    }
    for (const char* word : {"", "m", "d", "[]", "[s", "s]", "[s)", "(s]", "[", "ss", "s s"}) {
        EXPECT_FALSE(drive::time_unit_of(word)) << word;
    }
    EXPECT_FALSE(*drive::time_unit_of("s") == *drive::time_unit_of("ms"));
    EXPECT_FALSE(*drive::time_unit_of("s") == *drive::time_unit_of("min"));
    EXPECT_EQ(drive::time_unit_of("ms")->seconds(10.0), 0.01);  // as it is written
    // Only capital letters become small: not what stands before and behind them.
    EXPECT_EQ(drive::lower("@AMZ[`az{"), "@amz[`az{");
}

TEST(ColumnNames, HaveTheirUnitInBrackets) {
    const auto parts = [](std::string_view name) {
        const auto [base, unit] = drive::split_unit(name);
        return std::pair(base, unit);
    };
    const auto two = [](const char* base, const char* unit) { return std::pair<std::string, std::string>(base, unit); };
    EXPECT_EQ(parts("y [mm]"), two("y", "mm"));
    EXPECT_EQ(parts("y(mm)"), two("y", "mm"));
    EXPECT_EQ(parts("y [ mm ]"), two("y", "mm"));
    EXPECT_EQ(parts("y []"), two("y", ""));
    EXPECT_EQ(parts("x[1] [V]"), two("x[1]", "V"));
    EXPECT_EQ(parts("x (old) [V]"), two("x (old)", "V"));
    // Brackets that are all of the name, or stand within it, or do not match.
    for (const char* name : {"[mm]", "(mm)", "y [mm] raw", "y [mm)", "y mm]", "y", ""}) {
        EXPECT_EQ(parts(name), two(name, "")) << name;
    }
}

TEST(ColumnNames, HaveAUnitOfTimeBehindAJointToo) {
    const auto parts = [](std::string_view name) {
        const auto [base, unit] = drive::split_time_unit(name);
        return base + '|' + (unit ? unit->symbol : "none");
    };
    for (const char* name : {"t_ms", "t/ms", "t ms", "t [ms]", "t(ms)", "t__ms", "t_/ ms"}) {
        EXPECT_EQ(parts(name), "t|ms") << name;
    }
    EXPECT_EQ(parts("a_b_ms"), "a_b|ms");
    // A unit alone, and one behind joints alone.
    EXPECT_EQ(parts("ms"), "|ms");
    EXPECT_EQ(parts("[ms]"), "|ms");
    EXPECT_EQ(parts("__ms"), "|ms");
    EXPECT_EQ(parts("_ms"), "_ms|none");
    // Other units are none of time, and in brackets no part of the name.
    EXPECT_EQ(parts("t [V]"), "t|none");
    EXPECT_EQ(parts("t_V"), "t_V|none");
    EXPECT_EQ(parts("t"), "t|none");
}

std::vector<Field> fields_of(const std::vector<std::string_view>& texts) {
    std::vector<Field> fields;
    for (const std::string_view text : texts) {
        fields.push_back({text, false});
    }
    return fields;
}

drive::LogHeader header(const std::vector<std::string_view>& names) {
    return drive::header_of(fields_of(names), "l.csv:1");
}

TEST(LogHeader, IsWrittenUnlessItBeginsWithANumberOrADate) {
    EXPECT_TRUE(header({"t", "1"}).is_written);
    EXPECT_THAT(header({"t", "1"}).names, ElementsAre("t", "1"));
    EXPECT_EQ(header({"t", "1"}).place, "l.csv:1");
    EXPECT_FALSE(header({"0,5", "u", "y"}).is_written);
    EXPECT_THAT(header({"0,5", "u", "y"}).names, ElementsAre("1", "2", "3"));
    EXPECT_FALSE(header({"2024-05-01T10:00:00", "1"}).is_written);
    EXPECT_THAT(drive::header_of({{"t", false}, {"a \"\"b\"\"", true}}, "").names, ElementsAre("t", "a \"b\""));
}

TEST(LogColumns, WithoutAHeaderAreTakenByTheirNumbers) {
    const LogColumns three = drive::find_columns(header({"0", "1", "2"}), {.needs_input = false});
    EXPECT_EQ(three.time, 0U);
    EXPECT_EQ(three.input, 1U);
    EXPECT_EQ(three.output, 2U);
    EXPECT_EQ(three.reference, none);
    EXPECT_EQ(three.simulated, none);
    EXPECT_THAT(three.found, ElementsAre("column 1 as time", "column 2 as input", "column 3 as output"));
    // Of two the second is the output, unless there has to be an input.
    const LogColumns two = drive::find_columns(header({"0", "1"}), {.needs_input = false});
    EXPECT_EQ(two.input, none);
    EXPECT_EQ(two.output, 1U);
    EXPECT_THAT(two.found, ElementsAre("column 1 as time", "column 2 as output"));
    EXPECT_THAT(refusal_of([] { (void)drive::find_columns(header({"0"}), {.needs_input = false}); }),
                HasSubstr("or a column 2 for the output, found 1 columns without a header"));
    // A reference is never one of them.
    EXPECT_EQ(drive::find_columns(header({"0", "1", "2"}), {.takes_reference = true}).reference, none);
    EXPECT_THAT(refusal_of([] {
                    (void)drive::find_columns(header({"0", "1", "2"}), {.output = "4"});
                }),
                HasSubstr("expected a column 4 for the output; the log has no header, its columns are 1 to 3"));
}

TEST(LogColumns, AreGivenByNameOrElseByNumber) {
    const auto output = [](const std::string& asked) {
        return drive::find_columns(header({"time_s", "u", "1", "p"}), {.output = asked}).output;
    };
    EXPECT_EQ(output("p"), 3U);
    EXPECT_EQ(output("4"), 3U);
    EXPECT_EQ(output("3"), 2U);
    EXPECT_EQ(output("1"), 2U);  // a column that is called so
    for (const char* asked : {"0", "5", "4x", "-1", "4 "}) {
        EXPECT_THAT(refusal_of([&] { (void)output(asked); }),
                    HasSubstr(std::string("expected a column ") + asked + " for the output, found 'time_s,u,1,p'"));
    }
    const LogColumns more = drive::find_columns(header({"time_s", "u", "y", "p", "q", "reference"}),
                                                {.more_inputs = {"q", "4"}, .simulated = "6"});
    EXPECT_THAT(more.more_inputs, ElementsAre(4U, 3U));
    EXPECT_EQ(more.simulated, 5U);
    EXPECT_EQ(more.reference, none);
    EXPECT_THAT(more.found, ElementsAre("'u' as input"));
}

// A unit in full is the time: of four letters or more, which no other quantity has.
TEST(LogColumns, AreTheTimeByAUnitInFull) {
    for (const char* name : {"msec", "usec", "secs", "millis", "Seconds"}) {
        EXPECT_EQ(drive::find_columns(header({"u", name, "y"}), {}).time, 1U) << name;
    }
    for (const char* name : {"min", "sec", "ms", "s", "x_millis"}) {
        EXPECT_THAT(refusal_of([&] {
                        (void)drive::find_columns(header({"u", name, "y"}), {});
                    }),
                    HasSubstr("expected a column time_s for the time"))
            << name;
    }
    // Single letters as they are.
    EXPECT_EQ(drive::find_columns(header({"t", "CMD", "Measurement [mm]"}), {}).input, 1U);
    EXPECT_THAT(refusal_of([] {
                    (void)drive::find_columns(header({"t", "U", "y"}), {});
                }),
                HasSubstr("expected a column input, duty for the input, found 't,U,y'"));
}

TEST(LogColumns, OfALoopHaveAReferenceForTheInput) {
    const auto names = header({"time_s", "reference", "set", "y"});
    const LogColumns usual = drive::find_columns(names, {.takes_reference = true});
    EXPECT_EQ(usual.reference, 1U);
    EXPECT_EQ(usual.input, none);
    EXPECT_EQ(drive::find_columns(names, {.reference = "set", .takes_reference = true}).reference, 2U);
    EXPECT_THAT(refusal_of([&] { (void)drive::find_columns(names, {}); }), HasSubstr("for the input"));
    // Where there is an input too, both are read.
    const LogColumns both =
        drive::find_columns(header({"time_s", "reference", "duty", "y"}), {.takes_reference = true});
    EXPECT_EQ(both.input, 2U);
    EXPECT_EQ(both.reference, 1U);
}

TEST(LogColumns, OfTwoRolesAreTwo) {
    const auto said = [](const Columns& asked) {
        return refusal_of([&] { (void)drive::find_columns(header({"time_s", "u", "y", "reference", "p"}), asked); });
    };
    EXPECT_EQ(said({.time = "u"}),
              "l.csv:1: expected different columns for the time and the input, found u for both; --input-column names "
              "another");
    EXPECT_THAT(said({.output = "time_s"}), HasSubstr("for the time and the output, found time_s for both"));
    EXPECT_THAT(said({.reference = "y", .takes_reference = true}),
                HasSubstr("for the output and the reference, found y for both; --reference-column names another"));
    EXPECT_THAT(said({.simulated = "y"}), HasSubstr("for the output and the simulation, found y for both"));
    EXPECT_THAT(said({.more_inputs = {"p", "p"}}), HasSubstr("for the input and another input, found p for both"));
    EXPECT_EQ(said({.more_inputs = {"p", "reference"}}), "accepted");
    // Columns that are not there are not the same one.
    EXPECT_EQ(said({.needs_input = false, .needs_output = false}), "accepted");
}

TEST(LogColumns, AreSuggestedUpToFortyLettersAndOf256NearNames) {
    const auto said = [](const std::vector<std::string_view>& names) {
        return refusal_of([&] { (void)drive::find_columns(header(names), {.input = "abcd"}); });
    };
    const std::string forty = std::string(36, 'z') + "abcd";
    EXPECT_THAT(said({"time_s", forty, "y"}), HasSubstr("; nearest: '" + forty + "'"));
    EXPECT_THAT(said({"time_s", 'z' + forty, "y"}), Not(HasSubstr("nearest")));
    // The nearest is found behind 255 near names; a file may have millions, which are not all compared.
    const auto behind = [&](std::size_t count) {
        std::vector<std::string_view> names = {"time_s"};
        names.insert(names.end(), count, "abxy");
        names.emplace_back("abcx");
        return said(names);
    };
    EXPECT_THAT(behind(255), HasSubstr("; nearest: 'abcx', 'abxy', 'abxy'"));
    EXPECT_THAT(behind(256), HasSubstr("; nearest: 'abxy', 'abxy', 'abxy'"));
}

TEST(LogColumns, HaveUnitsBelowWhereOneIsKnownAndNothingIsANumber) {
    const auto is_row = [](const std::vector<std::string_view>& texts) {
        return drive::is_row_of_units(fields_of(texts), 1);
    };
    EXPECT_TRUE(is_row({"1", "ms", "2"}));  // of the time, whatever the others
    EXPECT_FALSE(is_row({"ms", "1", "2"}));
    EXPECT_TRUE(is_row({"-", "-", "rpm"}));
    EXPECT_TRUE(is_row({"V", "-", "-"}));
    EXPECT_TRUE(is_row({"-", "x", "min"}));
    EXPECT_FALSE(is_row({"V", "-", "1"}));
    EXPECT_FALSE(is_row({"V", "-", "2024-05-01T10:00:00"}));
    EXPECT_FALSE(is_row({"-", "-", "-"}));
    EXPECT_TRUE(is_row({"-", "-", "[x]"}));
    EXPECT_TRUE(is_row({"(x)", "-", "-"}));
    EXPECT_FALSE(is_row({"[]", "()", "[x)"}));
    EXPECT_FALSE(is_row({"xy]", "(xy", "[xy"}));
}

}  // namespace
