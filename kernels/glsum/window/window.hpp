// What a history gives to a technique: the past samples x_(k-1), x_(k-2), ..., newest first, in at most two
// contiguous pieces. The newest sample x_k is not among them: it is still in a register.
#pragma once

#include <cstddef>
#include <cstdint>

#include "glsum/c99.hpp"
#include "glsum/family.hpp"

namespace glsum {

inline constexpr Family window_family{"window", "a window of the newest samples"};

template <class T>
struct Window {
    const T* newer;
    std::size_t newer_count;
    const T* older;
    std::size_t older_count;
    std::size_t first_index;  ///< where `newer` begins in its buffer
};

/// Where the newest of `past` samples of a ring goes when the one before lies at `head`: down, so that rising addresses
/// run from new to old, as the coefficients do.
// C99: next_head
[[nodiscard]] constexpr std::uint32_t next_head(std::uint32_t head, std::size_t past) {
    return (head == 0 ? static_cast<std::uint32_t>(past) : head) - 1;
}
// C99 end

}  // namespace glsum
