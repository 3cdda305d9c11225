// Oustaloup's and Charef's rational approximations of s^v as their users tune them to a band: as filters sampled by
// three mappings. In parallel form they are one tap and modes, which every kernel with modes holds.
#pragma once

#include <complex>
#include <cstddef>
#include <string>
#include <vector>

#include "glsum/design/band.hpp"

namespace glsum::design {

/// How a pole or zero at -w becomes one of the sampled filter.
enum class Mapping {
    matched,            ///< e^(-w h)
    tustin,             ///< s = 2/h (z - 1)/(z + 1)
    impulse_invariant,  ///< the impulse response, sampled: of poles with residues, not of sections
};

[[nodiscard]] std::string to_text(Mapping mapping);

/// The edges that a rule spreads its roots between.
struct Edges {
    double low_rad_s;
    double high_rad_s;
};

enum class RationalRule {
    oustaloup,  ///< as many zeros as poles, evenly in the logarithm [Oustaloup2000]
    charef,     ///< the same of v > 0; of v < 0 a pole more than zeros: the singularity function [Charef1992]
};

/// prod (s + zero) / prod (s + pole); rad/s, above 0.
struct Roots {
    std::vector<double> zeros;
    std::vector<double> poles;
};

/// \param order  in (-1, 1), not 0  \param poles  P >= 1
[[nodiscard]] Roots roots_of(RationalRule rule, double order, std::size_t poles, Edges edges);

/// The sampled filter's answer to e^(i angle) before its gain: matched and Tustin's mapping of poles and zeros, or the
/// impulse response sampled, its first sample by half. \param angle  w h in (0, pi]
[[nodiscard]] std::complex<double> response_of(const Roots& roots, Mapping mapping, double step_s, double angle);

struct TunedRational {
    Edges edges;
    Mapping mapping;
    double gain;
    double error;  ///< largest |H - (jw)^v| / w^v at the goal's points, in double
};

/// Whether these rules have a filter of an order: in (-1, 2), and not a whole number.
[[nodiscard]] bool has_rational(double order);

/// Edges, mapping and gain of least error over the band of a goal: the best of a grid, moved in ever smaller steps.
/// Above order 1 a difference of samples over h goes before the filter of one order less. Deterministic.
/// \param allowed  `decaying`: without Tustin's mapping, which turns fast poles negative
/// \pre goal.band, and `has_rational(goal.order)`
[[nodiscard]] TunedRational tune_rational(RationalRule rule, const DerivativeGoal& goal, std::size_t poles,
                                          Poles allowed = Poles::one_may_swing);

/// The tuned filter in parallel form: one tap, and of each pole a mode. Above order 1 of increments, which are the
/// difference of samples that goes before the filter.
/// \pre the goal, rule and poles that it was tuned for
[[nodiscard]] FittedFilter as_modes(RationalRule rule, const DerivativeGoal& goal, std::size_t poles,
                                    const TunedRational& tuned);

}  // namespace glsum::design
