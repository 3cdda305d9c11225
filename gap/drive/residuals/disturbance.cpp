#include "gap/drive/residuals/disturbance.hpp"

#include <algorithm>
#include <cmath>

#include "gap/drive/residuals/pattern.hpp"
#include "gap/drive/residuals/whiten.hpp"

namespace gap {
namespace {

// Stationary noise of any colour stays below these: in stretches that are not one swing of it, and by lines.
constexpr double loud = 20.0;
constexpr double stands_out = 50.0;
// Of a wave, of which a record may hold too few for a line. What a plant with a damping ratio of 0.17 makes of noise
// stays above.
constexpr double turns_over = -0.6;

double mean_of(const Remainder& one) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < one.residuals.size(); ++i) {
        sum += one.counts[i] != 0 ? one.residuals[i] : 0.0;
        count += one.counts[i] != 0 ? 1.0 : 0.0;
    }
    return count > 0.0 ? sum / count : 0.0;
}

// The lowest correlation of values some way apart. A wave turns over half a wave on, which is 1.6 times what lies
// between values that tell anything new.
double lowest_correlation(const std::vector<std::vector<double>>& records, double apart) {
    const auto step = std::max<std::size_t>(1, static_cast<std::size_t>(apart / 16.0));
    const auto covariance = [&](std::size_t lag) {
        double sum = 0.0;
        for (const std::vector<double>& record : records) {
            for (std::size_t k = lag; k < record.size(); ++k) {
                sum += record[k] * record[k - lag];
            }
        }
        return sum;
    };
    const double whole = covariance(0);
    double lowest = whole;
    for (std::size_t lag = step; static_cast<double>(lag) <= 4.0 * apart; lag += step) {
        lowest = std::min(lowest, covariance(lag));
    }
    return lowest / whole;  // of nothing at all no number, which is above none
}

}  // namespace

void take_off_mean(Remainder& one) {
    const double mean = mean_of(one);
    for (double& value : one.residuals) {
        value -= mean;
    }
}

Disturbance disturbance_of(const std::vector<Remainder>& records, double least_square) {
    std::vector<Remainder> about;              // the mean
    std::vector<std::vector<double>> counted;  // of these, what counts
    Disturbance found;
    double samples = 0.0;
    double squares = 0.0;
    for (const Remainder& one : records) {
        const double mean = mean_of(one);
        about.push_back(one);
        take_off_mean(about.back());
        counted.emplace_back();
        for (std::size_t i = 0; i < one.residuals.size(); ++i) {
            if (one.counts[i] != 0) {
                counted.back().push_back(about.back().residuals[i]);
                squares += counted.back().back() * counted.back().back();
            }
        }
        const auto size = static_cast<double>(counted.back().size());
        samples += size;
        found.mean_square += size * mean * mean;
    }
    if (!(samples > 0.0) || !std::isfinite(squares)) {
        return found;
    }
    found.mean_square /= samples;
    found.rms = std::sqrt(squares / samples);
    const double apart = fit_whitener(counted, 0, std::sqrt(least_square)).samples_apart;
    found.times_anew = samples / apart;
    found.even = lowest_correlation(counted, apart) > turns_over;
    for (const Remainder& one : about) {
        const double stretch_s = 2.0 * apart * one.record->usual_interval_s;
        found.even = found.even &&
                     loudest_burst(*one.record, one.residuals, one.counts, stretch_s, least_square).ratio < loud &&
                     clearest_wave(*one.record, one.residuals).over_neighbours < stands_out;
    }
    return found;
}

bool are_one_disturbance(const Disturbance& fitted, const Disturbance& judged) {
    // An rms of so few independent values is off by a fifth, two of them by up to a half from one another.
    constexpr double fewest = 12.0;
    constexpr double alike = 1.5;
    return fitted.even && judged.even && fitted.times_anew >= fewest && judged.times_anew >= fewest &&
           judged.rms < alike * fitted.rms && fitted.rms < alike * judged.rms;
}

}  // namespace gap
