#include "bench/studies/tuned_oustaloup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace bench {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// Stops once beyond `enough`: most bands are given up within some samples.
double error_up_to(double enough, Oustaloup filter, const FilterTarget& target) {
    double largest = 0.0;
    auto next = target.wanted.begin();
    for (std::size_t k = 0; next != target.wanted.end() && largest <= enough; ++k) {
        const double output = filter.step(target.record[k]);
        if (k == next->first) {
            const double error = std::fabs(output - next->second) / target.peak;
            largest = std::max(largest, std::isfinite(error) ? error : infinite);
            ++next;
        }
    }
    return largest;
}

struct Candidate {
    double low;  // decades of the edges in rad/s
    double high;
    Mapping mapping;
    double error;
    [[nodiscard]] Band band() const { return {std::pow(10.0, low), std::pow(10.0, high)}; }
};

class Search {
public:
    Search(double order, double step_s, std::size_t poles, std::span<const FilterTarget> targets)
        : order_(order), step_s_(step_s), poles_(poles), targets_(targets) {}

    // The best of a grid, one behind the other.
    [[nodiscard]] std::vector<Candidate> starts() const {
        constexpr std::size_t count = 8;  // the best of the grid alone ends up to 3 % above what others of it reach
        std::vector<Candidate> best;
        const double nyquist = std::log10(3.14 / step_s_);
        for (const Mapping mapping : {Mapping::matched, Mapping::tustin}) {
            for (double below = 7.5; below >= 1.5; below -= 0.5) {
                for (double above = -1.25; above <= 3.5; above += 0.25) {
                    Candidate tried{nyquist - below, nyquist + above, mapping, infinite};
                    tried.error = error_of(tried, best.size() < count ? infinite : best.back().error);
                    best.insert(std::ranges::upper_bound(best, tried.error, {}, &Candidate::error), tried);
                    best.resize(std::min(best.size(), count), tried);
                }
            }
        }
        return best;
    }

    [[nodiscard]] Candidate closer(Candidate best) const {
        constexpr std::pair<int, int> ways[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}};
        constexpr double decades = 20.0;  // more on either side is a filter of nothing in between
        double step = 0.25;
        while (step > 1e-3) {
            const Candidate centre = best;
            for (const auto& [low_steps, high_steps] : ways) {
                Candidate tried{centre.low + low_steps * step, centre.high + high_steps * step, centre.mapping,
                                infinite};
                if (tried.low < tried.high && std::fabs(tried.low) < decades && std::fabs(tried.high) < decades) {
                    tried.error = error_of(tried, best.error);
                    best = tried.error < best.error ? tried : best;
                }
            }
            step = best.error < centre.error ? step : 0.5 * step;
        }
        return best;
    }

private:
    // Of the worst target; given up beyond `enough`.
    [[nodiscard]] double error_of(const Candidate& tried, double enough) const {
        double worst = 0.0;
        for (const FilterTarget& target : targets_) {
            if (worst <= enough) {
                worst = std::max(worst,
                                 error_up_to(enough, {order_, step_s_, poles_, tried.band(), tried.mapping}, target));
            }
        }
        return worst;
    }

    double order_;
    double step_s_;
    std::size_t poles_;
    std::span<const FilterTarget> targets_;
};

}  // namespace

double error_of(Oustaloup filter, const FilterTarget& target) {
    return error_up_to(infinite, std::move(filter), target);
}

TunedOustaloup tune_oustaloup(double order, double step_s, std::size_t poles, std::span<const FilterTarget> targets) {
    if (targets.empty()) {
        throw std::invalid_argument("tune_oustaloup: expected a target");
    }
    const Search search(order, step_s, poles, targets);
    std::vector<Candidate> found;
    for (const Candidate& start : search.starts()) {
        found.push_back(search.closer(start));
    }
    const Candidate& best = *std::ranges::min_element(found, {}, &Candidate::error);
    return {best.band(), best.mapping, best.error};
}

}  // namespace bench
