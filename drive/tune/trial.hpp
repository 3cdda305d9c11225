// A sampled controller with its limits around a continuous plant, stepped: a set point, then a load.
#pragma once

#include <vector>

#include "drive/controller_file.hpp"
#include "drive/tune/loop.hpp"

namespace tune {

/// From rest: the set point steps at 0, and after `until_s` a load is added to the plant's input, for as long again.
struct Trial {
    double setpoint = 1.0;
    double load = 0.5;
    double until_s = 10.0;
};

struct Course {
    std::vector<double> time_s;
    std::vector<double> output;
    std::vector<double> input;  ///< what the controller puts out from each stamp on
    double setpoint_iae = 0.0;  ///< integral of |set point - output| until the load comes
    double load_iae = 0.0;      ///< and from then on
    double overshoot = 0.0;     ///< of the set point, as a part of it
    bool limited = false;       ///< whether the input met a limit
};

inline constexpr std::size_t most_trial_samples = 400'000;

/// The plant's output is exact for the held input; the controller is stepped in velocity form, all of its past in
/// memory, and stops at its limits, as `glsum::Controller` does.
/// \throws glsum::Failure (bad input) for more than `most_trial_samples`; (check failed) as `drive::StepResponse`
[[nodiscard]] Course run(const SampledPlant& plant, const drive::Fopid& controller, const Trial& trial);

}  // namespace tune
