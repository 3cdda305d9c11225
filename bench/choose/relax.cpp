#include "bench/choose/relax.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace choose {
namespace {

class Relaxer {
public:
    Relaxer(ErrorSource& errors, CostSource& costs, const Limits& limits, std::vector<Outcome>& kernels)
        : errors_(errors), costs_(costs), limits_(limits), kernels_(kernels) {}

    std::vector<Relaxed> run() {
        // A kernel that was too costly at a short length already: how costly it is where it would do.
        std::vector<Candidate*> unknown;
        for (Outcome& outcome : kernels_) {
            if (outcome.already) {
                unknown.push_back(&*outcome.best);
            }
        }
        const bool nothing_meets = std::none_of(
            kernels_.begin(), kernels_.end(), [](const Outcome& outcome) { return outcome.best && !outcome.already; });
        if (nothing_meets && !unknown.empty()) {
            measure(costs_, unknown);
        }
        std::optional<Candidate> cost;
        std::optional<Candidate> bytes;
        for (const Outcome& outcome : kernels_) {
            if (!outcome.best || !outcome.best->cost.fault.empty() || (outcome.already && !nothing_meets)) {
                continue;
            }
            if (within(limits_.max_bytes, outcome.best->cost.bytes) &&
                (!cost || outcome.best->cost.limited < cost->cost.limited)) {
                cost = outcome.best;
            }
            if (within(limits_.max_cost, outcome.best->cost.limited) &&
                (!bytes || outcome.best->cost.bytes < bytes->cost.bytes)) {
                bytes = outcome.best;
            }
        }
        if (limits_.max_cost) {
            add_relaxed("max_cost", *limits_.max_cost, cost, cost ? cost->cost.limited : 0.0);
        }
        if (limits_.max_bytes) {
            add_relaxed("max_bytes", *limits_.max_bytes, bytes, bytes ? bytes->cost.bytes : 0.0);
        }
        const std::optional<Candidate> error = most_accurate();
        add_relaxed("max_error", limits_.max_error, error, error ? error->error.error : 0.0);
        std::stable_sort(relaxed_.begin(), relaxed_.end(),
                         [](const Relaxed& a, const Relaxed& b) { return a.factor() < b.factor(); });
        return relaxed_;
    }

private:
    void add_relaxed(const char* limit, double from, const std::optional<Candidate>& found, double to) {
        if (found) {
            relaxed_.push_back({limit, from, to, *found});
        }
    }

    // The most accurate of what the other limits allow: each kernel at the longest length within them, and at its best
    // measured length if that is no longer.
    std::optional<Candidate> most_accurate() {
        Limits others = limits_;
        others.max_error = std::numeric_limits<double>::infinity();
        std::vector<Candidate> candidates;
        for (const Outcome& outcome : kernels_) {
            if (outcome.standing != Standing::wrong) {
                candidates.push_back({outcome.kernel, 0, {}, {}});
            }
        }
        if (limits_.max_cost || limits_.max_bytes) {
            find_longest(candidates, others);
        }
        for (const Outcome& outcome : kernels_) {
            if (outcome.short_of) {
                candidates.push_back(*outcome.short_of);
            }
        }
        std::erase_if(candidates, [](const Candidate& candidate) { return candidate.taps == 0; });
        std::optional<Candidate> best;
        for (Candidate& candidate : candidates) {
            candidate.error = errors_.error(candidate.kernel, candidate.taps);
        }
        std::stable_sort(candidates.begin(), candidates.end(),
                         [](const Candidate& a, const Candidate& b) { return a.error.error < b.error.error; });
        for (Candidate& candidate : candidates) {
            if (candidate.error.fault.empty()) {
                measure(costs_, {&candidate});
                if (fits(candidate, others)) {
                    return candidate;
                }
            }
        }
        return std::nullopt;
    }

    // Sets `taps` to the longest length within the limits, 0 if none is; costs rise with the length, nearly straight.
    void find_longest(std::vector<Candidate>& candidates, const Limits& limits) {
        struct Bracket {
            std::size_t fits = 0;
            std::size_t fails;
            Candidate probe;
        };
        std::vector<Bracket> brackets;
        for (const Candidate& candidate : candidates) {
            brackets.push_back({0, errors_.longest_of(candidate.kernel) + 1, {candidate.kernel, 0, {}, {}}});
        }
        for (int round = 0; round < 24; ++round) {
            std::vector<Candidate*> now;
            for (std::size_t i = 0; i < brackets.size(); ++i) {
                Bracket& bracket = brackets[i];
                bracket.probe.taps = next_probe(bracket.probe, bracket.fits, bracket.fails, limits, round);
                if (bracket.probe.taps != 0) {
                    now.push_back(&bracket.probe);
                }
            }
            if (now.empty()) {
                break;
            }
            measure(costs_, now);
            for (Bracket& bracket : brackets) {
                if (bracket.probe.taps != 0) {
                    const bool inside = bracket.probe.cost.fault.empty() &&
                                        within(limits.max_cost, bracket.probe.cost.limited) &&
                                        within(limits.max_bytes, bracket.probe.cost.bytes);
                    (inside ? bracket.fits : bracket.fails) = bracket.probe.taps;
                }
            }
        }
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            candidates[i].taps = brackets[i].fits;
        }
    }

    // Where to look next, 0 when there is nothing left between: in proportion to what the last probe cost, by halves
    // every third time.
    std::size_t next_probe(const Candidate& last, std::size_t fits, std::size_t fails, const Limits& limits,
                           int round) const {
        if (fails - fits <= 1) {
            return 0;
        }
        if (round == 0) {
            return std::min<std::size_t>(32, fails / 2);
        }
        double share = std::numeric_limits<double>::infinity();
        if (limits.max_cost && last.cost.limited > 0.0) {
            share = std::min(share, *limits.max_cost / last.cost.limited);
        }
        if (limits.max_bytes && last.cost.bytes > 0.0) {
            share = std::min(share, *limits.max_bytes / last.cost.bytes);
        }
        std::size_t taps = fits + (fails - fits) / 2;
        if (round % 3 != 2 && std::isfinite(share)) {
            taps = static_cast<std::size_t>(std::min(1e6, static_cast<double>(last.taps) * share));
        }
        return std::clamp(taps, fits + 1, fails - 1);
    }

    ErrorSource& errors_;
    CostSource& costs_;
    const Limits& limits_;
    std::vector<Outcome>& kernels_;
    std::vector<Relaxed> relaxed_;
};

}  // namespace

std::vector<Relaxed> relax(ErrorSource& errors, CostSource& costs, const Limits& limits,
                           std::vector<Outcome>& kernels) {
    return Relaxer(errors, costs, limits, kernels).run();
}

}  // namespace choose
