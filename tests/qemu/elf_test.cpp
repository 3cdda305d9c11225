#include "qemu/elf.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "qemu/failure.hpp"
#include "qemu/scratch.hpp"

namespace {

const std::filesystem::path measure_elf = std::filesystem::path(TEST_FIRMWARE_BUILD) / "targets" / "measure.elf";

void expect_refused(const std::filesystem::path& path, const std::string& reason) {
    try {
        const qemu::Elf elf(path);
        FAIL() << "expected a refusal of " << path;
    } catch (const glsum::Failure& failure) {
        EXPECT_EQ(failure.status(), glsum::Exit::bad_input);
        EXPECT_NE(std::string(failure.what()).find(path.string()), std::string::npos) << failure.what();
        EXPECT_NE(std::string(failure.what()).find(reason), std::string::npos) << failure.what();
    }
}

TEST(Elf, RefusesWhatIsNoArmExecutable) {
    const qemu::Scratch folder;
    expect_refused(folder.file("missing.elf"), "No such file");
    std::ofstream(folder.file("text.elf")) << "not an ELF";
    expect_refused(folder.file("text.elf"), "another kind of file");
    expect_refused("/proc/self/exe", "machine");
}

TEST(Elf, FindsSymbolsFunctionsAndWords) {
    if (!std::filesystem::exists(measure_elf)) {
        GTEST_SKIP() << "no firmware was built";
    }
    const qemu::Elf elf(measure_elf);
    const auto reset = elf.symbol("reset_handler");
    ASSERT_TRUE(reset);
    EXPECT_EQ(*reset & 1U, 0U);
    ASSERT_NE(elf.function_at(*reset + 4), nullptr);
    EXPECT_EQ(elf.function_at(*reset + 4)->name, "reset_handler");
    EXPECT_EQ(elf.word(4), *reset | 1U);  // the vector table's second word
    EXPECT_FALSE(elf.symbol("nothing_of_this_name"));
    EXPECT_EQ(elf.function_at(0xF0000000), nullptr);
    EXPECT_THROW((void)elf.word(0xF0000000), glsum::Failure);
}

}  // namespace
