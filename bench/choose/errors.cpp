#include "bench/choose/errors.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <type_traits>

#include "bench/rows/row.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/host_line.hpp"
#include "bench/sweep/signals.hpp"
#include "bench/sweep/with_kernel.hpp"
#include "glsum/bound.hpp"
#include "glsum/design/modes.hpp"

namespace choose {
namespace {

struct Run {
    double error;  // of the samples up to the first beyond the limit
    bool whole;
    glsum::Status status;
};

template <class K>
Run run(const glsum::Design& design, const Record& record, double limit) {
    bench::HostLine<K> line(design);
    if (line.status() != glsum::Status::ok) {
        return {0.0, false, line.status()};
    }
    // Divided by the peak last, as bench does it: the same bits as its rows.
    double largest = 0.0;
    for (std::size_t k = 0; k < record.samples.size(); ++k) {
        const double error = std::fabs(record.exact[k].error_of(line.step_real(record.samples[k])));
        if (!std::isfinite(error)) {
            return {std::numeric_limits<double>::infinity(), true, glsum::Status::ok};
        }
        if (error > largest) {
            largest = error;
            if (largest / record.peak > limit) {
                return {largest / record.peak, false, glsum::Status::ok};
            }
        }
    }
    return {largest / record.peak, true, glsum::Status::ok};
}

}  // namespace

std::vector<std::size_t> turns_of(const ErrorSource& errors, const std::vector<std::string>& kernels) {
    std::map<std::string, std::size_t> seen;
    std::multimap<std::size_t, std::size_t> by_place;
    for (std::size_t i = 0; i < kernels.size(); ++i) {
        by_place.emplace(seen[errors.group(kernels[i])]++, i);
    }
    std::vector<std::size_t> turns;
    for (const auto& [place, kernel] : by_place) {
        turns.push_back(kernel);
    }
    return turns;
}

MeasuredErrors::MeasuredErrors(double order, std::vector<Record> records)
    : order_(order), records_(std::move(records)), truncation_(records_.at(0).samples.size(), 0.0) {
    for (const Record& record : records_) {
        std::transform(truncation_.begin(), truncation_.end(), record.truncation.begin(), truncation_.begin(),
                       [](double one, double other) { return std::max(one, other); });
    }
}

std::optional<std::vector<std::size_t>> MeasuredErrors::lengths(const std::string& kernel) const {
    if (bench::truncates(kernel)) {
        return std::nullopt;
    }
    if (bench::has_modes(kernel)) {
        const double of_weights = bench::order_of_weights(kernel, order_);
        std::vector<std::size_t> all(std::min(longest(), glsum::design::most_taps(of_weights)));
        std::iota(all.begin(), all.end(), std::size_t{1});
        return all;
    }
    // Truncation does not say how long a kernel must be that takes what it drops for more than 0, or keeps it as
    // blocks.
    constexpr std::size_t one_by_one = 128;
    std::vector<std::size_t> rungs = {1};
    while (rungs.back() < longest()) {
        const std::size_t taps = rungs.back();
        rungs.push_back(std::min(longest(), taps + (taps < one_by_one ? 1 : taps / 8)));
    }
    return rungs;
}

glsum::Design MeasuredErrors::design_of(const std::string& kernel, std::size_t taps) const {
    return bench::design_of(kernel, order_, bench::length_of(kernel, order_, taps, longest()), longest());
}

void MeasuredErrors::remember(const std::string& kernel, std::size_t taps, const std::string& signal, double error) {
    for (std::size_t i = 0; i < records_.size(); ++i) {
        if (records_[i].signal == signal) {
            auto& errors = given_[{kernel, taps}];
            errors.resize(records_.size(), -1.0);
            errors[i] = error;
        }
    }
}

double MeasuredErrors::rounding_bound(const std::string& kernel, std::size_t taps) const {
    double least_peak = std::numeric_limits<double>::infinity();
    for (const Record& record : records_) {
        least_peak = std::min(least_peak, record.peak);
    }
    double bound = std::numeric_limits<double>::infinity();
    bench::with_kernel(kernel, [&]<class K>() {
        if constexpr (!std::is_same_v<K, glsum::Null>) {  // which promises nothing
            const glsum::Design design = design_of(kernel, taps);
            bench::HostLine<K> line(design);
            if (line.status() == glsum::Status::ok) {
                bound = glsum::error_bound<K>(design, line.state(), bench::signal_peak, longest()) / least_peak;
            }
        }
    });
    return bound;
}

MeasuredErrors::Known MeasuredErrors::of_signal(const std::string& kernel, std::size_t taps, std::size_t signal,
                                                double limit, std::string& fault) {
    const std::pair key(kernel, taps);
    {
        const std::lock_guard lock(mutex_);
        auto& known = known_[key];
        if (known.empty()) {
            known.assign(records_.size(), {-1.0, false});
            if (const auto given = given_.find(key); given != given_.end()) {
                for (std::size_t i = 0; i < known.size(); ++i) {
                    known[i] = {given->second[i], given->second[i] >= 0.0};
                    remembered_ += known[i].whole ? 1 : 0;
                }
            }
        }
        if (known[signal].whole || known[signal].error > limit) {
            return known[signal];
        }
        ++measured_;
    }
    Run found{};
    const glsum::Design design = design_of(kernel, taps);
    bench::with_kernel(kernel, [&]<class K>() { found = run<K>(design, records_[signal], limit); });
    if (found.status != glsum::Status::ok) {
        fault = bench::to_text(found.status);
        return {std::numeric_limits<double>::infinity(), true};
    }
    const std::lock_guard lock(mutex_);
    return known_[key][signal] = {found.error, found.whole};
}

ErrorAt MeasuredErrors::error(const std::string& kernel, std::size_t taps) {
    ErrorAt worst{.error = -1.0, .signal = {}, .fault = {}};
    for (std::size_t i = 0; i < records_.size(); ++i) {
        const Known known = of_signal(kernel, taps, i, std::numeric_limits<double>::infinity(), worst.fault);
        if (known.error > worst.error) {
            worst.error = known.error;
            worst.signal = records_[i].signal;
        }
        if (!worst.fault.empty()) {
            break;
        }
    }
    if (worst.fault.empty() && !std::isfinite(worst.error)) {
        worst.fault = "the sum is not a finite number";
    }
    return worst;
}

bool MeasuredErrors::meets(const std::string& kernel, std::size_t taps, double limit) {
    // The signal that truncation hits hardest is likeliest to fail, and a failure ends the question.
    std::vector<std::size_t> order(records_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return records_[a].truncation[taps - 1] > records_[b].truncation[taps - 1];
    });
    std::string fault;
    return std::all_of(order.begin(), order.end(), [&](std::size_t signal) {
        const Known known = of_signal(kernel, taps, signal, limit, fault);
        return known.whole && known.error <= limit;
    });
}

}  // namespace choose
