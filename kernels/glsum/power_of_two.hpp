// 2^exponent, exactly, without the mathematical library.
#pragma once

#include <bit>
#include <cstdint>

namespace glsum {

/// \param exponent  in [-1022, 1023]
[[nodiscard]] constexpr double power_of_two(int exponent) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
}

}  // namespace glsum
