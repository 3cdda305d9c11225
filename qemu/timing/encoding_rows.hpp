// The decoder's tables: one row an encoding, the first that matches counts.
#pragma once

#include <cstdint>
#include <span>

#include "qemu/timing/decoded.hpp"

namespace timing {

/// Fills in registers and roles from the encoding's fields.
using Fields = void (*)(Decoded& decoded, std::uint32_t encoding);

struct EncodingRow {
    std::uint32_t mask;
    std::uint32_t value;
    const char* mnemonic;
    Kind kind;
    Fields fields;
};

[[nodiscard]] std::span<const EncodingRow> narrow_rows();           ///< 16 bits
[[nodiscard]] std::span<const EncodingRow> data_processing_rows();  ///< 32 bits: arithmetic, multiplication, branches
[[nodiscard]] std::span<const EncodingRow> load_store_rows();       ///< 32 bits
[[nodiscard]] std::span<const EncodingRow> floating_point_rows();   ///< 32 bits

/// The bits of a word from `low` on.
[[nodiscard]] constexpr unsigned field(std::uint32_t word, unsigned low, unsigned width) {
    return (word >> low) & ((1U << width) - 1);
}

}  // namespace timing
