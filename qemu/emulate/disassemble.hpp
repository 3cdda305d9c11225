// One instruction of an ELF as text.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace qemu {

/// As objdump has it; empty without objdump.
[[nodiscard]] std::string disassemble(const std::filesystem::path& elf, std::uint32_t address);

}  // namespace qemu
