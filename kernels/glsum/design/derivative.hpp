// What a user wants of a derivative, or an integral, of order v: how near a filter comes to (jw)^v over a band of
// frequencies, and to t^-v / Gamma(1 - v) behind a step, for as long as it runs.
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "glsum/design/filter.hpp"

namespace glsum::design {

/// Frequencies, both ends included.
struct Band {
    double low_hz;   ///< above 0
    double high_hz;  ///< at most half a sample's rate
    bool operator==(const Band&) const = default;
};

struct DerivativeGoal {
    double order;   ///< v, in (-2, 2]
    double step_s;  ///< h > 0
    std::optional<Band> band = {};
    std::optional<double> step_until_s = {};  ///< at least ten samples

    /// N: the last sample of the step, and at least a period of the band's lowest frequency.
    [[nodiscard]] std::size_t horizon() const;
    /// k of the step's last sample; 0 without a step.
    [[nodiscard]] std::size_t last_of_step() const;
};

/// From this sample on a step's response counts: before it every sampled derivative is a few weights.
inline constexpr std::size_t first_of_step = 10;

/// Whether a step's response can be held against t^-v / Gamma(1 - v): not of v = 1 and 2, where that is 0.
[[nodiscard]] bool has_step(double order);

/// (jw)^v. \param hz  above 0
[[nodiscard]] std::complex<double> exact_response(double order, double hz);
/// t^-v / Gamma(1 - v). \pre has_step(order) \param time_s  above 0
[[nodiscard]] double exact_step(double order, double time_s);

/// What the sum with all its weights answers: ((1 - e^(-ja)) / h)^v at the angle a a sample, and behind a unit step
/// h^-v sum_{j<=k} a_j = h^-v Gamma(k + 1 - v) / (Gamma(1 - v) Gamma(k + 1)) at sample k.
[[nodiscard]] std::complex<double> full_memory_response(double order, double step_s, double angle);
/// \pre has_step(order)
[[nodiscard]] double full_memory_step(double order, double step_s, std::size_t k);

/// Relative errors, and where they are: 0 of what the goal does not ask for.
struct DerivativeError {
    double band = 0.0;     ///< largest |H(e^(jwh)) - (jw)^v| / w^v
    double band_hz = 0.0;  ///< there
    double step = 0.0;     ///< largest |D_k - exact| / |exact| from k = 10 on
    double step_s = 0.0;   ///< there
    [[nodiscard]] double largest() const { return band > step ? band : step; }
};

/// Where a search looks: 32 frequencies a decade and both ends, and samples of the step 4 % apart.
[[nodiscard]] std::vector<double> frequencies_of(const DerivativeGoal& goal);
[[nodiscard]] std::vector<std::size_t> samples_of(const DerivativeGoal& goal);

/// The largest error at those points.
[[nodiscard]] DerivativeError error_at_points(const Filter& filter, const DerivativeGoal& goal);

/// Not exceeded anywhere, by 0.5 % at most above what is reached, if that is below a half: between points of the band
/// the error is bounded by its second derivative, and intervals are halved until that costs no more; of the step every
/// sample counts.
[[nodiscard]] DerivativeError certified_error(const Filter& filter, const DerivativeGoal& goal);

}  // namespace glsum::design
