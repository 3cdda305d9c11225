// A model whose orders are multiples of one base order q: a rational function of sigma = s^q ([Matusiak2020], below
// (5)).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "drive/model.hpp"

namespace drive {

/// sum numerator[i] sigma^i / sum denominator[i] sigma^i, the gain in the numerator; the dead time is not part of it.
struct Commensurate {
    double base_order;  ///< q
    std::vector<double> numerator;
    std::vector<double> denominator;
    double rounding;  ///< the largest change of an order that making it a multiple of q took
};

/// The orders rounded to multiples of `base_order`.
/// \throws glsum::Failure (bad input): a base order that is not in (0, 2), a degree above `highest_degree` (whose roots
/// would take minutes and lose their digits), or orders that fall together.
inline constexpr std::size_t highest_degree = 600;
[[nodiscard]] Commensurate to_commensurate(const Model& model, double base_order);

/// The largest q below 2 of which all orders are multiples, orders taken as decimals of at most 6 places; 1 for whole orders.
/// None where the degree would be above `highest_degree`: then there is no commensurate form to work with.
[[nodiscard]] std::optional<double> common_base_order(const Model& model);

/// D^q x = A x + B u, y = C x + D u, in controllable canonical form; one state for each power of sigma.
struct StateSpace {
    double base_order;
    Eigen::MatrixXd a;
    Eigen::VectorXd b;
    Eigen::RowVectorXd c;
    double d;
};

[[nodiscard]] StateSpace to_state_space(const Commensurate& model);

}  // namespace drive
