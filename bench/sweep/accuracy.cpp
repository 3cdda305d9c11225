#include "bench/sweep/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "bench/sweep/derivative_limits.hpp"
#include "bench/sweep/designs.hpp"
#include "bench/sweep/exact_weights.hpp"
#include "bench/sweep/host_line.hpp"
#include "bench/sweep/signals.hpp"
#include "glsum/registry.hpp"
#include "reference/dropped.hpp"
#include "reference/sums.hpp"

namespace bench {
namespace {

// The amplitude sweep: one length, one smooth and one measured signal.
constexpr std::size_t amplitude_taps = 600;
constexpr std::string_view amplitude_signals[] = {"sine5", "drive"};

// One order and one signal: the reference is made once and every kernel and length is held against it.
struct Case {
    double order;
    Discretisation weights;
    std::string signal;
    std::vector<double> record;
    std::vector<std::size_t> windows;     // lengths, full memory last
    std::vector<reference::Sums> exact;   // of each of them
    double peak = 0.0;                    // max_k |E_k|
    std::vector<DerivativeLimit> limits;  // none of a signal without a formula
    LimitError discretisation;            // of the exact sum
    // Of those that do not end with their window: of each length with a window, of each design without one.
    std::map<reference::Dropped, std::vector<reference::Sums>> of_windows;
    std::map<std::pair<reference::Dropped, std::string>, reference::Sums> of_designs;

    Case(const Sweep& sweep, double v, const std::string& name)
        : order(v), weights(sweep.weights), signal(name), record(make_signal(name, sweep.samples, sweep.seed)) {
        for (const Length& length : sweep.lengths) {
            if (length.window()) {
                windows.push_back(length.taps);
            }
        }
        windows.push_back(sweep.samples);
        exact = reference::sums(exact_weights(weights, reference::Real(order), sweep.samples), record, windows);
        for (const auto& sum : exact.back()) {
            peak = std::max(peak, std::fabs(sum.high));
        }
        limits = derivative_limits(name, sweep.samples, order, weights);
        discretisation =
            error_at(limits, [&](const DerivativeLimit& at) { return exact.back()[at.sample].error_of(at.value); });
    }

    /// The exact sums of what a kernel's design stands for.
    const reference::Sums& exact_of(reference::Dropped dropped, const Length& length, const glsum::Design& design) {
        if (length.window() && length.taps >= record.size()) {
            return exact.back();
        }
        // Increments of named weights have no order to take these from: their design has them.
        if (length.window() && (dropped == reference::Dropped::zero || !names_weights(weights))) {
            auto& sums = dropped == reference::Dropped::zero ? exact : of_windows[dropped];
            if (sums.empty()) {
                sums = reference::sums_of_windows(dropped, order, record, windows, exact);
            }
            return sums.at(static_cast<std::size_t>(std::ranges::find(windows, length.taps) - windows.begin()));
        }
        auto& sums = of_designs[{dropped, named(length, design)}];
        if (sums.empty()) {
            sums = reference::sums_of(dropped, design, record);
        }
        return sums;
    }
};

double largest_difference(const reference::Sums& one, const reference::Sums& other) {
    double largest = 0.0;
    for (std::size_t k = 0; k < one.size(); ++k) {
        largest = std::max(largest, std::fabs(other[k].error_of(one[k].high) + one[k].low));
    }
    return largest;
}

// What a kernel made of a record, and what it needs. All that depends on its type: the rest is compiled once.
struct Run {
    glsum::Status status;
    std::vector<double> sums;
    std::optional<std::uint32_t> saturations;
    std::size_t effective_taps;
    std::size_t macs;
    std::size_t coefficient_bytes;
    std::size_t state_bytes;
};

template <class K>
Run run(const glsum::Design& design, const std::vector<double>& record, double amplitude) {
    HostLine<K> line(design);
    Run found{line.status(), {}, {}, 0, 0, 0, 0};
    if (found.status != glsum::Status::ok) {
        return found;
    }
    found.sums.reserve(record.size());
    for (const double sample : record) {
        // Powers of two: the scaled record and its exact sums are exact too.
        found.sums.push_back(line.step_real(amplitude * sample) / amplitude);
    }
    if constexpr (K::FormatPart::fixed_point) {
        found.saturations = line.state().scale.saturations;
    }
    found.effective_taps = line.effective_taps();
    found.macs = K::multiplications(design.taps);
    found.coefficient_bytes = line.coefficient_bytes();
    found.state_bytes = line.state_bytes();
    return found;
}

struct Kernel {
    std::string name;
    reference::Dropped dropped;
    Run (*run)(const glsum::Design& design, const std::vector<double>& record, double amplitude);
};

// Of the registry, in its order: all but `null`, which sums nothing.
std::vector<Kernel> kernels() {
    std::vector<Kernel> all;
    glsum::Registry::for_each([&]<class K>() {
        if constexpr (!std::is_same_v<K, glsum::Null>) {
            all.push_back({std::string(K::name()), glsum::forgotten_by<typename K::HistoryPart>(), run<K>});
        }
    });
    return all;
}

Json measure(const Case& test, const Kernel& kernel, const Length& length, const glsum::Design& design,
             const reference::Sums& same_length, double amplitude) {
    RowKey key = row_key(kernel.name, test.order, length, RowKey::accuracy);
    key.signal = test.signal;
    if (amplitude != 1.0) {
        key.amplitude = fmt::format("{}", amplitude);
    }
    Row row(key, test.record.size());
    const Run found = kernel.run(design, test.record, amplitude);
    if (found.status != glsum::Status::ok) {
        row.mark_error(to_text(found.status));
        return std::move(row).take();
    }
    const reference::Sums& full = test.exact.back();
    double largest = 0.0;
    double squares = 0.0;
    double rounding = 0.0;
    for (std::size_t k = 0; k < test.record.size(); ++k) {
        const double error = full[k].error_of(found.sums[k]);
        largest = std::max(largest, std::fabs(error));
        squares += error * error;
        rounding = std::max(rounding, std::fabs(same_length[k].error_of(found.sums[k])));
    }
    const double rms = std::sqrt(squares / static_cast<double>(test.record.size()));
    if (!(test.peak > 0.0) || !std::isfinite(largest) || !std::isfinite(rms)) {
        row.mark_error("the sum or its reference is not a finite number above 0");
        return std::move(row).take();
    }
    row.set(Counter::error_max, largest / test.peak);
    row.set(Counter::error_rms, rms / test.peak);
    row.set(Counter::rounding_error_max, rounding / test.peak);
    row.set(Counter::truncation_error_max, largest_difference(same_length, full) / test.peak);
    if (!test.limits.empty()) {
        row.set(Counter::discretisation_error_max, test.discretisation.largest / test.peak);
        row.set(Counter::discretisation_error_late_max, test.discretisation.late / test.peak);
        const LimitError error =
            error_at(test.limits, [&](const DerivativeLimit& at) { return found.sums[at.sample] - at.value; });
        row.set(Counter::derivative_error_max, error.largest / test.peak);
        row.set(Counter::derivative_error_late_max, error.late / test.peak);
    }
    if (found.saturations) {
        row.set(Counter::saturations, *found.saturations);
    }
    if (length.window()) {
        row.set(Counter::effective_taps, found.effective_taps);
    }
    row.set(Counter::horizon_samples,
            length.modes ? test.record.size() : std::min(glsum::reach_of(design), test.record.size()));
    row.set(Counter::macs_per_sample, found.macs);
    row.set(Counter::coefficient_bytes, found.coefficient_bytes);
    row.set(Counter::state_bytes, found.state_bytes);
    return std::move(row).take();
}

}  // namespace

std::vector<std::vector<Json>> measure_accuracy(const Sweep& sweep, const std::vector<std::size_t>& cases) {
    const std::size_t signals = sweep.signals.size();
    std::vector<std::vector<Json>> rows(cases.size());
    const std::vector<Kernel> all = kernels();
    base::Progress progress("accuracy", cases.size());
    base::parallel_for(cases.size(), sweep.jobs, [&](std::size_t i) {
        Case test(sweep, sweep.orders.at(cases[i] / signals), sweep.signals[cases[i] % signals]);
        for (const Kernel& kernel : all) {
            if (std::find(sweep.kernels.begin(), sweep.kernels.end(), kernel.name) == sweep.kernels.end()) {
                continue;
            }
            for (const Length& length : lengths_of(sweep, kernel.name, test.order)) {
                const glsum::Design design =
                    design_of(kernel.name, test.order, length, test.record.size(), test.weights);
                const reference::Sums& exact = test.exact_of(kernel.dropped, length, design);
                rows[i].push_back(measure(test, kernel, length, design, exact, 1.0));
                if (length.taps == amplitude_taps && length.window() &&
                    std::find(std::begin(amplitude_signals), std::end(amplitude_signals), test.signal) !=
                        std::end(amplitude_signals)) {
                    for (const double amplitude : {0x1p-4, 0x1p-8}) {
                        rows[i].push_back(measure(test, kernel, length, design, exact, amplitude));
                    }
                }
            }
        }
        progress.advance();
    });
    return rows;
}

}  // namespace bench
