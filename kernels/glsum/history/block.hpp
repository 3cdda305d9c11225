// block: every few samples, what the past adds to the next few sums, all at once.
#pragma once

#include <string_view>

namespace glsum {

struct Block {
    static constexpr std::string_view word = "block";
    static constexpr bool contiguous = true;
};

}  // namespace glsum
