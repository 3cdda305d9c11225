#include "drive/fit.hpp"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "bench/parallel.hpp"
#include "drive/closed_loop.hpp"
#include "drive/inverse_laplace.hpp"
#include "drive/swings.hpp"
#include "qemu/failure.hpp"

namespace drive {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

constexpr double unbounded = 1e9;

// A model as the list of its numbers: gain, b, beta, ..., a, alpha, ..., delay.
std::vector<double> numbers_of(const Model& model) {
    std::vector<double> numbers{model.gain};
    for (const auto* terms : {&model.numerator, &model.denominator}) {
        for (const Term& term : *terms) {
            numbers.push_back(term.coefficient);
            numbers.push_back(term.order);
        }
    }
    numbers.push_back(model.delay_s);
    return numbers;
}

// The step response of a model and its derivatives by its numbers, the delay included.
InverseLaplace sensitivities_of(const Model& model) {
    const std::size_t count = 1 + numbers_of(model).size();
    return {count,
            [model](std::complex<double> s, std::span<std::complex<double>> values) {
                const std::complex<double> logarithm = std::log(s);
                std::complex<double> above = 0.0;
                std::complex<double> below = 0.0;
                std::size_t at = 2;
                for (const auto* terms : {&model.numerator, &model.denominator}) {
                    for (const Term& term : *terms) {
                        const auto power = term.order == 0.0 ? 1.0 : std::exp(term.order * logarithm);
                        (terms == &model.numerator ? above : below) += term.coefficient * power;
                        values[at++] = power;
                        values[at++] = term.coefficient * logarithm * power;
                    }
                }
                const std::complex<double> response = model.gain * above / below;
                values[0] = response / s;
                values[1] = above / (below * s);
                const std::complex<double> by_above = model.gain / (below * s);
                const std::complex<double> by_below = -response / (below * s);
                for (std::size_t i = 0; i < 2 * model.numerator.size(); ++i) {
                    values[2 + i] *= by_above;
                }
                for (std::size_t i = 0; i < 2 * model.denominator.size(); ++i) {
                    values[2 + 2 * model.numerator.size() + i] *= by_below;
                }
                values[at] = -response;  // -s times the step response
            },
            swings_of(model.denominator)};
}

std::size_t samples_of(const std::vector<Record>& records) {
    std::size_t samples = 0;
    for (const Record& record : records) {
        samples += record.output.size();
    }
    return samples;
}

using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// What a form's parameters predict, and how they change it.
class Predictor {
public:
    Predictor(const Form& form, const std::vector<Record>& records) : form_(form), records_(records) {
        for (std::size_t i = 0; i < form.parameters().size(); ++i) {
            if (!form.parameters()[i].fixed) {
                free_.push_back(i);
            }
        }
    }
    [[nodiscard]] const std::vector<std::size_t>& free() const { return free_; }
    [[nodiscard]] const std::vector<Record>& records() const { return records_; }

    [[nodiscard]] std::vector<double> all_values(const double* free_values) const {
        std::vector<double> values;
        for (const Parameter& parameter : form_.parameters()) {
            values.push_back(parameter.value);
        }
        for (std::size_t i = 0; i < free_.size(); ++i) {
            values[free_[i]] = free_values[i];
        }
        return values;
    }

    // residual = modelled - measured
    void evaluate(const double* free_values, Eigen::VectorXd& residuals, Jacobian* jacobian) const {
        const std::vector<double> values = all_values(free_values);
        const Model model = form_.to_model(values);
        check_model(model, "model");
        const auto parameters = static_cast<Eigen::Index>(free_.size());
        const auto samples = static_cast<Eigen::Index>(samples_of(records_));
        residuals.resize(samples);
        // The numbers are at most quadratic in the parameters: central differences of them are exact.
        const std::vector<double> numbers = numbers_of(model);
        Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(numbers.size()), parameters);
        std::optional<InverseLaplace> step;
        if (jacobian != nullptr) {
            jacobian->setZero(samples, parameters);
            for (Eigen::Index p = 0; p < parameters; ++p) {
                std::vector<double> moved = values;
                const std::size_t index = free_[static_cast<std::size_t>(p)];
                const double by = 1e-3 * std::max(1e-3, std::fabs(values[index]));
                moved[index] = values[index] + by;
                const std::vector<double> up = numbers_of(form_.to_model(moved));
                moved[index] = values[index] - by;
                const std::vector<double> down = numbers_of(form_.to_model(moved));
                for (std::size_t n = 0; n < numbers.size(); ++n) {
                    chain(static_cast<Eigen::Index>(n), p) = (up[n] - down[n]) / (2.0 * by);
                }
            }
            step.emplace(sensitivities_of(model));
        } else {
            step.emplace(
                1,
                [model](std::complex<double> s, std::span<std::complex<double>> out) {
                    out[0] = evaluate_without_delay(model, s) / s;
                },
                swings_of(model.denominator));
        }
        std::vector<double> at(jacobian != nullptr ? 1 + numbers.size() : 1);
        const Eigen::Map<const Eigen::VectorXd> by_number(at.data() + 1, static_cast<Eigen::Index>(at.size() - 1));
        const double offset = values.back();
        const bool free_offset = !form_.parameters().back().fixed;
        Eigen::Index row = 0;
        for (const Record& record : records_) {
            if (record.controller) {
                const LoopRun run = run_loop(
                    *step, at.size(), model.delay_s, *record.controller, record.time_s, record.reference, offset, {},
                    jacobian != nullptr ? std::optional<Sensitivity>({&chain, free_offset ? parameters - 1 : -1})
                                        : std::nullopt);
                for (std::size_t i = 0; i < record.output.size(); ++i, ++row) {
                    residuals(row) = run.output[i] + offset - record.output[i];
                    if (jacobian != nullptr) {
                        jacobian->row(row) = run.sensitivities.row(static_cast<Eigen::Index>(i));
                        (*jacobian)(row, parameters - 1) += free_offset ? 1.0 : 0.0;
                    }
                }
                continue;
            }
            for (std::size_t i = 0; i < record.output.size(); ++i, ++row) {
                residuals(row) = offset - record.output[i];
                if (jacobian != nullptr && free_offset) {
                    (*jacobian)(row, parameters - 1) = 1.0;
                }
                for (const Change& change : record.changes) {
                    const double t = record.time_s[i] - change.time_s - model.delay_s;
                    if (t <= 0.0) {
                        break;  // changes rise in time
                    }
                    step->at(t, at);
                    residuals(row) += change.size * at[0];
                    if (jacobian != nullptr) {
                        jacobian->row(row) += change.size * (by_number.transpose() * chain);
                    }
                }
            }
        }
    }

    // e_k = r_k + sum c_i r_(k-i) in each record, in place, newest first.
    template <class Matrix>
    void whiten(Matrix& rows, const std::vector<double>& noise_model) const {
        if (noise_model.empty()) {
            return;
        }
        Eigen::Index first = 0;
        for (const Record& record : records_) {
            const auto count = static_cast<Eigen::Index>(record.output.size());
            for (Eigen::Index k = count - 1; k > 0; --k) {
                for (std::size_t i = 0; i < noise_model.size() && k > static_cast<Eigen::Index>(i); ++i) {
                    rows.row(first + k) += noise_model[i] * rows.row(first + k - 1 - static_cast<Eigen::Index>(i));
                }
            }
            first += count;
        }
    }

private:
    const Form& form_;
    const std::vector<Record>& records_;
    std::vector<std::size_t> free_;
};

class Cost : public ceres::CostFunction {
public:
    Cost(const Predictor& predictor, const std::vector<double>& noise_model)
        : predictor_(predictor), noise_model_(noise_model) {
        set_num_residuals(static_cast<int>(samples_of(predictor.records())));
        mutable_parameter_block_sizes()->push_back(static_cast<int>(predictor.free().size()));
    }

    bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
        try {
            Eigen::VectorXd r;
            Jacobian j;
            const bool wanted = jacobians != nullptr && jacobians[0] != nullptr;
            predictor_.evaluate(parameters[0], r, wanted ? &j : nullptr);
            predictor_.whiten(r, noise_model_);
            std::copy(r.begin(), r.end(), residuals);
            if (wanted) {
                predictor_.whiten(j, noise_model_);
                std::copy(j.data(), j.data() + j.size(), jacobians[0]);
            }
            return true;
        } catch (const glsum::Failure&) {
            return false;  // no model, or one that cannot be simulated: the step is taken back
        }
    }

private:
    const Predictor& predictor_;
    const std::vector<double>& noise_model_;
};

// The first of the stopping rules (9).
class StopWhenAccepted : public ceres::IterationCallback {
public:
    explicit StopWhenAccepted(double accepted) : accepted_(accepted) {}
    ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
        // Ceres' cost is half the sum of squares.
        return 2.0 * summary.cost <= accepted_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
    }

private:
    double accepted_;
};

struct Attempt {
    std::vector<double> values;
    double sum_of_squares = std::numeric_limits<double>::infinity();
    int iterations = 0;
    std::string stopped;
};

Attempt descend(const Form& form, const Predictor& predictor, std::vector<double> start,
                const std::vector<double>& noise_model, const FitOptions& options, double tolerance = 1e-10) {
    ceres::Problem problem;
    problem.AddResidualBlock(new Cost(predictor, noise_model), nullptr, start.data());
    for (std::size_t i = 0; i < start.size(); ++i) {
        const Parameter& parameter = form.parameters()[predictor.free()[i]];
        problem.SetParameterLowerBound(start.data(), static_cast<int>(i), parameter.lower);
        problem.SetParameterUpperBound(start.data(), static_cast<int>(i), parameter.upper);
    }
    ceres::Solver::Options solver;
    solver.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
    solver.linear_solver_type = ceres::DENSE_QR;
    solver.max_num_iterations = options.iterations;
    solver.function_tolerance = tolerance;
    solver.parameter_tolerance = 1e-10;
    solver.gradient_tolerance = 1e-14;
    solver.logging_type = ceres::SILENT;
    StopWhenAccepted accepted(options.accepted_error);
    if (options.accepted_error > 0.0) {
        solver.callbacks.push_back(&accepted);
    }
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    Attempt attempt;
    if (summary.IsSolutionUsable()) {
        attempt.values = std::move(start);
        attempt.sum_of_squares = 2.0 * summary.final_cost;
        attempt.iterations = static_cast<int>(summary.iterations.size()) - 1;
        attempt.stopped = summary.termination_type == ceres::USER_SUCCESS     ? "the accepted error E_c was reached"
                          : summary.termination_type == ceres::NO_CONVERGENCE ? "the number of iterations was reached"
                                                                              : "nothing better is near";
    }
    return attempt;
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
        } else if (parameter.name.find("alpha") == 0 || parameter.name.find("beta") == 0) {
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

// Where a parameter's interval ends: the least sum of squares over all others has grown by quantile^2 variances.
class Profile {
public:
    Profile(const Form& form, const std::vector<Record>& records, const std::vector<double>& noise_model,
            const FitOptions& options)
        : form_(form), records_(records), noise_model_(noise_model), options_(options) {
        options_.accepted_error = 0.0;
    }

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
            if (std::fabs(now) < 2e-3 * quantile) {
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
        // A part of the sum of squares, which is as many variances as there are samples: 10^-4 of one at 1000 samples.
        return descend(fixed, predictor, start, noise_model_, options_, 1e-7).sum_of_squares;
    }

    const Form& form_;
    const std::vector<Record>& records_;
    const std::vector<double>& noise_model_;
    FitOptions options_;
};

// Replaces the straight intervals of the parameters that the record tells.
void profile_intervals(Fit& fit, const Form& form, const std::vector<Record>& records,
                       const std::vector<double>& values, const FitOptions& options, double least) {
    const auto samples = static_cast<double>(samples_of(records));
    const auto free = static_cast<Eigen::Index>(fit.free_names.size());
    const double freedom = samples - static_cast<double>(free);
    const double quantile = boost::math::quantile(boost::math::students_t(freedom), 0.975);
    const double variance = fit.noise_deviation * fit.noise_deviation;
    const Profile profile(form, records, fit.noise_model, options);
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
        if (!fit.parameters[i].fixed && std::isfinite(fit.parameters[i].deviation) &&
            fit.parameters[i].deviation > 0.0) {
            asked.push_back(i);
        }
    }
    bench::parallel_for(2 * asked.size(), options.jobs, [&](std::size_t task) {
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
    });
}

void judge(Fit& fit, const Form& form, const Predictor& predictor, const Eigen::VectorXd& residuals,
           const Jacobian& jacobian, const std::vector<double>& values) {
    const auto free = static_cast<Eigen::Index>(predictor.free().size());
    const auto samples = residuals.size();
    const double freedom = static_cast<double>(samples - free);
    const double variance = residuals.squaredNorm() / freedom;
    fit.noise_deviation = std::sqrt(variance);
    double product = 0.0;
    for (Eigen::Index k = 1; k < samples; ++k) {
        product += residuals(k) * residuals(k - 1);
    }
    fit.lag_one = residuals.squaredNorm() > 0.0 ? product / residuals.squaredNorm() : 0.0;
    // Columns of one length, so that the singular values compare parameters of different units.
    Eigen::VectorXd length = jacobian.colwise().norm();
    Eigen::MatrixXd scaled = jacobian;
    for (Eigen::Index p = 0; p < free; ++p) {
        scaled.col(p) /= length(p) > 0.0 ? length(p) : 1.0;
    }
    const Eigen::BDCSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeThinV);
    const double smallest = svd.singularValues()(free - 1);
    const bool singular = smallest < 1e-9 * svd.singularValues()(0);
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Constant(free, free, 0.0);
    if (!singular) {
        const Eigen::MatrixXd half = svd.matrixV() * svd.singularValues().cwiseInverse().asDiagonal();
        inverse = half * half.transpose();
    }
    fit.correlation = Eigen::MatrixXd::Identity(free, free);
    const double quantile = boost::math::quantile(boost::math::students_t(freedom), 0.975);
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
            const double reach = 1e-7 * std::max(1.0, std::fabs(values[i]));
            if (values[i] <= parameter.lower + reach || values[i] >= parameter.upper - reach) {
                fit.warnings.push_back(
                    fmt::format("{}: ends at its bound {}; its interval means nothing", parameter.name, values[i]));
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

Record to_record(const Log& log, const std::optional<Model>& controller) {
    Record record;
    record.name = log.name;
    for (const double t : log.time_s) {
        record.time_s.push_back(t - log.time_s.front());
    }
    record.output = log.output;
    if (record.output.size() < 8) {
        refuse(
            fmt::format("{}: expected at least 8 samples to identify from, found {}", log.name, record.output.size()));
    }
    record.controller = controller;
    if (controller) {
        record.reference = log.reference.empty() ? recover_reference(*controller, record.time_s, log.input, log.output)
                                                 : log.reference;
    }
    record.changes = changes_of(record.time_s, controller ? record.reference : log.input);
    if (record.changes.empty()) {
        refuse(fmt::format("{}: the {} is 0 throughout: nothing can be identified from it", log.name,
                           controller ? "reference" : "input"));
    }
    if (std::all_of(record.output.begin(), record.output.end(), [&](double y) { return y == record.output.front(); })) {
        refuse(fmt::format("{}: the output is {} throughout: nothing can be identified from it", log.name,
                           record.output.front()));
    }
    return record;
}

Form::Form(Kind kind, const Model& start) : kind_(kind), shape_(start) {
    shape_.kind = kind;
    shape_.notes.clear();
    const double delay_s = start.delay_s;
    if (kind == Kind::fopdt || kind == Kind::sopdt) {
        // The time constant of the mean: a_1 / a_0, shared by two.
        double first = 0.0;
        for (const Term& term : start.denominator) {
            first = std::fabs(term.order - 1.0) < 0.5 && term.order > 0.0 ? term.coefficient : first;
        }
        const double constant = constant_coefficient(start.denominator);
        double time_constant_s = constant != 0.0 ? first / constant : first;
        const bool second = highest_order(start.denominator) > 1.5;
        if (kind == Kind::sopdt) {
            time_constant_s *= 0.5;
        } else if (second) {
            time_constant_s *= 0.75;
        }
        const double gain =
            std::isfinite(static_gain(start)) && static_gain(start) != 0.0 ? static_gain(start) : start.gain;
        parameters_ = {{"gain", gain, -unbounded, unbounded},
                       {"time_constant_s", std::max(std::fabs(time_constant_s), 1e-6), 1e-9, unbounded},
                       {"delay_s", delay_s, 0.0, unbounded}};
        parameters_.push_back({"offset", 0.0, -unbounded, unbounded, true});
        return;
    }
    const auto falling = [](const Term& a, const Term& b) { return a.order > b.order; };
    std::sort(shape_.denominator.begin(), shape_.denominator.end(), falling);
    std::sort(shape_.numerator.begin(), shape_.numerator.end(), falling);
    if (kind == Kind::niopdt) {
        const double gain =
            start.gain * (constant_coefficient(start.numerator) == 0.0 ? 1.0 : constant_coefficient(start.numerator));
        shape_.gain = 1.0;
        shape_.numerator = {{1.0, 0.0}};
        for (Term& term : shape_.denominator) {
            term.coefficient /= gain;
        }
        if (shape_.denominator.size() == 2) {  // from a first order
            const double first = shape_.denominator[0].coefficient;
            const double constant = shape_.denominator[1].coefficient;
            shape_.denominator.insert(shape_.denominator.begin(), {0.25 * first * first / constant, 2.0});
        }
    }
    const bool free_form = kind == Kind::fotf;
    parameters_.push_back({"gain", shape_.gain, -unbounded, unbounded, true});
    const auto add = [&](const std::vector<Term>& terms, const char* coefficient, const char* order, bool fixed) {
        for (std::size_t i = 0; i < terms.size(); ++i) {
            const std::size_t index = terms.size() - 1 - i;
            parameters_.push_back(
                {fmt::format("{}{}", coefficient, index), terms[i].coefficient, -unbounded, unbounded, fixed});
            parameters_.push_back({fmt::format("{}{}", order, index), terms[i].order,
                                   terms[i].order == 0.0 ? 0.0 : 0.01, std::max(2.0, terms[i].order + 0.5),
                                   fixed || terms[i].order == 0.0});
        }
    };
    add(shape_.numerator, "b", "beta", !free_form || shape_.numerator.size() == 1);
    add(shape_.denominator, "a", "alpha", false);
    parameters_.push_back({"delay_s", delay_s, 0.0, unbounded});
    parameters_.push_back({"offset", 0.0, -unbounded, unbounded, true});
}

Parameter& Form::parameter(const std::string& name) {
    std::vector<std::string> names;
    for (Parameter& parameter : parameters_) {
        if (parameter.name == name) {
            return parameter;
        }
        names.push_back(parameter.name);
    }
    refuse(fmt::format("expected one of the parameters {}, found {}", fmt::join(names, ", "), name));
}

Model Form::to_model(const std::vector<double>& values) const {
    if (kind_ == Kind::fopdt || kind_ == Kind::sopdt) {
        Model model = kind_ == Kind::fopdt ? make_fopdt(values[0], values[1], values[2])
                                           : make_sopdt(values[0], values[1], values[2]);
        model.sample_time_s = shape_.sample_time_s;
        return model;
    }
    Model model = shape_;
    std::size_t at = 0;
    model.gain = values[at++];
    for (auto* terms : {&model.numerator, &model.denominator}) {
        for (Term& term : *terms) {
            term.coefficient = values[at++];
            term.order = values[at++];
        }
    }
    model.delay_s = values[at];
    return model;
}

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
        start.push_back(parameter.value);
    }
    std::vector<double> noise_model;
    std::vector<Attempt> attempts(std::max<std::size_t>(options.starts, 1));
    bench::parallel_for(attempts.size(), options.jobs, [&](std::size_t i) {
        attempts[i] =
            descend(form, predictor, i == 0 ? start : random_start(form, predictor, longest_s, options.seed + i),
                    noise_model, options);
    });
    const auto better = [](const Attempt& a, const Attempt& b) { return a.sum_of_squares < b.sum_of_squares; };
    Attempt best = *std::min_element(attempts.begin(), attempts.end(), better);
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
        Attempt next = descend(form, predictor, best.values, noise_model, options);
        if (!std::isfinite(next.sum_of_squares)) {
            break;
        }
        next.iterations += best.iterations;
        best = std::move(next);
    }
    predictor.evaluate(best.values.data(), residuals, &jacobian);
    found.sum_of_squares = residuals.squaredNorm();
    found.noise_model = noise_model;
    found.iterations = best.iterations;
    found.stopped = best.stopped;
    predictor.whiten(residuals, noise_model);
    predictor.whiten(jacobian, noise_model);
    const std::vector<double> values = predictor.all_values(best.values.data());
    found.model = form.to_model(values);
    found.offset = values.back();
    judge(found, form, predictor, residuals, jacobian, values);
    if (options.profile) {
        profile_intervals(found, form, records, values, options, residuals.squaredNorm());
    }
    if (found.starts > 1 && found.starts_that_agree == 1) {
        found.warnings.push_back(
            fmt::format("only one of {} starts ends here: other minima are near, take more starts", found.starts));
    }
    return found;
}

std::vector<double> respond_to(const Model& model, const Record& record, double offset) {
    std::vector<double> output =
        record.controller ? run_loop(model, *record.controller, record.time_s, record.reference, offset).output
                          : respond(model, record.changes, record.time_s);
    for (double& value : output) {
        value += offset;
    }
    return output;
}

std::vector<double> simulate_fit(const Fit& fit, const Record& record) {
    return respond_to(fit.model, record, fit.offset);
}

}  // namespace drive
