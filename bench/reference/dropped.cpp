#include "bench/reference/dropped.hpp"

#include <algorithm>

namespace reference {
namespace {

// The near weights of order v - 1 over increments: v - 1 exactly, which a design cannot always hold.
std::vector<Real> increment_weights(const glsum::Design& design) {
    return weights(design, Real(design.order) - 1, design.taps - 2 * design.modes.size());
}

}  // namespace

std::vector<Real> weights_of(Dropped dropped, const glsum::Design& design, std::size_t samples) {
    if (dropped == Dropped::zero) {
        return weights_of(design, samples);
    }
    if (dropped == Dropped::increments) {
        std::vector<Real> all = weights_of(increment_weights(design), design.modes, samples);
        for (std::size_t j = samples; j > 1; --j) {
            all[j - 1] -= all[j - 2];
        }
        return all;
    }
    const std::size_t taps = design.taps;
    std::vector<Real> all = weights(Real(design.order), samples);
    if (samples <= taps) {
        return all;
    }
    const std::size_t k = samples - 1;
    Real tail = 0;
    Real first = 0;
    for (std::size_t j = taps; j <= k; ++j) {
        tail += all[j];
        first += all[j] * Real(j - taps + 1) / Real(k - taps + 1);
        all[j] = 0;
    }
    if (dropped == Dropped::held) {
        first = 0;
    }
    all[taps - 1] += tail - first;
    all[k] += first;
    return all;
}

Sums sums_of(Dropped dropped, const glsum::Design& design, std::span<const double> record) {
    if (dropped == Dropped::zero) {
        return sums_of(design, record);
    }
    Sums result;
    result.reserve(record.size());
    if (dropped == Dropped::increments) {
        // The sum of order v - 1 over x, less that of a sample before.
        const Sums inner = sums_of(increment_weights(design), design.modes, record);
        for (std::size_t k = 0; k < inner.size(); ++k) {
            Real sum = Real(inner[k].high) + inner[k].low;
            if (k > 0) {
                sum -= Real(inner[k - 1].high) + inner[k - 1].low;
            }
            result.emplace_back(sum);
        }
        return result;
    }
    const std::size_t taps = design.taps;
    const std::vector<Real> a = weights(Real(design.order), record.size());
    const std::size_t reach[] = {taps};
    const Sums window = sums(a, record, reach).front();
    Real tail = 0;     // sum_{j=L..k} a_j
    Real moments = 0;  // sum_{j=L..k} a_j (j-L+1)
    for (std::size_t k = 0; k < record.size(); ++k) {
        Real sum = Real(window[k].high) + window[k].low;
        if (k >= taps) {
            const Real guessed = k - taps + 1;
            tail += a[k];
            moments += a[k] * guessed;
            const Real first = dropped == Dropped::line ? Real(moments / guessed) : Real(0);
            sum += (tail - first) * Real(record[k - taps + 1]) + first * Real(record[0]);
        }
        result.emplace_back(sum);
    }
    return result;
}

}  // namespace reference
