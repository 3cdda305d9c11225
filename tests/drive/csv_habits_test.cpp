// Logs as loggers write them: what is found in the file, that it is said, and what is refused because it may be read in
// two ways.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/failure.hpp"
#include "drive/log.hpp"

namespace {

using drive::Columns;
using drive::Log;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// What the plain log below says, in another form, with the one line that is said of it.
void expect_same(const std::string& text, const std::string& said, const Columns& columns = {}) {
    SCOPED_TRACE(text);
    const Log log = drive::parse_log(text, "l.csv", columns);
    EXPECT_THAT(log.time_s, ElementsAre(0, 0.01, 0.02));
    EXPECT_THAT(log.input, ElementsAre(0.5, 1, -1.25));
    EXPECT_THAT(log.output, ElementsAre(1.5, 2, 1e-3));
    if (said.empty()) {
        EXPECT_THAT(log.warnings, IsEmpty());
    } else {
        EXPECT_THAT(log.warnings, ElementsAre("l.csv: read with " + said));
    }
}

std::string refusal(const std::string& text, const Columns& columns = {}) {
    try {
        (void)drive::parse_log(text, "l.csv", columns);
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        return failure.what();
    }
    ADD_FAILURE() << "not refused: " << text;
    return "";
}

TEST(LogHabits, AreFoundAndSaidInOneLine) {
    expect_same("time_s,input,output\n0,0.5,1.5\n0.01,1,2\n0.02,-1.25,1e-3\n", "");
    expect_same("time_s,input,output\r\n0,0.5,1.5\r\n0.01,1,2\r\n0.02,-1.25,1e-3\r\n", "");
    expect_same("time_s, input,\toutput\n0, 0.5, 1.5\n0.01, 1, 2\n0.02, -1.25, 1e-3\n", "");
    expect_same("\xEF\xBB\xBFtime_s,input,output\n0,0.5,1.5\n0.01,1,2\n0.02,-1.25,1e-3\n", "a byte order mark");
    expect_same("time_s;input;output\n0;0.5;1.5\n0.01;1;2\n0.02;-1.25;1e-3\n", "semicolons");
    expect_same("time_s;input;output\n0;0,5;1,5\n0,01;1;2\n0,02;-1,25;1e-3\n", "semicolons, decimal commas");
    expect_same("time_s\tinput\toutput\tnote\n0\t0,5\t1,5\t\n0,01\t1\t2\tx y\n0,02\t-1,25\t1e-3\t\n",
                "tabs, decimal commas");
    expect_same("time_s\tinput\toutput\n0\t0.5\t1.5\n0.01\t1\t2\n0.02\t-1.25\t1e-3\n", "tabs");
    expect_same("  time_s input   output\n0 0.5 1.5\n0.01 \t1 2\n0.02 -1.25 1e-3  \n", "blanks between fields");
    expect_same("0,5 0 1,5\n1 0,01 2\n-1,25 0,02 1e-3\n",
                "blanks between fields, decimal commas, no header, column 3 as output", {.time = "2", .input = "1"});
    expect_same(
        "\"time_s\",\"input\",\"a \"\"b\"\", c\",\"output\"\n\"0\",\"0,5\",\"1,2,3\",\"1,5\"\n\"0,01\",1,,2\n"
        "\"0,02\",\"-1,25\",\"\",\"1e-3\"\n",
        "quoted fields, decimal commas");
    expect_same("time_s,\"the \"\"u\"\", in V\",output\n0,0.5,1.5\n0.01,1,2\n0.02,-1.25,1e-3\n", "quoted fields",
                {.input = "the \"u\", in V"});
    expect_same("time_s;input;output\nsec;1;1\n0;0.5;1.5\n0.01;1;2\n0.02;-1.25;1e-3\n", "semicolons, a row of units");
    expect_same("time_s;input;output\ns;V;mm\n0;0.5;1.5\n0.01;1;2\n0.02;-1.25;1e-3\n", "semicolons, a row of units");
    expect_same("0,0.5,1.5\n0.01,1,2\n0.02,-1.25,1e-3\n",
                "no header, column 1 as time, column 2 as input, column 3 as output");
    expect_same("time,U,output [mm]\n0,0.5,1.5\n0.01,1,2\n0.02,-1.25,1e-3\n", "'time' as time, 'output [mm]' as output",
                {.input = "U"});
    expect_same("# a rig\n\n # t_us,u,y\nt_ms,u,y\n0,0.5,1.5\n10,1,2\n20,-1.25,1e-3\n",
                "stamps in milliseconds, 't_ms' as time, 'u' as input");
}

TEST(LogHabits, OptionsDecideAndAreNotSaid) {
    expect_same("time_s;input;output\n0;0,5;1,5\n0,01;1;2\n0,02;-1,25;1e-3\n", "",
                {.separator = "semicolon", .decimal = "comma"});
}

TEST(LogHabits, DecimalCommasAmongCommasAreRefusedWithTheirReadings) {
    EXPECT_THAT(refusal("time_s,output\n1,5,2\n2,5,3\n", {.needs_input = false}),
                AllOf(HasSubstr("l.csv:2: expected 2 fields, as the header has, found 3"), HasSubstr("'1,5 2'"),
                      HasSubstr("'1 5,2'"), HasSubstr("quote")));
    // A sign belongs to a whole part, and is none itself, nor stands behind a comma.
    for (const char* sign : {"-", "+"}) {
        EXPECT_THAT(refusal(fmt::format("time_s,output\n{}1,5,2\n", sign), {.needs_input = false}),
                    HasSubstr(fmt::format("it may be '{0}1,5 2' or '{0}1 5,2'; quote", sign)));
        EXPECT_THAT(refusal(fmt::format("time_s,output\n{},5,2\n", sign), {.needs_input = false}),
                    HasSubstr(fmt::format("it may be '{} 5,2'; quote", sign)));
        EXPECT_THAT(refusal(fmt::format("time_s,output\n1,{}5,2\n", sign), {.needs_input = false}),
                    HasSubstr(fmt::format("it may be '1 {}5,2'; quote", sign)));
    }
    const std::string twice = "time_s,input,output\n0,0,0,5,1,5\n0,01,1,0,2,0\n0,02,-1,25,0,001\n";
    EXPECT_THAT(refusal(twice), AllOf(HasSubstr("found 6"), HasSubstr("'0,0 0,5 1,5'; --decimal comma reads it so")));
    expect_same(twice, "", {.decimal = "comma"});
    expect_same("0,0,0,5,1,5\n0,01,1,0,2,0\n0,02,-1,25,0,001\n",
                "no header, column 1 as time, column 2 as input, column 3 as output", {.decimal = "comma"});
    EXPECT_THAT(refusal("time_s,output\n,,0,5\n", {.needs_input = false, .decimal = "comma"}),
                HasSubstr("l.csv:2: time_s: expected a finite number, found ','"));
    EXPECT_THAT(
        refusal("time_s,input,output,4,5,6,7,8,9,10,11,12,13,14,15,16\n0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16\n"),
        AllOf(HasSubstr("expected 16 fields, as the header has, found 17"), Not(HasSubstr("decimal"))));
    EXPECT_THAT(refusal("time_s;output\n0;1;2;3\n", {.needs_input = false, .decimal = "comma"}),
                HasSubstr("expected 2 fields, as the header has, found 4"));
    EXPECT_THAT(refusal("time_s,input,output\n0,1,2\n0,5,1,2\n", {.decimal = "comma"}),
                HasSubstr("l.csv:3: expected 3"));
}

// Without a header nothing tells how many columns there are.
TEST(LogHabits, DigitsThatNoNumberBeginsWithAreDoubted) {
    const std::string text = "0,50,1,00\n1,05,2,00\n";
    EXPECT_THAT(refusal(text), HasSubstr("l.csv:1: expected a header or decimal points, found '00' in '0,50,1,00': 4 "
                                         "fields, or fewer with decimal commas? --decimal point or comma decides"));
    const Log joined = drive::parse_log(text, "l.csv", {.needs_input = false, .decimal = "comma"});
    EXPECT_THAT(joined.time_s, ElementsAre(0.5, 1.05));
    EXPECT_THAT(joined.output, ElementsAre(1, 2));
    EXPECT_THAT(drive::parse_log(text, "l.csv", {.decimal = "point"}).input, ElementsAre(50, 5));
    EXPECT_THAT(drive::parse_log("0,1,00\n0.5,1,01\n", "l.csv").output, ElementsAre(0, 1));
    EXPECT_THAT(drive::parse_log("0,1,3\n10,1,4\n", "l.csv").output, ElementsAre(3, 4));
    EXPECT_THAT(drive::parse_log("time_s,input,y\n0,1,00\n1,1,01\n", "l.csv").output, ElementsAre(0, 1));
    EXPECT_THAT(drive::parse_log("0,1;00,2;1\n1,1;00,2;2\n", "l.csv").output, ElementsAre(1, 2));
    EXPECT_THAT(refusal("1,5,2\n2,5,3\n", {.decimal = "comma"}),
                HasSubstr("l.csv:1: expected an even number of fields"));
    EXPECT_THAT(drive::parse_log("0,\"0,5\",1,2\n1,\"1,5\",2,2\n", "l.csv", {.decimal = "comma"}).input,
                ElementsAre(0.5, 1.5));
}

TEST(LogHabits, WhatMayBeReadInTwoWaysIsRefused) {
    EXPECT_THAT(refusal("time_s;input;output\n0;0,5;1\n1;0.5;1\n"),
                HasSubstr("l.csv:3: input: expected decimal commas throughout, as '0,5' in line 2 has, found '0.5'"));
    EXPECT_THAT(refusal("time_s;input;output\n0;0.5;1\n", {.decimal = "comma"}),
                HasSubstr("expected decimal commas throughout, as --decimal says, found '0.5'"));
    EXPECT_THAT(refusal("time_s;input;output\n0;1.234,5;1\n"), HasSubstr("expected a finite number, found '1.234,5'"));
    EXPECT_THAT(refusal("0,5;on\n1,5;off\n"),
                AllOf(HasSubstr("2 fields by comma: '1', '5;off', or 2 fields by semicolon: '1,5', 'off'"),
                      HasSubstr("--separator comma or semicolon decides")));
    EXPECT_THAT(refusal("time_s,input,y\n0,1,1e999\n"), HasSubstr("expected a finite number, found '1e999'"));
    EXPECT_THAT(refusal("values\n1\n2\n"), HasSubstr("expected columns apart by commas, semicolons, tabs or blanks"));
    EXPECT_THAT(refusal("time_s,input,y\n0,1,\"2\n"), HasSubstr("l.csv:2: expected quotes that end with their field"));
    EXPECT_THAT(refusal("time_s,input,y\n0,1,\"2\"3\n"), HasSubstr("l.csv:2: expected quotes that end"));
    EXPECT_THAT(refusal("\xFF\xFEt\n"), HasSubstr("found UTF-16"));
    EXPECT_THAT(refusal("time_s,input,y\n0,1,1\n1,1,1\n", {.separator = "pipe"}), HasSubstr("found 'pipe'"));
    EXPECT_THAT(refusal("time_s,input,y\n0,1,1\n1,1,1\n", {.decimal = "dot"}), HasSubstr("found 'dot'"));
}

// A first row of words is no row of units: what is wrong with it is said as of any row.
TEST(LogHabits, ARowOfWordsIsNotOfUnits) {
    EXPECT_THAT(refusal("time_s,input,output\nstart,off,none\n0,1,2\n1,1,2\n"),
                HasSubstr("l.csv:2: time_s: expected a finite number, found 'start'"));
    EXPECT_THAT(refusal("time_s,input,output\n-,-,-\n0,1,2\n1,1,2\n"), HasSubstr("l.csv:2: time_s"));
    EXPECT_THAT(refusal("time_s,input,output\n0,1,nan\n0,1,2\n1,1,2\n"), HasSubstr("l.csv:2: output"));
    EXPECT_THAT(refusal("time_s,input,output\ns,V,mm\ns,V,mm\n0,1,2\n"), HasSubstr("l.csv:3: time_s"));
}

// What stands in brackets is a unit, be it one letter that no list knows; brackets around nothing are none.
TEST(LogHabits, ARowOfBracketsIsOfUnits) {
    const std::string readings = "0,0.5,1.5\n0.01,1,2\n0.02,-1.25,1e-3\n";
    for (const char* units : {"-,[x],[y]\n", "-,(x),(y)\n", "-,[xy],-\n"}) {
        expect_same("time_s,input,output\n" + (units + readings), "a row of units");
    }
    for (const char* words : {"-,[],[]\n", "-,(),()\n", "-,[x),(y]\n", "-,[,]\n"}) {
        EXPECT_THAT(refusal("time_s,input,output\n" + (words + readings)), HasSubstr("l.csv:2: time_s"));
    }
}

TEST(LogColumns, AreFoundByUsualNamesContractNamesWin) {
    const Log usual = drive::parse_log("Timestamp,cmd,Measured [rad],other\n0,1,2,3\n1,1,4,3\n", "l.csv");
    EXPECT_THAT(usual.output, ElementsAre(2, 4));
    EXPECT_THAT(usual.warnings, ElementsAre(HasSubstr("'Timestamp' as time, 'cmd' as input, 'Measured [rad]' as")));
    const Log own = drive::parse_log("time,time_s,u,duty,measured,y\n5,0,7,1,8,2\n6,1,7,0,8,4\n", "l.csv");
    EXPECT_THAT(own.time_s, ElementsAre(0, 1));
    EXPECT_THAT(own.input, ElementsAre(1, 0));
    EXPECT_THAT(own.output, ElementsAre(2, 4));
    EXPECT_THAT(own.warnings, IsEmpty());
    EXPECT_THAT(refusal("time_s,u,cmd,y\n0,1,1,1\n"),
                HasSubstr("expected one column for the input, found u and cmd: name one by --input-column"));
    EXPECT_THAT(refusal("T,u,y\n0,1,1\n"), HasSubstr("expected a column time_s for the time, found 'T,u,y'"));
}

TEST(LogColumns, EachIsReadOnce) {
    EXPECT_THAT(refusal("time_s,u,y\n0,1,1\n1,1,1\n", {.input = "u", .output = "u"}),
                HasSubstr("expected different columns for the input and the output, found u for both"));
    EXPECT_THAT(refusal("time_s,u,y\n0,1,1\n1,1,1\n", {.input = "u", .more_inputs = {"u"}}),
                HasSubstr("expected different columns for the input and another input, found u for both"));
}

TEST(LogColumns, NearNamesAreSuggested) {
    const auto said = [](const std::string& names) {
        return refusal("time_s," + names + ",y\n0,1,2,3,4,5\n1,1,2,3,4,5\n", {.input = "abcd"});
    };
    EXPECT_THAT(said("abxy,wxcd,axyz,p"), HasSubstr("; nearest: 'abxy', 'wxcd'"));
    EXPECT_THAT(said("axyz,wxyd,xxxx,p"), Not(HasSubstr("nearest")));
    EXPECT_THAT(said("my_ABCD_of_today,axxyz,ABCX,p"), HasSubstr("; nearest: 'ABCX', 'my_ABCD_of_today'"));
    EXPECT_THAT(said("abxy,abcx,xbcd,abxd"),
                AllOf(HasSubstr("; nearest: 'abcx', 'xbcd', 'abxd'"), Not(HasSubstr("'abxy'"))));
}

TEST(LogColumns, AReferenceIsHeldToo) {
    Log log = drive::parse_log("time_s,reference,y\n0,1,5\n1,2,6\n1,3,8\n", "l.csv", {.takes_reference = true});
    (void)drive::order_stamps(log);
    EXPECT_THAT(log.reference, ElementsAre(1, 3));
}

TEST(LogColumns, AnOutputThatIsNotNeededIsNought) {
    EXPECT_THAT(drive::parse_log("time_s,input\n0,1\n1,2\n", "l.csv", {.needs_output = false}).output,
                ElementsAre(0, 0));
}

}  // namespace
