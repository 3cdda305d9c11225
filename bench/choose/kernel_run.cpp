#include "bench/choose/kernel_run.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <vector>

#include "bench/rows/row.hpp"
#include "bench/sweep/host_line.hpp"
#include "bench/sweep/with_kernel.hpp"
#include "glsum/bound.hpp"
#include "glsum/design/held.hpp"

namespace choose {
namespace {

namespace design = glsum::design;

// What fixed point can hold of 1; a power of two less, so that scaling is exact.
constexpr double full_scale = 1.0 - 0x1p-12;

glsum::Design design_for(const design::DerivativeGoal& goal, const design::FittedFilter& fitted, std::size_t taps) {
    glsum::Design made{goal.order, taps};
    made.modes = fitted.modes;
    made.weights = fitted.weights;
    return made;
}

// A filter in double, sample by sample: its averages in the leaky form, as kernels have them.
class FilterInDouble {
public:
    explicit FilterInDouble(design::Filter filter)
        : filter_(std::move(filter)), past_(filter_.taps.size(), 0.0), averages_(filter_.modes.size(), 0.0) {}

    double step(double sample) {
        // past_ ends with the newest.
        std::rotate(past_.begin(), past_.begin() + 1, past_.end());
        const double leaving = before_;
        past_.back() = sample;
        before_ = past_.front();
        double sum = 0.0;
        for (std::size_t j = 0; j < past_.size(); ++j) {
            sum += filter_.taps[j] * past_[past_.size() - 1 - j];
        }
        for (std::size_t m = 0; m < averages_.size(); ++m) {
            const design::Mode& mode = filter_.modes[m];
            // s is what the mode has seen, sum (1-d)^(j-K) x_(k-j).
            averages_[m] += leaving - mode.decay * averages_[m];
            sum += mode.weight * averages_[m];
        }
        return sum;
    }

private:
    design::Filter filter_;
    std::vector<double> past_;
    std::vector<double> averages_;
    double before_ = 0.0;  // what leaves the near taps with the next sample
};

design::Filter scaled(design::Filter filter, double factor) {
    for (double& tap : filter.taps) {
        tap *= factor;
    }
    for (design::Mode& mode : filter.modes) {
        mode.weight *= factor;
    }
    return filter;
}

template <class K>
void run_noise(bench::HostLine<K>& line, const design::DerivativeGoal& goal, double factor, Held& found) {
    // visit(k, difference) behind each sample.
    const auto compare = [&](std::size_t samples, const auto& signal, const auto& visit) {
        K::reset(line.state());
        FilterInDouble exact(found.filter);
        for (std::size_t k = 0; k < samples; ++k) {
            const double sample = full_scale * signal(k);
            const double output = factor * line.step_real(sample);
            visit(k, std::fabs(output - exact.step(sample)) / full_scale);
        }
    };
    if (goal.step_until_s) {
        compare(
            goal.last_of_step() + 1, [](std::size_t) { return 1.0; },
            [&](std::size_t k, double difference) {
                if (k >= design::first_of_step) {
                    const double wanted = design::exact_step(goal.order, static_cast<double>(k) * goal.step_s);
                    found.step_noise = std::max(found.step_noise, difference / std::fabs(wanted));
                }
            });
    }
    if (goal.band) {
        constexpr double periods = 4.0;
        const auto [low_hz, high_hz] = *goal.band;
        for (const double hz : {low_hz, std::sqrt(low_hz * high_hz), high_hz}) {
            const double angle = 2.0 * std::numbers::pi * hz * goal.step_s;
            const double wanted = std::abs(design::exact_response(goal.order, hz));
            compare(
                static_cast<std::size_t>(std::ceil(periods / (low_hz * goal.step_s))),
                [&](std::size_t k) { return std::sin(angle * static_cast<double>(k)); },
                [&](std::size_t, double difference) {
                    found.band_noise = std::max(found.band_noise, difference / wanted);
                });
        }
    }
}

void bound_noise(const design::DerivativeGoal& goal, double bound, Held& found) {
    if (goal.band) {
        // Of any record, so at each frequency the same: relative to the least |w^v| it is the largest.
        found.band_noise = bound / std::min(std::abs(design::exact_response(goal.order, goal.band->low_hz)),
                                            std::abs(design::exact_response(goal.order, goal.band->high_hz)));
    }
    if (goal.step_until_s) {
        const double first_s = static_cast<double>(design::first_of_step) * goal.step_s;
        found.step_noise = bound / std::min(std::fabs(design::exact_step(goal.order, first_s)),
                                            std::fabs(design::exact_step(goal.order, *goal.step_until_s)));
    }
}

template <class K>
Held hold(const glsum::Design& made, const design::DerivativeGoal& goal, const design::FittedFilter& fitted) {
    bench::HostLine<K> line(made);
    Held found;
    if (line.status() != glsum::Status::ok) {
        found.fault = bench::to_text(line.status());
        return found;
    }
    using History = typename K::HistoryPart;
    using Technique = typename K::TechniquePart;
    using Format = typename K::FormatPart;
    if constexpr (std::is_same_v<History, glsum::Modes>) {
        found.filter = scaled(design::held<Technique, Format>(line.state()), fitted.factor);
        run_noise<K>(line, goal, fitted.factor, found);
    } else if constexpr (std::is_same_v<History, glsum::Cascade>) {
        found.filter = scaled(design::held_in_parallel<Technique, Format>(line.state()), fitted.factor);
        run_noise<K>(line, goal, fitted.factor, found);
    } else if constexpr (std::is_same_v<History, glsum::ModesDelta>) {
        found.filter = design::of_samples(scaled(design::held<Technique, Format>(line.state()), fitted.factor));
        run_noise<K>(line, goal, fitted.factor, found);
    } else if constexpr (std::is_same_v<History, glsum::CascadeDelta>) {
        found.filter =
            design::of_samples(scaled(design::held_in_parallel<Technique, Format>(line.state()), fitted.factor));
        run_noise<K>(line, goal, fitted.factor, found);
    } else if constexpr (std::is_same_v<History, glsum::Integrator>) {
        found.filter = scaled(design::held_with_integrator<Technique, Format>(line.state()), fitted.factor);
        run_noise<K>(line, goal, fitted.factor, found);
    } else {
        found.filter = fitted.filter();
        found.as_fitted = true;
        bound_noise(goal, std::fabs(fitted.factor) * glsum::error_bound<K>(made, line.state(), 1.0, goal.horizon()),
                    found);
    }
    return found;
}

// Blackman and Harris's window of four terms: what is eight lines away counts less than 1e-4.
double window(double share) {
    const double angle = 2.0 * std::numbers::pi * share;
    return 0.35875 - 0.48829 * std::cos(angle) + 0.14128 * std::cos(2.0 * angle) - 0.01168 * std::cos(3.0 * angle);
}

// The response at one frequency, behind the start's transient.
template <class K>
std::complex<double> response(bench::HostLine<K>& line, double angle) {
    constexpr double settling_periods = 6.0;
    constexpr double periods = 16.0;
    const double period = 2.0 * std::numbers::pi / angle;
    const auto first = static_cast<std::size_t>(settling_periods * period);
    const auto count = static_cast<std::size_t>(periods * period);
    K::reset(line.state());
    std::complex<double> in;
    std::complex<double> out;
    for (std::size_t k = 0; k < first + count; ++k) {
        const double phase = angle * static_cast<double>(k);
        const double sample = full_scale * std::sin(phase);
        const double output = line.step_real(sample);
        if (k >= first) {
            const auto weight =
                window(static_cast<double>(k - first) / static_cast<double>(count)) * std::polar(1.0, -phase);
            in += sample * weight;
            out += output * weight;
        }
    }
    return out / in;
}

template <class K>
design::DerivativeError run(const glsum::Design& made, const design::DerivativeGoal& goal, double factor) {
    bench::HostLine<K> line(made);
    design::DerivativeError found;
    if (goal.band) {
        constexpr int points = 9;
        for (int i = 0; i < points; ++i) {
            const double hz = goal.band->low_hz * std::pow(goal.band->high_hz / goal.band->low_hz, i / (points - 1.0));
            const std::complex<double> exact = design::exact_response(goal.order, hz);
            const auto seen = factor * response<K>(line, 2.0 * std::numbers::pi * hz * goal.step_s);
            if (const double error = std::abs(seen - exact) / std::abs(exact); !(error <= found.band)) {
                found.band = error;
                found.band_hz = hz;
            }
        }
    }
    K::reset(line.state());
    for (std::size_t k = 0; k <= goal.last_of_step() && goal.step_until_s; ++k) {
        const double output = factor * line.step_real(full_scale) / full_scale;
        const double time_s = static_cast<double>(k) * goal.step_s;
        if (k < design::first_of_step) {
            continue;
        }
        const double exact = design::exact_step(goal.order, time_s);
        if (const double error = std::fabs(output / exact - 1.0); !(error <= found.step)) {
            found.step = error;
            found.step_s = time_s;
        }
    }
    return found;
}

}  // namespace

Held hold(const std::string& kernel, std::size_t taps, const design::DerivativeGoal& goal,
          const design::FittedFilter& fitted) {
    Held found;
    bench::with_kernel(kernel, [&]<class K>() {
        if constexpr (!std::is_same_v<K, glsum::Null>) {
            found = hold<K>(design_for(goal, fitted, taps), goal, fitted);
        }
    });
    return found;
}

design::DerivativeError run(const std::string& kernel, std::size_t taps, const design::DerivativeGoal& goal,
                            const design::FittedFilter& fitted) {
    design::DerivativeError found;
    bench::with_kernel(kernel, [&]<class K>() {
        if constexpr (!std::is_same_v<K, glsum::Null>) {
            found = run<K>(design_for(goal, fitted, taps), goal, fitted.factor);
        }
    });
    return found;
}

}  // namespace choose
