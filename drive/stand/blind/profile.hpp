// What a case's plant is given: excitations by kind, with chance in their times and levels.
#pragma once

#include <string>
#include <vector>

#include "drive/stand/blind/plant.hpp"
#include "drive/stand/chance.hpp"

namespace stand::blind {

/// `step`, `on_off`, `staircase`, `levels`, `ramp`, `chirp`, `prbs`.
[[nodiscard]] const std::vector<std::string>& profile_kinds();

/// Whether a record of this kind holds one level besides 0.
[[nodiscard]] bool has_one_level(const std::string& kind);

struct Clock {
    double interval_s = 0.01;
    double spread_s = 0.0;  ///< stamps lie up to this beside the even ones, and say so
    double until_s = 40.0;
};

/// Stamps and inputs between 0 and `high`, resting at 0 for a moment at first. \param tau_s  the plant's own time,
/// which holds and frequencies follow
[[nodiscard]] Held make_profile(const std::string& kind, const Clock& clock, double high, double tau_s, Chance& chance);

}  // namespace stand::blind
