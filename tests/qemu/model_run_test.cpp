// Whole models on the emulated Cortex-M7: the host's bits, and what a step costs.
#include "qemu/emulate/model_run.hpp"

#include <gtest/gtest.h>

#include "base/failure.hpp"
#include "drive/realtime.hpp"
#include "tests/drive/plants.hpp"

namespace {

TEST(ModelRun, StepsModelsWithTheHostsBits) {
    qemu::Board board;
    try {
        board = qemu::find_board(TEST_FIRMWARE_BUILD, TEST_PLUGIN, TEST_EMULATE);
        (void)qemu::model_elf(board);
        (void)qemu::emulator_version();
    } catch (const glsum::Failure& failure) {
        if (std::getenv("GLSUM_REQUIRE_FIRMWARE") != nullptr) {
            FAIL() << failure.what();
        }
        GTEST_SKIP() << failure.what();
    }
    std::vector<double> input;
    for (int k = 0; k < 1300; ++k) {
        input.push_back(k % 400 < 300 ? 0.9 : -0.3);
    }
    std::vector<drive::RealtimeModel> models;
    for (auto plant : {plants::fopdt(), plants::sopdt(), plants::niopdt()}) {
        plant.delay_s *= 0.1;
        for (const auto writing : {drive::Writing::merged, drive::Writing::delta, drive::Writing::apart}) {
            models.emplace_back(plant, writing, drive::Memory{80}, 0.001);
        }
    }
    std::vector<drive::RealtimeModel> with_modes;
    with_modes.emplace_back(plants::niopdt(), drive::Writing::delta, drive::Memory{16, 7}, 0.001);
    with_modes.emplace_back(plants::niopdt(), drive::Writing::bdf2, drive::Memory{27, 11}, 0.001);
    std::vector<qemu::PlannedModel> plan;
    glsum::ModelKernels::for_each([&]<class K>() {
        constexpr bool has_modes = std::is_same_v<typename K::HistoryPart, glsum::Modes>;
        for (const auto& model : has_modes ? with_modes : models) {
            plan.push_back({std::string(K::name()), &model.design(), input, 1300});
        }
    });
    const auto rows = qemu::step_models(board, plan, [] {});
    ASSERT_EQ(rows.size(), plan.size());
    for (std::size_t i = 0; i < plan.size(); ++i) {
        const auto here = qemu::step_model_here(plan[i]);
        EXPECT_EQ(rows[i].status, glsum::Status::ok) << plan[i].kernel << " " << i;
        EXPECT_EQ(rows[i].hash, here.hash) << plan[i].kernel << " " << i;
        EXPECT_GT(rows[i].instructions, 10.0);
        EXPECT_GE(static_cast<double>(rows[i].worst_instructions), rows[i].instructions);
        EXPECT_GT(rows[i].code_bytes, 100U);
    }
    // One more tap of a plain f32 ring costs its 6 instructions in every writing.
    const drive::RealtimeModel longer(plants::niopdt(), drive::Writing::delta, {180}, 0.001);
    const drive::RealtimeModel shorter(plants::niopdt(), drive::Writing::delta, {80}, 0.001);
    const auto two =
        qemu::step_models(board,
                          std::vector<qemu::PlannedModel>{{"ring_plain_f32", &shorter.design(), input, 1500},
                                                          {"ring_plain_f32", &longer.design(), input, 1500}},
                          [] {});
    EXPECT_NEAR(two[1].instructions - two[0].instructions, 600.0, 6.0);

    // The same calls timed: what model (12) costs with modes, and that more of them cost more.
    const timing::TimingRequest timing{TEST_CORES, {{"stm32f746-itcm", "", ""}, {"m7-ideal", "", ""}}};
    const auto timed = qemu::step_models(
        board,
        std::vector<qemu::PlannedModel>{{"modes_plain_f32", &with_modes[0].design(), input, 1500},
                                        {"modes_plain_f32", &with_modes[1].design(), input, 1500}},
        [] {}, timing);
    ASSERT_EQ(timed[0].cores.size(), 2U);
    EXPECT_LE(timed[0].cores[0].low, timed[0].cores[0].cycles);
    EXPECT_LE(timed[0].cores[0].cycles, timed[0].cores[0].high);
    EXPECT_GT(timed[0].cores[0].cycles, timed[0].cores[1].cycles);
    EXPECT_LE(timed[0].cores[0].cycles, 120.0);
    EXPECT_LE(timed[0].cores[0].high, 135.0);
    EXPECT_GT(timed[1].cores[0].cycles, timed[0].cores[0].cycles + 10.0);
    EXPECT_GT(timed[0].cores[0].first_cycles, timed[0].cores[0].cycles);
    EXPECT_TRUE(timed[0].unknown_encodings.empty());
}

}  // namespace
