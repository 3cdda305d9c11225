#include "bench/choose/reach.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace choose {
namespace {

// How many lengths in a row are measured one by one; a longer gap is bisected first.
constexpr std::size_t longest_scan = 512;

class Reacher {
public:
    Reacher(ErrorSource& errors, const std::string& kernel, double limit)
        : errors_(errors), kernel_(kernel), limit_(limit) {}

    Reach run() {
        const std::size_t first = next_possible(1);
        // Shorter ones whose rounding makes good what truncation costs.
        reach_.shortest = scan(1, first, limit_ + errors_.rounding_bound(kernel_, first));
        if (!reach_.shortest) {
            const ErrorAt there = whole(first);
            if (there.fault.empty() && there.error <= limit_) {
                reach_.shortest = first;
            } else {
                climb(first);
            }
        }
        return reach_;
    }

private:
    ErrorAt whole(std::size_t taps) {
        const ErrorAt at = errors_.error(kernel_, taps);
        if (reach_.best_taps == 0 || (at.fault.empty() && at.error < reach_.best.error)) {
            reach_.best = at;
            reach_.best_taps = taps;
        }
        return at;
    }

    // The first length from `taps` on whose truncation alone meets the limit: full memory does.
    std::size_t next_possible(std::size_t taps) const {
        while (taps < errors_.longest() && errors_.truncation(taps) > limit_) {
            ++taps;
        }
        return taps;
    }

    // The first of [from, to) that meets the limit, of those whose truncation is at most `possible`.
    std::optional<std::size_t> scan(std::size_t from, std::size_t to, double possible) {
        for (std::size_t taps = from; taps < to; ++taps) {
            if (errors_.truncation(taps) <= possible && errors_.meets(kernel_, taps, limit_)) {
                return taps;
            }
        }
        return std::nullopt;
    }

    // Truncation would do, rounding is in the way: a ladder to full memory, then every length below the first rung that
    // meets the limit or, if none does, about the best rung when that is near.
    void climb(std::size_t first) {
        std::vector<std::size_t> rungs = {first};
        while (rungs.back() < errors_.longest()) {
            const std::size_t taps = rungs.back();
            rungs.push_back(next_possible(std::min(errors_.longest(), taps + std::max<std::size_t>(1, taps / 4))));
            const ErrorAt at = whole(rungs.back());
            if (at.fault.empty() && at.error <= limit_) {
                descend(first, rungs[rungs.size() - 2], rungs.back());
                return;
            }
        }
        if (reach_.best.fault.empty() && reach_.best.error <= 1.25 * limit_) {
            const auto best = std::find(rungs.begin(), rungs.end(), reach_.best_taps);
            const std::size_t from = best == rungs.begin() ? first : *(best - 1);
            const std::size_t to = best + 1 == rungs.end() ? *best : *(best + 1);
            reach_.shortest = scan(from, std::min(to, from + 2 * longest_scan), limit_);
        }
    }

    // `meets` is a length that does, `fails` the rung before it that does not.
    void descend(std::size_t first, std::size_t fails, std::size_t meets) {
        if (meets - first <= longest_scan) {
            fails = first;
        }
        std::size_t below = fails;
        while (meets - below > longest_scan) {
            const std::size_t middle = below + (meets - below) / 2;
            if (errors_.meets(kernel_, middle, limit_)) {
                meets = middle;
            } else {
                below = middle;
            }
        }
        const std::size_t from = std::max(fails + longest_scan, meets) - longest_scan;
        reach_.shortest = scan(from, meets, limit_).value_or(meets);
    }

    ErrorSource& errors_;
    const std::string& kernel_;
    double limit_;
    Reach reach_;
};

}  // namespace

Reach reach_of(ErrorSource& errors, const std::string& kernel, const std::vector<std::size_t>& lengths, double limit) {
    constexpr double gain = 0.95;
    Reach reach;
    std::size_t without_gain = 0;
    double to_beat = std::numeric_limits<double>::infinity();
    for (const std::size_t taps : lengths) {
        const ErrorAt at = errors.error(kernel, taps);
        if (reach.best_taps == 0 || at.error < reach.best.error) {
            reach.best_taps = taps;
            reach.best = at;
        }
        if (at.fault.empty() && at.error <= limit) {
            reach.shortest = taps;
            break;
        }
        if (at.error < gain * to_beat || !at.fault.empty()) {
            to_beat = std::min(to_beat, at.error);
            without_gain = 0;
        } else if (++without_gain == errors.patience()) {
            break;
        }
    }
    return reach;
}

Reach reach(ErrorSource& errors, const std::string& kernel, double limit) {
    return Reacher(errors, kernel, limit).run();
}

}  // namespace choose
