#include "gap/cycles/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

namespace gap::cycles {
namespace {

constexpr int draws = 400;
constexpr double half_a_count = 0.5;  // cycles

// A number of a state, fitted by a median: each row says what it would have to be.
struct Fitted {
    std::function<double(const State&)> value;
    std::function<void(State&, const Rows&)> fit;
    Cycles cycles;  ///< of each row, for one unit of the number
};

Interval interval_of(Evidence& evidence, const State& found, const Fitted& number) {
    std::mt19937_64 random(1);
    std::vector<double> values;
    for (int n = 0; n < draws; ++n) {
        Rows drawn;
        for (std::size_t i = 0; i < evidence.rows().size(); ++i) {
            drawn.push_back(random() % evidence.rows().size());
        }
        State state = found;
        number.fit(state, drawn);
        values.push_back(number.value(state));
    }
    std::sort(values.begin(), values.end());
    Cycles cycles;
    for (const double one : number.cycles) {
        if (std::fabs(one) > 0.0) {
            cycles.push_back(std::fabs(one));
        }
    }
    const double resolution = cycles.empty() ? 0.0 : half_a_count / median(cycles);
    const double value = number.value(found);
    return {std::min(value, values[values.size() / 40]) - resolution,
            std::max(value, values[values.size() - 1 - values.size() / 40]) + resolution};
}

// What brings the sum of absolute differences to its least: the median of what the rows say, each by its weight.
double weighted_median(std::vector<std::pair<double, double>> values) {
    std::sort(values.begin(), values.end());
    double all = 0.0;
    for (const auto& [value, weight] : values) {
        all += weight;
    }
    double sum = 0.0;
    for (const auto& [value, weight] : values) {
        sum += weight;
        if (sum >= all / 2.0) {
            return value;
        }
    }
    return values.back().first;
}

// Of cycles that are proportional to a number.
Fitted proportional(const Evidence& evidence, double now, const std::function<void(State&, double)>& set,
                    const std::function<double(const State&)>& get, Cycles rest, Cycles unit) {
    return {get,
            [&evidence, now, set, rest, unit](State& state, const Rows& rows) {
                std::vector<std::pair<double, double>> values;
                for (const std::size_t i : rows) {
                    if (unit[i] != 0.0) {
                        values.emplace_back((evidence.measured()[i] - rest[i]) / unit[i],
                                            std::fabs(unit[i]) / evidence.rows()[i].per);
                    }
                }
                set(state, values.empty() ? now : weighted_median(std::move(values)));
            },
            unit};
}

}  // namespace

void add_intervals(Evidence& evidence, const State& found, std::vector<Step>& steps) {
    const auto beside = [&](double State::*cost) {
        return Fitted{[cost](const State& state) { return state.*cost; },
                      [&evidence](State& state, const Rows& rows) { evidence.fit_beside(state, rows); },
                      Cycles(evidence.rows().size(), 1.0)};
    };
    // What one unit more of a number does to the rows, and what is left of them at none of it.
    const auto linear = [&](const std::function<void(State&, double)>& set,
                            const std::function<double(const State&)>& get) {
        State none = found;
        State one = found;
        set(none, 0.0);
        set(one, 1.0);
        const Cycles rest = evidence.whole(none);
        Cycles unit = evidence.whole(one);
        for (std::size_t i = 0; i < unit.size(); ++i) {
            unit[i] -= rest[i];
        }
        return proportional(evidence, get(found), set, get, rest, unit);
    };
    const auto member = [&](double State::*number) {
        return linear([number](State& state, double value) { state.*number = value; },
                      [number](const State& state) { return state.*number; });
    };
    for (Step& step : steps) {
        if (step.effect == "call_overhead") {
            step.interval["cycles"] = interval_of(evidence, found, beside(&State::overhead));
        } else if (step.effect == "cache_maintenance") {
            step.interval["cycles"] = interval_of(evidence, found, beside(&State::maintenance));
        } else if (step.effect == "clock_ratio") {
            step.interval["ratio"] = interval_of(evidence, found, member(&State::ratio));
        } else if (step.effect == "bus_contention") {
            step.interval["share"] = interval_of(evidence, found, member(&State::contention));
        } else if (found.factor.contains(step.effect)) {
            const std::string effect = step.effect;
            step.interval["factor"] =
                interval_of(evidence, found,
                            linear([effect](State& state, double value) { state.factor[effect] = value; },
                                   [effect](const State& state) { return state.factor.at(effect); }));
        }
    }
}

}  // namespace gap::cycles
