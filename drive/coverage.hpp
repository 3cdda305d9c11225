// Whether the 95 % intervals of a fit hold what they promise: logs of a known model, fitted again and again.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "drive/fit.hpp"
#include "drive/log.hpp"
#include "drive/simulation.hpp"

namespace drive {

/// How a laboratory log comes about.
struct Acquisition {
    Excitation excitation = {.name = "pulse", .amplitude = 1.0, .off_s = 2.6, .stairs = 4};
    double until_s = 5.0;
    double interval_s = 0.01;
    double jitter_s =
        0.001;            ///< stamps lie up to this beside the even ones, uniformly; they say when the sample was taken
    double noise = 0.01;  ///< standard deviation, in the output's units, white and normal
    double quantum = 0.008;  ///< 1000 counts a turn with 45 degrees as 1: 0.008
};

/// The exact response of the model, taken like that. The same seed gives the same log.
[[nodiscard]] Log take_log(const Model& model, const Acquisition& acquisition, std::uint64_t seed);

struct Coverage {
    std::vector<std::string> names;  ///< of the free parameters
    std::vector<double> truth;
    std::vector<std::size_t> inside;  ///< runs whose 95 % interval holds the truth
    std::vector<double> mean;         ///< of the estimates
    std::vector<double> spread;       ///< standard deviation of the estimates
    std::vector<double> claimed;      ///< mean of the deviations that the fits claimed
    /// Runs whose joint 95 % region, of all parameters at once by Fisher's F, holds the truth. Where the parameters are
    /// known together only, their own counts are nearly one count, and this is another.
    std::size_t jointly_inside = 0;
    std::size_t runs = 0;
    std::size_t failed = 0;  ///< fits that threw; they count as outside
};

/// \param set  which logs: two sets have none in common. Each fit starts from the log alone: a search for SOPDT, its
/// fit, and that as the start of `kind`. \param done  called after each run
[[nodiscard]] Coverage measure_coverage(const Model& truth, Kind kind, const Acquisition& acquisition, std::size_t runs,
                                        std::uint64_t set, unsigned jobs, const std::function<void()>& done = {});

/// The way from a record to a fit of `kind` without a start: FOPDT and SOPDT from a search; others from a fitted SOPDT,
/// as the paper does, or from a search among second orders that swing, where that explains more. \param prepare  may
/// change the form before the last fit
[[nodiscard]] Fit fit_from_nothing(Kind kind, const std::vector<Record>& records, const FitOptions& options,
                                   const std::function<void(Form&)>& prepare = {});

}  // namespace drive
