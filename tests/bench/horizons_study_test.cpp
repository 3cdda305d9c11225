// What an error over a horizon costs: by hand, and each design of a small study found again by itself.
#include "bench/studies/horizons.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/failure.hpp"
#include "bench/studies/horizon_case.hpp"
#include "bench/sweep/signals.hpp"
#include "bench/sweep/sweep.hpp"
#include "bench/target/target_rows.hpp"
#include "glsum/design/blocks.hpp"
#include "glsum/design/modes.hpp"
#include "tests/choose/pretend_board.hpp"

namespace {

using bench::HorizonCase;
using bench::Json;

TEST(HorizonCase, AWindowLeavesNoMoreThanTheError) {
    const std::vector<double> weights{1.0, -0.5, 0.25, -0.125, 0.0625};
    EXPECT_EQ(bench::window_for(weights, 0.0625), 3U);  // four taps, the newest's for nothing
    EXPECT_EQ(bench::window_for(weights, 0.1875), 2U);
    EXPECT_EQ(bench::window_for(weights, 0.1874), 3U);
    EXPECT_EQ(bench::window_for(weights, 0.0624), std::nullopt);
    EXPECT_EQ(bench::window_for(weights, 100.0), 0U);
    EXPECT_EQ(bench::window_for({1.0}, 100.0), std::nullopt);
}

// 2 near taps and 3 modes, that is 7 multiplications.
HorizonCase made(double certificate, double found) {
    HorizonCase one{0.5, 1e-4, 600, std::nullopt, std::nullopt, std::nullopt};
    one.modes = glsum::design::Approximation{2, std::vector<glsum::Mode>(3), certificate};
    one.largest_error = found;
    return one;
}

TEST(HorizonCase, ModesPromiseTheirCertificateAndTheRounding) {
    EXPECT_DOUBLE_EQ(made(1e-4, 0.0).promised(), 0.9 * (1e-4 + 1e-11));
    HorizonCase without = made(1e-4, 0.0);
    without.modes.reset();
    EXPECT_EQ(without.promised(), 0.0);
}

TEST(HorizonCase, HasARowForEachWayThatThereIs) {
    HorizonCase one = made(9e-5, 1e-5);
    std::vector<Json> rows = bench::to_rows(one);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].at("name"), "horizon/window/order:0.5/error:0.0001/samples:600");
    EXPECT_EQ(rows[0].at("iterations"), 600);
    EXPECT_EQ(rows[0].at("horizon_samples"), 600);
    EXPECT_EQ(rows[0].at("macs_per_sample"), 599);  // all samples, the newest for nothing
    EXPECT_EQ(rows[1].at("name"), "horizon/modes/order:0.5/error:0.0001/samples:600");
    EXPECT_EQ(rows[1].at("horizon_samples"), 600);
    EXPECT_EQ(rows[1].at("macs_per_sample"), 7);
    EXPECT_EQ(rows[1].at("near_taps"), 2);
    EXPECT_EQ(rows[1].at("modes"), 3);
    EXPECT_EQ(rows[1].at("design_error"), 9e-5);
    EXPECT_EQ(rows[1].at("absolute_error_max"), 1e-5);
    EXPECT_FALSE(rows[1].contains("model_cycles_per_sample"));
    EXPECT_FALSE(rows[1].contains("error_occurred"));
    one.window = 400;
    one.blocks = 50;
    one.cycles = {33.5};
    rows = bench::to_rows(one);
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[0].at("macs_per_sample"), 400);
    EXPECT_EQ(rows[1].at("name"), "horizon/nested/order:0.5/error:0.0001/samples:600");
    EXPECT_EQ(rows[1].at("macs_per_sample"), 50);
    EXPECT_EQ(rows[2].at("model_cycles_per_sample"), 33.5);
    one.modes.reset();
    EXPECT_EQ(bench::to_rows(one).size(), 2U);
}

TEST(HorizonCase, CoresStandBesideEachOtherAndEachFurtherOneHasARow) {
    const std::vector<bench::HorizonCore> cores{{base::machine_called("m7"), "stm32f746-itcm"},
                                                {base::machine_called("m4"), "cortex-m4-zerowait"}};
    HorizonCase one = made(9e-5, 1e-5);
    HorizonCase without = one;
    without.modes.reset();
    without.largest_error = 0.0;
    one.cycles = {33.5, 66.6};
    const std::vector<Json> rows = bench::to_rows(one, cores);
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[1].at("name"), "horizon/modes/order:0.5/error:0.0001/samples:600");
    EXPECT_EQ(rows[1].at("model_cycles_per_sample"), 33.5);
    EXPECT_EQ(rows[2].at("name"), "horizon/modes/order:0.5/error:0.0001/samples:600/m4:cortex-m4-zerowait");
    EXPECT_EQ(rows[2].at("model_cycles_per_sample"), 66.6);
    EXPECT_EQ(rows[2].at("macs_per_sample"), 7);
    EXPECT_EQ(bench::to_rows(without, cores).size(), 1U);
    const std::string table = bench::to_table(0.5, {one, without}, cores);
    EXPECT_NE(table.find("  error found  m7 cycles  m4 cycles\n"), std::string::npos) << table;
    EXPECT_NE(table.find("      1.0e-05         34         67\n"), std::string::npos) << table;
    EXPECT_NE(table.find("            -          -          -\n"), std::string::npos) << table;
}

// On machines that are pretended, whose calls take so many cycles a coefficient.
TEST(HorizonStudy, EachDesignHasItsCyclesOnEachMachine) {
    const test::PretendBoard m7(0.5, 100, 1, 20, 24, base::machines[0], "modes_plain_f32");
    const test::PretendBoard m4(0.5, 100, 1, 50, 60, base::machines[1], "modes_plain_f32");
    const bench::Study study = bench::measure_horizons({{100, 110, 200}, {0.5}, {m7.board(), m4.board()}});
    EXPECT_EQ(study.context.at("core"), "stm32f746-itcm, cortex-m4-zerowait");
    EXPECT_NE(study.text.find("modelled cycles of the same design in single precision, stm32f746-itcm, "
                              "cortex-m4-zerowait.\n"),
              std::string::npos)
        << study.text;
    std::map<std::string, std::size_t> lengths;  // of the designs, by their rows of the first machine
    std::set<std::size_t> measured;
    std::size_t on_m4 = 0;
    for (const Json& row : study.rows) {
        const auto name = row.at("name").get<std::string>();
        if (!name.starts_with("horizon/modes/")) {
            EXPECT_FALSE(row.contains("model_cycles_per_sample")) << name;
            continue;
        }
        double cycles = 20.0;
        if (const std::size_t at = name.find("/m4:cortex-m4-zerowait"); at != std::string::npos) {
            cycles = 50.0 * static_cast<double>(lengths.at(name.substr(0, at)));
            ++on_m4;
        } else {
            lengths[name] = row.at("near_taps").get<std::size_t>() + 2 * row.at("modes").get<std::size_t>();
            measured.insert(lengths[name]);
            cycles *= static_cast<double>(lengths[name]);
        }
        EXPECT_DOUBLE_EQ(row.at("model_cycles_per_sample").get<double>(), cycles) << name;
    }
    EXPECT_EQ(on_m4, lengths.size());
    EXPECT_GT(measured.size(), 2U);
    // Of designs of the same length one is measured for all.
    EXPECT_GT(lengths.size(), measured.size());
}

TEST(HorizonCase, AModesRowThatErrsMoreThanItPromisesIsWrong) {
    HorizonCase one = made(0.5, 0.0);
    one.largest_error = one.promised();
    EXPECT_FALSE(bench::to_rows(one).back().contains("error_occurred"));
    EXPECT_EQ(bench::to_table(0.5, {one}).find("WRONG"), std::string::npos);
    one.largest_error = 0.75;
    EXPECT_EQ(bench::to_rows(one).back().at("error_message"), "errs by 0.75, promised 0.45");
    EXPECT_NE(bench::to_table(0.5, {one}).find("7.5e-01        -  WRONG\n"), std::string::npos);
}

TEST(HorizonCase, TheTableIsOfItsOrder) {
    HorizonCase one = made(9.01e-5, 1e-5);
    HorizonCase other = made(1e-4, 0.0);
    other.samples = 5000;
    other.window = 400;
    other.blocks = 50;
    other.cycles = {33.4};
    other.modes.reset();
    HorizonCase elsewhere = other;
    elsewhere.order = 0.9;
    EXPECT_EQ(bench::to_table(0.5, {one, elsewhere, other}),
              "\nOrder 0.5\n"
              "     error    samples      window     blocks            modes  certificate  error found   cycles\n"
              "    0.0001        600         all        all          7 (2+3)      9.1e-05      1.0e-05        -\n"
              "    0.0001       5000         400         50                -            -            -       33\n");
}

TEST(HorizonCase, ThePictureHasAPanelForEachOrderAndErrorWithEachWaysMultiplications) {
    HorizonCase shorter = made(9e-5, 1e-5);
    HorizonCase longer = shorter;
    longer.samples = 5000;
    longer.window = 400;
    longer.blocks = 50;
    const base::Picture picture = bench::picture_of({0.5, 0.9}, {shorter, longer});
    std::size_t panels = 0;
    for (std::size_t at = 0; (at = picture.script.find("set title \"order", at)) != std::string::npos; ++at) {
        ++panels;
    }
    EXPECT_EQ(panels, 6U);
    EXPECT_NE(picture.script.find("$d0 << EOD\n600 599\n5000 400\nEOD\n$d1 << EOD\n5000 50\nEOD\n$d2 << EOD\n600 "
                                  "7\n5000 7\nEOD\nset title \"order 0.5, error 10^{-4}\""),
              std::string::npos)
        << picture.script;
    EXPECT_NE(picture.script.find("$d0 << EOD\n1000 NaN\nEOD\n$d1 << EOD\n1000 NaN\nEOD\n$d2 << EOD\n1000 NaN\nEOD\n"
                                  "set title \"order 0.9, error 10^{-4}\""),
              std::string::npos);
    EXPECT_NE(picture.script.find("set xrange [300:10000]"), std::string::npos);
    EXPECT_NE(picture.script.find("$d1 using 1:2 with linespoints lw 1.8 pt 7"), std::string::npos);
    // Samples are named below the last row of panels, and ways once.
    EXPECT_LT(picture.script.find("set xlabel \"\""), picture.script.find("set xlabel \"samples\""));
    EXPECT_GT(picture.script.find("set xlabel \"samples\""), picture.script.find("error 10^{-6}"));
    EXPECT_EQ(picture.script.find("\nset key"), picture.script.rfind("\nset key"));
    EXPECT_GT(picture.width, 2U * 260U);
    EXPECT_GT(picture.height, 3U * 230U);
}

// Over it stands the most that a window and modes take over the longest horizon, of any order and error.
TEST(HorizonCase, ThePictureSaysWhatTheLongestHorizonTakes) {
    HorizonCase shorter = made(9e-5, 1e-5);
    shorter.modes->modes.resize(6);
    HorizonCase longer = made(9e-5, 1e-5);  // 2 + 2 * 3 coefficients, the first for nothing
    longer.samples = 5000;
    longer.window = 400;
    HorizonCase other = longer;
    other.order = 0.9;
    other.window = 300;
    other.modes->modes.resize(4);
    HorizonCase without = longer;
    without.window = 200;
    without.modes.reset();
    const base::Picture picture = bench::picture_of({0.5, 0.9}, {shorter, longer, other, without});
    EXPECT_NE(picture.script.find("title \"Over 5000 samples a window takes up to 400 multiplications a sample, near "
                                  "taps and modes at most 9\\n"),
              std::string::npos)
        << picture.script;
    EXPECT_NE(picture.script.find("set multiplot layout 3,2 "), std::string::npos);
    EXPECT_NE(picture.script.find("set yrange [3:10000]"), std::string::npos);  // to twice the longest horizon
    // Panels of 260 by 230 pixels.
    EXPECT_EQ(bench::picture_of({0.5, 0.7, 0.9}, {longer}).width, picture.width + 260U);
    EXPECT_EQ(bench::picture_of({0.5}, {longer}).height, picture.height);
}

// Margins and what lies between panels take as many pixels however many panels there are, and leave most to these.
TEST(HorizonCase, ThePicturesMarginsDoNotGrowWithIt) {
    struct Layout {
        double left, right, bottom, top, across, down;  // pixels; between panels the last two
        double width, height;
    };
    const auto layout_of = [](const std::vector<double>& orders) {
        const HorizonCase one{0.5, 1e-3, 600, {}, {}, {}};
        const base::Picture picture = bench::picture_of(orders, {one});
        const auto wide = static_cast<double>(picture.width);
        const auto tall = static_cast<double>(picture.height);
        double right = 0.0;
        double top = 0.0;
        Layout found{};
        const std::string margins = picture.script.substr(picture.script.find("margins"));
        EXPECT_EQ(std::sscanf(margins.c_str(), "margins %lf,%lf,%lf,%lf spacing %lf,%lf", &found.left, &right,
                              &found.bottom, &top, &found.across, &found.down),
                  6);
        return Layout{found.left * wide,
                      (1.0 - right) * wide,
                      found.bottom * tall,
                      (1.0 - top) * tall,
                      found.across * wide,
                      found.down * tall,
                      wide,
                      tall};
    };
    const Layout few = layout_of({0.5});
    const Layout many = layout_of({0.1, 0.3, 0.5, 0.7, 0.9});
    for (const auto part :
         {&Layout::left, &Layout::right, &Layout::bottom, &Layout::top, &Layout::across, &Layout::down}) {
        EXPECT_NEAR(few.*part, many.*part, 0.2);
        EXPECT_GT(few.*part, 10.0);
    }
    EXPECT_GT(many.width - many.left - many.right - 4.0 * many.across, 0.5 * many.width);
    EXPECT_GT(many.height - many.bottom - many.top - 2.0 * many.down, 0.5 * many.height);
}

// The key stands in the margin on the right, as high as the highest panel.
TEST(HorizonCase, ThePicturesKeyStandsBesideTheUppermostPanel) {
    const HorizonCase one{0.5, 1e-3, 600, {}, {}, {}};
    const std::string script = bench::picture_of({0.5, 0.9}, {one}).script;
    double left = 0.0;
    double right = 0.0;
    double bottom = 0.0;
    double top = 0.0;
    double x = 0.0;
    double y = 0.0;
    ASSERT_EQ(std::sscanf(script.substr(script.find("margins")).c_str(), "margins %lf,%lf,%lf,%lf", &left, &right,
                          &bottom, &top),
              4);
    ASSERT_EQ(std::sscanf(script.substr(script.find("set key")).c_str(), "set key at screen %lf, screen %lf left top",
                          &x, &y),
              2);
    EXPECT_GT(x, right);
    EXPECT_LT(x, 1.0);
    EXPECT_EQ(y, top);
}

// a_0 ... of an order: what the sums are made of.
std::vector<double> weights_of(double order, std::size_t count) {
    std::vector<double> weights{1.0};
    for (std::size_t j = 1; j < count; ++j) {
        weights.push_back(weights.back() * (1.0 - (1.0 + order) / static_cast<double>(j)));
    }
    return weights;
}

// The most that near taps and exponentials err on the seven signals, by the plain sums of both.
double largest_error(double order, const glsum::design::Approximation& design, std::size_t samples) {
    std::vector<double> off = weights_of(order, samples);
    for (std::size_t j = 0; j < samples; ++j) {
        double approximate = j < design.near_taps ? off[j] : 0.0;
        for (const glsum::Mode& mode : design.modes) {
            approximate += j < design.near_taps
                               ? 0.0
                               : mode.weight * std::pow(1.0 - mode.decay, static_cast<double>(j - design.near_taps));
        }
        off[j] -= approximate;
    }
    double largest = 0.0;
    for (const std::string_view signal : bench::signal_names) {
        const std::vector<double> record = bench::make_signal(signal, samples, bench::Sweep().seed);
        for (std::size_t k = 0; k < samples; ++k) {
            double error = 0.0;
            for (std::size_t j = 0; j <= k; ++j) {
                error += off[j] * record[k - j];
            }
            largest = std::max(largest, std::fabs(error));
        }
    }
    return largest;
}

TEST(HorizonsStudy, EachDesignIsTheShortestOfItsKind) {
    const bench::Horizons wanted{.horizons = {150, 1000}, .orders = {0.5, -0.5}};
    const bench::Study study = bench::measure_horizons(wanted);
    EXPECT_EQ(study.wrong, 0U);
    std::size_t next = 0;
    const auto macs = [&] { return study.rows.at(next).at("macs_per_sample").get<std::size_t>(); };
    for (const double order : wanted.orders) {
        for (const double error : {1e-2, 1e-4, 1e-6}) {
            for (const std::size_t samples : wanted.horizons) {
                const std::string place = (order > 0 ? "/order:0.5/error:" : "/order:-0.5/error:") +
                                          std::string(error > 1e-3   ? "0.01"
                                                      : error > 1e-5 ? "0.0001"
                                                                     : "1e-06") +
                                          "/samples:" + std::to_string(samples);
                EXPECT_EQ(study.rows.at(next).at("name"), "horizon/window" + place);
                const std::vector<double> weights = weights_of(order, samples);
                double left = 0.0;
                std::size_t taps = samples;
                while (left + std::fabs(weights[taps - 1]) <= error) {
                    left += std::fabs(weights[--taps]);
                }
                EXPECT_EQ(macs(), taps - 1) << place;
                ++next;
                const glsum::design::Tail tail{order, samples - 1};
                if (study.rows.at(next).at("name") == "horizon/nested" + place) {
                    const std::size_t enough = macs() + 1;
                    EXPECT_LE(glsum::design::design_blocks(tail, enough).error, error) << place;
                    const std::size_t fewer = enough - std::max<std::size_t>(1, enough / 64);
                    EXPECT_GT(glsum::design::design_blocks(tail, fewer).error, error) << place;
                    ++next;
                } else {  // no power of two below the horizon is enough
                    std::size_t most = 1;
                    while (2 * most <= samples - 1) {
                        most *= 2;
                    }
                    EXPECT_GT(glsum::design::design_blocks(tail, most).error, error) << place;
                }
                const auto modes = glsum::design::design_modes(tail, error);
                ASSERT_TRUE(modes.has_value());
                const Json& row = study.rows.at(next++);
                EXPECT_EQ(row.at("name"), "horizon/modes" + place);
                EXPECT_EQ(row.at("macs_per_sample"), modes->multiplications());
                EXPECT_EQ(row.at("near_taps"), modes->near_taps);
                EXPECT_EQ(row.at("modes"), modes->modes.size());
                EXPECT_EQ(row.at("design_error"), modes->error);
                EXPECT_NEAR(row.at("absolute_error_max").get<double>(), largest_error(order, *modes, samples), 1e-13)
                    << place;
            }
        }
    }
    EXPECT_EQ(next, study.rows.size());
    EXPECT_LT(study.text.find("\nOrder 0.5\n"), study.text.find("\nOrder -0.5\n"));
    EXPECT_NE(study.text.find("seven signals of 0.9.\n"), std::string::npos);  // without a board no cycles
    const Json& context = study.context;
    EXPECT_EQ(context.at("horizons"), Json({150, 1000}));
    EXPECT_EQ(context.at("core"), "");
    EXPECT_EQ(context.at("n_samples"), 1000);
    EXPECT_EQ(context.at("sweep").at("orders"), Json({0.5, -0.5}));
    EXPECT_EQ(context.at("sweep").at("signals").size(), 7U);
    EXPECT_EQ(context.at("sweep").at("targets"), Json({"host"}));
    EXPECT_EQ(context.at("sweep").at("cores"), Json::array());
    ASSERT_TRUE(study.picture.has_value());
    EXPECT_NE(study.picture->script.find("order -0.5, error 10^{-6}"), std::string::npos);
}

// Where a design takes hundreds of coefficients it is looked for within a sixty-fourth of them.
TEST(HorizonsStudy, LongDesignsOfBlocksAreTheShortestToASixtyFourth) {
    const bench::Study study = bench::measure_horizons({.horizons = {4000}, .orders = {0.2}});
    std::size_t met = 0;
    for (const Json& row : study.rows) {
        if (row.at("name").get<std::string>().starts_with("horizon/nested")) {
            ++met;
            const double error = std::stod(
                row.at("name").get<std::string>().substr(row.at("name").get<std::string>().find("error:") + 6));
            const std::size_t enough = row.at("macs_per_sample").get<std::size_t>() + 1;
            const glsum::design::Tail tail{0.2, 3999};
            EXPECT_LE(glsum::design::design_blocks(tail, enough).error, error);
            EXPECT_GT(glsum::design::design_blocks(tail, enough - std::max<std::size_t>(1, enough / 64)).error, error);
        }
    }
    EXPECT_GE(met, 2U);
}

TEST(HorizonsStudy, HasTheDocumentedOrders) {
    EXPECT_EQ(bench::Horizons().orders, (std::vector<double>{0.2, 0.5, 0.9, 1.5, -0.5}));
}

// Each design once, as each board itself counts it.
TEST(HorizonsStudy, CyclesAreTheBoardsOfTheSameDesigns) {
    std::vector<qemu::Board> boards;
    try {
        boards = {qemu::find_board(TEST_FIRMWARE_BUILD, TEST_PLUGIN, TEST_EMULATE),
                  qemu::find_board(TEST_M4_FIRMWARE_BUILD, TEST_PLUGIN, TEST_M4_EMULATE)};
        (void)qemu::emulator_version();
    } catch (const glsum::Failure& failure) {
        if (std::getenv("GLSUM_REQUIRE_FIRMWARE") != nullptr) {
            FAIL() << failure.what();
        }
        GTEST_SKIP() << failure.what();
    }
    boards[0].machine = base::machine_called("m7");
    boards[1].machine = base::machine_called("m4");
    for (qemu::Board& board : boards) {
        board.cores = TEST_CORES;
    }
    const bench::Study study = bench::measure_horizons({.horizons = {100, 150}, .orders = {0.5}, .boards = boards});
    EXPECT_NE(study.text.find("; modelled cycles of the same design in single precision, stm32f746-itcm, "
                              "cortex-m4-zerowait.\n"),
              std::string::npos);
    EXPECT_EQ(study.context.at("core"), "stm32f746-itcm, cortex-m4-zerowait");
    std::vector<qemu::PlannedRow> plan;
    std::vector<std::vector<double>> found(2);  // by board
    for (const Json& row : study.rows) {
        const auto name = row.at("name").get<std::string>();
        if (!name.starts_with("horizon/modes")) {
            EXPECT_FALSE(row.contains("model_cycles_per_sample"));
            continue;
        }
        const auto cycles = row.at("model_cycles_per_sample").get<double>();
        if (name.ends_with("/m4:cortex-m4-zerowait")) {
            found[1].push_back(cycles);
            continue;
        }
        found[0].push_back(cycles);
        const auto modes = glsum::design::design_modes({0.5, row.at("horizon_samples").get<std::size_t>() - 1},
                                                       std::stod(name.substr(name.find("error:") + 6)));
        plan.push_back({"modes_plain_f32", 0.5, modes->length(), 0,
                        qemu::calls_to_measure("modes_plain_f32", modes->length()), modes->modes});
    }
    for (std::size_t b = 0; b < boards.size(); ++b) {
        ASSERT_EQ(found[b].size(), 6U);
        const auto measured = qemu::measure(
            boards[b], plan, {bench::make_signal("noise", 1000, bench::Sweep().seed)}, [] {}, qemu::Counting::blocks,
            bench::timing_request(TEST_CORES, {std::string(boards[b].machine->default_core)}));
        for (std::size_t i = 0; i < plan.size(); ++i) {
            EXPECT_EQ(found[b][i], measured[i].cores.at(0).cycles) << b << ' ' << i;
        }
    }
}

}  // namespace
