#include "bench/choose/records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/failure.hpp"
#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "bench/sweep/signals.hpp"
#include "glsum/weights.hpp"
#include "reference/full_sums.hpp"

namespace choose {
namespace {

// The tails sum_{j >= L} a_j x_(k-j), of every length in one pass. In double: they only say where to measure.
std::vector<double> truncation(const std::vector<double>& x, double order, double peak) {
    std::vector<double> a(x.size(), 1.0);
    glsum::Weights weights(order);
    for (std::size_t j = 1; j < a.size(); ++j) {
        weights.next();
        a[j] = weights.weight();
    }
    std::vector<double> largest(x.size(), 0.0);
    for (std::size_t k = 0; k < x.size(); ++k) {
        double tail = 0.0;
        for (std::size_t j = k; j > 0; --j) {
            tail += a[j] * x[k - j];
            largest[j - 1] = std::max(largest[j - 1], std::fabs(tail));
        }
    }
    for (double& of_length : largest) {
        of_length /= peak;
    }
    return largest;
}

}  // namespace

std::vector<Record> make_records(const Conditions& conditions, unsigned jobs) {
    const auto a = reference::weights(reference::Real(conditions.order), conditions.samples);
    std::vector<Record> records(conditions.signals.size());
    base::Progress progress("exact sums", records.size());
    base::parallel_for(records.size(), jobs, [&](std::size_t i) {
        Record& record = records[i];
        record.signal = conditions.signals[i];
        record.samples = bench::make_signal(record.signal, conditions.samples, conditions.seed, conditions.step_s);
        record.exact = reference::full_sums(a, record.samples);
        record.peak = 0.0;
        for (const auto& sum : record.exact) {
            record.peak = std::max(record.peak, std::fabs(sum.high));
        }
        if (!(record.peak > 0.0)) {
            throw glsum::Failure(glsum::Exit::bad_input,
                                 fmt::format("signal {}: all its sums are zero: no relative error", record.signal));
        }
        record.truncation = truncation(record.samples, conditions.order, record.peak);
        progress.advance();
    });
    return records;
}

}  // namespace choose
