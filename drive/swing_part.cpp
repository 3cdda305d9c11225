#include "drive/swing_part.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace drive {
namespace {

using Complex = std::complex<double>;

constexpr int points = 32;
constexpr double reach = 0.25;  // of the distance to the next singularity: the rule leaves 0.25^31
// Relative to the largest value on the circle. A pole that was not met exactly leaves the square of its distance; a
// singularity nearer than known a slow decay of the coefficients, of which the square falls upon c1.
constexpr double most_third_order = 1e-11;
constexpr double most_fifteenth = 1e-7;

// By the formula: the operator's care for infinities takes longer than all else.
Complex inverse(Complex z) { return std::conj(z) / std::norm(z); }

}  // namespace

void SwingPart::take_from(std::span<Complex> values, Complex s) const {
    const Complex above = inverse(s - pole);
    const Complex below = inverse(s - std::conj(pole));
    for (std::size_t f = 0; f < values.size(); ++f) {
        values[f] -= (simple[f] + squared[f] * above) * above;
        values[f] -= (std::conj(simple[f]) + std::conj(squared[f]) * below) * below;
    }
}

void SwingPart::add_to(std::span<double> values, double t) const {
    const Complex turned = 2.0 * std::exp(pole * t);
    for (std::size_t f = 0; f < values.size(); ++f) {
        values[f] += ((simple[f] + t * squared[f]) * turned).real();
    }
}

double SwingPart::size(std::size_t f, double t) const {
    return 2.0 * (std::abs(simple[f]) + t * std::abs(squared[f])) * std::exp(pole.real() * t);
}

std::optional<SwingPart> swing_part(const Image& image, std::size_t count, const Swing& swing,
                                    const std::vector<Swing>& all) {
    SwingPart part{{-swing.decay_per_s, swing.radians_per_s}, std::vector<Complex>(count), std::vector<Complex>(count)};
    double distance = part.pole.imag();  // to the cut, the negative real axis
    for (const Swing& other : all) {
        const double apart = std::abs(part.pole - Complex(-other.decay_per_s, other.radians_per_s));
        distance = apart > 0.0 ? std::min(distance, apart) : distance;
    }
    if (!(distance > 0.0)) {
        return std::nullopt;
    }
    // F(p + r e^(i theta)) = sum A_k e^(i k theta): c1 = A_-1 r, c2 = A_-2 r^2.
    const double radius = reach * distance;
    std::vector<Complex> value(count);
    std::vector<Complex> third(count);
    std::vector<Complex> fifteenth(count);
    std::vector<double> largest(count, 0.0);
    for (int k = 0; k < points; ++k) {
        const auto turned = [&](int order) {
            return std::polar(1.0 / points, order * k * 2.0 * std::numbers::pi / points);
        };
        image(part.pole + std::polar(radius, k * 2.0 * std::numbers::pi / points), value);
        for (std::size_t f = 0; f < count; ++f) {
            part.simple[f] += value[f] * turned(1) * radius;
            part.squared[f] += value[f] * turned(2) * radius * radius;
            third[f] += value[f] * turned(3);
            fifteenth[f] += value[f] * turned(-15);
            largest[f] = std::max(largest[f], std::abs(value[f]));
        }
    }
    for (std::size_t f = 0; f < count; ++f) {
        // Written so that what is no number is no part either.
        if (!(std::abs(third[f]) <= most_third_order * largest[f] &&
              std::abs(fifteenth[f]) <= most_fifteenth * largest[f])) {
            return std::nullopt;
        }
    }
    return part;
}

}  // namespace drive
