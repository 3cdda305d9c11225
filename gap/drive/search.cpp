#include "gap/drive/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/parallel.hpp"
#include "gap/drive/jitter.hpp"
#include "gap/drive/near_best.hpp"
#include "gap/drive/settle.hpp"
#include "gap/drive/shortlist.hpp"

namespace gap {
namespace {

using Effects = std::vector<const Effect*>;

constexpr std::size_t shortlisted = 14;  // singles that are refitted whitened
constexpr double hopeless_beside_a_form = 0.97;
constexpr double too_far = 4.0;  // from the best single's cost
constexpr double worth_pairs = 0.5 * clear_advantage;
constexpr double worth_fits = 4.0;   // over what differs from sample to sample
constexpr double hopeless = 0.9995;  // of the cost without an effect: a unit of likelihood of 4000 samples

bool by_cost(const Candidate& a, const Candidate& b) { return a.cost < b.cost; }
bool by_score(const Ranked& a, const Ranked& b) { return a.score() > b.score(); }

class Run {
public:
    explicit Run(const Search& of) : of_(of) {}

    Found search() {
        of_.say(fmt::format("fitting the base: {} record{}", of_.ground.study.courses.size(),
                            of_.ground.study.courses.size() == 1 ? "" : "s"));
        const Candidate sketched = fit(of_.ground.sketch, {}, {}, nullptr, {6, 2, 60});
        none_ = fit(of_.ground.study, {}, sketched, nullptr);
        of_.say(fmt::format("fitting {} effects, each alone", of_.ground.list.size()));
        std::vector<Effects> alone;
        for (const Effect* effect : of_.ground.list) {
            alone.push_back({effect});
        }
        std::vector<Candidate> singles = fitted(alone, {&sketched}, nullptr, first_effort(sketched.cost));
        std::stable_sort(singles.begin(), singles.end(), by_cost);
        found_.whitener =
            whitener_of(of_.ground.study, singles.empty() || none_.cost <= singles[0].cost ? none_ : singles[0]);
        none_ = fit(of_.ground.study, {}, none_, fits_by());
        base::parallel_for(singles.size(), of_.jobs, [&](std::size_t i) {
            // Spread is not in the sum of squares: jitter stays in the race whatever its place.
            const bool far = of_.ground.study.base.refit && singles[i].cost > too_far * singles.front().cost;
            const bool near = (i < shortlisted && !far) || singles[i].any(&Effect::only_spreads);
            singles[i] = fit(of_.ground.study, singles[i].effects, singles[i], fits_by(),
                             {0, 1, near ? Effort{}.iterations : 0});
            fit_jitter(of_.ground.study, singles[i], found_.whitener);
        });
        of_.say("judging them by what was not fitted");
        take({none_});
        take(singles);
        renew_whitener();
        const Ranked& none = ranked_of({});
        const Ranked& best = found_.ranking.front();
        const bool slow = is_slow(of_.ground.validation, none.gap_after * output_deviation(of_.ground.validation));
        if ((&best != &none && advantage(best, none).mean > worth_pairs) || slow || quantum_shows()) {
            const std::vector<Candidate> pairs = widened(1, "pairs");
            take(pairs);
            renew_whitener();
            if (fits_by() != nullptr && found_.has_sized(2)) {
                take(again(2));
                renew_whitener();
            }
            // Fits of many numbers end at different places: a single that began elsewhere may go as far as its pair.
            if (of_.ground.study.base.refit && found_.has_sized(2)) {
                take(narrowed(near(), 2));
                renew_whitener();
            }
            if (worth_more(found_.ranking.front()) && found_.has_sized(2)) {
                take(exchanged());
                renew_whitener();
            }
            // One more as long as the best of all has as many as were tried, each without each of its own.
            for (std::size_t size = 2;
                 size < most_effects_beside(of_.ground.study.base) &&
                 found_.ranking.front().candidate.effects.size() == size &&
                 advantage(found_.ranking.front(), found_.best_of(size - 1)).mean > clear_advantage;
                 ++size) {
                take(widened(size, fmt::format("sets of {}", size + 1)));
                renew_whitener();
                if (found_.has_sized(size + 1)) {
                    take(narrowed(near(), size + 1));
                    renew_whitener();
                }
            }
        }
        // Named is mostly a single or a pair, though wider sets that follow the rest lead.
        const std::size_t leading = found_.ranking.front().trained.effects.size();
        for (const std::size_t size : std::set<std::size_t>{leading, 1, 2}) {
            if (of_.ground.study.base.refit && size > 0 && size <= leading && found_.has_sized(size)) {
                take(rivals(near(), size));
                renew_whitener();
            }
        }
        for (std::size_t size = 1; of_.ground.study.base.refit && found_.has_sized(size); ++size) {
            take(simplified(near(), size));
            take(variants(near(), size));
        }
        if (of_.ground.study.base.refit && quantum_shows()) {
            take(with_steps(near()));
        }
        take(with_jitter(near()));
        std::stable_sort(found_.ranking.begin(), found_.ranking.end(), by_score);
        return std::move(found_);
    }

private:
    [[nodiscard]] Neighbourhood near() const { return {of_, found_, fits_by()}; }
    // Beside a fitted base each fit has more numbers, and a coarse one is enough to be judged by: the finest is fitted
    // last.
    [[nodiscard]] Effort first_effort(double without) const {
        return of_.ground.study.base.refit ? Effort{4, 1, 9, hopeless_beside_a_form * without}
                                           : Effort{6, 2, 25, hopeless * without};
    }

    // A refitted base is to simulate well: it takes its numbers from the residuals as they are. Where they are coloured
    // because something is missing, whitened ones would tell little of what is slow.
    [[nodiscard]] const Whitener* fits_by() const { return of_.ground.study.base.refit ? nullptr : &found_.whitener; }

    // On the coarse grid, each from the candidate of `starts` at its place, or from the only one.
    std::vector<Candidate> fitted(const std::vector<Effects>& all, const std::vector<const Candidate*>& starts,
                                  const Whitener* whitener, const Effort& effort) const {
        std::vector<Candidate> result(all.size());
        base::parallel_for(all.size(), of_.jobs, [&](std::size_t i) {
            result[i] = fit(of_.ground.sketch, all[i], *starts[starts.size() == 1 ? 0 : i], whitener, effort);
        });
        return result;
    }

    // Whether the best so far leaves more than noise, and further fits are cheap: a refitted base makes each several
    // times as long.
    [[nodiscard]] bool worth_more(const Ranked& best) const {
        const Study& validation = of_.ground.validation;
        return !validation.base.refit &&
               over_noise(validation, best.gap_after * output_deviation(validation)) > worth_fits;
    }

    // The best candidates of some size with one effect more.
    std::vector<Candidate> widened(std::size_t size, const std::string& what) const {
        std::vector<const Candidate*> first;
        const bool more = size == 1 && worth_more(found_.ranking.front());
        for (const Ranked* lead : leads_of(found_.ranking, size, more, quantum_shows())) {
            first.push_back(&lead->trained);
        }
        return with_one_more(first, what);
    }

    // Of the best pair each alone, as it is there, with any other: what leads alone may be a stand-in for both.
    std::vector<Candidate> exchanged() const {
        const Candidate& pair = found_.best_of(2).trained;
        std::vector<Candidate> halves;
        for (const Effect* effect : pair.effects) {
            halves.push_back(fit(of_.ground.sketch, {effect}, pair, fits_by(), {0, 1, 0}));
        }
        return with_one_more({&halves[0], &halves[1]}, "exchanges");
    }

    // The best of a size once more: what was whitened by a single effect's residuals was fitted to those of the single.
    std::vector<Candidate> again(std::size_t size) const {
        constexpr std::size_t most = 3;
        std::vector<const Candidate*> best;
        for (const Ranked& ranked : found_.ranking) {
            if (ranked.trained.effects.size() == size && best.size() < most) {
                best.push_back(&ranked.trained);
            }
        }
        std::vector<Candidate> fitted(best.size());
        base::parallel_for(best.size(), of_.jobs, [&](std::size_t i) {
            fitted[i] = fit(of_.ground.study, best[i]->effects, *best[i], fits_by());
        });
        return fitted;
    }

    // All of them quickly, the best to the end.
    std::vector<Candidate> with_one_more(const std::vector<const Candidate*>& first, const std::string& what) const {
        std::vector<Effects> all;
        std::vector<const Candidate*> starts;
        std::set<Effects> seen;
        for (const Candidate* lead : first) {
            for (const Effect* effect : of_.ground.list) {
                Effects wider = lead->effects;
                wider.push_back(effect);
                Effects key = wider;
                std::sort(key.begin(), key.end());
                if (!effect->only_spreads && !(effect->rounds && !quantum_shows()) && !is_of_another_model(wider) &&
                    !lead->any(&Effect::only_spreads) && !lead->has(effect->name) && !nested(lead->effects, *effect) &&
                    seen.insert(key).second) {
                    all.push_back(wider);
                    starts.push_back(lead);
                }
            }
        }
        of_.say(fmt::format("fitting {} {}", all.size(), what));
        std::vector<Candidate> wide = fitted(all, starts, fits_by(), quick);
        std::stable_sort(wide.begin(), wide.end(), by_cost);
        keep_finalists(wide, of_.ground.study.base.refit);
        base::parallel_for(wide.size(), of_.jobs, [&](std::size_t i) {
            wide[i] = fit(of_.ground.study, wide[i].effects, wide[i], fits_by());
        });
        return wide;
    }

    // Readings of most logs are multiples of a step: a cause of the gap only where it makes a tenth of its rms.
    [[nodiscard]] bool quantum_shows() const {
        const double rounding = of_.ground.study.scales.quantum / std::sqrt(12.0);
        return rounding > 0.1 * ranked_of({}).gap_after * output_deviation(of_.ground.validation);
    }

    // What was deployed is a simulation of the model that is given: beside an effect that makes it another one its
    // error is not that one's, and would have to be simulated anew, at the square of its steps, wherever a fit looks.
    [[nodiscard]] bool is_of_another_model(const Effects& wanted) const {
        Scenario probe;
        probe.model = model_of(of_.ground.study.base.form);
        const drive::Model given = probe.model;
        for (const Effect* effect : wanted) {
            std::vector<double> values;
            for (const EffectParameter& parameter : effect->parameters(of_.ground.study.scales)) {
                values.push_back(parameter.starts.front());
            }
            effect->add_to(probe, values);
        }
        const auto same = [](const drive::Term& a, const drive::Term& b) {
            return a.coefficient == b.coefficient && a.order == b.order;
        };
        return probe.deployed && (probe.model.delay_s != given.delay_s || probe.model.gain != given.gain ||
                                  !std::ranges::equal(probe.model.denominator, given.denominator, same));
    }

    void take(const std::vector<Candidate>& candidates) {
        std::vector<Ranked> more(candidates.size());
        base::parallel_for(candidates.size(), of_.jobs, [&](std::size_t i) {
            const bool untold = of_.ground.study.base.refit && !of_.ground.same_records;
            const Settled settled =
                untold ? settle(of_.ground.study, of_.ground.validation, candidates[i]) : Settled{candidates[i]};
            more[i] = validated(of_.ground.validation, settled.trained, found_.whitener, fits_by(),
                                of_.ground.same_records, settled.numbers);
        });
        std::move(more.begin(), more.end(), std::back_inserter(found_.ranking));
        std::stable_sort(found_.ranking.begin(), found_.ranking.end(), by_score);
        // Of the same effects, reached from several starts, the best.
        std::set<Effects> seen;
        std::erase_if(found_.ranking, [&](const Ranked& ranked) {
            Effects key = ranked.trained.effects;
            std::sort(key.begin(), key.end());
            return !seen.insert(key).second;
        });
    }

    // The whitener of the best one's training residuals; likelihoods follow.
    void renew_whitener() {
        found_.whitener = whitener_of(of_.ground.study, found_.ranking.front().trained);
        if (of_.ground.study.base.refit && found_.whitener.is_slow()) {
            // What leads with a slow misfit hides how often there is anything new in the records.
            const auto closest =
                std::min_element(found_.ranking.begin(), found_.ranking.end(),
                                 [](const Ranked& a, const Ranked& b) { return a.trained.cost < b.trained.cost; });
            found_.whitener.samples_apart =
                std::min(found_.whitener.samples_apart, whitener_of(of_.ground.study, closest->trained).samples_apart);
        }
        for (Ranked& ranked : found_.ranking) {
            judge(ranked, of_.ground.validation, found_.whitener);
        }
        std::stable_sort(found_.ranking.begin(), found_.ranking.end(), by_score);
    }

    [[nodiscard]] const Ranked& ranked_of(const Effects& effects) const {
        return *std::find_if(found_.ranking.begin(), found_.ranking.end(),
                             [&](const Ranked& ranked) { return ranked.trained.effects == effects; });
    }
    const Search& of_;
    Candidate none_;
    Found found_;
};

}  // namespace

bool Found::has_sized(std::size_t size) const {
    return std::any_of(ranking.begin(), ranking.end(),
                       [&](const Ranked& ranked) { return ranked.trained.effects.size() == size; });
}

const Ranked& Found::best_of(std::size_t size) const {
    return *std::find_if(ranking.begin(), ranking.end(),
                         [&](const Ranked& ranked) { return ranked.trained.effects.size() == size; });
}

Found search(const Search& of) { return Run(of).search(); }

}  // namespace gap
