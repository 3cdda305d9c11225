#include "reference/modes.hpp"

#include <algorithm>

#include "reference/blocks.hpp"

namespace reference {

std::vector<Real> weights_of(std::span<const Real> near, std::span<const glsum::Mode> modes, std::size_t count) {
    std::vector<Real> all(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(std::min(near.size(), count)));
    all.resize(count, Real(0));
    for (const glsum::Mode& mode : modes) {
        Real term = mode.weight;
        for (std::size_t j = near.size(); j < count; ++j) {
            all[j] += term;
            term *= 1 - Real(mode.decay);
        }
    }
    return all;
}

Sums sums_of(std::span<const Real> near, std::span<const glsum::Mode> modes, std::span<const double> record) {
    const std::size_t near_taps = near.size();
    const std::vector<Real> x(record.begin(), record.end());
    std::vector<Real> ratios;
    std::vector<Real> first_weights;
    for (const glsum::Mode& mode : modes) {
        ratios.push_back(1 - Real(mode.decay));
        first_weights.emplace_back(mode.weight);
    }
    std::vector<Real> tails(modes.size(), Real(0));
    Sums result;
    result.reserve(record.size());
    for (std::size_t k = 0; k < record.size(); ++k) {
        Real total = 0;
        for (std::size_t j = 0; j < std::min(near_taps, k + 1); ++j) {
            add_product(total, near[j], x[k - j]);
        }
        for (std::size_t m = 0; m < tails.size(); ++m) {
            tails[m] *= ratios[m];
            if (k >= near_taps) {
                add_product(tails[m], first_weights[m], x[k - near_taps]);
            }
            total += tails[m];
        }
        result.emplace_back(total);
    }
    return result;
}

std::vector<Real> weights_of(const glsum::Design& design, std::size_t count) {
    if (design.blocks.count > 0) {
        return block_weights(design, count);
    }
    return weights_of(weights(design, design.taps - 2 * design.modes.size()), design.modes, count);
}

Sums sums_of(const glsum::Design& design, std::span<const double> record) {
    if (design.blocks.count > 0) {
        return block_sums(design, record);
    }
    return sums_of(weights(design, design.taps - 2 * design.modes.size()), design.modes, record);
}

}  // namespace reference
