#include "drive/tune/flat_phase.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace tune {

PlantPoint point_of(const SampledPlant& plant, double w) {
    constexpr double near = 1e-4;
    const Complex ratio = plant(w * (1.0 + near)) / plant(w * (1.0 - near));
    return {w, plant(w), std::arg(ratio) / (2.0 * near)};
}

std::optional<drive::Gains> gains_for(const Target& target, drive::Gains orders, const PlantPoint& plant,
                                      double step_s) {
    const Complex wanted = std::polar(1.0, target.margin_rad - std::numbers::pi) / plant.value;
    const Parts parts = controller_parts(orders, step_s, plant.w);
    Eigen::Matrix3d equations;
    for (int i = 0; i < 3; ++i) {
        equations(0, i) = (parts.value[i] / wanted).real();
        equations(1, i) = (parts.value[i] / wanted).imag();
        // With C = wanted, d arg C = Im (dC / C).
        equations(2, i) = (parts.slope[i] / wanted).imag();
    }
    const Eigen::ColPivHouseholderQR<Eigen::Matrix3d> solver(equations);
    if (!solver.isInvertible()) {
        return std::nullopt;
    }
    const Eigen::Vector3d gains = solver.solve(Eigen::Vector3d(1.0, 0.0, target.slope_rad - plant.phase_slope));
    orders.kp = gains(0);
    orders.ki = gains(1);
    orders.kd = gains(2);
    return gains.allFinite() ? std::optional(orders) : std::nullopt;
}

}  // namespace tune
