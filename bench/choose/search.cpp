#include "bench/choose/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "bench/parallel.hpp"
#include "bench/progress.hpp"

namespace choose {
namespace {

// How many lengths in a row are measured one by one; a longer gap is bisected first.
constexpr std::size_t longest_scan = 512;
// Where code of equal kind repeats in groups (of 2, 4, 8 taps), a slightly longer one can cost less, by no more than
// the rest of a group: so many instructions, so many taps.
constexpr double group_cost = 64.0;
constexpr std::size_t group_taps = 7;
// A kernel that is known to be dear is tried at this length first.
constexpr std::size_t short_taps = 64;

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
        const std::size_t from = std::max(fails, meets > longest_scan ? meets - longest_scan : 1);
        reach_.shortest = scan(from, meets, limit_).value_or(meets);
    }

    ErrorSource& errors_;
    const std::string& kernel_;
    double limit_;
    Reach reach_;
};

bool within(const std::optional<double>& limit, double value) { return !limit || value <= *limit; }

bool fits(const Candidate& candidate, const Limits& limits) {
    return candidate.error.fault.empty() && candidate.cost.fault.empty() && candidate.error.error <= limits.max_error &&
           within(limits.max_cost, candidate.cost.limited) && within(limits.max_bytes, candidate.cost.bytes);
}

bool dominates(const Candidate& a, const Candidate& b) {
    return a.error.error <= b.error.error && a.cost.value <= b.cost.value && a.cost.bytes <= b.cost.bytes &&
           (a.error.error < b.error.error || a.cost.value < b.cost.value || a.cost.bytes < b.cost.bytes);
}

// One search: the kernels' fates grow as errors, then costs become known.
class Search {
public:
    Search(ErrorSource& errors, CostSource& costs, const std::vector<std::string>& kernels, const Limits& limits,
           unsigned jobs)
        : errors_(errors), costs_(costs), limits_(limits), jobs_(jobs) {
        for (const std::string& kernel : kernels) {
            choice_.kernels.push_back(
                {.kernel = kernel, .fate = Fate::wrong, .best = {}, .short_of = {}, .already = {}, .why = {}});
        }
    }

    Choice run(bool progress) {
        find_lengths(progress);
        find_costs();
        judge();
        if (!choice_.chosen) {
            relax();
        }
        return choice_;
    }

private:
    void find_lengths(bool shown) {
        std::optional<bench::Progress> progress;
        if (shown) {
            progress.emplace("shortest lengths", choice_.kernels.size());
        }
        bench::parallel_for(choice_.kernels.size(), jobs_, [&](std::size_t i) {
            find_length(choice_.kernels[i]);
            if (progress) {
                progress->advance();
            }
        });
    }

    void find_length(Fared& fared) {
        if (const auto lengths = costs_.lengths(fared.kernel)) {
            Reach reach;
            for (const std::size_t taps : *lengths) {
                const ErrorAt at = errors_.error(fared.kernel, taps);
                if (at.fault.empty() && at.error <= limits_.max_error && !reach.shortest) {
                    reach.shortest = taps;
                }
                if (reach.best_taps == 0 || at.error < reach.best.error) {
                    reach.best_taps = taps;
                    reach.best = at;
                }
            }
            if (lengths->empty()) {
                reach.best.fault = "no " + costs_.unit() + " of it are known";
            }
            take(fared, reach);
        } else {
            take(fared, reach(errors_, fared.kernel, limits_.max_error));
        }
    }

    void take(Fared& fared, const Reach& reach) {
        if (reach.shortest) {
            fared.best = at(fared.kernel, *reach.shortest);
        } else if (reach.best.fault.empty()) {
            fared.fate = Fate::inaccurate;
            fared.short_of = {fared.kernel, reach.best_taps, reach.best, {}};
        } else {
            fared.why = reach.best.fault;
        }
    }

    Candidate at(const std::string& kernel, std::size_t taps) {
        return {kernel, taps, errors_.error(kernel, taps), {}};
    }

    void measure(std::vector<Candidate*> candidates) {
        std::vector<Case> cases;
        for (const Candidate* candidate : candidates) {
            cases.emplace_back(candidate->kernel, candidate->taps);
        }
        const std::vector<Cost> found = costs_.costs(cases);
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            candidates[i]->cost = found[i];
        }
    }

    // The least cost of what fits so far.
    [[nodiscard]] double least() const {
        double least = std::numeric_limits<double>::infinity();
        for (const Fared& fared : choice_.kernels) {
            if (fared.best && !fared.already && fits(*fared.best, limits_)) {
                least = std::min(least, fared.best->cost.value);
            }
        }
        return least;
    }

    void find_costs() {
        std::vector<Candidate*> now;
        std::vector<Fared*> dear;
        for (Fared& fared : choice_.kernels) {
            if (fared.best && costs_.dear(fared.kernel) && fared.best->taps > short_taps) {
                fared.already = Candidate{fared.kernel, short_taps, {}, {}};
                now.push_back(&*fared.already);
                dear.push_back(&fared);
            } else if (fared.best) {
                now.push_back(&*fared.best);
            }
        }
        measure(now);
        const double so_far = least();
        now.clear();
        for (Fared* fared : dear) {
            const Cost& cost = fared->already->cost;
            if (!cost.fault.empty() || (cost.value <= so_far && within(limits_.max_cost, cost.limited))) {
                fared->already.reset();
                now.push_back(&*fared->best);
            }
        }
        if (!now.empty()) {
            measure(now);
        }
        if (costs_.exact()) {
            look_behind();
        }
    }

    // Longer lengths that cost less, where that can be.
    void look_behind() {
        const double so_far = std::min(least(), limits_.max_cost.value_or(std::numeric_limits<double>::infinity()));
        std::vector<Candidate> longer;
        for (const Fared& fared : choice_.kernels) {
            if (!fared.best || fared.already || fared.best->cost.value > so_far + group_cost) {
                continue;
            }
            std::vector<std::size_t> lengths;
            if (const auto known = costs_.lengths(fared.kernel)) {
                lengths = *known;
            } else {
                for (std::size_t i = 1; i <= group_taps && fared.best->taps + i <= errors_.longest(); ++i) {
                    lengths.push_back(fared.best->taps + i);
                }
            }
            for (const std::size_t taps : lengths) {
                if (taps > fared.best->taps && errors_.meets(fared.kernel, taps, limits_.max_error)) {
                    longer.push_back(at(fared.kernel, taps));
                }
            }
        }
        std::vector<Candidate*> now;
        for (Candidate& candidate : longer) {
            now.push_back(&candidate);
        }
        measure(now);
        for (const Candidate& candidate : longer) {
            for (Fared& fared : choice_.kernels) {
                if (fared.kernel != candidate.kernel || !candidate.cost.fault.empty()) {
                    continue;
                }
                const bool fits_now = fits(candidate, limits_);
                const bool fitted = fits(*fared.best, limits_);
                if (fits_now != fitted ? fits_now : better(candidate, *fared.best)) {
                    fared.best = candidate;
                }
            }
        }
    }

    void judge() {
        Fared* first = nullptr;
        Fared* second = nullptr;
        for (Fared& fared : choice_.kernels) {
            if (!fared.best || fared.already || !fits(*fared.best, limits_)) {
                continue;
            }
            if (first == nullptr || better(*fared.best, *first->best)) {
                second = first;
                first = &fared;
            } else if (second == nullptr || better(*fared.best, *second->best)) {
                second = &fared;
            }
        }
        for (Fared& fared : choice_.kernels) {
            if (fared.best) {
                fared.fate = &fared == first ? Fate::chosen : &fared == second ? Fate::runner_up : fate_of(fared);
            }
        }
        if (first != nullptr) {
            choice_.chosen = first->best;
        }
        if (second != nullptr) {
            choice_.runner_up = second->best;
            choice_.tie = second->best->cost.value - first->best->cost.value <=
                          second->best->cost.noise + first->best->cost.noise;
        }
    }

    Fate fate_of(Fared& fared) {
        if (fared.already) {
            return within(limits_.max_cost, fared.already->cost.limited) ? Fate::dearer : Fate::too_dear;
        }
        if (!fared.best->cost.fault.empty()) {
            fared.why = fared.best->cost.fault;
            return Fate::wrong;
        }
        if (!within(limits_.max_cost, fared.best->cost.limited)) {
            return Fate::too_dear;
        }
        if (!within(limits_.max_bytes, fared.best->cost.bytes)) {
            return Fate::too_large;
        }
        for (const Fared& other : choice_.kernels) {
            if (&other != &fared && other.best && !other.already && fits(*other.best, limits_) &&
                dominates(*other.best, *fared.best)) {
                fared.why = "by " + other.kernel;
                return Fate::dominated;
            }
        }
        return Fate::dearer;
    }

    void add_relaxed(const char* limit, double from, const std::optional<Candidate>& found, double to) {
        if (found) {
            choice_.relaxed.push_back({limit, from, to, *found});
        }
    }

    void relax() {
        // A kernel that was too dear at a short length already: how dear it is where it would do.
        std::vector<Candidate*> unknown;
        for (Fared& fared : choice_.kernels) {
            if (fared.already) {
                unknown.push_back(&*fared.best);
            }
        }
        const bool nothing_meets = std::none_of(choice_.kernels.begin(), choice_.kernels.end(),
                                                [](const Fared& fared) { return fared.best && !fared.already; });
        if (nothing_meets && !unknown.empty()) {
            measure(unknown);
        }
        std::optional<Candidate> cost;
        std::optional<Candidate> bytes;
        for (const Fared& fared : choice_.kernels) {
            if (!fared.best || !fared.best->cost.fault.empty() || (fared.already && !nothing_meets)) {
                continue;
            }
            if (within(limits_.max_bytes, fared.best->cost.bytes) &&
                (!cost || fared.best->cost.limited < cost->cost.limited)) {
                cost = fared.best;
            }
            if (within(limits_.max_cost, fared.best->cost.limited) &&
                (!bytes || fared.best->cost.bytes < bytes->cost.bytes)) {
                bytes = fared.best;
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
        std::stable_sort(choice_.relaxed.begin(), choice_.relaxed.end(),
                         [](const Relaxed& a, const Relaxed& b) { return a.factor() < b.factor(); });
    }

    // The most accurate of what the other limits allow: each kernel at the longest length within them, and at its best
    // measured length if that is no longer.
    std::optional<Candidate> most_accurate() {
        Limits others = limits_;
        others.max_error = std::numeric_limits<double>::infinity();
        std::vector<Candidate> candidates;
        for (const Fared& fared : choice_.kernels) {
            if (fared.fate != Fate::wrong) {
                candidates.push_back({fared.kernel, 0, {}, {}});
            }
        }
        if (limits_.max_cost || limits_.max_bytes) {
            find_longest(candidates, others);
        }
        for (const Fared& fared : choice_.kernels) {
            if (fared.short_of) {
                candidates.push_back(*fared.short_of);
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
                measure({&candidate});
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
            brackets.push_back({0, errors_.longest() + 1, {candidate.kernel, 0, {}, {}}});
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
            measure(now);
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
        if (const auto known = costs_.lengths(last.kernel)) {
            std::vector<std::size_t> between;
            std::copy_if(known->begin(), known->end(), std::back_inserter(between),
                         [&](std::size_t taps) { return taps > fits && taps < fails; });
            return between.empty() ? 0 : between[between.size() / 2];
        }
        if (fails - fits <= 1) {
            return 0;
        }
        if (round == 0) {
            return std::min<std::size_t>(32, fits + (fails - fits) / 2);
        }
        double share = std::numeric_limits<double>::infinity();
        if (limits.max_cost && last.cost.limited > 0.0) {
            share = std::min(share, *limits.max_cost / last.cost.limited);
        }
        if (limits.max_bytes && last.cost.bytes > 0.0) {
            share = std::min(share, *limits.max_bytes / last.cost.bytes);
        }
        std::size_t taps = fits + (fails - fits) / 2;
        if (round % 3 != 2 && std::isfinite(share) && last.taps != 0) {
            const double guess = std::min(1e6, static_cast<double>(last.taps) * share);
            taps = static_cast<std::size_t>(guess) + (last.taps == static_cast<std::size_t>(guess) ? 1 : 0);
        }
        return std::clamp(taps, fits + 1, fails - 1);
    }

    ErrorSource& errors_;
    CostSource& costs_;
    Limits limits_;
    unsigned jobs_;
    Choice choice_;
};

}  // namespace

std::string to_text(Fate fate) {
    switch (fate) {
        case Fate::chosen:
            return "chosen";
        case Fate::runner_up:
            return "runner-up";
        case Fate::dominated:
            return "dominated";
        case Fate::dearer:
            return "dearer";
        case Fate::too_dear:
            return "too dear";
        case Fate::too_large:
            return "too large";
        case Fate::inaccurate:
            return "too inaccurate";
        case Fate::wrong:
            return "wrong";
    }
    return "unknown";
}

bool better(const Candidate& a, const Candidate& b) {
    return std::tie(a.cost.value, a.cost.bytes, a.error.error) < std::tie(b.cost.value, b.cost.bytes, b.error.error);
}

Reach reach(ErrorSource& errors, const std::string& kernel, double limit) {
    return Reacher(errors, kernel, limit).run();
}

Choice choose(ErrorSource& errors, CostSource& costs, const std::vector<std::string>& kernels, const Limits& limits,
              unsigned jobs, bool progress) {
    return Search(errors, costs, kernels, limits, jobs).run(progress);
}

}  // namespace choose
