// Branch encodings as the assembler makes them (arm-none-eabi-as 2.40, listed by objdump).
#include "qemu/stream/thumb.hpp"

#include <gtest/gtest.h>

#include "qemu/stream/stretch_marks.hpp"

namespace {

qemu::Instruction narrow(std::uint32_t encoding) { return {0, encoding, 2, 0}; }
qemu::Instruction wide(std::uint32_t encoding) { return {0, encoding, 4, 0}; }

TEST(Thumb, KnowsTheLength) {
    for (const unsigned half : {0x4770U /* bx lr */, 0xE7FEU /* b, the last of 16 bits */, 0xBF00U /* nop */}) {
        EXPECT_EQ(qemu::bytes_from(static_cast<std::uint16_t>(half)), 2) << std::hex << half;
    }
    for (const unsigned half : {0xE8BDU /* pop.w */, 0xEE60U /* vmul */, 0xF7FFU /* bl */, 0xFBC1U /* smlal */}) {
        EXPECT_EQ(qemu::bytes_from(static_cast<std::uint16_t>(half)), 4) << std::hex << half;
    }
}

TEST(Thumb, KnowsBranches) {
    for (const std::uint32_t e : {0xD1FBU /* bne */, 0xE7FEU /* b */, 0x4770U /* bx lr */, 0x4798U /* blx r3 */,
                                  0xB108U /* cbz r0 */, 0xB908U /* cbnz r0 */, 0xBB00U /* cbnz, far */,
                                  0xBD10U /* pop {r4, pc} */, 0x46F7U /* mov pc, lr */, 0x4487U /* add pc, r0 */}) {
        EXPECT_TRUE(qemu::is_branch(narrow(e))) << std::hex << e;
    }
    for (const std::uint32_t e :
         {0xF7FFFFFEU /* bl */, 0xF000B800U /* b.w */, 0xF4018000U /* beq.w */, 0xE8DFF000U /* tbb [pc, r0] */,
          0xE8DFF010U /* tbh [pc, r0, lsl 1] */, 0xE8BD8FF0U /* pop.w {r4-r11, pc} */,
          0xF85DFB04U /* ldr pc, [sp], 4 */, 0xF8DFF000U /* ldr.w pc, [pc] */}) {
        EXPECT_TRUE(qemu::is_branch(wide(e))) << std::hex << e;
    }
}

TEST(Thumb, KnowsWhatIsNoBranch) {
    for (const std::uint32_t e : {0xDE00U /* udf */, 0xDF00U /* svc */, 0x680AU /* ldr */, 0xBC30U /* pop {r4, r5} */,
                                  0xB510U /* push */, 0x4604U /* mov r4, r0 */, 0x448DU /* add sp, r1 */,
                                  0xBF08U /* it eq */, 0xBF00U /* nop */, 0xB2C0U /* uxtb */, 0xBE00U /* bkpt */}) {
        EXPECT_FALSE(qemu::is_branch(narrow(e))) << std::hex << e;
    }
    for (const std::uint32_t e :
         {0xE8BD0FF0U /* pop.w {r4-r11} */, 0xE92D4FF0U /* push.w with lr */, 0xF8D13000U /* ldr.w r3 */,
          0xFBC12304U /* smlal */, 0xEE600A01U /* vmul.f32 */, 0xECB10A01U /* vldmia */, 0xF3BF8F4FU /* dsb */,
          0xF3808811U /* msr basepri */, 0xF3EF8010U /* mrs */, 0xE9D10302U /* ldrd */}) {
        EXPECT_FALSE(qemu::is_branch(wide(e))) << std::hex << e;
    }
}

TEST(Thumb, KnowsPairs) {
    for (const std::uint32_t e : {0xE9D12300U /* ldrd r2, r3, [r1] */, 0xE9C12300U /* strd r2, r3, [r1] */,
                                  0xE8F12302U /* ldrd r2, r3, [r1], 8 */, 0xE9612302U /* strd r2, r3, [r1, -8]! */,
                                  0xE9DF2300U /* ldrd r2, r3, [pc] */}) {
        EXPECT_TRUE(qemu::moves_pair(wide(e))) << std::hex << e;
    }
    for (const std::uint32_t e :
         {0xE8512F00U /* ldrex */, 0xE8412300U /* strex */, 0xE8DFF000U /* tbb */, 0xE8D12F4FU /* ldrexb */,
          0xE8BD0FF0U /* pop.w */, 0xE8911C00U /* ldm.w */, 0xE92D4FF0U /* push.w */, 0xED910B00U /* vldr d0 */,
          0xF8D13000U /* ldr.w */, 0xEA400001U /* orr.w */}) {
        EXPECT_FALSE(qemu::moves_pair(wide(e))) << std::hex << e;
    }
    EXPECT_FALSE(qemu::moves_pair(narrow(0x680AU)));
}

TEST(Thumb, KnowsStores) {
    for (const std::uint32_t e :
         {0x5042U /* str r2, [r0, r1] */, 0x5242U /* strh */, 0x5442U /* strb */, 0x600AU /* str r2, [r1] */,
          0x700AU /* strb */, 0x800AU /* strh */, 0x9201U /* str r2, [sp, 4] */, 0xC13CU /* stmia r1! */,
          0xB430U /* push {r4, r5} */, 0xB510U /* push {r4, lr} */}) {
        EXPECT_TRUE(qemu::stores(narrow(e))) << std::hex << e;
    }
    for (const std::uint32_t e : {0x4A01U /* ldr r2, [pc, 4] */, 0x5642U /* ldrsb */, 0x5842U /* ldr r2, [r0, r1] */,
                                  0x5A42U /* ldrh */, 0x5C42U /* ldrb */, 0x5E42U /* ldrsh */, 0x680AU /* ldr */,
                                  0x780AU /* ldrb */, 0x880AU /* ldrh */, 0x9A01U /* ldr r2, [sp, 4] */,
                                  0xC93CU /* ldmia r1! */, 0xBC30U /* pop {r4, r5} */, 0xBD10U /* pop {r4, pc} */}) {
        EXPECT_FALSE(qemu::stores(narrow(e))) << std::hex << e;
    }
    for (const std::uint32_t e :
         {0xF8C12004U /* str.w r2, [r1, 4] */, 0xF8412B04U /* str r2, [r1], 4 */, 0xF8012003U /* strb.w */,
          0xF8A12004U /* strh.w */, 0xE9C12300U /* strd r2, r3, [r1] */, 0xE881003CU /* stm.w */,
          0xE92D4FF0U /* push.w */, 0xED810A00U /* vstr s0 */, 0xED810B00U /* vstr d0 */, 0xEC810A04U /* vstm */,
          0xED2D8B02U /* vpush {d8} */, 0xE8412300U /* strex */}) {
        EXPECT_TRUE(qemu::stores(wide(e))) << std::hex << e;
    }
    for (const std::uint32_t e :
         {0xF8D12004U /* ldr.w r2, [r1, 4] */, 0xF8512B04U /* ldr r2, [r1], 4 */, 0xF9912000U /* ldrsb.w */,
          0xF8B12004U /* ldrh.w */, 0xF9B12000U /* ldrsh.w */, 0xE9D12300U /* ldrd r2, r3, [r1] */,
          0xE8BD0FF0U /* pop.w */, 0xED910A00U /* vldr s0 */, 0xED910B00U /* vldr d0 */, 0xEC910A04U /* vldm */,
          0xECBD8B02U /* vpop {d8} */, 0xE8DFF000U /* tbb */, 0xE8512F00U /* ldrex */}) {
        EXPECT_FALSE(qemu::stores(wide(e))) << std::hex << e;
    }
}

TEST(Thumb, KnowsCalls) {
    EXPECT_TRUE(qemu::is_call(wide(0xF7FFFFFE)));   // bl
    EXPECT_TRUE(qemu::is_call(narrow(0x4798)));     // blx r3
    EXPECT_FALSE(qemu::is_call(narrow(0x4770)));    // bx lr
    EXPECT_FALSE(qemu::is_call(wide(0xF000B800)));  // b.w
    EXPECT_FALSE(qemu::is_call(narrow(0xE7FE)));    // b
}

TEST(Thumb, MarksOfStretchesPairAndDoNotNest) {
    EXPECT_TRUE(qemu::is_stretch_mark(narrow(0x46D2)));   // mov r10, r10
    EXPECT_TRUE(qemu::is_stretch_mark(narrow(0x46DB)));   // mov r11, r11
    EXPECT_FALSE(qemu::is_stretch_mark(narrow(0x46C0)));  // mov r8, r8, a NOP of Thumb-1
    EXPECT_FALSE(qemu::is_stretch_mark(wide(0x46D2)));
    qemu::StretchMarks marks;
    for (const std::uint32_t address : {0x20U, 0x40U}) {
        marks.meet({address, qemu::stretch_begins, 2, 0});
        EXPECT_EQ(marks.open(), address);
        marks.meet({address + 2, qemu::stretch_ends, 2, 1});
        EXPECT_FALSE(marks.open() || marks.misused());
    }
    qemu::StretchMarks nested = marks;
    nested.meet({0x20, qemu::stretch_begins, 2, 0});
    nested.meet({0x22, qemu::stretch_begins, 2, 1});
    nested.meet({0x24, qemu::stretch_begins, 2, 2});
    EXPECT_EQ(nested.misused(), (qemu::MisusedMark{0x22, 0x20}));
    marks.meet({0x30, qemu::stretch_ends, 2, 0});
    EXPECT_EQ(marks.misused(), (qemu::MisusedMark{0x30, std::nullopt}));
}

}  // namespace
