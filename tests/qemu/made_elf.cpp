#include "tests/qemu/made_elf.hpp"

#include <elf.h>

#include <cstring>
#include <fstream>

namespace test {
namespace {

template <class Record>
void append(std::string& to, const Record& record) {
    to.append(reinterpret_cast<const char*>(&record), sizeof record);
}

}  // namespace

std::vector<std::uint8_t> bytes_of(const std::vector<std::uint32_t>& words) {
    std::vector<std::uint8_t> bytes;
    for (const std::uint32_t word : words) {
        for (int shift = 0; shift < 32; shift += 8) {
            bytes.push_back(static_cast<std::uint8_t>(word >> shift));
        }
    }
    return bytes;
}

void MadeElf::write(const std::filesystem::path& path) const {
    std::string names(1, '\0');
    std::string table;
    append(table, Elf32_Sym{});
    for (const MadeSymbol& symbol : symbols) {
        Elf32_Sym entry{};
        entry.st_name = static_cast<Elf32_Word>(names.size());
        entry.st_value = symbol.value;
        entry.st_size = symbol.bytes;
        entry.st_info = ELF32_ST_INFO(STB_GLOBAL, symbol.function ? STT_FUNC : STT_OBJECT);
        entry.st_shndx = symbol.defined ? 1 : SHN_UNDEF;
        append(table, entry);
        names += symbol.name + '\0';
    }
    std::string body;
    std::vector<Elf32_Shdr> headers(1);
    const auto add = [&](Elf32_Word kind, const std::string& bytes) -> Elf32_Shdr& {
        Elf32_Shdr header{};
        header.sh_type = kind;
        header.sh_offset = static_cast<Elf32_Off>(sizeof(Elf32_Ehdr) + body.size());
        header.sh_size = static_cast<Elf32_Word>(bytes.size());
        header.sh_addralign = 4;
        body += bytes;
        body.append((4 - body.size() % 4) % 4, '\0');
        return headers.emplace_back(header);
    };
    std::string section_names(1, '\0');
    for (const MadeSection& section : sections) {
        Elf32_Shdr& header = add(SHT_PROGBITS, {section.bytes.begin(), section.bytes.end()});
        if (!section.name.empty()) {
            header.sh_name = static_cast<Elf32_Word>(section_names.size());
            section_names += section.name + '\0';
        }
        header.sh_flags = SHF_ALLOC | (section.code ? SHF_EXECINSTR : 0);
        header.sh_addr = section.address;
    }
    if (!attributes.empty()) {
        add(SHT_ARM_ATTRIBUTES, {attributes.begin(), attributes.end()});
    }
    if (!symbols.empty()) {
        Elf32_Shdr& header = add(SHT_SYMTAB, table);
        header.sh_entsize = sizeof(Elf32_Sym);
        header.sh_link = static_cast<Elf32_Word>(headers.size());
        add(SHT_STRTAB, names);
    }
    Elf32_Ehdr header{};
    if (section_names.size() > 1) {
        header.e_shstrndx = static_cast<Elf32_Half>(headers.size());
        add(SHT_STRTAB, section_names);
    }
    std::memcpy(header.e_ident, ELFMAG, SELFMAG);
    header.e_ident[EI_CLASS] = ELFCLASS32;
    header.e_ident[EI_DATA] = ELFDATA2LSB;
    header.e_ident[EI_VERSION] = EV_CURRENT;
    header.e_type = type;
    header.e_machine = machine;
    header.e_version = EV_CURRENT;
    header.e_ehsize = sizeof header;
    header.e_shentsize = sizeof(Elf32_Shdr);
    header.e_shoff = static_cast<Elf32_Off>(sizeof header + body.size());
    header.e_shnum = static_cast<Elf32_Half>(headers.size());
    std::string whole;
    append(whole, header);
    whole += body;
    for (const Elf32_Shdr& one : headers) {
        append(whole, one);
    }
    std::ofstream(path, std::ios::binary).write(whole.data(), static_cast<std::streamsize>(whole.size()));
}

}  // namespace test
