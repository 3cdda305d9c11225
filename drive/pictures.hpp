// Pictures of the drive, as gnuplot scripts.
#pragma once

#include <string>
#include <vector>

#include "base/gnuplot.hpp"
#include "drive/record.hpp"
#include "drive/stability.hpp"

namespace drive {

struct Curve {
    std::string title;
    std::vector<double> time_s;
    std::vector<double> value;
    bool points = false;  ///< measured samples
};

enum class Axis { linear, logarithmic };

/// Curves over time, each with its title in the key below. On a logarithmic axis values are above 0.
[[nodiscard]] base::Picture picture_of_curves(const std::vector<Curve>& curves, const std::string& title,
                                              const std::string& unit, Axis axis = Axis::linear);

/// The transfer function with 4 digits, as a title has room for.
[[nodiscard]] std::string short_text(Model model);

/// A record, the start's response and the fitted one. The title says the variance explained, 1 - |e|^2 / |y - mean|^2,
/// and both residuals' rms in the output's unit, then the model. \throws glsum::Failure (bad input) as
/// `compute_indices`.
[[nodiscard]] base::Picture picture_of_fit(const Record& record, const std::vector<double>& start,
                                           const std::vector<double>& fitted, const Model& model);

/// The roots in the plane of sigma = s^q with the unstable sector, and on the right that sector at close range, as in
/// [Matusiak2020] Figs. 5 to 7. The title says how far the nearest root keeps from that sector, then `model`.
[[nodiscard]] base::Picture picture_of_roots(const StabilityVerdict& judged, const std::string& model);

}  // namespace drive
