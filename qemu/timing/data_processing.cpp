// 32-bit encodings of the integer core without memory: arithmetic, bit fields, multiplication, branches, the system.
#include "qemu/timing/encoding_rows.hpp"

namespace timing {
namespace {

using std::uint32_t;

unsigned rn(uint32_t e) { return field(e, 16, 4); }
unsigned ra(uint32_t e) { return field(e, 12, 4); }  // also the low half of a long result
unsigned rd(uint32_t e) { return field(e, 8, 4); }
unsigned rm(uint32_t e) { return field(e, 0, 4); }
constexpr unsigned none = 15;

bool sets_flags(uint32_t e) { return field(e, 20, 1) != 0; }

// What Rd = PC or Rn = PC mean: AND becomes TST, ORR becomes MOV.
struct Alias {
    const char* plain;
    const char* without_result;
    const char* without_first;
};
constexpr Alias aliases[16] = {
    {"and", "tst", nullptr},     {"bic", nullptr, nullptr},   {"orr", nullptr, "mov"},     {"orn", nullptr, "mvn"},
    {"eor", "teq", nullptr},     {nullptr, nullptr, nullptr}, {"pkhbt", nullptr, nullptr}, {nullptr, nullptr, nullptr},
    {"add", "cmn", nullptr},     {nullptr, nullptr, nullptr}, {"adc", nullptr, nullptr},   {"sbc", nullptr, nullptr},
    {nullptr, nullptr, nullptr}, {"sub", "cmp", nullptr},     {"rsb", nullptr, nullptr},   {nullptr, nullptr, nullptr},
};
enum Operation : unsigned { pack = 6, add = 8, adc = 10, sbc = 11, sub = 13 };

// The part that shifted register and modified constant share. \return whether the row is a known operation
bool alias(Decoded& d, uint32_t e) {
    const unsigned operation = field(e, 21, 4);
    const Alias& names = aliases[operation];
    const bool no_result = rd(e) == registers::pc && sets_flags(e) && names.without_result != nullptr;
    const bool no_first = rn(e) == registers::pc && names.without_first != nullptr;
    d.mnemonic = no_result ? names.without_result : no_first ? names.without_first : names.plain;
    if (d.mnemonic == nullptr) {
        d.kind = Kind::unknown;
        return false;
    }
    const bool moves = operation == 2 && no_first;
    d.kind = operation == add || operation == sub || moves ? Kind::add : Kind::logic;
    d.sets_flags = sets_flags(e);
    if (!no_result) {
        d.write(rd(e));
    }
    if (!no_first) {
        d.read(Role::operand, rn(e));
    }
    if (operation == adc || operation == sbc) {
        d.read(Role::condition, registers::flags);
    }
    return true;
}

void shifted_register(Decoded& d, uint32_t e) {
    if (!alias(d, e)) {
        return;
    }
    const unsigned amount = field(e, 12, 3) << 2 | field(e, 6, 2);
    const unsigned type = field(e, 4, 2);
    if (field(e, 21, 4) == pack) {
        d.kind = Kind::bitfield;
        d.mnemonic = (type & 2U) != 0 ? "pkhtb" : "pkhbt";
        d.sets_flags = false;
        // PKHBT takes its second operand early even without a shift, PKHTB both.
        if ((type & 2U) != 0) {
            d.reads[0].role = Role::shifted;
        }
        d.read(Role::shifted, rm(e));
        d.uses_shifter = true;
        return;
    }
    if (amount == 0 && type == 0) {
        d.read(Role::operand, rm(e));
        return;
    }
    if (type == 3 && amount == 0) {  // RRX takes the carry in
        d.read(Role::condition, registers::flags);
    }
    const bool plain_shift = field(e, 21, 4) == 2 && rn(e) == registers::pc;
    d.kind = plain_shift ? Kind::shift : Kind::logic;
    d.uses_shifter = !plain_shift;
    d.read(plain_shift ? Role::operand : Role::shifted, rm(e));
}

void modified_constant(Decoded& d, uint32_t e) {
    if (field(e, 21, 4) == pack) {
        d.kind = Kind::unknown;
        return;
    }
    if (alias(d, e)) {
        d.uses_shifter = (field(e, 26, 1) << 1 | field(e, 14, 1)) != 0;  // a byte at another place, not a pattern
    }
}

void wide_constant(Decoded& d, uint32_t e) {
    d.write(rd(e));
    d.read(Role::operand, rn(e));
    if (rn(e) == registers::pc) {
        d.mnemonic = "adr";
    }
}
void move_half(Decoded& d, uint32_t e) { d.write(rd(e)); }
void move_top(Decoded& d, uint32_t e) {
    d.write(rd(e));
    d.read(Role::operand, rd(e));
}
void saturate(Decoded& d, uint32_t e) {
    d.saturates = true;
    d.write(rd(e));
    d.read(Role::shifted, rn(e));
}
void extract(Decoded& d, uint32_t e) {
    d.uses_shifter = true;
    d.write(rd(e));
    d.read(Role::shifted, rn(e));
}
void insert(Decoded& d, uint32_t e) {
    d.uses_shifter = true;
    d.write(rd(e));
    d.read(Role::operand, rd(e));
    if (rn(e) == registers::pc) {
        d.mnemonic = "bfc";
    } else {
        d.read(Role::shifted, rn(e));
    }
}
void shift_by_register(Decoded& d, uint32_t e) {
    d.write(rd(e));
    d.read(Role::operand, rn(e));
    d.read(Role::operand, rm(e));
    d.sets_flags = sets_flags(e);
}
void extend(Decoded& d, uint32_t e) {
    static constexpr const char* alone[] = {"sxth", "uxth", "sxtb16", "uxtb16", "sxtb", "uxtb"};
    static constexpr const char* added[] = {"sxtah", "uxtah", "sxtab16", "uxtab16", "sxtab", "uxtab"};
    const unsigned which = field(e, 20, 3);
    if (which > 5) {
        d.kind = Kind::unknown;
        return;
    }
    const bool adds = rn(e) != none;
    d.mnemonic = adds ? added[which] : alone[which];
    d.uses_shifter = adds;
    d.write(rd(e));
    d.read(adds ? Role::shifted : Role::operand, rm(e));
    if (adds) {
        d.read(Role::operand, rn(e));
    }
}
void parallel(Decoded& d, uint32_t e) {
    static constexpr const char* names[8][8] = {
        {"sadd8", "qadd8", "shadd8", nullptr, "uadd8", "uqadd8", "uhadd8", nullptr},
        {"sadd16", "qadd16", "shadd16", nullptr, "uadd16", "uqadd16", "uhadd16", nullptr},
        {"sasx", "qasx", "shasx", nullptr, "uasx", "uqasx", "uhasx", nullptr},
        {},
        {"ssub8", "qsub8", "shsub8", nullptr, "usub8", "uqsub8", "uhsub8", nullptr},
        {"ssub16", "qsub16", "shsub16", nullptr, "usub16", "uqsub16", "uhsub16", nullptr},
        {"ssax", "qsax", "shsax", nullptr, "usax", "uqsax", "uhsax", nullptr},
        {},
    };
    d.mnemonic = names[field(e, 20, 3)][field(e, 4, 3)];
    if (d.mnemonic == nullptr) {
        d.kind = Kind::unknown;
        return;
    }
    d.write(rd(e));
    d.read(Role::operand, rn(e));
    d.read(Role::operand, rm(e));
    if (field(e, 4, 2) == 0) {  // neither saturating nor halving
        d.write(registers::ge, Source::flags);
    }
    d.saturates = field(e, 4, 2) == 1;
}
void two_operands(Decoded& d, uint32_t e) {
    d.write(rd(e));
    d.read(Role::operand, rn(e));
    d.read(Role::operand, rm(e));
}
void saturating_sum(Decoded& d, uint32_t e) {
    d.saturates = true;
    two_operands(d, e);
}
void doubled_saturating_sum(Decoded& d, uint32_t e) {  // Rm plus or minus twice Rn
    d.saturates = true;
    d.write(rd(e));
    d.read(Role::shifted, rn(e));
    d.read(Role::shifted, rm(e));
}
void reverse(Decoded& d, uint32_t e) {
    d.early_result = true;
    d.uses_shifter = true;
    d.write(rd(e));
    d.read(Role::shifted, rm(e));
}
void count_zeros(Decoded& d, uint32_t e) {
    d.write(rd(e));
    d.read(Role::operand, rm(e));
}
void select(Decoded& d, uint32_t e) {
    two_operands(d, e);
    d.read(Role::condition, registers::ge);
}

void product(Decoded& d, uint32_t e) {
    d.write(rd(e));
    d.read(Role::multiplicand, rn(e));
    d.read(Role::multiplicand, rm(e));
}
void product_sum(Decoded& d, uint32_t e) {
    product(d, e);
    d.read(Role::accumulator, ra(e));
}
void long_product(Decoded& d, uint32_t e) {
    d.write(ra(e));
    d.write(rd(e));
    d.read(Role::multiplicand, rn(e));
    d.read(Role::multiplicand, rm(e));
}
void long_product_sum(Decoded& d, uint32_t e) {
    long_product(d, e);
    d.read(Role::accumulator, ra(e));
    d.read(Role::accumulator, rd(e));
}

void conditional_branch(Decoded& d, uint32_t e) {
    d.branch = Branch::conditional;
    d.condition = static_cast<std::uint8_t>(field(e, 22, 4));
    d.backward = field(e, 26, 1) != 0;
}
void direct_branch(Decoded& d, uint32_t e) {
    d.branch = d.condition == 0xE ? Branch::direct : Branch::conditional;
    d.backward = field(e, 26, 1) != 0;
}
void call(Decoded& d, uint32_t) {
    d.branch = Branch::call;
    d.write(registers::lr);
}
void from_system(Decoded& d, uint32_t e) { d.write(rd(e)); }
void to_system(Decoded& d, uint32_t e) { d.read(Role::operand, rn(e)); }
void nothing(Decoded&, uint32_t) {}

constexpr EncodingRow rows[] = {
    {0xFE000000, 0xEA000000, "", Kind::logic, shifted_register},
    {0xFA008000, 0xF0000000, "", Kind::logic, modified_constant},
    {0xFBF08000, 0xF2000000, "addw", Kind::add, wide_constant},
    {0xFBF08000, 0xF2400000, "movw", Kind::add, move_half},
    {0xFBF08000, 0xF2A00000, "subw", Kind::add, wide_constant},
    {0xFBF08000, 0xF2C00000, "movt", Kind::logic, move_top},
    {0xFFF0F0F0, 0xF3200000, "ssat16", Kind::bitfield, saturate},
    {0xFFD08020, 0xF3000000, "ssat", Kind::bitfield, saturate},
    {0xFFF08020, 0xF3400000, "sbfx", Kind::bitfield, extract},
    {0xFFF08020, 0xF3600000, "bfi", Kind::bitfield, insert},
    {0xFFF0F0F0, 0xF3A00000, "usat16", Kind::bitfield, saturate},
    {0xFFD08020, 0xF3800000, "usat", Kind::bitfield, saturate},
    {0xFFF08020, 0xF3C00000, "ubfx", Kind::bitfield, extract},

    {0xFFE0F0F0, 0xFA00F000, "lsl", Kind::shift, shift_by_register},
    {0xFFE0F0F0, 0xFA20F000, "lsr", Kind::shift, shift_by_register},
    {0xFFE0F0F0, 0xFA40F000, "asr", Kind::shift, shift_by_register},
    {0xFFE0F0F0, 0xFA60F000, "ror", Kind::shift, shift_by_register},
    {0xFF80F0C0, 0xFA00F080, "", Kind::bitfield, extend},
    {0xFF80F080, 0xFA80F000, "", Kind::bitfield, parallel},
    {0xFFF0F0F0, 0xFA80F080, "qadd", Kind::bitfield, saturating_sum},
    {0xFFF0F0F0, 0xFA80F090, "qdadd", Kind::bitfield, doubled_saturating_sum},
    {0xFFF0F0F0, 0xFA80F0A0, "qsub", Kind::bitfield, saturating_sum},
    {0xFFF0F0F0, 0xFA80F0B0, "qdsub", Kind::bitfield, doubled_saturating_sum},
    {0xFFF0F0F0, 0xFA90F080, "rev", Kind::bitfield, reverse},
    {0xFFF0F0F0, 0xFA90F090, "rev16", Kind::bitfield, reverse},
    {0xFFF0F0F0, 0xFA90F0A0, "rbit", Kind::bitfield, reverse},
    {0xFFF0F0F0, 0xFA90F0B0, "revsh", Kind::bitfield, reverse},
    {0xFFF0F0F0, 0xFAA0F080, "sel", Kind::bitfield, select},
    {0xFFF0F0F0, 0xFAB0F080, "clz", Kind::bitfield, count_zeros},

    {0xFFF0F0F0, 0xFB00F000, "mul", Kind::multiply, product},
    {0xFFF000F0, 0xFB000000, "mla", Kind::multiply, product_sum},
    {0xFFF000F0, 0xFB000010, "mls", Kind::multiply, product_sum},
    {0xFFF0F0F0, 0xFB10F000, "smulbb", Kind::multiply, product},
    {0xFFF0F0F0, 0xFB10F010, "smulbt", Kind::multiply, product},
    {0xFFF0F0F0, 0xFB10F020, "smultb", Kind::multiply, product},
    {0xFFF0F0F0, 0xFB10F030, "smultt", Kind::multiply, product},
    {0xFFF000F0, 0xFB100000, "smlabb", Kind::multiply, product_sum},
    {0xFFF000F0, 0xFB100010, "smlabt", Kind::multiply, product_sum},
    {0xFFF000F0, 0xFB100020, "smlatb", Kind::multiply, product_sum},
    {0xFFF000F0, 0xFB100030, "smlatt", Kind::multiply, product_sum},
    {0xFFF0F0F0, 0xFB20F000, "smuad", Kind::multiply, product},
    {0xFFF0F0F0, 0xFB20F010, "smuadx", Kind::multiply, product},
    {0xFFF000F0, 0xFB200000, "smlad", Kind::multiply, product_sum},
    {0xFFF000F0, 0xFB200010, "smladx", Kind::multiply, product_sum},
    {0xFFF0F0F0, 0xFB30F000, "smulwb", Kind::multiply, product},
    {0xFFF0F0F0, 0xFB30F010, "smulwt", Kind::multiply, product},
    {0xFFF000F0, 0xFB300000, "smlawb", Kind::multiply, product_sum},
    {0xFFF000F0, 0xFB300010, "smlawt", Kind::multiply, product_sum},
    {0xFFF0F0F0, 0xFB40F000, "smusd", Kind::multiply, product},
    {0xFFF0F0F0, 0xFB40F010, "smusdx", Kind::multiply, product},
    {0xFFF000F0, 0xFB400000, "smlsd", Kind::multiply, product_sum},
    {0xFFF000F0, 0xFB400010, "smlsdx", Kind::multiply, product_sum},
    {0xFFF0F0F0, 0xFB50F000, "smmul", Kind::multiply, product},
    {0xFFF0F0F0, 0xFB50F010, "smmulr", Kind::multiply, product},
    {0xFFF000F0, 0xFB500000, "smmla", Kind::multiply, product_sum},
    {0xFFF000F0, 0xFB500010, "smmlar", Kind::multiply, product_sum},
    {0xFFF000F0, 0xFB600000, "smmls", Kind::multiply, product_sum},
    {0xFFF000F0, 0xFB600010, "smmlsr", Kind::multiply, product_sum},
    {0xFFF0F0F0, 0xFB70F000, "usad8", Kind::multiply, product},
    {0xFFF000F0, 0xFB700000, "usada8", Kind::multiply, product_sum},
    {0xFFF000F0, 0xFB800000, "smull", Kind::multiply, long_product},
    {0xFFF0F0F0, 0xFB90F0F0, "sdiv", Kind::divide, product},
    {0xFFF000F0, 0xFBA00000, "umull", Kind::multiply, long_product},
    {0xFFF0F0F0, 0xFBB0F0F0, "udiv", Kind::divide, product},
    {0xFFF000F0, 0xFBC00000, "smlal", Kind::multiply, long_product_sum},
    {0xFFF000F0, 0xFBC00080, "smlalbb", Kind::multiply, long_product_sum},
    {0xFFF000F0, 0xFBC00090, "smlalbt", Kind::multiply, long_product_sum},
    {0xFFF000F0, 0xFBC000A0, "smlaltb", Kind::multiply, long_product_sum},
    {0xFFF000F0, 0xFBC000B0, "smlaltt", Kind::multiply, long_product_sum},
    {0xFFF000F0, 0xFBC000C0, "smlald", Kind::multiply, long_product_sum},
    {0xFFF000F0, 0xFBC000D0, "smlaldx", Kind::multiply, long_product_sum},
    {0xFFF000F0, 0xFBD000C0, "smlsld", Kind::multiply, long_product_sum},
    {0xFFF000F0, 0xFBD000D0, "smlsldx", Kind::multiply, long_product_sum},
    {0xFFF000F0, 0xFBE00000, "umlal", Kind::multiply, long_product_sum},
    {0xFFF000F0, 0xFBE00060, "umaal", Kind::multiply, long_product_sum},

    {0xFFFFFFFF, 0xF3AF8000, "nop", Kind::hint, nothing},
    {0xFFFFFFFF, 0xF3AF8001, "yield", Kind::hint, nothing},
    {0xFFFFFFFF, 0xF3AF8002, "wfe", Kind::hint, nothing},
    {0xFFFFFFFF, 0xF3AF8003, "wfi", Kind::hint, nothing},
    {0xFFFFFFFF, 0xF3AF8004, "sev", Kind::hint, nothing},
    {0xFFFFFFF0, 0xF3BF8F20, "clrex", Kind::system, nothing},
    {0xFFFFFFF0, 0xF3BF8F40, "dsb", Kind::barrier, nothing},
    {0xFFFFFFF0, 0xF3BF8F50, "dmb", Kind::barrier, nothing},
    {0xFFFFFFF0, 0xF3BF8F60, "isb", Kind::barrier, nothing},
    {0xFFF0F000, 0xF3808000, "msr", Kind::system, to_system},
    {0xFFFFF000, 0xF3EF8000, "mrs", Kind::system, from_system},
    {0xFFF0F000, 0xF7F0A000, "udf", Kind::system, nothing},
    {0xFB80D000, 0xF3808000, "", Kind::unknown, nothing},  // the rest of the system's space
    {0xF800D000, 0xF0008000, "b", Kind::branch, conditional_branch},
    {0xF800D000, 0xF0009000, "b", Kind::branch, direct_branch},
    {0xF800D000, 0xF000D000, "bl", Kind::branch, call},
};

}  // namespace

std::span<const EncodingRow> data_processing_rows() { return rows; }

}  // namespace timing
