// Models stepped in real time: errors against closed forms and each case by itself, on a board that is pretended.
#include "bench/studies/models.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/failure.hpp"
#include "base/files.hpp"
#include "base/scratch.hpp"
#include "base/sha256.hpp"
#include "bench/target/target_rows.hpp"
#include "drive/model_file.hpp"
#include "drive/response.hpp"
#include "qemu/emulate/model_run.hpp"
#include "tests/drive/plants.hpp"
#include "tests/qemu/made_emulator.hpp"
#include "tests/qemu/made_program.hpp"

namespace {

using bench::Json;
using drive::Memory;
using drive::Writing;

// Of the project's three models, without a board.
bench::Models host_only(std::vector<std::string> kernels) {
    bench::Models wanted;
    wanted.kernels = std::move(kernels);
    wanted.targets = {"host"};
    wanted.models = TEST_PROJECT "/drive/models";
    wanted.quick = true;
    return wanted;
}

bench::Study measured(const bench::Models& wanted, std::vector<std::string>* said = nullptr) {
    return bench::measure_models(wanted, [&](const std::string& what) {
        if (said == nullptr) {
            ADD_FAILURE() << what;
        } else {
            said->push_back(what);
        }
    });
}

std::vector<std::string> names_of(const bench::Study& study) {
    std::vector<std::string> names;
    for (const Json& row : study.rows) {
        names.push_back(row.at("name"));
    }
    return names;
}

// A board that is pretended, whose firmware steps models with one kernel: a step takes 100 instructions and so many
// cycles, and what is answered are these hashes, one after the other.
class PretendStepper {
public:
    PretendStepper(const std::string& kernel, int cycles, const std::vector<std::uint64_t>& hashes,
                   const base::Machine& machine) {
        test::MadeElf made = test::program();
        made.sections = {
            {0x1000, {kernel.begin(), kernel.end()}},
            {0x2000, test::bytes_of({0x1000, static_cast<std::uint32_t>(kernel.size()), test::ring + 1, 1})}};
        made.symbols[0] = {"glsum_watched", 0x2000, 12};
        made.symbols[1] = {"glsum_watched_count", 0x200C, 4};
        made.write(folder_.file("model.elf"));
        std::ofstream(folder_.file("build_info.json")) << R"({"compiler": "GNU 12.2.1", "flags": "-O3"})";
        std::ofstream answers(folder_.file("hashes"));
        for (const std::uint64_t hash : hashes) {
            answers << fmt::format("{:x}\n", hash);
        }
        std::string losses;
        for (std::size_t e = 0; e < timing::effect_count; ++e) {
            losses += " 0";
        }
        // Timed are the first step, and of the last 32 the first 8 with two before them.
        const std::string body = fmt::format(R"sh(for plan; do :; done
tail -n +2 "$plan" >rows
wc -l <rows >>runs
while read -r kernel increments half delay steps rest; do
    echo "calls {0} $((steps + 1)) 100 9 9 9"
done <rows >"$(of out)"
{{ echo "reached {0} {0}"; echo end; }} >>"$(of out)"
while read -r row; do
    echo "calls 11 {0} 100 core 1 {2}{1} 0"; echo end
done <rows >"$(of times)"
n=0
while read -r row; do
    n=$((n + 1)); echo "row $((n - 1)) 0 $(sed -n "${{n}}p" hashes) 12 34 56"
done <rows
sed "1,${{n}}d" hashes >left; mv left hashes
echo "end $n"
)sh",
                                             test::ring, losses, 2 * cycles);
        board.board = {folder_.file("measure.elf"),
                       folder_.file("measure.elf"),
                       "x.so",
                       test::made_emulator(folder_, body),
                       TEST_CORES,
                       &machine};
        board.cores = {std::string(machine.default_core)};
    }
    /// How many models were stepped by each run of it.
    [[nodiscard]] std::vector<int> runs() const {
        std::ifstream in(folder_.file("runs"));
        return {std::istream_iterator<int>(in), {}};
    }

    bench::ModelBoard board;

private:
    base::Scratch folder_;
};

TEST(ModelsStudy, EachMachineStepsThemAtItsCostAndItsBitsAreTheHosts) {
    const auto model = [](const char* name) {
        const std::string path = std::string(TEST_PROJECT "/drive/models/") + name + ".json";
        return drive::parse_model(base::read_file(path, drive::most_model_bytes), path);
    };
    const std::vector<double> one{1.0};
    std::vector<std::uint64_t> hashes;
    const auto hash = [&](const char* name, std::size_t taps, std::size_t steps) {
        const drive::RealtimeModel design(model(name), Writing::delta, Memory{taps}, 0.001);
        hashes.push_back(qemu::step_model_here({"ring_plain_f32", &design.design(), one, steps}).hash);
    };
    // Of whole orders there is one length; more than the firmware has room for at once, in two runs.
    hash("fopdt", 1, 6228);
    hash("sopdt", 2, 6064);
    bench::Models wanted = host_only({"ringdelta_plain_f32"});
    for (std::size_t taps = 10; taps < 29; ++taps) {
        hash("niopdt", taps, 6000);
        wanted.lengths.emplace_back(Memory{taps});
    }
    const PretendStepper m7("ring_plain_f32", 300, hashes, base::machines[0]);
    hashes[20] ^= 1;  // of 28 taps
    const PretendStepper m4("ring_plain_f32", 600, hashes, base::machines[1]);
    const base::Scratch folder;
    std::ofstream(folder.file("qemu")) << "#!/bin/sh\necho QEMU emulator version 7.2.22\n";
    std::filesystem::permissions(folder.file("qemu"), std::filesystem::perms::owner_all);
    setenv("GLSUM_QEMU", folder.file("qemu").c_str(), 1);
    wanted.targets = {"m7", "m4"};
    wanted.boards = {m7.board, m4.board};
    const bench::Study study = measured(wanted);
    unsetenv("GLSUM_QEMU");
    EXPECT_EQ(m7.runs(), (std::vector<int>{20, 1}));
    EXPECT_EQ(m4.runs(), m7.runs());
    EXPECT_EQ(study.wrong, 1U);
    ASSERT_EQ(study.rows.size(), 21U * 4U);
    const char* const names[] = {"/m7:count", "/m7:stm32f746-itcm", "/m4:count", "/m4:cortex-m4-zerowait"};
    for (std::size_t i = 0; i < study.rows.size(); ++i) {
        const Json& row = study.rows[i];
        const auto name = row.at("name").get<std::string>();
        const std::string design = i / 4 == 0   ? "fopdt/ringdelta_plain_f32/taps:1"
                                   : i / 4 == 1 ? "sopdt/ringdelta_plain_f32/taps:2"
                                                : fmt::format("niopdt/ringdelta_plain_f32/taps:{}", 8 + i / 4);
        EXPECT_EQ(name, "drive/" + design + names[i % 4]);
        EXPECT_EQ(row.at("instructions_per_sample"), 100.0) << name;
        EXPECT_EQ(row.contains("error_message"), i / 4 == 20 && i % 4 >= 2) << name;
        const double clock = i % 4 < 2 ? 216e6 : 24e6;
        EXPECT_DOUBLE_EQ(row.at("instructions_share_of_period").get<double>(), 100.0 / (0.001 * clock)) << name;
        ASSERT_EQ(row.contains("model_cycles_per_sample"), i % 2 == 1) << name;
        if (i % 2 == 1) {
            const double cycles = i % 4 == 1 ? 300.0 : 600.0;
            EXPECT_DOUBLE_EQ(row.at("model_cycles_per_sample").get<double>(), cycles) << name;
            EXPECT_DOUBLE_EQ(row.at("real_time").get<double>(), cycles / clock * 1e9) << name;
        }
    }
    EXPECT_THAT(study.text, testing::HasSubstr("\n  M7: instructions a step on the emulated core"));
    EXPECT_THAT(study.text, testing::HasSubstr("the cycles of a step on stm32f746-itcm"));
    EXPECT_THAT(study.text, testing::HasSubstr("the cycles of a step on cortex-m4-zerowait"));
    // The program that was run is that which steps models.
    EXPECT_EQ(study.context.at("elf_sha256"), base::sha256_of(qemu::model_elf(m7.board.board)));
}

// T (y_k - y_(k-1))/h + y_k = 1 is y_k = 1 - (1 + h/T)^-(k-d); the exact answer is 1 - exp(-(t - 1.2279)/T).
TEST(ModelsStudy, FirstOrderErrsAsEulersSchemeDoes) {
    const bench::Study study = measured(host_only({"ring_oldest_f64"}));
    EXPECT_EQ(study.wrong, 0U);
    double largest = 0.0;
    double square = 0.0;
    double peak = 0.0;
    double last = 0.0;
    const int steps = 5000 + 1228;
    for (int k = 0; k <= steps; ++k) {
        const double exact = k * 1e-3 > 1.2279 ? 1.0 - std::exp(-(k * 1e-3 - 1.2279) / 0.4934) : 0.0;
        last = k > 1228 ? 1.0 - std::pow(1.0 + 1e-3 / 0.4934, -(k - 1228)) : 0.0;
        largest = std::max(largest, std::fabs(last - exact));
        square += (last - exact) * (last - exact);
        peak = std::max(peak, exact);
    }
    for (const char* writing : {"ringdelta", "ring", "ringapart"}) {
        const std::string begin = std::string("drive/fopdt/") + writing + "_oldest_f64/";
        const auto row = std::find_if(study.rows.begin(), study.rows.end(), [&](const Json& one) {
            return one.at("name").get<std::string>().starts_with(begin);
        });
        ASSERT_NE(row, study.rows.end()) << begin;
        EXPECT_EQ(row->at("iterations"), steps + 1);
        EXPECT_NEAR(row->at("error_max").get<double>(), largest / peak, 2e-9) << begin;
        EXPECT_NEAR(row->at("error_rms").get<double>(), std::sqrt(square / (steps + 1)) / peak, 2e-9) << begin;
        EXPECT_NEAR(row->at("final_output").get<double>(), last, 1e-11) << begin;
        EXPECT_GT(row->at("ns_per_sample").get<double>(), 0.5);
        EXPECT_LT(row->at("ns_per_sample").get<double>(), 1e6);
    }
}

TEST(ModelsStudy, MeasuresEachWritingAtItsUsualLengths) {
    bench::Models wanted = host_only({"ring_oldest_f64", "modes*_plain_f32"});
    wanted.quick = false;
    wanted.long_records = {200, 400, 1600};
    const bench::Study study = measured(wanted);
    // Whole orders end their memory by themselves: of model (10) and (11) there is one length.
    EXPECT_EQ(
        names_of(study),
        (std::vector<std::string>{
            "drive/fopdt/ringdelta_oldest_f64/taps:1/host",     "drive/fopdt/ringbdf2_oldest_f64/taps:2/host",
            "drive/fopdt/ring_oldest_f64/taps:2/host",          "drive/fopdt/ringapart_oldest_f64/taps:2/host",
            "drive/sopdt/ringdelta_oldest_f64/taps:2/host",     "drive/sopdt/ringbdf2_oldest_f64/taps:4/host",
            "drive/sopdt/ring_oldest_f64/taps:3/host",          "drive/sopdt/ringapart_oldest_f64/taps:3/host",
            "drive/niopdt/ringdelta_oldest_f64/taps:50/host",   "drive/niopdt/ringdelta_oldest_f64/taps:100/host",
            "drive/niopdt/ringdelta_oldest_f64/taps:200/host",  "drive/niopdt/ringdelta_oldest_f64/taps:600/host",
            "drive/niopdt/ringdelta_oldest_f64/taps:full/host", "drive/niopdt/modesdelta_plain_f32/taps:2+5/host",
            "drive/niopdt/modesdelta_plain_f32/taps:2+7/host",  "drive/niopdt/modesdelta_plain_f32/taps:2+9/host",
            "drive/niopdt/ringbdf2_oldest_f64/taps:100/host",   "drive/niopdt/ringbdf2_oldest_f64/taps:600/host",
            "drive/niopdt/modesbdf2_plain_f32/taps:5+9/host",   "drive/niopdt/modesbdf2_plain_f32/taps:5+11/host",
            "drive/niopdt/ring_oldest_f64/taps:50/host",        "drive/niopdt/ring_oldest_f64/taps:100/host",
            "drive/niopdt/ring_oldest_f64/taps:200/host",       "drive/niopdt/ring_oldest_f64/taps:600/host",
            "drive/niopdt/ring_oldest_f64/taps:full/host",      "drive/niopdt/ringapart_oldest_f64/taps:50/host",
            "drive/niopdt/ringapart_oldest_f64/taps:100/host",  "drive/niopdt/ringapart_oldest_f64/taps:200/host",
            "drive/niopdt/ringapart_oldest_f64/taps:600/host",  "drive/niopdt/ringapart_oldest_f64/taps:full/host",
            "drive/niopdt/blockdelta_fft_f64/taps:200/host",    "drive/niopdt/blockdelta_fft_f64/taps:400/host",
            "drive/niopdt/blockdelta_fft_f64/taps:1600/host",
        }));
    // A window is stepped for 5 s behind the dead time, modes for a minute.
    for (const Json& row : study.rows) {
        const std::string name = row.at("name");
        const std::size_t delay = name.find("fopdt") != std::string::npos   ? 1228
                                  : name.find("sopdt") != std::string::npos ? 1064
                                                                            : 1000;
        if (name.find("block") == std::string::npos) {
            EXPECT_EQ(row.at("iterations"), (name.find("modes") != std::string::npos ? 60'000 : 5'000) + delay + 1)
                << name;
        }
        EXPECT_GT(row.at("ns_per_sample").get<double>(), 0.5) << name;
        EXPECT_EQ(row.at("cpu_time"), row.at("ns_per_sample"));
        EXPECT_EQ(row.at("real_time"), row.at("ns_per_sample"));
    }
    // Lines of the long records, one for each, and how the time grows from the last but one to the last.
    const std::string lines = study.text.substr(study.text.find("\nFull memory on this machine"));
    const auto ns = [&](std::size_t from_last) {
        return study.rows[study.rows.size() - from_last].at("ns_per_sample").get<double>();
    };
    EXPECT_NE(
        lines.find(fmt::format("\n       200 samples {:>10.4f} s {:>10.1f} ns a sample\n", ns(3) * 200e-9, ns(3))),
        std::string::npos)
        << lines;
    EXPECT_TRUE(lines.ends_with(fmt::format("  t(1600)/t(400) = {:.1f}\n", 4.0 * ns(1) / ns(2)))) << lines << ns(1);
    EXPECT_EQ(study.rows.back().at("iterations"), 1600);
    EXPECT_EQ(study.context.at("n_samples"), 5000);
    EXPECT_EQ(study.context.at("sweep").at("orders"), Json::array());
    EXPECT_EQ(study.context.at("sweep").at("targets"), Json({"host"}));
    EXPECT_EQ(study.context.at("sweep").at("kernels"), Json({"ring_oldest_f64", "modes*_plain_f32"}));
    for (const char* of_sums : {"target_count_order", "weights", "first_weights"}) {
        EXPECT_FALSE(study.context.contains(of_sums)) << of_sums;
    }
    EXPECT_EQ(study.text.find("gives it on"), std::string::npos);  // nothing was counted
    EXPECT_EQ(study.text.find("The longest memory"), std::string::npos);
    EXPECT_LT(study.text.find("\nfopdt\n"), study.text.find("\nsopdt\n"));
    EXPECT_LT(study.text.find("\nsopdt\n"), study.text.find("\nniopdt\n"));
}

TEST(ModelsStudy, QuicklyItTakesTwoLengthsAndNoLongRecords) {
    EXPECT_THAT(names_of(measured(host_only({"ringdelta_oldest_f64"}))),
                testing::ElementsAre("drive/fopdt/ringdelta_oldest_f64/taps:1/host",
                                     "drive/sopdt/ringdelta_oldest_f64/taps:2/host",
                                     "drive/niopdt/ringdelta_oldest_f64/taps:100/host",
                                     "drive/niopdt/ringdelta_oldest_f64/taps:600/host"));
    const bench::Models defaults;
    EXPECT_EQ(defaults.long_records, (std::vector<std::size_t>{5000, 100'000, 1'000'000}));
    EXPECT_FALSE(defaults.quick);
    EXPECT_EQ(defaults.jobs, 1U);
    EXPECT_EQ(defaults.targets, (std::vector<std::string>{"host", "m7"}));
}

// Lengths with modes are of kernels with modes, the others of windows. What cannot be is said and left out.
TEST(ModelsStudy, LengthsThatWereAskedForAreTheKernelsOwn) {
    bench::Models wanted = host_only({"ringdelta_oldest_f64", "modesdelta_plain_f32"});
    wanted.lengths = {Memory{80}, Memory{16, 7}, Memory{3, 1}, std::nullopt};
    std::vector<std::string> said;
    EXPECT_THAT(names_of(measured(wanted, &said)),
                testing::ElementsAre("drive/fopdt/ringdelta_oldest_f64/taps:1/host",
                                     "drive/sopdt/ringdelta_oldest_f64/taps:2/host",
                                     "drive/niopdt/ringdelta_oldest_f64/taps:80/host",
                                     "drive/niopdt/ringdelta_oldest_f64/taps:full/host",
                                     "drive/niopdt/modesdelta_plain_f32/taps:2+7/host"));
    ASSERT_EQ(said.size(), 1U);
    EXPECT_TRUE(said[0].starts_with(
        "left out: niopdt modesdelta_plain_f32: expected modes on increments and behind at least 2 taps, found 1+1"))
        << said[0];
}

// Each case stepped by itself, against the exact response of its model.
TEST(ModelsStudy, ErrorsAreThoseOfTheSteppedModel) {
    bench::Models wanted = host_only({"ringdelta_plain_q31", "modesdelta_plain_f32"});
    wanted.lengths = {Memory{80}, Memory{16, 7}};
    const bench::Study study = measured(wanted);
    const double delay_s = plants::niopdt().delay_s;
    EXPECT_EQ(delay_s, 1.0);
    for (const auto& [kernel, memory, steps] : {std::tuple("ring_plain_q31", Memory{80}, std::size_t{6000}),
                                                std::tuple("modes_plain_f32", Memory{16, 7}, std::size_t{61'000})}) {
        const drive::RealtimeModel design(plants::niopdt(), Writing::delta, memory, 1e-3, 60'000);
        const std::vector<double> ones{1.0};
        const qemu::SteppedModel stepped = qemu::step_model_here({kernel, &design.design(), ones, steps});
        std::vector<double> times;
        for (std::size_t k = 0; k <= steps; ++k) {
            times.push_back(1e-3 * static_cast<double>(k));
        }
        const std::vector<double> exact =
            drive::respond(plants::niopdt(), std::vector<drive::Change>{{0.0, 1.0}}, times);
        double largest = 0.0;
        double square = 0.0;
        double peak = 0.0;
        for (std::size_t k = 0; k <= steps; ++k) {
            largest = std::max(largest, std::fabs(stepped.output[k] - exact[k]));
            square += std::pow(stepped.output[k] - exact[k], 2.0);
            peak = std::max(peak, std::fabs(exact[k]));
        }
        const std::string begin = "drive/niopdt/" + drive::realtime_name(kernel, Writing::delta);
        const auto row = std::find_if(study.rows.begin(), study.rows.end(), [&](const Json& one) {
            return one.at("name").get<std::string>().starts_with(begin);
        });
        ASSERT_NE(row, study.rows.end());
        EXPECT_NEAR(row->at("error_max").get<double>(), largest / peak, 1e-12);
        EXPECT_NEAR(row->at("error_rms").get<double>(), std::sqrt(square / static_cast<double>(steps + 1)) / peak,
                    1e-12);
        EXPECT_EQ(row->at("final_output"), stepped.output.back());
        EXPECT_EQ(row->at("macs_per_sample"), stepped.multiplications);
        EXPECT_EQ(row->contains("saturations"), std::string(kernel) == "ring_plain_q31");
    }
}

TEST(ModelsStudy, HasTheDocumentedDefaults) {
    const bench::Models wanted;
    EXPECT_EQ(wanted.kernels, std::vector<std::string>{"*"});
    EXPECT_TRUE(wanted.lengths.empty());
    EXPECT_EQ(wanted.targets, (std::vector<std::string>{"host", "m7"}));
    EXPECT_TRUE(wanted.boards.empty());
    EXPECT_FALSE(wanted.quick);
    EXPECT_EQ(wanted.long_records, (std::vector<std::size_t>{5000, 100000, 1000000}));
    EXPECT_EQ(wanted.jobs, 1U);
}

TEST(ModelsStudy, RefusesKernelsThatStepNoModel) {
    try {
        (void)measured(host_only({"shift_plain_f32"}));
        FAIL();
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        EXPECT_NE(std::string(failure.what()).find("models are stepped with ring_plain_f32"), std::string::npos);
        EXPECT_NE(std::string(failure.what()).find("found shift_plain_f32"), std::string::npos);
    }
}

// The same models, stepped on each board by themselves.
TEST(ModelsStudy, OnBoardsRowsAreTheirCounts) {
    bench::Models wanted = host_only({"ringdelta_plain_f32", "ringdelta_oldest_f64"});
    try {
        wanted.boards = {
            {qemu::find_board(TEST_FIRMWARE_BUILD, TEST_PLUGIN, TEST_EMULATE), {"stm32f746-itcm", "stm32h747-dtcm"}},
            {qemu::find_board(TEST_M4_FIRMWARE_BUILD, TEST_PLUGIN, TEST_M4_EMULATE), {"stm32h747-m4"}}};
        for (bench::ModelBoard& on : wanted.boards) {
            (void)qemu::model_elf(on.board);
            on.board.cores = TEST_CORES;
        }
        (void)qemu::emulator_version();
    } catch (const glsum::Failure& failure) {
        if (std::getenv("GLSUM_REQUIRE_FIRMWARE") != nullptr) {
            FAIL() << failure.what();
        }
        GTEST_SKIP() << failure.what();
    }
    wanted.boards[0].board.machine = base::machine_called("m7");
    wanted.boards[1].board.machine = base::machine_called("m4");
    wanted.targets = {"m7", "m4"};
    wanted.lengths = {Memory{40}, Memory{100}, std::nullopt};
    const bench::Study study = measured(wanted);
    EXPECT_EQ(study.wrong, 0U);
    std::set<std::string> names;
    for (const std::string& name : names_of(study)) {
        names.insert(name);
        EXPECT_EQ(name.find("/host"), std::string::npos);                      // it was not asked for
        EXPECT_TRUE(name.find("f64/taps:full") == std::string::npos) << name;  // minutes in software
    }
    const drive::RealtimeModel design(plants::niopdt(), Writing::delta, {40}, 1e-3);
    const std::vector<double> ones{1.0};
    for (const bench::ModelBoard& on : wanted.boards) {
        const auto timing = bench::timing_request(TEST_CORES, on.cores);
        const std::vector<double> clocks = bench::clocks_of(timing);
        const auto counted = qemu::step_models(
            on.board, std::vector<qemu::PlannedModel>{{"ring_plain_f32", &design.design(), ones, 6000}}, [] {}, timing);
        const auto row = [&](const std::string& core) {
            return *std::find_if(study.rows.begin(), study.rows.end(), [&](const Json& one) {
                return one.at("name") ==
                       "drive/niopdt/ringdelta_plain_f32/taps:40/" + bench::on_target(*on.board.machine, core);
            });
        };
        EXPECT_EQ(row("count").at("instructions_per_sample"), counted[0].instructions);
        for (std::size_t c = 0; c < on.cores.size(); ++c) {
            const double cycles = counted[0].cores[c].cycles;
            EXPECT_EQ(row(on.cores[c]).at("model_cycles_per_sample"), cycles);
            EXPECT_DOUBLE_EQ(row(on.cores[c]).at("real_time").get<double>(), 1e9 * cycles / clocks[c]);
        }
        EXPECT_NE(study.text.find("gives it on " + on.cores[0] + ","), std::string::npos);
    }
    EXPECT_EQ(names.count("drive/niopdt/ringdelta_plain_f32/taps:full/m7:count"), 1U);
    EXPECT_NE(study.text.find(" M7 instr.      model cycles   period  M4 instr.      model cycles   period    bytes "),
              std::string::npos);
    EXPECT_NE(study.text.find("The longest memory at 1 kHz on an M7, 216 000 cycles a step"), std::string::npos);
    EXPECT_NE(study.text.find("The longest memory at 1 kHz on an M4, 24 000 cycles a step"), std::string::npos);
    EXPECT_NE(study.text.find("the worst step's cycles over\n  24 000, the cycles of a step on cortex-m4-zerowait."),
              std::string::npos);
}

}  // namespace
