// What is told of controllers that were found: each line and field by a made-up answer, each panel of the picture by
// the loop that it draws.
#include "drive/tune/tune_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "drive/tune/tune_picture.hpp"
#include "tests/drive/plants.hpp"

namespace {

using testing::HasSubstr;
using testing::Not;
using tune::Design;
using tune::Tuned;

// Numbers that are told apart, `by` from those of the other controllers.
Design made_up(double by) {
    Design design;
    design.controller.gains = {.kp = 1.5 + by,
                               .ki = 2.5 + by,
                               .kd = 3.5 + by,
                               .filter_s = 0.25,
                               .integral_order = 0.5 + 0.01 * by,
                               .derivative_order = 0.25 + 0.01 * by};
    design.controller.sample_time_s = 0.125;
    design.margins = {.unstable_poles = static_cast<int>(by),
                      .crossings = 1,
                      .crossover = 4.5 + by,
                      .phase_deg = 50.25 + by,
                      .gain = 6.5 + by,
                      .phase_crossover = 7.5 + by,
                      .sensitivity = 1.125 + by,
                      .sensitivity_at = 8.5 + by,
                      .complementary = 1.0625 + by,
                      .phase_slope = -0.5 * (1.0 + by)};
    design.weak_deg = 40.5 + by;
    design.strong_deg = 30.5 + by;
    design.load_iae = 99.0;
    design.tries = 700 + static_cast<std::size_t>(by);
    design.course.setpoint_iae = 8.0;
    design.course.load_iae = 2.0;
    design.course.overshoot = 0.055 + 0.01 * by;
    design.course.limited = by == 1.0;
    return design;
}

Tuned answer() {
    Tuned tuned{plants::fopdt(), {}, {4.0, 1.0, 1.625}, {1.5, 0.75, 32.0}, {}, {}, {}, {}};
    tuned.request.margin_deg = 57.5;
    tuned.request.crossover = 4.0;
    tuned.request.filter_s = 0.25;
    tuned.request.sample_time_s = 0.125;
    tuned.fractional = made_up(0.0);
    tuned.integer = made_up(1.0);
    return tuned;
}

std::string line_of(const std::string& text, const std::string& begin) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("  " + begin)) {
            return line;
        }
    }
    return "no line " + begin;
}

// The name of a row is padded to 44 places, each value to 14.
std::string row(const std::string& name, const std::vector<std::string>& values) {
    std::string line = "  " + name + std::string(44 - name.size(), ' ');
    for (const std::string& value : values) {
        line += std::string(14 - value.size(), ' ') + value;
    }
    return line;
}

TEST(TuneReport, HasARowForEachThingThatIsKnownOfALoop) {
    Tuned tuned = answer();
    const std::vector<std::pair<std::string, std::vector<std::string>>> rows = {
        {"kp", {"1.5", "2.5"}},
        {"ki", {"2.5", "3.5"}},
        {"kd", {"3.5", "4.5"}},
        {"integral order", {"0.5", "0.51"}},
        {"derivative order", {"0.25", "0.26"}},
        {"unstable poles of the loop (by the argument)", {"0", "1"}},
        {"crossover, rad/s", {"4.5", "5.5"}},
        {"phase margin, degrees", {"50.25", "51.25"}},
        {"  with 0.8 of the plant's gain", {"40.5", "41.5"}},
        {"  with 1.25 of it", {"30.5", "31.5"}},
        {"slope of the phase there, degrees an octave", {"-19.9", "-39.7"}},  // half a radian and one, times ln 2
        {"gain margin", {"6.5", "7.5"}},
        {"largest |S|", {"1.125", "2.125"}},
        {"largest |T|", {"1.062", "2.062"}},
        {"IAE of a load of 0.75, 32 s", {"2", "2"}},
        {"IAE of a set point of 1.5, 32 s", {"8", "8"}},
        {"overshoot, %", {"5.5", "6.5"}},
        {"met a limit", {"no", "yes"}},
        {"tries", {"700", "701"}}};
    const std::string text = to_text(tuned, "plant.json");
    EXPECT_THAT(text, testing::StartsWith("plant.json: "));
    EXPECT_THAT(text, HasSubstr("\nwished: a margin of 57.5 degrees at 4 rad/s, |S| at most 1.62\n"));
    EXPECT_THAT(text, HasSubstr("sampled each 0.125 s"));
    EXPECT_THAT(text, HasSubstr("filter 0.25 s"));
    EXPECT_THAT(text, Not(HasSubstr("steep")));
    for (const auto& [name, values] : rows) {
        EXPECT_EQ(line_of(text, name), row(name, values));
    }
    // A controller that was not found has its place, and one for which nobody asked has none.
    tuned.fractional.reset();
    tuned.steep = made_up(2.0);
    tuned.integer->margins.gain = INFINITY;
    const std::string others = to_text(tuned, "plant.json");
    EXPECT_EQ(line_of(others, "kp"), row("kp", {"-", "2.5", "3.5"}));
    EXPECT_EQ(line_of(others, "gain margin"), row("gain margin", {"-", "none", "8.5"}));
    EXPECT_THAT(others, HasSubstr("integer, steep"));
}

TEST(TuneReport, SaysWhatTheFractionBuys) {
    Tuned tuned = answer();
    tuned.integer->course.load_iae = 2.5;
    tuned.integer->course.setpoint_iae = 10.0;
    EXPECT_EQ(conclusion(tuned), "The fraction saves 20.0 % of the load's error (+20.0 % of the set point's).");
    // Worth its memory is 3 %, and what is just that is.
    tuned.integer->course.load_iae = 100.0;
    tuned.fractional->course.load_iae = 97.0;
    EXPECT_THAT(conclusion(tuned), HasSubstr("saves 3.0 %"));
    tuned.fractional->course.load_iae = 97.1;
    tuned.fractional->course.setpoint_iae = 10.5;
    EXPECT_EQ(
        conclusion(tuned),
        "The fraction buys nothing against a load: 2.9 % of its error (-5.0 % of the set point's); below 3 % take "
        "the integer PID (--integer).");
    tuned.fractional->course.load_iae = 100.001;  // nothing, and no -0.0
    EXPECT_THAT(conclusion(tuned), HasSubstr("a load: 0.0 %"));
    // A flat phase is said where it is the fraction's alone.
    tuned.fractional->flat = true;
    tuned.fractional->course.load_iae = 110.0;
    EXPECT_THAT(conclusion(tuned), HasSubstr("The fraction costs 10.0 % of the load's error. It has a flat phase"));
    tuned.fractional->course.load_iae = 50.0;
    EXPECT_THAT(conclusion(tuned), HasSubstr("saves 50.0 %"));
    EXPECT_THAT(conclusion(tuned), HasSubstr("It has a flat phase"));
    tuned.integer->flat = true;
    EXPECT_THAT(conclusion(tuned), Not(HasSubstr("flat phase")));
    tuned.steep = made_up(2.0);
    tuned.steep->course.load_iae = 80.0;
    EXPECT_THAT(conclusion(tuned), HasSubstr("(steep) errs 0.80 times the flat one's."));
    tuned.steep.reset();
    tuned.fractional.reset();
    EXPECT_THAT(conclusion(tuned), HasSubstr("the integer one meets this"));
    tuned.integer.reset();
    EXPECT_THAT(conclusion(tuned), HasSubstr("No integer PID"));
    tuned.request.crossover.reset();
    EXPECT_EQ(wish_text(tuned), "|S| at most 1.62");
}

TEST(TuneReport, ItsFileHasEachNumberUnderItsName) {
    Tuned tuned = answer();
    const auto expect_design = [](const nlohmann::json& json, double by) {
        EXPECT_EQ(json["controller"]["kp"], 1.5 + by);
        EXPECT_EQ(json["controller"]["kind"], "fopid");
        EXPECT_EQ(json["flat_phase"], false);
        EXPECT_EQ(json["phase_margin_deg"], 50.25 + by);
        EXPECT_EQ(json["phase_margin_deg_at_gain_0.8"], 40.5 + by);
        EXPECT_EQ(json["phase_margin_deg_at_gain_1.25"], 30.5 + by);
        EXPECT_EQ(json["crossover_rad_s"], 4.5 + by);
        EXPECT_EQ(json["gain_margin"], 6.5 + by);
        EXPECT_EQ(json["phase_crossover_rad_s"], 7.5 + by);
        EXPECT_EQ(json["sensitivity"], 1.125 + by);
        EXPECT_EQ(json["complementary_sensitivity"], 1.0625 + by);
        EXPECT_EQ(json["load_iae"], 2.0);
        EXPECT_EQ(json["setpoint_iae"], 8.0);
        EXPECT_DOUBLE_EQ(json["overshoot"].get<double>(), 0.055 + 0.01 * by);
        EXPECT_EQ(json["met_a_limit"], by == 1.0);
        EXPECT_EQ(json["tries"], 700 + static_cast<int>(by));
    };
    const std::string text = to_json(tuned, "m.json");
    EXPECT_EQ(text, nlohmann::ordered_json::parse(text).dump(2) + "\n");
    const auto file = nlohmann::json::parse(text);
    EXPECT_EQ(file["schema"], "glsum-tune-1");
    EXPECT_EQ(file["model"], "m.json");
    EXPECT_EQ(file["sample_time_s"], 0.125);
    EXPECT_EQ(file["sensitivity_at_most"], 1.625);
    EXPECT_EQ(file["margin_deg"], 57.5);
    EXPECT_EQ(file["crossover_rad_s"], 4.0);
    EXPECT_EQ(file["setpoint"], 1.5);
    EXPECT_EQ(file["load"], 0.75);
    EXPECT_EQ(file["until_s"], 32.0);
    EXPECT_EQ(file["conclusion"], conclusion(tuned));
    EXPECT_FALSE(file.contains("integer_steep"));
    expect_design(file["fractional"], 0.0);
    expect_design(file["integer"], 1.0);
    tuned.steep = made_up(2.0);
    tuned.request.crossover.reset();
    tuned.integer->margins.gain = INFINITY;  // JSON has none
    const auto other = nlohmann::json::parse(to_json(tuned, "m.json"));
    expect_design(other["integer_steep"], 2.0);
    EXPECT_FALSE(other.contains("margin_deg"));
    EXPECT_FALSE(other["integer"].contains("gain_margin"));
    tuned.fractional.reset();
    tuned.integer.reset();
    tuned.steep.reset();
    const auto none = nlohmann::json::parse(to_json(tuned, "m.json"));
    EXPECT_FALSE(none.contains("fractional") || none.contains("integer") || none.contains("integer_steep"));
}

// The rows of one of the picture's data blocks.
std::vector<std::vector<double>> block_of(const std::string& script, const std::string& name) {
    const std::string begin = "$" + name + " << EOD\n";
    std::istringstream text(script.substr(script.find(begin) + begin.size()));
    std::vector<std::vector<double>> rows;
    for (std::string line; std::getline(text, line) && line != "EOD";) {
        std::istringstream values(line);
        rows.emplace_back();
        for (double value = 0.0; values >> value;) {
            rows.back().push_back(value);
        }
    }
    return rows;
}

TEST(TunePicture, DrawsTheLoopFromAFiftiethOfItsCrossoverToTwentyTimes) {
    Tuned tuned = answer();
    tuned.request.sample_time_s = 0.01;
    for (Design* design : {&*tuned.fractional, &*tuned.integer}) {
        design->controller.gains = {.kp = 0.3, .ki = 0.4, .kd = 0.05, .filter_s = 0.1, .integral_order = 0.5};
        design->course.time_s = {0.0, 1.0, 2.0};
        design->course.output = {0.0, 0.5, 1.0};
        design->course.input = {4.0, 3.0, 2.0};
    }
    tuned.fractional->margins.crossover = 9.0;
    tuned.integer->margins.crossover = 0.5;  // the last that is shown says where the picture is: the fractional
    const std::string script = picture_of(tuned, "plant").script;
    const auto rows = block_of(script, "ffractional");
    ASSERT_EQ(rows.size(), 601U);
    EXPECT_NEAR(rows.front()[0], 9.0 / 50.0, 1e-6);
    EXPECT_NEAR(rows.back()[0], 9.0 * 20.0, 1e-4);
    EXPECT_NEAR(rows[300][0], 9.0 * std::sqrt(20.0 / 50.0), 1e-5);  // even in the logarithm
    const tune::SampledPlant plant(plants::fopdt(), 0.01, "plant");
    const tune::Loop loop{&plant, tuned.fractional->controller.gains};
    double before = -45.0;  // half an integration
    for (const auto& row : rows) {
        const tune::Complex value = loop(row[0]);
        EXPECT_NEAR(row[1] / std::abs(value), 1.0, 1e-4);
        const double turns = (row[2] - std::arg(value) * 180.0 / tune::pi) / 360.0;
        EXPECT_NEAR(turns, std::round(turns), 1e-3) << row[0];
        EXPECT_LT(std::fabs(row[2] - before), 180.0) << row[0];  // followed, without a jump
        before = row[2];
        EXPECT_NEAR(row[3] * std::abs(1.0 + value), 1.0, 1e-4);
    }
    EXPECT_LT(before, -1000.0);  // the dead time's
    EXPECT_EQ(block_of(script, "tinteger"), (std::vector<std::vector<double>>{{0, 0, 4}, {1, 0.5, 3}, {2, 1, 2}}));
    // Up to Nyquist's frequency where that is lower; of a long course at most some 2500 points.
    tuned.fractional->margins.crossover = 100.0;
    tuned.fractional->course.time_s.resize(7600);
    tuned.fractional->course.output.resize(7600);
    tuned.fractional->course.input.resize(7600);
    const std::string long_one = picture_of(tuned, "plant").script;
    EXPECT_NEAR(block_of(long_one, "ffractional").back()[0], 100.0 * tune::pi, 1e-3);
    EXPECT_EQ(block_of(long_one, "tfractional").size(), 2534U);  // each third
}

// Each panel has its column, its limit and its range.
TEST(TunePicture, HasAPanelForEachQuestion) {
    Tuned tuned = answer();
    tuned.steep = made_up(2.0);
    tuned.wish.sensitivity = 1.5;
    const auto picture = picture_of(tuned, "plant");
    EXPECT_EQ(picture.width, 1200U);
    EXPECT_EQ(picture.height, 680U);
    const std::string& script = picture.script;
    EXPECT_THAT(script, HasSubstr("set multiplot layout 2,3"));
    std::size_t at = 0;
    for (const char* words :
         {"set title \"open loop: gain\"\nset logscale y\nset yrange [0.01:100]\nset arrow 1 from first 0.09,1 to "
          "first "
          "25.1327,1 nohead",
          "plot $fsteep using 1:2 with lines lw 2 dt 3 lc rgb \"#009E73\" title \"integer, not flat\"",
          "$finteger using 1:2 with lines lw 2 dt 2 lc rgb \"#D55E00\" title \"integer\"",
          "$ffractional using 1:2 with lines lw 2 lc rgb \"#0072B2\" title \"fractional\"", "degrees\"",
          "set yrange [-360:0]\nset ytics 60\nset arrow 1 from first 0.09,-180 to first 25.1327,-180",
          "plot $fsteep using 1:3", "set title \"|S|\"\nset ytics autofreq\nset yrange [0:1.95]\n",
          "set arrow 1 from first 0.09,1.5 to first 25.1327,1.5", "plot $fsteep using 1:4", "unset arrow 1",
          "set title \"output: set point, then load\"\nplot $tsteep using 1:2",
          "set title \"input\"\nplot $tsteep using 1:3",
          "set title \"output: the load\"\nset xrange [32:51.2]\nplot $tsteep using 1:2", "unset multiplot"}) {
        const std::size_t next = script.find(words, at);
        ASSERT_NE(next, std::string::npos) << words;
        at = next;
    }
    tuned.steep.reset();
    tuned.integer.reset();
    EXPECT_THAT(picture_of(tuned, "plant").script,
                testing::AllOf(Not(HasSubstr("$finteger")), Not(HasSubstr("$fsteep"))));
}

}  // namespace
