#include "drive/swings.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace drive {
namespace {

using Complex = std::complex<double>;

constexpr double nearness = 0.4;       // of |P/P'|, about the distance of the nearest zero, to the frequency
constexpr int points_per_decade = 30;  // of a quantity that changes as fast as the frequency itself

Complex newton_step(const std::vector<Term>& terms, Complex s) {
    const Complex logarithm = std::log(s);
    Complex value = 0.0;
    Complex slope = 0.0;
    for (const Term& term : terms) {
        const Complex power = term.coefficient * std::exp(term.order * logarithm);
        value += power;
        slope += term.order * power / s;
    }
    return slope == 0.0 ? Complex(0.0) : value / slope;
}

}  // namespace

std::vector<Swing> swings_of(const std::vector<Term>& denominator) {
    // Zeros lie where two terms are equally large: not far outside the frequencies where any two are.
    double lowest = INFINITY;
    double highest = 0.0;
    for (const Term& a : denominator) {
        for (const Term& b : denominator) {
            if (a.order > b.order && a.coefficient != 0.0 && b.coefficient != 0.0) {
                const double crossing = std::pow(std::fabs(b.coefficient / a.coefficient), 1.0 / (a.order - b.order));
                lowest = std::min(lowest, crossing);
                highest = std::max(highest, crossing);
            }
        }
    }
    std::vector<Swing> swings;
    if (!(lowest > 0.0 && std::isfinite(highest) && highest > 0.0)) {
        return swings;
    }
    const double step = std::pow(10.0, 1.0 / points_per_decade);
    for (double w = lowest / 10.0; w < highest * 10.0 * step; w *= step) {
        Complex s(0.0, w);
        if (std::abs(newton_step(denominator, s)) > nearness * w) {
            continue;
        }
        for (int i = 0; i < 20; ++i) {
            s -= newton_step(denominator, s);
        }
        const bool found =
            std::isfinite(std::abs(s)) && s.imag() > 0.0 && std::abs(newton_step(denominator, s)) < 1e-9 * std::abs(s);
        const auto same = [&](const Swing& other) { return std::fabs(other.radians_per_s - s.imag()) < 1e-6 * w; };
        if (found && std::fabs(s.real()) < nearness * s.imag() && std::none_of(swings.begin(), swings.end(), same)) {
            swings.push_back({s.imag(), -s.real()});
        }
    }
    return swings;
}

double fastest_left(const std::vector<Swing>& swings, double t, double left) {
    double fastest = 0.0;
    for (const Swing& swing : swings) {
        if (swing.decay_per_s * t < -std::log(left)) {
            fastest = std::max(fastest, swing.radians_per_s);
        }
    }
    return fastest;
}

}  // namespace drive
