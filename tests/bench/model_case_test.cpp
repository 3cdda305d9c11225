// A model stepped in real time: its rows and its tables by hand.
#include "bench/studies/model_case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "bench/studies/models.hpp"
#include "tests/drive/plants.hpp"

namespace {

using bench::Json;
using bench::ModelCase;
using drive::Memory;
using drive::Writing;

ModelCase made(const Memory& memory, const std::string& kernel = "ring_plain_f32", Writing writing = Writing::delta) {
    ModelCase one{"niopdt", drive::realtime_name(kernel, writing),
                  kernel,   writing,
                  false,    drive::RealtimeModel(plants::niopdt(), writing, memory, 0.001),
                  2000,     nullptr};
    one.error_max = 0.25;
    one.error_rms = 0.125;
    one.final_output = 0.75;
    one.host_ns = 50.5;
    one.macs = 102;
    return one;
}

qemu::MeasuredRow counted(std::uint64_t worst, std::size_t state_bytes, std::size_t coefficient_bytes) {
    qemu::MeasuredRow row{};
    row.status = glsum::Status::ok;
    row.instructions = 600.5;
    row.loads = 200.25;
    row.stores = 10.5;
    row.branches = 7.5;
    row.first = {700, 1, 2, 3};
    row.worst_instructions = worst;
    row.code_bytes = 1000;
    row.stack_bytes = 64;
    row.state_bytes = state_bytes;
    row.coefficient_bytes = coefficient_bytes;
    return row;
}

qemu::ModelledCall modelled(double cycles, double low, double high, double worst) {
    qemu::ModelledCall call{};
    call.cycles = cycles;
    call.low = low;
    call.high = high;
    call.first_cycles = 900.0;
    call.worst_cycles = worst;
    call.latency_cycles = cycles;
    return call;
}

TEST(ModelCase, OnTheHostARowHasErrorsAndTime) {
    ModelCase one = made({100});
    const Json row = bench::to_host_row(one);
    EXPECT_EQ(row.at("name"), "drive/niopdt/ringdelta_plain_f32/taps:100/host");
    EXPECT_EQ(row.at("iterations"), 2001);  // steps, and the first output
    EXPECT_EQ(row.at("error_max"), 0.25);
    EXPECT_EQ(row.at("error_rms"), 0.125);
    EXPECT_EQ(row.at("final_output"), 0.75);
    EXPECT_EQ(row.at("macs_per_sample"), 102);
    EXPECT_EQ(row.at("effective_taps"), 100);
    EXPECT_EQ(row.at("horizon_samples"), 100);
    EXPECT_EQ(row.at("real_time"), 50.5);
    EXPECT_EQ(row.at("cpu_time"), 50.5);
    EXPECT_EQ(row.at("ns_per_sample"), 50.5);
    for (const char* not_here : {"saturations", "instructions_per_sample", "error_message"}) {
        EXPECT_FALSE(row.contains(not_here)) << not_here;
    }
    one.full = true;
    EXPECT_EQ(bench::to_host_row(one).at("name"), "drive/niopdt/ringdelta_plain_f32/taps:full/host");
    one.fault = "the coefficients do not fit the format";
    EXPECT_EQ(bench::to_host_row(one).at("error_message"), "the coefficients do not fit the format");
    EXPECT_FALSE(bench::to_host_row(one).contains("ns_per_sample"));
}

TEST(ModelCase, ModesHaveNoWindowAndFixedPointSaturates) {
    const ModelCase modes = made({16, 7}, "modes_plain_f32");
    const Json row = bench::to_host_row(modes);
    EXPECT_EQ(row.at("name"), "drive/niopdt/modesdelta_plain_f32/taps:2+7/host");
    EXPECT_FALSE(row.contains("effective_taps"));
    EXPECT_EQ(row.at("horizon_samples"), 2000);  // all that was stepped
    ModelCase fixed = made({100}, "ring_plain_q31");
    fixed.saturations = 3;
    EXPECT_EQ(bench::to_host_row(fixed).at("saturations"), 3);
}

TEST(ModelCase, OnTheTargetARowHasItsCounts) {
    ModelCase one = made({100});
    one.counted = {{counted(21600, 800, 400), true}};
    const Json row = bench::to_target_row(one, one.counted[0], "m7:count");
    EXPECT_EQ(row.at("name"), "drive/niopdt/ringdelta_plain_f32/taps:100/m7:count");
    EXPECT_EQ(row.at("label"), "instructions only");
    EXPECT_EQ(row.at("instructions_per_sample"), 600.5);
    EXPECT_EQ(row.at("loads_per_sample"), 200.25);
    EXPECT_EQ(row.at("stores_per_sample"), 10.5);
    EXPECT_EQ(row.at("branches_per_sample"), 7.5);
    EXPECT_EQ(row.at("first_instructions"), 700);
    EXPECT_EQ(row.at("worst_instructions"), 21600);
    EXPECT_DOUBLE_EQ(row.at("instructions_share_of_period").get<double>(), 0.1);  // of 216 000
    EXPECT_EQ(row.at("code_bytes"), 1000);
    EXPECT_EQ(row.at("stack_bytes"), 64);
    EXPECT_EQ(row.at("state_bytes"), 800);
    EXPECT_EQ(row.at("coefficient_bytes"), 400);
    for (const char* not_here : {"ns_per_sample", "model_cycles_per_sample", "share_of_period", "error_message"}) {
        EXPECT_FALSE(row.contains(not_here)) << not_here;
    }
    one.kernel = "ring_oldest_f64";
    EXPECT_EQ(bench::to_target_row(one, one.counted[0], "m7:count").at("label"),
              "instructions only; double precision in software, where the count depends on the data");
    one.counted[0].same_bits = false;
    EXPECT_EQ(bench::to_target_row(one, one.counted[0], "m7:count").at("error_message"),
              "the target's outputs differ from the host's");
}

TEST(ModelCase, OfAModelledCoreItHasTheCyclesToo) {
    ModelCase one = made({100});
    one.counted = {{counted(21600, 800, 400), true}};
    one.counted[0].row.cores = {modelled(1.0, 1.0, 1.0, 1.0), modelled(500.0, 450.0, 550.0, 40000.0)};
    Json row = bench::to_target_row(one, one.counted[0], "m7:other", 1, 400e6);
    EXPECT_EQ(row.at("label"), "modelled cycles");
    EXPECT_EQ(row.at("instructions_per_sample"), 600.5);
    EXPECT_EQ(row.at("model_cycles_per_sample"), 500.0);
    EXPECT_EQ(row.at("model_cycles_low"), 450.0);
    EXPECT_EQ(row.at("model_cycles_high"), 550.0);
    EXPECT_EQ(row.at("worst_model_cycles"), 40000.0);
    EXPECT_DOUBLE_EQ(row.at("real_time").get<double>(), 1250.0);     // ns at 400 MHz
    EXPECT_DOUBLE_EQ(row.at("share_of_period").get<double>(), 0.1);  // of 400 000 cycles in 1 ms
    one.counted[0].row.unknown_encodings = {0x08001234, 0x08004321};
    row = bench::to_target_row(one, one.counted[0], "m7:other", 1, 400e6);
    EXPECT_EQ(row.at("error_message"), "the timing model does not know 2 encodings, the first at 0x08001234");
    EXPECT_FALSE(
        bench::to_target_row(one, one.counted[0], "m7:count").contains("error_message"));  // counts need no model
}

TEST(ModelCase, SoftwareDoubleRunsOnTheTargetUpToSixHundredTaps) {
    EXPECT_FALSE(made({601}).in_double());
    EXPECT_TRUE(made({601}).runs_on_target());
    EXPECT_TRUE(made({600}, "ring_oldest_f64").in_double());
    EXPECT_TRUE(made({600}, "ring_oldest_f64").runs_on_target());
    EXPECT_FALSE(made({601}, "ring_oldest_f64").runs_on_target());
}

TEST(ModelCase, TheTableIsOfItsModel) {
    std::vector<ModelCase> cases;
    cases.push_back(made({100}));
    cases.push_back(made({100}));
    cases[1].counted = {{counted(21600, 800, 400), true}};
    cases[1].saturations = 5;
    cases.push_back(made({100}));
    cases[2].counted = {{counted(21600, 800, 400), true}};
    cases[2].counted[0].row.cores = {modelled(500.0, 500.0, 500.0, 43200.0)};
    cases[2].counted[0].same_bits = false;
    cases.push_back(made({100}));
    cases[3].counted = {{counted(21600, 800, 400), true}};
    cases[3].counted[0].row.cores = {modelled(500.0, 450.0, 550.0, 43200.0)};
    cases.push_back(made({100}));
    cases[4].fault = "no taps";
    cases.push_back(made({100}));
    cases[5].model = "other";
    EXPECT_EQ(
        bench::to_table(cases, "niopdt"),
        "\nniopdt\n"
        "  kernel                         taps  MACs for s  error max at the end  M7 instr.      model cycles   "
        "period    bytes  host ns\n"
        "  ringdelta_plain_f32             100   102     2   2.50e-01    0.75000          -                 -     "
        "   -        -  50.5\n"
        "  ringdelta_plain_f32             100   102     2   2.50e-01    0.75000      600.5                 -   "
        "10.00%     1200  50.5  5 saturations\n"
        "  ringdelta_plain_f32             100   102     2   2.50e-01    0.75000      600.5               500   "
        "20.00%     1200  50.5  NOT THE HOST'S BITS\n"
        "  ringdelta_plain_f32             100   102     2   2.50e-01    0.75000      600.5     500 (450-550)   "
        "20.00%     1200  50.5\n"
        "  ringdelta_plain_f32             100 no taps\n");
}

TEST(ModelCase, MachinesStandBesideEachOther) {
    std::vector<ModelCase> cases;
    cases.push_back(made({100}));
    cases[0].counted = {{counted(21600, 800, 400), true}, {counted(2400, 800, 400), false}};
    cases[0].counted[1].row.cores = {modelled(900.0, 850.0, 950.0, 1200.0)};
    EXPECT_EQ(bench::to_table(cases, "niopdt", {{"M7", 216000.0}, {"M4", 24000.0}}),
              "\nniopdt\n"
              "  kernel                         taps  MACs for s  error max at the end  M7 instr.      model cycles   "
              "period  M4 instr.      model cycles   period    bytes  host ns\n"
              "  ringdelta_plain_f32             100   102     2   2.50e-01    0.75000      600.5                 -   "
              "10.00%      600.5     900 (850-950)    5.00%     1200  50.5  NOT THE HOST'S BITS\n");
}

// Straight lines: 6 instructions and 12 bytes a tap.
TEST(ModelCase, TheLongestMemoryIsByTheLineThroughTheShortestAndTheLongest) {
    std::vector<ModelCase> cases;
    const auto add = [&](const Memory& memory, std::uint64_t worst, std::size_t state, std::size_t coefficients,
                         const std::string& kernel = "ring_plain_f32") {
        cases.push_back(made(memory, kernel));
        cases.back().counted = {{counted(worst, state, coefficients), true}};
    };
    add({200}, 5000, 5000, 5000);  // between them: of no weight
    add({600}, 3700, 4800, 2400);
    add({100}, 700, 800, 400);
    add({50}, 1, 1, 1);
    cases.back().fault = "of no weight either";
    cases.push_back(made({40}));  // not counted
    add({100}, 700, 800, 400, "mirror_multi_f32");
    add({131}, 900, 900, 900, "mirror_multi_f32");  // too close to tell
    add({100}, 700, 800, 400, "ring_oldest_f32");
    add({132}, 764, 832, 400, "ring_oldest_f32");
    add({16, 7}, 1, 1, 1, "modes_plain_f32");
    add({20, 9}, 2, 2, 2, "modes_plain_f32");
    const std::string table = bench::deadline_table(cases);
    // 100 + (216000 - 700)/6, and 100 + (320 * 1024 - 1200)/12.
    EXPECT_NE(table.find("  niopdt     ringdelta_plain_f32                      6.00           12.0            35983   "
                         "         27306\n"),
              std::string::npos)
        << table;
    // 100 + 215300/2, and 100 + 326480/1.
    EXPECT_NE(table.find("  niopdt     ringdelta_oldest_f32                     2.00            1.0           107750   "
                         "        326580\n"),
              std::string::npos)
        << table;
    EXPECT_EQ(table.find("mirror"), std::string::npos) << table;
    EXPECT_EQ(table.find("modes"), std::string::npos) << table;
}

}  // namespace
