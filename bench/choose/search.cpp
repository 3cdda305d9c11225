#include "bench/choose/search.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "bench/choose/relax.hpp"

namespace choose {
namespace {

// Where code of equal kind repeats in groups (of 2, 4, 8 taps), a slightly longer one can cost less, by no more than
// the rest of a group: so many instructions, so many taps.
constexpr double group_cost = 64.0;
constexpr std::size_t group_taps = 7;
// In software double the data decides too, and what the branch predictor makes of it: a tenth.
constexpr double dear_share = 0.1;
// A kernel that is known to be dear is tried at this length first.
constexpr std::size_t short_taps = 64;

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
            choice_.relaxed = relax(errors_, costs_, limits_, choice_.kernels);
        }
        return choice_;
    }

private:
    void find_lengths(bool shown) {
        std::optional<base::Progress> progress;
        if (shown) {
            progress.emplace("shortest lengths", choice_.kernels.size());
        }
        base::parallel_for(choice_.kernels.size(), jobs_, [&](std::size_t i) {
            find_length(choice_.kernels[i]);
            if (progress) {
                progress->advance();
            }
        });
    }

    void find_length(Fared& fared) {
        if (const auto lengths = errors_.lengths(fared.kernel)) {
            Reach reach;
            for (const std::size_t taps : *lengths) {
                const ErrorAt at = errors_.error(fared.kernel, taps);
                if (reach.best_taps == 0 || at.error < reach.best.error) {
                    reach.best_taps = taps;
                    reach.best = at;
                }
                if (at.fault.empty() && at.error <= limits_.max_error) {
                    reach.shortest = taps;
                    break;
                }
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
        measure(costs_, now);
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
            measure(costs_, now);
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
            const double group = group_cost + (costs_.dear(fared.kernel) ? dear_share * so_far : 0.0);
            if (!fared.best || fared.already || fared.best->cost.value > so_far + group) {
                continue;
            }
            for (std::size_t i = 1; i <= group_taps && fared.best->taps + i <= errors_.longest_of(fared.kernel); ++i) {
                const std::size_t taps = fared.best->taps + i;
                if (errors_.meets(fared.kernel, taps, limits_.max_error)) {
                    longer.push_back(at(fared.kernel, taps));
                }
            }
        }
        std::vector<Candidate*> now;
        for (Candidate& candidate : longer) {
            now.push_back(&candidate);
        }
        measure(costs_, now);
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

    ErrorSource& errors_;
    CostSource& costs_;
    Limits limits_;
    unsigned jobs_;
    Choice choice_;
};

}  // namespace

Choice choose(ErrorSource& errors, CostSource& costs, const std::vector<std::string>& kernels, const Limits& limits,
              unsigned jobs, bool progress) {
    return Search(errors, costs, kernels, limits, jobs).run(progress);
}

}  // namespace choose
