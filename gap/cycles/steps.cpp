#include "gap/cycles/steps.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "gap/cycles/intervals.hpp"

namespace gap::cycles {
namespace {

// Whether an effect costs these rows anything: an effect that is absent there is no difference.
bool matters(Evidence& evidence, const State& found, const State& base, const std::string& effect) {
    State with = found.off.contains(effect) ? base : found;
    with.off.erase(effect);
    const auto index = timing::index(*timing::effect_named(effect));
    const auto& predicted = evidence.predicted(with);
    // What was taken away since it changes nothing.
    if (found.off.contains(effect) && evidence.inside(with) == evidence.inside(found)) {
        return false;
    }
    return std::any_of(predicted.begin(), predicted.end(), [&](const auto& p) { return p.half_cycles[index] != 0; });
}

}  // namespace

std::vector<Step> steps_to(Evidence& evidence, const State& found, State now, const State& fitted, double cost_worth) {
    struct Move {
        std::string effect;
        std::function<void(State&)> apply;
        std::map<std::string, double> parameters;
    };
    std::vector<Move> moves;
    for (const std::string_view name : timing::effect_names) {
        const std::string effect(name);
        const double had = now.off.contains(effect) ? 0.0 : 1.0;
        const double has = found.off.contains(effect)      ? 0.0
                           : found.factor.contains(effect) ? found.factor.at(effect)
                                                           : 1.0;
        if (had == has || !matters(evidence, found, now, effect)) {
            continue;
        }
        moves.push_back({effect,
                         [effect, has, &found](State& state) {
                             if (found.off.contains(effect)) {
                                 state.off.insert(effect);
                             } else {
                                 state.off.erase(effect);
                             }
                             if (has != 0.0 && has != 1.0) {
                                 state.factor[effect] = has;
                             }
                         },
                         {{"factor", has}}});
    }
    // Another clock takes the costs beside the call along: what is left of them is a cause, to a twentieth.
    const auto is_cause = [&](double State::*cost) {
        const double along = now.*cost * found.ratio;
        return std::fabs(found.*cost - along) > std::max(cost_worth, found.ratio != 1.0 ? 0.05 * along : 0.0);
    };
    const bool overhead = is_cause(&State::overhead);
    const bool maintenance = is_cause(&State::maintenance);
    if (overhead) {
        moves.push_back({"call_overhead",
                         [&found](State& state) { state.overhead = found.overhead; },
                         {{"cycles", found.overhead}}});
    }
    if (maintenance) {
        moves.push_back({"cache_maintenance",
                         [&found](State& state) { state.maintenance = found.maintenance; },
                         {{"cycles", found.maintenance}}});
    }
    if (found.ratio != 1.0) {
        moves.push_back({"clock_ratio",
                         [&found, overhead, maintenance](State& state) {
                             state.ratio = found.ratio;
                             state.overhead = overhead ? state.overhead : found.overhead;
                             state.maintenance = maintenance ? state.maintenance : found.maintenance;
                         },
                         {{"ratio", found.ratio}}});
    }
    if (found.contention != 0.0) {
        moves.push_back({"bus_contention",
                         [&found](State& state) { state.contention = found.contention; },
                         {{"share", found.contention}}});
    }
    const double floor = evidence.floor();
    std::vector<Step> steps;
    double gap = evidence.judged_gap(evidence.whole(now));
    while (!moves.empty()) {
        std::vector<State> next;
        for (const Move& move : moves) {
            next.push_back(now);
            move.apply(next.back());
        }
        evidence.simulate(next);
        std::size_t best = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < next.size(); ++i) {
            const double after = evidence.judged_gap(evidence.whole(next[i]));
            if (after < least) {
                least = after;
                best = i;
            }
        }
        const double confidence = std::fabs(gap - least) > 5.0 * std::max(floor, 0.001) ? 0.95 : 0.6;
        steps.push_back({moves[best].effect, moves[best].parameters, {}, gap, least, confidence});
        now = next[best];
        gap = least;
        moves.erase(moves.begin() + static_cast<std::ptrdiff_t>(best));
    }
    add_intervals(evidence, fitted, steps);
    return steps;
}

}  // namespace gap::cycles
