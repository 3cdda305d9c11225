#include "drive/form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/failure.hpp"

namespace drive {
namespace {

constexpr double unbounded = 1e9;

}  // namespace

Form::Form(Kind kind, const Model& start) : kind_(kind), shape_(start) {
    shape_.kind = kind;
    shape_.notes.clear();
    const double delay_s = start.delay_s;
    if (kind == Kind::fopdt || kind == Kind::sopdt) {
        // The time constant of the mean: a_1 / a_0, shared by two.
        double first = 0.0;
        for (const Term& term : start.denominator) {
            first = std::fabs(term.order - 1.0) < 0.5 ? term.coefficient : first;
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
            parameters_.push_back(
                {fmt::format("{}{}", order, index), terms[i].order, terms[i].order == 0.0 ? 0.0 : 0.01,
                 std::max(highest_usual_order, terms[i].order + 0.5), fixed || terms[i].order == 0.0});
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
    throw glsum::Failure(glsum::Exit::bad_input,
                         fmt::format("expected one of the parameters {}, found {}", fmt::join(names, ", "), name));
}

std::vector<double> Form::in_order(std::vector<double> values) const {
    if (kind_ == Kind::fopdt || kind_ == Kind::sopdt) {
        return values;
    }
    const auto fits = [&](std::size_t i, double value) {
        return !parameters_[i].fixed && value >= parameters_[i].lower && value <= parameters_[i].upper;
    };
    // At `at` a coefficient and behind it its order. A few terms: each pair of neighbours in turn.
    std::size_t at = 1;
    for (const auto* terms : {&shape_.numerator, &shape_.denominator}) {
        for (std::size_t turn = 0; turn < terms->size(); ++turn) {
            for (std::size_t i = at; i + 3 < at + 2 * terms->size(); i += 2) {
                if (values[i + 1] < values[i + 3] && fits(i, values[i + 2]) && fits(i + 2, values[i]) &&
                    fits(i + 1, values[i + 3]) && fits(i + 3, values[i + 1])) {
                    std::swap(values[i], values[i + 2]);
                    std::swap(values[i + 1], values[i + 3]);
                }
            }
        }
        at += 2 * terms->size();
    }
    return values;
}

std::vector<double> Form::values() const {
    std::vector<double> values;
    for (const Parameter& parameter : parameters_) {
        values.push_back(parameter.value);
    }
    return values;
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

}  // namespace drive
