#include "gap/drive/beside_found_base.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "gap/drive/base/jointly.hpp"
#include "gap/drive/base/signs.hpp"
#include "gap/drive/base/worth_asking.hpp"
#include "gap/drive/decide/evidence.hpp"

namespace gap {
namespace {

std::vector<const Effect*> causes_of(const Answer& answer) {
    std::vector<const Effect*> causes;
    for (const std::size_t i : answer.decision.effects) {
        for (const Effect* effect : answer.ranking[i].trained.effects) {
            if (std::find(causes.begin(), causes.end(), effect) == causes.end()) {
                causes.push_back(effect);
            }
        }
    }
    return causes;
}

// Friction of two sizes is friction.
bool are_same(const std::vector<const Effect*>& ours, const std::vector<const Effect*>& theirs) {
    const auto has = [](const std::vector<const Effect*>& causes, const Effect* wanted) {
        return std::any_of(causes.begin(), causes.end(), [&](const Effect* one) {
            return one == wanted || one->covers(*wanted) || wanted->covers(*one);
        });
    };
    return std::all_of(ours.begin(), ours.end(), [&](const Effect* one) { return has(theirs, one); }) &&
           std::all_of(theirs.begin(), theirs.end(), [&](const Effect* one) { return has(ours, one); });
}

std::string names_of(const std::vector<const Effect*>& causes) {
    std::string names;
    for (const Effect* cause : causes) {
        names += (names.empty() ? "" : " + ") + cause->name;
    }
    return names;
}

}  // namespace

bool is_settled(const Decision& decision) { return decision.outcome == Outcome::no_gap && !decision.disturbed; }

bool leaves_most(const Described& base) { return base.validation > 0.5; }
bool leaves_half_of(double with_signs, double without) { return with_signs < 0.5 * without; }

double best_linear_share(double of_base, const std::vector<Described>& found) {
    for (const Described& one : found) {
        of_base = std::max(of_base, linear_share_of(one.validation));
    }
    return of_base;
}

double price_of(const Answer& answer, int base_numbers) {
    constexpr double each = 0.08;
    constexpr double floor = 1e-4;
    return std::log(std::max(answer.chosen().gap_after, floor)) +
           each * (base_numbers + static_cast<double>(answer.chosen().candidate.effect_parameters_in_all()));
}

Answer cheapest_of(std::vector<BesideABase> tried) {
    std::stable_sort(tried.begin(), tried.end(),
                     [](const BesideABase& a, const BesideABase& b) { return a.price < b.price; });
    Answer answer = std::move(tried.front().answer);
    answer.base_name = tried.front().name;
    const std::vector<const Effect*> causes = causes_of(answer);
    for (std::size_t i = 1; i < tried.size() && !causes.empty(); ++i) {
        constexpr double near = 0.2;
        const std::vector<const Effect*> theirs = causes_of(tried[i].answer);
        if (tried[i].price < tried.front().price + near && !theirs.empty() && !are_same(causes, theirs)) {
            answer.decision.confidence = std::min(answer.decision.confidence, 0.6);
            answer.notes.push_back(
                fmt::format("beside the base {} {} goes about as far", tried[i].name, names_of(theirs)));
        }
    }
    return answer;
}

void judge_jointly(Answer& answer, double jointly) {
    constexpr double as_well = 1.15;
    // More than that left, or than a form may leave that lacks nothing, and something is missing; a plant that was only
    // seen on its way up may come down otherwise.
    constexpr double nearly_all = 0.1;
    constexpr double most = 0.25;
    const bool one_way = std::any_of(answer.extrapolated.begin(), answer.extrapolated.end(), [](const auto& what) {
        return what == "falling output" || what == "rising output";
    });
    // Of a base that runs away: of the output.
    const double without = std::min(1.0, answer.none().gap_after);
    const double enough = one_way ? most * without : std::min(nearly_all * without, small_gap_of_a_form);
    if (jointly > as_well * answer.chosen().gap_after || jointly > enough) {
        return;
    }
    answer.decision.outcome = Outcome::no_gap;
    answer.decision.chosen = static_cast<std::size_t>(&answer.none() - answer.ranking.data());
    answer.decision.effects.clear();
    answer.decision.suspect.reset();
    answer.decision.confidence = std::min(answer.decision.confidence, 0.9);
    answer.next_record.reset();
    answer.next_experiment =
        answer.extrapolated.empty()
            ? "none for this gap; a longer training record would tell the base's numbers by itself"
            : fmt::format("train on what validation alone has, too: {}", fmt::join(answer.extrapolated, "; "));
    answer.notes.push_back(fmt::format(
        "fitted to the validation, too, the base leaves {:.4f} without any effect: training alone does not tell "
        "its numbers",
        jointly));
}

Answer answer_beside_found_base(Question question, const std::function<void(const std::string&)>& say) {
    std::vector<Described> found = find_base(question, say);
    question.refit = true;
    // No linear description turns its output's sign: where readings may have lost theirs, one is looked for that
    // follows them with it, and the loss is an effect like others.
    if (leaves_most(found.front()) && may_have_lost_signs(question.train)) {
        say("looking for signs that the sensor may have lost");
        const Question with_signs = with_signs_of_a_base(question);
        std::vector<Described> better = find_base(with_signs, say);
        // Judged where both were fitted: that validation goes where training never was says nothing of signs. And in
        // units of the output, whose deviation is another one with signs.
        if (leaves_half_of(better.front().aside * deviation_of(with_signs.train),
                           found.front().aside * deviation_of(question.train))) {
            found = std::move(better);
        }
    }
    std::vector<BesideABase> tried;
    std::vector<const Described*> asked = worth_asking(found);
    const Described* place = nullptr;  // where a spring may pull, once it is wanted
    for (std::size_t i = 0; i < asked.size(); ++i) {
        const Described* base = asked[i];
        // A simpler base may do with less; where noise alone is left, no other one can say more but of a place.
        if (!tried.empty() && tried.front().answer.leaves_noise && base->numbers >= asked.front()->numbers &&
            base != place) {
            continue;
        }
        say(fmt::format("the base: {} ({})", base->name, base->meaning));
        question.form = base->form;
        question.from_no_input = base->from_no_input;
        Answer answer = answer_to(question, say);
        const bool settled = is_settled(answer.decision);
        const double price = price_of(answer, base->numbers);
        const auto ask = [&](const Described* other) {
            if (other != nullptr && std::find(asked.begin(), asked.end(), other) == asked.end()) {
                asked.push_back(other);
            }
        };
        ask(answer.lag_wanted ? with_one_lag_more(found, *base) : nullptr);
        place = answer.place_wanted ? with_a_place(found, asked) : place;
        ask(place);
        tried.push_back({base->name, std::move(answer), price});
        if (settled && tried.size() == 1) {
            break;
        }
        if (i + 1 == asked.size() &&
            std::ranges::min_element(tried, {}, &BesideABase::price)->answer.decision.outcome == Outcome::unknown) {
            ask(simplest_like(found, found.front()));
        }
    }
    Answer answer = cheapest_of(std::move(tried));
    for (const Described& one : found) {
        if (one.name == answer.base_name) {
            question.form = one.form;
            question.from_no_input = one.from_no_input;
        }
    }
    answer.linear_share = best_linear_share(answer.linear_share, found);
    if (answer.decision.outcome != Outcome::no_gap) {
        judge_jointly(answer, joint_gap(question));
    }
    answer.descriptions = std::move(found);
    return answer;
}

}  // namespace gap
