#include "bench/reference/modes.hpp"

#include <algorithm>

namespace reference {

std::vector<Real> weights_of(const glsum::Design& design, std::size_t count) {
    const std::size_t near_taps = design.taps - 2 * design.modes.size();
    std::vector<Real> all = weights(Real(design.order), std::min(near_taps, count));
    all.resize(count, Real(0));
    for (const glsum::Mode& mode : design.modes) {
        Real term = mode.weight;
        for (std::size_t j = near_taps; j < count; ++j) {
            all[j] += term;
            term *= 1 - Real(mode.decay);
        }
    }
    return all;
}

Sums sums_of(const glsum::Design& design, std::span<const double> record) {
    const std::size_t near_taps = design.taps - 2 * design.modes.size();
    const std::vector<Real> a = weights(Real(design.order), near_taps);
    std::vector<Real> tails(design.modes.size(), Real(0));
    Sums result;
    result.reserve(record.size());
    for (std::size_t k = 0; k < record.size(); ++k) {
        Real total = 0;
        for (std::size_t j = 0; j < std::min(near_taps, k + 1); ++j) {
            total += a[j] * Real(record[k - j]);
        }
        for (std::size_t m = 0; m < tails.size(); ++m) {
            const glsum::Mode& mode = design.modes[m];
            tails[m] *= 1 - Real(mode.decay);
            if (k >= near_taps) {
                tails[m] += Real(mode.weight) * Real(record[k - near_taps]);
            }
            total += tails[m];
        }
        result.emplace_back(total);
    }
    return result;
}

}  // namespace reference
