#include "drive/commensurate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "base/failure.hpp"

namespace drive {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

std::vector<double> powers(const std::vector<Term>& terms, double base_order, double gain, double& rounding) {
    std::vector<double> coefficients;
    for (const Term& term : terms) {
        const auto power = static_cast<std::size_t>(std::llround(term.order / base_order));
        rounding = std::max(rounding, std::fabs(static_cast<double>(power) * base_order - term.order));
        if (power >= coefficients.size()) {
            coefficients.resize(power + 1, 0.0);
        }
        if (coefficients[power] != 0.0) {
            refuse(fmt::format("base order {}: expected one that keeps the orders apart; two become {}", base_order,
                               static_cast<double>(power) * base_order));
        }
        coefficients[power] = gain * term.coefficient;
    }
    return coefficients;
}

}  // namespace

Commensurate to_commensurate(const Model& model, double base_order) {
    if (!(base_order > 0.0 && base_order < 2.0)) {
        refuse(fmt::format("base order: expected a number in (0, 2), found {}", base_order));
    }
    const double degree = highest_order(model.denominator) / base_order;
    if (degree > static_cast<double>(highest_degree) + 0.5) {
        refuse(fmt::format(
            "base order {}: the polynomial would be of degree {:.0f}; expected at most {}, above which its roots "
            "take minutes and lose their digits; take a larger base order",
            base_order, degree, highest_degree));
    }
    Commensurate form{base_order, {}, {}, 0.0};
    form.denominator = powers(model.denominator, base_order, 1.0, form.rounding);
    form.numerator = powers(model.numerator, base_order, model.gain, form.rounding);
    return form;
}

std::optional<double> common_base_order(const Model& model) {
    constexpr double unit = 1e-6;
    std::int64_t common = 0;
    for (const auto* terms : {&model.numerator, &model.denominator}) {
        for (const Term& term : *terms) {
            const double units = term.order / unit;
            if (std::fabs(units - std::round(units)) > 1e-3) {
                return std::nullopt;
            }
            common = std::gcd(common, std::llround(units));
        }
    }
    if (common == 0) {
        return 1.0;
    }
    common = std::gcd(common, std::int64_t{1'000'000}) == 1'000'000 ? 1'000'000 : common;
    // Of 2 and above the largest part that is below: of a lone 2.5 the half.
    const double base_order = static_cast<double>(common) * unit / static_cast<double>(common / 2'000'000 + 1);
    if (highest_order(model.denominator) / base_order > static_cast<double>(highest_degree)) {
        return std::nullopt;
    }
    return base_order;
}

StateSpace to_state_space(const Commensurate& model) {
    const std::size_t degree = model.denominator.size() - 1;
    const auto states = static_cast<Eigen::Index>(degree);
    const double leading = model.denominator.back();
    StateSpace space{model.base_order, Eigen::MatrixXd::Zero(states, states), Eigen::VectorXd::Zero(states),
                     Eigen::RowVectorXd::Zero(states), 0.0};
    const auto above = [&](std::size_t i) { return i < model.numerator.size() ? model.numerator[i] / leading : 0.0; };
    space.d = above(degree);
    for (Eigen::Index i = 0; i + 1 < states; ++i) {
        space.a(i, i + 1) = 1.0;
    }
    for (std::size_t i = 0; i < degree; ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        space.a(states - 1, at) = -model.denominator[i] / leading;
        space.c(at) = above(i) - space.d * model.denominator[i] / leading;
    }
    if (states > 0) {
        space.b(states - 1) = 1.0;
    }
    return space;
}

}  // namespace drive
