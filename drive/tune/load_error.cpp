#include "drive/tune/load_error.hpp"

#include <cmath>

namespace tune {
namespace {

constexpr Eigen::Index time_count = 200;
constexpr Eigen::Index frequency_count = 512;
const double damped = std::log(1e4);  // over two horizons, the series' period

}  // namespace

LoadError::LoadError(const SampledPlant& plant, double horizon_s)
    : step_s_(plant.step_s()),
      times_(time_count),
      cosines_(time_count, frequency_count),
      sines_(time_count, frequency_count) {
    const double spacing = pi / horizon_s;
    const double a = damped / (2.0 * horizon_s);
    for (Eigen::Index k = 0; k < frequency_count; ++k) {
        const Complex s(a, spacing * static_cast<double>(k));
        const Complex d = (1.0 - std::exp(-s * step_s_)) / step_s_;
        s_.push_back(s);
        plant_.push_back(plant.continuous(s));
        held_.push_back(plant_.back() * d / s);
        difference_.push_back(d);
        logarithm_.push_back(std::log(d));
    }
    for (Eigen::Index i = 0; i < time_count; ++i) {
        times_(i) = horizon_s * static_cast<double>(i + 1) / static_cast<double>(time_count);
        for (Eigen::Index k = 0; k < frequency_count; ++k) {
            // Lanczos' factors: no ringing at a kink.
            const double x = pi * static_cast<double>(k) / static_cast<double>(frequency_count);
            const double factor = spacing / pi * std::exp(a * times_(i)) * (k == 0 ? 0.5 : std::sin(x) / x);
            const double angle = spacing * static_cast<double>(k) * times_(i);
            cosines_(i, k) = factor * std::cos(angle);
            sines_(i, k) = factor * std::sin(angle);
        }
    }
}

Eigen::VectorXd LoadError::response(const drive::Gains& gains) const {
    Eigen::VectorXd real(frequency_count);
    Eigen::VectorXd imaginary(frequency_count);
    for (std::size_t k = 0; k < s_.size(); ++k) {
        Complex controller = gains.kp + gains.ki * std::exp(-gains.integral_order * logarithm_[k]);
        if (gains.kd != 0.0) {
            controller +=
                gains.kd * std::exp(gains.derivative_order * logarithm_[k]) / (gains.filter_s * difference_[k] + 1.0);
        }
        const Complex value = plant_[k] / (s_[k] * (1.0 + controller * held_[k]));
        real(static_cast<Eigen::Index>(k)) = value.real();
        imaginary(static_cast<Eigen::Index>(k)) = value.imag();
    }
    return cosines_ * real - sines_ * imaginary;
}

double LoadError::iae(const drive::Gains& gains) const {
    const Eigen::VectorXd output = response(gains);
    return (output.cwiseAbs().sum() - 0.5 * std::fabs(output(time_count - 1))) * (times_(1) - times_(0));
}

}  // namespace tune
