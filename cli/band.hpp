// A band of frequencies, as options have it.
#pragma once

#include <string>

#include "glsum/design/derivative.hpp"

namespace cli {

/// An hour at 10 kHz and more: no record that a derivative is judged by is longer.
inline constexpr double most_samples = 5e7;

/// Of "0.05..80", in Hz. \throws glsum::Failure (bad input) naming the option: for what is no rising band above 0, one
/// beyond half the sampling rate, or with a period of more than `most_samples`
[[nodiscard]] glsum::design::Band to_band(const char* option, const std::string& text, double step_s);

}  // namespace cli
