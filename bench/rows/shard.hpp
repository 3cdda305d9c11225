// Which part of a sweep a run measures.
#pragma once

#include <cstddef>
#include <string>

namespace bench {

/// One of `count` runs that together measure a sweep.
struct Shard {
    std::size_t index = 1;  ///< from 1
    std::size_t count = 1;
    static constexpr std::size_t most = 10'000;
};

/// "2/3". \throws glsum::Failure (bad input) unless 1 <= I <= N <= Shard::most.
[[nodiscard]] Shard parse_shard(const std::string& text);

}  // namespace bench
