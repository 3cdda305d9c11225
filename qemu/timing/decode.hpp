// Decodes ARMv7E-M with FPv5. [ARMv7-M Architecture Reference Manual, A5, A6, A7]
#pragma once

#include <cstdint>

#include "qemu/timing/decoded.hpp"

namespace timing {

inline constexpr std::uint8_t always = 0xE;

/// \param encoding   16-bit: the halfword; 32-bit: first halfword in the upper half
/// \param bytes      2 or 4
/// \param condition  of the IT block that the instruction stands in; `always` outside of one or under an "al"
/// \param in_it_block  16-bit arithmetic sets no flags there
/// \return with Kind::unknown when no row of the tables matches
[[nodiscard]] Decoded decode(std::uint32_t encoding, std::uint8_t bytes, std::uint8_t condition = always,
                             bool in_it_block = false);

/// Conditions of the members of an IT block, from the IT instruction.
class ItBlock {
public:
    void begin(std::uint32_t encoding) { state_ = static_cast<std::uint8_t>(encoding & 0xFF); }
    /// Whether the next instruction is a member.
    [[nodiscard]] bool inside() const { return (state_ & 0xF) != 0; }
    [[nodiscard]] std::uint8_t condition() const { return inside() ? state_ >> 4 : always; }
    void advance() {
        state_ = (state_ & 0x7) == 0 ? 0 : static_cast<std::uint8_t>((state_ & 0xE0) | ((state_ << 1) & 0x1F));
    }

private:
    std::uint8_t state_ = 0;
};

}  // namespace timing
