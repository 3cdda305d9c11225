#include "gap/drive/white_noise.hpp"

#include <algorithm>
#include <cmath>

namespace gap {

double noise_by_differences(std::vector<double> sizes, std::size_t order) {
    if (sizes.empty()) {
        return 0.0;
    }
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    double binomial = 1.0;
    for (std::size_t k = 1; k <= order; ++k) {
        binomial *= static_cast<double>(order + k) / static_cast<double>(k);
    }
    return *middle / (0.6745 * std::sqrt(binomial));
}

}  // namespace gap
