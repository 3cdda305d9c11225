#include "gap/drive/near_best.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/parallel.hpp"
#include "gap/drive/jitter.hpp"

namespace gap {
namespace {

using Effects = std::vector<const Effect*>;

constexpr std::size_t most_rivals = 3;

// Whether a special case of a candidate is known that leaves about as much in training. One that leaves more may have
// stayed where it was begun, with a base that the wider law has moved on from.
bool is_known_as_good(const Found& found, const Effects& effects, const Candidate& general) {
    constexpr double about = 1.2;  // of the cost: a tenth of the gap
    return std::any_of(found.ranking.begin(), found.ranking.end(), [&](const Ranked& ranked) {
        return std::ranges::is_permutation(ranked.trained.effects, effects) &&
               ranked.trained.cost < about * general.cost;
    });
}

// The best of a size by its own laws: neither steps nor spread of the readings are among them.
const Ranked* plain_best_of(const Found& found, std::size_t size) {
    const auto best = std::find_if(found.ranking.begin(), found.ranking.end(), [&](const Ranked& ranked) {
        return ranked.trained.effects.size() == size && !ranked.trained.any(&Effect::only_spreads) &&
               !ranked.trained.any(&Effect::rounds);
    });
    return best == found.ranking.end() ? nullptr : &*best;
}

bool is_looked_for(const Ground& ground, const std::string& name) {
    return std::ranges::any_of(ground.list, [&](const Effect* effect) { return effect->name == name; });
}

// The best with one of its effects as what it only is, from the numbers that say so.
Candidate with_only(const Study& study, const Candidate& best, std::size_t i, const Special& special) {
    const Effect& effect = effect_named(special.effect);
    Candidate simpler = best;
    simpler.effects[i] = &effect;
    const auto at = simpler.lasting.begin() + (best.numbers_of(best.effects[i]) - best.lasting.data());
    *at = parameters_of(effect, study.scales, 0);
    for (std::size_t k = 0; k < at->size(); ++k) {
        (*at)[k].value = std::clamp(special.values[k], (*at)[k].lower, (*at)[k].upper);
    }
    return simpler;
}

// Numbers that stay where they start say which variant of an effect it is.
bool are_one_variant(const std::vector<FreeParameter>& a, const std::vector<FreeParameter>& b) {
    return std::ranges::equal(a, b, [](const FreeParameter& mine, const FreeParameter& other) {
        return mine.fixed == other.fixed && (!mine.fixed || mine.value == other.value);
    });
}

}  // namespace

bool nested(const Effects& mine, const Effect& other) {
    return std::any_of(mine.begin(), mine.end(),
                       [&](const Effect* effect) { return effect->covers(other) || other.covers(*effect); });
}

std::vector<Candidate> narrowed(const Neighbourhood& near, std::size_t size) {
    const Candidate& best = near.found.best_of(size).trained;
    std::vector<Candidate> narrower(best.effects.size());
    base::parallel_for(narrower.size(), near.of.jobs, [&](std::size_t i) {
        Effects fewer = best.effects;
        fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
        narrower[i] = fit(near.of.ground.study, fewer, best, near.fits_by);
    });
    return narrower;
}

std::vector<Candidate> simplified(const Neighbourhood& near, std::size_t size) {
    const Candidate& best = near.found.best_of(size).trained;
    struct Begun {
        Effects effects;
        Candidate start;
    };
    std::vector<Begun> simpler;
    for (std::size_t i = 0; i < best.effects.size(); ++i) {
        if (const std::optional<Special> only = best.only(best.effects[i]);
            only && !best.has(only->effect) && is_looked_for(near.of.ground, only->effect)) {
            Candidate start = with_only(near.of.ground.study, best, i, *only);
            simpler.push_back({start.effects, start});
        }
        for (const Effect* special : near.of.ground.list) {
            Effects effects = best.effects;
            effects[i] = special;
            if (best.effects[i]->covers(*special) && !best.has(special->name) &&
                !is_known_as_good(near.found, effects, best)) {
                simpler.push_back({std::move(effects), best});
            }
        }
    }
    std::vector<Candidate> fitted(simpler.size());
    base::parallel_for(simpler.size(), near.of.jobs, [&](std::size_t i) {
        fitted[i] = fit(near.of.ground.study, simpler[i].effects, simpler[i].start, near.fits_by);
    });
    return fitted;
}

std::vector<Candidate> variants(const Neighbourhood& near, std::size_t size) {
    constexpr double untold = 1.02;  // of the cost: of thousands of slow samples half a unit of likelihood
    const Study& study = near.of.ground.study;
    const Candidate& best = near.found.best_of(size).trained;
    struct Begun {
        const Candidate* start;
        Effects effects;
        std::size_t at;
    };
    std::vector<Begun> other;
    for (const Effect* effect : best.effects) {
        const std::vector<FreeParameter>* numbers = best.numbers_of(effect);
        Begun begun{nullptr, best.effects, 0};
        std::erase(begun.effects, effect);
        // From where it is not there yet: the base has bent to the variant that it was fitted with.
        const auto without = std::ranges::find_if(near.found.ranking, [&](const Ranked& ranked) {
            return std::ranges::is_permutation(ranked.trained.effects, begun.effects);
        });
        if (numbers == nullptr || without == near.found.ranking.end()) {
            continue;
        }
        begun.start = &without->trained;
        begun.effects.push_back(effect);
        for (; begun.at < starts_of(*effect, study.scales); ++begun.at) {
            if (!are_one_variant(parameters_of(*effect, study.scales, begun.at), *numbers)) {
                other.push_back(begun);
            }
        }
    }
    std::vector<Candidate> fitted(other.size());
    base::parallel_for(other.size(), near.of.jobs, [&](std::size_t i) {
        Effort effort;
        effort.first_iterations = 12;  // it begins far away
        effort.only_start = other[i].at;
        fitted[i] = fit(study, other[i].effects, *other[i].start, near.fits_by, effort);
    });
    std::erase_if(fitted, [&](const Candidate& one) { return !(weighed_cost(one) <= untold * weighed_cost(best)); });
    return fitted;
}

std::vector<Candidate> rivals(const Neighbourhood& near, std::size_t size) {
    const Candidate& best = near.found.best_of(size).trained;
    std::vector<Effects> all;
    for (std::size_t i = 0; i < best.effects.size(); ++i) {
        for (const Effect* other : near.of.ground.list) {
            Effects effects = best.effects;
            effects[i] = other;
            if (best.effects[i]->kind == Kind::lasting && other->kind == Kind::lasting &&
                other->place == best.effects[i]->place && !other->only_spreads && !other->rounds &&
                !best.has(other->name) && !nested({best.effects[i]}, *other)) {
                all.push_back(std::move(effects));
            }
        }
    }
    if (all.empty()) {
        return {};
    }
    near.of.say(fmt::format("fitting {} rivals", all.size()));
    std::vector<Candidate> close(all.size());
    base::parallel_for(all.size(), near.of.jobs, [&](std::size_t i) {
        close[i] = fit(near.of.ground.sketch, all[i], best, near.fits_by, quick);
    });
    std::ranges::stable_sort(close, {}, &Candidate::cost);
    close.resize(std::min(close.size(), most_rivals));
    // Twice: from where the first look ended, and from the best one's base, whose numbers training may leave open.
    const std::size_t apart = close.size();
    for (std::size_t i = 0; i < apart; ++i) {
        close.push_back(close[i]);
        close.back().base = best.base;
        close.back().own = best.own;
    }
    base::parallel_for(close.size(), near.of.jobs, [&](std::size_t i) {
        close[i] = fit(near.of.ground.study, close[i].effects, close[i], near.fits_by);
    });
    return close;
}

std::vector<Candidate> with_steps(const Neighbourhood& near) {
    std::vector<Candidate> stepped;
    for (const Effect* effect : near.of.ground.list) {
        for (std::size_t size = 1; effect->rounds && size <= 2; ++size) {
            if (const Ranked* best = plain_best_of(near.found, size); best != nullptr) {
                Effects wider = best->trained.effects;
                wider.push_back(effect);
                stepped.push_back(fit(near.of.ground.study, wider, best->trained, near.fits_by));
            }
        }
    }
    return stepped;
}

std::vector<Candidate> with_jitter(const Neighbourhood& near) {
    const auto jitter = std::find_if(near.of.ground.list.begin(), near.of.ground.list.end(),
                                     [](const Effect* effect) { return effect->only_spreads; });
    std::vector<Candidate> wide;
    for (std::size_t size = 1; jitter != near.of.ground.list.end() && size <= 2; ++size) {
        const Ranked* best = plain_best_of(near.found, size);
        if (best == nullptr) {
            continue;
        }
        Candidate both = best->trained;
        both.effects.push_back(*jitter);
        both.lasting.push_back(parameters_of(**jitter, near.of.ground.study.scales, 0));
        fit_jitter(near.of.ground.study, both, near.found.whitener);
        wide.push_back(std::move(both));
    }
    return wide;
}

}  // namespace gap
