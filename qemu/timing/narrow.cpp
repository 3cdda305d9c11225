// 16-bit encodings.
#include "qemu/timing/encoding_rows.hpp"

namespace timing {
namespace {

using std::uint32_t;

unsigned low(uint32_t e) { return field(e, 0, 3); }
unsigned middle(uint32_t e) { return field(e, 3, 3); }
unsigned high(uint32_t e) { return field(e, 8, 3); }
unsigned low4(uint32_t e) { return field(e, 7, 1) << 3 | field(e, 0, 3); }
unsigned middle4(uint32_t e) { return field(e, 3, 4); }

// Outside of an IT block the arithmetic of 16 bits sets the flags.
void flags_outside_it(Decoded& d) { d.sets_flags = !d.in_it_block; }

void shift_by_constant(Decoded& d, uint32_t e) {
    d.write(low(e));
    d.read(Role::operand, middle(e));
    if (field(e, 6, 5) == 0 && field(e, 11, 2) == 0) {
        d.mnemonic = "mov";
        d.kind = Kind::add;
    }
    flags_outside_it(d);
}
void three_registers(Decoded& d, uint32_t e) {
    d.write(low(e));
    d.read(Role::operand, middle(e));
    d.read(Role::operand, field(e, 6, 3));
    flags_outside_it(d);
}
void two_registers_constant(Decoded& d, uint32_t e) {
    d.write(low(e));
    d.read(Role::operand, middle(e));
    flags_outside_it(d);
}
void move_constant(Decoded& d, uint32_t e) {
    d.write(high(e));
    flags_outside_it(d);
}
void compare_constant(Decoded& d, uint32_t e) {
    d.read(Role::operand, high(e));
    d.sets_flags = true;
}
void add_constant(Decoded& d, uint32_t e) {
    d.write(high(e));
    d.read(Role::operand, high(e));
    flags_outside_it(d);
}
void arithmetic(Decoded& d, uint32_t e) {
    d.write(low(e));
    d.read(Role::operand, low(e));
    d.read(Role::operand, middle(e));
    flags_outside_it(d);
}
void arithmetic_with_carry(Decoded& d, uint32_t e) {
    arithmetic(d, e);
    d.read(Role::condition, registers::flags);
}
void one_operand(Decoded& d, uint32_t e) {
    d.write(low(e));
    d.read(Role::operand, middle(e));
    flags_outside_it(d);
}
void compare_registers(Decoded& d, uint32_t e) {
    d.read(Role::operand, low(e));
    d.read(Role::operand, middle(e));
    d.sets_flags = true;
}
void multiply(Decoded& d, uint32_t e) {
    d.write(low(e));
    d.read(Role::multiplicand, low(e));
    d.read(Role::multiplicand, middle(e));
    flags_outside_it(d);
}
void write_maybe_pc(Decoded& d, unsigned reg) {
    d.write(reg);
    if (reg == registers::pc) {
        d.kind = Kind::branch;
        d.branch = Branch::indirect;
    }
}
void add_high(Decoded& d, uint32_t e) {
    d.read(Role::operand, low4(e));
    d.read(Role::operand, middle4(e));
    write_maybe_pc(d, low4(e));
}
void compare_high(Decoded& d, uint32_t e) {
    d.read(Role::operand, low4(e));
    d.read(Role::operand, middle4(e));
    d.sets_flags = true;
}
void move_high(Decoded& d, uint32_t e) {
    d.read(Role::operand, middle4(e));
    write_maybe_pc(d, low4(e));
}
void branch_to_register(Decoded& d, uint32_t e) {
    const bool is_call = field(e, 7, 1) != 0;
    d.read(Role::address, middle4(e));
    d.branch = middle4(e) == registers::lr && !is_call ? Branch::back : Branch::indirect;
    if (is_call) {
        d.write(registers::lr);
    }
}

void memory(Decoded& d, unsigned reg, std::uint8_t bytes) {
    d.registers = 1;
    d.access_bytes = bytes;
    if (d.kind == Kind::load) {
        d.write(reg, Source::loaded);
    } else {
        d.read(Role::store_data, reg);
    }
}
void load_literal(Decoded& d, uint32_t e) {
    memory(d, high(e), 4);
    d.read(Role::address, registers::pc);
}
template <std::uint8_t bytes>
void memory_by_register(Decoded& d, uint32_t e) {
    memory(d, low(e), bytes);
    d.read(Role::address, middle(e));
    d.read(Role::index, field(e, 6, 3));
}
template <std::uint8_t bytes>
void memory_by_constant(Decoded& d, uint32_t e) {
    memory(d, low(e), bytes);
    d.read(Role::address, middle(e));
}
void memory_on_stack(Decoded& d, uint32_t e) {
    memory(d, high(e), 4);
    d.read(Role::address, registers::sp);
}
void address_from_pc(Decoded& d, uint32_t e) {
    d.write(high(e));
    d.read(Role::operand, registers::pc);
}
void address_from_sp(Decoded& d, uint32_t e) {
    d.write(high(e));
    d.read(Role::operand, registers::sp);
}
void adjust_sp(Decoded& d, uint32_t) {
    d.write(registers::sp);
    d.read(Role::operand, registers::sp);
}
void extend(Decoded& d, uint32_t e) {
    d.write(low(e));
    d.read(Role::operand, middle(e));
}
void reverse(Decoded& d, uint32_t e) {
    d.early_result = true;
    d.uses_shifter = true;
    d.write(low(e));
    d.read(Role::shifted, middle(e));
}

void several(Decoded& d, uint32_t list) {
    d.access_bytes = 4;
    for (unsigned reg = 0; reg < 16; ++reg) {
        if ((list >> reg & 1U) != 0) {
            ++d.registers;
            if (d.kind == Kind::load_multiple) {
                d.write(reg, Source::loaded);
            } else {
                d.read(Role::store_data, reg);
            }
        }
    }
    if (d.kind == Kind::load_multiple && (list >> registers::pc & 1U) != 0) {
        d.branch = Branch::back;
    }
}
void push(Decoded& d, uint32_t e) {
    several(d, field(e, 0, 8) | field(e, 8, 1) << registers::lr);
    d.read(Role::address, registers::sp);
    d.write(registers::sp, Source::base);
}
void pop(Decoded& d, uint32_t e) {
    several(d, field(e, 0, 8) | field(e, 8, 1) << registers::pc);
    d.read(Role::address, registers::sp);
    d.write(registers::sp, Source::base);
}
void store_multiple(Decoded& d, uint32_t e) {
    several(d, field(e, 0, 8));
    d.read(Role::address, high(e));
    d.write(high(e), Source::base);
}
void load_multiple(Decoded& d, uint32_t e) {
    several(d, field(e, 0, 8));
    d.read(Role::address, high(e));
    if ((e >> high(e) & 1U) == 0) {
        d.write(high(e), Source::base);
    }
}

void compare_and_branch(Decoded& d, uint32_t e) {
    d.read(Role::operand, low(e));
    d.branch = Branch::conditional;
}
void branch_if(Decoded& d, uint32_t e) {
    d.branch = Branch::conditional;
    d.condition = static_cast<std::uint8_t>(field(e, 8, 4));
    d.backward = field(e, 7, 1) != 0;
}
void branch(Decoded& d, uint32_t e) {
    d.branch = d.condition == 0xE ? Branch::direct : Branch::conditional;
    d.backward = field(e, 10, 1) != 0;
}
void nothing(Decoded&, uint32_t) {}

constexpr EncodingRow rows[] = {
    {0xF800, 0x0000, "lsl", Kind::shift, shift_by_constant},
    {0xF800, 0x0800, "lsr", Kind::shift, shift_by_constant},
    {0xF800, 0x1000, "asr", Kind::shift, shift_by_constant},
    {0xFE00, 0x1800, "add", Kind::add, three_registers},
    {0xFE00, 0x1A00, "sub", Kind::add, three_registers},
    {0xFE00, 0x1C00, "add", Kind::add, two_registers_constant},
    {0xFE00, 0x1E00, "sub", Kind::add, two_registers_constant},
    {0xF800, 0x2000, "mov", Kind::add, move_constant},
    {0xF800, 0x2800, "cmp", Kind::add, compare_constant},
    {0xF800, 0x3000, "add", Kind::add, add_constant},
    {0xF800, 0x3800, "sub", Kind::add, add_constant},
    {0xFFC0, 0x4000, "and", Kind::logic, arithmetic},
    {0xFFC0, 0x4040, "eor", Kind::logic, arithmetic},
    {0xFFC0, 0x4080, "lsl", Kind::shift, arithmetic},
    {0xFFC0, 0x40C0, "lsr", Kind::shift, arithmetic},
    {0xFFC0, 0x4100, "asr", Kind::shift, arithmetic},
    {0xFFC0, 0x4140, "adc", Kind::logic, arithmetic_with_carry},
    {0xFFC0, 0x4180, "sbc", Kind::logic, arithmetic_with_carry},
    {0xFFC0, 0x41C0, "ror", Kind::shift, arithmetic},
    {0xFFC0, 0x4200, "tst", Kind::logic, compare_registers},
    {0xFFC0, 0x4240, "rsb", Kind::logic, one_operand},
    {0xFFC0, 0x4280, "cmp", Kind::add, compare_registers},
    {0xFFC0, 0x42C0, "cmn", Kind::add, compare_registers},
    {0xFFC0, 0x4300, "orr", Kind::logic, arithmetic},
    {0xFFC0, 0x4340, "mul", Kind::multiply, multiply},
    {0xFFC0, 0x4380, "bic", Kind::logic, arithmetic},
    {0xFFC0, 0x43C0, "mvn", Kind::logic, one_operand},
    {0xFF00, 0x4400, "add", Kind::add, add_high},
    {0xFF00, 0x4500, "cmp", Kind::add, compare_high},
    {0xFF00, 0x4600, "mov", Kind::add, move_high},
    {0xFF87, 0x4700, "bx", Kind::branch, branch_to_register},
    {0xFF87, 0x4780, "blx", Kind::branch, branch_to_register},
    {0xF800, 0x4800, "ldr", Kind::load, load_literal},
    {0xFE00, 0x5000, "str", Kind::store, memory_by_register<4>},
    {0xFE00, 0x5200, "strh", Kind::store, memory_by_register<2>},
    {0xFE00, 0x5400, "strb", Kind::store, memory_by_register<1>},
    {0xFE00, 0x5600, "ldrsb", Kind::load, memory_by_register<1>},
    {0xFE00, 0x5800, "ldr", Kind::load, memory_by_register<4>},
    {0xFE00, 0x5A00, "ldrh", Kind::load, memory_by_register<2>},
    {0xFE00, 0x5C00, "ldrb", Kind::load, memory_by_register<1>},
    {0xFE00, 0x5E00, "ldrsh", Kind::load, memory_by_register<2>},
    {0xF800, 0x6000, "str", Kind::store, memory_by_constant<4>},
    {0xF800, 0x6800, "ldr", Kind::load, memory_by_constant<4>},
    {0xF800, 0x7000, "strb", Kind::store, memory_by_constant<1>},
    {0xF800, 0x7800, "ldrb", Kind::load, memory_by_constant<1>},
    {0xF800, 0x8000, "strh", Kind::store, memory_by_constant<2>},
    {0xF800, 0x8800, "ldrh", Kind::load, memory_by_constant<2>},
    {0xF800, 0x9000, "str", Kind::store, memory_on_stack},
    {0xF800, 0x9800, "ldr", Kind::load, memory_on_stack},
    {0xF800, 0xA000, "adr", Kind::add, address_from_pc},
    {0xF800, 0xA800, "add", Kind::add, address_from_sp},
    {0xFF80, 0xB000, "add", Kind::add, adjust_sp},
    {0xFF80, 0xB080, "sub", Kind::add, adjust_sp},
    {0xFD00, 0xB100, "cbz", Kind::branch, compare_and_branch},
    {0xFD00, 0xB900, "cbnz", Kind::branch, compare_and_branch},
    {0xFFC0, 0xB200, "sxth", Kind::bitfield, extend},
    {0xFFC0, 0xB240, "sxtb", Kind::bitfield, extend},
    {0xFFC0, 0xB280, "uxth", Kind::bitfield, extend},
    {0xFFC0, 0xB2C0, "uxtb", Kind::bitfield, extend},
    {0xFE00, 0xB400, "push", Kind::store_multiple, push},
    {0xFFF8, 0xB660, "cpsie", Kind::system, nothing},
    {0xFFF8, 0xB670, "cpsid", Kind::system, nothing},
    {0xFFC0, 0xBA00, "rev", Kind::bitfield, reverse},
    {0xFFC0, 0xBA40, "rev16", Kind::bitfield, reverse},
    {0xFFC0, 0xBAC0, "revsh", Kind::bitfield, reverse},
    {0xFE00, 0xBC00, "pop", Kind::load_multiple, pop},
    {0xFF00, 0xBE00, "bkpt", Kind::system, nothing},
    {0xFFFF, 0xBF00, "nop", Kind::hint, nothing},
    {0xFFFF, 0xBF10, "yield", Kind::hint, nothing},
    {0xFFFF, 0xBF20, "wfe", Kind::hint, nothing},
    {0xFFFF, 0xBF30, "wfi", Kind::hint, nothing},
    {0xFFFF, 0xBF40, "sev", Kind::hint, nothing},
    {0xFF0F, 0xBF00, "", Kind::unknown, nothing},
    {0xFF00, 0xBF00, "it", Kind::if_then, nothing},
    {0xF800, 0xC000, "stmia", Kind::store_multiple, store_multiple},
    {0xF800, 0xC800, "ldmia", Kind::load_multiple, load_multiple},
    {0xFF00, 0xDE00, "udf", Kind::system, nothing},
    {0xFF00, 0xDF00, "svc", Kind::system, nothing},
    {0xF000, 0xD000, "b", Kind::branch, branch_if},
    {0xF800, 0xE000, "b", Kind::branch, branch},
};

}  // namespace

std::span<const EncodingRow> narrow_rows() { return rows; }

}  // namespace timing
