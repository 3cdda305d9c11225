#include "drive/tune/search.hpp"

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>

namespace tune {
namespace {

constexpr double least_order = 0.2;
// Scores: the logarithm of the area, and far above it what is worse than any area, worst the highest.
constexpr double not_enough = 1e3;
constexpr double unstable = 1e4;
constexpr double wrong_sign = 1e5;
constexpr double no_gains = 1e6;
constexpr std::size_t descents = 8;
constexpr int evaluations = 400;  // of each
constexpr double wanted_tries = 6000.0;

}  // namespace

// What is free: [slope], [frequency, margin, slope], and the orders behind them.
struct Search::Space {
    struct Range {
        double low;
        double high;
    };
    Wish wish;
    Orders orders;
    bool flat;
    std::optional<PlantPoint> point;
    std::vector<Range> ranges;
};

Search::Search(const SampledPlant& plant, double filter_s, double horizon_s)
    : plant_(plant), filter_s_(filter_s), grid_(plant), load_(plant, horizon_s) {}

std::optional<drive::Gains> Search::gains_at(const Space& space, const double* x) const {
    Target target{space.wish.crossover.value_or(0.0), space.wish.margin_rad.value_or(0.0), 0.0};
    if (!space.wish.crossover) {
        target.crossover = std::min(std::exp(*x++), plant_.nyquist());
        target.margin_rad = *x++;
    }
    if (!space.flat) {
        target.slope_rad = *x++;
    }
    drive::Gains orders;
    orders.filter_s = filter_s_;
    if (space.orders == Orders::fractional) {
        orders.integral_order = *x++;
        orders.derivative_order = *x++;
    }
    return gains_for(target, orders, space.point ? *space.point : point_of(plant_, target.crossover), plant_.step_s());
}

Search::Trouble Search::trouble_of(const Wish& wish, const drive::Gains& gains, double w) const {
    const Parts parts = controller_parts(gains, plant_.step_s(), w);
    const double sign = plant_.sign();
    const double shares[] = {sign * gains.kp, sign * gains.ki * std::abs(parts.value[1]),
                             sign * gains.kd * std::abs(parts.value[2])};
    const double size = std::fabs(shares[0]) + std::fabs(shares[1]) + std::fabs(shares[2]);
    const double worst = std::min({shares[0], shares[1] - 1e-6 * size, shares[2]}) / size;
    if (worst < -1e-9) {
        return {wrong_sign * (1.0 - worst), 0.0};
    }
    const Grid::Answer answer = grid_(gains);
    if (answer.unstable_poles != 0) {
        return {unstable * (1.0 + std::abs(answer.unstable_poles)), 0.0};
    }
    const double short_of = wish.margin_rad ? *wish.margin_rad - answer.phase_rad : 0.0;
    const double excess = answer.sensitivity / wish.sensitivity - 1.0;
    if (short_of > 0.02 || excess > 0.2) {
        return {not_enough * (1.0 + std::max(short_of, 0.0) + std::max(excess, 0.0)), excess};
    }
    return {0.0, excess};
}

bool meets(const Wish& wish, const Margins& margins) {
    const bool margin = !wish.margin_rad || (std::fabs(margins.phase_deg * pi / 180.0 - *wish.margin_rad) < 0.01 &&
                                             std::fabs(margins.crossover / *wish.crossover - 1.0) < 1e-3);
    return margins.stable() && margin && margins.sensitivity < 1.0005 * wish.sensitivity;
}

double Search::score(const Space& space, const double* x) const {
    const std::optional<drive::Gains> gains = gains_at(space, x);
    if (!gains) {
        return no_gains;
    }
    const double w = space.wish.crossover ? *space.wish.crossover : std::exp(x[0]);
    const Trouble trouble = trouble_of(space.wish, *gains, w);
    return trouble.size > 0.0 ? trouble.size : std::log(load_.iae(*gains)) + 40.0 * std::max(trouble.excess, 0.0);
}

std::optional<Found> Search::explore(const Space& space, const std::optional<Found>& beside) const {
    const std::size_t free = space.ranges.size();
    std::size_t tries = 0;
    struct Try {
        double score;
        std::vector<double> x;
    };
    std::vector<Try> all;
    const auto attempt = [&](std::vector<double> x) {
        ++tries;
        all.push_back({score(space, x.data()), std::move(x)});
    };
    if (free == 0) {
        attempt({});
    } else {
        const int points = static_cast<int>(std::lround(std::pow(wanted_tries, 1.0 / static_cast<double>(free))));
        const int each = std::min(points, 400);
        std::vector<int> place(free, 0);
        for (bool more = true; more;) {
            std::vector<double> x(free);
            for (std::size_t i = 0; i < free; ++i) {
                x[i] = std::lerp(space.ranges[i].low, space.ranges[i].high, static_cast<double>(place[i]) / (each - 1));
            }
            attempt(std::move(x));
            more = false;
            for (std::size_t i = 0; i < free && !more; ++i) {
                more = ++place[i] < each;
                place[i] = more ? place[i] : 0;
            }
        }
    }
    std::stable_sort(all.begin(), all.end(), [](const Try& a, const Try& b) { return a.score < b.score; });
    // The best, no two of them near each other.
    std::vector<Try> starts;
    for (const Try& one : all) {
        const bool near = std::any_of(starts.begin(), starts.end(), [&](const Try& other) {
            double distance = 0.0;
            for (std::size_t i = 0; i < free; ++i) {
                const double width = space.ranges[i].high - space.ranges[i].low;
                distance = std::max(distance, std::fabs(one.x[i] - other.x[i]) / width);
            }
            return distance < 0.1;
        });
        if (!near && starts.size() < descents) {
            starts.push_back(one);
        }
    }
    Try best = all.front();
    for (const Try& start : starts) {
        if (free == 0) {
            break;
        }
        nlopt::opt descent(nlopt::LN_SBPLX, static_cast<unsigned>(free));
        std::vector<double> low;
        std::vector<double> high;
        std::vector<double> first;
        for (const Space::Range& range : space.ranges) {
            low.push_back(range.low);
            high.push_back(range.high);
            first.push_back(0.05 * (range.high - range.low));
        }
        descent.set_lower_bounds(low);
        descent.set_upper_bounds(high);
        descent.set_initial_step(first);
        descent.set_maxeval(evaluations);
        descent.set_xtol_rel(1e-7);
        struct Asked {
            const Search* search;
            const Space* space;
            std::size_t* tries;
        } asked{this, &space, &tries};
        descent.set_min_objective(
            [](unsigned, const double* x, double*, void* data) {
                const Asked& ask = *static_cast<Asked*>(data);
                ++*ask.tries;
                return ask.search->score(*ask.space, x);
            },
            &asked);
        std::vector<double> x = start.x;
        double value = 0.0;
        try {
            (void)descent.optimize(x, value);
        } catch (const nlopt::roundoff_limited&) {  // x is the best so far
            value = score(space, x.data());
        }
        if (value < best.score) {
            best = {value, x};
        }
    }
    std::optional<Found> found;
    if (best.score < not_enough) {
        if (const std::optional<drive::Gains> gains = gains_at(space, best.x.data())) {
            found = {*gains, space.flat, load_.iae(*gains), tries};
        }
    }
    if (beside && beside->flat == space.flat && (!found || beside->iae < found->iae)) {
        found = {beside->gains, space.flat, beside->iae, tries};
    }
    return found;
}

std::optional<Found> Search::best(const Wish& wish, Orders orders, const std::optional<Found>& beside) const {
    Space space{wish, orders, false, {}, {}};
    if (wish.crossover) {
        space.point = point_of(plant_, *wish.crossover);
    } else {
        space.ranges = {{std::log(0.01 * plant_.scale()), std::log(std::min(4.0 * plant_.scale(), plant_.nyquist()))},
                        {pi / 12.0, pi / 1.5}};
    }
    const std::vector<Space::Range> free_orders = {{least_order, 1.0}, {least_order, 1.0}};
    const auto with_orders = [&](std::vector<Space::Range> ranges) {
        if (orders == Orders::fractional) {
            ranges.insert(ranges.end(), free_orders.begin(), free_orders.end());
        }
        return ranges;
    };
    const std::vector<Space::Range> before = space.ranges;
    if (wish.crossover && wish.flat) {
        space.flat = true;
        space.ranges = with_orders(before);
        if (std::optional<Found> found = explore(space, beside)) {
            return found;
        }
        space.flat = false;
    }
    space.ranges = before;
    space.ranges.push_back({-4.0, 1.0});
    space.ranges = with_orders(space.ranges);
    return explore(space, beside);
}

bool Search::reachable(const Wish& wish, Orders orders) const {
    Space space{wish, orders, false, point_of(plant_, *wish.crossover), {}};
    const std::vector<double> some =
        orders == Orders::integer ? std::vector{1.0} : std::vector{0.3, 0.5, 0.7, 0.9, 1.0};
    for (double slope = -4.0; slope < 1.01; slope += 0.1) {
        for (const double integral : some) {
            for (const double derivative : some) {
                const double x[] = {slope, integral, derivative};
                const std::optional<drive::Gains> gains = gains_at(space, x);
                const Trouble trouble = gains ? trouble_of(wish, *gains, *wish.crossover) : Trouble{no_gains, 0.0};
                if (trouble.size == 0.0 && trouble.excess <= 0.0) {
                    return true;
                }
            }
        }
    }
    return false;
}

}  // namespace tune
