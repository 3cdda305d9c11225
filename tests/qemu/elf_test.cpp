#include "qemu/emulate/elf.hpp"

#include <elf.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "base/failure.hpp"
#include "base/scratch.hpp"
#include "made_elf.hpp"
#include "qemu/emulate/software_double.hpp"
#include "qemu/emulate/unwinding.hpp"
#include "tests/refusal.hpp"

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
    const base::Scratch folder;
    expect_refused(folder.file("missing.elf"), "No such file");
    std::ofstream(folder.file("text.elf")) << "not an ELF";
    expect_refused(folder.file("text.elf"), "another kind of file");
    expect_refused("/proc/self/exe", "machine");
}

// An ELF without any bytes of its own: `sections` sections that are the same `bytes` zeros of a sparse file.
void write_sparse_elf(const std::filesystem::path& path, std::uint16_t sections, std::uint32_t bytes,
                      std::uint32_t type = SHT_PROGBITS, std::uint32_t entry_bytes = sizeof(Elf32_Sym)) {
    Elf32_Ehdr header{};
    std::memcpy(header.e_ident, ELFMAG, SELFMAG);
    header.e_ident[EI_CLASS] = ELFCLASS32;
    header.e_ident[EI_DATA] = ELFDATA2LSB;
    header.e_ident[EI_VERSION] = EV_CURRENT;
    header.e_type = ET_EXEC;
    header.e_machine = EM_ARM;
    header.e_version = EV_CURRENT;
    header.e_ehsize = sizeof header;
    header.e_shentsize = sizeof(Elf32_Shdr);
    header.e_shoff = sizeof header;
    header.e_shnum = static_cast<std::uint16_t>(sections + 1);
    std::ofstream out(path, std::ios::binary);
    out.write(reinterpret_cast<const char*>(&header), sizeof header);
    Elf32_Shdr section{};
    out.write(reinterpret_cast<const char*>(&section), sizeof section);
    section.sh_type = type;
    section.sh_flags = SHF_ALLOC;
    section.sh_entsize = entry_bytes;
    section.sh_offset = 1 << 16;
    section.sh_size = bytes;
    for (std::uint16_t i = 0; i < sections; ++i) {
        out.write(reinterpret_cast<const char*>(&section), sizeof section);
    }
    out.close();
    std::filesystem::resize_file(path, (1 << 16) + bytes);
}

TEST(Elf, RefusesWhatWouldFillTheMemory) {
    const base::Scratch folder;
    write_sparse_elf(folder.file("one.elf"), 1, 16 << 20);
    expect_refused(folder.file("one.elf"), "without symbols");  // its size is not what is wrong
    write_sparse_elf(folder.file("many.elf"), 5, 16 << 20);
    expect_refused(folder.file("many.elf"), "more than 67108864 bytes in its sections");
    write_sparse_elf(folder.file("large.elf"), 1, 257 << 20);
    expect_refused(folder.file("large.elf"), "no regular file of at most 268435456 bytes");
    expect_refused("/dev/zero", "no regular file");
}

// At its bounds a file is read: what is wrong with these is that they have no names.
TEST(Elf, ReadsWhatIsAtItsBounds) {
    const base::Scratch folder;
    const auto path = folder.file("a.elf");
    write_sparse_elf(path, 4, 16 << 20);
    expect_refused(path, "without symbols");
    write_sparse_elf(path, 4, (16 << 20) + 1);
    expect_refused(path, "more than 67108864 bytes in its sections");
    write_sparse_elf(path, 1, 1 << 20);
    std::filesystem::resize_file(path, 256 << 20);
    expect_refused(path, "without symbols");
    std::filesystem::resize_file(path, (256 << 20) + 1);
    expect_refused(path, "no regular file of at most 268435456 bytes");
    constexpr std::uint32_t symbols = 1000000 * sizeof(Elf32_Sym);
    write_sparse_elf(path, 1, symbols, SHT_SYMTAB);
    expect_refused(path, "without symbols");
    write_sparse_elf(path, 1, symbols + sizeof(Elf32_Sym), SHT_SYMTAB);
    expect_refused(path, "more than 1000000 symbols");
    write_sparse_elf(path, 2, symbols / 2 + sizeof(Elf32_Sym), SHT_SYMTAB);  // of all its tables
    expect_refused(path, "more than 1000000 symbols");
}

// A file that ends before its sections do, and a table of more symbols than its bytes hold.
TEST(Elf, RefusesWhatIsCutShort) {
    const base::Scratch folder;
    const auto path = folder.file("a.elf");
    write_sparse_elf(path, 1, 1024);
    expect_refused(path, "without symbols");
    std::filesystem::resize_file(path, (1 << 16) + 1023);
    expect_refused(path, "a damaged section");
    write_sparse_elf(path, 1, 1024, SHT_SYMTAB, sizeof(Elf32_Sym) / 2);
    expect_refused(path, "a damaged symbol table");
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

// At every even address of what is executed, the last one too, and nowhere else.
TEST(Elf, FindsHalfwordsInItsCode) {
    const base::Scratch folder;
    test::MadeElf made;
    made.sections = {{0x100, test::bytes_of({0xBF0046D2, 0x46D2BF00, 0xD200BF46, 0x46D2BF46}), true},
                     {0x200, test::bytes_of({0x46D246D2})}};
    made.symbols = {{"f", 0x101, 16, true}};
    made.write(folder.file("a.elf"));
    const qemu::Elf elf(folder.file("a.elf"));
    EXPECT_EQ(elf.halfwords_in_code(0x46D2), (std::set<std::uint32_t>{0x100, 0x106, 0x10E}));
    EXPECT_TRUE(elf.halfwords_in_code(0x1234).empty());
}

// Four bytes of one section, wherever it lies.
TEST(Elf, HasTheWordsThatLieWhollyInASection) {
    const base::Scratch folder;
    test::MadeElf made;
    made.sections = {{0x100, test::bytes_of({1, 2})}, {0x2000, {1, 2, 3, 4, 5, 6}}};
    made.symbols = {{"f", 0x101, 8, true}};
    made.write(folder.file("a.elf"));
    const qemu::Elf elf(folder.file("a.elf"));
    for (const std::uint32_t here : {0x100U, 0x104U, 0x2000U, 0x2002U}) {
        EXPECT_TRUE(elf.has_word(here)) << here;
    }
    for (const std::uint32_t beside : {0U, 0xFCU, 0xFFU, 0x105U, 0x108U, 0x1FFFU, 0x2003U, 0x2100U}) {
        EXPECT_FALSE(elf.has_word(beside)) << beside;
    }
}

test::MadeElf with_named_sections() {
    test::MadeElf made;
    made.sections = {{0x100, test::bytes_of({1, 2}), true, ".text"}, {0x20000000, {1, 2, 3}, false, ".data"}};
    made.symbols = {{"f", 0x101, 8, true}};
    return made;
}

TEST(Elf, TellsWhereASectionLies) {
    const base::Scratch folder;
    with_named_sections().write(folder.file("a.elf"));
    const qemu::Elf elf(folder.file("a.elf"));
    EXPECT_EQ(elf.section(".text").begin, 0x100U);
    EXPECT_EQ(elf.section(".text").end, 0x108U);
    EXPECT_EQ(elf.section(".data").begin, 0x20000000U);
    EXPECT_EQ(elf.section(".data").end, 0x20000003U);
    EXPECT_EQ(test::refusal(glsum::Exit::bad_input, [&] { (void)elf.section(".bss"); }),
              folder.file("a.elf").string() + ": no section .bss; expected one of .data .text");
}

// Each section in one memory from its first byte to its last.
TEST(Elf, LiesWithinTheMemoriesThatHoldItsSections) {
    const base::Scratch folder;
    with_named_sections().write(folder.file("a.elf"));
    const qemu::Elf elf(folder.file("a.elf"));
    using Memories = std::vector<qemu::Elf::Extent>;
    for (const Memories& enough : {Memories{{0x100, 0x108}, {0x20000000, 0x20000003}}, Memories{{0, 0x20000003}},
                                   Memories{{0x300, 0x400}, {0x20000000, 0x30000000}, {0x80, 0x200}}}) {
        EXPECT_NO_THROW(elf.check_lies_within(enough, "the board"));
    }
    const auto said = [&](const Memories& memories) {
        return test::refusal(glsum::Exit::bad_input, [&] { elf.check_lies_within(memories, "the board"); });
    };
    const std::string path = folder.file("a.elf").string();
    EXPECT_EQ(said({{0x100, 0x107}, {0x20000000, 0x20000003}}),
              path +
                  ": section .text lies at 0x00000100 to 0x00000108; link it into the memories of the board: "
                  "0x00000100 to 0x00000107, 0x20000000 to 0x20000003");
    EXPECT_EQ(said({{0x20000001, 0x20000100}, {0x100, 0x108}}),
              path +
                  ": section .data lies at 0x20000000 to 0x20000003; link it into the memories of the board: "
                  "0x20000001 to 0x20000100, 0x00000100 to 0x00000108");
    EXPECT_NE(said({{0x100, 0x104}, {0x104, 0x108}, {0x20000000, 0x20000003}}).find("section .text"),
              std::string::npos);  // not in parts
}

// What restores registers ends where its symbol says, or where the next function begins. A function's cold part has its
// number, and behind the last function there is none.
TEST(Unwinding, IsOfTheProgramsRestorersAndFunctions) {
    const base::Scratch folder;
    test::MadeElf made;
    made.sections = {{0x100, test::bytes_of({1, 2})}};
    made.symbols = {{"f", 0x101, 0x20, true}, {"g", 0x281, 4, true}, {"f.cold", 0x301, 8, true}};
    made.write(folder.file("plain.elf"));
    const timing::Unwinding none = qemu::unwinding_of(qemu::Elf(folder.file("plain.elf")));
    EXPECT_TRUE(none.restorers.empty());
    EXPECT_TRUE(none.functions.empty());
    made.symbols.push_back({"__restore_core_regs", 0x201, 0x10, true});
    made.symbols.push_back({"longjmp", 0x241, 0, true});
    made.write(folder.file("unwinds.elf"));
    const timing::Unwinding own = qemu::unwinding_of(qemu::Elf(folder.file("unwinds.elf")));
    ASSERT_EQ(own.restorers.size(), 2U);
    EXPECT_EQ(own.restorers[0].begin, 0x200U);
    EXPECT_EQ(own.restorers[0].end, 0x210U);
    EXPECT_EQ(own.restorers[1].begin, 0x240U);
    EXPECT_EQ(own.restorers[1].end, 0x280U);
    EXPECT_EQ(own.functions, (std::map<std::uint32_t, std::uint32_t>{
                                 {0x100, 0x100}, {0x200, 0x200}, {0x280, 0x280}, {0x300, 0x100}, {0x308, 0}}));
}

TEST(SoftwareDouble, IsToldByTheNamesOfItsRoutines) {
    for (const char* name :
         {"__aeabi_dadd", "__aeabi_drsub", "__aeabi_dcmpun", "__aeabi_cdrcmple", "__aeabi_d2ulz", "__aeabi_ul2d",
          "__aeabi_f2d", "__adddf3", "__negdf2", "__unorddf2", "__fixunsdfdi", "__floatundidf", "__truncdfsf2"}) {
        EXPECT_TRUE(qemu::is_double_routine(name)) << name;
    }
    for (const char* name : {"__aeabi_fadd", "__aeabi_fcmpun", "__aeabi_f2iz", "__aeabi_i2f", "__aeabi_ldivmod",
                             "__addsf3", "__floatsisf", "__divdi3", "dadd", "__aeabi_dadd_of_mine", "__aeabi_memcpy"}) {
        EXPECT_FALSE(qemu::is_double_routine(name)) << name;
    }
}

TEST(Elf, TellsTheRoutinesThatComputeInDoublePrecision) {
    if (!std::filesystem::exists(measure_elf)) {
        GTEST_SKIP() << "no " << measure_elf;
    }
    const qemu::Elf elf(measure_elf);
    const std::vector<timing::AddressRange> ranges = qemu::double_routines(elf);
    const auto holds = [&](std::uint32_t address) {
        return std::any_of(ranges.begin(), ranges.end(), [&](const timing::AddressRange& range) {
            return range.begin <= address && address < range.end;
        });
    };
    for (const char* name : {"__aeabi_dadd", "__aeabi_dsub", "__aeabi_drsub", "__aeabi_dmul", "__aeabi_d2f",
                             "__aeabi_f2d", "__aeabi_i2d", "__aeabi_ui2d", "__aeabi_dcmpeq", "__aeabi_cdcmpeq"}) {
        EXPECT_TRUE(holds(elf.symbol(name).value_or(0))) << name;
    }
    // To their last byte, of 634, and no further.
    const std::uint32_t subtraction = elf.symbol("__aeabi_dsub").value_or(0);
    EXPECT_TRUE(holds(elf.end_of_function(subtraction) - 2));
    for (const char* name : {"memcpy", "__aeabi_uldivmod", "main"}) {
        EXPECT_FALSE(holds(elf.symbol(name).value_or(0))) << name;
    }
}

}  // namespace
