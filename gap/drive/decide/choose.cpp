// Which candidate, before it is asked what else there is.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "gap/drive/decide/rule.hpp"

namespace gap {
namespace {

constexpr std::size_t most_effects = 4;  // with rounded or uneven readings; a search without them may end before
// Of the gap's rms: less is too little to be anyone's trouble.
constexpr double first_share = 0.03;
// Beside a fitted form a first effect takes so much: less is another form's share.
constexpr double first_share_beside_a_form = 0.25;
// A further one takes so much of what can be closed, a second one that much of what is left instead: beside a gap as
// large as the output itself it may be small and still take most.
constexpr double further_share = 0.04;
constexpr double second_share = 0.25;
// But for a five-hundredth of what can be closed nobody looks: in readings without noise whatever repeats by itself, as
// a play's do, is as clear as a law.
constexpr double least_share = 0.002;
// Events, which are located where they are judged, follow any form's misfit: a further one takes half of what is left.
constexpr double further_share_of_an_event = 0.5;
// A cause is a law of a few numbers, and the drive's own is a little different: so much of the gap's rms, a fortieth of
// its squares, is what the law's shape leaves to whatever follows it.
constexpr double shape_of_a_law = 0.16;
// A shape may be a quarter off: friction falls with speed, say. What follows that takes a part of it, a cause half.
constexpr double widest_shape_of_a_law = 0.25;
constexpr double part_of_a_shape = 0.5;

// Whether all that a wider candidate has more are facts of the log: readings that are rounded, held or clipped.
bool adds_facts_alone(const Candidate& wider, const Candidate& narrower) {
    return std::all_of(wider.effects.begin(), wider.effects.end(), [&](const Effect* effect) {
        return narrower.has(effect->name) || (effect->uneven_noise && !effect->only_spreads);
    });
}

// What grows with time alone has no shape that the input shows again, nor follows one.
bool are_of_time(const Candidate& wider, const Candidate& narrower) {
    return std::ranges::all_of(narrower.effects, &Effect::of_time) ||
           std::ranges::all_of(wider.effects,
                               [&](const Effect* effect) { return narrower.has(effect->name) || effect->of_time; });
}

// Whether what is left beside a fitted form may be the shape of the laws that are taken, which a further one follows.
bool follows_a_shape(const Evidence& evidence, std::size_t wider, std::size_t chosen) {
    const Candidate& mine = evidence.ranking[chosen].trained;
    const Candidate& theirs = evidence.ranking[wider].trained;
    const double left = evidence.gap(chosen) / evidence.gap(evidence.none());
    const bool takes_a_part = evidence.gap(wider) > part_of_a_shape * evidence.gap(chosen);
    return evidence.beside_form() && !mine.effects.empty() &&
           (left < shape_of_a_law || (left < widest_shape_of_a_law && takes_a_part)) && goes_beyond(theirs, mine) &&
           !adds_facts_alone(theirs, mine) && !are_of_time(theirs, mine);
}

// What a fitted form leaves below what it may leave itself, however clean the readings, is no cause's but the log's.
bool is_all_the_forms(const Evidence& evidence, std::size_t wider, std::size_t chosen) {
    return evidence.beside_form() && evidence.gap(evidence.none()) < gap_without_causes &&
           !adds_facts_alone(evidence.ranking[wider].trained, evidence.ranking[chosen].trained);
}

// Laws that do next to nothing alone and much together cancel each other: so does an expansion of whatever is missing.
// Of real causes each goes its part of the way.
bool acts_only_together(const Evidence& evidence, std::size_t of) {
    constexpr double next_to_nothing = 0.9;  // of the gap's rms is left
    const std::vector<const Effect*>& effects = evidence.ranking[of].trained.effects;
    if (!evidence.beside_form() || effects.size() < 2) {
        return false;
    }
    bool tried = false;
    for (std::size_t i = 0; i < evidence.ranking.size(); ++i) {
        const std::vector<const Effect*>& alone = evidence.ranking[i].trained.effects;
        if (alone.size() == 1 && std::ranges::find(effects, alone.front()) != effects.end()) {
            tried = true;
            if (evidence.gap(i) < next_to_nothing * evidence.gap(evidence.none())) {
                return false;
            }
        }
    }
    return tried;
}

// Whether it is as likely without one of its effects: that one explains nothing, though training may not tell the
// numbers of what is left, so that it cannot be named.
bool has_an_idle_one(const Evidence& evidence, std::size_t of) {
    const Ranked& wide = evidence.ranking[of];
    return evidence.beside_form() && std::ranges::any_of(evidence.ranking, [&](const Ranked& ranked) {
               return !ranked.trained.effects.empty() && ranked.trained.effects.size() < wide.trained.effects.size() &&
                      ranked.score() >= wide.score() && contains(wide.trained, ranked.trained);
           });
}

// What is no set of causes, however far it goes.
bool is_no_set_of_causes(const Evidence& evidence, std::size_t wider, std::size_t chosen) {
    return is_all_the_forms(evidence, wider, chosen) || acts_only_together(evidence, wider) ||
           has_an_idle_one(evidence, wider) || follows_a_shape(evidence, wider, chosen);
}

bool has_an_event_of_the_plant(const Candidate& candidate) {
    return std::ranges::any_of(candidate.effects, [](const Effect* effect) {
        return effect->kind == Kind::event && effect->place == Place::plant;
    });
}

bool is_better(const Evidence& evidence, std::size_t wider, std::size_t chosen, double closable) {
    if (is_no_set_of_causes(evidence, wider, chosen)) {
        return false;
    }
    const double before = evidence.gap(chosen);
    const double taken = before - evidence.gap(wider);
    const std::size_t so_far = evidence.ranking[chosen].trained.effects.size();
    const double of_first = evidence.beside_form() ? first_share_beside_a_form : first_share;
    const double of_second = std::clamp(second_share * before, least_share * closable, further_share * closable);
    const double material = so_far == 0 ? of_first * before : so_far == 1 ? of_second : further_share * closable;
    // And where the form may leave as much itself there is nothing for it to explain, but for readings that jump from
    // one to the next, as no plant does: those show by themselves.
    const Candidate& wide = evidence.ranking[wider].trained;
    const bool small = before < small_gap_of_a_form;
    if (evidence.beside_form() && wide.has_events() && !evidence.ranking[chosen].trained.has_events() &&
        ((small && has_an_event_of_the_plant(wide)) ||
         ((small || so_far > 0) && taken < further_share_of_an_event * before))) {
        return false;
    }
    return is_clear(advantage(evidence.ranking[wider], evidence.ranking[chosen])) && taken > material;
}

// What cannot be named and yet goes most of the way, as likely as any, is more than nothing.
std::optional<std::size_t> goes_most_of_the_way(const Evidence& evidence, const Decision& decision) {
    constexpr double most = 0.5;
    if (evidence.is_small_of_a_form(decision.base_gap)) {
        return std::nullopt;
    }
    const auto found = std::find_if(evidence.ranking.begin(), evidence.ranking.end(), [&](const Ranked& one) {
        return one.score() > evidence.ranking.front().score() - clear_advantage &&
               one.gap_after < most * decision.base_gap;
    });
    if (found == evidence.ranking.end()) {
        return std::nullopt;
    }
    return static_cast<std::size_t>(found - evidence.ranking.begin());
}

// What is clear over what was taken, by two steps of which the first alone was not, has its second chosen among some
// dozens, and not among their pairs: chance does not reach half of what it needs.
bool beats_narrower(const Ranked& wider, const Ranked& narrower, bool was_taken) {
    const Interval by = advantage(wider, narrower);
    return was_taken ? is_clear(by) : by.mean > 0.5 * clear_advantage && by.low > 0.0;
}

void choose(const Evidence& evidence, Decision& decision) {
    const std::size_t none = evidence.none();
    decision.base_gap = evidence.gap(none);
    decision.chosen = none;
    decision.noise_floor = decision.base_gap;
    for (const Ranked& ranked : evidence.ranking) {
        // Of those that are as likely as any: others may follow noise.
        if (ranked.score() > evidence.ranking.front().score() - clear_advantage) {
            decision.noise_floor = std::min(decision.noise_floor, ranked.gap_after);
        }
    }
    const double closable = decision.base_gap - decision.noise_floor;
    for (std::size_t size = 1; size <= most_effects; ++size) {
        const auto wider = evidence.best_of(size);
        // The best with one effect less may have been too small a step to be taken; it must be beaten all the same.
        if (const auto narrower = evidence.best_of(size - 1);
            wider && is_better(evidence, *wider, decision.chosen, closable) &&
            (!narrower ||
             beats_narrower(evidence.ranking[*wider], evidence.ranking[*narrower], *narrower == decision.chosen))) {
            decision.chosen = *wider;
        }
    }
    if (decision.chosen != none) {
        decision.outcome = Outcome::attributed;
        decision.effects = {decision.chosen};
        return;
    }
    if (const auto most = goes_most_of_the_way(evidence, decision); most && evidence.beside_form()) {
        decision.outcome = Outcome::unknown;
        decision.confidence = 0.7;
        const std::string& objection = evidence.objection(*most);
        decision.notes.push_back(fmt::format("{} would bring the gap to {:.4f}, but {}",
                                             evidence.ranking[*most].trained.name(), evidence.gap(*most),
                                             objection.empty() ? "is not clearly more likely than none" : objection));
        return;
    }
    decision.outcome = Outcome::no_gap;
    // How near the best effect came to being named.
    constexpr double sure = 0.95;
    constexpr double less = 0.3;
    const auto best = evidence.best_of(1);
    const double near = best ? std::max(0.0, advantage(evidence.ranking[*best], evidence.ranking[none]).mean) : 0.0;
    decision.confidence = sure - less * std::min(1.0, near / clear_advantage);
}

void name_the_step(const Evidence& evidence, Decision& decision) {
    const auto candidate = std::find_if(evidence.ranking.begin(), evidence.ranking.end(), [](const Ranked& ranked) {
        return ranked.trained.effects.size() == 1 && ranked.trained.effects.front()->rounds;
    });
    const double step = evidence.study.scales.quantum / output_deviation(evidence.validation);
    constexpr double most = 0.5;  // of the squared gap: a uniform error's square is a twelfth of the step's
    if (decision.outcome != Outcome::no_gap || candidate == evidence.ranking.end() ||
        step * step / 12.0 < most * evidence.gap(decision.chosen) * evidence.gap(decision.chosen)) {
        return;
    }
    decision.chosen = static_cast<std::size_t>(candidate - evidence.ranking.begin());
    decision.effects = {decision.chosen};
    decision.outcome = Outcome::attributed;
    decision.noise_floor = std::min(decision.noise_floor, candidate->gap_after);
    decision.confidence = 0.9;
}

}  // namespace

const Rule rule_of_clear_advantage{
    "clear_advantage",
    "Effects are taken one by one while each is clearly more likely on what was not fitted, whichever block of samples "
    "is asked, and takes a material share of the gap. What training leaves open is not taken, nor what acts only "
    "together, nor a set that is as likely without one of its own.",
    choose};

const Rule rule_of_rounded_readings{
    "rounded_readings",
    "That readings are multiples of a step is a fact of the log: it is named where it is most of what is left.",
    name_the_step};

}  // namespace gap
