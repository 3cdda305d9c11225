#include "glsum/design/rational.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace glsum::design {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Point {
    double angle;
    std::complex<double> wanted;  // of the filter of order in (-1, 1)
};

// The gain g of least max |g a - 1|, which is convex in g.
std::pair<double, double> best_gain(const std::vector<std::complex<double>>& relative) {
    double cross = 0.0;
    double square = 0.0;
    for (const auto& a : relative) {
        cross += a.real();
        square += std::norm(a);
    }
    const double middle = cross / square;
    if (!(middle > 0.0) || !std::isfinite(middle)) {
        return {1.0, infinite};
    }
    const auto error = [&](double gain) {
        double largest = 0.0;
        for (const auto& a : relative) {
            largest = std::max(largest, std::norm(gain * a - 1.0));
        }
        return largest;
    };
    double low = 0.5 * middle;
    double high = 2.0 * middle;
    for (int i = 0; i < 60 && high - low > 1e-9 * middle; ++i) {
        const double third = (high - low) / 3.0;
        if (error(low + third) < error(high - third)) {
            high -= third;
        } else {
            low += third;
        }
    }
    const double gain = 0.5 * (low + high);
    return {gain, std::sqrt(error(gain))};
}

class Tuner {
public:
    Tuner(RationalRule rule, const DerivativeGoal& goal, std::size_t poles)
        : rule_(rule), poles_(poles), step_s_(goal.step_s), order_(goal.order > 1.0 ? goal.order - 1.0 : goal.order) {
        for (const double hz : frequencies_of(goal)) {
            const double angle = 2.0 * std::numbers::pi * hz * goal.step_s;
            std::complex<double> wanted = exact_response(goal.order, hz);
            if (goal.order > 1.0) {
                wanted *= goal.step_s / (1.0 - std::polar(1.0, -angle));
            }
            points_.push_back({angle, wanted});
        }
    }

    [[nodiscard]] TunedRational at(double low, double high, Mapping mapping) const {
        const Edges edges{std::pow(10.0, low), std::pow(10.0, high)};
        const Roots roots = roots_of(rule_, order_, poles_, edges);
        std::vector<std::complex<double>> relative;
        for (const Point& point : points_) {
            relative.push_back(response_of(roots, mapping, step_s_, point.angle) / point.wanted);
        }
        const auto [gain, error] = best_gain(relative);
        return {edges, mapping, gain, std::isfinite(error) ? error : infinite};
    }

private:
    RationalRule rule_;
    std::size_t poles_;
    double step_s_;
    double order_;
    std::vector<Point> points_;
};

}  // namespace

std::string to_text(Mapping mapping) {
    return mapping == Mapping::matched ? "matched" : mapping == Mapping::tustin ? "Tustin" : "impulse-invariant";
}

bool has_rational(double order) { return order > -1.0 && order < 2.0 && order != std::floor(order); }

Roots roots_of(RationalRule rule, double order, std::size_t poles, Edges edges) {
    const double ratio = edges.high_rad_s / edges.low_rad_s;
    const auto root = [&](double place) {
        return edges.low_rad_s * std::pow(ratio, place / static_cast<double>(poles));
    };
    const bool proper = rule == RationalRule::charef && order < 0.0;
    Roots roots;
    for (std::size_t k = 0; k < poles; ++k) {
        const auto place = static_cast<double>(k) + 0.5;
        roots.poles.push_back(root(place + 0.5 * order));
        if (!proper || k + 1 < poles) {
            roots.zeros.push_back(root(place - 0.5 * order));
        }
    }
    return roots;
}

namespace {

// Of d + sum r / (s + p): its residues, and d, 1 with as many zeros as poles.
struct Partial {
    double direct;
    std::vector<double> residues;
};

Partial partial_of(const Roots& roots) {
    Partial of{roots.zeros.size() == roots.poles.size() ? 1.0 : 0.0, {}};
    for (std::size_t k = 0; k < roots.poles.size(); ++k) {
        double residue = 1.0;
        for (const double zero : roots.zeros) {
            residue *= zero - roots.poles[k];
        }
        for (std::size_t j = 0; j < roots.poles.size(); ++j) {
            residue /= j == k ? 1.0 : roots.poles[j] - roots.poles[k];
        }
        of.residues.push_back(residue);
    }
    return of;
}

// Of H(q), q = z^-1: zeros and poles, whose factors are 1 - root q, and H(0).
struct Sampled {
    std::vector<double> zeros;
    std::vector<double> poles;
    double first;
};

// By a mapping of poles and zeros.
Sampled sampled(const Roots& roots, Mapping mapping, double step_s) {
    const double bilinear = 2.0 / step_s;
    const auto mapped = [&](double root) {
        return mapping == Mapping::matched ? std::exp(-root * step_s) : (bilinear - root) / (bilinear + root);
    };
    const auto scale = [&](double root) { return mapping == Mapping::matched ? 1.0 : bilinear + root; };
    Sampled of{{}, {}, 1.0};
    for (const double zero : roots.zeros) {
        of.zeros.push_back(mapped(zero));
        of.first *= scale(zero);
    }
    for (const double pole : roots.poles) {
        of.poles.push_back(mapped(pole));
        of.first /= scale(pole);
    }
    if (mapping == Mapping::tustin && roots.zeros.size() < roots.poles.size()) {
        of.zeros.push_back(-1.0);  // what is 0 at infinite frequency is 0 at half the sample's rate
    }
    return of;
}

}  // namespace

std::complex<double> response_of(const Roots& roots, Mapping mapping, double step_s, double angle) {
    const std::complex<double> delay = std::polar(1.0, -angle);
    if (mapping == Mapping::impulse_invariant) {
        const Partial of = partial_of(roots);
        std::complex<double> response = of.direct;
        for (std::size_t k = 0; k < roots.poles.size(); ++k) {
            response += of.residues[k] * step_s * (1.0 / (1.0 - std::exp(-roots.poles[k] * step_s) * delay) - 0.5);
        }
        return response;
    }
    const Sampled of = sampled(roots, mapping, step_s);
    std::complex<double> response = of.first;
    for (const double zero : of.zeros) {
        response *= 1.0 - zero * delay;
    }
    for (const double pole : of.poles) {
        response /= 1.0 - pole * delay;
    }
    return response;
}

FittedFilter as_modes(RationalRule rule, const DerivativeGoal& goal, std::size_t poles, const TunedRational& tuned) {
    const bool increments = goal.order > 1.0;
    const Roots roots = roots_of(rule, increments ? goal.order - 1.0 : goal.order, poles, tuned.edges);
    double first = 0.0;
    std::vector<Mode> modes;
    if (tuned.mapping == Mapping::impulse_invariant) {
        // r h (1/(1 - e q) - 1/2) = r h / 2 + r h e q / (1 - e q), and d before.
        const Partial of = partial_of(roots);
        first = of.direct;
        for (std::size_t k = 0; k < roots.poles.size(); ++k) {
            const double weight = of.residues[k] * goal.step_s;
            first += 0.5 * weight;
            modes.push_back(
                {-std::expm1(-roots.poles[k] * goal.step_s), weight * std::exp(-roots.poles[k] * goal.step_s)});
        }
    } else {
        const Sampled of = sampled(roots, tuned.mapping, goal.step_s);
        first = of.first;
        for (std::size_t k = 0; k < of.poles.size(); ++k) {
            // A/(1 - p q) = A + A p q/(1 - p q), with as many zeros as poles A p = (p - z) ...: no division by p.
            const double pole = of.poles[k];
            double weight = of.first;
            for (std::size_t j = 0; j < of.poles.size(); ++j) {
                weight *= j < of.zeros.size() ? pole - of.zeros[j] : pole;
                weight /= j == k ? 1.0 : pole - of.poles[j];
            }
            modes.push_back({1.0 - pole, weight});
        }
    }
    std::sort(modes.begin(), modes.end(), [](const auto& a, const auto& b) { return a.decay < b.decay; });
    for (auto& mode : modes) {
        mode.weight /= first;
    }
    const double unit = increments ? 1.0 / goal.step_s : 1.0;
    FittedFilter filter{
        unit * tuned.gain * first, {}, modes, {}, increments ? FilterKind::increments : FilterKind::samples};
    filter.error = error_at_points(filter.filter(), goal);
    return filter;
}

TunedRational tune_rational(RationalRule rule, const DerivativeGoal& goal, std::size_t poles, Poles allowed) {
    struct Start {
        double low;  // decades of the edges in rad/s
        double high;
        TunedRational found;
    };
    constexpr std::size_t starts = 6;
    const Tuner tuner(rule, goal, poles);
    const double first = std::log10(2.0 * std::numbers::pi * goal.band->low_hz);
    const double last = std::log10(2.0 * std::numbers::pi * goal.band->high_hz);
    std::vector<Start> best;
    for (const Mapping mapping : {Mapping::matched, Mapping::tustin, Mapping::impulse_invariant}) {
        if (mapping == Mapping::tustin && allowed == Poles::decaying) {
            continue;
        }
        for (double low = first - 2.5; low < first + 0.6; low += 0.25) {
            for (double high = last - 0.6; high < last + 3.1; high += 0.25) {
                if (low < high) {
                    best.push_back({low, high, tuner.at(low, high, mapping)});
                }
            }
        }
    }
    const auto errs_less = [](const Start& a, const Start& b) { return a.found.error < b.found.error; };
    std::stable_sort(best.begin(), best.end(), errs_less);
    best.resize(std::min(best.size(), starts));
    constexpr std::pair<int, int> ways[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}};
    for (Start& start : best) {
        for (double step = 0.125; step > 5e-4;) {
            Start nearest = start;
            for (const auto& [low_steps, high_steps] : ways) {
                const double low = start.low + low_steps * step;
                const double high = start.high + high_steps * step;
                if (low < high) {
                    const Start tried{low, high, tuner.at(low, high, start.found.mapping)};
                    nearest = errs_less(tried, nearest) ? tried : nearest;
                }
            }
            step = errs_less(nearest, start) ? step : 0.5 * step;
            start = nearest;
        }
    }
    return std::min_element(best.begin(), best.end(), errs_less)->found;
}

}  // namespace glsum::design
