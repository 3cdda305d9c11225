// Measured rows beside predicted ones, as they are told and as a file: each field under its name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "qemu/emulate/rows_fit.hpp"

namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct Made {
    std::vector<qemu::MeasuredCall> rows;
    std::vector<qemu::PredictedCall> calls;
    void add(const std::string& function, double cycles, double predicted, double instructions,
             const std::string& group) {
        rows.push_back(
            {"own.elf", function, "core", "itcm", "dtcm", cycles, 2.0, static_cast<unsigned>(rows.size() + 3)});
        rows.back().group = group;
        calls.push_back({predicted, predicted - 4.0, predicted + 6.0, instructions, {}});
    }
};

// Twelve rows, each 1 % farther off than the one before; two groups of an author, and one of another.
Made made() {
    Made made;
    for (int i = 0; i < 12; ++i) {
        const double cycles = 100.0 + 100.0 * i;
        made.add("f", cycles, cycles * (1.0 + 0.01 * i), 50.0 + 60.0 * i, i < 5 ? "a/1" : i < 9 ? "a/2" : "b");
    }
    made.calls[11].lost = {};
    for (std::size_t e = 0; e < 6; ++e) {
        made.calls[11].lost[e] = 1.0 + static_cast<double>(e);
    }
    return made;
}

TEST(RowsReport, ItsFileHasEachFieldOfARow) {
    const Made all = made();
    const qemu::RowsFit fit = qemu::fit_of(all.rows, all.calls);
    const auto json = nlohmann::json::parse(qemu::to_json("m.csv", all.rows, all.calls, fit));
    EXPECT_EQ(json["schema"], "glsum-silicon-rows-1");
    EXPECT_EQ(json["file"], "m.csv");
    ASSERT_EQ(json["rows"].size(), 12U);
    for (std::size_t i = 0; i < 12; ++i) {
        const auto& row = json["rows"][i];
        EXPECT_EQ(row["line"], i + 3);
        EXPECT_EQ(row["elf"], "own.elf");
        EXPECT_EQ(row["function"], "f");
        EXPECT_EQ(row["core"], "core");
        EXPECT_EQ(row["placement"]["code"], "itcm");
        EXPECT_EQ(row["placement"]["data"], "dtcm");
        EXPECT_EQ(row["per"], 2.0);
        EXPECT_EQ(row["measured"], all.rows[i].cycles);
        EXPECT_EQ(row["predicted"], all.calls[i].cycles);
        EXPECT_EQ(row["low"], all.calls[i].low);
        EXPECT_EQ(row["high"], all.calls[i].high);
        EXPECT_EQ(row["instructions"], all.calls[i].instructions);
        EXPECT_NEAR(row["error"].get<double>(), 0.01 * static_cast<double>(i), 1e-12);
        EXPECT_EQ(row["inside_band"], fit.rows[i].inside);
        EXPECT_EQ(row["missed"], fit.rows[i].missed);
        EXPECT_EQ(row["interval_score"], fit.rows[i].interval_score);
        EXPECT_EQ(row["stalls"].size(), timing::effect_count);
    }
    EXPECT_EQ(json["rows"][11]["stalls"][std::string(timing::effect_names[4])], 5.0);
    EXPECT_EQ(json["median_error"], fit.median_error);
    EXPECT_EQ(json["worst_error"], fit.worst_error);
    EXPECT_EQ(json["inside_band"], fit.inside);
    EXPECT_EQ(json["median_half_width"], fit.median_half_width);
    EXPECT_EQ(json["mean_interval_score"], fit.mean_interval_score);
    EXPECT_EQ(json["missed"], fit.missed);
    ASSERT_EQ(json["slopes"].size(), 1U);
    const auto& line = json["slopes"][0];
    EXPECT_EQ(line["function"], "f");
    EXPECT_EQ(line["core"], "core");
    EXPECT_EQ(line["placement"]["code"], "itcm");
    EXPECT_EQ(line["placement"]["data"], "dtcm");
    EXPECT_EQ(line["rows"], 12);
    EXPECT_EQ(line["cycles_per_instruction"]["measured"], fit.lines[0].measured_slope);
    EXPECT_EQ(line["cycles_per_instruction"]["predicted"], fit.lines[0].predicted_slope);
    EXPECT_EQ(line["constant"]["measured"], fit.lines[0].measured_constant);
    EXPECT_EQ(line["constant"]["predicted"], fit.lines[0].predicted_constant);
    ASSERT_EQ(json["left_out"].size(), fit.left_out.size());
    for (std::size_t g = 0; g < fit.left_out.size(); ++g) {
        const auto& group = json["left_out"][g];
        const qemu::GroupLeftOut& one = fit.left_out[g];
        EXPECT_EQ(group["group"], one.group);
        EXPECT_EQ(group["rows"], one.rows);
        EXPECT_EQ(group["author"], one.is_author);
        EXPECT_EQ(group["scale"], one.scale);
        EXPECT_EQ(group["half_width"], one.from_others.half_width);
        EXPECT_EQ(group["inside"], one.from_others.inside);
        EXPECT_EQ(group["interval_score"], one.from_others.interval_score);
        EXPECT_EQ(group["band"]["half_width"], one.as_it_is.half_width);
        EXPECT_EQ(group["band"]["inside"], one.as_it_is.inside);
        EXPECT_EQ(group["band"]["interval_score"], one.as_it_is.interval_score);
    }
}

TEST(RowsReport, TellsTheTenWorstAndTheirFourGreatestLosses) {
    const Made all = made();
    const qemu::RowsFit fit = qemu::fit_of(all.rows, all.calls);
    const std::string text = qemu::to_text("m.csv", all.rows, all.calls, fit);
    EXPECT_THAT(text, ::testing::StartsWith("m.csv: 12 rows\n"));
    std::istringstream lines(text.substr(text.find("the worst rows")));
    std::string line;
    std::getline(lines, line);
    std::vector<std::string> worst;
    while (std::getline(lines, line) && !line.empty()) {
        worst.push_back(line);
    }
    ASSERT_EQ(worst.size(), 10U);
    EXPECT_THAT(worst[0], HasSubstr("   14 f "));  // the last row, of the file's line 14
    EXPECT_THAT(worst[0], HasSubstr("+11.0%"));
    EXPECT_THAT(worst[9], HasSubstr("+2.0%"));
    std::string losses;
    for (int e = 5; e > 1; --e) {
        losses += std::string(losses.empty() ? "" : ", ") +
                  std::string(timing::effect_names[static_cast<std::size_t>(e)]) + ' ' + std::to_string(e + 1);
    }
    EXPECT_TRUE(worst[0].ends_with("  " + losses)) << worst[0];
    // A row on its own: how it lies to its band, and whether it is missed.
    EXPECT_THAT(text, HasSubstr("        300        306            302 to 312    +2.0%  outside\n"));
    EXPECT_THAT(text, HasSubstr("        100        100             96 to 106    +0.0%\n"));
    EXPECT_THAT(text, HasSubstr("of 12 rows within 5 % or 8 cycles"));
    EXPECT_THAT(text, HasSubstr("\nf itcm dtcm "));
}

// Losses that are alike come in the order of the effects, everywhere and in every run; what lost nothing is not named.
TEST(RowsReport, LossesAsGreatAsOneAnotherKeepTheirOrder) {
    Made all = made();
    std::string losses;
    for (qemu::PredictedCall& call : all.calls) {
        call.lost.fill(0.0);
        call.lost[1] = 1.0;
        call.lost[3] = call.lost[6] = 7.0;
    }
    for (const std::size_t e : {3U, 6U}) {
        losses += std::string(timing::effect_names[e]) + " 7, ";
    }
    const std::string text = qemu::to_text("m.csv", all.rows, all.calls, qemu::fit_of(all.rows, all.calls));
    EXPECT_THAT(text, HasSubstr("  " + losses + std::string(timing::effect_names[1]) + " 1\n"));
}

// Over all groups as many rows count as they have: of 12, and by authors of 12 again.
TEST(RowsReport, MeansCountEachRowOnce) {
    const Made all = made();
    qemu::RowsFit fit = qemu::fit_of(all.rows, all.calls);
    const auto group = [](const char* name, bool author, std::size_t rows, double half_width) {
        return qemu::GroupLeftOut{name, author, rows, {half_width, 0.5, 0.25}, 1.5, {2.0 * half_width, 0.75, 0.125}};
    };
    fit.left_out = {group("a/1", false, 3, 0.01), group("a/2", false, 1, 0.05), group("b", false, 4, 0.02),
                    group("a", true, 6, 0.04)};
    const std::string text = qemu::to_text("m.csv", all.rows, all.calls, fit);
    EXPECT_THAT(text,
                HasSubstr("\na/1                              3       1.0%    50.0%   25.0%    1.50       2.0%    "
                          "75.0%   12.5%\n"));
    // 3 of 1 %, 1 of 5 %, 4 of 2 %: 2 % in the mean.
    EXPECT_THAT(text,
                HasSubstr("\nall, each unseen                 8       2.0%    50.0%   25.0%               4.0%    "
                          "75.0%   12.5%\na/                               6       4.0%"));
    EXPECT_THAT(text, HasSubstr("\nall, by authors                  6       4.0%    50.0%   25.0%               8.0%"));
    fit.left_out.pop_back();
    EXPECT_THAT(qemu::to_text("m.csv", all.rows, all.calls, fit),
                testing::AllOf(HasSubstr("\nall, each unseen                 8"), Not(HasSubstr("by authors"))));
    fit.left_out.clear();
    EXPECT_THAT(qemu::to_text("m.csv", all.rows, all.calls, fit), Not(HasSubstr("left out")));
}

// Shares are told in per cent.
TEST(RowsReport, EndsWithTheWholeFit) {
    const Made all = made();
    qemu::RowsFit fit = qemu::fit_of(all.rows, all.calls);
    fit.median_error = 0.125;
    fit.worst_error = -0.5;
    fit.missed = 3;
    fit.inside = 0.75;
    fit.median_half_width = 0.25;
    fit.mean_interval_score = 0.875;
    EXPECT_THAT(qemu::to_text("m.csv", all.rows, all.calls, fit),
                testing::EndsWith("\nmedian error 12.50 %, worst -50.0 %; 9 of 12 rows within 5 % or 8 cycles\n"
                                  "75.0 % of the rows inside the band; its median half-width 25.0 %, mean interval "
                                  "score 87.5 %\n"));
}

// A row may miss by 5 % or 8 cycles, whichever is more; a line needs calls that differ by a quarter.
TEST(RowsFit, AllowsWhatItsPageSays) {
    EXPECT_FALSE(qemu::misses(1049.9, 1000.0));
    EXPECT_TRUE(qemu::misses(1050.1, 1000.0));
    EXPECT_FALSE(qemu::misses(950.1, 1000.0));
    EXPECT_TRUE(qemu::misses(949.9, 1000.0));
    EXPECT_FALSE(qemu::misses(17.99, 10.0));
    EXPECT_TRUE(qemu::misses(18.01, 10.0));
    const auto lines_with = [](double instructions) {
        Made two;
        two.add("f", 100.0, 100.0, 100.0, "");
        two.add("f", 120.0, 120.0, instructions, "");
        return qemu::fit_of(two.rows, two.calls).lines.size();
    };
    EXPECT_EQ(lines_with(125.0), 1U);
    EXPECT_EQ(lines_with(124.9), 0U);
}

}  // namespace
