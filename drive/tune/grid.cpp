#include "drive/tune/grid.hpp"

#include <algorithm>
#include <cmath>

namespace tune {
namespace {

constexpr double ratio = 0.04;          // of the spacing to the frequency
constexpr double phase_step = 0.25;     // of the dead time
constexpr double longest_phase = 40.0;  // of the dead time: beyond, its phase spins

}  // namespace

Grid::Grid(const SampledPlant& plant) : integrations_(plant.integrations()) {
    const double delay_s = plant.model().delay_s;
    const double top = plant.nyquist();
    for (double w = 1e-4 * plant.scale(); w < top * (1.0 + ratio);) {
        const double at = std::min(w, top);
        const Complex d = (1.0 - std::polar(1.0, -at * plant.step_s())) / plant.step_s();
        const bool spins = at * delay_s > longest_phase;
        points_.push_back({plant(at), d, std::log(d), spins});
        w += spins || delay_s == 0.0 ? ratio * w : std::min(ratio * w, phase_step / delay_s);
    }
}

Grid::Answer Grid::operator()(const drive::Gains& gains) const {
    const double integrations = (gains.ki != 0.0 ? gains.integral_order : 0.0) + integrations_;
    double turned = -0.5 * pi * integrations;
    double phase = turned;
    double before = 1e9;
    Answer answer{0, 0.0, pi};
    for (const Point& point : points_) {
        Complex controller = gains.kp + gains.ki * std::exp(-gains.integral_order * point.logarithm);
        if (gains.kd != 0.0) {
            controller += gains.kd * std::exp(gains.derivative_order * point.logarithm) /
                          (gains.filter_s * point.difference + 1.0);
        }
        const Complex loop = controller * point.plant;
        const double size = std::abs(loop);
        if (point.spins) {
            if (size >= 1.0) {
                return {1, INFINITY, 0.0};
            }
            answer.sensitivity = std::max(answer.sensitivity, 1.0 / (1.0 - size));
            continue;
        }
        turned += std::remainder(std::arg(1.0 + loop) - turned, 2.0 * pi);
        const double now = phase + std::remainder(std::arg(loop) - phase, 2.0 * pi);
        if ((size > 1.0) != (before > 1.0) && before < 1e9) {
            const double share = std::log(before) / std::log(before / size);
            answer.phase_rad = std::min(answer.phase_rad, phase + share * (now - phase) + pi);
        }
        phase = now;
        before = size;
        answer.sensitivity = std::max(answer.sensitivity, 1.0 / std::abs(1.0 + loop));
    }
    answer.unstable_poles = static_cast<int>(std::lround(-turned / pi));
    return answer;
}

}  // namespace tune
