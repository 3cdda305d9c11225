// How fast the error of a filter may bend over the band: between two frequencies it lies no higher than that says.
#pragma once

#include "glsum/design/derivative.hpp"

namespace glsum::design {

/// Bound of |d^2/da^2 (H(e^ia) - (ia/h)^v)| for angles in an interval: term by term, reached at 0 by weights of one
/// sign. Outlived by filter and goal.
class Curvature {
public:
    Curvature(const Filter& filter, const DerivativeGoal& goal);
    /// \pre 0 < low <= high <= pi
    [[nodiscard]] double bound(double low, double high) const;

private:
    const Filter& filter_;
    const DerivativeGoal& goal_;
    double of_taps_ = 0.0;
};

}  // namespace glsum::design
