// Records that could be taken: what is put in, of which length.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace gap {

struct Excitation {
    std::string text;
    double length_s;
    std::function<double(double share, double time_s)> level;  ///< of the record's length; in 0 to 1
};

/// A staircase, random bits, a swept sine, pulses and a level that is held; where the record is long beside the time
/// constant, a staircase as long, too.
[[nodiscard]] std::vector<Excitation> excitations(double time_constant_s, double record_s);

}  // namespace gap
