#include "drive/predictor.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "drive/closed_loop.hpp"
#include "drive/inverse_laplace.hpp"
#include "drive/swings.hpp"

namespace drive {
namespace {

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
                // One division for all, by the formula: the operator's care for infinities takes longer than all else.
                const std::complex<double> divisor = below * s;
                const std::complex<double> inverse = std::conj(divisor) / std::norm(divisor);
                values[1] = above * inverse;
                values[0] = model.gain * values[1];
                const std::complex<double> response = values[0] * s;
                const std::complex<double> by_above = model.gain * inverse;
                const std::complex<double> by_below = -response * inverse;
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

}  // namespace

std::size_t samples_of(const std::vector<Record>& records) {
    std::size_t samples = 0;
    for (const Record& record : records) {
        samples += record.output.size();
    }
    return samples;
}

Predictor::Predictor(const Form& form, const std::vector<Record>& records) : form_(form), records_(records) {
    for (std::size_t i = 0; i < form.parameters().size(); ++i) {
        if (!form.parameters()[i].fixed) {
            free_.push_back(i);
        }
    }
}

std::vector<double> Predictor::all_values(const double* free_values) const {
    std::vector<double> values = form_.values();
    for (std::size_t i = 0; i < free_.size(); ++i) {
        values[free_[i]] = free_values[i];
    }
    return values;
}

void Predictor::evaluate(const double* free_values, Eigen::VectorXd& residuals, Jacobian* jacobian) const {
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

}  // namespace drive
