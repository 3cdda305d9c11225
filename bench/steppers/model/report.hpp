// What is said of a generated model: in its header's comment, to people, and as a file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/steppers/model/model_choice.hpp"
#include "bench/steppers/stepper/verify.hpp"

namespace generate {

struct ModelReport {
    std::string model;   ///< its file
    std::string header;  ///< the one that was written
    ModelChoice choice;
    double max_error;
    std::vector<CheckedBits> checked = {};
    std::string core = {};  ///< of the timing model
    std::optional<StepCost> cost = {};
};

/// Lines without an indentation: how far it is off, and why it stays stable.
[[nodiscard]] std::vector<std::string> to_lines(const ModelChoice& choice);

/// Schema `glsum-model-1`.
[[nodiscard]] std::string to_json(const ModelReport& report);

}  // namespace generate
