#include "drive/profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "base/failure.hpp"
#include "base/parallel.hpp"
#include "drive/descend.hpp"
#include "drive/predictor.hpp"
#include "drive/quantiles.hpp"

namespace drive {
namespace {

constexpr double close = 2e-3;  // an interval's end is as good as this, in quantiles
constexpr double worth = 0.01;  // so many variances less say that the fit had not ended

struct Lowest {
    double sum_of_squares = std::numeric_limits<double>::infinity();
    std::vector<double> free_values;  // none: there was no model
};

// Where a parameter's interval ends: the least sum of squares over all others has grown by quantile^2 variances.
class Profile {
public:
    Profile(const Form& form, const std::vector<Record>& records, const std::vector<double>& noise_model,
            int iterations)
        : form_(form), records_(records), noise_model_(noise_model), iterations_(iterations) {}

    /// \param index  of the parameter \param values  of all, at the least sum of squares \param side  -1 or 1
    /// \param straight  the deviation that a linear model would have
    /// \param along  how the free parameters, this one included, move with it in a linear model
    /// \param met  in return at most the lowest sum of squares on the way
    [[nodiscard]] double end(std::size_t index, const std::vector<double>& values, double side, double straight,
                             const Eigen::VectorXd& along, double least, double variance, double quantile,
                             double& met) const {
        const Parameter& parameter = form_.parameters()[index];
        const double bound = side > 0.0 ? parameter.upper : parameter.lower;
        // In deviations of a linear model, of which there would be `quantile`.
        const double farthest = std::min(std::fabs(bound - values[index]) / straight, 20.0 * quantile);
        // How the free parameters move for each deviation; after the first descent as they did move: where they bend
        // away from the straight line, a descent from there takes most of its steps to come back.
        Eigen::VectorXd move = side * straight * along;
        const auto height = [&](double by) {
            const double now = values[index] + side * by * straight;
            const Lowest found = lowest_with(index, now, values, by * move);
            if (!found.free_values.empty()) {
                move =
                    (Eigen::Map<const Eigen::VectorXd>(found.free_values.data(), move.size()) - free_of(values)) / by;
            }
            met = std::min(met, found.sum_of_squares);
            return std::sqrt(std::max(0.0, found.sum_of_squares - least) / variance) - quantile;
        };
        double inside = 0.0;
        double inside_height = -quantile;
        double outside = 0.0;
        double outside_height = 0.0;
        double by = std::min(quantile, farthest);
        for (int turn = 0; turn < 12; ++turn) {
            const double now = height(by);
            if (std::fabs(now) < close * quantile) {
                return values[index] + side * by * straight;
            }
            if (now < 0.0) {
                if (by >= farthest) {
                    return bound;
                }
                inside = by;
                inside_height = now;
            } else {
                outside = by;
                outside_height = now;
            }
            if (outside == 0.0) {
                by = std::min(farthest, std::max(1.1 * by, by * quantile / (quantile + now)));
            } else if (!std::isfinite(outside_height)) {
                by = 0.5 * (inside + outside);
            } else {
                // The height is close to straight: the chord, kept off its ends.
                const double part = -inside_height / (outside_height - inside_height);
                by = inside + std::clamp(part, 0.05, 0.95) * (outside - inside);
            }
        }
        return values[index] + side * by * straight;
    }

private:
    [[nodiscard]] Eigen::VectorXd free_of(const std::vector<double>& values) const {
        std::vector<double> free;
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (!form_.parameters()[i].fixed) {
                free.push_back(values[i]);
            }
        }
        return Eigen::Map<const Eigen::VectorXd>(free.data(), static_cast<Eigen::Index>(free.size()));
    }

    // Over all others than `index`, which is held at `now`; begun `move` away from `values`.
    [[nodiscard]] Lowest lowest_with(std::size_t index, double now, const std::vector<double>& values,
                                     const Eigen::VectorXd& move) const {
        Form fixed = form_;
        Eigen::Index at = 0;
        Eigen::Index own = 0;
        std::vector<double> start;
        for (std::size_t i = 0; i < values.size(); ++i) {
            Parameter& parameter = fixed.parameters()[i];
            if (parameter.fixed) {
                continue;
            }
            if (i == index) {
                own = at;
                parameter.value = std::clamp(now, parameter.lower, parameter.upper);
                parameter.fixed = true;
            } else {
                start.push_back(std::clamp(values[i] + move(at), parameter.lower, parameter.upper));
            }
            ++at;
        }
        const Predictor predictor(fixed, records_);
        Lowest found;
        if (start.empty()) {
            try {
                Eigen::VectorXd residuals;
                predictor.evaluate(start.data(), residuals, nullptr);
                predictor.whiten(residuals, noise_model_);
                found.sum_of_squares = residuals.squaredNorm();
            } catch (const glsum::Failure&) {
                return found;
            }
        } else {
            // As a part of the sum of squares, which is as many variances as there are samples: a height is wanted to
            // within `close` quantiles, 0.015 variances of the sum at its 95 %.
            const double tolerance = 2e-3 / static_cast<double>(samples_of(records_));
            Attempt attempt = descend(fixed, predictor, start, noise_model_, {0.0, iterations_, tolerance});
            found = {attempt.sum_of_squares, std::move(attempt.values)};
        }
        if (std::isfinite(found.sum_of_squares)) {
            found.free_values.insert(found.free_values.begin() + own, fixed.parameters()[index].value);
        }
        return found;
    }

    const Form& form_;
    const std::vector<Record>& records_;
    const std::vector<double>& noise_model_;
    int iterations_;
};

}  // namespace

bool profile_intervals(Fit& fit, const Form& form, const std::vector<Record>& records,
                       const std::vector<double>& values, const FitOptions& options, double least) {
    const auto samples = static_cast<double>(samples_of(records));
    const auto free = static_cast<Eigen::Index>(fit.free_names.size());
    const double freedom = samples - static_cast<double>(free);
    const double quantile = students_t_quantile(freedom, 0.975);
    const double variance = fit.noise_deviation * fit.noise_deviation;
    const Profile profile(form, records, fit.noise_model, options.iterations);
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
        if (!fit.parameters[i].fixed && std::isfinite(fit.parameters[i].deviation) &&
            fit.parameters[i].deviation > 0.0) {
            asked.push_back(i);
        }
    }
    std::mutex telling;
    std::size_t done = 0;
    double lowest = least;
    if (options.on_progress) {
        options.on_progress("intervals", 0, 2 * asked.size());
    }
    base::parallel_for(2 * asked.size(), options.jobs, [&](std::size_t task) {
        const std::size_t index = asked[task / 2];
        Estimate& estimate = fit.parameters[index];
        Eigen::VectorXd along(free);
        Eigen::Index own = 0;
        while (fit.free_names[static_cast<std::size_t>(own)] != estimate.name) {
            ++own;
        }
        Eigen::Index at = 0;
        for (const Estimate& other : fit.parameters) {
            if (!other.fixed) {
                along(at) = fit.correlation(own, at) * other.deviation / estimate.deviation;
                ++at;
            }
        }
        const double side = task % 2 == 0 ? -1.0 : 1.0;
        double met = least;
        (side < 0.0 ? estimate.low : estimate.high) =
            profile.end(index, values, side, estimate.deviation, along, least, variance, quantile, met);
        const std::lock_guard<std::mutex> lock(telling);
        lowest = std::min(lowest, met);
        if (options.on_progress) {
            options.on_progress("intervals", ++done, 2 * asked.size());
        }
    });
    return lowest >= least - worth * variance;
}

}  // namespace drive
