// The tail of the Grünwald-Letnikov weights as a few decaying exponentials ("modes"), with the certificate of its
// error.
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
#include <optional>
#include <vector>

namespace glsum::modes {

/// What is approximated, and how well.
struct Target {
    double order;         ///< v in (-1, 2), no integer
    std::size_t horizon;  ///< N >= 1: the last index j that counts
    double error;         ///< bound of sum_{j=K..N} |a_j - approximation|: of the output, for |x| <= 1, before h^-v
};

/// One exponential: its part of a_j is weight (1 - decay)^(j-K).
struct Mode {
    double decay;   ///< d = 1 - r in (0, 1); r itself would lose the slow modes in single precision
    double weight;  ///< w, of the sign of the tail
};

/// a_0 ... a_(K-1) are exact, a_j ~ sum_m w_m (1 - d_m)^(j-K) from j = K on.
struct Approximation {
    std::size_t near_taps;    ///< K
    std::vector<Mode> modes;  ///< M of them, slowest first
    double error;             ///< the exact sum_{j=K..N} |a_j - approximation|

    /// K + 2M: multiplications a sample.
    [[nodiscard]] std::size_t cost() const { return near_taps + 2 * modes.size(); }
};

/// The most exact taps that the integral needs: K > v, and not by little.
[[nodiscard]] std::size_t least_near_taps(double order);

/// With these numbers of taps and modes. Fewer modes come back when the tail needs no more.
/// \pre near_taps >= least_near_taps(target.order); target.error decides how fine the trapezoid is.
[[nodiscard]] Approximation approximate(const Target& target, std::size_t near_taps, std::size_t modes);

/// The cheapest that meets the target, over K from the least up to 64 and M up to 40; empty if none does.
[[nodiscard]] std::optional<Approximation> design(const Target& target);

}  // namespace glsum::modes
