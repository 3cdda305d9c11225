#include "qemu/emulate/disassemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

namespace qemu {
namespace {

std::string output_of(const std::string& command) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::string text;
    char buffer[4096];
    for (std::size_t got; pipe && (got = fread(buffer, 1, sizeof buffer, pipe.get())) > 0;) {
        text.append(buffer, got);
    }
    return text;
}

}  // namespace

std::string disassemble(const std::filesystem::path& elf, std::uint32_t address) {
    const std::string text = output_of(fmt::format(
        "arm-none-eabi-objdump -d --no-show-raw-insn --start-address={:#x} --stop-address={:#x} '{}' 2>/dev/null",
        address, address + 4, elf.string()));
    // "  1a4:\tadds\tr0, #1": as wide as the section's addresses need.
    const std::string mark = fmt::format("{:x}:\t", address);
    const std::size_t at = text.find(mark);
    if (at == 0 || at == std::string::npos || (text[at - 1] != ' ' && text[at - 1] != '\n')) {
        return "";
    }
    std::string line = text.substr(at + mark.size(), text.find('\n', at + mark.size()) - at - mark.size());
    std::replace(line.begin(), line.end(), '\t', ' ');
    return line;
}

}  // namespace qemu
