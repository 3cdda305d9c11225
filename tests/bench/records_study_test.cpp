// Whole records, many ways: what is made of turns and errors, by hand; and a small study against closed forms.
#include "bench/studies/records.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <map>
#include <string>
#include <vector>

#include "bench/studies/record_case.hpp"
#include "bench/sweep/sweep.hpp"
#include "drive/whole_record.hpp"

namespace {

using bench::Json;
using bench::RecordSize;
using bench::RecordTask;
using bench::RecordWay;
using bench::Seconds;

TEST(RecordCase, TheMedianIsTheMiddleOrTheMeanOfBoth) {
    EXPECT_EQ(bench::median({7.0}), 7.0);
    EXPECT_EQ(bench::median({3.0, 1.0, 8.0}), 3.0);
    EXPECT_EQ(bench::median({1.0, 16.0, 2.0, 4.0}), 3.0);
    EXPECT_EQ(bench::median({9.0, 1.0, 5.0, 3.0, 2.0}), 3.0);
}

RecordWay made(const std::string& name, const std::vector<Seconds>& turns) {
    RecordWay way{.name = name, .label = "as " + name, .full_memory = true};
    way.turns = turns;
    return way;
}

TEST(RecordCase, RatiosAreTakenTurnByTurn) {
    const RecordWay one = made("one", {{10.0, 1.0}, {11.0, 8.0}, {30.0, 9.0}});
    const RecordWay other = made("other", {{1.0, 1.0}, {1.0, 2.0}, {1.0, 3.0}});
    EXPECT_EQ(one.processor_s(), 8.0);
    EXPECT_EQ(one.wall_s(), 11.0);
    EXPECT_EQ(bench::ratio(one, other), 3.0);  // of 1, 4 and 3; the medians' own would be 4
}

TEST(RecordCase, ATurnTakesAboutAHundredThousandSamples) {
    EXPECT_EQ(bench::runs_a_turn(1000), 100U);
    EXPECT_EQ(bench::runs_a_turn(50'000), 2U);
    EXPECT_EQ(bench::runs_a_turn(50'001), 1U);
    EXPECT_EQ(bench::runs_a_turn(10'000'000), 1U);
}

void work(double seconds) {
    for (const std::clock_t start = std::clock();
         static_cast<double>(std::clock() - start) < seconds * CLOCKS_PER_SEC;) {
    }
}

TEST(RecordCase, ATurnIsTheMeanOfItsRunsWithoutLoading) {
    int loads = 0;
    int runs = 0;
    double waited = 0.0;
    RecordWay way{.name = "", .label = "", .full_memory = true};
    way.load = [&](const RecordTask&) {
        EXPECT_EQ(loads++, runs);  // once before each run
        const auto begin = std::chrono::steady_clock::now();
        work(0.02);
        waited += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    double wall = 0.0;  // by the clock that tells it: another one may run at another pace in a virtual machine
    way.timed = [&](const RecordTask&) {
        EXPECT_EQ(loads, ++runs);
        const auto begin = std::chrono::steady_clock::now();
        work(0.004);
        wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    RecordTask task;
    task.record.assign(33'333, 0.0);
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t start = std::clock();
    const Seconds turn = bench::time_once(way, task);
    const double all_wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const double all = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_EQ(runs, 3);
    EXPECT_GE(turn.processor, 0.004);
    EXPECT_LE(turn.processor, all / 3.0 - 0.02);
    EXPECT_GE(turn.wall, wall / 3.0);
    EXPECT_LE(turn.wall, all_wall / 3.0 - waited / 3.0);
    way.load = nullptr;  // none is needed
    loads = 4;
    EXPECT_GE(bench::time_once(way, {{}, std::vector<double>(100'000)}).processor, 0.004);
    EXPECT_EQ(runs, 4);
}

TEST(RecordCase, ComparesTheFirstTheBordersAndTheLastOfEachTwelfth) {
    EXPECT_EQ(bench::compared_samples(1200),
              (std::vector<std::size_t>{0,   1,   2,   15,  16,  17,  127, 255, 256, 257,  99,
                                        199, 299, 399, 499, 599, 699, 799, 899, 999, 1099, 1199}));
    EXPECT_EQ(bench::compared_samples(1000).back(), 999U);
    EXPECT_EQ(bench::compared_samples(1000)[10], 82U);  // 1000/12 and one less
}

TEST(RecordCase, AllowsTheSumsBoundAndTheWeightsRounding) {
    const RecordTask task{{1.0, -0.5, 0.25}, {0.9, -0.9, 0.3, 0.1}};
    EXPECT_NEAR(bench::allowed_error(task),
                drive::whole_record_error_bound(task.weights, task.record) + std::exp2(-53.0) * 0.9 * 1.75, 1e-22);
}

TEST(RecordCase, JudgesTheLargestErrorOfAll) {
    RecordWay way = made("way", {});
    bench::judge(way, "step", std::vector<double>{0.25, -0.5, 0.125}, 2.0, 0.5);
    EXPECT_EQ(way.error_max, 0.25);  // of the peak
    EXPECT_EQ(way.fault, "");        // at the limit, not beyond it
    bench::judge(way, "ramp", std::vector<double>{0.1}, 2.0, 0.5);
    EXPECT_EQ(way.error_max, 0.25);
    bench::judge(way, "noise", std::vector<double>{0.0, 0.75}, 1.0, 0.5);
    EXPECT_EQ(way.error_max, 0.75);
    EXPECT_EQ(way.fault, "noise: wrong answer: error 0.75 beyond 0.5");
    RecordWay window = made("window", {});
    window.full_memory = false;  // it promises nothing
    bench::judge(window, "noise", std::vector<double>{0.75}, 1.0, 0.5);
    EXPECT_EQ(window.error_max, 0.75);
    EXPECT_EQ(window.fault, "");
    RecordWay broken = made("broken", {});
    bench::judge(broken, "step", std::vector<double>{std::nan(""), 0.0}, 1.0, 0.5);
    EXPECT_EQ(broken.fault, "step: wrong answer: error inf beyond 0.5");
}

// The second way errs; its size is twice and its time four times that of the size before.
std::vector<RecordSize> two_sizes() {
    std::vector<RecordSize> sizes{{1000, {}, {}}, {2000, {}, {}}};
    sizes[0].ways = {made("whole_f64", {{0.5, 0.25}}), made("peer_fftw_f64", {{1.0, 0.5}}),
                     made("peer_fftwmeasured_f64", {{1.0, 0.125}})};
    sizes[1].ways = {made("whole_f64", {{2.0, 1.0}}), made("peer_fftw_f64", {{2.0, 1.0}}),
                     made("peer_fftwmeasured_f64", {{1.0, 0.5}})};
    sizes[1].ways[1].error_max = 0.5;
    sizes[1].ways[1].fault = "of noise";
    return sizes;
}

TEST(RecordCase, ARowSaysWhatItsTurnsWere) {
    std::vector<RecordSize> sizes = two_sizes();
    sizes[0].ways[0].error_max = 0.125;
    const Json row = bench::to_row(0.5, sizes[0], sizes[0].ways[0]);
    EXPECT_EQ(row.at("name"), "record/whole_f64/order:0.5/samples:1000/host");
    EXPECT_EQ(row.at("iterations"), 1000);
    EXPECT_EQ(row.at("label"), "as whole_f64");
    EXPECT_EQ(row.at("real_time"), 5e5);
    EXPECT_EQ(row.at("cpu_time"), 2.5e5);
    EXPECT_EQ(row.at("ns_per_sample"), 2.5e5);
    EXPECT_EQ(row.at("record_ms"), 250.0);
    EXPECT_EQ(row.at("turns"), 1);
    EXPECT_EQ(row.at("times_peer"), 0.5);
    EXPECT_EQ(row.at("times_measured_peer"), 2.0);
    EXPECT_EQ(row.at("error_max"), 0.125);
    EXPECT_EQ(row.at("sums_compared"), 22);
    EXPECT_FALSE(row.contains("error_message"));
    EXPECT_EQ(bench::to_row(0.5, sizes[1], sizes[1].ways[1]).at("error_message"), "of noise");
}

TEST(RecordCase, TheTableHasALineForEachSizeAndWay) {
    EXPECT_EQ(
        bench::to_table(0.5, two_sizes()),
        "\nOrder 0.5\n"
        "   samples  how                    ms a record ns a sample times peer times measured of size before  error "
        "max\n"
        "      1000  whole_f64                  250.000    250000.0       0.50           2.00              -    "
        "0.0e+00\n"
        "      1000  peer_fftw_f64              500.000    500000.0       1.00           4.00              -    "
        "0.0e+00\n"
        "      1000  peer_fftwmeasured_f64      125.000    125000.0       0.25           1.00              -    "
        "0.0e+00\n"
        "      2000  whole_f64                 1000.000    500000.0       1.00           2.00            4.0    "
        "0.0e+00\n"
        "      2000  peer_fftw_f64             1000.000    500000.0       1.00           2.00            2.0    "
        "5.0e-01  WRONG: of noise\n"
        "      2000  peer_fftwmeasured_f64      500.000    250000.0       0.50           1.00            4.0    "
        "0.0e+00\n");
}

// Of a step of 0.9 the sums are 0.9 B_k, with B_k = prod_{i<=k} (1 - v/i); a window of 600 stays at B_599.
double step_sum(double order, std::size_t k) {
    double product = 0.9;
    for (std::size_t i = 1; i <= k; ++i) {
        product *= 1.0 - order / static_cast<double>(i);
    }
    return product;
}

TEST(RecordsStudy, IsHeldAgainstTheExactSumsOfAStep) {
    const bench::Records wanted{
        .samples = {300, 640}, .orders = {0.5, -0.5}, .signals = {"step"}, .repetitions = 2, .planning_s = 0.02};
    const std::clock_t start = std::clock();
    const bench::Study study = bench::measure_records(wanted);
    const double all_ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_EQ(study.wrong, 0U);
    ASSERT_EQ(study.rows.size(), 2U * 2U * 5U);
    const std::map<std::string, std::string> labels = {
        {"whole_f64", "all sums at once"},
        {"blocks_f64", "sample by sample; each may depend on the sum before"},
        {"window600_f64", "mirror_multi_f64"},
        {"peer_fftw_f64", "FFTW planned by its estimate as ours is"},
        {"peer_fftwmeasured_f64", "FFTW planned by timing for 0.02 s each way"},
    };
    double timed_ms = 0.0;
    std::size_t next = 0;
    std::string lines;
    for (const double order : wanted.orders) {
        lines += order == 0.5 ? "\nOrder 0.5\n" : "\nOrder -0.5\n";
        for (const std::size_t samples : wanted.samples) {
            for (const char* way :
                 {"whole_f64", "blocks_f64", "window600_f64", "peer_fftw_f64", "peer_fftwmeasured_f64"}) {
                const Json& row = study.rows[next++];
                EXPECT_EQ(row.at("name"), std::string("record/") + way + (order > 0 ? "/order:0.5" : "/order:-0.5") +
                                              (samples == 300 ? "/samples:300/host" : "/samples:640/host"));
                EXPECT_EQ(row.at("label"), labels.at(way));
                EXPECT_EQ(row.at("turns"), 2);
                EXPECT_GT(row.at("ns_per_sample").get<double>(), 0.0);
                timed_ms += 2.0 * row.at("record_ms").get<double>() * static_cast<double>(bench::runs_a_turn(samples));
                const double error = row.at("error_max").get<double>();
                if (samples == 640 && way == std::string("window600_f64")) {
                    const double largest = order > 0 ? 0.9 : step_sum(order, 639);
                    EXPECT_NEAR(error, std::fabs(step_sum(order, 599) - step_sum(order, 639)) / largest, 1e-13);
                } else {
                    EXPECT_LT(error, 1e-14) << row.dump();
                }
                if (way == std::string("peer_fftw_f64")) {
                    EXPECT_EQ(row.at("times_peer"), 1.0);
                }
                if (way == std::string("peer_fftwmeasured_f64")) {
                    EXPECT_EQ(row.at("times_measured_peer"), 1.0);
                }
            }
        }
    }
    EXPECT_LE(timed_ms, all_ms);  // what was timed was done
    EXPECT_NE(study.text.find("median of 2 interleaved turns"), std::string::npos);
    EXPECT_NE(study.text.find("against 50 digits at 22 samples"), std::string::npos);
    EXPECT_LT(study.text.find("\nOrder 0.5\n"), study.text.find("\nOrder -0.5\n"));
    EXPECT_NE(study.text.find("\nOrder -0.5\n"), std::string::npos);
    const Json& context = study.context;
    EXPECT_EQ(context.at("records"), Json({300, 640}));
    EXPECT_EQ(context.at("n_samples"), 640);
    EXPECT_EQ(context.at("sweep").at("orders"), Json({0.5, -0.5}));
    EXPECT_EQ(context.at("sweep").at("signals"), Json({"step"}));
    EXPECT_EQ(context.at("sweep").at("targets"), Json({"host"}));
    EXPECT_EQ(context.at("sweep").at("cores"), Json::array());
    EXPECT_NE(study.text.find(context.at("fftw").get<std::string>()), std::string::npos);
}

// The largest of the signals' errors, each relative to its own largest sum: a window forgets a step, not one impulse.
TEST(RecordsStudy, TheErrorIsTheWorstOfTheSignals) {
    bench::Records wanted{.samples = {640}, .orders = {0.5}, .signals = {"step"}, .repetitions = 1, .planning_s = 0.02};
    std::map<std::string, double> errors;
    const auto window_error = [&] { return bench::measure_records(wanted).rows[2].at("error_max").get<double>(); };
    const double step = window_error();
    wanted.signals = {"sine50"};
    const double sine = window_error();
    EXPECT_NE(step, sine);
    wanted.signals = {"sine50", "step"};
    EXPECT_EQ(window_error(), std::max(step, sine));
}

TEST(RecordsStudy, HasTheDocumentedDefaults) {
    const bench::Records wanted;
    EXPECT_EQ(wanted.orders, (std::vector<double>{0.5, -0.5}));
    EXPECT_EQ(wanted.signals, (std::vector<std::string>{"step", "sine5", "noise"}));
    EXPECT_EQ(wanted.repetitions, 9U);
    EXPECT_EQ(wanted.planning_s, 5.0);
}

}  // namespace
