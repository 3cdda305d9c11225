#include "bench/studies/oustaloup.hpp"

#include <cmath>
#include <complex>
#include <stdexcept>

namespace bench {

Oustaloup::Oustaloup(double order, double step_s, std::size_t poles, Band band, Mapping mapping)
    : differs_(order > 1.0) {
    if (!takes(order) || poles == 0 || mapping == Mapping::impulse_invariant || !(step_s > 0.0) ||
        !(band.low_rad_s > 0.0 && band.high_rad_s > band.low_rad_s)) {
        throw std::invalid_argument("Oustaloup: order, poles, step or band out of range");
    }
    const double r = differs_ ? order - 1.0 : order;
    const double ratio = band.high_rad_s / band.low_rad_s;
    const auto root = [&](std::size_t k, double shift) {
        return band.low_rad_s * std::pow(ratio, (static_cast<double>(k) + shift) / static_cast<double>(poles));
    };
    const std::complex<double> middle(0.0, std::sqrt(band.low_rad_s * band.high_rad_s));
    const std::complex<double> delay = std::exp(-middle * step_s);
    std::vector<double> zeros_z;
    std::vector<double> poles_z;
    double gain = std::pow(band.high_rad_s, r);
    std::complex<double> wanted(gain, 0.0);
    std::complex<double> found(1.0, 0.0);
    for (std::size_t k = 0; k < poles; ++k) {
        const double zero = root(k, 0.5 * (1.0 - r));
        const double pole = root(k, 0.5 * (1.0 + r));
        if (mapping == Mapping::tustin) {
            const double half = 0.5 * step_s;
            zeros_z.push_back((1.0 - half * zero) / (1.0 + half * zero));
            poles_z.push_back((1.0 - half * pole) / (1.0 + half * pole));
            gain *= (1.0 + half * zero) / (1.0 + half * pole);
        } else {
            zeros_z.push_back(std::exp(-zero * step_s));
            poles_z.push_back(std::exp(-pole * step_s));
            wanted *= (middle + zero) / (middle + pole);
            found *= (1.0 - zeros_z.back() * delay) / (1.0 - poles_z.back() * delay);
        }
    }
    if (mapping == Mapping::matched) {
        gain = std::abs(wanted) / std::abs(found);
    }
    gain_ = gain * std::pow(step_s, r);
    for (std::size_t k = 0; k < poles; k += 2) {
        const bool pair = k + 1 < poles;
        const double zero = pair ? zeros_z[k + 1] : 0.0;
        const double pole = pair ? poles_z[k + 1] : 0.0;
        sections_.push_back({-(zeros_z[k] + zero), zeros_z[k] * zero, -(poles_z[k] + pole), poles_z[k] * pole});
    }
}

bool Oustaloup::takes(double order) { return glsum::design::has_rational(order); }

double Oustaloup::step(double sample) {
    double value = gain_ * (differs_ ? sample - before_ : sample);
    before_ = sample;
    for (Section& section : sections_) {
        const double output = value + section.first;
        section.first = section.b1 * value - section.a1 * output + section.second;
        section.second = section.b2 * value - section.a2 * output;
        value = output;
    }
    return value;
}

}  // namespace bench
