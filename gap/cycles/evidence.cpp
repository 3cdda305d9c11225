#include "gap/cycles/evidence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace gap::cycles {
namespace {

std::string key_of(const State& state) {
    return fmt::format("{} {} {}", state.core, state.set, fmt::join(state.off, ","));
}

}  // namespace

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

std::string placement_of(const qemu::MeasuredCycles& row) {
    return fmt::format("code={} data={}{}", row.code, row.data, row.maintenance ? " maintenance" : "");
}

bool on_bus(const qemu::MeasuredCycles& row) { return row.code == "flash" || row.code == "axi" || row.data == "axi"; }

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

Evidence::Evidence(const Question& question, const Predict& predict) : question_(question), predict_(predict) {
    for (const qemu::MeasuredCycles& row : question.rows) {
        measured_.push_back(row.cycles);
    }
    std::map<std::tuple<std::string, std::string>, unsigned> seen;
    for (std::size_t i = 0; i < question_.rows.size(); ++i) {
        const auto& row = question_.rows[i];
        (seen[{row.kernel, placement_of(row)}]++ % 2 == 0 ? fit_ : judge_).push_back(i);
    }
    if (std::any_of(seen.begin(), seen.end(), [](const auto& one) { return one.second < 2; })) {
        fit_.resize(question_.rows.size());
        std::iota(fit_.begin(), fit_.end(), std::size_t{0});
        judge_ = fit_;
        judged_by_itself_ = true;
    }
}

double Evidence::floor() const {
    std::map<std::tuple<std::string, std::string, std::string, std::uint32_t>, Rows> repeats;
    for (std::size_t i = 0; i < question_.rows.size(); ++i) {
        const auto& row = question_.rows[i];
        repeats[{row.program, row.kernel, placement_of(row), row.taps}].push_back(i);
    }
    double sum = 0.0;
    double all = 0.0;
    for (const auto& [key, rows] : repeats) {
        std::vector<double> cycles;
        for (const std::size_t i : rows) {
            cycles.push_back(measured_[i]);
        }
        const double middle = median(cycles);
        for (const std::size_t i : rows) {
            sum += std::max(0.5, std::fabs(measured_[i] - middle)) / question_.rows[i].per;
            all += measured_[i] / question_.rows[i].per;
        }
    }
    return sum / all;
}

double Evidence::gap(const Cycles& predicted, const Rows& rows) const {
    Cycles measured = measured_;
    Cycles compared = predicted;
    for (const std::size_t i : rows) {
        measured[i] /= question_.rows[i].per;
        compared[i] /= question_.rows[i].per;
    }
    return gap_of(measured, compared, rows);
}

void Evidence::simulate(const std::vector<State>& states) {
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

const std::vector<qemu::PredictedCycles>& Evidence::predicted(const State& state) {
    simulate({state});
    return known_.at(key_of(state));
}

Cycles Evidence::inside(const State& state) {
    Cycles cycles;
    for (const qemu::PredictedCycles& p : predicted(state)) {
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

Cycles Evidence::whole(const State& state) {
    Cycles cycles = inside(state);
    for (std::size_t i = 0; i < cycles.size(); ++i) {
        cycles[i] += state.overhead + (question_.rows[i].maintenance ? state.maintenance : 0.0);
    }
    return cycles;
}

void Evidence::fit_beside(State& state, const Rows& rows) {
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

double Evidence::fitted_gap(State& state) {
    fit_beside(state, fit_);
    return gap(whole(state), fit_);
}

}  // namespace gap::cycles
