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
// A kernel that is known to be costly is tried at this length first.
constexpr std::size_t short_taps = 64;

// One search: the kernels' fates grow as errors, then costs become known.
class Search {
public:
    Search(ErrorSource& errors, CostSource& costs, const std::vector<std::string>& kernels, const Limits& limits,
           unsigned jobs)
        : errors_(errors), costs_(costs), limits_(limits), jobs_(jobs) {
        for (const std::string& kernel : kernels) {
            choice_.kernels.push_back(
                {.kernel = kernel, .standing = Standing::wrong, .best = {}, .short_of = {}, .already = {}, .why = {}});
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
        std::vector<std::string> kernels;
        for (const Outcome& outcome : choice_.kernels) {
            kernels.push_back(outcome.kernel);
        }
        const std::vector<std::size_t> turns = turns_of(errors_, kernels);
        base::parallel_for(turns.size(), jobs_, [&](std::size_t i) {
            find_length(choice_.kernels[turns[i]]);
            if (progress) {
                progress->advance();
            }
        });
    }

    void find_length(Outcome& outcome) {
        if (const auto lengths = errors_.lengths(outcome.kernel)) {
            take(outcome, reach_of(errors_, outcome.kernel, *lengths, limits_.max_error));
        } else {
            take(outcome, reach(errors_, outcome.kernel, limits_.max_error));
        }
    }

    void take(Outcome& outcome, const Reach& reach) {
        if (reach.shortest) {
            outcome.best = at(outcome.kernel, *reach.shortest);
        } else if (reach.best.fault.empty()) {
            outcome.standing = Standing::inaccurate;
            outcome.short_of = {outcome.kernel, reach.best_taps, reach.best, {}};
        } else {
            outcome.why = reach.best.fault;
        }
    }

    Candidate at(const std::string& kernel, std::size_t taps) {
        return {kernel, taps, errors_.error(kernel, taps), {}};
    }

    // The least cost of what fits so far.
    [[nodiscard]] double least() const {
        double least = std::numeric_limits<double>::infinity();
        for (const Outcome& outcome : choice_.kernels) {
            if (outcome.best && !outcome.already && fits(*outcome.best, limits_)) {
                least = std::min(least, outcome.best->cost.value);
            }
        }
        return least;
    }

    void find_costs() {
        std::vector<Candidate*> now;
        std::vector<Outcome*> costly;
        for (Outcome& outcome : choice_.kernels) {
            if (outcome.best && costs_.costly(outcome.kernel) && outcome.best->taps > short_taps) {
                outcome.already = Candidate{outcome.kernel, short_taps, {}, {}};
                now.push_back(&*outcome.already);
                costly.push_back(&outcome);
            } else if (outcome.best) {
                now.push_back(&*outcome.best);
            }
        }
        measure(costs_, now);
        const double so_far = least();
        now.clear();
        for (Outcome* outcome : costly) {
            const Cost& cost = outcome->already->cost;
            if (!cost.fault.empty() || (cost.value <= so_far && within(limits_.max_cost, cost.limited))) {
                outcome->already.reset();
                now.push_back(&*outcome->best);
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
        for (const Outcome& outcome : choice_.kernels) {
            const double group = group_cost + (costs_.costly(outcome.kernel) ? dear_share * so_far : 0.0);
            if (!outcome.best || outcome.already || outcome.best->cost.value > so_far + group) {
                continue;
            }
            for (std::size_t i = 1; i <= group_taps && outcome.best->taps + i <= errors_.longest_of(outcome.kernel);
                 ++i) {
                const std::size_t taps = outcome.best->taps + i;
                if (errors_.meets(outcome.kernel, taps, limits_.max_error)) {
                    longer.push_back(at(outcome.kernel, taps));
                }
            }
        }
        std::vector<Candidate*> now;
        for (Candidate& candidate : longer) {
            now.push_back(&candidate);
        }
        measure(costs_, now);
        for (const Candidate& candidate : longer) {
            for (Outcome& outcome : choice_.kernels) {
                if (outcome.kernel != candidate.kernel || !candidate.cost.fault.empty()) {
                    continue;
                }
                const bool fits_now = fits(candidate, limits_);
                const bool fitted = fits(*outcome.best, limits_);
                if (fits_now != fitted ? fits_now : better(candidate, *outcome.best)) {
                    outcome.best = candidate;
                }
            }
        }
    }

    void judge() {
        Outcome* first = nullptr;
        Outcome* second = nullptr;
        for (Outcome& outcome : choice_.kernels) {
            if (!outcome.best || outcome.already || !fits(*outcome.best, limits_)) {
                continue;
            }
            if (first == nullptr || better(*outcome.best, *first->best)) {
                second = first;
                first = &outcome;
            } else if (second == nullptr || better(*outcome.best, *second->best)) {
                second = &outcome;
            }
        }
        for (Outcome& outcome : choice_.kernels) {
            if (outcome.best) {
                outcome.standing = &outcome == first    ? Standing::chosen
                                   : &outcome == second ? Standing::runner_up
                                                        : fate_of(outcome);
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

    Standing fate_of(Outcome& outcome) {
        if (outcome.already) {
            return within(limits_.max_cost, outcome.already->cost.limited) ? Standing::costlier : Standing::too_costly;
        }
        if (!outcome.best->cost.fault.empty()) {
            outcome.why = outcome.best->cost.fault;
            return Standing::wrong;
        }
        if (!within(limits_.max_cost, outcome.best->cost.limited)) {
            return Standing::too_costly;
        }
        if (!within(limits_.max_bytes, outcome.best->cost.bytes)) {
            return Standing::too_large;
        }
        for (const Outcome& other : choice_.kernels) {
            if (&other != &outcome && other.best && !other.already && fits(*other.best, limits_) &&
                dominates(*other.best, *outcome.best)) {
                outcome.why = "by " + other.kernel;
                return Standing::dominated;
            }
        }
        return Standing::costlier;
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
