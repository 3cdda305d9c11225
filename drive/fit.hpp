// Identification: parameters of a model from logs, by least squares on the simulation error ([Matusiak2020] (9)), with
// what the data say about how well they are known.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "drive/form.hpp"
#include "drive/record.hpp"

namespace drive {

struct FitOptions {
    double accepted_error = 0.0;  ///< E_c of (9): stop when the sum of squares is at most this
    int iterations = 200;         ///< or after so many
    std::size_t starts = 1;       ///< the first from the parameters as they are, others from seeded random ones
    /// So many more where the best of them ends at a bound, grows, leaves what no noise is, neighbours that are alike,
    /// or has not ended after 50 iterations.
    std::size_t starts_if_poor = 0;
    std::uint64_t seed = 1;
    /// Prediction-error method: the residuals are whitened by an autoregressive noise model of BIC's order, fitted in
    /// turns.
    bool prediction_error = false;
    /// Intervals by profile likelihood: each ends where the least sum of squares over all other parameters has grown by
    /// t^2 variances. Straight ones, value +- t deviations, hold too rarely where the model is curved over its own
    /// uncertainty. Costs some tens of descents.
    bool profile = false;
    /// Told of what takes long, `starts` and then `intervals` (their ends), at its beginning and after each: one call
    /// at a time.
    std::function<void(const std::string& part, std::size_t done, std::size_t all)> on_progress = {};
    unsigned jobs = 1;
};

struct Estimate {
    std::string name;
    double value;
    double deviation;  ///< standard deviation; 0 if fixed, infinite if the record does not tell
    double low;        ///< 95 % interval, by Student's t: straight, or by profile
    double high;
    bool fixed;
};

struct Fit {
    Model model;
    double offset = 0.0;
    std::vector<Estimate> parameters;
    Eigen::MatrixXd correlation;  ///< of the free parameters, in their order
    std::vector<std::string> free_names;
    double sum_of_squares = 0.0;      ///< LSA of (9), of the simulation error, over all records
    double noise_deviation = 0.0;     ///< of the (whitened) residuals
    std::vector<double> noise_model;  ///< c_1, c_2, ... of e_k = r_k + sum c_i r_(k-i); empty: white
    double lag_one = 0.0;             ///< autocorrelation of the (whitened) residuals at lag one
    int iterations = 0;
    std::string stopped;  ///< why
    std::size_t starts = 1;
    std::size_t starts_that_agree = 1;  ///< ended within 0.1 % of the smallest sum of squares
    std::vector<std::string> warnings;
};

/// Trust-region (Levenberg-Marquardt) with bounds by Ceres; sensitivities are exact, by inverse Laplace. The simulated
/// response is the exact one at the stamps. \throws glsum::Failure (bad input) if no parameter is free or there are
/// more than samples, (check failed) if no start can be simulated.
[[nodiscard]] Fit fit(const Form& form, const std::vector<Record>& records, const FitOptions& options);

/// The simulated output of a fit on a record, its offset included.
[[nodiscard]] std::vector<double> simulate_fit(const Fit& fit, const Record& record);

/// A start without any: the time constant and the delay (in a closed loop also the gain) of a grid whose response,
/// scaled, leaves the least sum of squares. \param kind  fopdt or sopdt; niopdt: a second order of any damping from
/// 0.025 to 1 (in a closed loop 1)
[[nodiscard]] Model search_start(Kind kind, const std::vector<Record>& records);

/// Kuepfmueller's tangent at the inflection of a step response. It meets the old level after a dead time and the new
/// one after the rise: FOPDT takes both as they are; with two equal time constants the rise is e T and the dead time
/// grows by (3 - e) T. \param kind  fopdt or sopdt \throws glsum::Failure (bad input) unless the record begins with one
/// step that is held for long enough to settle.
[[nodiscard]] Model tangent_construction(Kind kind, const Record& record);

}  // namespace drive
