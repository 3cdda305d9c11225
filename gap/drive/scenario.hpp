// A simulation with whatever effects are to be in it: what goes in, how it moves, how it is read.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drive/model.hpp"
#include "gap/drive/record.hpp"

namespace gap {

/// The output cannot pass a limit; what arrives with a speed leaves with `restitution` of it.
struct EndStop {
    double limit;
    double restitution;
};

/// An outside force for a time, counted from the record's first stamp.
struct Push {
    double from_s;
    double to_s;
    double size;
};

/// The restoring term a_0 y becomes a_0 f(y + operating point) - f(operating point), as an outflow that grows with a
/// power p = 1 + c of the level: f(y) = sign(y) reference ((|y| / reference + e)^p - e^p) / ((1 + e)^p - e^p). Of a
/// root p is 1/2. e = 0.01 keeps the slope at 0 finite.
struct Outflow {
    double curvature;
    double reference;
};

/// A force that is locked to the place, size sin(2 pi per_unit y + phase); of a speed, to its integral over the record.
struct Cogging {
    double size;
    double per_unit;
    double phase_rad;
    bool of_speed;
};

/// In units of the model's right-hand side. Each is solved for within the step, so that what sticks, sticks.
struct Forces {
    double friction_up = 0.0;    ///< against motion upwards, at least 0
    double friction_down = 0.0;  ///< against motion downwards
    /// Friction beside both: so much of |what drives| + |what restores|. In [0, 1).
    double friction_share = 0.0;
    bool friction_of_speed = false;  ///< the output is a speed: up and down are its signs; it stands at 0
    double drag = 0.0;               ///< drag y' |y'|
    double drag_of_speed = 0.0;      ///< drag y |y|: the output is a speed
    double angle_per_unit = 0.0;     ///< kappa: a_0 sin(kappa y) / kappa instead of a_0 y; 0: linear
    double cubic = 0.0;              ///< c: c y^3 more in the bracket of a_0
    double bias = 0.0;               ///< always there
    std::vector<Cogging> cogging;
    std::optional<Outflow> outflow;
    std::optional<EndStop> stop;
    std::vector<Push> pushes;
};

/// Another input of the record, added to the effective one behind a first-order lag.
struct FurtherInput {
    std::size_t number;  ///< in the record's further inputs
    double gain;
    double tau_s;
};

/// What was run instead of the model: the Grünwald-Letnikov scheme in some numbers, over some memory.
struct Deployed {
    double step_s;       ///< 0: the model's own sample time, or the record's
    double taps;         ///< 0: all; between whole numbers, a mixture of both
    std::string kernel;  ///< empty: double
    bool increments = false;
};

/// What an output stage may look at, by nodes.
struct Motion {
    const Grid& grid;
    std::span<const double> input;   ///< the effective input, before the dead time
    std::span<const double> output;  ///< y
};

/// At the stamps, on the levels that are held from each to the next: exact for what has no memory.
using LevelStage = std::function<void(std::span<double> levels)>;
using InputStage = std::function<void(std::span<double> held, const Grid& grid)>;
using OutputStage = std::function<void(std::span<double> reading, const Motion& motion)>;
/// At the stamps: what the logger does with a reading.
using LoggerStage = std::function<void(std::span<double> reading, const Record& record)>;

struct Scenario {
    drive::Model model;
    double initial_output = 0.0;    ///< where it rests before the record
    double initial_velocity = 0.0;  ///< per second
    double operating_output = 0.0;  ///< added to the model's output: the point that it is linear about
    double input_before = 0.0;      ///< the record: over the dead time, and where actuators with a memory begin
    std::vector<LevelStage> levels;
    std::vector<InputStage> input;
    std::vector<FurtherInput> further_inputs;
    Forces forces;
    std::vector<OutputStage> output;
    std::vector<LoggerStage> logger;
    std::optional<Deployed> deployed;
    double jitter_s = 0.0;  ///< half width of what stamps are off by: spreads readings, moves none
};

}  // namespace gap
