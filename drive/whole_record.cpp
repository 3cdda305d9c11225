#include "drive/whole_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/failure.hpp"
#include "drive/real_transform.hpp"
#include "glsum/weights.hpp"

namespace drive {

std::vector<double> record_weights(double order, std::size_t count) {
    std::vector<double> table;
    table.reserve(count);
    for (glsum::Weights weights(order); table.size() < count; weights.next()) {
        table.push_back(weights.weight());
    }
    return table;
}
namespace {

constexpr std::size_t near_weights = 16;   // never in a transform
constexpr std::size_t no_transform = 128;  // up to so many weights summing directly is faster than any transform
constexpr std::size_t tile = 8;            // sums at once: enough for the adders to be busy
constexpr double unit_roundoff = 0x1.0p-53;

void check_finite(std::span<const double> numbers, const char* what) {
    const auto odd =
        std::find_if_not(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
    if (odd != numbers.end()) {
        throw glsum::Failure(glsum::Exit::bad_input, fmt::format("{} {}: expected a finite number, found {}", what,
                                                                 odd - numbers.begin(), *odd));
    }
}

// How a table is parted for a record: so many weights directly, the others by a transform of that length.
struct Parted {
    std::span<const double> near;
    std::span<const double> far;
    std::size_t length = 0;
};

Parted part(std::span<const double> weights, std::size_t samples) {
    weights = weights.first(std::min(weights.size(), samples));
    if (weights.size() <= no_transform) {
        return {weights, {}, 0};
    }
    const std::span<const double> far = weights.subspan(near_weights);
    // As long as the whole convolution: what comes round from its end would else fall on its first sums.
    return {weights.first(near_weights), far, RealTransform::fast_length(samples - near_weights + far.size() - 1)};
}

// sums[k] += sum_j weights[j] record[k - j], oldest first; the same bits however the sums are tiled.
void add_near(std::span<const double> weights, std::span<const double> record, std::span<double> sums) {
    const double* const w = weights.data();
    const auto add_one = [&](std::size_t k) {
        double sum = sums[k];
        for (std::size_t j = std::min(weights.size(), k + 1); j-- > 0;) {
            sum += w[j] * record[k - j];
        }
        sums[k] = sum;
    };
    std::size_t k = 0;
    for (const std::size_t begin = std::min(weights.size(), record.size()); k < begin; ++k) {
        add_one(k);
    }
    for (; k + tile <= record.size(); k += tile) {
        std::array<double, tile> sum;
        std::copy_n(sums.data() + k, tile, sum.begin());
        const double* x = record.data() + k + 1 - weights.size();
        for (std::size_t j = weights.size(); j-- > 0; ++x) {
            for (std::size_t i = 0; i < tile; ++i) {
                sum[i] += w[j] * x[i];
            }
        }
        std::copy_n(sum.begin(), tile, sums.data() + k);
    }
    for (; k < record.size(); ++k) {
        add_one(k);
    }
}

double largest(std::span<const double> numbers) {
    double peak = 0.0;
    for (const double number : numbers) {
        peak = std::max(peak, std::fabs(number));
    }
    return peak;
}

// The 2-norm, without squares that overflow or vanish.
double norm(std::span<const double> numbers) {
    const double peak = largest(numbers);
    double squares = 0.0;
    for (const double number : numbers) {
        squares += peak == 0.0 ? 0.0 : (number / peak) * (number / peak);
    }
    return peak * std::sqrt(squares);
}

}  // namespace

std::vector<double> whole_record_sums(std::span<const double> weights, std::span<const double> record) {
    check_finite(weights, "weight");
    check_finite(record, "sample");
    const Parted parted = part(weights, record.size());
    std::vector<double> sums(record.size(), 0.0);
    if (!parted.far.empty()) {
        const RealTransform& transform = RealTransform::of(parted.length);
        const std::size_t count = record.size() - near_weights;
        RealTransform::Buffer far(parted.length, parted.far);
        RealTransform::Buffer samples(parted.length, record.first(count));
        transform.forward(far);
        transform.forward(samples);
        transform.convolve(samples, far);
        std::copy_n(samples.reals().begin(), count, sums.begin() + near_weights);
    }
    add_near(parted.near, record, sums);
    return sums;
}

double whole_record_error_bound(std::span<const double> weights, std::span<const double> record) {
    const Parted parted = part(weights, record.size());
    const double peak = largest(record);
    double bound = 0.0;
    for (std::size_t j = 0; j < parted.near.size(); ++j) {
        bound += static_cast<double>(j + 2) * std::fabs(parted.near[j]) * peak;
    }
    if (!parted.far.empty()) {
        double magnitude = 0.0;
        for (const double weight : parted.far) {
            magnitude += std::fabs(weight);
        }
        const double reach = norm(parted.far) * norm(record);
        bound += static_cast<double>(near_weights + 1) * std::min(magnitude * peak, reach);
        bound += std::log2(static_cast<double>(parted.length)) * reach;
    }
    return unit_roundoff * bound;
}

}  // namespace drive
