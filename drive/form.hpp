// What identification looks for: a family of models and its parameters.
#pragma once

#include <string>
#include <vector>

#include "drive/model.hpp"

namespace drive {

struct Parameter {
    std::string name;
    double value;  ///< the start; in a result, the estimate
    double lower;
    double upper;
    bool fixed = false;
    bool bounds_are_given = false;  ///< by who asks, not by the form
};

/// That of a mass on a spring; a s^v + 1 with a higher one is unstable.
constexpr double highest_usual_order = 2.0;

/// A family of models and its parameters:
///   fopdt, sopdt  gain, time_constant_s, delay_s
///   niopdt        a2 alpha2 a1 alpha1 a0 delay_s, with gain 1 and alpha0 0 fixed
///   fotf          gain, b<i> beta<i> of each numerator term, a<i> alpha<i> of each denominator term, delay_s; those
///   that are
///                 superfluous (gain, a numerator of one term, orders of 0) are fixed
/// and `offset`, of the output, fixed at 0. Orders may go half of one beyond those of the start, and to 2 in any case:
/// the intervals of a plant whose order is close to 2 want room on both sides. Indices count down with the order, to 0.
class Form {
public:
    /// The parameters of `kind` that are nearest to a start of any kind: (11) as the start of (12) becomes
    /// a2 = T^2, alpha2 = 2, a1 = 2 T, alpha1 = 1, a0 = 1 / gain. A fopdt start gives a niopdt without its highest
    /// term's weight, T^2/4.
    Form(Kind kind, const Model& start);

    [[nodiscard]] const std::vector<Parameter>& parameters() const { return parameters_; }
    [[nodiscard]] std::vector<Parameter>& parameters() { return parameters_; }
    /// \throws glsum::Failure (bad input) naming those there are, if there is none of that name
    [[nodiscard]] Parameter& parameter(const std::string& name);
    /// Of all parameters, in their order.
    [[nodiscard]] std::vector<double> values() const;
    [[nodiscard]] Model to_model(const std::vector<double>& values) const;
    /// The same model with its terms in the order of their names, the highest order first, as far as terms whose order
    /// is free may change places within their bounds.
    [[nodiscard]] std::vector<double> in_order(std::vector<double> values) const;

private:
    Kind kind_;
    Model shape_;  // its terms and their order
    std::vector<Parameter> parameters_;
};

}  // namespace drive
