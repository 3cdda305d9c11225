#include "glsum/design/band.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "glsum/design/band_fit_body.hpp"
#include "glsum/exponentials/modes.hpp"
#include "glsum/weights.hpp"

namespace glsum::design {
namespace {

// From the slowest that the goal shows to the fastest, evenly in the logarithm.
Vector spread(const DerivativeGoal& goal, Eigen::Index modes, double slow, double fast) {
    const double time_s = static_cast<double>(goal.horizon()) * goal.step_s;
    const double period_s = goal.band ? 1.0 / (2.0 * std::numbers::pi * goal.band->low_hz) : 0.0;
    const double longest_s = goal.step_until_s ? std::max(*goal.step_until_s, period_s) : std::min(time_s, period_s);
    const double high = goal.band ? 2.0 * std::numbers::pi * goal.band->high_hz * goal.step_s : 0.1;
    const double last = std::log(std::min(0.7, fast * high));
    const double first = std::min(std::log(slow * goal.step_s / longest_s), last - 0.1);
    return modes == 1 ? Vector::Constant(1, std::midpoint(first, last)) : Vector::LinSpaced(modes, first, last).eval();
}

// What rounding is multiplied by: the magnitudes of all coefficients in units of the first, a mode's by the range of
// its average. A filter of less error is not taken where this is so many times that of the order's own weights.
constexpr double largest_amplification = 8.0;
double amplification(const Filter& filter) {
    double sum = 0.0;
    for (const double tap : filter.taps) {
        sum += std::fabs(tap);
    }
    for (const Mode& mode : filter.modes) {
        sum += std::fabs(mode.weight) / (mode.decay == 0.0 ? 1.0 : forgets(mode.decay));
    }
    // One that begins with no coefficient above 0 is no w_0 of a sum.
    return filter.taps.front() > 0.0 ? sum / filter.taps.front() : std::numeric_limits<double>::infinity();
}

constexpr int rough_rounds = 6;
constexpr int rounds = 60;
// At last sums of powers of the error are made small: of the fourth, and each time of four times that, up to this one,
// each in so many steps.
constexpr double last_power = 4096.0;
constexpr int rounds_of_power = 8;

// How far beyond 0 a pole may lie, tried in turn until coefficients are not too large: the nearer to the circle, the
// longer it rings, and the larger its average.
constexpr double swings[] = {0.9, 0.75, 0.6, 0.4};

// What a coefficient of the size of its column's norm counts as: tried in turn until coefficients are not too large.
constexpr double ridges[] = {0.0, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2};

struct Found {
    Filter filter;
    double error;  // infinite where every one amplifies too much
};

// What a search for poles begins from: the best of these after a few steps.
struct Starts {
    std::vector<double> slow;
    std::vector<double> fast;
    Eigen::Index
        crowded;  // at most, at the fast end: derivatives want several there, where steps from a spread bring none
};
const Starts of_decaying{{0.1, 0.3, 1.0, 3.0}, {0.5, 1.5}, 3};
const Starts of_swinging{{0.1, 1.0}, {0.5, 1.5}, 1};

// Poles to be sought, as many as `moving`.
struct Search {
    const DerivativeGoal& goal;
    std::size_t near_taps;
    Eigen::Index moving;
    FilterKind kind;
    double most;  // of the amplification, if there is one with less
    double cost;  // of coefficients at the least

    [[nodiscard]] Vector start(const Starts& starts, double swing, double ridge) const {
        Vector best = Vector::Zero(std::max<Eigen::Index>(moving, 0));
        const Eigen::Index positive = moving - (swing > 0.0 ? 1 : 0);
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; moving > 0 && i < starts.slow.size() * starts.fast.size(); ++i) {
            const double slow = starts.slow[i / starts.fast.size()];
            const double fast = starts.fast[i % starts.fast.size()];
            const Eigen::Index crowds = std::clamp<Eigen::Index>(positive - 1, 0, starts.crowded);
            for (Eigen::Index crowd = 0; crowd <= crowds; ++crowd) {
                Fit fit(goal, near_taps, kind, swing, ridge);
                Vector from = Vector::Zero(moving);
                if (positive > 0) {
                    from.head(positive - crowd) = spread(goal, positive - crowd, slow, fast);
                }
                fit.set(from);
                for (int round = 0; round < rough_rounds; ++round) {
                    fit.improve(true);
                }
                if (fit.error() < least) {
                    least = fit.error();
                    best = fit.log_decays();
                }
            }
        }
        return best;
    }

    [[nodiscard]] Found from(const Vector& start, double swing, double ridge) const {
        Fit fit(goal, near_taps, kind, swing, ridge);
        fit.set(start);
        Found best{fit.filter(), std::numeric_limits<double>::infinity()};
        const auto keep = [&] {
            if (fit.error() < best.error && amplification(fit.filter()) <= most) {
                best = {fit.filter(), fit.error()};
            }
        };
        for (int round = 0; round < rounds; ++round) {
            keep();
            fit.improve(round < rounds / 2 || round % 2 == 0);
        }
        keep();
        for (double power = 4.0; !(cost > 0.0) && power <= last_power; power *= 4.0) {
            for (int round = 0; round < rounds_of_power; ++round) {
                fit.sharpen(power);
                keep();
            }
        }
        return best;
    }

    // All poles in [0, 1), with the least ridge that keeps coefficients small; where none does, with the largest.
    [[nodiscard]] Found decaying() const {
        Found found;
        for (const double least : ridges) {
            const double ridge = std::max(least, cost);
            found = from(start(of_decaying, 0.0, ridge), 0.0, ridge);
            if (std::isfinite(found.error)) {
                break;
            }
        }
        return found;
    }

    // The last pole beyond 0, as far as coefficients are not too large.
    [[nodiscard]] Found swinging() const {
        const Vector begin = start(of_swinging, swings[0], cost);
        Found found;
        for (const double swing : swings) {
            found = from(begin, swing, cost);
            if (std::isfinite(found.error)) {
                break;
            }
        }
        return found;
    }
};

}  // namespace

Filter FittedFilter::filter() const {
    Filter filter{{factor}, modes};
    for (const double weight : weights) {
        filter.taps.push_back(factor * weight);
    }
    for (Mode& mode : filter.modes) {
        mode.weight *= factor;
    }
    return kind == FilterKind::increments ? of_samples(filter) : filter;
}

const FittedFilter& better_of(const FittedFilter& decaying, const FittedFilter& swinging) {
    const auto error = [](const FittedFilter& filter) {
        return filter.amplification <= largest_amplification ? filter.error.largest()
                                                             : std::numeric_limits<double>::infinity();
    };
    return error(swinging) < error(decaying) ? swinging : decaying;
}

FittedFilter fit_filter(const DerivativeGoal& goal, std::size_t near_taps, std::size_t modes, FilterKind kind,
                        Poles poles, double cost) {
    const std::size_t moving = moving_poles(modes, kind);
    if (poles == Poles::one_may_swing && moving > 0) {
        return better_of(fit_filter(goal, near_taps, modes, kind, Poles::decaying, cost),
                         fit_filter(goal, near_taps, modes, kind, Poles::one_swings, cost));
    }
    const double unit = absolute_sum(order_of(goal, kind), goal.horizon() + 1);
    const Search search{goal, near_taps, static_cast<Eigen::Index>(moving), kind, largest_amplification * unit, cost};
    Filter filter = (poles == Poles::one_swings ? search.swinging() : search.decaying()).filter;
    std::sort(filter.modes.begin(), filter.modes.end(), [](const Mode& a, const Mode& b) { return a.decay < b.decay; });
    const Filter whole = kind == FilterKind::increments ? of_samples(filter) : filter;
    FittedFilter found{filter.taps.front(),          {},   filter.modes,
                       error_at_points(whole, goal), kind, amplification(filter) / unit};
    for (std::size_t j = 1; j < filter.taps.size(); ++j) {
        found.weights.push_back(filter.taps[j] / found.factor);
    }
    for (Mode& mode : found.modes) {
        mode.weight /= found.factor;
    }
    return found;
}

std::optional<FittedFilter> design_filter(const DerivativeGoal& goal, double error, FilterKind kind, Poles poles) {
    constexpr double gain = 0.95;
    constexpr int patience = 6;
    const std::size_t least_modes = kind == FilterKind::integrator ? 1 : 0;
    double least = std::numeric_limits<double>::infinity();
    int without_gain = 0;
    for (std::size_t length = 1 + 2 * least_modes; length <= longest_filter && without_gain < patience; ++length) {
        const std::size_t near_taps = length % 2 == 1 ? 1 : 2;
        FittedFilter fitted = fit_filter(goal, near_taps, (length - near_taps) / 2, kind, poles);
        const double now = certified_error(fitted.filter(), goal).largest();
        if (now <= error && fitted.amplification <= largest_amplification) {
            return fitted;
        }
        without_gain = now < gain * least ? 0 : without_gain + 1;
        least = std::min(least, now);
    }
    return std::nullopt;
}

}  // namespace glsum::design
