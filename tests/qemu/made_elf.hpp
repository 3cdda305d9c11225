// An Arm executable made by hand: for what is read from one, where no compiler for it is at hand.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace test {

struct MadeSymbol {
    std::string name;
    std::uint32_t value;  ///< of a function with the Thumb bit
    std::uint32_t bytes = 0;
    bool function = false;
    bool defined = true;
};

struct MadeSection {
    std::uint32_t address;
    std::vector<std::uint8_t> bytes;
    bool code = false;
    std::string name = {};
};

struct MadeElf {
    std::vector<MadeSection> sections;
    std::vector<MadeSymbol> symbols;
    std::vector<std::uint8_t> attributes = {};  ///< of .ARM.attributes; empty: the section is not there
    std::uint16_t machine = 40;                 ///< EM_ARM
    std::uint16_t type = 2;                     ///< ET_EXEC
    void write(const std::filesystem::path& path) const;
};

/// The bytes of little-endian words.
[[nodiscard]] std::vector<std::uint8_t> bytes_of(const std::vector<std::uint32_t>& words);

}  // namespace test
