#include "qemu/elf.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <gelf.h>
#include <libelf.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <memory>

#include "qemu/failure.hpp"

namespace qemu {
namespace {

using glsum::Exit;
using glsum::Failure;

// Beyond these a file is refused: no firmware for a microcontroller comes near, and a damaged one does not fill the
// memory by sections that share bytes or names.
constexpr off_t most_bytes = 256 << 20;
constexpr std::size_t most_section_bytes = 64U << 20;  // all together
constexpr std::size_t most_symbols = 1'000'000;
constexpr std::size_t longest_name = 8192;

struct Descriptor {
    int number;
    ~Descriptor() {
        if (number >= 0) {
            close(number);
        }
    }
};

}  // namespace

Elf::Elf(const std::filesystem::path& path) : path_(path) {
    const auto refuse = [&](const std::string& found) {
        return Failure(Exit::bad_input,
                       fmt::format("{}: expected a 32-bit Arm executable, found {}", path.string(), found));
    };
    elf_version(EV_CURRENT);
    const Descriptor file{open(path.c_str(), O_RDONLY | O_CLOEXEC)};
    if (file.number < 0) {
        throw refuse(std::strerror(errno));
    }
    struct stat status {};
    if (fstat(file.number, &status) != 0 || !S_ISREG(status.st_mode) || status.st_size > most_bytes) {
        throw refuse(fmt::format("no regular file of at most {} bytes", most_bytes));
    }
    const std::unique_ptr<::Elf, int (*)(::Elf*)> elf(elf_begin(file.number, ELF_C_READ, nullptr), elf_end);
    GElf_Ehdr header;
    if (!elf || elf_kind(elf.get()) != ELF_K_ELF || gelf_getehdr(elf.get(), &header) == nullptr) {
        throw refuse("another kind of file");
    }
    if (header.e_machine != EM_ARM || header.e_type != ET_EXEC || gelf_getclass(elf.get()) != ELFCLASS32) {
        throw refuse(fmt::format("an ELF of machine {} and type {}", header.e_machine, header.e_type));
    }
    std::size_t bytes_left = most_section_bytes;
    std::size_t symbols_left = most_symbols;
    for (Elf_Scn* section = nullptr; (section = elf_nextscn(elf.get(), section)) != nullptr;) {
        GElf_Shdr info;
        Elf_Data* data = elf_getdata(section, nullptr);
        if (gelf_getshdr(section, &info) == nullptr || data == nullptr) {
            throw refuse("a damaged section");
        }
        if ((info.sh_flags & SHF_ALLOC) != 0 && info.sh_type == SHT_PROGBITS && data->d_buf != nullptr) {
            if (data->d_size > bytes_left) {
                throw refuse(fmt::format("more than {} bytes in its sections", most_section_bytes));
            }
            bytes_left -= data->d_size;
            const auto* bytes = static_cast<const unsigned char*>(data->d_buf);
            sections_.push_back({static_cast<std::uint32_t>(info.sh_addr), {bytes, bytes + data->d_size}});
        }
        if (info.sh_type == SHT_SYMTAB && info.sh_entsize != 0) {
            const std::size_t symbols = info.sh_size / info.sh_entsize;
            if (symbols > symbols_left) {
                throw refuse(fmt::format("more than {} symbols", most_symbols));
            }
            symbols_left -= symbols;
            for (std::size_t i = 0; i < symbols; ++i) {
                GElf_Sym symbol;
                if (gelf_getsym(data, static_cast<int>(i), &symbol) == nullptr) {
                    throw refuse("a damaged symbol table");
                }
                const char* name = elf_strptr(elf.get(), info.sh_link, symbol.st_name);
                if (name == nullptr || symbol.st_shndx == SHN_UNDEF) {
                    continue;
                }
                if (strnlen(name, longest_name + 1) > longest_name) {
                    throw refuse(fmt::format("a symbol's name of more than {} bytes", longest_name));
                }
                const bool function = GELF_ST_TYPE(symbol.st_info) == STT_FUNC;
                const auto address = static_cast<std::uint32_t>(symbol.st_value) & (function ? ~1U : ~0U);
                symbols_.emplace(name, address);
                if (function && symbol.st_size > 0) {
                    functions_.emplace(address, Function{name, address, static_cast<std::uint32_t>(symbol.st_size)});
                }
            }
        }
    }
    if (symbols_.empty()) {
        throw refuse("one without symbols");
    }
}

std::optional<std::uint32_t> Elf::symbol(const std::string& name) const {
    const auto found = symbols_.find(name);
    return found == symbols_.end() ? std::nullopt : std::optional(found->second);
}

const Function* Elf::function_at(std::uint32_t address) const {
    auto next = functions_.upper_bound(address);
    if (next == functions_.begin()) {
        return nullptr;
    }
    const Function& function = std::prev(next)->second;
    return address - function.address < function.bytes ? &function : nullptr;
}

const unsigned char* Elf::at(std::uint32_t address, std::size_t length) const {
    for (const Section& section : sections_) {
        if (address >= section.address && address - section.address + length <= section.bytes.size()) {
            return section.bytes.data() + (address - section.address);
        }
    }
    throw Failure(Exit::bad_input, fmt::format("{}: no section holds address {:#x}", path_.string(), address));
}

std::uint32_t Elf::word(std::uint32_t address) const {
    std::uint32_t value;
    std::memcpy(&value, at(address, sizeof value), sizeof value);
    return value;
}

std::string Elf::text(std::uint32_t address, std::size_t length) const {
    return {reinterpret_cast<const char*>(at(address, length)), length};
}

}  // namespace qemu
