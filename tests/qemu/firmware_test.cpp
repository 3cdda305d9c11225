// The emulated Cortex-M7: its counts, and the same bits as this machine. And the Cortex-M4's bits.
#include "qemu/emulate/firmware.hpp"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "base/failure.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/signals.hpp"
#include "bench/target/count_path.hpp"
#include "glsum/registry.hpp"

namespace {

class FirmwareTest : public testing::Test {
protected:
    void SetUp() override {
        try {
            board_ = qemu::find_board(firmware_build(), TEST_PLUGIN, emulate_script());
            (void)qemu::emulator_version();
        } catch (const glsum::Failure& failure) {
            if (std::getenv("GLSUM_REQUIRE_FIRMWARE") != nullptr) {
                FAIL() << failure.what();
            }
            GTEST_SKIP() << failure.what();
        }
        for (const std::string_view name : bench::signal_names) {
            signals_.push_back(bench::make_signal(name, 400, 11));
        }
    }
    [[nodiscard]] virtual const char* firmware_build() const { return TEST_FIRMWARE_BUILD; }
    [[nodiscard]] virtual const char* emulate_script() const { return TEST_EMULATE; }
    void expect_the_bits_of_this_machine();
    qemu::Board board_;
    qemu::Signals signals_;
};
class CortexM4FirmwareTest : public FirmwareTest {
protected:
    [[nodiscard]] const char* firmware_build() const override { return TEST_M4_FIRMWARE_BUILD; }
    [[nodiscard]] const char* emulate_script() const override { return TEST_M4_EMULATE; }
};

template <class Visit>
void for_each_target_kernel(Visit visit) {
    glsum::Registry::for_each([&]<class K>() {
        if (!K::host_only) {
            visit(std::string(K::name()));
        }
    });
}

void FirmwareTest::expect_the_bits_of_this_machine() {
    std::vector<qemu::PlannedRow> plan;
    for_each_target_kernel([&](const std::string& kernel) {
        for (const double order : {0.5, 0.98319, 1.9909, 2.0, -0.5, -1.3}) {
            for (const std::size_t taps : {1U, 2U, 3U, 50U, 101U}) {
                for (std::size_t signal = 0; signal < signals_.size(); ++signal) {
                    plan.push_back({kernel, order, taps, signal, 2 * taps + 60});
                }
            }
        }
        if (bench::has_modes(kernel)) {
            const std::string designed = bench::has_integrator(kernel) ? kernel : "modes_plain_f32";
            for (const double order : {0.5, 1.9909, -0.5}) {
                if (bench::has_integrator(kernel) && order > 0.0) {
                    continue;
                }
                for (const std::size_t taps : {3U, 16U, 31U}) {
                    const auto modes =
                        bench::design_of(designed, order, bench::length_with_modes(designed, order, taps), 1000).modes;
                    plan.push_back({kernel, order, taps, taps % signals_.size(), 1100, {modes.begin(), modes.end()}});
                    ASSERT_EQ(plan.back().modes.empty(), taps == 3 && order > 1.0);
                }
            }
        }
    });
    for (const char* kernel : {"nested_plain_f64", "nested_plain_f32", "nested_plain_q31"}) {
        for (const double order : {0.5, 1.9909, -0.5, -1.3}) {
            // Several turns of the ring, all of a level or a part of the last.
            for (const auto& [taps, blocks] : {std::pair<std::size_t, glsum::Blocks>{2, {1, 1}},
                                               {8, {5, 1}},
                                               {16, {9, 2}},
                                               {40, {12, 3}},
                                               {5, {4, 9}}}) {
                plan.push_back({kernel, order, taps, taps % signals_.size(), 600, {}, blocks});
            }
        }
    }
    // Loops of a core's own: each place where a turn may be entered, each rest, several turns.
    for (const char* kernel : {"mirror_multi_f32", "mirror_multi_q31", "mirror_smlald_q15", "mirror_hornersplit_f32"}) {
        for (std::size_t taps = 4; taps <= 150; ++taps) {
            plan.push_back({kernel, 0.5, taps, 6, 2 * taps});
        }
    }
    // In parts that the firmware has room for.
    std::vector<qemu::ReplayedRow> rows;
    constexpr std::size_t at_once = 6000;
    for (std::size_t first = 0; first < plan.size(); first += at_once) {
        const auto part = std::span(plan).subspan(first, std::min(at_once, plan.size() - first));
        const auto replayed = qemu::replay(board_, part, signals_, [] {});
        rows.insert(rows.end(), replayed.begin(), replayed.end());
    }
    ASSERT_EQ(rows.size(), plan.size());
    for (std::size_t i = 0; i < plan.size(); ++i) {
        const auto here = qemu::replay_here(plan[i], signals_);
        ASSERT_EQ(rows[i].status, here.status);
        ASSERT_EQ(rows[i].hash, here.hash) << plan[i].kernel << ", order " << plan[i].order << ", taps " << plan[i].taps
                                           << ", signal " << bench::signal_names[plan[i].signal];
    }
}

TEST_F(FirmwareTest, ComputesTheBitsOfThisMachine) { expect_the_bits_of_this_machine(); }
TEST_F(CortexM4FirmwareTest, ComputesTheBitsOfThisMachine) { expect_the_bits_of_this_machine(); }

TEST_F(FirmwareTest, CountsAreThoseOfTheLoopsAndDoNotDependOnTheRunner) {
    std::vector<qemu::PlannedRow> plan;
    for_each_target_kernel([&](const std::string& kernel) {
        for (const std::size_t taps : {1U, 50U, 100U}) {
            plan.push_back({kernel, 0.5, taps, 5, qemu::calls_to_measure(kernel, taps)});
        }
    });
    const auto rows = qemu::measure(board_, plan, signals_, [] {});
    const auto again = qemu::measure(board_, plan, signals_, [] {});
    ASSERT_EQ(rows.size(), plan.size());
    for (std::size_t i = 0; i < plan.size(); ++i) {
        const auto& row = rows[i];
        const std::string what = plan[i].kernel + " " + std::to_string(plan[i].taps);
        EXPECT_EQ(row.instructions, again[i].instructions) << what;
        EXPECT_EQ(row.hash, again[i].hash) << what;
        EXPECT_GE(static_cast<double>(row.worst_instructions), row.instructions) << what;
        EXPECT_GE(row.first.instructions, 1U) << what;
        qemu::PlannedRow here = plan[i];
        here.calls = qemu::calls_hashed(here.kernel, here.calls);
        EXPECT_EQ(row.hash, qemu::replay_here(here, signals_).hash) << what;
        if (plan[i].kernel == "null") {
            EXPECT_EQ(row.instructions, 1.0);  // bx lr
            EXPECT_EQ(row.loads + row.stores, 0.0);
            EXPECT_EQ(row.stack_bytes, 0U);
            continue;
        }
        EXPECT_GT(row.code_bytes, 20U) << what;
        EXPECT_LT(row.code_bytes, 4000U) << what;
        EXPECT_LT(row.stack_bytes, 200U) << what;
        if (plan[i].kernel == "shift_firfma_f32" && plan[i].taps == 100) {
            // One coefficient and one sample read, one sample written for each of 99 taps; the state besides.
            EXPECT_GE(row.loads, 2.0 * 99);
            EXPECT_LE(row.loads, 2.0 * 99 + 8);
            EXPECT_GE(row.stores, 99.0);
            EXPECT_LE(row.stores, 99.0 + 8);
            EXPECT_GE(row.branches, 99.0);
            EXPECT_LE(row.branches, 99.0 + 5);
        }
        if (plan[i].kernel == "mirror_smlald_q15" && plan[i].taps == 100) {
            EXPECT_LT(row.loads, 99.0 + 40);  // two samples a load, and what is kept of the caller's
        }
    }
}

TEST_F(FirmwareTest, BlocksAndTheWholeStreamGiveTheSameCounts) {
    std::vector<qemu::PlannedRow> plan;
    for_each_target_kernel([&](const std::string& kernel) {
        for (const std::size_t taps : {1U, 2U, 7U, 100U}) {
            plan.push_back({kernel, -0.5, taps, 5, qemu::calls_to_measure(kernel, taps)});
        }
    });
    const auto by_blocks = qemu::measure(
        board_, plan, signals_, [] {}, qemu::Counting::blocks);
    const auto by_stream = qemu::measure(
        board_, plan, signals_, [] {}, qemu::Counting::stream);
    ASSERT_EQ(by_blocks.size(), plan.size());
    for (std::size_t i = 0; i < plan.size(); ++i) {
        EXPECT_EQ(by_blocks[i], by_stream[i]) << plan[i].kernel << " " << plan[i].taps;
    }
}

// Cores side by side cost one emulation, and change nothing: neither what is counted nor each other's cycles; nor do
// the rows before.
TEST_F(FirmwareTest, ModelledCyclesDoNotDependOnWhatElseRuns) {
    std::vector<qemu::PlannedRow> plan;
    for (const char* kernel : {"shift_plain_f32", "ring_plain_q31", "mirror_smlald_q15", "ring_horner_f64",
                               "block_plain_q31", "block_oldestfma_f32"}) {
        for (const std::size_t taps : {1U, 20U, 100U}) {
            plan.push_back({kernel, 0.5, taps, 5, qemu::calls_to_measure(kernel, taps)});
        }
    }
    const auto request_of = [](const std::vector<std::string>& cores) {
        timing::TimingRequest request;
        request.cores_folder = TEST_CORES;
        for (const std::string& core : cores) {
            request.cores.push_back({core, "", ""});
        }
        return request;
    };
    const auto measure = [&](const std::vector<qemu::PlannedRow>& rows, const std::vector<std::string>& cores) {
        return qemu::measure(
            board_, rows, signals_, [] {}, qemu::Counting::blocks, request_of(cores));
    };
    const std::vector<std::string> cores{"stm32f746-itcm", "m7-ideal", "stm32f746-flash-nocache"};
    const auto counted = measure(plan, {});
    const auto rows = measure(plan, cores);
    const auto backward = measure({plan.rbegin(), plan.rend()}, {"stm32f746-flash-nocache"});
    for (std::size_t i = 0; i < plan.size(); ++i) {
        const std::string what = plan[i].kernel + " " + std::to_string(plan[i].taps);
        const qemu::MeasuredRow& row = rows[i];
        ASSERT_EQ(row.cores.size(), 3U);
        qemu::MeasuredRow without = row;
        without.cores.clear();
        EXPECT_EQ(without, counted[i]) << what;
        ASSERT_EQ(backward[plan.size() - 1 - i].cores.size(), 1U);
        EXPECT_EQ(backward[plan.size() - 1 - i].cores[0], row.cores[2]) << what;
        // Of the first fewer calls are timed, and the others' differ from call to call.
        if (plan[i].kernel != "ring_horner_f64" && !plan[i].kernel.starts_with("block_")) {
            EXPECT_EQ(row.cores[1].cycles, row.instructions / 2) << what;
        }
        EXPECT_EQ(row.cores[1].first_cycles, static_cast<double>(row.first.instructions) / 2) << what;
        for (const qemu::ModelledCall& core : row.cores) {
            double lost = 0;
            for (const double share : core.lost) {
                EXPECT_GE(share, 0.0) << what;
                lost += share;
            }
            EXPECT_NEAR(core.cycles - core.double_in_software,
                        row.cores[1].cycles - row.cores[1].double_in_software + lost, 1e-9)
                << what;
            EXPECT_EQ(core.double_in_software > 0, plan[i].kernel.ends_with("_f64")) << what;
            EXPECT_LE(core.low, core.cycles) << what;
            EXPECT_GE(core.high, core.cycles) << what;
            EXPECT_GE(core.worst_cycles, core.cycles) << what;
            if (plan[i].kernel.starts_with("block_") && plan[i].taps > 1) {
                EXPECT_LT(core.latency_cycles, core.cycles) << what;  // at most three products whatever the length
            } else if (!plan[i].kernel.starts_with("block_")) {
                EXPECT_EQ(core.latency_cycles, core.cycles) << what;
            }
        }
        // Cold, each line of 32 bytes comes from flash with 7 wait states.
        EXPECT_GT(row.cores[2].cycles, row.cores[0].cycles) << what;
    }
}

// What one count for all orders and signals rests on.
TEST_F(FirmwareTest, CountsFollowFromThePathAloneButInSoftwareDouble) {
    std::vector<qemu::PlannedRow> plan;
    for_each_target_kernel([&](const std::string& kernel) {
        if (!bench::double_in_software(kernel)) {
            for (const std::size_t taps : {1U, 2U, 7U, 50U, 101U}) {
                for (const double order : {0.5, 1.9909, -0.5}) {
                    for (const std::size_t signal : {0U, 5U}) {  // step, noise
                        plan.push_back({kernel, order, taps, signal, qemu::calls_to_measure(kernel, taps)});
                    }
                }
            }
        }
    });
    const auto rows = qemu::measure(board_, plan, signals_, [] {});
    ASSERT_EQ(rows.size(), plan.size());
    std::map<std::tuple<std::string, std::size_t, bench::CountPath>, std::size_t> first_of;
    for (std::size_t i = 0; i < plan.size(); ++i) {
        const auto path = bench::count_path(plan[i].kernel, {plan[i].order, plan[i].taps});
        const std::size_t first = first_of.try_emplace({plan[i].kernel, plan[i].taps, path}, i).first->second;
        qemu::MeasuredRow expected = rows[first];
        expected.hash = rows[i].hash;  // other orders and signals: other outputs
        EXPECT_EQ(rows[i], expected) << plan[i].kernel << ", order " << plan[i].order << ", taps " << plan[i].taps
                                     << ", signal " << bench::signal_names[plan[i].signal];
    }
    EXPECT_LT(first_of.size(), plan.size() / 2);
}

TEST_F(FirmwareTest, ARowBeyondTheCapacityOrFormatComesBackWithItsStatus) {
    const std::vector<qemu::PlannedRow> plan{
        {"shift_plain_f32", 0.5, 100000, 0, qemu::calls_to_measure("shift_plain_f32", 100000)},
        {"shift_plain_f32", 0.5, 3, 0, qemu::calls_to_measure("shift_plain_f32", 3)}};
    const auto rows = qemu::measure(board_, plan, signals_, [] {});
    EXPECT_EQ(rows[0].status, glsum::Status::table_too_small);
    EXPECT_EQ(rows[1].status, glsum::Status::ok);
}

TEST_F(FirmwareTest, AnUnknownKernelIsAnErrorNotANumber) {
    const std::vector<qemu::PlannedRow> plan{{"no_such_kernel", 0.5, 3, 0, 4}};
    EXPECT_THROW((void)qemu::replay(board_, plan, signals_, [] {}), glsum::Failure);
}

}  // namespace
