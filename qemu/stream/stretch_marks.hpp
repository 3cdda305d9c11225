// Two instructions without an effect by which a program marks stretches of itself: targets/glsum_mark.h.
#pragma once

#include <cstdint>
#include <optional>

#include "qemu/stream/stream.hpp"

namespace qemu {

/// MOV r10, r10 and MOV r11, r11. [ARMv7-M ARM, A7.7.77, encoding T1]
inline constexpr std::uint16_t stretch_begins = 0x46D2;
inline constexpr std::uint16_t stretch_ends = 0x46DB;

[[nodiscard]] constexpr bool is_stretch_mark(const Instruction& instruction) {
    return instruction.bytes == 2 && (instruction.encoding == stretch_begins || instruction.encoding == stretch_ends);
}

/// A mark that fits no other.
struct MisusedMark {
    std::uint32_t address = 0;
    std::optional<std::uint32_t> open =
        std::nullopt;  ///< a beginning within the stretch that began there; none: an end
    bool operator==(const MisusedMark&) const = default;
};

/// Which stretch is open. One at a time is: they do not nest.
class StretchMarks {
public:
    /// \param mark  is_stretch_mark
    void meet(const Instruction& mark) {
        const bool begins = mark.encoding == stretch_begins;
        if (begins == open_.has_value() && !misused_) {
            misused_ = {mark.address, open_};
        }
        open_ = begins ? std::optional(mark.address) : std::nullopt;
    }
    /// Address of its beginning.
    [[nodiscard]] std::optional<std::uint32_t> open() const { return open_; }
    /// The first.
    [[nodiscard]] const std::optional<MisusedMark>& misused() const { return misused_; }

private:
    std::optional<std::uint32_t> open_;
    std::optional<MisusedMark> misused_;
};

}  // namespace qemu
