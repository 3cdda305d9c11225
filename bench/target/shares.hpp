// Pieces of work of unequal cost in balanced shares, for workers that each start once and take a whole one.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace bench {

/// The pieces 0, 1, ... in `shares` shares of about equal cost: the costliest first, each to the share that has
/// least so far. Each share's pieces rise; shares without a piece are left out.
[[nodiscard]] std::vector<std::vector<std::size_t>> balanced_shares(std::span<const double> costs, std::size_t shares);

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
