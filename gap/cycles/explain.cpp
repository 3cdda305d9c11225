#include "gap/cycles/explain.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <tuple>

namespace gap::cycles {
namespace {

using Rows = std::vector<std::size_t>;
using Cycles = std::vector<double>;

// An effect is believed where it takes off this much of the sum of measured cycles, and this share of the gap.
constexpr double worth = 0.003;
constexpr double worth_of_gap = 0.15;
// A base within this is called no gap; what is left beyond this, and of four floors, has another cause.
constexpr double small_gap = 0.02;
constexpr double large_rest = 0.03;

double median(std::vector<double> values) {
    if (values.empty()) {
        return 0.0;
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) {
        return *middle;
    }
    const double upper = *middle;
    return 0.5 * (upper + *std::max_element(values.begin(), middle));
}

// Where a function of one variable is least. Bounded: on what is flat the search would not end.
template <class Function>
double least_at(const Function& function, double low, double high) {
    std::uintmax_t most = 100;
    return boost::math::tools::brent_find_minima(function, low, high, 24, most).first;
}

std::string format_of(const std::string& kernel) { return kernel.substr(kernel.rfind('_') + 1); }
bool is_floating(const std::string& kernel) { return format_of(kernel).starts_with("f"); }

std::string placement_of(const qemu::MeasuredCycles& row) {
    return fmt::format("code={} data={}{}", row.code, row.data, row.maintenance ? " maintenance" : "");
}

// Whether the call's code or data come over a bus that others use too.
bool on_bus(const qemu::MeasuredCycles& row) { return row.code == "flash" || row.data == "axi"; }

// What a core pays.
struct State {
    std::string core;
    std::string set;
    std::set<std::string> off;
    std::map<std::string, double> factor;  // of what is not off and not 1
    double ratio = 1.0;                    // measured clock over the core's
    double overhead = 0.0;                 // cycles a call
    double maintenance = 0.0;              // and beside them where caches are maintained
    double contention = 0.0;               // a part of the call's cycles where it is on the bus
};

class Explainer {
public:
    Explainer(const Question& question, const Predict& predict) : question_(question), predict_(predict) {
        for (const qemu::MeasuredCycles& row : question.rows) {
            measured_.push_back(row.cycles);
        }
        split();
    }

    Explanation run() {
        find_floor();
        const Cycles base = predicted_base();
        result_.base_gap = gap_of(measured_, base, judge_);
        locate(base);
        if (result_.base_gap <= std::max(small_gap, 4.0 * result_.floor)) {
            result_.verdict = "no_gap";
            result_.after_gap = result_.base_gap;
            result_.reference = question_.base;
            return result_;
        }
        State by_clock = best_reference();
        State by_bus = by_clock;
        State found = by_clock;
        take_away(found);
        find_factors(found);
        find_ratio(found);
        // One cause for all rows before several.
        find_ratio(by_clock);
        if (by_clock.ratio != 1.0 && fitted_gap(by_clock) <= fitted_gap(found) + worth) {
            found = by_clock;
        }
        find_contention(by_bus);
        if (by_bus.contention != 0.0 && fitted_gap(by_bus) <= fitted_gap(found) + worth) {
            found = by_bus;
        }
        result_.reference = found.core;
        decide(found);
        return result_;
    }

private:
    // Every other row of each kernel and placement is fitted, the rest judge.
    void split() {
        std::map<std::tuple<std::string, std::string>, unsigned> seen;
        for (std::size_t i = 0; i < question_.rows.size(); ++i) {
            const auto& row = question_.rows[i];
            (seen[{row.kernel, placement_of(row)}]++ % 2 == 0 ? fit_ : judge_).push_back(i);
        }
        if (std::any_of(seen.begin(), seen.end(), [](const auto& one) { return one.second < 2; })) {
            fit_.resize(question_.rows.size());
            std::iota(fit_.begin(), fit_.end(), std::size_t{0});
            judge_ = fit_;
            result_.notes.emplace_back(
                "a kernel and placement has one row only: what is fitted is judged on the same rows");
        }
    }

    // From rows that were measured more than once; half a cycle otherwise, as counters are whole.
    void find_floor() {
        std::map<std::tuple<std::string, std::string, std::uint32_t>, std::vector<double>> repeats;
        for (const auto& row : question_.rows) {
            repeats[{row.kernel, placement_of(row), row.taps}].push_back(row.cycles);
        }
        double sum = 0.0;
        double all = 0.0;
        for (const auto& [key, cycles] : repeats) {
            const double middle = median(cycles);
            for (const double one : cycles) {
                sum += std::max(0.5, std::fabs(one - middle));
                all += one;
            }
        }
        result_.floor = sum / all;
    }

    const std::vector<qemu::PredictedCycles>& of(const State& state) {
        std::vector<State> one{state};
        simulate(one);
        return known_.at(key_of(state));
    }
    static std::string key_of(const State& state) {
        return fmt::format("{} {} {}", state.core, state.set, fmt::join(state.off, ","));
    }
    // Those that are not known yet, all in one emulation.
    void simulate(const std::vector<State>& states) {
        std::vector<qemu::CoreVariant> variants;
        std::vector<std::string> keys;
        for (const State& state : states) {
            const std::string key = key_of(state);
            if (!known_.contains(key) && std::find(keys.begin(), keys.end(), key) == keys.end()) {
                keys.push_back(key);
                variants.push_back({state.core, state.set, {state.off.begin(), state.off.end()}});
            }
        }
        if (variants.empty()) {
            return;
        }
        auto found = predict_(variants);
        for (std::size_t i = 0; i < keys.size(); ++i) {
            known_[keys[i]] = std::move(found[i]);
        }
    }

    // Without what lies beside the call.
    Cycles inside(const State& state) {
        Cycles cycles;
        for (const qemu::PredictedCycles& p : of(state)) {
            double sum = p.nominal - p.beside;
            for (const auto& [effect, factor] : state.factor) {
                const auto index = timing::index(*timing::effect_named(effect));
                sum += (factor - 1.0) * static_cast<double>(p.half_cycles[index]) / 2.0;
            }
            const bool waits = on_bus(question_.rows[cycles.size()]);
            cycles.push_back(sum * state.ratio * (waits ? 1.0 + state.contention : 1.0));
        }
        return cycles;
    }
    Cycles whole(const State& state) {
        Cycles cycles = inside(state);
        for (std::size_t i = 0; i < cycles.size(); ++i) {
            cycles[i] += state.overhead + (question_.rows[i].maintenance ? state.maintenance : 0.0);
        }
        return cycles;
    }

    // Medians: counts have outliers to one side.
    void fit_beside(State& state, const Rows& rows) {
        const Cycles cycles = inside(state);
        std::vector<double> plain;
        for (const std::size_t i : rows) {
            if (!question_.rows[i].maintenance) {
                plain.push_back(measured_[i] - cycles[i]);
            }
        }
        state.overhead = median(plain);
        std::vector<double> maintained;
        for (const std::size_t i : rows) {
            if (question_.rows[i].maintenance) {
                maintained.push_back(measured_[i] - cycles[i] - state.overhead);
            }
        }
        state.maintenance = median(maintained);
    }
    double fitted_gap(State& state) {
        fit_beside(state, fit_);
        return gap_of(measured_, whole(state), fit_);
    }
    static bool better(double now, double before) { return before - now > std::max(worth, worth_of_gap * before); }

    Cycles predicted_base() {
        Cycles cycles;
        for (const qemu::PredictedCycles& p : of({question_.base, "", {}, {}, 1.0, 0.0, 0.0, 0.0})) {
            cycles.push_back(p.nominal);
            base_overhead_ = question_.rows[cycles.size() - 1].maintenance ? base_overhead_ : p.beside;
            base_maintained_ = question_.rows[cycles.size() - 1].maintenance ? p.beside : base_maintained_;
        }
        return cycles;
    }

    State best_reference() {
        State best;
        double least = std::numeric_limits<double>::infinity();
        for (const std::string& core : question_.references) {
            State state{core, "", {}, {}, 1.0, 0.0, 0.0, 0.0};
            const double gap = fitted_gap(state);
            if (gap < least) {
                least = gap;
                best = state;
            }
        }
        return best;
    }

    // Effects that these rows do not show, or speak against: the one whose absence fits best goes first.
    void take_away(State& state) {
        double gap = fitted_gap(state);
        while (true) {
            std::vector<State> without;
            for (const std::string_view effect : timing::effect_names) {
                if (!state.off.contains(std::string(effect))) {
                    without.push_back(state);
                    without.back().off.insert(std::string(effect));
                }
            }
            simulate(without);
            State* best = nullptr;
            double least = std::numeric_limits<double>::infinity();
            for (State& one : without) {
                const double now = fitted_gap(one);
                // What changes nothing is not there.
                if (now < least) {
                    least = now;
                    best = &one;
                }
            }
            const bool changes_nothing = best != nullptr && inside(*best) == inside(state);
            if (best == nullptr || !(changes_nothing || better(least, gap))) {
                return;
            }
            if (!changes_nothing) {
                gap = least;
            }
            state = *best;
        }
    }

    void find_factors(State& state) {
        double gap = fitted_gap(state);
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
                    return fitted_gap(tried);
                };
                const double factor = least_at(of_factor, 0.0, 4.0);
                const double now = of_factor(factor);
                if (now < least) {
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

    void find_ratio(State& state) {
        const double gap = fitted_gap(state);
        State tried = state;
        const auto of_ratio = [&](double ratio) {
            tried.ratio = ratio;
            return fitted_gap(tried);
        };
        const double ratio = least_at(of_ratio, 0.25, 4.0);
        if (better(of_ratio(ratio), gap)) {
            state = tried;
        }
    }

    // Only where some rows are on the bus and others are not: in all of them it would be a clock.
    void find_contention(State& state) {
        const auto shared = std::count_if(question_.rows.begin(), question_.rows.end(), on_bus);
        if (shared == 0 || static_cast<std::size_t>(shared) == question_.rows.size()) {
            return;
        }
        const double gap = fitted_gap(state);
        State tried = state;
        const auto of_contention = [&](double contention) {
            tried.contention = contention;
            return fitted_gap(tried);
        };
        const double contention = least_at(of_contention, 0.0, 3.0);
        if (better(of_contention(contention), gap)) {
            state = tried;
        }
    }

    // From the base to what was found, the step that takes off most first.
    // \param fitted  whose costs beside the call are resampled
    std::vector<Step> steps_to(const State& found, State now, const State& fitted) {
        struct Move {
            std::string effect;
            std::function<void(State&)> apply;
            std::map<std::string, double> parameters;
        };
        std::vector<Move> moves;
        const double wider = question_.base_off.empty() ? 4.0 : 0.5;  // cycles that a call's cost must differ by
        for (const std::string_view name : timing::effect_names) {
            const std::string effect(name);
            const double had = now.off.contains(effect) ? 0.0 : 1.0;
            const double has = found.off.contains(effect)      ? 0.0
                               : found.factor.contains(effect) ? found.factor.at(effect)
                                                               : 1.0;
            if (had == has || !matters(found, now, effect)) {
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
        if (std::fabs(found.overhead - now.overhead) > wider) {
            moves.push_back({"call_overhead",
                             [&found](State& state) { state.overhead = found.overhead; },
                             {{"cycles", found.overhead}}});
        }
        if (std::fabs(found.maintenance - now.maintenance) > wider) {
            moves.push_back({"cache_maintenance",
                             [&found](State& state) { state.maintenance = found.maintenance; },
                             {{"cycles", found.maintenance}}});
        }
        if (found.ratio != 1.0) {
            moves.push_back(
                {"clock_ratio", [&found](State& state) { state.ratio = found.ratio; }, {{"ratio", found.ratio}}});
        }
        if (found.contention != 0.0) {
            moves.push_back({"bus_contention",
                             [&found](State& state) { state.contention = found.contention; },
                             {{"share", found.contention}}});
        }
        std::vector<Step> steps;
        double gap = gap_of(measured_, whole(now), judge_);
        while (!moves.empty()) {
            std::vector<State> next;
            for (const Move& move : moves) {
                next.push_back(now);
                move.apply(next.back());
            }
            simulate(next);
            std::size_t best = 0;
            double least = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i < next.size(); ++i) {
                const double after = gap_of(measured_, whole(next[i]), judge_);
                if (after < least) {
                    least = after;
                    best = i;
                }
            }
            const double confidence = std::fabs(gap - least) > 5.0 * std::max(result_.floor, 0.001) ? 0.95 : 0.6;
            steps.push_back({moves[best].effect, moves[best].parameters, {}, gap, least, confidence});
            now = next[best];
            gap = least;
            moves.erase(moves.begin() + static_cast<std::ptrdiff_t>(best));
        }
        add_intervals(fitted, steps);
        return steps;
    }
    // Whether an effect costs these rows anything: an effect that is absent there is no difference.
    bool matters(const State& found, const State& base, const std::string& effect) {
        State with = found.off.contains(effect) ? base : found;
        with.off.erase(effect);
        const auto index = timing::index(*timing::effect_named(effect));
        const auto& predicted = of(with);
        return std::any_of(predicted.begin(), predicted.end(),
                           [&](const auto& p) { return p.half_cycles[index] != 0; });
    }

    // Of the costs beside the call: rows drawn again and again.
    void add_intervals(const State& found, std::vector<Step>& steps) {
        std::mt19937_64 random(1);
        std::vector<double> overhead;
        std::vector<double> maintenance;
        for (int n = 0; n < 400; ++n) {
            Rows drawn;
            for (std::size_t i = 0; i < question_.rows.size(); ++i) {
                drawn.push_back(random() % question_.rows.size());
            }
            State state = found;
            fit_beside(state, drawn);
            overhead.push_back(state.overhead);
            maintenance.push_back(state.maintenance);
        }
        const auto interval = [](std::vector<double>& values) {
            std::sort(values.begin(), values.end());
            return Interval{values[values.size() / 40], values[values.size() - 1 - values.size() / 40]};
        };
        for (Step& step : steps) {
            if (step.effect == "call_overhead") {
                step.interval["cycles"] = interval(overhead);
            } else if (step.effect == "cache_maintenance") {
                step.interval["cycles"] = interval(maintenance);
            }
        }
    }

    void decide(State found) {
        const bool from_nothing = !question_.base_off.empty();
        State base = from_nothing ? State{found.core,
                                          found.set,
                                          {question_.base_off.begin(), question_.base_off.end()},
                                          {},
                                          1.0,
                                          base_overhead_,
                                          base_maintained_ - base_overhead_,
                                          0.0}
                                  : State{question_.base,
                                          "",
                                          {},
                                          {},
                                          1.0,
                                          base_overhead_,
                                          std::max(0.0, base_maintained_ - base_overhead_),
                                          0.0};
        if (base_maintained_ == 0.0) {
            base.maintenance = 0.0;
        }
        result_.verdict = "attributed";
        State published = found;
        published.set = "published";
        const bool rivals = from_nothing && has_set(found.core, "published");
        if (rivals && better(gap_of(measured_, whole(found), judge_), fitted_gap_of(published, found))) {
            base.set = "published";
            result_.steps = steps_to(published, base, found);
            part_rules(found, published);
        } else {
            result_.steps = steps_to(found, base, found);
            result_.after_gap = gap_of(measured_, whole(found), judge_);
            if (found.ratio > 1.0 && found.ratio < 1.5) {
                result_.verdict = "ambiguous";
                Step other = *std::find_if(result_.steps.begin(), result_.steps.end(),
                                           [](const Step& step) { return step.effect == "clock_ratio"; });
                result_.alternatives.push_back(other);
                other.effect = "interrupt_load";
                other.parameters = {{"share", 1.0 - 1.0 / found.ratio}};
                result_.alternatives.push_back(other);
                if (std::all_of(question_.rows.begin(), question_.rows.end(), on_bus)) {
                    other.effect = "bus_contention";
                    other.parameters = {{"share", found.ratio - 1.0}};
                    result_.alternatives.push_back(other);
                }
                result_.apart = "a part of every row's time";
                std::erase_if(result_.steps, [](const Step& step) { return step.effect == "clock_ratio"; });
                result_.next_experiment =
                    "the same rows with interrupts off, and with the counter read around a delay of known length";
            }
        }
        if (result_.after_gap > std::max(large_rest, 4.0 * result_.floor)) {
            result_.verdict = "unknown";
        }
    }
    [[nodiscard]] bool has_set(const std::string& core, const std::string& set) const {
        const auto found = question_.sets.find(core);
        return found != question_.sets.end() &&
               std::find(found->second.begin(), found->second.end(), set) != found->second.end();
    }
    // With the costs beside the call that another state has.
    double fitted_gap_of(State& state, const State& like) {
        state.overhead = like.overhead;
        state.maintenance = like.maintenance;
        return gap_of(measured_, whole(state), judge_);
    }

    // What published rules leave is proportional to the length, in rows of floating-point kernels of one placement: any
    // effect that acts there at each tap explains it, and these rows cannot part them.
    void part_rules(const State& found, const State& published) {
        const Cycles by_rules = whole(published);
        Cycles after = by_rules;
        std::map<std::string, Rows> groups;
        for (std::size_t i = 0; i < question_.rows.size(); ++i) {
            const auto& row = question_.rows[i];
            groups[format_of(row.kernel) + " " + placement_of(row)].push_back(i);
        }
        std::map<std::string, double> a_tap;
        for (const auto& [name, rows] : groups) {
            std::vector<double> taps;
            std::vector<double> rest;
            for (const std::size_t i : rows) {
                taps.push_back(question_.rows[i].taps);
                rest.push_back(measured_[i] - by_rules[i]);
            }
            const double slope = qemu::fit_line(taps, rest).slope;
            if (!is_floating(question_.rows[rows.front()].kernel) || std::fabs(slope) < 0.2) {
                continue;
            }
            a_tap["cycles_per_tap " + name] = slope;
            for (const std::size_t i : rows) {
                after[i] += slope * question_.rows[i].taps;
            }
        }
        const double before = gap_of(measured_, by_rules, judge_);
        result_.after_gap = gap_of(measured_, after, judge_);
        for (const char* effect : {"fpu_latency", "load_bank_conflict", "store_buffer", "load_use"}) {
            result_.alternatives.push_back({effect, a_tap, {}, before, result_.after_gap, 0.25});
        }
        result_.apart = "floating-point rows, by their length, beyond published rules";
        result_.verdict = "ambiguous";
        std::string fits;
        for (const std::string& set : question_.fitting.at(found.core)) {
            State state = found;
            state.set = set;
            fits +=
                fmt::format("{}{} leaves {:.2f} %", fits.empty() ? "" : ", ", set, 100.0 * fitted_gap_of(state, found));
        }
        result_.notes.push_back(fmt::format("of the rule sets in the core file {}: {}", found.core, fits));
    }

    void locate(const Cycles& base) {
        std::map<std::string, double> kernels;
        std::map<std::string, double> placements;
        std::map<std::string, Rows> lines;
        double sum = 0.0;
        for (const std::size_t i : judge_) {
            const auto& row = question_.rows[i];
            const double off = std::fabs(measured_[i] - base[i]);
            sum += off;
            kernels[row.kernel] += off;
            placements[placement_of(row)] += off;
            lines[row.kernel + " " + placement_of(row)].push_back(i);
        }
        double slope = 0.0;
        double constant = 0.0;
        for (const auto& [name, rows] : lines) {
            std::vector<double> taps;
            std::vector<double> rest;
            for (const std::size_t i : rows) {
                taps.push_back(question_.rows[i].taps);
                rest.push_back(measured_[i] - base[i]);
            }
            const qemu::Line line = qemu::fit_line(taps, rest);
            for (const double one : taps) {
                slope += std::fabs(line.slope * one);
                constant += std::fabs(line.constant);
            }
        }
        const auto shares = [](const std::map<std::string, double>& parts, double all) {
            std::vector<Share> found;
            for (const auto& [name, part] : parts) {
                found.push_back({name, all > 0.0 ? part / all : 1.0 / static_cast<double>(parts.size())});
            }
            std::stable_sort(found.begin(), found.end(),
                             [](const Share& a, const Share& b) { return a.share > b.share; });
            return found;
        };
        result_.kernels = shares(kernels, sum);
        result_.placements = shares(placements, sum);
        result_.lines = shares({{"slope", slope}, {"constant", constant}}, slope + constant);
    }

    const Question& question_;
    const Predict& predict_;
    Cycles measured_;
    Rows fit_;
    Rows judge_;
    std::map<std::string, std::vector<qemu::PredictedCycles>> known_;
    double base_overhead_ = 0.0;
    double base_maintained_ = 0.0;
    Explanation result_;
};

}  // namespace

double gap_of(const std::vector<double>& measured, const std::vector<double>& predicted,
              const std::vector<std::size_t>& rows) {
    double off = 0.0;
    double sum = 0.0;
    for (const std::size_t i : rows) {
        off += std::fabs(measured[i] - predicted[i]);
        sum += measured[i];
    }
    return sum > 0.0 ? off / sum : 0.0;
}

Explanation explain(const Question& question, const Predict& predict) { return Explainer(question, predict).run(); }

}  // namespace gap::cycles
