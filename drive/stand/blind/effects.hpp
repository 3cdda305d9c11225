// How large the effects of blind cases are, and how they get into a plant.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "drive/stand/blind/plant.hpp"
#include "drive/stand/chance.hpp"

namespace stand::blind {

/// What sizes are measured by.
struct Scale {
    double full_input;
    double full_output;
    double force;  ///< of the plant at the full input: its gain times the input
    double tau_s;
    double interval_s;
    double until_s;
    double charge;  ///< integral of the input over a record
};

/// What a plant is, what acts on it and how it is read.
struct Setup {
    bool physical = false;  ///< the stand; the linear plant otherwise
    Stand stand;            ///< effects, and the parts of a physical one
    Plant plant;
    Unlisted unlisted;
    double missed_at_s = 0.0;
    double missed_size = 0.0;
};

enum class EffectSize { small, clear, large };
[[nodiscard]] const char* name_of(EffectSize size);

using Parameters = std::map<std::string, double>;

/// Effects of the diagnosis' table that a log can show; the errors of a deployed simulation are not among them.
[[nodiscard]] const std::vector<std::string>& listed_effects();
/// Effects that no table has; `start_up_time` is the stand's alone, the others are the linear plant's.
[[nodiscard]] const std::vector<std::string>& unlisted_effects();

/// Whether an effect is one that the stand cannot have.
[[nodiscard]] bool needs_linear_plant(const std::string& effect);
/// A first-order lag, which commutes with whatever is linear.
[[nodiscard]] bool is_lag(const std::string& effect);
/// Memoryless from the command to the force: at one level, a gain.
[[nodiscard]] bool bends_the_input(const std::string& effect);

/// Parameters by the table's names. \param one_level  that the input alone has: supply_sag by its resistance, which is
/// memoryless, and input_curve with another reference
[[nodiscard]] Parameters draw_parameters(const std::string& effect, EffectSize size, const Scale& scale, bool one_level,
                                         Chance& chance);
/// Of an effect that is an event: where in this record. Others stay as they are.
void draw_event(const std::string& effect, Parameters& parameters, const Scale& scale, Chance& chance);

void apply(const std::string& effect, const Parameters& parameters, Setup& setup);

}  // namespace stand::blind
