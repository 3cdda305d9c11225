// What a linear base takes up of an effect by itself, so that only what it leaves is asked for.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace stand::blind {

/// A record at even steps that begins at rest.
struct EvenRecord {
    std::vector<double> input;
    std::vector<double> output;
    std::size_t from = 0;  ///< the first sample that is logged, and counts
};

/// (b0 + b1 T s) / (T^2 s^2 + 2 zeta T s + 1) e^(-delay s), and an offset.
struct LinearBase {
    double time_s = 1.0;
    double damping = 1.0;
    double delay_s = 0.0;
    double offset = 0.0;
    double gain = 0.0;       ///< b0
    double lead_gain = 0.0;  ///< b1
};

/// The best of a grid: time constants of 0.15, 0.3, 0.6, 1 and 1.8 times `tau_s`, dampings of 0.3, 0.7, 1.2 and 2.5,
/// and dead times of 0, 0.1, 0.25, 0.5 and 1 times `tau_s`.
[[nodiscard]] LinearBase start_of(std::span<const EvenRecord> records, double step_s, double tau_s);

/// Least squares of the simulated output over all records, from that grid on.
[[nodiscard]] LinearBase fit_base(std::span<const EvenRecord> records, double step_s, double tau_s);

/// Root of the mean square of what the base leaves of the logged samples of all records.
[[nodiscard]] double misfit(const LinearBase& base, std::span<const EvenRecord> records, double step_s);

}  // namespace stand::blind
