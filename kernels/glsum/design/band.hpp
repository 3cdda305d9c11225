// A filter fitted to the derivative itself, over a band and along a step: not to the weights of a sum, whose own error
// grows towards half the sample's rate.
//
// Given its poles, a filter of near taps and modes is linear in what is sought; its largest relative error is made
// small by least squares whose weights follow the error (Lawson's iteration [Lawson1961]), and the poles, real and
// inside the circle, are moved by Gauss-Newton steps of the weighted problem with the linear part solved for (variable
// projection [GolubPereyra1973]). At last Newton's steps of all unknowns make ever higher powers of the error small.
// Oustaloup's and Charef's filters are of this form too, with poles and weights by rule; Tustin's mapping turns their
// fastest poles negative, and so may one pole here.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "glsum/design/derivative.hpp"
#include "glsum/kernel.hpp"

namespace glsum::design {

/// Which poles a filter may have.
enum class Poles {
    decaying,  ///< in [0, 1): what every kernel with modes holds
    /// One lies in (-0.9, 0), or from -0.75, -0.6 or -0.4 on where coefficients would be too large else: floating point
    /// alone. Of v towards 1 it is worth several others.
    one_swings,
    one_may_swing,  ///< the better of both
};

/// A filter for a goal, as what a kernel's design names: D_k = factor S_k with S_k of these weights and modes.
struct FittedFilter {
    double factor;                ///< b_0: w_0 h^-v
    std::vector<double> weights;  ///< a_1 ... a_(K-1), of what the kernel sums
    std::vector<Mode> modes;      ///< slowest first; of an integrator the first does not decay
    DerivativeError error;        ///< of the filter in double, at the points of a search
    FilterKind kind = FilterKind::samples;
    /// What rounding is multiplied by: the magnitudes of all coefficients, in units of the order's own weights'.
    double amplification = 0.0;

    /// K + 2M: what a design calls taps.
    [[nodiscard]] std::size_t length() const { return 1 + weights.size() + 2 * modes.size(); }
    /// Of the samples, in units of the derivative.
    [[nodiscard]] Filter filter() const;
};

/// \param near_taps  K >= 1
/// \param modes      M; none: a window fitted to the goal; of an integrator M >= 1
/// \param cost  of a coefficient, as a relative error, when it is as large as would answer the whole goal: large ones
/// of
///              both signs are loud in a format of few digits. 0: no more than keeps them from being too large.
/// A tap that no point of the goal shows is that of the order's own weights. The same arguments give the same filter.
/// \pre of `one_swings` a mode that may move: M >= 1, of an integrator M >= 2
[[nodiscard]] FittedFilter fit_filter(const DerivativeGoal& goal, std::size_t near_taps, std::size_t modes,
                                      FilterKind kind, Poles poles = Poles::decaying, double cost = 0.0);

/// The shortest filter, of one near tap or two and modes, whose certified error in double is at most `error`: a
/// half-order derivative within 5 % from 0.05 to 80 Hz and of a step until a minute, at 1 kHz:
///
///     const auto found = design_filter({.order = 0.5, .step_s = 1e-3, .band = Band{0.05, 80}, .step_until_s = 60},
///                                      0.05);
///     line.prepare({.order = 0.5, .taps = found->length(), .modes = found->modes, .weights = found->weights});
///     double derivative = found->factor * line.step(x);
///
/// What a kernel holds of it adds the rounding of its table (held.hpp), certified again by `certified_error`, and the
/// noise of its arithmetic. Empty where none of `longest_filter` coefficients is that near, or where six lengths in a
/// row gained nothing.
[[nodiscard]] std::optional<FittedFilter> design_filter(const DerivativeGoal& goal, double error,
                                                        FilterKind kind = FilterKind::samples,
                                                        Poles poles = Poles::decaying);
inline constexpr std::size_t longest_filter = 40;

/// How many of a filter's poles are sought: all modes but an integrator's running sum.
[[nodiscard]] constexpr std::size_t moving_poles(std::size_t modes, FilterKind kind) {
    return modes - (kind == FilterKind::integrator ? 1 : 0);
}

/// The one that errs less, of those that do not amplify too much.
[[nodiscard]] const FittedFilter& better_of(const FittedFilter& decaying, const FittedFilter& swinging);

}  // namespace glsum::design
