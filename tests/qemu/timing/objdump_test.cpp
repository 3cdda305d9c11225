// The decoder against binutils' disassembler, over whole programs and libraries: same mnemonics, same registers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

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

Counts compare(const std::vector<listing::Line>& lines, const std::string& from) {
    Counts counts;
    timing::ItBlock it;
    for (const listing::Line& line : lines) {
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
            ADD_FAILURE() << from << " " << std::hex << line.address << " " << line.encoding << ": objdump has "
                          << line.mnemonic << " " << line.operands << "; decoded as " << our_name(d, their_name(line))
                          << " with registers " << testing::PrintToString(ours);
        }
    }
    return counts;
}

Counts compare(const std::filesystem::path& file) {
    return compare(listing::disassemble(file), file.filename().string());
}

// Instructions with registers drawn for each: r any of r0 to r12, l of r0 to r7, s and d of the FPU, all different in a
// line, and i a number of 1 to 31.
constexpr const char* forms[] = {
    "adds %l, %l, %l",
    "adds %l, %l, #3",
    "adds %l, #200",
    "subs %l, %l, %l",
    "subs %l, %l, #7",
    "subs %l, #99",
    "movs %l, #%i",
    "cmp %l, #%i",
    "lsls %l, %l, #%i",
    "lsrs %l, %l, #%i",
    "asrs %l, %l, #%i",
    "movs %l, %l",
    "ands %l, %l",
    "eors %l, %l",
    "lsls %l, %l",
    "lsrs %l, %l",
    "asrs %l, %l",
    "adcs %l, %l",
    "sbcs %l, %l",
    "rors %l, %l",
    "tst %l, %l",
    "rsbs %l, %l, #0",
    "cmp %l, %l",
    "cmn %l, %l",
    "orrs %l, %l",
    "bics %l, %l",
    "mvns %l, %l",
    "add %r, %r",
    "cmp %r, %r",
    "mov %r, %r",
    "bx %r",
    "blx %r",
    "ldr %l, [pc, #16]",
    "str %l, [%l, %l]",
    "strh %l, [%l, %l]",
    "strb %l, [%l, %l]",
    "ldrsb %l, [%l, %l]",
    "ldr %l, [%l, %l]",
    "ldrh %l, [%l, %l]",
    "ldrb %l, [%l, %l]",
    "ldrsh %l, [%l, %l]",
    "str %l, [%l, #4]",
    "ldr %l, [%l, #8]",
    "strb %l, [%l, #3]",
    "ldrb %l, [%l, #5]",
    "strh %l, [%l, #6]",
    "ldrh %l, [%l, #2]",
    "str %l, [sp, #8]",
    "ldr %l, [sp, #8]",
    "add %l, pc, #8",
    "add %l, sp, #8",
    "add sp, #16",
    "sub sp, #16",
    "cbz %l, .+8",
    "cbnz %l, .+8",
    "sxth %l, %l",
    "sxtb %l, %l",
    "uxth %l, %l",
    "uxtb %l, %l",
    "rev %l, %l",
    "rev16 %l, %l",
    "revsh %l, %l",
    "push {%l, lr}",
    "pop {%l, pc}",
    "stmia %l!, {%l}",
    "ldmia %l!, {%l}",
    "b .",
    "bne .",
    "bl .",
    "b.w .",
    "bne.w .",
    "and.w %r, %r, %r",
    "and.w %r, %r, %r, lsl #%i",
    "ands.w %r, %r, #0xff00",
    "bic.w %r, %r, %r, lsr #%i",
    "orr.w %r, %r, %r, asr #%i",
    "orn %r, %r, %r",
    "eor.w %r, %r, %r, ror #%i",
    "add.w %r, %r, %r",
    "adds.w %r, %r, %r, lsl #%i",
    "adc.w %r, %r, %r",
    "sbcs.w %r, %r, %r",
    "sub.w %r, %r, %r",
    "rsb %r, %r, %r",
    "rsb %r, %r, #0xff00",
    "teq %r, %r",
    "tst.w %r, %r",
    "cmn.w %r, %r",
    "cmp.w %r, %r, lsl #%i",
    "cmp.w %r, #0xff00",
    "mov.w %r, %r",
    "mvn.w %r, %r",
    "mvn.w %r, #0xff00",
    "lsl.w %r, %r, #%i",
    "asrs.w %r, %r, #%i",
    "rrx %r, %r",
    "pkhbt %r, %r, %r",
    "pkhtb %r, %r, %r, asr #%i",
    "addw %r, %r, #1234",
    "subw %r, %r, #1234",
    "movw %r, #1234",
    "movt %r, #1234",
    "ssat %r, #%i, %r",
    "usat %r, #%i, %r, lsl #3",
    "ssat16 %r, #7, %r",
    "usat16 %r, #7, %r",
    "sbfx %r, %r, #3, #5",
    "ubfx %r, %r, #3, #5",
    "bfi %r, %r, #3, #5",
    "bfc %r, #3, #5",
    "lsl.w %r, %r, %r",
    "lsrs.w %r, %r, %r",
    "asr.w %r, %r, %r",
    "ror.w %r, %r, %r",
    "sxth.w %r, %r, ror #8",
    "uxth.w %r, %r",
    "sxtb16 %r, %r",
    "uxtb16 %r, %r",
    "sxtb.w %r, %r",
    "uxtb.w %r, %r",
    "sxtah %r, %r, %r",
    "uxtah %r, %r, %r",
    "sxtab16 %r, %r, %r",
    "uxtab16 %r, %r, %r",
    "sxtab %r, %r, %r, ror #16",
    "uxtab %r, %r, %r",
    "sadd8 %r, %r, %r",
    "qadd8 %r, %r, %r",
    "shadd8 %r, %r, %r",
    "uadd8 %r, %r, %r",
    "uqadd8 %r, %r, %r",
    "uhadd8 %r, %r, %r",
    "sadd16 %r, %r, %r",
    "qadd16 %r, %r, %r",
    "shadd16 %r, %r, %r",
    "uadd16 %r, %r, %r",
    "uqadd16 %r, %r, %r",
    "uhadd16 %r, %r, %r",
    "sasx %r, %r, %r",
    "qasx %r, %r, %r",
    "shasx %r, %r, %r",
    "uasx %r, %r, %r",
    "uqasx %r, %r, %r",
    "uhasx %r, %r, %r",
    "ssub8 %r, %r, %r",
    "usub16 %r, %r, %r",
    "qsub16 %r, %r, %r",
    "ssax %r, %r, %r",
    "uhsax %r, %r, %r",
    "qadd %r, %r, %r",
    "qdadd %r, %r, %r",
    "qsub %r, %r, %r",
    "qdsub %r, %r, %r",
    "rev.w %r, %r",
    "rev16.w %r, %r",
    "rbit %r, %r",
    "revsh.w %r, %r",
    "sel %r, %r, %r",
    "clz %r, %r",
    "mul %r, %r, %r",
    "mla %r, %r, %r, %r",
    "mls %r, %r, %r, %r",
    "smulbb %r, %r, %r",
    "smultt %r, %r, %r",
    "smlabt %r, %r, %r, %r",
    "smuad %r, %r, %r",
    "smladx %r, %r, %r, %r",
    "smulwb %r, %r, %r",
    "smlawt %r, %r, %r, %r",
    "smusd %r, %r, %r",
    "smlsd %r, %r, %r, %r",
    "smmul %r, %r, %r",
    "smmlar %r, %r, %r, %r",
    "smmls %r, %r, %r, %r",
    "usad8 %r, %r, %r",
    "usada8 %r, %r, %r, %r",
    "smull %r, %r, %r, %r",
    "umull %r, %r, %r, %r",
    "smlal %r, %r, %r, %r",
    "umlal %r, %r, %r, %r",
    "umaal %r, %r, %r, %r",
    "smlalbt %r, %r, %r, %r",
    "smlald %r, %r, %r, %r",
    "smlsldx %r, %r, %r, %r",
    "sdiv %r, %r, %r",
    "udiv %r, %r, %r",
    "mrs %r, primask",
    "msr primask, %r",
    "ldr.w %r, [%r, #1000]",
    "ldr %r, [%r, #-9]",
    "ldr %r, [%r], #4",
    "ldr %r, [%r, #-4]!",
    "ldr.w %r, [%r, %r, lsl #2]",
    "ldr.w %r, [pc, #1000]",
    "ldrb.w %r, [%r, #1000]",
    "ldrh.w %r, [%r, %r]",
    "ldrsb.w %r, [%r, #77]",
    "ldrsh.w %r, [%r], #4",
    "str.w %r, [%r, #1000]",
    "str %r, [%r, #-9]",
    "str %r, [%r], #4",
    "strb.w %r, [%r, %r]",
    "strh.w %r, [%r, #-4]!",
    "ldrt %r, [%r, #4]",
    "ldrbt %r, [%r, #4]",
    "ldrht %r, [%r, #4]",
    "ldrsbt %r, [%r, #4]",
    "ldrsht %r, [%r, #4]",
    "strt %r, [%r, #4]",
    "strbt %r, [%r, #4]",
    "strht %r, [%r, #4]",
    "ldrd %r, %r, [%r, #8]",
    "ldrd %r, %r, [%r], #8",
    "ldrd %r, %r, [%r, #-8]!",
    "strd %r, %r, [%r, #8]",
    "strd %r, %r, [%r], #8",
    "ldrex %r, [%r]",
    "ldrexb %r, [%r]",
    "ldrexh %r, [%r]",
    "strex %r, %r, [%r, #4]",
    "strexb %r, %r, [%r]",
    "strexh %r, %r, [%r]",
    "ldmia.w r0, {%h, r1}",
    "ldmdb r0!, {%h, r2}",
    "stmia.w r0!, {%h, r3}",
    "stmdb r0, {%h, r4}",
    "tbb [%r, %r]",
    "tbh [%r, %r, lsl #1]",
    "pld [%r, #4]",
    "pld [%r, %r]",
    "pli [%r, #4]",
    "vmov %r, %r, %d",
    "vmov %d, %r, %r",
    "vstr %s, [%r, #8]",
    "vldr %s, [%r]",
    "vldr %d, [%r, #16]",
    "vstr %d, [%r, #16]",
    "vpush {%s}",
    "vpop {%d}",
    "vldmia %r!, {%s}",
    "vstmia %r, {%d}",
    "vldmdb %r!, {%d}",
    "vstmdb %r!, {%s}",
    "vmla.f32 %s, %s, %s",
    "vmls.f64 %d, %d, %d",
    "vnmla.f32 %s, %s, %s",
    "vnmls.f64 %d, %d, %d",
    "vmul.f32 %s, %s, %s",
    "vmul.f64 %d, %d, %d",
    "vnmul.f32 %s, %s, %s",
    "vadd.f32 %s, %s, %s",
    "vadd.f64 %d, %d, %d",
    "vsub.f32 %s, %s, %s",
    "vdiv.f32 %s, %s, %s",
    "vdiv.f64 %d, %d, %d",
    "vfma.f32 %s, %s, %s",
    "vfms.f64 %d, %d, %d",
    "vfnma.f32 %s, %s, %s",
    "vfnms.f32 %s, %s, %s",
    "vmov.f32 %s, #1.0",
    "vmov.f64 %d, #1.0",
    "vmov.f32 %s, %s",
    "vmov.f64 %d, %d",
    "vabs.f32 %s, %s",
    "vneg.f64 %d, %d",
    "vsqrt.f32 %s, %s",
    "vsqrt.f64 %d, %d",
    "vcvtb.f32.f16 %s, %s",
    "vcvtt.f16.f32 %s, %s",
    "vcvtb.f64.f16 %d, %s",
    "vcvtt.f16.f64 %s, %d",
    "vcmp.f32 %s, %s",
    "vcmpe.f64 %d, %d",
    "vcmp.f32 %s, #0.0",
    "vcmpe.f64 %d, #0.0",
    "vrintr.f32 %s, %s",
    "vrintz.f64 %d, %d",
    "vrintx.f32 %s, %s",
    "vcvt.f64.f32 %d, %s",
    "vcvt.f32.f64 %s, %d",
    "vcvt.f32.s32 %s, %s",
    "vcvt.f64.u32 %d, %s",
    "vcvt.s32.f32 %s, %s",
    "vcvt.u32.f64 %s, %d",
    "vcvtr.s32.f64 %s, %d",
    "vselge.f32 %s, %s, %s",
    "vselgt.f64 %d, %d, %d",
    "vseleq.f32 %s, %s, %s",
    "vselvs.f32 %s, %s, %s",
    "vmaxnm.f32 %s, %s, %s",
    "vminnm.f64 %d, %d, %d",
    "vrinta.f32 %s, %s",
    "vrintn.f64 %d, %d",
    "vrintp.f32 %s, %s",
    "vrintm.f64 %d, %d",
    "vcvta.s32.f32 %s, %s",
    "vcvtn.u32.f64 %s, %d",
    "vcvtp.s32.f32 %s, %s",
    "vcvtm.s32.f64 %s, %d",
    "vmov %s, %r",
    "vmov %r, %s",
    "vmrs %r, fpscr",
    "vmsr fpscr, %r",
};

TEST(Assembled, AgreesWithTheDisassemblerWhateverTheRegisters) {
    std::mt19937_64 random(5);
    std::string text;
    for (const std::string form : forms) {
        for (int again = 0; again < 12; ++again) {
            std::set<std::string> taken;
            std::string line;
            for (std::size_t i = 0; i < form.size(); ++i) {
                if (form[i] != '%') {
                    line += form[i];
                    continue;
                }
                const char kind = form[++i];
                std::string name;
                do {
                    const auto below = [&](unsigned count) { return std::to_string(random() % count); };
                    name = kind == 'r'   ? "r" + below(13)
                           : kind == 'l' ? "r" + below(8)
                           : kind == 'h' ? "r" + std::to_string(8 + random() % 5)
                           : kind == 's' ? "s" + below(32)
                           : kind == 'd' ? "d" + below(16)
                                         : std::to_string(1 + random() % 31);
                } while (!taken.insert(name).second);
                line += name;
            }
            text += line + "\n";
        }
    }
    const auto lines = listing::assemble(text);
    const Counts counts = compare(lines, "assembled");
    EXPECT_GT(counts.instructions, 12U * 250U);
    EXPECT_EQ(counts.wrong, 0U);
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
