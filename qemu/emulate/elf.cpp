#include "qemu/emulate/elf.hpp"

#include <cxxabi.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <fnmatch.h>
#include <gelf.h>
#include <libelf.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <span>

#include "base/failure.hpp"
#include "base/nearest_name.hpp"

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

// Numbers of the public build attributes that one byte or two hold. [Arm IHI 0045, 2.2]
struct Attributes {
    unsigned architecture = 0;
    unsigned profile = 0;
};
Attributes parse(std::span<const unsigned char> bytes) {
    Attributes found;
    // 'A', then a section: its length, "aeabi", then of the whole file: tag 1, a length, and pairs of tag and value.
    constexpr std::size_t head = 1 + 4 + 6 + 1 + 4;
    bytes = bytes.subspan(std::min(head, bytes.size()));
    const auto next = [&] {
        const unsigned char byte = bytes.front();
        bytes = bytes.subspan(1);
        return byte;
    };
    const auto number = [&] {
        unsigned value = 0;
        for (unsigned shift = 0; !bytes.empty(); shift += 7) {
            const unsigned char byte = next();
            value |= (byte & 0x7FU) << (shift & 31U);
            if ((byte & 0x80U) == 0) {
                break;
            }
        }
        return value;
    };
    const auto skip_text = [&] {
        while (!bytes.empty() && next() != 0) {
        }
    };
    while (!bytes.empty()) {
        const unsigned tag = number();
        if (tag == 4 || tag == 5 || (tag > 32 && tag % 2 == 1)) {
            skip_text();
            continue;
        }
        const unsigned value = number();
        if (tag == 32) {
            skip_text();
        } else if (tag == 6) {
            found.architecture = value;
        } else if (tag == 7) {
            found.profile = value;
        }
    }
    return found;
}

std::string readable(const std::string& name) {
    int status = 0;
    const std::unique_ptr<char, void (*)(void*)> text(abi::__cxa_demangle(name.c_str(), nullptr, nullptr, &status),
                                                      std::free);
    return status == 0 && text ? text.get() : name;
}

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
    std::size_t names = 0;
    if (elf_getshdrstrndx(elf.get(), &names) != 0) {
        throw refuse("a damaged table of sections");
    }
    std::size_t bytes_left = most_section_bytes;
    std::size_t symbols_left = most_symbols;
    for (Elf_Scn* section = nullptr; (section = elf_nextscn(elf.get(), section)) != nullptr;) {
        GElf_Shdr info;
        Elf_Data* data = elf_getdata(section, nullptr);
        if (gelf_getshdr(section, &info) == nullptr || data == nullptr) {
            throw refuse("a damaged section");
        }
        const char* const called = elf_strptr(elf.get(), names, info.sh_name);
        if ((info.sh_flags & SHF_ALLOC) != 0 && info.sh_size > 0 && called != nullptr &&
            strnlen(called, longest_name + 1) <= longest_name) {
            const auto begin = static_cast<std::uint32_t>(info.sh_addr);
            extents_.emplace(called, Extent{begin, begin + static_cast<std::uint32_t>(info.sh_size)});
        }
        if ((info.sh_flags & SHF_ALLOC) != 0 && info.sh_type == SHT_PROGBITS && data->d_buf != nullptr) {
            if (data->d_size > bytes_left) {
                throw refuse(fmt::format("more than {} bytes in its sections", most_section_bytes));
            }
            bytes_left -= data->d_size;
            const auto* bytes = static_cast<const unsigned char*>(data->d_buf);
            sections_.push_back({static_cast<std::uint32_t>(info.sh_addr),
                                 (info.sh_flags & SHF_EXECINSTR) != 0,
                                 {bytes, bytes + data->d_size}});
        }
        if (info.sh_type == SHT_ARM_ATTRIBUTES && data->d_buf != nullptr) {
            const auto* bytes = static_cast<const unsigned char*>(data->d_buf);
            attributes_.assign(bytes, bytes + data->d_size);
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

Elf::Extent Elf::section(const std::string& name) const {
    const auto found = extents_.find(name);
    if (found == extents_.end()) {
        std::string known;
        for (const auto& [one, extent] : extents_) {
            known += ' ' + one;
        }
        throw Failure(Exit::bad_input,
                      fmt::format("{}: no section {}; expected one of{}", path_.string(), name, known));
    }
    return found->second;
}

Function Elf::function(const std::string& name) const {
    std::vector<Function> found;
    std::vector<std::pair<std::size_t, std::string>> close;
    for (const auto& [address, function] : functions_) {
        const std::string text = readable(function.name);
        const std::string without_parameters = text.substr(0, text.find('('));
        // "f.constprop.0" is what the compiler made of f.
        if (function.name == name || text == name || function.name + "()" == name || without_parameters == name ||
            function.name.starts_with(name + '.')) {
            found.push_back(function);
        }
        close.emplace_back(base::letters_between(without_parameters, name), text);
    }
    if (found.size() == 1) {
        return found[0];
    }
    if (found.empty() && symbols_.contains(name)) {
        const std::uint32_t address = symbols_.at(name) & ~1U;
        if (at(address, 2) != nullptr && address < 0x20000000U) {
            return {name, address, 2};
        }
    }
    std::string names;
    if (found.empty()) {
        std::sort(close.begin(), close.end());
        for (std::size_t i = 0; i < std::min<std::size_t>(3, close.size()); ++i) {
            names += (i > 0 ? ", " : "") + close[i].second;
        }
        throw Failure(
            Exit::bad_input,
            fmt::format("{}: no function {}; the compiler may have inlined it (noinline keeps it) or the linker "
                        "dropped it; the closest names are {}",
                        path_.string(), name, names));
    }
    for (const Function& function : found) {
        names += fmt::format(" {} at {:#x}", function.name, function.address);
    }
    throw Failure(Exit::bad_input,
                  fmt::format("{}: {} is the name of {} functions:{}", path_.string(), name, found.size(), names));
}

std::vector<Function> Elf::functions_like(const std::vector<std::string>& globs) const {
    std::map<std::uint32_t, Function> found;
    for (const std::string& glob : globs) {
        bool any = false;
        for (const auto& [address, function] : functions_) {
            const std::string text = readable(function.name);
            if (fnmatch(glob.c_str(), function.name.c_str(), 0) == 0 ||
                fnmatch(glob.c_str(), text.substr(0, text.find('(')).c_str(), 0) == 0) {
                found.emplace(address, function);
                any = true;
            }
        }
        if (!any) {
            throw Failure(Exit::bad_input, fmt::format("{}: no function's name matches {}", path_.string(), glob));
        }
    }
    std::vector<Function> functions;
    for (const auto& [address, function] : found) {
        functions.push_back(function);
    }
    return functions;
}

// The core starts where the vector table says, in Thumb state; the ELF's own entry is for loaders, and often not set.
void Elf::check_starts(const std::string& core) const {
    const auto first =
        std::find_if(sections_.begin(), sections_.end(), [](const Section& section) { return section.address == 0; });
    if (first == sections_.end() || first->bytes.size() < 8 || (word(4) & 1U) == 0) {
        throw Failure(Exit::bad_input,
                      fmt::format("{}: expected a program for a {} (ARMv7E-M), found none whose vector table at "
                                  "address 0 starts it in Thumb state",
                                  path_.string(), core));
    }
}

void Elf::check_lies_within(const std::vector<Extent>& memories, const std::string& whose) const {
    for (const auto& [name, extent] : extents_) {
        if (std::none_of(memories.begin(), memories.end(), [&, at = extent](const Extent& memory) {
                return memory.begin <= at.begin && at.end <= memory.end;
            })) {
            std::string text;
            for (const Extent& memory : memories) {
                text += fmt::format("{}{:#010x} to {:#010x}", text.empty() ? "" : ", ", memory.begin, memory.end);
            }
            throw Failure(
                Exit::bad_input,
                fmt::format("{}: section {} lies at {:#010x} to {:#010x}; link it into the memories of {}: {}",
                            path_.string(), name, extent.begin, extent.end, whose, text));
        }
    }
}

void Elf::check_runs_on(const std::string& core) const {
    const auto refuse = [&](const std::string& found) {
        throw Failure(Exit::bad_input,
                      fmt::format("{}: expected a program for a {} (ARMv7E-M), found {}", path_.string(), core, found));
    };
    if (attributes_.empty()) {
        check_starts(core);  // written in assembly: its encodings will tell
        return;
    }
    // [Arm IHI 0045, Tag_CPU_arch]
    static const std::map<unsigned, const char*> names{{10, "ARMv7"},
                                                       {13, "ARMv7E-M"},
                                                       {14, "ARMv8-A"},
                                                       {15, "ARMv8-R"},
                                                       {16, "ARMv8-M baseline"},
                                                       {17, "ARMv8-M mainline"},
                                                       {21, "ARMv8.1-M mainline"},
                                                       {22, "ARMv9-A"}};
    constexpr unsigned v7 = 10;
    constexpr unsigned v6_m = 11;
    constexpr unsigned v6s_m = 12;
    constexpr unsigned v7e_m = 13;
    const Attributes attributes = parse(attributes_);
    const bool small = attributes.architecture == v6_m || attributes.architecture == v6s_m;
    const bool right = attributes.architecture == v7e_m || (attributes.architecture == v7 && attributes.profile == 'M');
    if (!small && !right) {
        const auto name = names.find(attributes.architecture);
        refuse(fmt::format(
            "one for {}{}",
            name != names.end() ? name->second : fmt::format("architecture {}", attributes.architecture),
            attributes.profile != 0 ? fmt::format(", profile {}", static_cast<char>(attributes.profile)) : ""));
    }
}

const Function* Elf::function_at(std::uint32_t address) const {
    auto next = functions_.upper_bound(address);
    if (next == functions_.begin()) {
        return nullptr;
    }
    const Function& function = std::prev(next)->second;
    return address - function.address < function.bytes ? &function : nullptr;
}

std::uint32_t Elf::end_of_function(std::uint32_t address) const {
    const auto found = functions_.lower_bound(address);
    return found == functions_.end() ? address : found->first == address ? address + found->second.bytes : found->first;
}

const unsigned char* Elf::at(std::uint32_t address, std::size_t length) const {
    for (const Section& section : sections_) {
        if (address >= section.address && address - section.address + length <= section.bytes.size()) {
            return section.bytes.data() + (address - section.address);
        }
    }
    throw Failure(Exit::bad_input, fmt::format("{}: no section holds address {:#x}", path_.string(), address));
}

std::set<std::uint32_t> Elf::halfwords_in_code(std::uint16_t value) const {
    std::set<std::uint32_t> addresses;
    for (const Section& section : sections_) {
        for (std::size_t i = 0; section.code && i + 1 < section.bytes.size(); i += 2) {
            if ((section.bytes[i] | section.bytes[i + 1] << 8) == value) {
                addresses.insert(section.address + static_cast<std::uint32_t>(i));
            }
        }
    }
    return addresses;
}

bool Elf::has_word(std::uint32_t address) const {
    return std::any_of(sections_.begin(), sections_.end(), [&](const Section& section) {
        return address >= section.address && address - section.address + 4 <= section.bytes.size();
    });
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
