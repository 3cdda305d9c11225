#include "reference/dropped.hpp"

#include <algorithm>
#include <utility>

namespace reference {
namespace {

// The near weights of order v - 1 over increments: v - 1 exactly, which a design cannot always hold.
std::vector<Real> increment_weights(const glsum::Design& design) {
    return weights(design, Real(design.order) - 1, design.taps - 2 * design.modes.size());
}

Real value_of(const Exact& sum) { return Real(sum.high) + sum.low; }

// The sum of order v - 1 over increments is that over x, less that of a sample before.
Sums less_the_one_before(const Sums& inner) {
    Sums result;
    result.reserve(inner.size());
    for (std::size_t k = 0; k < inner.size(); ++k) {
        result.emplace_back(k == 0 ? value_of(inner[k]) : Real(value_of(inner[k]) - value_of(inner[k - 1])));
    }
    return result;
}

Sums with_guess(Dropped dropped, const Sums& window, std::span<const Real> a, std::size_t taps,
                std::span<const double> record) {
    Sums result;
    result.reserve(record.size());
    Real tail = 0;     // sum_{j=L..k} a_j
    Real moments = 0;  // sum_{j=L..k} a_j (j-L+1)
    for (std::size_t k = 0; k < record.size(); ++k) {
        Real sum = value_of(window[k]);
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
    if (dropped == Dropped::increments) {
        return less_the_one_before(sums_of(increment_weights(design), design.modes, record));
    }
    const std::size_t taps[] = {design.taps};
    const std::vector<Sums> ended = sums(weights(Real(design.order), record.size()), record, taps);
    return std::move(sums_of_windows(dropped, design.order, record, taps, ended).front());
}

std::vector<Sums> sums_of_windows(Dropped dropped, double order, std::span<const double> record,
                                  std::span<const std::size_t> lengths, std::span<const Sums> ended) {
    std::vector<Sums> result;
    if (dropped == Dropped::zero) {
        result.assign(ended.begin(), ended.end());
    } else if (dropped == Dropped::increments) {
        for (const Sums& inner : sums(weights(Real(order) - 1, record.size()), record, lengths)) {
            result.push_back(less_the_one_before(inner));
        }
    } else {
        const std::vector<Real> a = weights(Real(order), record.size());
        for (std::size_t i = 0; i < lengths.size(); ++i) {
            result.push_back(with_guess(dropped, ended[i], a, lengths[i], record));
        }
    }
    return result;
}

}  // namespace reference
