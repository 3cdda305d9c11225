#include "gap/cycles/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "gap/cycles/evidence.hpp"
#include "gap/cycles/lines.hpp"
#include "gap/cycles/locate.hpp"
#include "gap/cycles/search.hpp"
#include "gap/cycles/steps.hpp"
#include "glsum/catalogue.hpp"
#include "qemu/emulate/rows_fit.hpp"

namespace gap::cycles {
namespace {

// A base within this is called no gap; what is left beyond this, and of four floors, has another cause.
constexpr double small_gap = 0.02;
constexpr double large_rest = 0.03;

// Whether counter and core may run at such clocks: near each other as the settings of two boards are, or at a whole
// ratio, as a timer's prescaler makes it. Another core's rows come as another ratio.
bool is_clock(double ratio) {
    const double steps = std::max(ratio, 1.0 / ratio);
    return (ratio >= 0.5 && ratio <= 1.5) || std::fabs(steps - std::round(steps)) <= 0.01 * steps;
}

// What is no kernel of ours stands for itself.
std::string_view format_of(const std::string& name) {
    const glsum::CatalogueEntry* const kernel = glsum::find_kernel(name);
    return kernel != nullptr ? kernel->format : name;
}

class Explainer {
public:
    Explainer(const Question& question, const Predict& predict) : question_(question), evidence_(question, predict) {}

    Explanation run() {
        result_.floor = evidence_.floor();
        if (evidence_.judged_by_itself()) {
            result_.notes.emplace_back(
                "a kernel and placement has one row only: what is fitted is judged on the same rows");
        }
        const Cycles base = predicted_base();
        result_.base_gap = evidence_.judged_gap(base);
        result_.where = locate(evidence_, base);
        if (result_.base_gap <= std::max(small_gap, 4.0 * result_.floor)) {
            result_.outcome = Outcome::no_gap;
            result_.after_gap = result_.base_gap;
            result_.reference = question_.base;
            return result_;
        }
        const State found = search(evidence_, question_);
        result_.reference = found.core;
        decide(found);
        return result_;
    }

private:
    Cycles predicted_base() {
        Cycles cycles;
        for (const qemu::PredictedCycles& p : evidence_.predicted({.core = question_.base})) {
            cycles.push_back(p.nominal);
            base_overhead_ = evidence_.rows()[cycles.size() - 1].maintenance ? base_overhead_ : p.beside;
            base_maintained_ = evidence_.rows()[cycles.size() - 1].maintenance ? p.beside : base_maintained_;
        }
        return cycles;
    }

    void decide(State found) {
        const bool from_nothing = !question_.base_off.empty();
        State base{.core = from_nothing ? found.core : question_.base};
        if (from_nothing) {
            base.set = found.set;
            base.off = {question_.base_off.begin(), question_.base_off.end()};
        }
        base.overhead = base_overhead_;
        base.maintenance =
            from_nothing ? base_maintained_ - base_overhead_ : std::max(0.0, base_maintained_ - base_overhead_);
        if (base_maintained_ == 0.0) {
            base.maintenance = 0.0;
        }
        const double cost_worth = from_nothing ? 0.5 : 4.0;
        result_.outcome = Outcome::attributed;
        State published = found;
        published.set = "published";
        const bool rivals = from_nothing && has_set(found.core, "published") && any_floating(found);
        if (rivals && better(evidence_.judged_gap(evidence_.whole(found)), fitted_gap_of(published, found))) {
            base.set = "published";
            result_.steps = steps_to(evidence_, published, base, found, cost_worth);
            part_rules(found, published);
        } else {
            result_.steps = steps_to(evidence_, found, base, found, cost_worth);
            result_.after_gap = evidence_.judged_gap(evidence_.whole(found));
            if (found.ratio > 1.0 && found.ratio < 1.5) {
                result_.outcome = Outcome::ambiguous;
                Step other = *std::find_if(result_.steps.begin(), result_.steps.end(),
                                           [](const Step& step) { return step.effect == "clock_ratio"; });
                result_.alternatives.push_back(other);
                other.effect = "interrupt_load";
                other.parameters = {{"share", 1.0 - 1.0 / found.ratio}};
                result_.alternatives.push_back(other);
                if (std::all_of(evidence_.rows().begin(), evidence_.rows().end(), on_bus)) {
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
            result_.outcome = Outcome::unknown;
        }
        if (!is_clock(found.ratio)) {
            refute(
                fmt::format("a clock of {:.3g} times the core's would explain the rows, and no counter runs at such "
                            "a ratio: another core was measured, or another program",
                            found.ratio));
        }
        if (found.overhead < -qemu::allowed_cycles) {
            refute(fmt::format("a call would cost {:.3g} cycles beside the kernel, and none costs less than nothing",
                               found.overhead));
        }
        if (result_.outcome == Outcome::attributed) {
            for (const LineLeft& line : lines_left(evidence_, evidence_.whole(found))) {
                if (!is_met(line)) {
                    refute(
                        fmt::format("{} {}: slope off by {:.1f} %, its shortest calls by {:.0f} cycles: a cause "
                                    "explains every kernel",
                                    line.kernel, line.placement, 100.0 * line.slope, line.constant));
                }
            }
        }
    }
    void refute(std::string why) {
        result_.outcome = Outcome::unknown;
        result_.notes.push_back(std::move(why));
    }
    [[nodiscard]] bool has_set(const std::string& core, const std::string& set) const {
        const auto found = question_.sets.find(core);
        return found != question_.sets.end() &&
               std::find(found->second.begin(), found->second.end(), set) != found->second.end();
    }
    // Of a program of anybody's: whether its call waits for results of the floating-point unit.
    bool is_floating(State state, std::size_t row) {
        if (const glsum::CatalogueEntry* const kernel = glsum::find_kernel(evidence_.rows()[row].kernel)) {
            return kernel->floating_point;
        }
        state.off.erase("fpu_latency");
        return evidence_.predicted(state)[row].half_cycles[timing::index(timing::Effect::fpu_latency)] > 0;
    }
    bool any_floating(const State& state) {
        for (std::size_t i = 0; i < evidence_.rows().size(); ++i) {
            if (is_floating(state, i)) {
                return true;
            }
        }
        return false;
    }
    // With the costs beside the call that another state has.
    double fitted_gap_of(State& state, const State& like) {
        state.overhead = like.overhead;
        state.maintenance = like.maintenance;
        return evidence_.judged_gap(evidence_.whole(state));
    }

    // What published rules leave is proportional to the length, in rows of floating-point kernels of one placement: any
    // effect that acts there at each tap explains it, and these rows cannot part them.
    void part_rules(const State& found, const State& published) {
        const Cycles by_rules = evidence_.whole(published);
        Cycles after = by_rules;
        std::map<std::string, Rows> groups;
        for (std::size_t i = 0; i < evidence_.rows().size(); ++i) {
            const auto& row = evidence_.rows()[i];
            groups[fmt::format("{} {}", format_of(row.kernel), placement_of(row))].push_back(i);
        }
        std::map<std::string, double> a_tap;
        for (const auto& [name, rows] : groups) {
            std::vector<double> taps;
            std::vector<double> rest;
            for (const std::size_t i : rows) {
                taps.push_back(evidence_.rows()[i].taps);
                rest.push_back(evidence_.measured()[i] - by_rules[i]);
            }
            const double slope = qemu::fit_line(taps, rest).slope;
            if (!is_floating(found, rows.front()) || std::fabs(slope) < 0.2) {
                continue;
            }
            a_tap["cycles_per_tap " + name] = slope;
            for (const std::size_t i : rows) {
                after[i] += slope * evidence_.rows()[i].taps;
            }
        }
        const double before = evidence_.judged_gap(by_rules);
        result_.after_gap = evidence_.judged_gap(after);
        for (const char* effect : {"fpu_latency", "load_bank_conflict", "store_buffer", "load_use"}) {
            result_.alternatives.push_back({effect, a_tap, {}, before, result_.after_gap, 0.25});
        }
        result_.apart = "floating-point rows, by their length, beyond published rules";
        result_.outcome = Outcome::ambiguous;
        std::string fits;
        for (const std::string& set : question_.fitting.at(found.core)) {
            State state = found;
            state.set = set;
            fits +=
                fmt::format("{}{} leaves {:.2f} %", fits.empty() ? "" : ", ", set, 100.0 * fitted_gap_of(state, found));
        }
        result_.notes.push_back(fmt::format("of the rule sets in the core file {}: {}", found.core, fits));
    }

    const Question& question_;
    Evidence evidence_;
    double base_overhead_ = 0.0;
    double base_maintained_ = 0.0;
    Explanation result_;
};

}  // namespace

Explanation explain(const Question& question, const Predict& predict) { return Explainer(question, predict).run(); }

}  // namespace gap::cycles
