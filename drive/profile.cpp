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

// Where a parameter's interval ends: the least sum of squares over all others has grown by quantile^2 variances.
class Profile {
public:
    Profile(const Form& form, const std::vector<Record>& records, const std::vector<double>& noise_model,
            int iterations)
        : form_(form), records_(records), noise_model_(noise_model), iterations_(iterations) {}

    /// \param index  of the parameter \param values  of all, at the least sum of squares \param side  -1 or 1
    /// \param straight  the deviation that a linear model would have
    /// \param along  how the free parameters, this one included, move with it in a linear model
    [[nodiscard]] double end(std::size_t index, const std::vector<double>& values, double side, double straight,
                             const Eigen::VectorXd& along, double least, double variance, double quantile) const {
        const Parameter& parameter = form_.parameters()[index];
        const double bound = side > 0.0 ? parameter.upper : parameter.lower;
        // In deviations of a linear model, of which there would be `quantile`.
        const double farthest = std::min(std::fabs(bound - values[index]) / straight, 20.0 * quantile);
        const auto height = [&](double by) {
            const double sum = sum_of_squares(index, values, side * by * straight, along);
            return std::sqrt(std::max(0.0, sum - least) / variance) - quantile;
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
    [[nodiscard]] double sum_of_squares(std::size_t index, const std::vector<double>& values, double by,
                                        const Eigen::VectorXd& along) const {
        Form fixed = form_;
        Eigen::Index at = 0;
        std::vector<double> start;
        for (std::size_t i = 0; i < values.size(); ++i) {
            Parameter& parameter = fixed.parameters()[i];
            if (parameter.fixed) {
                continue;
            }
            if (i == index) {
                parameter.value = std::clamp(values[i] + by, parameter.lower, parameter.upper);
                parameter.fixed = true;
            } else {
                start.push_back(std::clamp(values[i] + by * along(at), parameter.lower, parameter.upper));
            }
            ++at;
        }
        const Predictor predictor(fixed, records_);
        if (start.empty()) {
            try {
                Eigen::VectorXd residuals;
                predictor.evaluate(start.data(), residuals, nullptr);
                predictor.whiten(residuals, noise_model_);
                return residuals.squaredNorm();
            } catch (const glsum::Failure&) {
                return std::numeric_limits<double>::infinity();
            }
        }
        // As a part of the sum of squares, which is as many variances as there are samples: a height is wanted to
        // within `close` quantiles, 0.015 variances of the sum at its 95 %.
        const double tolerance = 2e-3 / static_cast<double>(samples_of(records_));
        return descend(fixed, predictor, start, noise_model_, {0.0, iterations_, tolerance}).sum_of_squares;
    }

    const Form& form_;
    const std::vector<Record>& records_;
    const std::vector<double>& noise_model_;
    int iterations_;
};

}  // namespace

void profile_intervals(Fit& fit, const Form& form, const std::vector<Record>& records,
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
        (side < 0.0 ? estimate.low : estimate.high) =
            profile.end(index, values, side, estimate.deviation, along, least, variance, quantile);
        if (options.on_interval_end) {
            const std::lock_guard<std::mutex> lock(telling);
            options.on_interval_end(++done, 2 * asked.size());
        }
    });
}

}  // namespace drive
