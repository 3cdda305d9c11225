// What a lightly damped pole adds to a function of time, known in closed form from the function's transform.
#pragma once

#include <complex>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "drive/swings.hpp"

namespace drive {

/// Fills several Laplace transforms, which share their poles, at s.
using Image = std::function<void(std::complex<double> s, std::span<std::complex<double>> values)>;

/// Of each transform the part c1/(s - p) + c2/(s - p)^2 and its conjugate; in time 2 Re[(c1 + c2 t) e^(pt)].
struct SwingPart {
    std::complex<double> pole;
    std::vector<std::complex<double>> simple;   ///< c1, one for each transform
    std::vector<std::complex<double>> squared;  ///< c2

    /// Takes the part of each transform from its value at s.
    void take_from(std::span<std::complex<double>> values, std::complex<double> s) const;
    /// Adds each one's function of time; the first ones, if `values` are fewer.
    void add_to(std::span<double> values, double t) const;
    /// The most that transform f's can be within a turn around t.
    [[nodiscard]] double size(std::size_t f, double t) const;
};

/// By the trapezoidal rule on a circle around the pole, of a quarter of the distance to what is known to lie near:
/// exact to rounding. \param count  of transforms  \return none where the pole is not alone within the circle, or of a
/// third order
[[nodiscard]] std::optional<SwingPart> swing_part(const Image& image, std::size_t count, const Swing& swing,
                                                  const std::vector<Swing>& all);

}  // namespace drive
