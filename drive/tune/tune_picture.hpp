// The picture of what was tuned.
#pragma once

#include "base/gnuplot.hpp"
#include "drive/tune/tune.hpp"

namespace tune {

/// Gain and phase of the open loop, |S|, and the trial's output and input, fractional and integer side by side.
[[nodiscard]] base::Picture picture_of(const Tuned& tuned, const std::string& name);

}  // namespace tune
