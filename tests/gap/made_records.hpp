// Records that are made from a known input, and what models of them answer.
#pragma once

#include <functional>
#include <vector>

#include "gap/drive/simulate.hpp"

namespace gap_test {

constexpr double h = 0.25;

inline gap::Record record_of(std::size_t count, const std::function<double(double)>& input) {
    gap::Record record;
    record.name = "made";
    record.usual_interval_s = h;
    for (std::size_t i = 0; i < count; ++i) {
        record.time_s.push_back(h * static_cast<double>(i));
        record.input.push_back(input(record.time_s.back()));
        record.output.push_back(0.0);
    }
    return record;
}

inline double levels(double t) {
    constexpr double held[] = {0.0, 1.0, 0.3, 0.8, -0.5, 0.6, -1.0, 0.2, 0.9, -0.3, 0.5, 0.0};
    return held[static_cast<std::size_t>(t / 5.0) % 12];
}

// Simulated on the grid of the records' own stamps, as starts are compared.
inline std::vector<double> response(const gap::Record& record, const drive::Model& model, double initial_output = 0.0,
                                    double initial_velocity = 0.0, double bias = 0.0) {
    gap::Scenario scenario;
    scenario.model = model;
    scenario.initial_output = initial_output;
    scenario.initial_velocity = initial_velocity;
    scenario.forces.bias = bias;
    return gap::simulate(scenario, gap::Course(record, 1));
}

inline drive::Model of(std::vector<drive::Term> denominator) {
    drive::Model model;
    model.denominator = std::move(denominator);
    return model;
}

inline std::vector<gap::Course> courses_of(const std::vector<gap::Record>& records) {
    std::vector<gap::Course> courses;
    for (const gap::Record& record : records) {
        courses.emplace_back(record, 1);
    }
    return courses;
}

}  // namespace gap_test
