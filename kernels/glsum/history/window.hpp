// What a history gives to a technique: the past samples x_(k-1), x_(k-2), ..., newest first, in at most two
// contiguous pieces. The newest sample x_k is not among them: it is still in a register.
#pragma once

#include <cstddef>

namespace glsum {

template <class T>
struct Window {
    const T* newer;
    std::size_t newer_count;
    const T* older;
    std::size_t older_count;
    std::size_t first_index;  ///< where `newer` begins in its buffer
};

}  // namespace glsum
