// An emulator that is missing, too old, hanging or crashing gives a clear error within a time limit, never a number.
#include "qemu/emulate/emulator.hpp"

#include <gtest/gtest.h>

#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/failure.hpp"
#include "qemu/emulate/firmware.hpp"

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

// A script in the place of a board's.
class Script {
public:
    explicit Script(const std::string& body)
        : path_(std::filesystem::temp_directory_path() / ("emulator_test-" + std::to_string(getpid()) + ".sh")) {
        std::ofstream(path_) << "#!/bin/sh\n" << body;
        std::filesystem::permissions(path_, std::filesystem::perms::owner_all);
    }
    Script(const Script&) = delete;
    Script& operator=(const Script&) = delete;
    ~Script() { std::filesystem::remove(path_); }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

struct Told {
    std::vector<std::string> lines;
    glsum::Exit status = glsum::Exit::good;
    std::string message;
};

Told told_by(const std::string& body, const std::string& plugin = "",
             std::chrono::seconds limit = std::chrono::seconds(20)) {
    const Script script(body);
    Told told;
    try {
        qemu::emulate({script.path(), limit}, "folder/a.elf", {"one", "two words"}, plugin,
                      [&](const std::string& line) { told.lines.push_back(line); });
    } catch (const glsum::Failure& failure) {
        told.status = failure.status();
        told.message = failure.what();
    }
    return told;
}

TEST(Emulate, HandsOverArgumentsAndPluginAndEveryLine) {
    setenv("GLSUM_QEMU_PLUGIN", "of the caller", 1);
    const Told without =
        told_by("echo \"$# $1 $2 $3\"; echo \"plugin:${GLSUM_QEMU_PLUGIN-none}\"; echo; echo last >&2\n");
    EXPECT_EQ(without.status, glsum::Exit::good) << without.message;
    EXPECT_EQ(without.lines, (std::vector<std::string>{"3 folder/a.elf one two words", "plugin:none", "", "last"}));
    EXPECT_EQ(told_by("echo \"$GLSUM_QEMU_PLUGIN\"\n", "its own").lines, std::vector<std::string>{"its own"});
    unsetenv("GLSUM_QEMU_PLUGIN");
    // Lines come as they are written, however they are cut, and in any number.
    const Told slow = told_by("printf one; sleep 0.05; printf ' line\\ntwo\\n'\n");
    EXPECT_EQ(slow.lines, (std::vector<std::string>{"one line", "two"}));
    EXPECT_EQ(told_by("seq 1 30000\n").lines.size(), 30000U);
    EXPECT_EQ(told_by("exit 0\n").lines.size(), 0U);
}

TEST(Emulate, AFailureSaysHowItEndedAndItsLastWords) {
    const Told exited = told_by("echo first; printf 'no end of line'; exit 7\n");
    EXPECT_EQ(exited.status, glsum::Exit::check_failed);
    EXPECT_EQ(exited.message, "a.elf under the emulator exited with 7; it said:\n  first\n  no end of line");
    EXPECT_EQ(told_by("echo not there; exit 3\n").status, glsum::Exit::missing);
    EXPECT_EQ(told_by("kill -TERM $$\n").message, "a.elf under the emulator was ended by signal 15");
    // Of much that was said the end.
    const Told much = told_by("seq 100000 100999; exit 1\n");
    EXPECT_LT(much.message.size(), 1200U);
    EXPECT_GT(much.message.size(), 900U);
    EXPECT_TRUE(much.message.ends_with("\n  100998\n  100999")) << much.message;
    EXPECT_EQ(much.message.find("100000"), std::string::npos);
}

// As shells say it: found, and no program.
TEST(Emulate, WhatCannotBeginExitsWith127) {
    const Script script("");
    std::ofstream(script.path()) << "neither a program nor a script";
    try {
        qemu::emulate({script.path(), std::chrono::seconds(20)}, "a.elf", {}, "", [](const std::string&) {});
        FAIL() << "expected a failure";
    } catch (const glsum::Failure& failure) {
        EXPECT_STREQ(failure.what(), "a.elf under the emulator exited with 127");
    }
}

// What QEMU dies of it says in one line, and dumps all registers after it: of those the place, R15, is told.
TEST(Emulate, OfAFatalErrorItsReasonAndItsPlaceAreTold) {
    const std::string registers =
        "echo R12=00000000 R13=20000f00 R14=fffffff9 R15=0000012c; echo XPSR=41000003 -Z-- T handler; kill -ABRT $$\n";
    const Told told = told_by("echo row 0; echo 'qemu: fatal: Lockup: no way to escalate'; echo; " + registers);
    EXPECT_EQ(told.status, glsum::Exit::check_failed);
    EXPECT_EQ(told.message, "a.elf under the emulator was ended by signal 6: Lockup: no way to escalate, R15=0000012c");
    EXPECT_EQ(told.lines.size(), 5U);
    // Registers alone are no reason, nor is what another line says of one.
    EXPECT_EQ(told_by("echo it is qemu: fatal: here; " + registers).message,
              "a.elf under the emulator was ended by signal 6; it said:\n  it is qemu: fatal: here\n"
              "  R12=00000000 R13=20000f00 R14=fffffff9 R15=0000012c\n  XPSR=41000003 -Z-- T handler");
}

TEST(Emulate, ALineWithoutAnEndIsRefused) {
    EXPECT_EQ(told_by("head -c 65536 /dev/zero | tr '\\0' x; echo\n").lines.size(), 1U);
    const Told endless = told_by("printf begin; head -c 70000 /dev/zero | tr '\\0' x; exec sleep 60\n");
    EXPECT_EQ(endless.status, glsum::Exit::check_failed);
    EXPECT_TRUE(endless.message.starts_with("a.elf wrote a line of more than 65536 bytes: beginxxx"))
        << endless.message;
    EXPECT_LT(endless.message.size(), 150U);
    EXPECT_EQ(told_by("head -c 70000 /dev/zero | tr '\\0' '\\n'\n").lines.size(), 70000U);
}

// What may end by itself is given the time for it: its last words reach the disk.
TEST(Emulate, AnEmulatorThatIsGivenGraceMayFinish) {
    const auto mark = std::filesystem::temp_directory_path() / ("emulator_test-mark-" + std::to_string(getpid()));
    const Script script("trap 'sleep 0.2; echo written >\"" + mark.string() +
                        "\"; exit 0' TERM\necho up\nwhile :; do sleep 0.05; done\n");
    for (const std::chrono::seconds grace : {std::chrono::seconds(0), std::chrono::seconds(20)}) {
        std::filesystem::remove(mark);
        EXPECT_THROW(
            qemu::emulate({script.path(), std::chrono::seconds(1), grace}, "a.elf", {}, "", [](const std::string&) {}),
            glsum::Failure);
        EXPECT_EQ(std::filesystem::exists(mark), grace.count() > 0);
        EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "no process is left, nor what the system keeps of one";
    }
    std::filesystem::remove(mark);
    const qemu::Emulator usual{};
    EXPECT_EQ(usual.silence_limit, std::chrono::seconds(120));
    EXPECT_EQ(usual.grace, std::chrono::seconds(0));
}

// Where others take the processor it is slow, and no longer silent by its own clock: here it works a third of the time.
TEST(Emulate, IsNotEndedForWhatOthersTakeOfTheProcessor) {
    const std::string work = "i=0; while [ $i -lt 40000 ]; do i=$((i + 1)); done; ";
    const std::string slowly = "for turn in 1 2 3 4 5 6 7 8; do " + work + "sleep 0.2; done; echo done\n";
    const Told told = told_by(slowly, "", std::chrono::seconds(1));
    EXPECT_EQ(told.status, glsum::Exit::good) << told.message;
    EXPECT_EQ(told.lines, std::vector<std::string>{"done"});
    // What turns in circles has had its time.
    const Told circles = told_by("while :; do :; done\n", "", std::chrono::seconds(1));
    EXPECT_EQ(circles.status, glsum::Exit::check_failed);
    EXPECT_EQ(circles.message.find("the emulator was silent for "), 0U) << circles.message;
}

// A signal that its caller takes care of, here every 10 ms, ends no waiting: neither for output nor for the end.
TEST(Emulate, WaitsOnWhenASignalInterrupts) {
    struct sigaction before {};
    struct sigaction interrupting {};
    interrupting.sa_handler = [](int) {};
    sigaction(SIGALRM, &interrupting, &before);
    const itimerval often{{0, 10'000}, {0, 10'000}};
    setitimer(ITIMER_REAL, &often, nullptr);
    const Told told = told_by("echo first; sleep 0.2; echo second; exec >/dev/null 2>&1; sleep 0.3; exit 7\n");
    const itimerval never{};
    setitimer(ITIMER_REAL, &never, nullptr);
    sigaction(SIGALRM, &before, nullptr);
    EXPECT_EQ(told.message, "a.elf under the emulator exited with 7; it said:\n  first\n  second");
}

TEST(Emulate, VersionIsTheFirstLineThatTheEmulatorPrints) {
    const Script script("[ \"$*\" = --version ] && { echo 'QEMU emulator version 9.9'; echo Copyright; }\n");
    setenv("GLSUM_QEMU", script.path().c_str(), 1);
    EXPECT_EQ(qemu::emulator_version(), "QEMU emulator version 9.9");
    unsetenv("GLSUM_QEMU");
}

// The plan that the firmware reads: bits of doubles in hexadecimal digits, modes behind their number, records beside
// it.
TEST(Replay, WritesThePlanAndReadsTheAnswersInTheirOrder) {
    const auto kept = std::filesystem::temp_directory_path() / ("emulator_test-plan-" + std::to_string(getpid()));
    const Script script("cp \"$2\" '" + kept.string() +
                        "'; cp \"$(sed -n '1s/^glsum-plan-3 \\(.*\\) [0-9]*$/\\1/p' \"$2\")\" '" + kept.string() +
                        ".samples'; echo 'row 0 0 ab'; echo hello; echo 'row 1 3'; echo 'end 2'\n");
    const qemu::Board board{"x.elf", "x.elf", "x.so", {script.path(), std::chrono::seconds(20)}};
    std::vector<qemu::PlannedRow> plan{{"ring_plain_f32", 0.5, 9, 1, 40, {{0.25, -2.0}, {1.0, 4.0}}, {}},
                                       {"nested_plain_f32", -1.0, 8, 0, 7, {}, {5, 2}}};
    std::size_t done = 0;
    const auto rows = qemu::replay(board, plan, {{0.5, -1.0}, {2.0, 4.0}}, [&] { ++done; });
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(done, 2U);
    EXPECT_EQ(rows[0].status, glsum::Status::ok);
    EXPECT_EQ(rows[0].hash, 0xABU);
    EXPECT_EQ(rows[1].status, static_cast<glsum::Status>(3));
    std::ifstream in(kept);
    std::string header;
    std::getline(in, header);
    EXPECT_TRUE(header.ends_with(" 2")) << header;  // samples a record
    std::string row;
    std::getline(in, row);
    EXPECT_EQ(row,
              "ring_plain_f32 3fe0000000000000 9 1 40 0 1 2 3fd0000000000000 c000000000000000 3ff0000000000000 "
              "4010000000000000");
    std::getline(in, row);
    EXPECT_EQ(row, "nested_plain_f32 bff0000000000000 8 0 7 5 2 0");
    std::ifstream samples(kept.string() + ".samples", std::ios::binary);
    double all[5] = {};
    samples.read(reinterpret_cast<char*>(all), sizeof all);
    EXPECT_EQ(samples.gcount(), 32);
    EXPECT_EQ((std::vector<double>(all, all + 4)), (std::vector<double>{0.5, -1.0, 2.0, 4.0}));
    std::filesystem::remove(kept);
    std::filesystem::remove(kept.string() + ".samples");
}

// Of a board every file is asked for, and the first that is not there is named with the preset that makes it.
TEST(Board, AMissingFileIsNamedWithItsPreset) {
    const auto folder = std::filesystem::temp_directory_path() / ("emulator_test-board-" + std::to_string(getpid()));
    const auto build = folder / "mps2-an500";
    std::filesystem::create_directories(build / "targets");
    const auto said = [&] {
        try {
            (void)qemu::find_board(build, folder / "plugin.so", folder / "emulate");
        } catch (const glsum::Failure& failure) {
            EXPECT_EQ(failure.status(), glsum::Exit::missing);
            return std::string(failure.what());
        }
        return std::string("nothing");
    };
    for (const auto& [file, preset] :
         {std::pair(build / "targets" / "measure.elf", "mps2-an500"),
          std::pair(build / "targets" / "replay.elf", "mps2-an500"), std::pair(folder / "plugin.so", "host"),
          std::pair(folder / "emulate", "mps2-an500")}) {
        EXPECT_EQ(said(), file.string() + ": not found; expected from `cmake --preset " + preset +
                              "` and `cmake --build --preset " + preset + "`");
        std::ofstream(file) << "x";
    }
    const qemu::Board board = qemu::find_board(build, folder / "plugin.so", folder / "emulate");
    EXPECT_EQ(board.measure_elf, build / "targets" / "measure.elf");
    EXPECT_EQ(board.replay_elf, build / "targets" / "replay.elf");
    EXPECT_EQ(board.emulator.command, folder / "emulate");
    std::filesystem::remove_all(folder);
}

TEST(Measure, MakesTheFirstTheFillingAndATurnOfCalls) {
    for (const std::size_t taps : {1U, 31U, 33U, 600U}) {
        const std::size_t turn = std::max<std::size_t>(taps, 32);
        EXPECT_EQ(qemu::calls_to_measure("ring_plain_f32", taps), 1 + taps + turn);
        EXPECT_EQ(qemu::calls_to_measure("shift_plain_f64", taps), 1 + taps + 32);  // in software double
    }
    EXPECT_EQ(qemu::calls_hashed("ring_plain_f32", 40), 41U);  // and the one on the painted stack
    EXPECT_EQ(qemu::calls_hashed("block_plain_q31", 40), 41U + firmware::calls_in_halves);
}

}  // namespace
