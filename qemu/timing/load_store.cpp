// 32-bit encodings of the integer core that access memory.
#include "qemu/timing/encoding_rows.hpp"

namespace timing {
namespace {

using std::uint32_t;

unsigned rn(uint32_t e) { return field(e, 16, 4); }
unsigned rt(uint32_t e) { return field(e, 12, 4); }

void transfer(Decoded& d, unsigned reg, std::uint8_t bytes) {
    d.access_bytes = bytes;
    ++d.registers;
    if (d.is_load()) {
        d.write(reg, Source::loaded);
        if (reg == registers::pc) {
            d.branch = Branch::indirect;
        }
    } else {
        d.read(Role::store_data, reg);
    }
}

void single(Decoded& d, uint32_t e, std::uint8_t bytes) {
    const bool by_constant_12 = field(e, 23, 1) != 0 || (rn(e) == registers::pc && d.kind == Kind::load);
    const bool by_constant_8 = field(e, 11, 1) != 0;
    if (rt(e) == registers::pc && d.kind == Kind::load && bytes < 4) {
        d.kind = Kind::hint;
        d.mnemonic = field(e, 24, 1) != 0 ? "pli" : "pld";
    } else {
        transfer(d, rt(e), bytes);
    }
    d.read(Role::address, rn(e));
    if (by_constant_12) {
        return;
    }
    if (!by_constant_8) {
        if (field(e, 6, 5) != 0) {
            d.kind = Kind::unknown;
        }
        d.read(Role::index, field(e, 0, 4));
        return;
    }
    const bool before = field(e, 10, 1) != 0;
    const bool writes_base = field(e, 8, 1) != 0;
    if (!before && !writes_base) {
        d.kind = Kind::unknown;
    } else if (writes_base) {
        d.write(rn(e), Source::base);
    } else if (field(e, 9, 1) != 0 && d.kind != Kind::hint) {  // unprivileged
        switch (field(e, 20, 5)) {
            case 0x00:
                d.mnemonic = "strbt";
                break;
            case 0x01:
                d.mnemonic = "ldrbt";
                break;
            case 0x02:
                d.mnemonic = "strht";
                break;
            case 0x03:
                d.mnemonic = "ldrht";
                break;
            case 0x04:
                d.mnemonic = "strt";
                break;
            case 0x05:
                d.mnemonic = "ldrt";
                break;
            case 0x11:
                d.mnemonic = "ldrsbt";
                break;
            default:
                d.mnemonic = "ldrsht";
                break;
        }
    }
    if (d.branch == Branch::indirect && rn(e) == registers::sp && writes_base) {
        d.branch = Branch::back;
    }
}
template <std::uint8_t bytes>
void single(Decoded& d, uint32_t e) {
    single(d, e, bytes);
}

void pair(Decoded& d, uint32_t e) {
    transfer(d, rt(e), 4);
    transfer(d, field(e, 8, 4), 4);
    d.read(Role::address, rn(e));
    if (field(e, 21, 1) != 0) {
        d.write(rn(e), Source::base);
    }
}

void several(Decoded& d, uint32_t e) {
    for (unsigned reg = 0; reg < 16; ++reg) {
        if ((e >> reg & 1U) != 0) {
            transfer(d, reg, 4);
        }
    }
    d.read(Role::address, rn(e));
    if (field(e, 21, 1) != 0) {
        d.write(rn(e), Source::base);
    }
    if (d.branch == Branch::indirect && rn(e) == registers::sp) {
        d.branch = Branch::back;
    }
}

template <std::uint8_t bytes>
void load_exclusive(Decoded& d, uint32_t e) {
    transfer(d, rt(e), bytes);
    d.read(Role::address, rn(e));
}
void store_exclusive(Decoded& d, uint32_t e) {
    transfer(d, rt(e), 4);
    d.read(Role::address, rn(e));
    d.write(field(e, 8, 4));
}
template <std::uint8_t bytes>
void store_exclusive_narrow(Decoded& d, uint32_t e) {
    transfer(d, rt(e), bytes);
    d.read(Role::address, rn(e));
    d.write(field(e, 0, 4));
}
void table_branch(Decoded& d, uint32_t e) {
    d.branch = Branch::indirect;
    d.registers = 1;
    d.access_bytes = field(e, 4, 1) != 0 ? 2 : 1;
    d.read(Role::address, rn(e));
    d.read(Role::index, field(e, 0, 4));
}

constexpr EncodingRow rows[] = {
    {0xFFF00F00, 0xE8500F00, "ldrex", Kind::load, load_exclusive<4>},
    {0xFFF00FFF, 0xE8D00F4F, "ldrexb", Kind::load, load_exclusive<1>},
    {0xFFF00FFF, 0xE8D00F5F, "ldrexh", Kind::load, load_exclusive<2>},
    {0xFFF00FF0, 0xE8C00F40, "strexb", Kind::store, store_exclusive_narrow<1>},
    {0xFFF00FF0, 0xE8C00F50, "strexh", Kind::store, store_exclusive_narrow<2>},
    {0xFFF0FFF0, 0xE8D0F000, "tbb", Kind::branch, table_branch},
    {0xFFF0FFF0, 0xE8D0F010, "tbh", Kind::branch, table_branch},
    {0xFFF00000, 0xE8400000, "strex", Kind::store, store_exclusive},
    {0xFF700000, 0xE8700000, "ldrd", Kind::load_multiple, pair},
    {0xFF500000, 0xE9500000, "ldrd", Kind::load_multiple, pair},
    {0xFF700000, 0xE8F00000, "ldrd", Kind::load_multiple, pair},
    {0xFF700000, 0xE8600000, "strd", Kind::store_multiple, pair},
    {0xFF500000, 0xE9400000, "strd", Kind::store_multiple, pair},
    {0xFFD00000, 0xE8800000, "stmia", Kind::store_multiple, several},
    {0xFFD00000, 0xE8900000, "ldmia", Kind::load_multiple, several},
    {0xFFD00000, 0xE9000000, "stmdb", Kind::store_multiple, several},
    {0xFFD00000, 0xE9100000, "ldmdb", Kind::load_multiple, several},
    {0xFF700000, 0xF8000000, "strb", Kind::store, single<1>},
    {0xFF700000, 0xF8100000, "ldrb", Kind::load, single<1>},
    {0xFF700000, 0xF8200000, "strh", Kind::store, single<2>},
    {0xFF700000, 0xF8300000, "ldrh", Kind::load, single<2>},
    {0xFF700000, 0xF8400000, "str", Kind::store, single<4>},
    {0xFF700000, 0xF8500000, "ldr", Kind::load, single<4>},
    {0xFF700000, 0xF9100000, "ldrsb", Kind::load, single<1>},
    {0xFF700000, 0xF9300000, "ldrsh", Kind::load, single<2>},
};

}  // namespace

std::span<const EncodingRow> load_store_rows() { return rows; }

}  // namespace timing
