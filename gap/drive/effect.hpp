// An effect that a simulation may lack: what it does to a scenario, with which parameters.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "gap/drive/scenario.hpp"

namespace gap {

/// How large things are in the training records, for bounds and starts.
struct Scales {
    double input_max;   ///< of |u|
    double output_low;  ///< of the readings
    double output_high;
    double output_span;
    double speed_max;  ///< of |dz/dt|, smoothed
    double force;      ///< of the right-hand side: gain times the input
    double length_s;
    double interval_s;
    double time_constant_s;  ///< of the model: how long it takes to most of its way
};

struct EffectParameter {
    std::string name;
    std::string unit;
    double lower;
    double upper;
    double none;                 ///< the value at which the effect is not there
    std::vector<double> starts;  ///< fits begin at each
};

/// What an effect is bound to.
enum class Kind {
    lasting,  ///< keeps its fitted parameters in other records
    event,    ///< happens at its own times in each record: located afresh
};

struct Effect {
    std::string name;
    Kind kind;
    std::vector<EffectParameter> (*parameters)(const Scales& scales);
    /// \param values  in the order of `parameters`
    void (*add_to)(Scenario& scenario, std::span<const double> values);
};

/// All that there are, in the order of the list (effects.def).
[[nodiscard]] const std::vector<const Effect*>& effects();
/// \throws glsum::Failure (bad input) naming those there are
[[nodiscard]] const Effect& effect_named(const std::string& name);

}  // namespace gap
