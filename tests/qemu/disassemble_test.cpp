// An instruction as binutils writes it: asked for by its address, and taken out of what a disassembler says.
#include "qemu/emulate/disassemble.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "base/scratch.hpp"

namespace {

// A script in the disassembler's place, the first of its name on the path.
class Disassemble : public testing::Test {
protected:
    void SetUp() override {
        const auto script = folder_.file("arm-none-eabi-objdump");
        const std::string folder = folder_.file("").string();
        std::ofstream(script) << "#!/bin/sh\necho \"$@\" >'" << folder << "asked'\ncat '" << folder << "said'\n";
        std::filesystem::permissions(script, std::filesystem::perms::owner_all);
        setenv("PATH", (folder + ':' + path_).c_str(), 1);
    }
    void TearDown() override { setenv("PATH", path_.c_str(), 1); }
    std::string of(std::uint32_t address, const std::string& said) {
        std::ofstream(folder_.file("said")) << said;
        return qemu::disassemble("a file.elf", address);
    }

    base::Scratch folder_;
    const std::string path_ = std::getenv("PATH");
};

TEST_F(Disassemble, ReadsTheLineOfAnAddress) {
    const std::string head = "\na file.elf:     file format elf32-littlearm\n\n00000104 <f>:\n";
    EXPECT_EQ(of(0x104, head + "     104:\tldr\tr0, [r1, #4]\n     106:\tnop\n"), "ldr r0, [r1, #4]");
    std::ifstream asked(folder_.file("asked"));
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(asked), {}),
              "-d --no-show-raw-insn --start-address=0x104 --stop-address=0x108 a file.elf\n");
    EXPECT_EQ(of(0x8000104, head + "8000104:\tbx\tlr\n"), "bx lr");  // as wide as the section's addresses
    EXPECT_EQ(of(0x104, head + "     104:\tbx\tlr"), "bx lr");
    EXPECT_EQ(of(0x104, std::string(9000, ' ') + head + "     104:\tbx\tlr\n"), "bx lr");
}

TEST_F(Disassemble, SaysNothingOfWhatIsNotThere) {
    EXPECT_EQ(of(0x104, ""), "");
    EXPECT_EQ(of(0x104, "\n    1104:\tbx\tlr\n"), "");  // another's last digits
    std::filesystem::remove(folder_.file("arm-none-eabi-objdump"));
    setenv("PATH", folder_.file("").c_str(), 1);
    EXPECT_EQ(qemu::disassemble("a file.elf", 0x104), "");
}

}  // namespace
