// In the place of the target's compilers: what says how it was called, and links a program that was made by hand.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/scratch.hpp"
#include "qemu/emulate/firmware.hpp"

namespace test {

/// While it lives, the compilers of the target are scripts of its folder, for a board whose files lie there too.
class PretendCompiler {
public:
    PretendCompiler() : path_(std::getenv("PATH")) {
        setenv("PATH", (scratch.file("bin").string() + ":" + path_).c_str(), 1);
        std::filesystem::create_directories(scratch.file("bin"));
        std::filesystem::create_directories(scratch.file("board"));
        board.measure_elf = scratch.file("board") / "measure.elf";
        board.emulator.command = scratch.file("board") / "emulate";
        for (const char* compiler : {"arm-none-eabi-gcc", "arm-none-eabi-g++"}) {
            const std::filesystem::path file = scratch.file("bin") / compiler;
            std::ofstream(file) << "#!/bin/sh\necho \"$*\" >>'" << scratch.file("calls").string()
                                << "'\nfor to; do :; done\n[ \"${to%.elf}\" = \"$to\" ] || [ ! -e '"
                                << linked().string() << "' ] || cp '" << linked().string() << "' \"$to\"\n";
            std::filesystem::permissions(file, std::filesystem::perms::owner_all);
        }
    }
    PretendCompiler(const PretendCompiler&) = delete;
    PretendCompiler& operator=(const PretendCompiler&) = delete;
    ~PretendCompiler() { setenv("PATH", path_.c_str(), 1); }

    /// Of the firmware's build.
    void flags(const std::string& flags) const {
        std::ofstream(board.measure_elf.parent_path() / "build_info.json") << "{\"flags\": \"" << flags << "\"}";
    }
    /// What both were called with, a line each.
    [[nodiscard]] std::string calls() const {
        std::ifstream in(scratch.file("calls"));
        return {std::istreambuf_iterator<char>(in), {}};
    }
    /// The program that a link gives; none where it is not there.
    [[nodiscard]] std::filesystem::path linked() const { return scratch.file("linked.elf"); }

    base::Scratch scratch;
    qemu::Board board;

private:
    std::string path_;
};

}  // namespace test
