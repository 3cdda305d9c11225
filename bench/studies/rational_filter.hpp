// Oustaloup's and Charef's rational approximations of s^v as their users tune them to a band: as filters sampled by
// three mappings. For comparison; in parallel form a kernel with modes holds them.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "bench/studies/oustaloup.hpp"
#include "glsum/design/band.hpp"

namespace bench {

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
[[nodiscard]] Roots roots_of(RationalRule rule, double order, std::size_t poles, Band band);

/// The sampled filter's answer to e^(i angle) before its gain: matched and Tustin's mapping of poles and zeros, or the
/// impulse response sampled, its first sample by half. \param angle  w h in (0, pi]
[[nodiscard]] std::complex<double> response_of(const Roots& roots, Mapping mapping, double step_s, double angle);

struct TunedRational {
    Band band;
    Mapping mapping;
    double gain;
    double error;  ///< largest |H - (jw)^v| / w^v at the goal's points, in double
};

/// Band, mapping and gain of least error over the band of a goal: the best of a grid, moved in ever smaller steps.
/// Above order 1 a difference of samples over h goes before the filter of one order less. Deterministic.
/// \pre goal.band, and `Oustaloup::takes(goal.order)`
[[nodiscard]] TunedRational tune_rational(RationalRule rule, const glsum::design::DerivativeGoal& goal,
                                          std::size_t poles);

/// The tuned filter in parallel form: one tap, and of each pole a mode. Above order 1 of increments, which are the
/// difference of samples that goes before the filter.
/// \pre the goal, rule and poles that it was tuned for
[[nodiscard]] glsum::design::FittedFilter as_modes(RationalRule rule, const glsum::design::DerivativeGoal& goal,
                                                   std::size_t poles, const TunedRational& tuned);

}  // namespace bench
