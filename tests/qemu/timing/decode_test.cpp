// What the decoder says of single instructions: written by hand, one a row. The assembler encodes them.
#include "qemu/timing/decode.hpp"

#include <gtest/gtest.h>

#include <set>

#include "listing.hpp"

namespace {

using timing::Kind;

std::string name_of(unsigned reg) {
    if (reg >= timing::registers::flags) {
        return reg == timing::registers::flags ? "nzcv" : reg == timing::registers::ge ? "ge" : "fpscr";
    }
    return reg >= timing::registers::s0 ? "s" + std::to_string(reg - timing::registers::s0)
           : reg == 13                  ? "sp"
           : reg == 14                  ? "lr"
           : reg == 15                  ? "pc"
                                        : "r" + std::to_string(reg);
}

// "=r0" is a result, "<r0" a loaded value, "!r0" a written-back base; o operand, s shifted, @ address, * multiplicand,
// + accumulator, d store data, ? condition.
std::set<std::string> words_of(const timing::Decoded& d) {
    std::set<std::string> words;
    for (int i = 0; i < d.write_count; ++i) {
        words.insert(std::string(1, "=<!="[static_cast<int>(d.writes[i].source)]) + name_of(d.writes[i].reg));
    }
    for (int i = 0; i < d.read_count; ++i) {
        words.insert(std::string(1, "os@i*+d?"[static_cast<int>(d.reads[i].role)]) + name_of(d.reads[i].reg));
    }
    return words;
}
std::set<std::string> split(const std::string& text) {
    std::set<std::string> words;
    std::size_t at = 0;
    while (at < text.size()) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        words.insert(text.substr(at, end - at));
        at = end + 1;
    }
    return words;
}

struct Row {
    const char* text;
    Kind kind;
    const char* words;
};

constexpr Row rows[] = {
    // 16 bits
    {"adds r0, r1, r2", Kind::add, "=r0 =nzcv or1 or2"},
    {"adds r0, #1", Kind::add, "=r0 =nzcv or0"},
    {"movs r0, #1", Kind::add, "=r0 =nzcv"},
    {"mov r8, r1", Kind::add, "=r8 or1"},
    {"cmp r0, #1", Kind::add, "=nzcv or0"},
    {"lsls r0, r1, #2", Kind::shift, "=r0 =nzcv or1"},
    {"ands r0, r1", Kind::logic, "=r0 =nzcv or0 or1"},
    {"adcs r0, r1", Kind::logic, "=r0 =nzcv or0 or1 ?nzcv"},
    {"muls r0, r1, r0", Kind::multiply, "=r0 =nzcv *r0 *r1"},
    {"uxtb r0, r1", Kind::bitfield, "=r0 or1"},
    {"rev r0, r1", Kind::bitfield, "=r0 sr1"},
    {"ldr r0, [r1, #4]", Kind::load, "<r0 @r1"},
    {"ldrb r0, [r1, r2]", Kind::load, "<r0 @r1 ir2"},
    {"str r0, [r1, r2]", Kind::store, "dr0 @r1 ir2"},
    {"strh r0, [r1, #2]", Kind::store, "dr0 @r1"},
    {"push {r4, lr}", Kind::store_multiple, "dr4 dlr @sp !sp"},
    {"pop {r4, pc}", Kind::load_multiple, "<r4 <pc @sp !sp"},
    {"stmia r0!, {r1, r2}", Kind::store_multiple, "dr1 dr2 @r0 !r0"},
    {"ldmia r0!, {r1, r2}", Kind::load_multiple, "<r1 <r2 @r0 !r0"},
    {"ldmia r0, {r0, r1}", Kind::load_multiple, "<r0 <r1 @r0"},
    {"bx lr", Kind::branch, "@lr"},
    {"blx r3", Kind::branch, "=lr @r3"},
    {"cbz r0, .+8", Kind::branch, "or0"},
    {"nop", Kind::hint, ""},
    {"bkpt 0xab", Kind::system, ""},
    {"sub sp, #8", Kind::add, "=sp osp"},
    // 32 bits
    {"add.w r8, r1, r2", Kind::add, "=r8 or1 or2"},
    {"add.w r8, r1, r2, lsl #3", Kind::logic, "=r8 or1 sr2"},
    {"adds.w r8, r1, #255", Kind::add, "=r8 =nzcv or1"},
    {"eor.w r0, r1, r2", Kind::logic, "=r0 or1 or2"},
    {"lsl.w r0, r1, #3", Kind::shift, "=r0 or1"},
    {"lsl.w r0, r1, r2", Kind::shift, "=r0 or1 or2"},
    {"rrx r0, r1", Kind::shift, "=r0 or1 ?nzcv"},
    {"mvn.w r0, r1", Kind::logic, "=r0 or1"},
    {"tst.w r0, r1", Kind::logic, "=nzcv or0 or1"},
    {"movw r0, #1234", Kind::add, "=r0"},
    {"movt r0, #1234", Kind::logic, "=r0 or0"},
    {"ubfx r0, r1, #2, #3", Kind::bitfield, "=r0 sr1"},
    {"bfi r0, r1, #2, #3", Kind::bitfield, "=r0 or0 sr1"},
    {"bfc r0, #2, #3", Kind::bitfield, "=r0 or0"},
    {"ssat r0, #31, r1", Kind::bitfield, "=r0 sr1"},
    {"usat16 r0, #7, r1", Kind::bitfield, "=r0 sr1"},
    {"pkhbt r0, r1, r2, lsl #16", Kind::bitfield, "=r0 or1 sr2"},
    {"sxtah r0, r1, r2", Kind::bitfield, "=r0 or1 sr2"},
    {"sadd16 r0, r1, r2", Kind::bitfield, "=r0 =ge or1 or2"},
    {"uqadd8 r0, r1, r2", Kind::bitfield, "=r0 or1 or2"},
    {"sel r0, r1, r2", Kind::bitfield, "=r0 or1 or2 ?ge"},
    {"qadd r0, r1, r2", Kind::bitfield, "=r0 or1 or2"},
    {"clz r0, r1", Kind::bitfield, "=r0 or1"},
    {"mla r0, r1, r2, r3", Kind::multiply, "=r0 *r1 *r2 +r3"},
    {"smmlar r0, r1, r2, r3", Kind::multiply, "=r0 *r1 *r2 +r3"},
    {"smlad r0, r1, r2, r3", Kind::multiply, "=r0 *r1 *r2 +r3"},
    {"smuad r0, r1, r2", Kind::multiply, "=r0 *r1 *r2"},
    {"smlatb r0, r1, r2, r3", Kind::multiply, "=r0 *r1 *r2 +r3"},
    {"smull r0, r1, r2, r3", Kind::multiply, "=r0 =r1 *r2 *r3"},
    {"smlal r0, r1, r2, r3", Kind::multiply, "=r0 =r1 *r2 *r3 +r0 +r1"},
    {"smlaldx r0, r1, r2, r3", Kind::multiply, "=r0 =r1 *r2 *r3 +r0 +r1"},
    {"umaal r0, r1, r2, r3", Kind::multiply, "=r0 =r1 *r2 *r3 +r0 +r1"},
    {"usada8 r0, r1, r2, r3", Kind::multiply, "=r0 *r1 *r2 +r3"},
    {"udiv r0, r1, r2", Kind::divide, "=r0 *r1 *r2"},
    {"ldr.w r0, [r1, #1024]", Kind::load, "<r0 @r1"},
    {"ldr r0, [r1], #4", Kind::load, "<r0 @r1 !r1"},
    {"ldr r0, [r1, #-4]!", Kind::load, "<r0 @r1 !r1"},
    {"ldr.w r0, [r1, r2, lsl #2]", Kind::load, "<r0 @r1 ir2"},
    {"ldrsb.w r0, [r1, #9]", Kind::load, "<r0 @r1"},
    {"str r0, [r1], #4", Kind::store, "dr0 @r1 !r1"},
    {"ldrd r0, r1, [r2, #8]!", Kind::load_multiple, "<r0 <r1 @r2 !r2"},
    {"strd r0, r1, [r2]", Kind::store_multiple, "dr0 dr1 @r2"},
    {"ldmdb r0!, {r1, r2, r8}", Kind::load_multiple, "<r1 <r2 <r8 @r0 !r0"},
    {"strex r0, r1, [r2]", Kind::store, "=r0 dr1 @r2"},
    {"tbb [pc, r0]", Kind::branch, "@pc ir0"},
    {"pld [r0]", Kind::hint, "@r0"},
    {"dsb", Kind::barrier, ""},
    {"mrs r0, primask", Kind::system, "=r0"},
    // The FPU
    {"vadd.f32 s0, s1, s2", Kind::fp_add, "=s0 os1 os2"},
    {"vmul.f32 s0, s1, s2", Kind::fp_mul, "=s0 *s1 *s2"},
    {"vfma.f32 s0, s1, s2", Kind::fp_mac, "=s0 +s0 *s1 *s2"},
    {"vfnms.f32 s0, s1, s2", Kind::fp_mac, "=s0 +s0 *s1 *s2"},
    {"vmls.f32 s30, s31, s1", Kind::fp_mac, "=s30 +s30 *s31 *s1"},
    {"vfma.f64 d1, d2, d15", Kind::fp_mac, "=s2 =s3 +s2 +s3 *s4 *s5 *s30 *s31"},
    {"vdiv.f32 s0, s1, s2", Kind::fp_divide, "=s0 os1 os2"},
    {"vsqrt.f64 d0, d1", Kind::fp_sqrt, "=s0 =s1 os2 os3"},
    {"vcmp.f32 s0, s1", Kind::fp_add, "=fpscr os0 os1"},
    {"vcmpe.f32 s0, #0", Kind::fp_add, "=fpscr os0"},
    {"vmrs apsr_nzcv, fpscr", Kind::fp_to_core, "=nzcv ?fpscr"},
    {"vcvt.f64.f32 d0, s3", Kind::fp_convert, "=s0 =s1 os3"},
    {"vcvt.f32.f64 s3, d0", Kind::fp_convert, "=s3 os0 os1"},
    {"vcvt.s32.f64 s3, d1", Kind::fp_convert, "=s3 os2 os3"},
    {"vcvt.f32.s32 s3, s4", Kind::fp_convert, "=s3 os4"},
    {"vcvt.s32.f32 s3, s3, #15", Kind::fp_convert, "=s3 os3"},
    {"vrinta.f32 s0, s1", Kind::fp_convert, "=s0 os1"},
    {"vselge.f32 s0, s1, s2", Kind::fp_add, "=s0 os1 os2 ?nzcv"},
    {"vmaxnm.f32 s0, s1, s2", Kind::fp_add, "=s0 os1 os2"},
    {"vmov.f32 s0, s1", Kind::fp_move, "=s0 os1"},
    {"vmov.f32 s0, #1.0", Kind::fp_move_immediate, "=s0"},
    {"vmov s0, r1", Kind::fp_from_core, "=s0 or1"},
    {"vmov r1, s0", Kind::fp_to_core, "=r1 os0"},
    {"vmov s4, s5, r0, r1", Kind::fp_from_core, "=s4 =s5 or0 or1"},
    {"vmov r0, r1, d3", Kind::fp_to_core, "=r0 =r1 os6 os7"},
    {"vmov.32 d1[1], r0", Kind::fp_from_core, "=s3 or0"},
    {"vmov.32 d14[0], r7", Kind::fp_from_core, "=s28 or7"},
    {"vmov.32 r0, d2[0]", Kind::fp_to_core, "=r0 os4"},
    {"vmov.32 r9, d15[1]", Kind::fp_to_core, "=r9 os31"},
    {"vmsr fpscr, r3", Kind::fp_from_core, "=fpscr or3"},
    {"vmrs r3, fpscr", Kind::fp_to_core, "=r3 ?fpscr"},
    {"vcvtb.f64.f16 d1, s5", Kind::fp_convert, "=s2 =s3 os5"},
    {"vcvtt.f16.f64 s5, d1", Kind::fp_convert, "=s5 os2 os3"},
    {"vldr s5, [r0, #8]", Kind::load, "<s5 @r0"},
    {"vldr d5, [r0, #8]", Kind::load_multiple, "<s10 <s11 @r0"},
    {"vstr s5, [r0]", Kind::store, "ds5 @r0"},
    {"vldmia r0!, {s4-s6}", Kind::load_multiple, "<s4 <s5 <s6 @r0 !r0"},
    {"vstmdb r0!, {d1}", Kind::store_multiple, "ds2 ds3 @r0 !r0"},
    {"vpush {d8}", Kind::store_multiple, "ds16 ds17 @sp !sp"},
    {"vpop {s16}", Kind::load_multiple, "<s16 @sp !sp"},
    // Of high registers, shifts and places whose encodings differ in one bit
    {"eor.w r9, r10, r11", Kind::logic, "=r9 or10 or11"},
    {"eor.w r9, r10, r11, lsl #1", Kind::logic, "=r9 or10 sr11"},
    {"eor.w r9, r10, r11, lsl #4", Kind::logic, "=r9 or10 sr11"},
    {"eor.w r9, r10, r11, lsr #32", Kind::logic, "=r9 or10 sr11"},
    {"eor.w r9, r10, r11, rrx", Kind::logic, "=r9 or10 sr11 ?nzcv"},
    {"eor.w r9, r10, r11, ror #4", Kind::logic, "=r9 or10 sr11"},
    {"mov.w r9, r10", Kind::add, "=r9 or10"},
    {"mov.w r9, r10, lsl #4", Kind::shift, "=r9 or10"},
    {"mov.w r9, r10, ror #1", Kind::shift, "=r9 or10"},
    {"orr.w r9, r10, r11, asr #2", Kind::logic, "=r9 or10 sr11"},
    {"orn r9, r10, r11", Kind::logic, "=r9 or10 or11"},
    {"bic.w r9, r10, r11", Kind::logic, "=r9 or10 or11"},
    {"rsb.w r9, r10, r11", Kind::logic, "=r9 or10 or11"},
    {"sbc.w r9, r10, r11", Kind::logic, "=r9 or10 or11 ?nzcv"},
    {"adcs.w r9, r10, r11", Kind::logic, "=r9 =nzcv or10 or11 ?nzcv"},
    {"sub.w r9, r10, r11", Kind::add, "=r9 or10 or11"},
    {"teq.w r9, r10", Kind::logic, "=nzcv or9 or10"},
    {"cmn.w r9, r10", Kind::add, "=nzcv or9 or10"},
    {"cmp.w r9, r10", Kind::add, "=nzcv or9 or10"},
    {"mvn.w r9, #1", Kind::logic, "=r9"},
    {"mov.w r9, #0xff0000", Kind::add, "=r9"},
    {"adc.w r9, r10, #1", Kind::logic, "=r9 or10 ?nzcv"},
    {"tst.w r9, #1", Kind::logic, "=nzcv or9"},
    {"subw r9, r10, #1234", Kind::add, "=r9 or10"},
    {"movt r9, #65535", Kind::logic, "=r9 or9"},
    {"sbfx r9, r10, #3, #4", Kind::bitfield, "=r9 sr10"},
    {"bfi r9, r10, #5, #6", Kind::bitfield, "=r9 or9 sr10"},
    {"usat r9, #5, r10, lsl #4", Kind::bitfield, "=r9 sr10"},
    {"pkhtb r9, r10, r11, asr #1", Kind::bitfield, "=r9 sr10 sr11"},
    {"pkhbt r9, r10, r11, lsl #4", Kind::bitfield, "=r9 or10 sr11"},
    {"pkhbt r9, r10, r11", Kind::bitfield, "=r9 or10 sr11"},
    {"asr.w r9, r10, r11", Kind::shift, "=r9 or10 or11"},
    {"uxtb.w r9, r10", Kind::bitfield, "=r9 or10"},
    {"uxtb.w r9, r2, ror #8", Kind::bitfield, "=r9 or2"},
    {"uxtb.w r9, r2, ror #16", Kind::bitfield, "=r9 or2"},
    {"uxtab r9, r10, r11", Kind::bitfield, "=r9 or10 sr11"},
    {"sxtb16 r9, r10", Kind::bitfield, "=r9 or10"},
    {"sasx r9, r10, r11", Kind::bitfield, "=r9 =ge or10 or11"},
    {"uhsub16 r9, r10, r11", Kind::bitfield, "=r9 or10 or11"},
    {"qsax r9, r10, r11", Kind::bitfield, "=r9 or10 or11"},
    {"qdadd r9, r10, r11", Kind::bitfield, "=r9 sr10 sr11"},
    {"rbit r9, r10", Kind::bitfield, "=r9 sr10"},
    {"clz r9, r10", Kind::bitfield, "=r9 or10"},
    {"sel r9, r10, r11", Kind::bitfield, "=r9 or10 or11 ?ge"},
    {"mul r9, r10, r11", Kind::multiply, "=r9 *r10 *r11"},
    {"mls r9, r10, r11, r12", Kind::multiply, "=r9 *r10 *r11 +r12"},
    {"umull r9, r10, r11, r12", Kind::multiply, "=r9 =r10 *r11 *r12"},
    {"smlalbt r9, r10, r11, r12", Kind::multiply, "=r9 =r10 *r11 *r12 +r9 +r10"},
    {"sdiv r9, r10, r11", Kind::divide, "=r9 *r10 *r11"},
    {"msr primask, r10", Kind::system, "or10"},
    {"mrs r10, primask", Kind::system, "=r10"},
    {"ldr.w r9, [r10, r11, lsl #3]", Kind::load, "<r9 @r10 ir11"},
    {"ldrb.w r9, [r10], #-1", Kind::load, "<r9 @r10 !r10"},
    {"ldrsh.w r9, [r10, r11]", Kind::load, "<r9 @r10 ir11"},
    {"ldrh.w r9, [r10, #-8]", Kind::load, "<r9 @r10"},
    {"str.w r9, [r10, r11]", Kind::store, "dr9 @r10 ir11"},
    {"strh.w r9, [r10, #-8]!", Kind::store, "dr9 @r10 !r10"},
    {"ldrd r9, r10, [r11], #-8", Kind::load_multiple, "<r9 <r10 @r11 !r11"},
    {"ldrd r9, r10, [r11, #-8]", Kind::load_multiple, "<r9 <r10 @r11"},
    {"strd r9, r10, [r11, #8]!", Kind::store_multiple, "dr9 dr10 @r11 !r11"},
    {"stmdb r9!, {r1, r10, r12}", Kind::store_multiple, "dr1 dr10 dr12 @r9 !r9"},
    {"ldm.w r9, {r1, r10}", Kind::load_multiple, "<r1 <r10 @r9"},
    {"ldrex r9, [r10]", Kind::load, "<r9 @r10"},
    {"strexb r9, r10, [r11]", Kind::store, "=r9 dr10 @r11"},
    {"tbh [r9, r10, lsl #1]", Kind::branch, "@r9 ir10"},
    {"vadd.f32 s31, s16, s17", Kind::fp_add, "=s31 os16 os17"},
    {"vmul.f64 d15, d14, d13", Kind::fp_mul, "=s30 =s31 *s28 *s29 *s26 *s27"},
    {"vnmul.f32 s31, s30, s29", Kind::fp_mul, "=s31 *s30 *s29"},
    {"vfnma.f32 s31, s16, s17", Kind::fp_mac, "=s31 +s31 *s16 *s17"},
    {"vdiv.f64 d15, d14, d13", Kind::fp_divide, "=s30 =s31 os28 os29 os26 os27"},
    {"vsqrt.f32 s31, s16", Kind::fp_sqrt, "=s31 os16"},
    {"vcmp.f64 d15, d14", Kind::fp_add, "=fpscr os30 os31 os28 os29"},
    {"vcvt.f64.f32 d15, s31", Kind::fp_convert, "=s30 =s31 os31"},
    {"vcvt.f32.f64 s31, d15", Kind::fp_convert, "=s31 os30 os31"},
    {"vcvt.u32.f64 s31, d15", Kind::fp_convert, "=s31 os30 os31"},
    {"vcvt.f64.u32 d15, s31", Kind::fp_convert, "=s30 =s31 os31"},
    {"vcvta.s32.f32 s31, s16", Kind::fp_convert, "=s31 os16"},
    {"vcvtb.f32.f16 s31, s16", Kind::fp_convert, "=s31 os16"},
    {"vrintz.f64 d15, d14", Kind::fp_convert, "=s30 =s31 os28 os29"},
    {"vselgt.f64 d15, d14, d13", Kind::fp_add, "=s30 =s31 os28 os29 os26 os27 ?nzcv"},
    {"vminnm.f64 d15, d14, d13", Kind::fp_add, "=s30 =s31 os28 os29 os26 os27"},
    {"vmov.f64 d15, d14", Kind::fp_move, "=s30 =s31 os28 os29"},
    {"vmov s31, r9", Kind::fp_from_core, "=s31 or9"},
    {"vmov r9, s31", Kind::fp_to_core, "=r9 os31"},
    {"vmov r9, r10, s30, s31", Kind::fp_to_core, "=r9 =r10 os30 os31"},
    {"vmov d15, r9, r10", Kind::fp_from_core, "=s30 =s31 or9 or10"},
    {"vldr s31, [r9, #-8]", Kind::load, "<s31 @r9"},
    {"vstr d15, [r9, #8]", Kind::store_multiple, "ds30 ds31 @r9"},
    {"vldmia r9, {s30, s31}", Kind::load_multiple, "<s30 <s31 @r9"},
    {"vstmdb r9!, {d14, d15}", Kind::store_multiple, "ds28 ds29 ds30 ds31 @r9 !r9"},
    {"mov r1, r9", Kind::add, "=r1 or9"},
    {"add r9, r10", Kind::add, "=r9 or9 or10"},
    {"cmp r9, r10", Kind::add, "=nzcv or9 or10"},
    {"bx r9", Kind::branch, "@r9"},
    {"add r7, sp, #1020", Kind::add, "=r7 osp"},
    {"ldr r7, [sp, #4]", Kind::load, "<r7 @sp"},
    {"ldrsb r7, [r6, r5]", Kind::load, "<r7 @r6 ir5"},
    {"subs r7, r6, r5", Kind::add, "=r7 =nzcv or6 or5"},
    {"subs r7, r6, #7", Kind::add, "=r7 =nzcv or6"},
    {"asrs r7, r6, #31", Kind::shift, "=r7 =nzcv or6"},
    {"asrs r7, r6, #32", Kind::shift, "=r7 =nzcv or6"},  // coded as one of 0
    {"lsrs r7, r6, #32", Kind::shift, "=r7 =nzcv or6"},
    {"movs r7, r6", Kind::add, "=r7 =nzcv or6"},
    {"rors r7, r6", Kind::shift, "=r7 =nzcv or7 or6"},
    {"rsbs r7, r6, #0", Kind::logic, "=r7 =nzcv or6"},
    {"tst r7, r6", Kind::logic, "=nzcv or7 or6"},
    {"cbnz r7, .+8", Kind::branch, "or7"},
    {"push {r0, r7}", Kind::store_multiple, "dr0 dr7 @sp !sp"},
};

TEST(Decode, KnowsKindsRegistersAndRoles) {
    std::string text;
    for (const Row& row : rows) {
        text += std::string(row.text) + "\n";
    }
    const auto lines = listing::assemble(text);
    ASSERT_EQ(lines.size(), std::size(rows));
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const timing::Decoded d = timing::decode(lines[i].encoding, lines[i].bytes);
        EXPECT_EQ(static_cast<int>(d.kind), static_cast<int>(rows[i].kind)) << rows[i].text;
        EXPECT_EQ(words_of(d), split(rows[i].words)) << rows[i].text;
    }
}

timing::Decoded of(const std::string& text) {
    const auto lines = listing::assemble(text);
    return timing::decode(lines.at(0).encoding, lines.at(0).bytes);
}

TEST(Decode, TellsBranchesApart) {
    EXPECT_EQ(of("b .").branch, timing::Branch::direct);
    EXPECT_EQ(of("bne .").branch, timing::Branch::conditional);
    EXPECT_EQ(of("bne.w .").branch, timing::Branch::conditional);
    EXPECT_EQ(of("cbnz r0, .+4").branch, timing::Branch::conditional);
    EXPECT_EQ(of("bl .").branch, timing::Branch::call);
    EXPECT_EQ(of("blx r0").branch, timing::Branch::indirect);
    EXPECT_EQ(of("bx r0").branch, timing::Branch::indirect);
    EXPECT_EQ(of("bx lr").branch, timing::Branch::back);
    EXPECT_EQ(of("pop {r4, pc}").branch, timing::Branch::back);
    EXPECT_EQ(of("pop.w {r4, r8, pc}").branch, timing::Branch::back);
    EXPECT_EQ(of("ldr pc, [sp], #4").branch, timing::Branch::back);
    EXPECT_EQ(of("ldr.w pc, [r0]").branch, timing::Branch::indirect);
    EXPECT_EQ(of("mov pc, r1").branch, timing::Branch::indirect);
    EXPECT_EQ(of("add r0, r1").branch, timing::Branch::none);
    EXPECT_EQ(of("bge.w .").condition, 0xA);
    EXPECT_EQ(of("bls.w .").condition, 0x9);
    EXPECT_EQ(of("bgt .").condition, 0xC);
}

TEST(Decode, TheShifterIsUsedByShiftedOperandsAndShiftedConstants) {
    EXPECT_TRUE(of("add.w r0, r1, r2, lsl #2").uses_shifter);
    EXPECT_TRUE(of("add.w r0, r1, #0xff00").uses_shifter);
    EXPECT_FALSE(of("add.w r0, r1, #0xff").uses_shifter);
    EXPECT_FALSE(of("add.w r0, r1, #0x00ff00ff").uses_shifter);
    EXPECT_FALSE(of("lsl.w r0, r1, #2").uses_shifter);
    EXPECT_FALSE(of("add.w r0, r1, r2").uses_shifter);
}

TEST(Decode, InAnItBlockNarrowArithmeticSetsNoFlagsAndReadsThem) {
    const auto lines = listing::assemble("it eq\naddeq r0, r1, r2\n");
    const timing::Decoded d = timing::decode(lines[1].encoding, 2, 0x0, true);
    EXPECT_EQ(words_of(d), split("=r0 or1 or2 ?nzcv"));
}

// How many registers a transfer has and of how many bytes each, and what else the pipeline asks: written by hand.
struct Facts {
    const char* text;
    const char* facts;
};

std::string facts_of(const timing::Decoded& d) {
    std::string text;
    const auto add = [&](const std::string& word) { text += (text.empty() ? "" : " ") + word; };
    if (d.registers > 0) {
        add(std::to_string(d.registers) + "x" + std::to_string(d.access_bytes));
    }
    for (const auto& [holds, word] :
         {std::pair(d.backward, "backward"), std::pair(d.sets_flags, "flags"), std::pair(d.uses_shifter, "shifter"),
          std::pair(d.fused, "fused"), std::pair(d.is_double, "double"), std::pair(d.is_fp, "fpu"),
          std::pair(d.both_fp_ports, "both"), std::pair(d.early_result, "early"),
          std::pair(d.saturates, "saturates")}) {
        if (holds) {
            add(word);
        }
    }
    return text;
}

constexpr Facts facts[] = {
    {"ldr r0, [r1]", "1x4"},
    {"ldrh r0, [r1, #2]", "1x2"},
    {"ldrb r0, [r1, #1]", "1x1"},
    {"ldrsb r0, [r1, r2]", "1x1"},
    {"ldrsh r0, [r1, r2]", "1x2"},
    {"ldrb r0, [r1, r2]", "1x1"},
    {"ldrh r0, [r1, r2]", "1x2"},
    {"ldr r0, [r1, r2]", "1x4"},
    {"str r0, [r1, r2]", "1x4"},
    {"strh r0, [r1, r2]", "1x2"},
    {"strb r0, [r1, r2]", "1x1"},
    {"str r0, [r1, #4]", "1x4"},
    {"strh r0, [r1, #2]", "1x2"},
    {"strb r0, [r1, #1]", "1x1"},
    {"str r0, [sp, #4]", "1x4"},
    {"ldr r0, [sp, #4]", "1x4"},
    {"ldr r0, [pc, #4]", "1x4"},
    {"push {r0, r2, lr}", "3x4"},
    {"pop {r1, r3, pc}", "3x4"},
    {"ldmia r0!, {r1-r4}", "4x4"},
    {"stmia r0!, {r1, r7}", "2x4"},
    {"ldr.w r0, [r1, #1000]", "1x4"},
    {"ldrh.w r0, [r1, #1000]", "1x2"},
    {"ldrb.w r0, [r1, #1000]", "1x1"},
    {"ldrsh.w r0, [r1, #1000]", "1x2"},
    {"ldrsb.w r0, [r1, #1000]", "1x1"},
    {"str.w r0, [r1, #1000]", "1x4"},
    {"strh.w r0, [r1, #1000]", "1x2"},
    {"strb.w r0, [r1, #1000]", "1x1"},
    {"ldrd r0, r1, [r2]", "2x4"},
    {"strd r0, r1, [r2]", "2x4"},
    {"ldmdb r0, {r1, r8, r9}", "3x4"},
    {"ldrex r0, [r1]", "1x4"},
    {"ldrexb r0, [r1]", "1x1"},
    {"ldrexh r0, [r1]", "1x2"},
    {"strex r0, r1, [r2]", "1x4"},
    {"strexb r0, r1, [r2]", "1x1"},
    {"strexh r0, r1, [r2]", "1x2"},
    {"tbb [r0, r1]", "1x1"},
    {"tbh [r0, r1, lsl #1]", "1x2"},
    {"pld [r0]", ""},
    {"vldr s0, [r0]", "1x4 fpu"},
    {"vldr d0, [r0]", "2x4 double fpu"},
    {"vstr d1, [r0]", "2x4 double fpu"},
    {"vldmia r0, {s1-s5}", "5x4 fpu"},
    {"vstmia r0!, {d1-d3}", "6x4 double fpu"},
    {"vpush {d8, d9}", "4x4 double fpu"},
    {"b .-4", "backward"},
    {"b .+8", ""},
    {"beq .-4", "backward"},
    {"beq .+8", ""},
    {"b.w .-4", "backward"},
    {"b.w .+8", ""},
    {"beq.w .-4", "backward"},
    {"beq.w .+8", ""},
    {"bl .-4", ""},
    {"adds r0, r1, r2", "flags"},
    {"add r0, r8", ""},
    {"cmp r0, r1", "flags"},
    {"cmp r0, r8", "flags"},
    {"cmp r0, #1", "flags"},
    {"movs r0, #1", "flags"},
    {"lsls r0, r1, #2", "flags"},
    {"muls r0, r1, r0", "flags"},
    {"mvns r0, r1", "flags"},
    {"adcs r0, r1", "flags"},
    {"adds.w r0, r8, r1", "flags"},
    {"add.w r0, r8, r1", ""},
    {"tst.w r0, r8", "flags"},
    {"lsls.w r0, r8, r1", "flags"},
    {"lsl.w r0, r8, r1", ""},
    {"vmrs apsr_nzcv, fpscr", "flags fpu both"},
    {"add.w r0, r8, r1, lsl #2", "shifter"},
    {"add.w r0, r1, #0x100", "shifter"},
    {"add.w r0, r1, #0xff0000", "shifter"},
    {"add.w r0, r1, #0xff000000", "shifter"},
    {"add.w r0, r1, #0xff00ff00", ""},
    {"add.w r0, r1, #0xffffffff", ""},
    {"eor.w r9, r10, r11, lsl #4", "shifter"},
    {"eor.w r9, r10, r11, rrx", "shifter"},
    {"mov.w r9, r10, lsl #4", ""},
    {"add.w r0, r8, #255", ""},
    {"mov.w r0, r8, lsl #3", ""},
    {"pkhbt r0, r1, r2", "shifter"},
    {"ubfx r0, r1, #2, #3", "shifter"},
    {"bfi r0, r1, #2, #3", "shifter"},
    {"uxtab r0, r1, r2", "shifter"},
    {"uxtb.w r0, r1, ror #8", ""},
    {"pkhbt r0, r1, r2, lsl #1", "shifter"},
    {"ssat r0, #3, r1", "saturates"},
    {"usat16 r0, #3, r1", "saturates"},
    {"qadd r0, r1, r2", "saturates"},
    {"qdsub r0, r1, r2", "saturates"},
    {"qadd8 r0, r1, r2", "saturates"},
    {"uqsub16 r0, r1, r2", "saturates"},
    {"shadd8 r0, r1, r2", ""},
    {"uadd8 r0, r1, r2", ""},
    {"uhsax r0, r1, r2", ""},
    {"rev r0, r1", "shifter early"},
    {"rev.w r8, r1", "shifter early"},
    {"rbit r0, r1", "shifter early"},
    {"revsh.w r8, r1", "shifter early"},
    {"clz r0, r1", ""},
    {"vfma.f32 s0, s1, s2", "fused fpu"},
    {"vfms.f32 s0, s1, s2", "fused fpu"},
    {"vfnma.f32 s0, s1, s2", "fused fpu"},
    {"vfnms.f32 s0, s1, s2", "fused fpu"},
    {"vmla.f32 s0, s1, s2", "fpu"},
    {"vmls.f32 s0, s1, s2", "fpu"},
    {"vnmla.f32 s0, s1, s2", "fpu"},
    {"vnmls.f32 s0, s1, s2", "fpu"},
    {"vfnms.f64 d0, d1, d2", "fused double fpu"},
    {"vadd.f64 d0, d1, d2", "double fpu"},
    {"vmov.f32 s0, #1.0", "fpu"},
    {"vmov.f64 d0, #1.0", "double fpu"},
    {"vcvt.f64.f32 d0, s1", "fpu"},
    {"vcvt.f32.f64 s0, d1", "double fpu"},
    {"vcvt.s32.f64 s0, d1", "double fpu"},
    {"vmov s0, r1", "fpu"},
    {"vmov r1, s0", "fpu"},
    {"vmov s0, s1, r0, r1", "fpu both"},
    {"vmov d0, r0, r1", "fpu both"},
    {"vmov.32 d1[1], r0", "fpu"},
    {"vmsr fpscr, r0", "fpu both"},
    {"vmrs r0, fpscr", "fpu both"},
};

TEST(Decode, KnowsWhatThePipelineAsks) {
    std::string text;
    for (const Facts& row : facts) {
        text += std::string(row.text) + "\n";
    }
    const auto lines = listing::assemble(text);
    ASSERT_EQ(lines.size(), std::size(facts));
    for (std::size_t i = 0; i < lines.size(); ++i) {
        EXPECT_EQ(facts_of(timing::decode(lines[i].encoding, lines[i].bytes)), facts[i].facts) << facts[i].text;
    }
}

// What an encoding of one architecture is that of another would have: registers beyond the sixteen doubles, none at
// all.
TEST(Decode, ADoubleBeyondTheSixteenthIsUnknown) {
    constexpr std::uint32_t low = 1U << 5;     // of Vm
    constexpr std::uint32_t high = 1U << 22;   // of Vd
    constexpr std::uint32_t middle = 1U << 7;  // of Vn
    for (const std::uint32_t e :
         {0xEE310B02U /* vadd.f64 d0, d1, d2 */, 0xEEA10B02U /* vfma.f64 */, 0xFE010B02U /* vseleq.f64 */}) {
        EXPECT_NE(timing::decode(e, 4).kind, Kind::unknown);
        for (const std::uint32_t bit : {low, high, middle}) {
            EXPECT_EQ(timing::decode(e | bit, 4).kind, Kind::unknown) << std::hex << (e | bit);
            EXPECT_NE(timing::decode((e & ~0x100U) | bit, 4).kind, Kind::unknown) << std::hex << (e | bit);  // of f32
        }
    }
    EXPECT_NE(timing::decode(0xED900B00U, 4).kind, Kind::unknown);  // vldr d0, [r0]
    EXPECT_EQ(timing::decode(0xED900B00U | high, 4).kind, Kind::unknown);
    EXPECT_EQ(timing::decode(0xEC900A00U, 4).kind, Kind::unknown);  // vldmia of none
    EXPECT_NE(timing::decode(0xEC90FA01U, 4).kind, Kind::unknown);  // of s30
    EXPECT_NE(timing::decode(0xEC90FA02U, 4).kind, Kind::unknown);  // of s30 and s31
    EXPECT_EQ(timing::decode(0xEC90FA03U, 4).kind, Kind::unknown);
    EXPECT_EQ(timing::decode(0xEC410A3FU, 4).kind, Kind::unknown);  // vmov s31, s32, r0, r1
    EXPECT_NE(timing::decode(0xEC410A1FU, 4).kind, Kind::unknown);  // s30 and s31
    EXPECT_NE(timing::decode(0xEC410B13U, 4).kind, Kind::unknown);  // vmov d3, r0, r1
    EXPECT_EQ(timing::decode(0xEC410B13U | low, 4).kind, Kind::unknown);
    EXPECT_NE(timing::decode(0xEC410A13U | low, 4).kind, Kind::unknown);  // of two singles
    for (const std::uint32_t e : {0xEE010B10U /* vmov.32 d1[0], r0 */, 0xEE110B10U /* vmov.32 r0, d1[0] */}) {
        EXPECT_NE(timing::decode(e, 4).kind, Kind::unknown);
        EXPECT_EQ(timing::decode(e | middle, 4).kind, Kind::unknown) << std::hex << e;
    }
}

// Sixteen of the core, 32 singles, three that flags are: each has a number of its own below their count.
TEST(Decode, RegistersHaveNumbersOfTheirOwn) {
    namespace registers = timing::registers;
    std::set<unsigned> all{registers::flags, registers::ge, registers::fp_flags};
    for (unsigned i = 0; i < 16; ++i) {
        all.insert(i);
    }
    for (unsigned i = 0; i < 32; ++i) {
        all.insert(registers::s0 + i);
    }
    EXPECT_EQ(all.size(), 51U);
    EXPECT_EQ(all.size(), registers::count);
    EXPECT_EQ(*all.rbegin(), registers::count - 1U);
}

TEST(Decode, WhatNoRowMatchesIsUnknown) {
    for (const std::uint32_t e : {0xFFFFFFFFU, 0xEE000000U /* coprocessor 0 */, 0xEC000A00U, 0xFE800000U,
                                  0xEEB03B40U | 0x20U /* vmov d3, d16 */, 0xFBF00000U}) {
        EXPECT_EQ(timing::decode(e, 4).kind, Kind::unknown) << std::hex << e;
    }
    EXPECT_EQ(timing::decode(0xB100U | 0x0F00U | 0x00C0U, 2).kind, Kind::unknown);  // a hint that is none
    EXPECT_EQ(timing::decode(0xB680U, 2).kind, Kind::unknown);
}

}  // namespace
