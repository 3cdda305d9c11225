#include "bench/gate/host_time.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace bench::gate {
namespace {

constexpr std::size_t resamples = 4000;

// The lower quartile, between two values in proportion. What disturbs a time only makes it longer: the quartile stays
// while less than three quarters of the repetitions are disturbed, where a median follows half of them; and unlike the
// minimum it does not hang on one lucky draw.
double lower_quartile(std::vector<double>& values) {
    const double place = 0.25 * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(below);
    std::nth_element(values.begin(), at, values.end());
    const double low = *at;
    const double share = place - static_cast<double>(below);
    return share > 0.0 ? low + share * (*std::min_element(at + 1, values.end()) - low) : low;
}

double log_ratio(std::vector<double>& kernel, std::vector<double>& anchor) {
    return std::log(lower_quartile(kernel) / lower_quartile(anchor));
}

double log_ratio_of(const Timing& timing) {
    std::vector<double> kernel = timing.kernel;
    std::vector<double> anchor = timing.anchor;
    return log_ratio(kernel, anchor);
}

// The ratio of one redrawn run. Kernel and anchor are drawn at the same places: what disturbed both stays with both.
double resample(const Timing& timing, std::mt19937_64& generator, std::vector<double>& kernel,
                std::vector<double>& anchor) {
    const std::size_t count = std::min(timing.kernel.size(), timing.anchor.size());
    kernel.resize(count);
    anchor.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = generator() % count;
        kernel[i] = timing.kernel[at];
        anchor[i] = timing.anchor[at];
    }
    return log_ratio(kernel, anchor);
}

}  // namespace

TimeChange time_change(const Timing& baseline, const Timing& current, double confidence) {
    std::mt19937_64 generator(2020);
    std::vector<double> kernel;
    std::vector<double> anchor;
    std::vector<double> changes(resamples);
    for (double& change : changes) {
        change = -resample(baseline, generator, kernel, anchor);
        change += resample(current, generator, kernel, anchor);
    }
    std::sort(changes.begin(), changes.end());
    const auto at = [&](double share) {
        return std::expm1(changes[static_cast<std::size_t>(share * static_cast<double>(resamples - 1))]);
    };
    return {std::expm1(log_ratio_of(current) - log_ratio_of(baseline)), at(1.0 - confidence), at(confidence)};
}

}  // namespace bench::gate
