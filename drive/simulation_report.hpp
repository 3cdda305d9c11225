// A simulation for people and as a file, beside the exact response where that is known.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "drive/exact_step_response.hpp"
#include "drive/log.hpp"
#include "drive/simulation.hpp"

namespace drive {

struct SimulationReport {
    std::string method;         ///< how the output came about, in words
    Log record;                 ///< called as its input; with the simulated output
    std::vector<double> exact;  ///< at the same stamps; empty: not compared
    std::string why_not;        ///< compared
    std::size_t saturations = 0;
    double full_scale = 0.0;  ///< of fixed point
};

/// "ring_oldest_f32, increments, 600 taps, h = 0.001 s"
[[nodiscard]] std::string in_words(const Scheme& scheme);

/// The exact response. \throws glsum::Failure where there is none
[[nodiscard]] SimulationReport simulate_exactly(const Model& model, Log record);

/// By the scheme, beside the exact response where that is wanted and there is one.
[[nodiscard]] SimulationReport simulate(const Model& model, const Scheme& scheme, Log record, bool compare);

[[nodiscard]] std::string to_text(const SimulationReport& report, const Model& model);

/// \param model  its file. An output that is not a number is null.
[[nodiscard]] std::string to_json(const SimulationReport& report, const std::string& model);

/// The oracle's digits at a time.
struct ExactPoint {
    double time_s;
    ExactValue value;
};
[[nodiscard]] std::string to_text(const std::vector<ExactPoint>& points);
[[nodiscard]] std::string to_json(const std::vector<ExactPoint>& points);

}  // namespace drive
