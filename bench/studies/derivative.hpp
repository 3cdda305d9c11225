// What every kernel needs to come within so many percent of the derivative itself, over a band and along a step.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/choose/costs.hpp"
#include "bench/choose/derivative_errors.hpp"
#include "bench/rows/row.hpp"

namespace bench {

/// Where kernels are run for their cost.
struct DerivativeTarget {
    std::string aspect;  ///< host, m7:<core>, m4:<core>
    std::function<std::unique_ptr<choose::CostSource>(const choose::CountedOrder&)> costs;
};

struct DerivativeStudy {
    std::vector<glsum::design::DerivativeGoal> goals;  ///< of the same band and step: one for each order
    double limit = 0.0;                                ///< largest relative error, above 0
    std::vector<std::string> kernels;
    std::vector<DerivativeTarget> targets;
    unsigned jobs = 1;
    choose::FilterDesign by = choose::FilterDesign::fitted;
};

/// A kernel at the shortest length that keeps the limit, with modes also at the next; where none does, where it errs
/// least.
struct DerivativePoint {
    double order;
    std::string kernel;
    std::size_t coefficients;  ///< K + 2M
    std::string taps;          ///< "1+5"
    /// As the kernel holds the filter, the noise of its arithmetic added, and what running it gave.
    choose::DerivativeReport report;
    bool meets = false;
    std::vector<choose::Cost> costs;  ///< of each target; none of what does not meet the limit
};

struct DerivativeRun {
    std::vector<DerivativePoint> points;
    std::vector<std::string> left_out;  ///< a sentence for each reason
};

/// Kernels that no fixed filter describes, or that do not take an order, are left out. Deterministic but for the host's
/// times. Shows its progress.
[[nodiscard]] DerivativeRun measure_derivative(const DerivativeStudy& study);

/// Of each order those that meet the limit, the cheapest first; behind them how near the others come.
[[nodiscard]] std::string to_table(const DerivativeStudy& study, const DerivativeRun& run);

/// Rows `derivative/<kernel>/order:<v>/taps:<L>/<target>[/hz:<low>..<high>][/until:<s>]`; of what misses the limit one
/// row of aspect accuracy, without a cost.
[[nodiscard]] std::vector<Json> rows_of_derivative(const DerivativeStudy& study, const DerivativeRun& run);

}  // namespace bench
