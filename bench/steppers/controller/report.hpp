// What is said of a generated controller: in its header's comment, to people, and as a file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/steppers/controller/loop.hpp"
#include "bench/steppers/stepper/verify.hpp"
#include "drive/tune/margins.hpp"

namespace generate {

/// Of the loop with a plant.
struct LoopReport {
    std::string plant;       ///< its file
    std::string plant_text;  ///< as a person reads it
    LoopDeviation deviation;
    tune::Margins margins;
};

struct ControllerReport {
    std::string controller;  ///< its file
    std::string header;      ///< the one that was written
    std::optional<LoopReport> loop = {};
    std::vector<CheckedBits> checked = {};
    std::string core = {};  ///< of the timing model
    std::optional<StepCost> cost = {};
    std::optional<StepCost> whole = {};  ///< of the integer PID of the same gains
};

/// Lines without an indentation.
[[nodiscard]] std::vector<std::string> to_lines(const LoopReport& loop, const ControllerSpec& spec);

/// What a step costs beside the integer PID's; nothing without a cost.
[[nodiscard]] std::string cost_table(const ControllerReport& report);

/// Schema `glsum-controller-1`; what is infinite is left out.
[[nodiscard]] std::string to_json(const ControllerReport& report, const ControllerSpec& spec);

}  // namespace generate
