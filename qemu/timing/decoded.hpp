// What the timing model needs to know of one instruction: what kind of work it is, which registers it reads in which
// role, which it writes, and what it does with memory and control. No figure of time is here.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace timing {

/// Registers as one numbering: r0 to r15, s0 to s31 (a double is two of them), then the flags.
namespace registers {
inline constexpr std::uint8_t sp = 13;
inline constexpr std::uint8_t lr = 14;
inline constexpr std::uint8_t pc = 15;
inline constexpr std::uint8_t s0 = 16;
inline constexpr std::uint8_t flags = 48;     ///< N, Z, C, V
inline constexpr std::uint8_t ge = 49;        ///< GE bits: parallel additions write them, SEL reads them
inline constexpr std::uint8_t fp_flags = 50;  ///< FPSCR: VCMP writes it, VMRS reads it
inline constexpr std::uint8_t count = 51;
}  // namespace registers

/// The unit that does the work, as far as timing tells units apart.
enum class Kind : std::uint8_t {
    unknown,   ///< no encoding that the decoder knows
    add,       ///< ADD, SUB, MOV and their comparisons, not shifted: the early ALU may do them
    logic,     ///< the other one-cycle work of the ALU, and all with an inline shifted operand
    shift,     ///< plain shifts
    bitfield,  ///< bit fields, extensions, saturation, SIMD additions: one unit has them
    multiply,
    divide,
    load,
    load_multiple,  ///< LDM, POP, LDRD, VLDM, VLDR of a double
    store,
    store_multiple,
    branch,
    if_then,
    hint,     ///< NOP and the like, PLD
    barrier,  ///< DSB, DMB, ISB
    system,   ///< MRS, MSR, CPS, SVC, BKPT
    fp_add,   ///< VADD, VSUB, VCMP, VABS, VNEG, VSEL, VMAXNM
    fp_mul,
    fp_mac,  ///< VFMA, VMLA and their forms
    fp_divide,
    fp_sqrt,
    fp_convert,
    fp_move_immediate,
    fp_move,       ///< VMOV s, s
    fp_from_core,  ///< VMOV s, r
    fp_to_core,    ///< VMOV r, s; VMRS
};

/// In which place of an instruction a register is read: places differ in when they must be there.
enum class Role : std::uint8_t {
    operand,       ///< of the ALU
    shifted,       ///< passes the shifter first, or is taken by the early ALU
    address,       ///< the base
    index,         ///< the register that is added to it
    multiplicand,  ///< of an integer or floating-point product, and of a division
    accumulator,   ///< what a product is added to
    store_data,
    condition,  ///< flags, for a branch, an IT block's member, ADC, SEL
};

enum class Branch : std::uint8_t {
    none,
    direct,       ///< B
    conditional,  ///< B<c>, CBZ, CBNZ
    call,         ///< BL
    indirect,     ///< BX, BLX, and loads into PC that are no return; TBB, TBH
    back,         ///< BX LR, POP {.., PC}
};

struct Read {
    std::uint8_t reg;
    Role role;
};

enum class Source : std::uint8_t {
    result,
    loaded,
    base,  ///< the address of a pre- or post-indexed access
    flags,
};

struct Write {
    std::uint8_t reg;
    Source source;
};

struct Decoded {
    const char* mnemonic = "";  ///< without condition, width and the S that sets flags
    Kind kind = Kind::unknown;
    Branch branch = Branch::none;
    std::uint8_t bytes = 2;
    std::uint8_t condition = 0xE;   ///< of the IT block that it stands in, or of B<c>
    std::uint8_t registers = 0;     ///< loaded or stored
    std::uint8_t access_bytes = 0;  ///< of one register
    bool backward = false;          ///< a direct branch to a lower address
    bool sets_flags = false;        ///< writes N, Z, C or V
    bool uses_shifter = false;      ///< an inline shifted operand, or a constant that is a shifted byte
    bool fused = false;             ///< of an fp_mac: VFMA rather than VMLA
    bool is_double = false;         ///< works on f64
    bool is_fp = false;             ///< of the FPU's register file
    bool both_fp_ports = false;     ///< VMOV of two registers, VMRS, VMSR
    bool early_result = false;      ///< of a bitfield: REV, RBIT, which are done before the ALU
    bool saturates = false;         ///< of a bitfield: its result passes the saturation behind the ALU
    bool in_it_block = false;
    std::uint8_t read_count = 0;
    std::uint8_t write_count = 0;
    std::array<Read, 36> reads{};
    std::array<Write, 36> writes{};

    [[nodiscard]] std::span<const Read> all_reads() const { return std::span(reads).first(read_count); }
    void read(Role role, unsigned reg) { reads[read_count++] = {static_cast<std::uint8_t>(reg), role}; }
    void write(unsigned reg, Source source = Source::result) {
        writes[write_count++] = {static_cast<std::uint8_t>(reg), source};
    }
    [[nodiscard]] bool is_load() const { return kind == Kind::load || kind == Kind::load_multiple; }
    [[nodiscard]] bool is_store() const { return kind == Kind::store || kind == Kind::store_multiple; }
    /// BL, or BLX of a register. A jump may also load LR, with PC: that is none.
    [[nodiscard]] bool is_call() const {
        return branch == Branch::call ||
               (branch == Branch::indirect && writes[0].reg == registers::lr && writes[0].source == Source::result);
    }
    [[nodiscard]] bool is_fp_arithmetic() const { return kind >= Kind::fp_add && kind <= Kind::fp_convert; }
};

}  // namespace timing
