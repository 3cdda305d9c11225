#include "bench/truncation_bound.hpp"

#include <algorithm>
#include <cmath>

#include "bench/signals.hpp"
#include "glsum/weights.hpp"

namespace bench {

double dropped_sum(double order, std::size_t taps, std::size_t samples) {
    // Only what is dropped is summed: as the difference of two whole sums it would drown in their rounding.
    double sum = taps == 0 && samples > 0 ? 1.0 : 0.0;
    glsum::Weights weights(order);
    for (std::size_t j = 1; j < samples; ++j) {
        weights.next();
        sum += j >= taps ? std::fabs(weights.weight()) : 0.0;
    }
    return sum;
}

double largest_sum(double order, std::span<const double> record) {
    std::vector<double> sums(record.begin(), record.end());
    glsum::Weights weights(order);
    for (std::size_t j = 1; j < record.size(); ++j) {  // one coefficient at a time: independent sums, which vectorise
        weights.next();
        const double a = weights.weight();
        for (std::size_t k = j; k < record.size(); ++k) {
            sums[k] += a * record[k - j];
        }
    }
    double largest = 0.0;
    for (const double sum : sums) {
        largest = std::max(largest, std::fabs(sum));
    }
    return largest;
}

std::vector<double> truncation_bounds(double order, std::string_view signal, std::span<const std::size_t> lengths,
                                      std::size_t samples, std::uint64_t seed) {
    const std::vector<double> record = make_signal(signal, samples, seed);
    double peak = 0.0;
    for (const double x : record) {
        peak = std::max(peak, std::fabs(x));
    }
    const double scale = (1.0 + 1e-9) * peak / largest_sum(order, record);
    std::vector<double> bounds;
    for (const std::size_t taps : lengths) {
        bounds.push_back(scale * dropped_sum(order, taps, samples));
    }
    return bounds;
}

}  // namespace bench
