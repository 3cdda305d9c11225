#include "glsum/design/filter.hpp"

#include <algorithm>
#include <cmath>

namespace glsum::design {

Filter of_samples(const Filter& of_increments) {
    Filter filter = of_increments;
    for (std::size_t j = 1; j < of_increments.taps.size(); ++j) {
        filter.taps[j] -= of_increments.taps[j - 1];
    }
    // Behind a mode's newest sample its weights w, w (1-d), ... differ by w d, w d (1-d), ...
    double behind = -of_increments.taps.back();
    for (Mode& mode : filter.modes) {
        behind += mode.weight;
        mode.weight *= -mode.decay;
    }
    filter.taps.push_back(behind);
    return filter;
}

std::complex<double> difference_response(double angle) {
    const double half = std::sin(0.5 * angle);
    return {2.0 * half * half, std::sin(angle)};
}

std::complex<double> mode_response(double decay, std::size_t near_taps, double angle) {
    return mode_response(decay, difference_response(angle), std::polar(1.0, -angle * static_cast<double>(near_taps)));
}

std::complex<double> frequency_response(const Filter& filter, double angle) {
    std::complex<double> sum;
    const std::complex<double> delay = std::polar(1.0, -angle);
    for (auto tap = filter.taps.rbegin(); tap != filter.taps.rend(); ++tap) {
        sum = sum * delay + *tap;
    }
    for (const Mode& mode : filter.modes) {
        sum += mode.weight * mode_response(mode.decay, filter.taps.size(), angle);
    }
    return sum;
}

double mode_step_response(double decay, std::size_t near_taps, std::size_t k) {
    if (k < near_taps) {
        return 0.0;
    }
    const auto count = static_cast<double>(k - near_taps + 1);
    return decay == 0.0   ? count
           : decay == 1.0 ? 1.0
           : decay > 1.0  ? (1.0 - std::pow(1.0 - decay, count)) / decay
                          : -std::expm1(count * std::log1p(-decay)) / decay;
}

double step_response(const Filter& filter, std::size_t k) {
    double sum = 0.0;
    for (std::size_t j = 0; j < std::min(filter.taps.size(), k + 1); ++j) {
        sum += filter.taps[j];
    }
    for (const Mode& mode : filter.modes) {
        sum += mode.weight * mode_step_response(mode.decay, filter.taps.size(), k);
    }
    return sum;
}

}  // namespace glsum::design
