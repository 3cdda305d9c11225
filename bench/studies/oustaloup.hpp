// Oustaloup's rational approximation of s^v: what many take in place of a Grünwald-Letnikov sum. For comparison at
// equal cost; it is no kernel, as it approximates the derivative itself and no sum of weights, and has no bound.
#pragma once

#include <cstddef>
#include <vector>

#include "glsum/design/rational.hpp"

namespace bench {

using glsum::design::Mapping;  // matched: and the gain at the middle of the band

/// A band in which |s^v| is approximated.
struct Band {
    double low_rad_s;
    double high_rad_s;
};

/// s^r ~ w_h^r prod_k (s + w'_k)/(s + w_k), k = 0 ... P - 1, with w'_k = w_b (w_h/w_b)^((k + (1 - r)/2)/P) and
/// w_k = w_b (w_h/w_b)^((k + (1 + r)/2)/P) [Oustaloup2000], in second-order sections. Above order 1 a difference goes
/// before it.
class Oustaloup {
public:
    /// \param order   v, as `takes` has it
    /// \param step_s  h > 0
    /// \param poles   P >= 1
    /// \param mapping  matched or Tustin's
    Oustaloup(double order, double step_s, std::size_t poles, Band band, Mapping mapping);

    /// Whether there is a filter of an order: in (-1, 2), and not a whole number.
    [[nodiscard]] static bool takes(double order);

    /// \return h^v times the derivative of order v: what S_k is an approximation of too
    double step(double sample);

    /// 2 P + 1 a sample: two for a pole, one for the gain
    [[nodiscard]] static constexpr std::size_t multiplications(std::size_t poles) { return 2 * poles + 1; }

private:
    // (1 + b1/z + b2/z^2) / (1 + a1/z + a2/z^2); of a single pole b2 = a2 = 0.
    struct Section {
        double b1;
        double b2;
        double a1;
        double a2;
        double first = 0.0;
        double second = 0.0;
    };
    std::vector<Section> sections_;
    double gain_;
    bool differs_;
    double before_ = 0.0;
};

}  // namespace bench
