#include "qemu/timing/decode.hpp"

#include "qemu/timing/encoding_rows.hpp"

namespace timing {
namespace {

bool apply(std::span<const EncodingRow> rows, std::uint32_t encoding, Decoded& decoded) {
    for (const EncodingRow& row : rows) {
        if ((encoding & row.mask) == row.value) {
            decoded.mnemonic = row.mnemonic;
            decoded.kind = row.kind;
            row.fields(decoded, encoding);
            return decoded.kind != Kind::unknown;
        }
    }
    return false;
}

}  // namespace

Decoded decode(std::uint32_t encoding, std::uint8_t bytes, std::uint8_t condition, bool in_it_block) {
    Decoded decoded;
    decoded.bytes = bytes;
    decoded.condition = condition;
    decoded.in_it_block = in_it_block;
    const bool known = bytes == 2 ? apply(narrow_rows(), encoding, decoded)
                                  : apply(load_store_rows(), encoding, decoded) ||
                                        apply(data_processing_rows(), encoding, decoded) ||
                                        apply(floating_point_rows(), encoding, decoded);
    if (!known) {
        Decoded unknown;
        unknown.bytes = bytes;
        unknown.mnemonic = "unknown";
        return unknown;
    }
    if (decoded.sets_flags) {
        decoded.write(registers::flags, Source::flags);
    }
    if (decoded.condition != always) {
        decoded.read(Role::condition, registers::flags);
    }
    return decoded;
}

}  // namespace timing
