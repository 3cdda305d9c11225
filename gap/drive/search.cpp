#include "gap/drive/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/parallel.hpp"
#include "gap/drive/jitter.hpp"
#include "gap/drive/settle.hpp"

namespace gap {
namespace {

using Effects = std::vector<const Effect*>;

constexpr std::size_t shortlisted = 14;  // singles that are refitted whitened
constexpr std::size_t leads = 2;         // by validation, and as many by training: what partners are tried with
constexpr std::size_t more_leads = 5;    // where none of them leaves noise alone
constexpr std::size_t finalists_of_a_lead_beside_a_form = 2;
constexpr std::size_t eventful_finalists_beside_a_form = 2;
constexpr double hopeless_beside_a_form = 0.97;
constexpr double too_far = 4.0;       // from the best single's cost
constexpr std::size_t finalists = 8;  // pairs, and triples, that are fitted to the end
constexpr std::size_t most_rivals = 3;
constexpr Effort effects_alone{0, 1, 0};
constexpr Effort quick{3, 1, 6};
// Real rigs have several causes at once; beside a model that is given more than three are an expansion of something
// else.
constexpr std::size_t most_beside_a_form = 4;
constexpr std::size_t most_beside_a_model = 3;
std::size_t most_effects_of(const Study& study) { return study.base.refit ? most_beside_a_form : most_beside_a_model; }
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
        if ((&best != &none && advantage(best, none).mean > 4.0) || slow || quantum_shows()) {
            const std::vector<Candidate> pairs = widened(1, "pairs");
            take(pairs);
            renew_whitener();
            if (fits_by() != nullptr && has_sized(2)) {
                take(again(2));
                renew_whitener();
            }
            // Fits of many numbers end at different places: a single that began elsewhere may go as far as its pair.
            if (of_.ground.study.base.refit && has_sized(2)) {
                take(narrowed(2));
                renew_whitener();
            }
            if (worth_more(found_.ranking.front()) && has_sized(2)) {
                take(exchanged());
                renew_whitener();
            }
            // One more as long as the best of all has as many as were tried, each without each of its own.
            for (std::size_t size = 2;
                 size < most_effects_of(of_.ground.study) && found_.ranking.front().candidate.effects.size() == size &&
                 advantage(found_.ranking.front(), best_of(size - 1)).mean > 8.0;
                 ++size) {
                take(widened(size, fmt::format("sets of {}", size + 1)));
                renew_whitener();
                if (has_sized(size + 1)) {
                    take(narrowed(size + 1));
                    renew_whitener();
                }
            }
        }
        if (of_.ground.study.base.refit && !found_.ranking.front().trained.effects.empty()) {
            take(rivals());
            renew_whitener();
        }
        for (std::size_t size = 2; of_.ground.study.base.refit && has_sized(size); ++size) {
            take(simplified(size));
        }
        if (of_.ground.study.base.refit && quantum_shows()) {
            take(with_steps());
        }
        take(with_jitter());
        std::stable_sort(found_.ranking.begin(), found_.ranking.end(), by_score);
        return std::move(found_);
    }

private:
    // Beside a fitted base each fit has more numbers, and a coarse one is enough to be judged by: the finest is fitted
    // last.
    [[nodiscard]] Effort first_effort(double without) const {
        return of_.ground.study.base.refit ? Effort{4, 1, 9, hopeless_beside_a_form * without}
                                           : Effort{6, 2, 25, hopeless * without};
    }
    // Beside a form the best ones of each lead: what follows any misfit (a delay that swings, and events, which are
    // located in each record) would fill the list. \param sets  the best first, each a lead's effects and one more
    void keep_finalists(std::vector<Candidate>& sets) const {
        if (!of_.ground.study.base.refit) {
            sets.resize(std::min(sets.size(), finalists));
            return;
        }
        std::map<Effects, std::size_t> lasting;
        std::size_t eventful = 0;
        std::erase_if(sets, [&](const Candidate& set) {
            const Effects lead(set.effects.begin(), set.effects.end() - 1);
            return set.has_events() ? ++eventful > eventful_finalists_beside_a_form
                                    : ++lasting[lead] > finalists_of_a_lead_beside_a_form;
        });
    }

    // That readings are multiples of a coarse step is seen, not guessed: it is asked for beside the best of each size,
    // whatever squares it has at the start, since a sum of squares has a jump wherever a reading takes the next step.
    [[nodiscard]] std::vector<Candidate> with_steps() const {
        std::vector<Candidate> stepped;
        for (const Effect* effect : of_.ground.list) {
            for (std::size_t size = 1; effect->rounds && size <= 2 && has_sized(size); ++size) {
                const auto best = std::find_if(found_.ranking.begin(), found_.ranking.end(), [&](const Ranked& ranked) {
                    return ranked.trained.effects.size() == size && !ranked.trained.any(&Effect::rounds) &&
                           !ranked.trained.any(&Effect::only_spreads);
                });
                if (best != found_.ranking.end()) {
                    Effects wider = best->trained.effects;
                    wider.push_back(effect);
                    stepped.push_back(fit(of_.ground.study, wider, best->trained, fits_by()));
                }
            }
        }
        return stepped;
    }

    // Jitter moves no reading, so it changes no other effect's fit: it is asked for once, beside the best of each size.
    [[nodiscard]] std::vector<Candidate> with_jitter() const {
        const auto jitter = std::find_if(of_.ground.list.begin(), of_.ground.list.end(),
                                         [](const Effect* effect) { return effect->only_spreads; });
        std::vector<Candidate> wide;
        for (std::size_t size = 1; jitter != of_.ground.list.end() && size <= 2; ++size) {
            const auto best = std::find_if(found_.ranking.begin(), found_.ranking.end(), [&](const Ranked& ranked) {
                return ranked.trained.effects.size() == size && !ranked.trained.any(&Effect::only_spreads) &&
                       !ranked.trained.any(&Effect::rounds);
            });
            if (best == found_.ranking.end()) {
                continue;
            }
            Candidate both = best->trained;
            both.effects.push_back(*jitter);
            both.lasting.push_back(parameters_of(**jitter, of_.ground.study.scales, 0));
            fit_jitter(of_.ground.study, both, found_.whitener);
            wide.push_back(std::move(both));
        }
        return wide;
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

    [[nodiscard]] bool has_sized(std::size_t size) const {
        return std::any_of(found_.ranking.begin(), found_.ranking.end(),
                           [&](const Ranked& ranked) { return ranked.trained.effects.size() == size; });
    }

    // Whether the best so far leaves more than noise, and further fits are cheap: a refitted base makes each several
    // times as long.
    [[nodiscard]] bool worth_more(const Ranked& best) const {
        const Study& validation = of_.ground.validation;
        return !validation.base.refit && over_noise(validation, best.gap_after * output_deviation(validation)) > 4.0;
    }

    // The best candidates of some size with one effect more.
    std::vector<Candidate> widened(std::size_t size, const std::string& what) const {
        std::vector<const Candidate*> first;
        for (const Ranked* lead : leads_of(size)) {
            first.push_back(&lead->trained);
        }
        return with_one_more(first, what);
    }

    // Of the best pair each alone, as it is there, with any other: what leads alone may be a stand-in for both.
    std::vector<Candidate> exchanged() const {
        const Candidate& pair = best_of(2).trained;
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

    // The best of a size without one of its effects: what the last one brought about was perhaps only a better start,
    // and made one of the others superfluous.
    std::vector<Candidate> narrowed(std::size_t size) const {
        const Candidate& best = best_of(size).trained;
        std::vector<Candidate> narrower(best.effects.size());
        base::parallel_for(narrower.size(), of_.jobs, [&](std::size_t i) {
            Effects fewer = best.effects;
            fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
            narrower[i] = fit(of_.ground.study, fewer, best, fits_by());
        });
        return narrower;
    }

    // The best of a size with special cases in place of what covers them: of each lead few are fitted to the end, and
    // the wider one, which follows more, comes first.
    std::vector<Candidate> simplified(std::size_t size) const {
        const Candidate& best = best_of(size).trained;
        std::vector<Effects> simpler;
        for (std::size_t i = 0; i < best.effects.size(); ++i) {
            for (const Effect* special : of_.ground.list) {
                Effects effects = best.effects;
                effects[i] = special;
                if (best.effects[i]->covers(*special) && !best.has(special->name) && !is_known(effects)) {
                    simpler.push_back(std::move(effects));
                }
            }
        }
        std::vector<Candidate> fitted(simpler.size());
        base::parallel_for(simpler.size(), of_.jobs,
                           [&](std::size_t i) { fitted[i] = fit(of_.ground.study, simpler[i], best, fits_by()); });
        return fitted;
    }

    // Of the best set each effect exchanged for each that acts at its place, from where the best one stands: what looks
    // alike is not to lose because it began further away.
    std::vector<Candidate> rivals() const {
        const Candidate& best = found_.ranking.front().trained;
        std::vector<Effects> all;
        for (std::size_t i = 0; i < best.effects.size(); ++i) {
            for (const Effect* other : of_.ground.list) {
                Effects effects = best.effects;
                effects[i] = other;
                if (best.effects[i]->kind == Kind::lasting && other->kind == Kind::lasting &&
                    other->place == best.effects[i]->place && !other->only_spreads && !other->rounds &&
                    !best.has(other->name) && !nested({best.effects[i]}, *other)) {
                    all.push_back(std::move(effects));
                }
            }
        }
        of_.say(fmt::format("fitting {} rivals", all.size()));
        std::vector<Candidate> close = fitted(all, {&best}, fits_by(), quick);
        std::stable_sort(close.begin(), close.end(), by_cost);
        close.resize(std::min(close.size(), most_rivals));
        const std::size_t rivals = close.size();
        for (std::size_t i = 0; i < rivals; ++i) {
            close.push_back(close[i]);
            close.back().base = best.base;
        }
        // Twice: with a base of their own, and beside the best one's, of which training may leave some numbers open.
        base::parallel_for(close.size(), of_.jobs, [&](std::size_t i) {
            close[i] =
                fit(of_.ground.study, close[i].effects, close[i], fits_by(), i < rivals ? Effort{} : effects_alone);
        });
        return close;
    }

    [[nodiscard]] bool is_known(const Effects& effects) const {
        return std::any_of(found_.ranking.begin(), found_.ranking.end(), [&](const Ranked& ranked) {
            return std::ranges::is_permutation(ranked.trained.effects, effects);
        });
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
        keep_finalists(wide);
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

    // The best by what was not fitted, and those by what was.
    [[nodiscard]] std::vector<const Ranked*> leads_of(std::size_t size) const {
        std::vector<const Ranked*> sized;
        const bool steps_count = quantum_shows();
        for (const Ranked& ranked : found_.ranking) {
            if (ranked.trained.effects.size() == size && (steps_count || !ranked.trained.any(&Effect::rounds))) {
                sized.push_back(&ranked);
            }
        }
        std::vector<const Ranked*> by_training = sized;
        std::stable_sort(by_training.begin(), by_training.end(),
                         [](const Ranked* a, const Ranked* b) { return a->trained.cost < b->trained.cost; });
        const std::size_t wanted = size == 1 && worth_more(found_.ranking.front()) ? more_leads : leads;
        std::vector<const Ranked*> first;
        for (const auto* list : {&sized, &by_training}) {
            for (std::size_t i = 0; i < std::min(wanted, list->size()); ++i) {
                if (std::find(first.begin(), first.end(), (*list)[i]) == first.end()) {
                    first.push_back((*list)[i]);
                }
            }
        }
        return first;
    }

    static bool nested(const Effects& mine, const Effect& other) {
        return std::any_of(mine.begin(), mine.end(),
                           [&](const Effect* effect) { return effect->covers(other) || other.covers(*effect); });
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
    [[nodiscard]] const Ranked& best_of(std::size_t size) const {
        return *std::find_if(found_.ranking.begin(), found_.ranking.end(),
                             [&](const Ranked& ranked) { return ranked.trained.effects.size() == size; });
    }

    const Search& of_;
    Candidate none_;
    Found found_;
};

}  // namespace

Found search(const Search& of) { return Run(of).search(); }

}  // namespace gap
