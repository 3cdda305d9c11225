#include "drive/fit.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <random>

#include "base/failure.hpp"
#include "base/parallel.hpp"
#include "drive/descend.hpp"
#include "drive/predictor.hpp"
#include "drive/profile.hpp"
#include "drive/quantiles.hpp"
#include "drive/stability.hpp"

namespace drive {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

bool is_order(const Parameter& parameter) {
    return parameter.name.starts_with("alpha") || parameter.name.starts_with("beta");
}

std::vector<double> random_start(const Form& form, const Predictor& predictor, double longest_s, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto uniform = [&](double from, double to) {
        return from + (to - from) * static_cast<double>(random() >> 11) * 0x1p-53;
    };
    std::vector<double> start;
    for (const std::size_t index : predictor.free()) {
        const Parameter& parameter = form.parameters()[index];
        double value = parameter.value;
        if (parameter.name == "delay_s") {
            value = uniform(0.0, 0.5 * longest_s);
        } else if (is_order(parameter)) {
            value += uniform(-0.3, 0.3);
        } else if (parameter.name != "offset") {
            value *= std::exp(uniform(-1.2, 1.2));
        }
        start.push_back(std::clamp(value, parameter.lower, parameter.upper));
    }
    return start;
}

// Autoregressive model of the residuals by Yule and Walker, its order by BIC.
std::vector<double> fit_noise(const Eigen::VectorXd& residuals, const std::vector<Record>& records) {
    constexpr std::size_t most = 12;
    std::vector<double> covariance(most + 1, 0.0);
    Eigen::Index first = 0;
    for (const Record& record : records) {
        const auto count = static_cast<Eigen::Index>(record.output.size());
        for (std::size_t lag = 0; lag <= most; ++lag) {
            const auto shift = static_cast<Eigen::Index>(lag);
            if (shift < count) {
                covariance[lag] +=
                    residuals.segment(first, count - shift).dot(residuals.segment(first + shift, count - shift));
            }
        }
        first += count;
    }
    const auto samples = static_cast<double>(residuals.size());
    std::vector<double> best;
    double least = samples * std::log(covariance[0]);
    std::vector<double> coefficients;  // Levinson's recursion
    double variance = covariance[0];
    for (std::size_t order = 1; order <= most && variance > 0.0; ++order) {
        double reflection = covariance[order];
        for (std::size_t i = 0; i < coefficients.size(); ++i) {
            reflection += coefficients[i] * covariance[order - 1 - i];
        }
        reflection /= -variance;
        std::vector<double> next = coefficients;
        for (std::size_t i = 0; i < coefficients.size(); ++i) {
            next[i] += reflection * coefficients[coefficients.size() - 1 - i];
        }
        next.push_back(reflection);
        coefficients = next;
        variance *= 1.0 - reflection * reflection;
        const double criterion = samples * std::log(variance) + static_cast<double>(order) * std::log(samples);
        if (criterion < least) {
            least = criterion;
            best = coefficients;
        }
    }
    return best;
}

double lag_one(const Eigen::VectorXd& residuals) {
    const Eigen::Index pairs = residuals.size() - 1;
    const double squares = residuals.squaredNorm();
    return squares > 0.0 ? residuals.head(pairs).dot(residuals.tail(pairs)) / squares : 0.0;
}

bool at_a_bound(const Parameter& parameter, double value) {
    const double reach = 1e-7 * std::max(1.0, std::fabs(value));
    return value <= parameter.lower + reach || value >= parameter.upper - reach;
}

// Where an order has run away to a bound of the form's own: the form with orders to 2.
std::optional<Form> with_usual_orders(const Form& form, const Predictor& predictor, const Attempt& attempt) {
    std::optional<Form> lower;
    for (std::size_t p = 0; p < attempt.values.size(); ++p) {
        const std::size_t i = predictor.free()[p];
        const Parameter& parameter = form.parameters()[i];
        const bool begins_usual = is_order(parameter) && parameter.value <= highest_usual_order;
        if (begins_usual && !parameter.bounds_are_given && parameter.upper > highest_usual_order &&
            attempt.values[p] >= parameter.upper - 1e-7) {
            lower = lower.value_or(form);
            lower->parameters()[i].upper = highest_usual_order;
        }
    }
    return lower;
}

// Whether a minimum is likely not to be the least. A dead time of 0 is one like another.
bool ends_poorly(const Form& form, const Predictor& predictor, const Attempt& attempt) {
    if (!std::isfinite(attempt.sum_of_squares)) {
        return true;
    }
    for (std::size_t p = 0; p < attempt.values.size(); ++p) {
        const Parameter& parameter = form.parameters()[predictor.free()[p]];
        if (parameter.name != "delay_s" && at_a_bound(parameter, attempt.values[p])) {
            return true;
        }
    }
    if (zeros_right_of_axis(form.to_model(predictor.all_values(attempt.values.data())).denominator) > 0) {
        return true;
    }
    Eigen::VectorXd residuals;
    predictor.evaluate(attempt.values.data(), residuals, nullptr);
    // Of white noise it is within two deviations of 0; sensors' noise is seldom coloured by more than a fifth.
    return lag_one(residuals) > std::max(0.2, 4.0 / std::sqrt(static_cast<double>(residuals.size())));
}

void judge(Fit& fit, const Form& form, const Predictor& predictor, const Eigen::VectorXd& residuals,
           const Jacobian& jacobian, const std::vector<double>& values) {
    const auto free = static_cast<Eigen::Index>(predictor.free().size());
    const auto samples = residuals.size();
    const double freedom = static_cast<double>(samples - free);
    const double variance = residuals.squaredNorm() / freedom;
    fit.noise_deviation = std::sqrt(variance);
    fit.lag_one = lag_one(residuals);
    // Columns of one length, so that the singular values compare parameters of different units.
    Eigen::VectorXd length = jacobian.colwise().norm();
    Eigen::MatrixXd scaled = jacobian;
    for (Eigen::Index p = 0; p < free; ++p) {
        scaled.col(p) /= length(p) > 0.0 ? length(p) : 1.0;
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinV);
    const double smallest = svd.singularValues()(free - 1);
    const bool singular = smallest < 1e-9 * svd.singularValues()(0);
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Constant(free, free, 0.0);
    if (!singular) {
        const Eigen::MatrixXd half = svd.matrixV() * svd.singularValues().cwiseInverse().asDiagonal();
        inverse = half * half.transpose();
    }
    fit.correlation = Eigen::MatrixXd::Identity(free, free);
    const double quantile = students_t_quantile(freedom, 0.975);
    Eigen::Index p = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Parameter& parameter = form.parameters()[i];
        Estimate estimate{parameter.name, values[i], 0.0, values[i], values[i], parameter.fixed};
        if (!parameter.fixed) {
            fit.free_names.push_back(parameter.name);
            estimate.deviation = singular || length(p) == 0.0 ? std::numeric_limits<double>::infinity()
                                                              : std::sqrt(variance * inverse(p, p)) / length(p);
            estimate.low = values[i] - quantile * estimate.deviation;
            estimate.high = values[i] + quantile * estimate.deviation;
            for (Eigen::Index q = 0; q < free && !singular; ++q) {
                fit.correlation(p, q) = inverse(p, q) / std::sqrt(inverse(p, p) * inverse(q, q));
            }
            if (length(p) == 0.0) {
                fit.warnings.push_back(fmt::format("{}: nothing in the record depends on it", parameter.name));
            } else if (!singular && quantile * estimate.deviation > 0.5 * std::fabs(values[i]) &&
                       parameter.name != "offset" && parameter.name != "delay_s") {
                fit.warnings.push_back(
                    fmt::format("{}: hardly known: its interval is {:.0f} % of it wide; the record does not "
                                "tell it, fix it or excite more",
                                parameter.name, 200.0 * quantile * estimate.deviation / std::fabs(values[i])));
            }
            if (at_a_bound(parameter, values[i])) {
                fit.warnings.push_back(fmt::format("{}: ends at its bound {}, where a straight interval means nothing",
                                                   parameter.name, values[i]));
            }
            ++p;
        }
        fit.parameters.push_back(estimate);
    }
    if (singular) {
        fit.warnings.emplace_back(
            "the record cannot tell these parameters apart: fix some, or excite at other frequencies or levels");
    }
    for (Eigen::Index a = 0; a < free; ++a) {
        for (Eigen::Index b = 0; b < a; ++b) {
            if (std::fabs(fit.correlation(a, b)) > 0.995) {
                fit.warnings.push_back(fmt::format("{} and {} are known together only: correlation {:.4f}",
                                                   fit.free_names[static_cast<std::size_t>(b)],
                                                   fit.free_names[static_cast<std::size_t>(a)], fit.correlation(a, b)));
            }
        }
    }
    if (std::fabs(fit.lag_one) > 4.0 / std::sqrt(static_cast<double>(samples))) {
        fit.warnings.push_back(fmt::format(
            "the residuals are not white (lag one: {:.2f}): the model lacks something or the noise is coloured, and "
            "the intervals are too narrow{}",
            fit.lag_one, fit.noise_model.empty() ? "; try the prediction-error method" : ""));
    }
}

}  // namespace

Fit fit(const Form& form, const std::vector<Record>& records, const FitOptions& options) {
    const Predictor predictor(form, records);
    if (predictor.free().empty()) {
        refuse("expected at least one free parameter");
    }
    if (samples_of(records) <= predictor.free().size() + 1) {
        refuse(fmt::format("expected more samples than {} free parameters, found {}", predictor.free().size(),
                           samples_of(records)));
    }
    double longest_s = 0.0;
    for (const Record& record : records) {
        longest_s = std::max(longest_s, record.time_s.back());
    }
    std::vector<double> start;
    for (const std::size_t index : predictor.free()) {
        const Parameter& parameter = form.parameters()[index];
        if (!(parameter.value >= parameter.lower && parameter.value <= parameter.upper)) {
            refuse(fmt::format("{}: expected a start within its bounds {} and {}, found {}", parameter.name,
                               parameter.lower, parameter.upper, parameter.value));
        }
        // A step that is cut off at a bound leads nowhere: an order begins inside.
        const double inside = 0.01 * (parameter.upper - parameter.lower);
        start.push_back(is_order(parameter)
                            ? std::clamp(parameter.value, parameter.lower + inside, parameter.upper - inside)
                            : parameter.value);
    }
    const Descent descent{options.accepted_error, options.iterations};
    std::vector<double> noise_model;
    std::vector<Attempt> attempts;
    const auto attempt = [&](std::size_t more, int iterations) {
        const std::size_t before = attempts.size();
        attempts.resize(before + more);
        std::mutex telling;
        std::size_t done = 0;
        const auto tell = [&](std::size_t steps) {
            const std::lock_guard<std::mutex> lock(telling);
            done += steps;
            if (options.on_progress) {
                options.on_progress("starts", done, more);
            }
        };
        tell(0);
        base::parallel_for(more, options.jobs, [&](std::size_t k) {
            const std::size_t i = before + k;
            attempts[i] =
                descend(form, predictor, i == 0 ? start : random_start(form, predictor, longest_s, options.seed + i),
                        noise_model, {descent.accepted_error, std::min(descent.iterations, iterations)});
            tell(1);
        });
    };
    const auto leader = [&]() -> Attempt& {
        return *std::min_element(attempts.begin(), attempts.end(), [](const Attempt& a, const Attempt& b) {
            return a.sum_of_squares < b.sum_of_squares;
        });
    };
    // Some start where nothing is near, and go on for ever: who leads after some steps goes on alone.
    constexpr int first_iterations = 50;
    constexpr int other_iterations = 25;
    attempt(std::max<std::size_t>(options.starts, 1),
            options.starts_if_poor > 0 ? first_iterations : descent.iterations);
    if (options.starts_if_poor > 0 && (!leader().ended || ends_poorly(form, predictor, leader()))) {
        attempt(options.starts_if_poor, other_iterations);
    }
    if (Attempt& first = leader(); !first.ended && first.iterations < descent.iterations) {
        const int before = first.iterations;
        first =
            descend(form, predictor, first.values, noise_model, {descent.accepted_error, descent.iterations - before});
        first.iterations += before;
    }
    Attempt best = leader();
    if (const auto lower = with_usual_orders(form, predictor, best)) {
        Fit found = fit(*lower, records, options);
        found.warnings.insert(
            found.warnings.begin(),
            fmt::format(
                "with orders beyond 2 the sum of squares is {:.4g}, and an order ends at its bound: the form does "
                "not describe the record, and `glsum diagnose` with this model as its base says what it lacks; "
                "orders are held to 2",
                best.sum_of_squares));
        return found;
    }
    if (!std::isfinite(best.sum_of_squares)) {
        throw glsum::Failure(
            glsum::Exit::check_failed,
            "no start could be simulated: expected one near a stable model that fits the record's times");
    }
    Fit found;
    found.starts = attempts.size();
    found.starts_that_agree =
        static_cast<std::size_t>(std::count_if(attempts.begin(), attempts.end(), [&](const Attempt& a) {
            return a.sum_of_squares <= 1.001 * best.sum_of_squares;
        }));
    Eigen::VectorXd residuals;
    Jacobian jacobian;
    for (int turn = 0; turn < (options.prediction_error ? 4 : 0); ++turn) {
        predictor.evaluate(best.values.data(), residuals, nullptr);
        noise_model = fit_noise(residuals, records);
        if (noise_model.empty()) {
            break;  // white already
        }
        Attempt next = descend(form, predictor, best.values, noise_model, descent);
        if (!std::isfinite(next.sum_of_squares)) {
            break;
        }
        next.iterations += best.iterations;
        best = std::move(next);
    }
    const std::vector<double> values = form.in_order(predictor.all_values(best.values.data()));
    for (std::size_t p = 0; p < best.values.size(); ++p) {
        best.values[p] = values[predictor.free()[p]];
    }
    predictor.evaluate(best.values.data(), residuals, &jacobian);
    found.sum_of_squares = residuals.squaredNorm();
    found.noise_model = noise_model;
    found.iterations = best.iterations;
    found.stopped = best.stopped;
    predictor.whiten(residuals, noise_model);
    predictor.whiten(jacobian, noise_model);
    found.model = form.to_model(values);
    found.offset = values.back();
    judge(found, form, predictor, residuals, jacobian, values);
    if (options.profile && !profile_intervals(found, form, records, values, options, residuals.squaredNorm())) {
        found.warnings.emplace_back(
            "a lower sum of squares is near: the intervals are of where the fit stopped; take more iterations or "
            "starts");
    }
    if (found.starts > 1 && found.starts_that_agree == 1) {
        found.warnings.push_back(
            fmt::format("only one of {} starts ends here: other minima are near, take more starts", found.starts));
    }
    return found;
}

std::vector<double> simulate_fit(const Fit& fit, const Record& record) {
    return respond_to(fit.model, record, fit.offset);
}

}  // namespace drive
