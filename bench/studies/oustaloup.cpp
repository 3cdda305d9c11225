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
    double gain = std::pow(band.high_rad_s, r);
    std::complex<double> wanted(gain, 0.0);
    std::complex<double> found(1.0, 0.0);
    for (std::size_t k = 0; k < poles; ++k) {
        const double zero = root(k, 0.5 * (1.0 - r));
        const double pole = root(k, 0.5 * (1.0 + r));
        double zero_z = std::exp(-zero * step_s);
        double pole_z = std::exp(-pole * step_s);
        if (mapping == Mapping::tustin) {
            const double half = 0.5 * step_s;
            zero_z = (1.0 - half * zero) / (1.0 + half * zero);
            pole_z = (1.0 - half * pole) / (1.0 + half * pole);
            gain *= (1.0 + half * zero) / (1.0 + half * pole);
        } else {
            wanted *= (middle + zero) / (middle + pole);
            found *= (1.0 - zero_z * delay) / (1.0 - pole_z * delay);
        }
        if (k % 2 == 0) {
            sections_.push_back({-zero_z, 0.0, -pole_z, 0.0});
        } else {
            const Section one = sections_.back();
            sections_.back() = {one.b1 - zero_z, -one.b1 * zero_z, one.a1 - pole_z, -one.a1 * pole_z};
        }
    }
    if (mapping == Mapping::matched) {
        gain = std::abs(wanted) / std::abs(found);
    }
    gain_ = gain * std::pow(step_s, r);
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
