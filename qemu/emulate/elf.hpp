// Reads what the tools need from a 32-bit Arm ELF.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace qemu {

struct Function {
    std::string name;  ///< as in the symbol table (mangled)
    std::uint32_t address;
    std::uint32_t bytes;
};

class Elf {
public:
    /// Addresses of a section once the program runs, or of a memory.
    struct Extent {
        std::uint32_t begin;
        std::uint32_t end;  ///< behind its last byte
    };
    /// \throws glsum::Failure (bad input) when the file is missing, damaged, or not a 32-bit Arm executable.
    explicit Elf(const std::filesystem::path& path);

    /// Address of a symbol, without the Thumb bit.
    [[nodiscard]] std::optional<std::uint32_t> symbol(const std::string& name) const;
    /// The one function that a name means: as in the symbol table, or as C++ has it, with or without parameters.
    /// \throws glsum::Failure (bad input) when there is none, with the closest names, or when several are called so.
    [[nodiscard]] Function function(const std::string& name) const;
    /// The functions whose names, as in the symbol table or as C++ has them without parameters, match one of the globs;
    /// by address. \throws glsum::Failure (bad input) when a glob matches none
    [[nodiscard]] std::vector<Function> functions_like(const std::vector<std::string>& globs) const;
    /// \throws glsum::Failure (bad input), which names the section and its address, when one lies elsewhere
    void check_lies_within(const std::vector<Extent>& memories, const std::string& whose) const;
    /// \param core  its name, for the message
    /// \throws glsum::Failure (bad input) when the vector table at address 0 does not start it in Thumb state
    void check_starts(const std::string& core) const;
    /// \throws glsum::Failure (bad input) when it was built for another core than an M-profile one up to ARMv7E-M.
    void check_runs_on(const std::string& core) const;
    /// The function that holds an address.
    [[nodiscard]] const Function* function_at(std::uint32_t address) const;
    /// Behind the last byte of the function that begins at an address: by its symbol's size, or, where that has none,
    /// where the next function begins.
    [[nodiscard]] std::uint32_t end_of_function(std::uint32_t address) const;
    /// Its name as in `.rodata`. \throws glsum::Failure (bad input) when there is none, with those that there are
    [[nodiscard]] Extent section(const std::string& name) const;
    /// Addresses by name; of functions without the Thumb bit.
    [[nodiscard]] const std::map<std::string, std::uint32_t>& symbols() const { return symbols_; }
    /// Addresses in its code of halfwords that have a value, whatever they are part of.
    [[nodiscard]] std::set<std::uint32_t> halfwords_in_code(std::uint16_t value) const;
    [[nodiscard]] bool has_word(std::uint32_t address) const;
    /// The word at an address of a loaded section. \throws glsum::Failure when there is none.
    [[nodiscard]] std::uint32_t word(std::uint32_t address) const;
    [[nodiscard]] std::string text(std::uint32_t address, std::size_t length) const;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    struct Section {
        std::uint32_t address;
        bool code;
        std::vector<unsigned char> bytes;
    };
    [[nodiscard]] const unsigned char* at(std::uint32_t address, std::size_t length) const;

    std::filesystem::path path_;
    std::vector<Section> sections_;
    std::map<std::string, Extent> extents_;  // of what takes up memory
    std::map<std::string, std::uint32_t> symbols_;
    std::vector<unsigned char> attributes_;        // .ARM.attributes
    std::map<std::uint32_t, Function> functions_;  // by address
};

}  // namespace qemu
