// Coloured residuals made white, so that a likelihood counts what they tell and no more.
#pragma once

#include <span>
#include <vector>

namespace gap {

/// e_k = r_k - sum_i c_i r_(k-i): an autoregressive model of residuals.
struct Whitener {
    std::vector<double> coefficients;
    double deviation = 1.0;  ///< of e

    /// The whitened residuals over the deviation; the first ones, without a past, as stationary ones are: each divided
    /// by the residuals' own deviation.
    [[nodiscard]] std::vector<double> apply(std::span<const double> residuals) const;
    /// Of each sample: the logarithm of its likelihood, heavy-tailed (Student's t of 5 degrees), so that no single
    /// reading decides. \param spread  the deviation of each over the usual one; empty: 1
    [[nodiscard]] std::vector<double> log_likelihood(std::span<const double> residuals,
                                                     std::span<const double> spread = {}) const;
    double stationary_deviation = 1.0;
    /// Between residuals that tell anything new: 1 + 2 sum of their correlations, up to the first that is not positive.
    double samples_apart = 1.0;
    /// Correlations of 0.97 from one to the next and beyond: no sensor's noise, but a model that is not quite right.
    [[nodiscard]] bool is_slow() const { return stationary_deviation > 4.0 * deviation; }
};

/// By Yule and Walker over several records, the order by BIC up to `most`. \param least_deviation  e is taken to have
/// at least this: a perfect simulation of quantised readings has none
[[nodiscard]] Whitener fit_whitener(const std::vector<std::vector<double>>& residuals, std::size_t most,
                                    double least_deviation);

/// Mean and bounds of a mean of dependent values: blocks of consecutive ones are redrawn.
struct Interval {
    double mean;
    double low;   ///< 5th percentile
    double high;  ///< 95th
};
/// Of the sum. Seeded.
[[nodiscard]] Interval bootstrap_sum(std::span<const double> values, std::size_t block, std::size_t draws = 400);

}  // namespace gap
