// An emulator that is missing, too old, hanging or crashing gives a clear error within a time limit, never a number.
#include "qemu/emulator.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>

#include "qemu/failure.hpp"
#include "qemu/firmware.hpp"

namespace {

class EmulatorTest : public testing::Test {
protected:
    static void pretend(const char* how) {
        setenv("GLSUM_QEMU", TEST_SCRIPTS "/pretend_qemu.sh", 1);
        setenv("PRETEND", how, 1);
    }
    void TearDown() override { unsetenv("GLSUM_QEMU"); }

    static void expect_failure(glsum::Exit status, const std::string& text) {
        try {
            const qemu::Board board{"x.elf", "x.elf", "x.so", {TEST_EMULATE, std::chrono::seconds(1)}};
            const std::vector<qemu::PlannedRow> plan{{"null", 0.5, 1, 0, 1}};
            (void)qemu::replay(board, plan, {{0.0}}, [] {});
            FAIL() << "expected a failure";
        } catch (const glsum::Failure& failure) {
            EXPECT_EQ(failure.status(), status) << failure.what();
            EXPECT_NE(std::string(failure.what()).find(text), std::string::npos) << failure.what();
        }
    }
};

TEST_F(EmulatorTest, Missing) {
    setenv("GLSUM_QEMU", "no-such-emulator", 1);
    expect_failure(glsum::Exit::missing, "qemu-system-arm");
    EXPECT_THROW((void)qemu::emulator_version(), glsum::Failure);
}

TEST_F(EmulatorTest, TooOld) {
    pretend("old");
    expect_failure(glsum::Exit::missing, "expected 7.2 or later");
}

TEST_F(EmulatorTest, HangingIsEndedWithinTheLimit) {
    pretend("hang");
    const auto start = std::chrono::steady_clock::now();
    expect_failure(glsum::Exit::check_failed, "silent for 1 s");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST_F(EmulatorTest, Crashing) {
    pretend("crash");
    expect_failure(glsum::Exit::check_failed, "ended by signal 11");
}

TEST_F(EmulatorTest, AFaultOfTheFirmwareIsToldInItsWords) {
    pretend("fail");
    expect_failure(glsum::Exit::check_failed, "the processor took an exception");
}

TEST_F(EmulatorTest, AnAnswerCutShort) {
    pretend("short");
    expect_failure(glsum::Exit::check_failed, "answered 1 rows of 1 and stopped");
}

}  // namespace
