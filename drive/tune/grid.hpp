// A loop's stability and largest |S| on a fixed grid of frequencies: what a search asks thousands of times.
#pragma once

#include <vector>

#include "drive/tune/loop.hpp"

namespace tune {

/// What `margins_of` finds by a dense sweep, from a few hundred frequencies that are evaluated once.
class Grid {
public:
    explicit Grid(const SampledPlant& plant);

    struct Answer {
        int unstable_poles;
        double sensitivity;
        double phase_rad;  ///< the least margin of phase at frequencies where |L| crosses 1; pi without one
    };
    /// Where the dead time turns faster than the grid's spacing, every phase is taken to occur.
    [[nodiscard]] Answer operator()(const drive::Gains& gains) const;

private:
    struct Point {
        Complex plant;
        Complex difference;  // D
        Complex logarithm;   // of it
        bool spins;          // the phase turns by more than one sees
    };
    std::vector<Point> points_;
    double integrations_;
};

}  // namespace tune
