#include "glsum/design/derivative.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "glsum/design/derivative_curvature.hpp"

namespace glsum::design {
namespace {

constexpr double points_a_decade = 32.0;
constexpr double step_ratio = 1.04;

double relative_error(const Filter& filter, const DerivativeGoal& goal, double hz) {
    const std::complex<double> exact = exact_response(goal.order, hz);
    return std::abs(frequency_response(filter, 2.0 * std::numbers::pi * hz * goal.step_s) - exact) / std::abs(exact);
}

void raise(double& largest, double& where, double error, double here) {
    if (!(error <= largest)) {
        largest = error;
        where = here;
    }
}

// Halves intervals, those of the largest bound first, until no bound is half a percent above the largest error found.
void certify_band(const Filter& filter, const DerivativeGoal& goal, DerivativeError& found) {
    struct Interval {
        double low;  // angles
        double high;
        double error_low;
        double error_high;
        double bound;
        bool operator<(const Interval& other) const { return bound < other.bound; }
    };
    constexpr double margin = 1.005;
    // What errs by half of the derivative is of no use to anybody: its bound need not be near. Windows for an integral
    // have coefficients of both signs there that would take all of them.
    const auto most_intervals = [&] { return found.band < 0.5 ? std::size_t{2'000'000} : std::size_t{2'000}; };
    const Curvature curvature(filter, goal);
    const double v = goal.order;
    const double to_hz = 1.0 / (2.0 * std::numbers::pi * goal.step_s);
    const auto error_at = [&](double angle) { return relative_error(filter, goal, angle * to_hz); };
    const auto make = [&](double low, double high, double error_low, double error_high) {
        // Of f/|w^v|, by the least |w^v| of the interval: exact at the ends up to that ratio.
        const double ratio = std::pow(high / low, std::fabs(v));
        const double least = std::pow(goal.step_s, -v) * std::min(std::pow(low, v), std::pow(high, v));
        const double width = high - low;
        const double bound =
            std::max(error_low, error_high) * ratio + curvature.bound(low, high) * width * width / 8.0 / least;
        return Interval{low, high, error_low, error_high, bound};
    };
    std::priority_queue<Interval> intervals;
    const std::vector<double> points = frequencies_of(goal);
    double before = points.front() / to_hz;
    double error_before = error_at(before);
    raise(found.band, found.band_hz, error_before, points.front());
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double angle = points[i] / to_hz;
        const double error = error_at(angle);
        raise(found.band, found.band_hz, error, points[i]);
        intervals.push(make(before, angle, error_before, error));
        before = angle;
        error_before = error;
    }
    // A band of one frequency has no interval.
    while (!intervals.empty() && intervals.top().bound > margin * found.band && intervals.size() < most_intervals()) {
        const Interval widest = intervals.top();
        intervals.pop();
        const double middle = 0.5 * (widest.low + widest.high);
        const double error = error_at(middle);
        raise(found.band, found.band_hz, error, middle * to_hz);
        intervals.push(make(widest.low, middle, widest.error_low, error));
        intervals.push(make(middle, widest.high, error, widest.error_high));
    }
    if (!intervals.empty()) {
        found.band = std::max(found.band, intervals.top().bound);
    }
}

// Every sample, in one pass: each mode's sum grows by a factor.
void add_whole_step(const Filter& filter, const DerivativeGoal& goal, DerivativeError& found) {
    const std::size_t near = filter.taps.size();
    std::vector<double> sums(filter.modes.size(), 0.0);
    double of_taps = 0.0;
    for (std::size_t k = 0; k <= goal.last_of_step(); ++k) {
        of_taps += k < near ? filter.taps[k] : 0.0;
        double response = of_taps;
        for (std::size_t m = 0; m < sums.size(); ++m) {
            sums[m] = k < near ? 0.0 : sums[m] - filter.modes[m].decay * sums[m] + 1.0;
            response += filter.modes[m].weight * sums[m];
        }
        if (k >= first_of_step) {
            const double time_s = static_cast<double>(k) * goal.step_s;
            const double exact = exact_step(goal.order, time_s);
            raise(found.step, found.step_s, std::fabs(response - exact) / std::fabs(exact), time_s);
        }
    }
}

}  // namespace

std::size_t DerivativeGoal::last_of_step() const {
    return step_until_s ? static_cast<std::size_t>(std::llround(*step_until_s / step_s)) : 0;
}

std::size_t DerivativeGoal::horizon() const {
    const double period = band ? std::ceil(1.0 / (band->low_hz * step_s)) : 1.0;
    return std::max(last_of_step(), static_cast<std::size_t>(period));
}

bool has_step(double order) { return order != 1.0 && order != 2.0; }

std::complex<double> exact_response(double order, double hz) {
    return std::polar(std::pow(2.0 * std::numbers::pi * hz, order), 0.5 * std::numbers::pi * order);
}

double exact_step(double order, double time_s) { return std::pow(time_s, -order) / std::tgamma(1.0 - order); }

std::complex<double> full_memory_response(double order, double step_s, double angle) {
    return std::pow((1.0 - std::polar(1.0, -angle)) / step_s, order);
}

double full_memory_step(double order, double step_s, std::size_t k) {
    const auto at = static_cast<double>(k);
    const double sum = std::exp(std::lgamma(at + 1.0 - order) - std::lgamma(at + 1.0)) / std::tgamma(1.0 - order);
    return sum * std::pow(step_s, -order);
}

std::vector<double> frequencies_of(const DerivativeGoal& goal) {
    std::vector<double> frequencies;
    if (goal.band) {
        const double ratio = goal.band->high_hz / goal.band->low_hz;
        const auto steps = static_cast<std::size_t>(std::ceil(std::log10(ratio) * points_a_decade));
        for (std::size_t i = 0; i < steps; ++i) {
            const double share = static_cast<double>(i) / static_cast<double>(steps);
            frequencies.push_back(goal.band->low_hz * std::pow(ratio, share));
        }
        frequencies.push_back(goal.band->high_hz);
    }
    return frequencies;
}

std::vector<std::size_t> samples_of(const DerivativeGoal& goal) {
    std::vector<std::size_t> samples;
    const auto last = static_cast<double>(goal.last_of_step());
    for (double k = first_of_step; k < last; k = std::max(k + 1.0, k * step_ratio)) {
        samples.push_back(static_cast<std::size_t>(k));
    }
    if (goal.last_of_step() >= first_of_step) {
        samples.push_back(goal.last_of_step());
    }
    return samples;
}

DerivativeError error_at_points(const Filter& filter, const DerivativeGoal& goal) {
    DerivativeError found;
    for (const double hz : frequencies_of(goal)) {
        raise(found.band, found.band_hz, relative_error(filter, goal, hz), hz);
    }
    for (const std::size_t k : samples_of(goal)) {
        const double time_s = static_cast<double>(k) * goal.step_s;
        const double exact = exact_step(goal.order, time_s);
        raise(found.step, found.step_s, std::fabs(step_response(filter, k) - exact) / std::fabs(exact), time_s);
    }
    return found;
}

DerivativeError certified_error(const Filter& filter, const DerivativeGoal& goal) {
    DerivativeError found;
    if (goal.band) {
        certify_band(filter, goal, found);
    }
    if (goal.step_until_s) {
        add_whole_step(filter, goal, found);
    }
    return found;
}

}  // namespace glsum::design
