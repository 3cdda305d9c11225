// The hash by which host and target prove to each other that they computed the same bits.
#pragma once

#include <bit>
#include <cstdint>

namespace firmware {

/// FNV-1a, 64 bits, over the bytes of each output, the lowest first.
class OutputHash {
public:
    template <class Output>
    void add(Output output) {
        static_assert(sizeof(Output) == 4 || sizeof(Output) == 8);
        if constexpr (sizeof(Output) == 4) {
            add_bytes(std::bit_cast<std::uint32_t>(output), 4);
        } else {
            add_bytes(std::bit_cast<std::uint64_t>(output), 8);
        }
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

private:
    void add_bytes(std::uint64_t bits, int count) {
        for (int i = 0; i < count; ++i) {
            value_ = (value_ ^ ((bits >> (8 * i)) & 0xFFU)) * 0x100000001B3U;
        }
    }
    std::uint64_t value_ = 0xCBF29CE484222325U;
};

}  // namespace firmware
