#include "bench/target/shares.hpp"

#include <algorithm>
#include <numeric>

namespace bench {

std::vector<std::vector<std::size_t>> balanced_shares(std::span<const double> costs, std::size_t shares) {
    std::vector<std::size_t> pieces(costs.size());
    std::iota(pieces.begin(), pieces.end(), std::size_t{0});
    std::stable_sort(pieces.begin(), pieces.end(), [&](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
    std::vector<std::vector<std::size_t>> balanced(std::min(shares, costs.size()));
    std::vector<double> load(balanced.size());
    for (const std::size_t piece : pieces) {
        const auto least = static_cast<std::size_t>(std::min_element(load.begin(), load.end()) - load.begin());
        load[least] += costs[piece];
        balanced[least].push_back(piece);
    }
    std::erase_if(balanced, [](const auto& share) { return share.empty(); });
    for (auto& share : balanced) {
        std::sort(share.begin(), share.end());
    }
    return balanced;
}

}  // namespace bench
