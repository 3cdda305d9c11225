// 32-bit encodings of the FPU: single and double precision.
#include "qemu/timing/encoding_rows.hpp"

namespace timing {
namespace {

using std::uint32_t;

bool is_double(uint32_t e) { return field(e, 8, 1) != 0; }

// Number of the first single register of the field whose four bits begin at `four` and whose fifth is `one`.
unsigned first_single(uint32_t e, unsigned four, unsigned one, bool two) {
    return registers::s0 + (two ? 2 * field(e, four, 4) : 2 * field(e, four, 4) + field(e, one, 1));
}
// A double's fifth bit numbers d16 and above, which the core has not.
bool beyond(uint32_t e, unsigned one, bool two) { return two && field(e, one, 1) != 0; }

void reads(Decoded& d, Role role, unsigned first, bool two) {
    d.read(role, first);
    if (two) {
        d.read(role, first + 1);
    }
}
void writes(Decoded& d, unsigned first, bool two, Source source = Source::result) {
    d.write(first, source);
    if (two) {
        d.write(first + 1, source);
    }
}
void vd(Decoded& d, uint32_t e, bool two) {
    writes(d, first_single(e, 12, 22, two), two);
    if (beyond(e, 22, two)) {
        d.kind = Kind::unknown;
    }
}
void vn(Decoded& d, uint32_t e, Role role, bool two) {
    reads(d, role, first_single(e, 16, 7, two), two);
    if (beyond(e, 7, two)) {
        d.kind = Kind::unknown;
    }
}
void vm(Decoded& d, uint32_t e, Role role, bool two) {
    reads(d, role, first_single(e, 0, 5, two), two);
    if (beyond(e, 5, two)) {
        d.kind = Kind::unknown;
    }
}
void mark(Decoded& d, uint32_t e) {
    d.is_fp = true;
    d.is_double = is_double(e);
}

void three(Decoded& d, uint32_t e) {
    mark(d, e);
    vd(d, e, d.is_double);
    const Role role = d.kind == Kind::fp_mul ? Role::multiplicand : Role::operand;
    vn(d, e, role, d.is_double);
    vm(d, e, role, d.is_double);
}
template <bool fused>
void accumulate(Decoded& d, uint32_t e) {
    mark(d, e);
    d.fused = fused;
    vd(d, e, d.is_double);
    reads(d, Role::accumulator, first_single(e, 12, 22, d.is_double), d.is_double);
    vn(d, e, Role::multiplicand, d.is_double);
    vm(d, e, Role::multiplicand, d.is_double);
}
void two(Decoded& d, uint32_t e) {
    mark(d, e);
    vd(d, e, d.is_double);
    vm(d, e, Role::operand, d.is_double);
}
void select(Decoded& d, uint32_t e) {
    three(d, e);
    d.read(Role::condition, registers::flags);
}
void constant(Decoded& d, uint32_t e) {
    mark(d, e);
    vd(d, e, d.is_double);
}
void compare(Decoded& d, uint32_t e) {
    mark(d, e);
    reads(d, Role::operand, first_single(e, 12, 22, d.is_double), d.is_double);
    if (field(e, 16, 1) == 0) {
        vm(d, e, Role::operand, d.is_double);
    }
    d.write(registers::fp_flags, Source::flags);
}
void between_precisions(Decoded& d, uint32_t e) {
    mark(d, e);  // the bit is that of the source
    vd(d, e, !is_double(e));
    vm(d, e, Role::operand, is_double(e));
}
void half_precision(Decoded& d, uint32_t e) {
    mark(d, e);
    const bool to_half = field(e, 16, 1) != 0;
    vd(d, e, is_double(e) && !to_half);
    vm(d, e, Role::operand, is_double(e) && to_half);
}
void from_integer(Decoded& d, uint32_t e) {
    mark(d, e);
    vd(d, e, is_double(e));
    vm(d, e, Role::operand, false);
}
void to_integer(Decoded& d, uint32_t e) {
    mark(d, e);
    vd(d, e, false);
    vm(d, e, Role::operand, is_double(e));
}
void fixed_point(Decoded& d, uint32_t e) {
    mark(d, e);
    vd(d, e, is_double(e));
    reads(d, Role::operand, first_single(e, 12, 22, is_double(e)), is_double(e));
}

// Between a single and a core register: the rows are of those that write the single.
void with_core_register(Decoded& d, uint32_t e, unsigned single) {
    d.is_fp = true;
    if (field(e, 20, 1) != 0) {
        d.kind = Kind::fp_to_core;
        d.write(field(e, 12, 4));
        d.read(Role::operand, single);
    } else {
        d.write(single);
        d.read(Role::operand, field(e, 12, 4));
    }
}
void one_core_register(Decoded& d, uint32_t e) { with_core_register(d, e, first_single(e, 16, 7, false)); }
void half_of_double(Decoded& d, uint32_t e) {
    with_core_register(d, e, first_single(e, 16, 7, true) + field(e, 21, 1));
    if (beyond(e, 7, true)) {
        d.kind = Kind::unknown;
    }
}
void two_core_registers(Decoded& d, uint32_t e) {
    d.is_fp = true;
    d.both_fp_ports = true;
    const unsigned first = first_single(e, 0, 5, is_double(e));
    if (beyond(e, 5, is_double(e)) || first == registers::s0 + 31) {
        d.kind = Kind::unknown;
        return;
    }
    if (field(e, 20, 1) != 0) {
        d.kind = Kind::fp_to_core;
        d.write(field(e, 12, 4));
        d.write(field(e, 16, 4));
        reads(d, Role::operand, first, true);
    } else {
        writes(d, first, true);
        d.read(Role::operand, field(e, 12, 4));
        d.read(Role::operand, field(e, 16, 4));
    }
}
void status_to_core(Decoded& d, uint32_t e) {
    d.is_fp = true;
    d.both_fp_ports = true;
    d.read(Role::condition, registers::fp_flags);
    if (field(e, 12, 4) == registers::pc) {
        d.sets_flags = true;
    } else {
        d.write(field(e, 12, 4));
    }
}
void status_from_core(Decoded& d, uint32_t e) {
    d.is_fp = true;
    d.both_fp_ports = true;
    d.write(registers::fp_flags, Source::flags);
    d.read(Role::operand, field(e, 12, 4));
}

void transfer(Decoded& d, uint32_t e, unsigned count) {
    mark(d, e);
    const unsigned first = first_single(e, 12, 22, d.is_double);
    if (beyond(e, 22, d.is_double) || first + count > registers::s0 + 32U || count == 0) {
        d.kind = Kind::unknown;
        return;
    }
    d.access_bytes = 4;
    d.registers = static_cast<std::uint8_t>(count);
    for (unsigned reg = first; reg < first + count; ++reg) {
        if (d.is_load()) {
            d.write(reg, Source::loaded);
        } else {
            d.read(Role::store_data, reg);
        }
    }
    d.read(Role::address, field(e, 16, 4));
}
void one(Decoded& d, uint32_t e) {
    if (is_double(e)) {
        d.kind = d.kind == Kind::load ? Kind::load_multiple : Kind::store_multiple;
    }
    transfer(d, e, is_double(e) ? 2 : 1);
}
void several(Decoded& d, uint32_t e) {
    transfer(d, e, is_double(e) ? field(e, 0, 8) & ~1U : field(e, 0, 8));
    if (field(e, 21, 1) != 0) {
        d.write(field(e, 16, 4), Source::base);
    }
}

constexpr EncodingRow rows[] = {
    {0xFFE00FD0, 0xEC400A10, "vmov", Kind::fp_from_core, two_core_registers},
    {0xFFE00FD0, 0xEC400B10, "vmov", Kind::fp_from_core, two_core_registers},
    {0xFF300E00, 0xED000A00, "vstr", Kind::store, one},
    {0xFF300E00, 0xED100A00, "vldr", Kind::load, one},
    {0xFFBF0E00, 0xED2D0A00, "vpush", Kind::store_multiple, several},
    {0xFFBF0E00, 0xECBD0A00, "vpop", Kind::load_multiple, several},
    {0xFF900E00, 0xEC800A00, "vstmia", Kind::store_multiple, several},
    {0xFF900E00, 0xEC900A00, "vldmia", Kind::load_multiple, several},
    {0xFFB00E00, 0xED200A00, "vstmdb", Kind::store_multiple, several},
    {0xFFB00E00, 0xED300A00, "vldmdb", Kind::load_multiple, several},

    {0xFFB00E50, 0xEE000A00, "vmla", Kind::fp_mac, accumulate<false>},
    {0xFFB00E50, 0xEE000A40, "vmls", Kind::fp_mac, accumulate<false>},
    {0xFFB00E50, 0xEE100A00, "vnmls", Kind::fp_mac, accumulate<false>},
    {0xFFB00E50, 0xEE100A40, "vnmla", Kind::fp_mac, accumulate<false>},
    {0xFFB00E50, 0xEE200A00, "vmul", Kind::fp_mul, three},
    {0xFFB00E50, 0xEE200A40, "vnmul", Kind::fp_mul, three},
    {0xFFB00E50, 0xEE300A00, "vadd", Kind::fp_add, three},
    {0xFFB00E50, 0xEE300A40, "vsub", Kind::fp_add, three},
    {0xFFB00E50, 0xEE800A00, "vdiv", Kind::fp_divide, three},
    {0xFFB00E50, 0xEE900A00, "vfnms", Kind::fp_mac, accumulate<true>},
    {0xFFB00E50, 0xEE900A40, "vfnma", Kind::fp_mac, accumulate<true>},
    {0xFFB00E50, 0xEEA00A00, "vfma", Kind::fp_mac, accumulate<true>},
    {0xFFB00E50, 0xEEA00A40, "vfms", Kind::fp_mac, accumulate<true>},
    {0xFFB00EF0, 0xEEB00A00, "vmov", Kind::fp_move_immediate, constant},
    {0xFFBF0ED0, 0xEEB00A40, "vmov", Kind::fp_move, two},
    {0xFFBF0ED0, 0xEEB00AC0, "vabs", Kind::fp_add, two},
    {0xFFBF0ED0, 0xEEB10A40, "vneg", Kind::fp_add, two},
    {0xFFBF0ED0, 0xEEB10AC0, "vsqrt", Kind::fp_sqrt, two},
    {0xFFBE0ED0, 0xEEB20A40, "vcvtb", Kind::fp_convert, half_precision},
    {0xFFBE0ED0, 0xEEB20AC0, "vcvtt", Kind::fp_convert, half_precision},
    {0xFFBE0ED0, 0xEEB40A40, "vcmp", Kind::fp_add, compare},
    {0xFFBE0ED0, 0xEEB40AC0, "vcmpe", Kind::fp_add, compare},
    {0xFFBF0ED0, 0xEEB60A40, "vrintr", Kind::fp_convert, two},
    {0xFFBF0ED0, 0xEEB60AC0, "vrintz", Kind::fp_convert, two},
    {0xFFBF0ED0, 0xEEB70A40, "vrintx", Kind::fp_convert, two},
    {0xFFBF0ED0, 0xEEB70AC0, "vcvt", Kind::fp_convert, between_precisions},
    {0xFFBF0E50, 0xEEB80A40, "vcvt", Kind::fp_convert, from_integer},
    {0xFFBA0E50, 0xEEBA0A40, "vcvt", Kind::fp_convert, fixed_point},
    {0xFFBE0ED0, 0xEEBC0A40, "vcvtr", Kind::fp_convert, to_integer},
    {0xFFBE0ED0, 0xEEBC0AC0, "vcvt", Kind::fp_convert, to_integer},
    {0xFFB00E50, 0xFE000A00, "vseleq", Kind::fp_add, select},
    {0xFFB00E50, 0xFE100A00, "vselvs", Kind::fp_add, select},
    {0xFFB00E50, 0xFE200A00, "vselge", Kind::fp_add, select},
    {0xFFB00E50, 0xFE300A00, "vselgt", Kind::fp_add, select},
    {0xFFB00E50, 0xFE800A00, "vmaxnm", Kind::fp_add, three},
    {0xFFB00E50, 0xFE800A40, "vminnm", Kind::fp_add, three},
    {0xFFBF0ED0, 0xFEB80A40, "vrinta", Kind::fp_convert, two},
    {0xFFBF0ED0, 0xFEB90A40, "vrintn", Kind::fp_convert, two},
    {0xFFBF0ED0, 0xFEBA0A40, "vrintp", Kind::fp_convert, two},
    {0xFFBF0ED0, 0xFEBB0A40, "vrintm", Kind::fp_convert, two},
    {0xFFBF0E50, 0xFEBC0A40, "vcvta", Kind::fp_convert, to_integer},
    {0xFFBF0E50, 0xFEBD0A40, "vcvtn", Kind::fp_convert, to_integer},
    {0xFFBF0E50, 0xFEBE0A40, "vcvtp", Kind::fp_convert, to_integer},
    {0xFFBF0E50, 0xFEBF0A40, "vcvtm", Kind::fp_convert, to_integer},

    {0xFFE00F7F, 0xEE000A10, "vmov", Kind::fp_from_core, one_core_register},
    {0xFFC00F7F, 0xEE000B10, "vmov", Kind::fp_from_core, half_of_double},
    {0xFFFF0FFF, 0xEEF10A10, "vmrs", Kind::fp_to_core, status_to_core},
    {0xFFFF0FFF, 0xEEE10A10, "vmsr", Kind::fp_from_core, status_from_core},
};

}  // namespace

std::span<const EncodingRow> floating_point_rows() { return rows; }

}  // namespace timing
