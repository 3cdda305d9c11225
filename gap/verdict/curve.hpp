// What a verdict's page draws.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace gap {

/// Of one record that was judged, by its stamps.
struct Curve {
    std::string name;
    std::vector<double> time_s;
    std::vector<double> measured;
    std::vector<double> left_by_base;    ///< measured - simulated
    std::vector<double> left_by_chosen;  ///< with what helps most; empty: nothing does
    std::vector<double> input = {};      ///< held from its stamp to the next; empty: not drawn
};

/// A record that could be taken next, simulated.
struct NextRecord {
    std::string text;
    std::vector<double> time_s;
    std::vector<double> input;
    std::vector<std::pair<std::string, std::vector<double>>> outputs;  ///< by what would cause them
};

}  // namespace gap
