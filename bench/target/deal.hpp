// Dealing pieces of work of unequal cost to workers that each start once and take a whole share.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace bench {

/// Deals the pieces 0, 1, ... to `shares` shares of about equal cost: the dearest first, each to the share that has
/// least so far. Each share's pieces rise; shares without a piece are left out.
[[nodiscard]] std::vector<std::vector<std::size_t>> deal(std::span<const double> costs, std::size_t shares);

/// What a share names, in the share's order.
template <class T>
[[nodiscard]] std::vector<T> pick(const std::vector<T>& all, const std::vector<std::size_t>& share) {
    std::vector<T> picked;
    for (const std::size_t piece : share) {
        picked.push_back(all[piece]);
    }
    return picked;
}

}  // namespace bench
