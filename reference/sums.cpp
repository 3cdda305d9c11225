#include "reference/sums.hpp"

#include <algorithm>

namespace reference {
std::vector<Real> weights(const Real& order, std::size_t count) {
    std::vector<Real> a;
    a.reserve(count);
    for (std::size_t j = 0; j < count; ++j) {
        a.push_back(j == 0 ? Real(1) : a.back() * (1 - (1 + order) / Real(j)));
    }
    return a;
}

std::vector<Real> weights(const glsum::Design& design, std::size_t count) {
    return weights(design, Real(design.order), count);
}

std::vector<Real> weights(const glsum::Design& design, const Real& order, std::size_t count) {
    std::vector<Real> a = weights(order, count);
    for (std::size_t j = 1; j < a.size() && j <= design.weights.size(); ++j) {
        a[j] = design.weights[j - 1];
    }
    return a;
}

std::vector<Sums> sums(std::span<const Real> a, std::span<const double> record, std::span<const std::size_t> lengths) {
    const std::vector<Real> x(record.begin(), record.end());
    std::vector<Sums> result(lengths.size());
    for (auto& of_length : result) {
        of_length.reserve(record.size());
    }
    for (std::size_t k = 0; k < x.size(); ++k) {
        Real total = 0;
        std::size_t j = 0;
        for (std::size_t i = 0; i < lengths.size(); ++i) {
            for (const std::size_t end = std::min(lengths[i], k + 1); j < end; ++j) {
                add_product(total, a[j], x[k - j]);
            }
            result[i].emplace_back(total);
        }
    }
    return result;
}

Real sum(std::span<const Real> a, std::span<const double> newest_first) {
    Real total = 0;
    for (std::size_t j = 0; j < std::min(a.size(), newest_first.size()); ++j) {
        add_product(total, a[j], Real(newest_first[j]));
    }
    return total;
}

}  // namespace reference
