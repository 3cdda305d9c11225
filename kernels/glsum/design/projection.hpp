// Few exponentials for many: the tail's integral as a trapezoidal sum, and its projection on what dominates.
//
// For every order v > -1 that is no integer and every integer j > v, by the Beta function,
//
//   a_j = -(sin(pi v)/pi) Int_{-inf}^{inf} e^(-s (j-v)) (1 - e^(-s))^v s du,      s = e^u:
//
// behind the first taps all weights have one sign and are a mixture of r^j, 0 < r < 1, with a positive density. The
// trapezoid in u takes some forty of these exponentials; projected on the dominant eigenvectors of their Gramian (for
// this symmetric system balanced truncation) a dozen are left, whose poles are real and inside (0, 1) whatever is
// dropped: the projection of a symmetric matrix keeps its eigenvalues between the old ones. No optimizer is needed.
#pragma once

#include <cstddef>
#include <vector>

#include "glsum/design/mode.hpp"

namespace glsum::design {

/// An exponential of the mixture: b^2 e^(-s (j-K)).
struct Node {
    double rate;  ///< s > 0
    double root;  ///< b
};

/// |a_j| for j >= K as a mixture.
/// \param order      v > -1, no integer
/// \param near_taps  K > v, and not by little
/// \param horizon    the largest j that counts
/// \param error      what the sum over j of the mixture's own errors stays below
[[nodiscard]] std::vector<Node> tail_nodes(double order, std::size_t near_taps, std::size_t horizon, double error);

/// The fewest exact taps that the integral needs: K > v, by at least 0.25.
[[nodiscard]] std::size_t least_near_taps(double order);

class Projection {
public:
    /// \param horizon  discounts the infinite sums of the Gramian to as many terms
    Projection(std::vector<Node> nodes, std::size_t horizon);

    [[nodiscard]] std::size_t size() const { return nodes_.size(); }
    /// About the error of `modes(count)`: twice the sum of the eigenvalues that it drops.
    [[nodiscard]] double dropped(std::size_t count) const;
    /// On the `count` dominant eigenvectors, at most `size()`: slowest first, all weights positive.
    [[nodiscard]] std::vector<Mode> modes(std::size_t count) const;

private:
    std::vector<Node> nodes_;
    std::vector<double> vectors_;  // one after the other, the dominant ones first
    std::vector<double> values_;
};

}  // namespace glsum::design
