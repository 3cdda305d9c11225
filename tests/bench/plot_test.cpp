// Pictures as gnuplot is told to draw them: a script in its place keeps what it is sent. Points, lines and keys are
// held against the rows; where things lie in the picture is for people to look at.
#include "bench/report/plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "base/gnuplot.hpp"
#include "bench/report/curves.hpp"
#include "bench/report/plot_message.hpp"
#include "bench/studies/equal_cost.hpp"
#include "tests/bench/pretend_gnuplot.hpp"
#include "tests/count_of.hpp"
#include "tests/refusal.hpp"

namespace {

using bench::Entry;
using bench::Group;
using test::count_of;
using testing::HasSubstr;
using testing::Not;

class Drawing : public PretendGnuplot {};

TEST_F(Drawing, IsMadeTwiceAndPublishedWhole) {
    base::draw({"plot sin(x)", 321, 123}, stem());
    std::ifstream in(folder_ / "sent");
    const std::string all{std::istreambuf_iterator<char>(in), {}};
    EXPECT_THAT(all, HasSubstr("set terminal svg size 321,123 "));
    EXPECT_THAT(all, HasSubstr("set terminal pngcairo size 321,123 font \"DejaVu Sans,9\""));
    EXPECT_EQ(count_of(all, "plot sin(x)\nunset output\n"), 2U);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "picture.svg"));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "picture.png"));
    // Nothing is left beside them.
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 4);
    base::draw({"plot sin(x)"}, folder_ / "it's one");
    EXPECT_TRUE(std::filesystem::exists(folder_ / "it's one.svg"));
}

TEST_F(Drawing, AGnuplotThatFailsOrDrawsNothingIsAnError) {
    const auto status = [&] {
        try {
            base::draw({"plot sin(x)"}, stem());
        } catch (const glsum::Failure& failure) {
            return failure.status();
        }
        return glsum::Exit::good;
    };
    pretend("cat >/dev/null; exit 1");
    EXPECT_EQ(status(), glsum::Exit::missing);
    pretend("cat >/dev/null");
    EXPECT_EQ(status(), glsum::Exit::check_failed);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "picture.svg"));
}

// A script that is longer than what a pipe holds, and nobody to read it: an error, and no end by a signal.
TEST_F(Drawing, AGnuplotThatDoesNotReadIsAnError) {
    pretend("exit 0");
    EXPECT_EQ(test::refusal(glsum::Exit::missing, [&] { base::draw({std::string(1 << 20, '#')}, stem()); }),
              (folder_ / "picture.svg").string() + ": gnuplot failed (Debian package gnuplot-nox)");
}

TEST_F(Drawing, OfNoSizeIsTwiceAsWideAsHigh) {
    base::draw({"plot sin(x)"}, stem());
    EXPECT_THAT(sent(), HasSubstr("set terminal svg size 1200,600 "));
}

TEST(Gnuplot, SeesNoTextThatCouldEndAStringAndLeavesRoomAroundValues) {
    EXPECT_EQ(base::gnuplot_text("a_B 9.:+-,/()"), "a_B 9.:+-,/()");
    EXPECT_EQ(base::gnuplot_text("\"`$\\'\n;ä"), "?????????");
    EXPECT_EQ(base::gnuplot_text(std::string(70, 'x')), std::string(60, 'x'));
    double low = 0.0;
    double high = 0.0;
    ASSERT_EQ(std::sscanf(base::log_range(1e-6, 1e-2).c_str(), "[%lf:%lf]", &low, &high), 2);
    EXPECT_LT(low, 1e-6);
    EXPECT_GT(low, 1e-7);
    EXPECT_GT(high, 1e-2);
    EXPECT_LT(high, 1e-1);
}

Entry entry(const char* kernel, std::optional<double> error, std::optional<double> rounding, double truncation) {
    Entry made;
    made.kernel = kernel;
    made.error_max = error;
    made.rounding_error_max = rounding;
    made.truncation_error_max = truncation;
    return made;
}

std::vector<Group> groups() {
    return {{"0.5", "50", {entry("a_f32", 0.25, 1e-7, 0.125), entry("b_q15", 0.5, 1e-3, 0.125)}},
            {"0.5", "2+7", {entry("c_f64", 1e-3, 1e-15, 1e-3)}},
            {"0.5", "full", {entry("a_f32", 1e-6, 1e-6, 0.0), entry("unmeasured", {}, {}, 0.0)}},
            {"0.9", "50", {entry("a_f32", 0.75, {}, 0.0625)}}};
}

// The panels of a page and the room between them lie on it, left before right and the lower before the upper.
void expect_on_the_page(const std::string& text) {
    int rows = 0;
    int columns = 0;
    double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0, beside = 0.0, above = 0.0;
    const std::size_t at = text.find("set multiplot layout");
    ASSERT_NE(at, std::string::npos);
    ASSERT_EQ(std::sscanf(text.c_str() + at, "set multiplot layout %d,%d margins %lf,%lf,%lf,%lf spacing %lf,%lf",
                          &rows, &columns, &left, &right, &bottom, &top, &beside, &above),
              8);
    EXPECT_GT(left, 0.0);
    EXPECT_LT(right, 1.0);
    EXPECT_GT(bottom, 0.0);
    EXPECT_LT(top, 1.0);
    EXPECT_GT(beside, 0.0);
    EXPECT_GT(above, 0.0);
    EXPECT_GT(right - left, 2.0 * beside * (columns - 1)) << text.substr(at, 120);
    EXPECT_GT(top - bottom, 2.0 * above * (rows - 1)) << text.substr(at, 120);
}

TEST_F(Drawing, OfErrorsHasAPanelForEachOrderAndKind) {
    bench::plot_error(groups(), {{"0.5", {{"50", 0.375}}}}, stem());
    const std::string text = sent();
    EXPECT_THAT(text, HasSubstr("set multiplot layout 2,2 "));
    expect_on_the_page(text);
    // Kernels in the order of their appearance, then the truncation of windows, then its bound. The full memory lies
    // behind the longest length, under its name.
    EXPECT_THAT(text, HasSubstr("$d0 << EOD\n50 2.500000e-01\n85 1.000000e-06\nEOD\n$d1 << EOD\n50 5.000000e-01\nEOD\n"
                                "$d2 << EOD\n9 1.000000e-03\nEOD\n$d3 << EOD\n50 1.250000e-01\nEOD\n"
                                "$d4 << EOD\n50 3.750000e-01\nEOD\nset title \"order 0.5: total error\""));
    EXPECT_THAT(text, HasSubstr("$d0 << EOD\n50 1.000000e-07\n85 1.000000e-06\nEOD\n$d1 << EOD\n50 1.000000e-03\nEOD\n"
                                "$d2 << EOD\n9 1.000000e-15\nEOD\nset title \"order 0.5: rounding error\""));
    EXPECT_THAT(text, HasSubstr("$d0 << EOD\n50 7.500000e-01\nEOD\n$d3 << EOD\n50 6.250000e-02\nEOD\nset title \"order "
                                "0.9: total error\""));
    // Nothing is known of its rounding: the place stays empty.
    EXPECT_THAT(text, Not(HasSubstr("order 0.9: rounding error")));
    EXPECT_EQ(count_of(text, "set multiplot next\n"), 1U);
    EXPECT_THAT(text, Not(HasSubstr("unmeasured")));
    // One key, in the first panel; the two lines of truncation are black, without points, and told apart.
    EXPECT_EQ(count_of(text, "set key at"), 1U);
    EXPECT_LT(text.find("set key at"), text.find("unset key"));
    EXPECT_THAT(text, HasSubstr("with lines lw 1.5 dt 2 lc rgb \"#000000\" title \"truncation alone\""));
    EXPECT_THAT(text, HasSubstr("with lines lw 1.5 dt 4 lc rgb \"#000000\" title \"truncation bound\""));
    for (const auto& [kernel, i] : {std::pair("a_f32", 0), std::pair("b_q15", 1), std::pair("c_f64", 2)}) {
        EXPECT_THAT(text, HasSubstr("dt 1 pt " + std::to_string(4 + i) + " ps 0.6 lc rgb \"" + base::palette[i] +
                                    "\" title \"" + kernel + "\""));
    }
    EXPECT_THAT(text, HasSubstr("set yrange " + base::log_range(1e-6, 0.5)));
    EXPECT_THAT(text, HasSubstr("set yrange " + base::log_range(1e-15, 1e-3)));
    // Marks: windows first, then what has room.
    EXPECT_THAT(text, HasSubstr("set xtics (\"50\" 50, \"full\" 85, \"2+7\" 9)"));
    EXPECT_THAT(text, HasSubstr("set xrange [7.2:106.25]"));
    EXPECT_THAT(
        text,
        HasSubstr("title \"The best window of 50 taps forgets 0.062 to 0.12 of the largest sum, by the order; the best "
                  "of at most 9 taps and modes errs by 0.001 to 0.001\\nGrünwald-Letnikov sum"));
    bench::plot_error(groups(), {}, stem());
    EXPECT_THAT(sent(), Not(HasSubstr("truncation bound")));
}

// Of an order the best counts, of orders the range; designs no shorter than a window, and faults, do not.
TEST(PlotMessage, SaysWhatTheLongestWindowForgetsAndShortDesignsLeave) {
    Entry wrong = entry("w_f32", 1e-12, {}, 0.0);
    wrong.fault = "wrong";
    EXPECT_EQ(
        bench::plot_message({{"0.5", "50", {entry("a_f32", 0.5, {}, 0.5)}},
                             {"0.5", "600", {entry("a_f32", 0.25, {}, 0.25), entry("b_f32", 0.1, {}, 0.1)}},
                             {"0.9", "600", {entry("a_f32", 0.02, {}, 0.02)}},
                             {"0.9", "full", {entry("a_f32", 1e-15, {}, 1e-15)}},
                             {"0.5", "2+7", {entry("c_f32", 1e-3, {}, 0.0), entry("d_f32", 1e-4, {}, 0.0), wrong}},
                             {"0.9", "2+9", {entry("c_f32", 1e-5, {}, 0.0)}},
                             {"0.9", "20+30", {entry("c_f32", 1e-9, {}, 0.0)}}}),
        "The best window of 600 taps forgets 0.02 to 0.1 of the largest sum, by the order; the best of at most 11 "
        "taps and modes errs by 1e-05 to 0.0001\\n");
}

// "full" does not tell how long it is, and what is no length is neither long nor short.
TEST(PlotMessage, IsOfLengthsThatAreNumbers) {
    const Group window{"0.5", "50", {entry("a_f32", 0.5, {}, 0.5)}};
    const Group full{"0.5", "full", {entry("a_f32", 0.5, {}, 0.5)}};
    const Group design{"0.5", "2+7", {entry("c_f32", 1e-3, {}, 0.0)}};
    EXPECT_NE(bench::plot_message({window, full, design}), "");
    EXPECT_EQ(bench::plot_message({full, design}), "");
    for (const char* taps : {"5+", "+", "2+many", "2+99999999999"}) {
        EXPECT_EQ(bench::plot_message({window, {"0.5", taps, {entry("c_f32", 1e-3, {}, 0.0)}}}), "") << taps;
    }
}

// One that was only timed is not among the best.
TEST(PlotMessage, IsOfDesignsWhoseErrorIsKnown) {
    EXPECT_THAT(bench::plot_message({{"0.5", "50", {entry("a_f32", 0.5, {}, 0.5)}},
                                     {"0.5", "2+7", {entry("c_f32", 1e-3, {}, 0.0)}},
                                     {"0.5", "2+30", {entry("d_f32", {}, {}, 0.0)}}}),
                HasSubstr("the best of at most 9 taps and modes errs by 0.001 to 0.001"));
}

// Their points are faint; the line is the best window's, and no line joins a design with modes.
TEST_F(Drawing, OfMoreKernelsThanColoursHasForEachFormatTheBestWindowAsALine) {
    Group many{"0.5", "50", {}};
    double error = 0.5;
    for (const char* kernel :
         {"ring_plain_f32", "ring_oldest_f32", "ring_plain_q15", "shift_fir_q15", "shift_plain_f64", "ring_multi_f32",
          "mirror_multi_f32", "shift_plain_f32", "ring_horner_f64"}) {
        many.entries.push_back(entry(kernel, error, error / 2.0, 0.125));
        error /= 2.0;
    }
    Group close{"0.5", "20+20", {entry("ring_plain_f32", 1e-3, 0.25, 0.25)}};  // 40: too near to 50 for a mark
    bench::plot_error({many, close}, {}, stem());
    const std::string text = sent();
    EXPECT_EQ(count_of(text, "title \"f32\""), 2U);  // once a panel
    EXPECT_EQ(count_of(text, "title \"q15\""), 2U);
    EXPECT_EQ(count_of(text, "title \"f64\""), 2U);
    EXPECT_THAT(text, HasSubstr("$d0 << EOD\n50 5.000000e-01\n50 2.500000e-01\n50 1.562500e-02\n50 7.812500e-03\n50 "
                                "3.906250e-03\n40 1.000000e-03\nEOD\n$d1 << EOD\n50 3.906250e-03\nEOD\n"));
    EXPECT_THAT(text, HasSubstr("$d0 using 1:2 with points pt 4 ps 0.6 lc rgb \"#900072B2\" notitle"));
    EXPECT_THAT(text, HasSubstr("$d1 using 1:2 with linespoints lw 1.5 dt 1 pt 4 ps 0.6 lc rgb \"#0072B2\" title"));
    EXPECT_EQ(count_of(text, " notitle"), 6U);
    EXPECT_THAT(text, HasSubstr("set xtics (\"50\" 50)"));
    many.entries.pop_back();  // eight have one each
    bench::plot_error({many}, {}, stem());
    const std::string few = sent();
    EXPECT_EQ(count_of(few, "title \"shift_plain_f32\""), 2U);
    EXPECT_THAT(few, Not(HasSubstr("best window of")));
}

TEST_F(Drawing, OfEqualCostHasAPanelForEachOrderAndSignal) {
    bench::EqualCost wanted;
    wanted.costs = {16, 24};
    wanted.orders = {0.5, 0.9};
    wanted.signals = {"step", "noise"};
    const auto row = [](const char* way, std::size_t cost, const std::string& where, double error) {
        bench::Json made = bench::make_row("gl/k/" + where, 300);
        made["way"] = way;
        made["cost"] = cost;
        made["error_max"] = error;
        return made;
    };
    bench::plot_equal_cost(wanted,
                           {row("shift_plain_f64", 16, "order:0.5/taps:17/accuracy/signal:step", 0.25),
                            row("shift_plain_f64", 24, "order:0.5/taps:25/accuracy/signal:step", 1e-12),
                            row("modes_plain_f64", 24, "order:0.9/taps:25/accuracy/signal:noise", 0.5),
                            row("mirror_multi_f64", 299, "order:0.9/taps:25/accuracy/signal:noise", 1e-15)},
                           stem());
    const std::string text = sent();
    EXPECT_THAT(text, HasSubstr("set multiplot layout 2,2 "));
    expect_on_the_page(text);
    EXPECT_THAT(text, HasSubstr("set xtics nomirror (16, 24)"));
    // What is exact is drawn at the floor.
    EXPECT_THAT(text, HasSubstr("$d0 << EOD\n16 2.500000e-01\n24 1.000000e-10\nEOD\n$d1 << EOD\n16 NaN\nEOD\n"));
    EXPECT_EQ(count_of(text, "24 5.000000e-01\n"), 1U);
    EXPECT_EQ(count_of(text, "1.000000e-15"), 0U);  // the full memory is no way to save
    const std::size_t shown = bench::equal_cost_ways().size() - 2;
    EXPECT_EQ(count_of(text, "<< EOD"), 4 * shown);
    EXPECT_EQ(count_of(text, "NaN"), 4 * shown - 2);
    for (const char* title : {"order 0.5: step", "order 0.5: noise", "order 0.9: step", "order 0.9: noise"}) {
        EXPECT_EQ(count_of(text, std::string("set title \"") + title), 1U);
    }
    // One key, whose lines are all ways; the axis is named below the last row alone.
    EXPECT_EQ(count_of(text, "set key at"), 1U);
    EXPECT_EQ(count_of(text, "title \"modes\" noenhanced"), 1U);
    EXPECT_EQ(count_of(text, "title \"full memory\""), 0U);
    EXPECT_EQ(count_of(text, "set xlabel \"multiplications a sample\""), 2U);
    EXPECT_GT(text.find("set xlabel \"multiplications a sample\""), text.find("order 0.5: noise"));
    EXPECT_THAT(text, HasSubstr("set yrange " + base::log_range(1e-10, 0.25)));
    EXPECT_EQ(count_of(text, "set yrange [1e-3:1]"), 2U);
}

// Over the picture stands which three ways err least at the highest cost, in how many of the panels that have any.
TEST_F(Drawing, OfEqualCostSaysWhoErrsLeast) {
    bench::EqualCost wanted;
    wanted.costs = {16, 24};
    wanted.orders = {0.5, 0.9};
    wanted.signals = {"step", "ramp", "sine1", "noise"};
    std::vector<bench::Json> rows;
    const auto add = [&](const char* way, std::size_t cost, const char* order, const char* signal, double error) {
        rows.push_back(bench::make_row(std::string("gl/k/order:") + order + "/taps:17/accuracy/signal:" + signal, 300));
        rows.back()["way"] = way;
        rows.back()["cost"] = cost;
        rows.back()["error_max"] = error;
    };
    for (const char* signal : {"step", "ramp", "sine1"}) {
        add("shift_plain_f64", 16, "0.5", signal, 1e-9);  // of another cost
        add("shift_plain_f64", 24, "0.5", signal, 0.25);
        add("modes_plain_f64", 24, "0.5", signal, 0.125);
        add("mirror_multi_f64", 24, "0.5", signal, 1e-15);  // the full memory is no way to save
        add("oustaloupown_f64", 24, "0.5", signal, 1e-12);  // nor is what knows the derivative
    }
    add("shift_plain_f64", 24, "0.9", "step", 0.125);
    add("modes_plain_f64", 24, "0.9", "step", 0.25);
    add("nested_plain_f64", 24, "0.9", "ramp", 0.25);
    add("oustaloup_f64", 24, "0.9", "sine1", 0.25);
    bench::plot_equal_cost(wanted, rows, stem());
    const std::string text = sent();
    EXPECT_THAT(text, HasSubstr("title \"Of 6 panels, at 24 multiplications a sample, the least error is that of modes "
                                "in 3, Oustaloup's filter in 1, logarithmic memory in 1\\n"));
    EXPECT_THAT(text, HasSubstr("set multiplot layout 2,4 "));
    EXPECT_THAT(text, HasSubstr(" size 1200,550 "));  // panels of 230 by 210 pixels
    EXPECT_THAT(text, HasSubstr("set xrange [13:27]"));
}

// A panel for each order and cost: every ranked point by its format, and those on the front as steps, the cheapest
// first.
TEST_F(Drawing, OfCostsHasTheFrontDrawnIn) {
    const auto costed = [](const char* kernel, double error, double ns, double bytes) {
        Entry made = entry(kernel, error, error, 0.0);
        made.host_ns = ns;
        made.bytes = bytes;
        return made;
    };
    Entry wrong = costed("ring_plain_f32", 1e-9, 1.0, 1.0);
    wrong.fault = "wrong";
    const std::vector<Group> all = {
        {"0.5", "50", {costed("ring_plain_f32", 0.25, 20.0, 400.0), costed("ring_plain_q15", 0.5, 30.0, 100.0), wrong}},
        {"0.5", "100", {costed("ring_plain_f32", 0.125, 40.0, 800.0)}},
        {"0.9", "50", {costed("ring_plain_f32", 0.75, 20.0, 400.0), entry("shift_plain_f64", 0.5, 0.5, 0.0)}}};
    const auto costs = bench::report::costs_of(all);
    std::vector<std::string> names;
    for (const auto& cost : costs) {
        names.push_back(cost.name);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"host_ns", "bytes"}));
    const auto points = bench::report::curve_points(all, costs);
    bench::report::plot_costs(stem(), points, costs);
    const std::string text = sent();
    EXPECT_THAT(text, HasSubstr("set multiplot layout 2,2 "));
    expect_on_the_page(text);
    EXPECT_THAT(text, HasSubstr("$d0 << EOD\n2.000000e+01 2.500000e-01\n4.000000e+01 1.250000e-01\nEOD\n"
                                "$d1 << EOD\n3.000000e+01 5.000000e-01\nEOD\n"
                                "$front << EOD\n2.000000e+01 2.500000e-01\n4.000000e+01 1.250000e-01\nEOD\n"));
    EXPECT_THAT(
        text,
        HasSubstr(
            "$front << EOD\n1.000000e+02 5.000000e-01\n4.000000e+02 2.500000e-01\n8.000000e+02 1.250000e-01\nEOD\n"));
    EXPECT_THAT(text, HasSubstr("4.000000e+01 1.250000e-01\nEOD\nset title \"order 0.5\""));
    EXPECT_THAT(text, HasSubstr("$front << EOD\n2.000000e+01 7.500000e-01\nEOD\nset title \"order 0.9\""));
    EXPECT_EQ(count_of(text, "$front << EOD"), 4U);
    EXPECT_EQ(count_of(text, "1.000000e-09"), 0U);  // what is wrong is not shown, nor what has no cost
    EXPECT_EQ(count_of(text, "title \"f64\""), 0U);
    EXPECT_EQ(count_of(text, "title \"f32\""), 4U);
    EXPECT_EQ(count_of(text, "title \"q15\""), 2U);
    EXPECT_EQ(count_of(text, "set key at"), 1U);
    EXPECT_LT(text.find("set key at"), text.find("unset key"));
    EXPECT_EQ(count_of(text, "set title \"order 0.5\""), 2U);
    EXPECT_EQ(count_of(text, "set title \"order 0.9\""), 2U);
    EXPECT_THAT(text,
                HasSubstr("set xrange " + base::log_range(20.0, 40.0) + "\nset yrange " + base::log_range(0.125, 0.5)));
    for (const auto& cost : costs) {
        // Where it is and what it counts, one below the other.
        std::string label = cost.title;
        if (const std::size_t comma = label.find(", "); comma != std::string::npos) {
            label.replace(comma, 2, ",\\n");
        }
        EXPECT_EQ(count_of(text, "set xlabel \"" + label + "\""), 2U) << label;
    }
}

// Logarithmic axes have no zero: what is free or exact is on a front, and not drawn.
TEST_F(Drawing, OfCostsHasNothingThatIsFreeOrExact) {
    Entry exact = entry("ring_plain_f32", 0.0, 0.0, 0.0);
    exact.host_ns = 20.0;
    Entry gift = entry("ring_plain_q15", 0.25, 0.25, 0.0);
    gift.host_ns = 0.0;
    Entry other = entry("shift_plain_f32", 0.5, 0.5, 0.0);
    other.host_ns = 10.0;
    const std::vector<Group> all = {{"0.5", "50", {exact, gift, other}}};
    const auto costs = bench::report::costs_of(all);
    bench::report::plot_costs(stem(), bench::report::curve_points(all, costs), costs);
    const std::string text = sent();
    EXPECT_THAT(text, HasSubstr("$d0 << EOD\n1.000000e+01 5.000000e-01\nEOD\n"));
    EXPECT_THAT(text, Not(HasSubstr("0.000000e+00")));
    EXPECT_THAT(text, Not(HasSubstr("title \"q15\"")));
}

// Of more kernels than 200 the first are drawn: a format that only another one has is not in the key.
TEST_F(Drawing, OfErrorsHasTheFirst200Kernels) {
    Group many{"0.5", "50", {}};
    for (int i = 0; i < 199; ++i) {
        many.entries.push_back(entry(("k" + std::to_string(i)).c_str(), 0.5, {}, 0.125));
    }
    many.entries.push_back(entry("ring_plain_q15", 0.5, {}, 0.125));
    many.entries.push_back(entry("ring_plain_f32", 0.5, {}, 0.125));
    bench::plot_error({many}, {}, stem());
    const std::string text = sent();
    EXPECT_EQ(count_of(text, "title \"unknown\""), 1U);
    EXPECT_EQ(count_of(text, "title \"q15\""), 1U);
    EXPECT_EQ(count_of(text, "title \"f32\""), 0U);
}

// From a file a length may be none: there is no place for it, and its order's others are drawn.
TEST_F(Drawing, OfErrorsHasNoPlaceForWhatIsNoLength) {
    bench::plot_error(
        {{"0.5", "50", {entry("a_f32", 0.5, 0.25, 0.125)}}, {"0.5", "0", {entry("a_f32", 1e-3, 1e-4, 1e-3)}}},
        {{"0.5", {{"0", 1e-3}, {"50", 0.25}}}}, stem());
    const std::string text = sent();
    EXPECT_THAT(text, HasSubstr("$d0 << EOD\n50 5.000000e-01\nEOD\n"));
    EXPECT_THAT(text, HasSubstr("set xtics (\"50\" 50)"));
    EXPECT_THAT(text, HasSubstr("set xrange [40:62.5]"));
    EXPECT_THAT(text, Not(HasSubstr("1.000000e-03")));
    EXPECT_THAT(text, Not(HasSubstr("1.000000e-04")));
}

// A mark of taps and modes has room from a factor of 1.45 on, to either side.
TEST_F(Drawing, OfErrorsHasMarksThatDoNotLieOnEachOther) {
    std::vector<Group> all;
    for (const char* taps : {"20", "1+27", "1+28", "800", "1+551", "1+550"}) {
        all.push_back({"0.5", taps, {entry("a_f32", 0.5, {}, 0.125)}});
    }
    bench::plot_error(all, {}, stem());
    EXPECT_THAT(sent(), HasSubstr("set xtics (\"20\" 20, \"800\" 800, \"1+28\" 29, \"1+550\" 551)"));
}

// Of more orders than anybody reads, and gnuplot has room for, the first 24 are drawn.
TEST_F(Drawing, OfManyOrdersTheFirstAreShown) {
    std::vector<Group> many;
    for (int i = 1; i <= 25; ++i) {
        Entry one = entry("a_f32", 0.5, 0.25, 0.125);
        one.host_ns = 10.0;
        many.push_back({"0." + std::to_string(i), "50", {one}});
    }
    const auto costs = bench::report::costs_of(many);
    bench::report::plot_costs(stem(), bench::report::curve_points(many, costs), costs);
    std::string text = sent();
    EXPECT_EQ(count_of(text, "set title \"order "), 24U);  // of the host; bytes are not known
    EXPECT_EQ(count_of(text, "\"order 0.25\""), 0U);
    EXPECT_EQ(count_of(text, "\"order 0.24\""), 1U);
    bench::plot_error(many, {}, stem());
    text = sent();
    EXPECT_EQ(count_of(text, ": total error\""), 24U);
    EXPECT_EQ(count_of(text, "order 0.25: "), 0U);
}

// The table of the same points: nothing where nothing is known, the model's band beside its cycles.
TEST_F(Drawing, IsWrittenAsATableToo) {
    Entry modelled = entry("a_f32", 0.25, 0.125, 0.0625);
    modelled.host_ns = 20.0;
    modelled.bytes = 400.0;
    modelled.effective_taps = 49.0;
    modelled.model_cycles["m7-ideal"] = {30.0, 28.0, 33.0};
    modelled.target_instructions = 60.0;
    Entry wrong = entry("b,q15", 0.5, {}, 0.5);
    wrong.fault = "wrong";
    const std::vector<Group> all = {{"0.5", "50", {modelled, wrong}}, {"0.9", "full", {entry("c_f64", {}, {}, 0.0)}}};
    const auto costs = bench::report::costs_of(all);
    bench::report::write_curves(folder_ / "curves.csv", bench::report::curve_points(all, costs), costs,
                                {{"0.5", {{"50", 0.375}}}});
    std::ifstream in(folder_ / "curves.csv");
    EXPECT_EQ(
        (std::string{std::istreambuf_iterator<char>(in), {}}),
        "order,kernel,taps,error_max,rounding_error_max,truncation_error_max,truncation_bound,effective_taps,host_ns,"
        "instructions,model_cycles:m7-ideal,model_cycles_low:m7-ideal,model_cycles_high:m7-ideal,bytes,front:host_ns,"
        "front:instructions,front:model_cycles:m7-ideal,front:bytes,fault\n"
        "0.5,a_f32,50,0.25,0.125,0.0625,0.375,49,20,60,30,28,33,400,1,1,1,1,\n"
        "0.5,\"b,q15\",50,0.5,,0.5,0.375,,,,,,,,0,0,0,0,wrong\n"
        "0.9,c_f64,full,,,0,,,,,,,,,0,0,0,0,\n");
}

}  // namespace
