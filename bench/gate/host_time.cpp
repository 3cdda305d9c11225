#include "bench/gate/host_time.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace bench::gate {
namespace {

constexpr std::size_t resamples = 2000;

// The mean of the fastest hundredth (one part of `parts`), two at least. What disturbs a time only makes it longer, and
// on a busy machine may do so to nine repetitions of ten: a neighbour on the same core that multiplies costs some
// kernels two thirds and others nothing, so that no quartile and no ratio is safe. A few quiet moments are nearly
// always left.
double fastest(std::vector<double>& values, std::size_t parts = 100) {
    const std::size_t count = std::max<std::size_t>(2, values.size() / parts);
    const auto end = values.begin() + static_cast<std::ptrdiff_t>(std::min(count, values.size()));
    std::partial_sort(values.begin(), end, values.end());
    return std::accumulate(values.begin(), end, 0.0) / static_cast<double>(end - values.begin());
}

double log_ratio(std::vector<double>& kernel, std::vector<double>& anchor) {
    return std::log(fastest(kernel) / fastest(anchor));
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

double movement(const Timing& baseline, const Timing& current) {
    double most = 0.0;
    for (const std::size_t parts : {100, 20}) {
        double change = 0.0;
        for (const Timing& timing : {current, baseline}) {
            std::vector<double> kernel = timing.kernel;
            std::vector<double> anchor = timing.anchor;
            change = std::log(fastest(kernel, parts) / fastest(anchor, parts)) - change;
        }
        most = std::max(most, std::expm1(std::fabs(change)));
    }
    return most;
}

}  // namespace bench::gate
