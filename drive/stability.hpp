// Stability by Matignon's theorem ([Matusiak2020], theorem 1), found twice by independent means.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "drive/commensurate.hpp"
#include "drive/model.hpp"

namespace drive {

enum class Stability {
    stable,
    borderline,  ///< a pole on the boundary: an undamped oscillation, or an integrator
    unstable,
};

struct StabilityVerdict {
    Stability verdict;
    double base_order;                        ///< q
    double rounding;                          ///< largest change of an order by making it a multiple of q
    std::vector<std::complex<double>> roots;  ///< of P(sigma), sigma = s^q
    std::vector<std::complex<double>> poles;  ///< those roots as s, on the principal sheet: |arg sigma| < q pi
    double smallest_angle_rad;                ///< of the roots, |arg sigma|; infinite without roots
    double limit_rad;                         ///< q pi / 2
    double largest_residual;                  ///< of the roots: |P(sigma)| over sum |a_i sigma^i|
    int unstable_by_roots;                    ///< roots inside the limit
    int unstable_by_argument;  ///< zeros of P(s) with Re s > 0 by the argument principle, orders as they are; -1: on
                               ///< the axis
    [[nodiscard]] bool agree() const { return unstable_by_argument < 0 || unstable_by_roots == unstable_by_argument; }
};

/// Roots of the polynomial in sigma as eigenvalues of its companion matrix, each polished by Newton's method; and the
/// zeros of the pseudo-polynomial P(s) in the right half-plane from the turn of its argument along the imaginary axis.
/// A root within 10^-7 rad of the limit, or 0, is on the boundary. \throws glsum::Failure (bad input) as
/// `to_commensurate`.
[[nodiscard]] StabilityVerdict judge_stability(const Model& model, double base_order);

/// The base order that the verdict is taken with unless told: that of whole orders, 1, else the paper's 0.01.
[[nodiscard]] double usual_base_order(const Model& model);

/// Zeros of sum a s^alpha with Re s > 0 on the principal sheet; -1 if one lies on the imaginary axis, 0 included.
[[nodiscard]] int zeros_right_of_axis(const std::vector<Term>& denominator);

[[nodiscard]] const char* name_of(Stability verdict);

}  // namespace drive
