// Branch encodings as the assembler makes them (arm-none-eabi-as 2.40, listed by objdump).
#include "qemu/thumb.hpp"

#include <gtest/gtest.h>

namespace {

qemu::Instruction narrow(std::uint32_t encoding) { return {0, encoding, 2, 0}; }
qemu::Instruction wide(std::uint32_t encoding) { return {0, encoding, 4, 0}; }

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

TEST(Thumb, KnowsCalls) {
    EXPECT_TRUE(qemu::is_call(wide(0xF7FFFFFE)));   // bl
    EXPECT_TRUE(qemu::is_call(narrow(0x4798)));     // blx r3
    EXPECT_FALSE(qemu::is_call(narrow(0x4770)));    // bx lr
    EXPECT_FALSE(qemu::is_call(wide(0xF000B800)));  // b.w
    EXPECT_FALSE(qemu::is_call(narrow(0xE7FE)));    // b
}

}  // namespace
