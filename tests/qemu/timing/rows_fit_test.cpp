// Measured rows of any program: how they are read, and what is said of how well they are met.
#include "qemu/emulate/rows_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

qemu::MeasuredCall measured(const std::string& function, double cycles, double per = 1.0) {
    return {"own.elf", function, "core", "itcm", "dtcm", cycles, per, 1};
}
qemu::PredictedCall predicted(double cycles, double low, double high, double instructions = 10.0) {
    return {cycles, low, high, instructions, {}};
}

TEST(MeasuredCalls, PathsCountFromTheFilesFolderAndEmptyPlacesAreTheCores) {
    const auto rows = qemu::parse_measured_calls(
        "# note\nper,measured,data,code,core,function,elf,group\n2,31.5,,flash_cached,c,f(int),sub/a.elf,mine\n"
        "1,7,axi,,c,g,/b.elf,\n",
        "m.csv", "folder");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].elf, "folder/sub/a.elf");
    EXPECT_EQ(rows[0].function, "f(int)");
    EXPECT_EQ(rows[0].code, "flash");
    EXPECT_EQ(rows[0].data, "");
    EXPECT_EQ(rows[0].cycles, 31.5);
    EXPECT_EQ(rows[0].per, 2.0);
    EXPECT_EQ(rows[0].group, "mine");
    EXPECT_EQ(rows[1].elf, "/b.elf");
    EXPECT_EQ(rows[1].line, 4U);
}

TEST(MeasuredCalls, NumbersAreFromAMillionthToATrillion) {
    const auto read = [](const std::string& measured, const std::string& per) {
        return qemu::parse_measured_calls(
                   "elf,function,core,code,data,measured,per\na,f,c,,," + measured + "," + per + "\n", "m.csv",
                   "folder")
            .front();
    };
    EXPECT_EQ(read("1e-6", "1e12").cycles, 1e-6);
    EXPECT_EQ(read("1e12", "1e-6").per, 1e-6);
    for (const char* beyond : {"0.999e-6", "1.001e12"}) {
        EXPECT_THROW((void)read(beyond, "1"), glsum::Failure);
        EXPECT_THROW((void)read("1", beyond), glsum::Failure);
    }
}

TEST(MeasuredCalls, AreToldFromRowsOfKernelsByTheirHeader) {
    EXPECT_TRUE(qemu::names_programs("# elf\n\nfunction, elf ,core\na,b,c\n"));
    EXPECT_FALSE(qemu::names_programs("# elf\nkernel,code\nelf,elf\n"));
    EXPECT_FALSE(qemu::names_programs(""));
}

TEST(RowsFit, ErrorsCoverageWidthAndScore) {
    // Errors +10 %, 0, -20 % and +2 %; half-widths 5, 10, 12.5 and 4.9 %; the third lies outside by 10.
    const std::vector<qemu::MeasuredCall> rows{measured("a", 100), measured("b", 200), measured("c", 100),
                                               measured("d", 50)};
    const std::vector<qemu::PredictedCall> calls{predicted(110, 100, 111), predicted(200, 180, 220),
                                                 predicted(80, 70, 90), predicted(51, 49, 54)};
    const qemu::RowsFit fit = qemu::fit_of(rows, calls);
    EXPECT_NEAR(fit.median_error, 0.06, 1e-12);
    EXPECT_NEAR(fit.worst_error, -0.2, 1e-12);
    EXPECT_THAT(fit.worst, ElementsAre(2, 0, 3, 1));
    EXPECT_NEAR(fit.inside, 0.75, 1e-12);
    EXPECT_NEAR(fit.median_half_width, (5.5 / 110 + 0.1) / 2, 1e-12);
    // Widths 11, 40, 20, 5, and 40 times the 10 cycles outside.
    EXPECT_NEAR(fit.mean_interval_score, (0.11 + 0.2 + 0.2 + 40 * 0.1 + 0.1) / 4, 1e-12);
    EXPECT_EQ(fit.missed, 2U);
    EXPECT_TRUE(fit.rows[0].inside);  // on its edge
    EXPECT_FALSE(fit.rows[2].inside);
    EXPECT_FALSE(fit.rows[3].missed);
    EXPECT_TRUE(fit.lines.empty());
}

TEST(RowsFit, RowsThatErrAlikeKeepTheirOrder) {
    const auto call = predicted(125, 120, 130);
    const qemu::RowsFit fit = qemu::fit_of(
        {measured("a", 100), measured("b", 125), measured("c", 100), measured("d", 100), measured("e", 125)},
        {call, call, call, call, call});
    EXPECT_THAT(fit.worst, ElementsAre(0, 2, 3, 1, 4));
}

TEST(RowsFit, ARowIsMissedByCyclesOfACallNotOfItsParts) {
    const qemu::RowsFit fit =
        qemu::fit_of({measured("a", 10, 1000), measured("b", 10), measured("c", 10, 1000), measured("d", 10, 10)},
                     {predicted(11, 9, 12), predicted(17.9, 9, 18), predicted(10.4, 9, 12), predicted(10.7, 9, 12)});
    EXPECT_TRUE(fit.rows[0].missed);   // 1000 cycles
    EXPECT_FALSE(fit.rows[1].missed);  // 7.9 cycles
    EXPECT_FALSE(fit.rows[2].missed);  // 400 cycles, of 10000
    EXPECT_FALSE(fit.rows[3].missed);  // 7 cycles, of 100
}

TEST(RowsFit, ALineThroughCallsOfDifferentLength) {
    // Measured 0.8 cycles an instruction and 6, predicted 0.7 and 5, of which one row is told by a tenth.
    const qemu::RowsFit fit = qemu::fit_of(
        {measured("a", 14), measured("a", 22), measured("a", 3, 10), measured("b", 9)},
        {predicted(12, 0, 99, 10), predicted(19, 0, 99, 20), predicted(2.6, 0, 99, 3), predicted(9, 8, 10)});
    ASSERT_EQ(fit.lines.size(), 1U);
    EXPECT_EQ(fit.lines[0].function, "a");
    EXPECT_EQ(fit.lines[0].rows, 3U);
    EXPECT_NEAR(fit.lines[0].measured_slope, 0.8, 1e-9);
    EXPECT_NEAR(fit.lines[0].predicted_slope, 0.7, 1e-9);
    EXPECT_NEAR(fit.lines[0].measured_constant, 6.0, 1e-9);
    EXPECT_NEAR(fit.lines[0].predicted_constant, 5.0, 1e-9);
}

// Each group is judged by the band, and by one that is scaled to hold 95 % of the others' rows; so is each author.
class RowsLeftOut : public testing::Test {
protected:
    std::vector<qemu::MeasuredCall> rows;
    std::vector<qemu::PredictedCall> calls;
    void add(const std::string& group, double cycles, double low = 99, double high = 101) {
        rows.push_back(measured("f", cycles));
        rows.back().group = group;
        calls.push_back(predicted(100, low, high));
    }
    void SetUp() override {
        for (int row = 1; row <= 20; ++row) {
            add("a/1", 100 + 0.1 * row);  // 0.1 to 2 widths of the band
        }
        add("b", 101);
        add("b", 104);
    }
};

TEST_F(RowsLeftOut, BandsAreAsWideAsTheOthersAsk) {
    const auto left_out = qemu::fit_of(rows, calls).left_out;
    ASSERT_EQ(left_out.size(), 2U);
    EXPECT_EQ(left_out[0].group, "a/1");
    EXPECT_NEAR(left_out[0].scale, 4.0, 1e-12);  // of two rows the greater
    EXPECT_NEAR(left_out[0].from_others.half_width, 0.04, 1e-12);
    EXPECT_NEAR(left_out[0].from_others.inside, 1.0, 1e-12);
    EXPECT_NEAR(left_out[0].as_it_is.half_width, 0.01, 1e-12);
    EXPECT_NEAR(left_out[0].as_it_is.inside, 0.5, 1e-12);
    EXPECT_EQ(left_out[1].rows, 2U);
    EXPECT_NEAR(left_out[1].scale, 2.0, 1e-12);  // 0.95 of 21: the twentieth
    EXPECT_NEAR(left_out[1].from_others.inside, 0.5, 1e-12);
    EXPECT_NEAR(left_out[1].from_others.interval_score, (4.0 / 101 + (4.0 + 40 * 2.0) / 104) / 2, 1e-12);
    const std::string text = qemu::to_text("m.csv", rows, calls, qemu::fit_of(rows, calls));
    EXPECT_THAT(text,
                HasSubstr("\nb                                2       1.0%    50.0%   59.6%    2.00       2.0%    "
                          "50.0%   42.4%\n"));
    EXPECT_THAT(text, HasSubstr("\nall, each unseen                22"));
    for (qemu::MeasuredCall& row : rows) {
        row.group = "one";
    }
    EXPECT_TRUE(qemu::fit_of(rows, calls).left_out.empty());
}

// A row far off counts by the side of the band that it lies on: a wide band is no narrow one missed.
TEST_F(RowsLeftOut, RowsCountByTheirOwnBand) {
    add("c", 110, 99, 120);
    add("c", 80, 90, 101);
    const auto left_out = qemu::fit_of(rows, calls).left_out;
    ASSERT_EQ(left_out.size(), 3U);
    EXPECT_NEAR(left_out[0].scale, 4.0, 1e-12);               // half a width and two of them: 104 is the farthest
    EXPECT_NEAR(left_out[2].from_others.inside, 1.0, 1e-12);  // 96 to 180, and 60 to 104
    EXPECT_NEAR(left_out[2].as_it_is.inside, 0.5, 1e-12);
}

// A band of no width counts as a millionth of its figure: a cycle off of a hundred is ten thousand of them.
TEST(RowsFit, AFigureWithoutABandIsFarOffByItsOwnMillionth) {
    std::vector<qemu::MeasuredCall> rows{measured("f", 101), measured("f", 100)};
    rows[0].group = "a";
    rows[1].group = "b";
    const auto left_out = qemu::fit_of(rows, {predicted(100, 100, 100), predicted(100, 99, 101)}).left_out;
    ASSERT_EQ(left_out.size(), 2U);
    EXPECT_EQ(left_out[0].scale, 0.0);  // the other is met exactly
    EXPECT_NEAR(left_out[1].scale, 1e4, 1.0);
}

TEST_F(RowsLeftOut, AnAuthorsGroupsGoTogether) {
    add("a/2", 103);
    const auto left_out = qemu::fit_of(rows, calls).left_out;
    ASSERT_EQ(left_out.size(), 4U);
    EXPECT_NEAR(left_out[0].scale, 4.0, 1e-12);  // a/2 is seen, and b
    EXPECT_EQ(left_out[3].group, "a");
    EXPECT_TRUE(left_out[3].is_author);
    EXPECT_EQ(left_out[3].rows, 21U);
    EXPECT_NEAR(left_out[3].scale, 4.0, 1e-12);
    EXPECT_EQ(left_out[1].group, "a/2");
    EXPECT_NEAR(left_out[1].scale, 4.0, 1e-12);  // 0.95 of 23: the last of 22
    EXPECT_THAT(qemu::to_text("m.csv", rows, calls, qemu::fit_of(rows, calls)),
                testing::AllOf(HasSubstr("\na/                              21"), HasSubstr("\nall, by authors")));
}

TEST(RowsFit, SaysWhereTheWorstRowsLostTheirCycles) {
    std::vector<qemu::PredictedCall> calls{predicted(100, 90, 110), predicted(150, 140, 160)};
    calls[1].lost[timing::index(timing::Effect::load_use)] = 12.0;
    calls[1].lost[timing::index(timing::Effect::branch_mispredict)] = 30.5;
    const std::vector<qemu::MeasuredCall> rows{measured("near", 100), measured("far", 100)};
    const qemu::RowsFit fit = qemu::fit_of(rows, calls);
    const std::string text = qemu::to_text("m.csv", rows, calls, fit);
    EXPECT_THAT(text, HasSubstr("branch_mispredict 30.5, load_use 12"));
    const auto json = nlohmann::json::parse(qemu::to_json("m.csv", rows, calls, fit));
    EXPECT_EQ(json["rows"][1]["stalls"]["branch_mispredict"], 30.5);
    EXPECT_EQ(json["rows"][1]["inside_band"], false);
    EXPECT_EQ(json["missed"], 1);
    EXPECT_EQ(json["inside_band"], 0.5);
}

}  // namespace
