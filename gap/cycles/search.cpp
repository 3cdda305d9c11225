#include "gap/cycles/search.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <limits>
#include <optional>

#include "gap/cycles/lines.hpp"

namespace gap::cycles {
namespace {

// An effect is believed where it takes off this much of the sum of measured cycles, and this share of the gap.
constexpr double worth = 0.003;
constexpr double worth_of_gap = 0.15;
// Costs of an effect that are tried, as multiples of the core file's.
constexpr double most_factor = 4.0;

// Where a function of one variable is least. Bounded: on what is flat the search would not end.
template <class Function>
double least_at(const Function& function, double low, double high) {
    std::uintmax_t most = 100;
    return boost::math::tools::brent_find_minima(function, low, high, 24, most).first;
}

State best_reference(Evidence& evidence, const Question& question) {
    State best;
    double least = std::numeric_limits<double>::infinity();
    for (const std::string& core : question.references) {
        State state{.core = core};
        const double gap = evidence.fitted_gap(state);
        if (gap < least) {
            least = gap;
            best = state;
        }
    }
    return best;
}

// Effects that these rows do not show, or speak against: the one whose absence fits best goes first.
void take_away(Evidence& evidence, State& state) {
    double gap = evidence.fitted_gap(state);
    while (true) {
        std::vector<State> without;
        for (const std::string_view effect : timing::effect_names) {
            if (!state.off.contains(std::string(effect))) {
                without.push_back(state);
                without.back().off.insert(std::string(effect));
            }
        }
        evidence.simulate(without);
        State* best = nullptr;
        double least = std::numeric_limits<double>::infinity();
        for (State& one : without) {
            const double now = evidence.fitted_gap(one);
            // What changes nothing is not there.
            if (now < least) {
                least = now;
                best = &one;
            }
        }
        const bool changes_nothing = best != nullptr && evidence.inside(*best) == evidence.inside(state);
        if (best == nullptr || !(changes_nothing || better(least, gap))) {
            return;
        }
        if (!changes_nothing) {
            gap = least;
        }
        state = *best;
    }
}

void find_factors(Evidence& evidence, State& state) {
    double gap = evidence.fitted_gap(state);
    for (int n = 0; n < 2; ++n) {
        State best = state;
        double least = gap;
        for (const std::string_view effect : timing::effect_names) {
            if (state.off.contains(std::string(effect)) || state.factor.contains(std::string(effect))) {
                continue;
            }
            State tried = state;
            const auto of_factor = [&](double factor) {
                tried.factor[std::string(effect)] = factor;
                return evidence.fitted_gap(tried);
            };
            const double factor = least_at(of_factor, 0.0, most_factor);
            const double now = of_factor(factor);
            // At the end of what was tried nothing was found.
            if (now < least && factor < 0.98 * most_factor) {
                least = now;
                best = tried;
            }
        }
        if (!better(least, gap)) {
            return;
        }
        gap = least;
        state = best;
    }
}

// The state with that number at its best, if that is better.
void find(Evidence& evidence, State& state, double State::*number, double low, double high) {
    const double gap = evidence.fitted_gap(state);
    State tried = state;
    const auto gap_at = [&](double value) {
        tried.*number = value;
        return evidence.fitted_gap(tried);
    };
    const double best = least_at(gap_at, low, high);
    if (better(gap_at(best), gap)) {
        state = tried;
    }
}

void find_ratio(Evidence& evidence, State& state) { find(evidence, state, &State::ratio, 0.25, 4.0); }

// Only where some rows are on the bus and others are not: in all of them it would be a clock.
void find_contention(Evidence& evidence, State& state) {
    const auto shared = std::count_if(evidence.rows().begin(), evidence.rows().end(), on_bus);
    if (shared > 0 && static_cast<std::size_t>(shared) < evidence.rows().size()) {
        find(evidence, state, &State::contention, 0.0, 3.0);
    }
}

// In how much a core differs from the base, which pays all but what it says.
std::size_t causes(const State& state, const Question& question) {
    std::size_t count = state.factor.size() + (state.ratio != 1.0 ? 1 : 0) + (state.contention != 0.0 ? 1 : 0);
    for (const std::string_view effect : timing::effect_names) {
        const std::string name(effect);
        const bool base_pays =
            std::find(question.base_off.begin(), question.base_off.end(), name) == question.base_off.end();
        count += base_pays == state.off.contains(name) ? 1 : 0;
    }
    return count;
}

// A clock or a bus hides what an effect takes: with each effect away that number is sought anew.
template <class Find>
State with_one_away(Evidence& evidence, const State& reference, const Find& find_number) {
    State best = reference;
    double least = std::numeric_limits<double>::infinity();
    std::vector<State> without;
    for (const std::string_view effect : timing::effect_names) {
        without.push_back(reference);
        without.back().off.insert(std::string(effect));
    }
    evidence.simulate(without);
    for (State& one : without) {
        find_number(evidence, one);
        const double now = evidence.fitted_gap(one);
        if (now < least) {
            least = now;
            best = one;
        }
    }
    return best;
}

}  // namespace

bool better(double now, double before) { return before - now > std::max(worth, worth_of_gap * before); }

// What the core file itself adds beside a call.
void set_beside(Evidence& evidence, State& state) {
    const auto& predicted = evidence.predicted(state);
    for (std::size_t i = 0; i < predicted.size(); ++i) {
        (evidence.rows()[i].maintenance ? state.maintenance : state.overhead) = predicted[i].beside;
    }
    state.maintenance = std::max(0.0, state.maintenance - state.overhead);
}

// Where costs beside the call meet the slope and the constant of every kernel, an effect would only take a few cycles
// off the constants, and one is always found that does: two kernels have two of them, and it is as many numbers. So
// that is all, but for an effect whose absence leaves less without any such cost.
std::optional<State> by_costs_alone(Evidence& evidence, const State& reference) {
    State by_call = reference;
    const double left = evidence.fitted_gap(by_call);
    const auto lines = lines_left(evidence, evidence.whole(by_call));
    if (by_call.overhead < 0.0 || by_call.maintenance < 0.0 ||
        !std::all_of(lines.begin(), lines.end(), is_met_closely)) {
        return std::nullopt;
    }
    State found = by_call;
    double least = left;
    std::vector<State> without;
    for (const std::string_view effect : timing::effect_names) {
        without.push_back({.core = reference.core, .off = {std::string(effect)}});
    }
    evidence.simulate(without);
    for (State& one : without) {
        set_beside(evidence, one);
        const double now = evidence.gap(evidence.whole(one), evidence.to_fit());
        if (now < least && better(now, left)) {
            least = now;
            found = one;
        }
    }
    return found;
}

State search(Evidence& evidence, const Question& question) {
    const State reference = best_reference(evidence, question);
    if (const auto alone = by_costs_alone(evidence, reference)) {
        return *alone;
    }
    State found = reference;
    take_away(evidence, found);
    find_factors(evidence, found);
    find_ratio(evidence, found);
    // One clock or one bus for all rows, alone or with an effect away, where it says as much by fewer causes.
    const auto prefer = [&](State other) {
        if (other.ratio == 1.0 && other.contention == 0.0) {
            return;
        }
        const bool simpler = causes(other, question) < causes(found, question);
        if (evidence.fitted_gap(other) <= evidence.fitted_gap(found) + (simpler ? worth : -worth)) {
            found = other;
        }
    };
    prefer(with_one_away(evidence, reference, find_ratio));
    prefer(with_one_away(evidence, reference, find_contention));
    State by_clock = reference;
    find_ratio(evidence, by_clock);
    prefer(by_clock);
    State by_bus = reference;
    find_contention(evidence, by_bus);
    prefer(by_bus);
    return found;
}

}  // namespace gap::cycles
