// Any instruction, in and out of an IT block: decoded, or said to be unknown.
#include "qemu/timing/decode.hpp"
#include "tests/fuzz/refused.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    timing::ItBlock block;
    for (std::size_t i = 0; i + 4 <= size; i += 4) {
        const std::uint32_t word = static_cast<std::uint32_t>(data[i]) << 24 |
                                   static_cast<std::uint32_t>(data[i + 1]) << 16 |
                                   static_cast<std::uint32_t>(data[i + 2]) << 8 | data[i + 3];
        const bool wide = word >> 27 >= 0x1D;
        const timing::Decoded decoded =
            timing::decode(wide ? word : word >> 16, wide ? 4 : 2, block.condition(), block.inside());
        const timing::Decoded again =
            timing::decode(wide ? word : word >> 16, wide ? 4 : 2, block.condition(), block.inside());
        fuzz::expect(decoded.kind == again.kind);
        if (block.inside()) {
            block.advance();
        } else if (!wide && (word >> 24) == 0xBF && ((word >> 16) & 0xF) != 0) {
            block.begin(word >> 16);
        }
    }
    return 0;
}
