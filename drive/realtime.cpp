#include "drive/realtime.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drive/simulation.hpp"
#include "qemu/failure.hpp"

namespace drive {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

double power_of_two_above(double value) {
    return value > 0.0 && std::isfinite(value) ? std::exp2(std::ceil(std::log2(1.01 * value))) : 1.0;
}

}  // namespace

const char* word_of(Writing writing) {
    return writing == Writing::delta ? "delta" : writing == Writing::apart ? "apart" : "";
}

std::string realtime_name(const std::string& kernel, Writing writing) {
    const auto end = kernel.find('_');
    return kernel.substr(0, end) + word_of(writing) + kernel.substr(end);
}

RealtimeModel::RealtimeModel(const Model& model, Writing writing, std::size_t taps, double step_s) {
    if (!(step_s > 0.0 && std::isfinite(step_s)) || taps == 0) {
        refuse(fmt::format("expected a step above 0 s and at least 1 tap, found {} s and {}", step_s, taps));
    }
    if (model.numerator.size() != 1 || model.numerator[0].order != 0.0) {
        refuse("expected a numerator without derivatives: real-time stepping takes the input as it is");
    }
    const bool delta = writing == Writing::delta;
    const double constant = constant_coefficient(model.denominator);
    // The tables, h^-order included; their newest coefficients together are what is divided by.
    std::vector<std::vector<double>> weights;
    if (writing == Writing::apart) {
        for (const Term& term : model.denominator) {
            if (term.order != 0.0 && term.coefficient != 0.0) {
                weights.push_back(merged_weights({term}, step_s, taps));
            }
        }
    } else {
        weights.push_back(merged_weights(model.denominator, step_s, taps, delta));
    }
    double newest = delta || writing == Writing::apart ? constant : 0.0;
    for (const auto& table : weights) {
        newest += table[0];
    }
    for (std::vector<double>& table : weights) {
        while (table.size() > 1 && table.back() == 0.0) {
            table.pop_back();
        }
        taps_ = std::max(taps_, table.size());
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
    design_.increments = delta;
    design_.delay = static_cast<std::uint32_t>(std::ceil(model.delay_s / step_s - 1e-9));
    design_.input = model.gain * model.numerator[0].coefficient / newest;
    design_.constant = delta ? constant / newest : 0.0;
    design_.tables = tables_;
    // What the scheme answers to an impulse bounds what it can answer to any input: the sums of the magnitudes of y and
    // of its increments.
    Model undelayed = model;
    undelayed.delay_s = 0.0;
    const Scheme scheme{.step_s = step_s, .taps = taps, .increments = delta};
    const std::size_t samples = std::max<std::size_t>(20'001, 4 * taps);
    std::vector<double> impulse(samples, 0.0);
    impulse[0] = 1.0;
    const std::vector<double> answer = simulate(undelayed, scheme, impulse).output;
    double most = 0.0;
    double most_of_increments = 0.0;
    for (std::size_t k = 1; k < samples; ++k) {
        most += std::fabs(answer[k]);
        most_of_increments += std::fabs(answer[k] - answer[k - 1]);
    }
    design_.input_full_scale = 2.0;  // so that an input of 1 is exact
    design_.output_full_scale = power_of_two_above(most);
    design_.stored_full_scale = delta ? power_of_two_above(most_of_increments) : design_.output_full_scale;
}

std::size_t largest_taps(double short_taps, double short_cost, double long_taps, double long_cost, double budget) {
    const double slope = (long_cost - short_cost) / (long_taps - short_taps);
    const double reach = short_taps + (budget - short_cost) / slope;
    return slope > 0.0 && reach >= 1.0 ? static_cast<std::size_t>(reach) : 0;
}

}  // namespace drive
