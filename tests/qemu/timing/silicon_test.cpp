// The reading of measured files, and the line through them.
#include "qemu/emulate/silicon.hpp"

#include <gtest/gtest.h>

#include <string>

#include "base/failure.hpp"
#include "qemu/emulate/silicon_loops.hpp"

namespace {

std::string message_of(const std::string& text) {
    try {
        (void)qemu::parse_measured_cycles(text, "m.csv");
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        return failure.what();
    }
    return "";
}

constexpr const char* header = "# measured by hand\nkernel,code,data,maintenance,taps,cycles,board\n";

TEST(MeasuredCycles, ReadsRowsCommentsAndFurtherColumns) {
    std::string text = header;
    text += "a_b_f32,flash_cached,dtcm,0,5,59.5,mine\n\na_b_f32,itcm,axi,1,100,914,mine\n";
    const auto rows = qemu::parse_measured_cycles(text, "m.csv");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].kernel, "a_b_f32");
    EXPECT_EQ(rows[0].cycles, 59.5);
    EXPECT_FALSE(rows[0].maintenance);
    EXPECT_TRUE(rows[1].maintenance);
    EXPECT_EQ(rows[1].data, "axi");
    EXPECT_EQ(rows[1].taps, 100U);
    EXPECT_EQ(rows[1].line, 5U);
}

TEST(MeasuredCycles, AreReadAsTheyAreWritten) {
    const std::vector<qemu::MeasuredCycles> rows{{"a_b_f32", "itcm", "axi", true, 100, 914.25, 0},
                                                 {"c", "flash_cached", "dtcm", false, 5, 60.0, 0}};
    const std::string text = qemu::to_csv(rows);
    EXPECT_EQ(text,
              "kernel,code,data,maintenance,taps,cycles\na_b_f32,itcm,axi,1,100,914.25\nc,flash_cached,dtcm,0,5,60\n");
    const auto read = qemu::parse_measured_cycles(text, "m.csv");
    ASSERT_EQ(read.size(), 2U);
    EXPECT_EQ(read[0].kernel, "a_b_f32");
    EXPECT_TRUE(read[0].maintenance);
    EXPECT_EQ(read[0].cycles, 914.25);
    EXPECT_EQ(read[1].code, "flash_cached");
    EXPECT_EQ(read[1].taps, 5U);
}

TEST(SiliconLoops, RivalsAreAmongThem) {
    EXPECT_EQ(qemu::rival_loops().size(), 8U);
    for (const qemu::SiliconLoop& rival : qemu::rival_loops()) {
        ASSERT_NE(qemu::find_loop(rival.name), nullptr) << rival.name;
        EXPECT_EQ(qemu::find_loop(rival.name)->most_taps, 1000U);
    }
    EXPECT_EQ(qemu::find_loop("shift_fir_q31")->most_taps, 128U);
    EXPECT_EQ(qemu::find_loop("ring_plain_f32"), nullptr);
}

// What is said of a file whose only row is this one.
std::string message_of_row(const std::string& row) {
    std::string text = header;
    text += row;
    text += '\n';
    return message_of(text);
}

TEST(MeasuredCycles, SaysFileLineExpectedAndFound) {
    EXPECT_NE(message_of_row("a,flash_cached,dtcm,0,5").find("m.csv:3: expected 7 cells, found 5"), std::string::npos);
    EXPECT_NE(message_of_row("a,ram,dtcm,0,5,59,x").find("m.csv:3: code: expected"), std::string::npos);
    EXPECT_NE(message_of_row("a,itcm,dtcm,2,5,59,x").find("maintenance"), std::string::npos);
    EXPECT_NE(message_of_row("a,itcm,dtcm,0,0,59,x").find("taps"), std::string::npos);
    for (const char* row : {"a,itcm,dtcm,0,5,nan,x", "a,itcm,dtcm,0,5,-4,x", "a,itcm,dtcm,0,5,,x",
                            "a,itcm,dtcm,0,5,1e,x", "a,itcm,dtcm,0,5,inf,x"}) {
        EXPECT_NE(message_of_row(row).find("m.csv:3: cycles"), std::string::npos) << row;
    }
    EXPECT_NE(message_of("kernel,code,data,taps,cycles\n").find("m.csv:1: expected the column maintenance"),
              std::string::npos);
    EXPECT_NE(message_of(header).find("found none"), std::string::npos);
    EXPECT_NE(message_of("kernel,code,data,maintenance,taps,cycles,taps\n").find("m.csv:1: expected each column once"),
              std::string::npos);
    EXPECT_NE(message_of(std::string(100, ',')).find("m.csv:1: expected at most 100 columns, found 101"),
              std::string::npos);
    std::string long_file = header;
    for (std::size_t i = 0; i <= qemu::MeasuredLimits::rows; ++i) {
        long_file += "a,itcm,dtcm,0,5,59,x\n";
    }
    EXPECT_NE(message_of(long_file).find("m.csv:100003: expected at most 100000 rows"), std::string::npos);
}

TEST(MeasuredCycles, AtTheirBoundsRowsAreRead) {
    EXPECT_EQ(message_of_row("a,itcm,dtcm,0,1,1,x"), "");
    EXPECT_EQ(message_of_row("a,itcm,dtcm,0,1000000,1000000000000,x"), "");
    EXPECT_NE(message_of_row("a,itcm,dtcm,0,1000001,59,x").find("m.csv:3: taps"), std::string::npos);
    EXPECT_NE(message_of_row("a,itcm,dtcm,0,5,0.99,x").find("m.csv:3: cycles"), std::string::npos);
    EXPECT_NE(message_of_row("a,itcm,dtcm,0,5,1000000000001,x").find("m.csv:3: cycles"), std::string::npos);
    const std::string counted = "kernel,code,data,maintenance,taps,cycles,instructions\na,itcm,dtcm,0,5,59,";
    EXPECT_EQ(qemu::parse_measured_cycles(counted + "1000000000000\n", "m.csv").at(0).instructions, 1e12);
    EXPECT_NE(message_of(counted + "1000000000001\n").find("m.csv:2: instructions"), std::string::npos);
    EXPECT_NE(message_of(counted + "0.5\n").find("m.csv:2: instructions"), std::string::npos);
    EXPECT_EQ(message_of(std::string("kernel,code,data,maintenance,taps,cycles") +
                         [] {
                             std::string more;
                             for (int i = 0; i < 94; ++i) {  // a hundred columns
                                 more += ",c" + std::to_string(i);
                             }
                             return more;
                         }() +
                         "\n"),
              "m.csv: expected rows of measured cycles, found none");
    std::string long_file = header;
    for (std::size_t i = 0; i < qemu::MeasuredLimits::rows; ++i) {
        long_file += "a,itcm,dtcm,0,5,59,x\n";
    }
    EXPECT_EQ(qemu::parse_measured_cycles(long_file, "m.csv").size(), 100000U);
}

TEST(MeasuredCycles, TheLineGoesThroughPointsThatLieOnOne) {
    const qemu::FittedLine line = qemu::fit_line({5, 10, 128}, {59, 104, 1166});
    EXPECT_NEAR(line.slope, 9.0, 1e-12);
    EXPECT_NEAR(line.constant, 14.0, 1e-9);
}

}  // namespace
