// The decoder against binutils' disassembler, over whole programs and libraries: same mnemonics, same registers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "listing.hpp"
#include "qemu/timing/decode.hpp"

namespace {

namespace registers = timing::registers;

constexpr const char* conditions[] = {"eq", "ne", "cs", "cc", "mi", "pl", "vs", "vc",
                                      "hi", "ls", "ge", "lt", "gt", "le", "",   ""};

// objdump's other names for the same encodings.
std::string base_name(const timing::Decoded& d) {
    static const std::map<std::string, std::string> others{{"adr", "add"}, {"pli", "pli"}};
    const auto other = others.find(d.mnemonic);
    return other == others.end() ? d.mnemonic : other->second;
}

std::string our_name(const timing::Decoded& d, const std::string& theirs) {
    const std::string base = base_name(d);
    if (base == "it") {
        return theirs.starts_with("it") && theirs.size() <= 5 ? theirs : "it";
    }
    const bool compares = base == "cmp" || base == "cmn" || base == "tst" || base == "teq" || base == "vmrs";
    return base + (d.sets_flags && !compares ? "s" : "") + conditions[d.condition];
}

// Without width and data types.
std::string their_name(const listing::Line& line) {
    std::string name = line.mnemonic.substr(0, line.mnemonic.find('.'));
    const auto is = [&](const char* prefix) { return name.starts_with(prefix); };
    if (is("neg") && !is("nege")) {
        name = "rsb" + name.substr(3);
    }
    if (line.operands.find("pc, #") != std::string::npos && (is("addw") || is("subw"))) {
        name = "add" + name.substr(4);
    }
    return name;
}

std::set<unsigned> our_registers(const timing::Decoded& d) {
    std::set<unsigned> found;
    for (int i = 0; i < d.read_count; ++i) {
        found.insert(d.reads[i].reg);
    }
    for (int i = 0; i < d.write_count; ++i) {
        found.insert(d.writes[i].reg);
    }
    for (const unsigned unnamed : {registers::flags, registers::ge, registers::fp_flags}) {
        found.erase(unnamed);
    }
    return found;
}

// Registers that the text does not name.
std::set<unsigned> implied(const timing::Decoded& d) {
    const std::string name = d.mnemonic;
    if (name == "push" || name == "pop" || name == "vpush" || name == "vpop") {
        return {registers::sp};
    }
    if (d.branch == timing::Branch::call || name == "blx") {
        return {registers::lr};
    }
    return {};
}

struct Counts {
    std::size_t instructions = 0;
    std::size_t wrong = 0;
};

Counts compare(const std::filesystem::path& file) {
    Counts counts;
    timing::ItBlock it;
    for (const listing::Line& line : listing::disassemble(file)) {
        const bool inside = it.inside();
        const timing::Decoded d = timing::decode(line.encoding, line.bytes, it.condition(), inside);
        if (inside) {
            it.advance();
        }
        if (d.kind == timing::Kind::if_then) {
            it.begin(line.encoding);
        }
        ++counts.instructions;
        std::set<unsigned> ours = our_registers(d);
        for (const unsigned reg : implied(d)) {
            ours.erase(reg);
        }
        std::set<unsigned> theirs = listing::registers_in(line.operands);
        if (d.kind == timing::Kind::system) {
            ours.clear();
            theirs.clear();
        }
        for (const unsigned reg : implied(d)) {
            theirs.erase(reg);
        }
        const bool same_name = our_name(d, their_name(line)) == their_name(line);
        if ((!same_name || ours != theirs) && ++counts.wrong <= 20) {
            ADD_FAILURE() << file.filename().string() << " " << std::hex << line.address << " " << line.encoding
                          << ": objdump has " << line.mnemonic << " " << line.operands << "; decoded as "
                          << our_name(d, their_name(line)) << " with registers " << testing::PrintToString(ours);
        }
    }
    return counts;
}

TEST(Objdump, AgreesOnTheFirmware) {
    const std::filesystem::path folder(TEST_FIRMWARE_BUILD "/targets");
    for (const char* name : {"measure.elf", "replay.elf", "selftest.elf"}) {
        if (!std::filesystem::exists(folder / name)) {
            ASSERT_EQ(std::getenv("GLSUM_REQUIRE_FIRMWARE"), nullptr) << name;
            GTEST_SKIP() << "no firmware in " << folder;
        }
        const Counts counts = compare(folder / name);
        EXPECT_GT(counts.instructions, 10000U);
        EXPECT_EQ(counts.wrong, 0U);
    }
}

TEST(Objdump, AgreesOnTheLibrariesOfTheCompiler) {
    const std::filesystem::path newlib("/usr/lib/arm-none-eabi/newlib/thumb/v7e-m+dp/hard");
    if (!std::filesystem::exists(newlib)) {
        GTEST_SKIP() << "no newlib in " << newlib;
    }
    std::size_t instructions = 0;
    for (const char* name : {"libm.a", "libc.a", "libstdc++.a"}) {
        const Counts counts = compare(newlib / name);
        instructions += counts.instructions;
        EXPECT_EQ(counts.wrong, 0U) << name;
    }
    EXPECT_GT(instructions, 300000U);
}

}  // namespace
