#include "drive/realtime.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/failure.hpp"
#include "drive/simulation.hpp"
#include "glsum/design/merged.hpp"

namespace drive {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

double power_of_two_above(double value) {
    return value > 0.0 && std::isfinite(value) ? std::exp2(std::ceil(std::log2(1.01 * value))) : 1.0;
}

}  // namespace

const char* word_of(Writing writing) {
    switch (writing) {
        case Writing::merged:
            return "";
        case Writing::delta:
            return "delta";
        case Writing::apart:
            return "apart";
        case Writing::bdf2:
            return "bdf2";
    }
    return "";
}

std::string realtime_name(const std::string& kernel, Writing writing) {
    const auto end = kernel.find('_');
    return kernel.substr(0, end) + word_of(writing) + kernel.substr(end);
}

RealtimeModel::RealtimeModel(const Model& model, Writing writing, const Memory& memory, double step_s,
                             std::size_t horizon) {
    const std::size_t near_taps = memory.taps - std::min(2 * memory.modes, memory.taps);
    if (!(step_s > 0.0 && std::isfinite(step_s)) || near_taps == 0) {
        refuse(fmt::format("expected a step above 0 s and at least 1 tap, found {} s and {}", step_s, near_taps));
    }
    const bool increments = writing == Writing::delta || writing == Writing::bdf2;
    if (memory.modes > 0 && (!increments || near_taps < 2)) {
        refuse(fmt::format("expected modes on increments and behind at least 2 taps, found {}", memory.text()));
    }
    if (model.numerator.size() != 1 || model.numerator[0].order != 0.0) {
        refuse("expected a numerator without derivatives: real-time stepping takes the input as it is");
    }
    const double constant = constant_coefficient(model.denominator);
    // The tables, h^-order included; their newest coefficients together are what is divided by.
    std::vector<std::vector<double>> weights;
    if (writing == Writing::apart) {
        for (const Term& term : model.denominator) {
            if (term.order != 0.0 && term.coefficient != 0.0) {
                weights.push_back(merged_weights({term}, step_s, near_taps));
            }
        }
    } else if (writing == Writing::merged) {
        weights.push_back(merged_weights(model.denominator, step_s, near_taps));
    } else {
        const auto discretisation = writing == Writing::bdf2 ? glsum::design::Discretisation::bdf2
                                                             : glsum::design::Discretisation::grunwald_letnikov;
        std::vector<glsum::design::Term> terms;
        for (const Term& term : model.denominator) {
            if (term.order != 0.0 && term.coefficient != 0.0) {
                terms.push_back({term.coefficient, term.order});
            }
        }
        weights.push_back(glsum::design::merged_weights(terms, step_s, discretisation, near_taps - 1));
        if (memory.modes > 0) {
            auto found = glsum::design::approximate_merged(terms, step_s, discretisation, std::max(horizon, near_taps),
                                                           near_taps, memory.modes);
            modes_ = std::move(found.modes);
            loop_gain_ = found.error;
        }
    }
    double newest = increments || writing == Writing::apart ? constant : 0.0;
    for (const auto& table : weights) {
        newest += table[0];
    }
    for (std::vector<double>& table : weights) {
        while (modes_.empty() && table.size() > 1 && table.back() == 0.0) {
            table.pop_back();
        }
        memory_.taps = std::max(memory_.taps, table.size());
        if (table.size() == 1) {
            continue;
        }
        if (table[1] == 0.0) {
            refuse("expected a first past coefficient other than 0");
        }
        std::vector<double> ratios(table.begin() + 2, table.end());
        for (double& ratio : ratios) {
            ratio /= table[1];
        }
        ratios_.push_back(std::move(ratios));
        tables_.push_back({table[1] / newest, {}});
    }
    if (tables_.size() > glsum::most_tables) {
        refuse(fmt::format("expected at most {} orders, found {}", glsum::most_tables, tables_.size()));
    }
    for (std::size_t i = 0; i < tables_.size(); ++i) {
        tables_[i].ratios = ratios_[i];
    }
    if (!modes_.empty()) {  // of the one table that there is then
        for (glsum::Mode& mode : modes_) {
            mode.weight /= weights[0][1];
        }
        memory_ = {memory_.taps + 2 * modes_.size(), modes_.size()};
        tables_[0].modes = modes_;
    }
    design_.increments = increments;
    design_.half_input = writing == Writing::bdf2;
    design_.delay = static_cast<std::uint32_t>(std::ceil(model.delay_s / step_s - 1e-9));
    design_.input = model.gain * model.numerator[0].coefficient / newest;
    design_.constant = increments ? constant / newest : 0.0;
    design_.tables = tables_;
    // What the scheme answers to an impulse bounds what it can answer to any input: the sums of the magnitudes of y and
    // of its increments.
    Model undelayed = model;
    undelayed.delay_s = 0.0;
    Scheme scheme{.step_s = step_s, .increments = increments};
    if (modes_.empty()) {
        scheme.taps = memory.taps;
    }
    const std::size_t samples = std::max<std::size_t>(20'001, 4 * memory.taps);
    std::vector<double> impulse(samples, 0.0);
    impulse[0] = 1.0;
    const std::vector<double> answer = simulate(undelayed, scheme, impulse).output;
    double most = 0.0;
    double most_of_increments = 0.0;
    for (std::size_t k = 1; k < samples; ++k) {
        most += std::fabs(answer[k]);
        most_of_increments += std::fabs(answer[k] - answer[k - 1]);
    }
    if (!modes_.empty()) {
        loop_gain_ *= most_of_increments / std::fabs(model.gain * model.numerator[0].coefficient);
        if (!(loop_gain_ < 1.0)) {
            refuse(
                fmt::format("expected more taps or modes than {}: with a loop gain of {:.3g}, 1 or above, they need "
                            "not be stable",
                            memory.text(), loop_gain_));
        }
    }
    design_.input_full_scale = 2.0;  // so that an input of 1 is exact
    design_.output_full_scale = power_of_two_above(most);
    design_.stored_full_scale = increments ? power_of_two_above(most_of_increments) : design_.output_full_scale;
    // The output is read from a sum of increments: it cannot have a unit below theirs.
    design_.output_full_scale = std::max(design_.output_full_scale, design_.stored_full_scale);
}

std::size_t largest_taps(double short_taps, double short_cost, double long_taps, double long_cost, double budget) {
    const double slope = (long_cost - short_cost) / (long_taps - short_taps);
    const double reach = short_taps + (budget - short_cost) / slope;
    return slope > 0.0 && reach >= 1.0 ? static_cast<std::size_t>(reach) : 0;
}

}  // namespace drive
