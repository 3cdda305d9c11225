// A function of time from its Laplace transform, in double: fast enough for fits, exact to about nine digits.
//
// The method is Abate and Whitt's Euler summation (ORSA J. Computing 7, 1995): the trapezoidal rule on a line right of
// all singularities, whose alternating series is summed with binomial weights. No step of it amplifies rounding.
// Lightly damped poles, which it would take hundreds of terms to follow, are taken out first: what they add is known in
// closed form. `exact_step_response.hpp` is the check, in multi-precision and by another method.
#pragma once

#include <array>
#include <complex>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "drive/swing_part.hpp"

namespace drive {

/// The inverses of one or several transforms that share their poles, smooth for t > 0. Values are kept: one octave of
/// time [2^w, 2^(w+1)) costs some hundred evaluations of the transforms when it is first asked for, and a polynomial of
/// degree 15 each afterwards.
class InverseLaplace {
public:
    using Complex = std::complex<double>;
    /// \param count  of transforms
    /// \param image  analytic right of the imaginary axis but for `swings`, real on the real axis, without a dead time
    ///               (which would have a kink)
    /// \param swings  the lightly damped poles; growing ones too, as long as they do not grow beyond 10^3
    InverseLaplace(std::size_t count, Image image, std::vector<Swing> swings);

    /// f(t) of each; 0 for t <= 0. The errors are about 1e-9 of the functions' sizes around t, or of what rounding
    /// leaves of their transforms near a pole, if that is more: after a swing has decayed. \throws glsum::Failure
    /// (check failed) where it does not converge: it grows, some ten thousand radians of a swing lie before t, or some
    /// hundred of one that cannot be told from another. Not safe to call from several threads: it fills its tables.
    void at(double t, std::span<double> values);
    /// The first.
    double operator()(double t) {
        double value = 0.0;
        at(t, {&value, 1});
        return value;
    }

    /// Of the polynomials of time: their degree is one less.
    static constexpr std::size_t nodes = 16;

private:
    struct Octave {
        std::vector<const SwingPart*> parts;  // what the coefficients leave out
        std::size_t pieces = 1;
        std::vector<std::array<double, nodes>> coefficients;  // Chebyshev's: those of all functions, piece by piece
    };
    const Octave& octave(int exponent);
    [[nodiscard]] Octave make_octave(int exponent) const;
    void euler_sum(const Octave& octave, double abscissa, double t, int terms, std::span<double> values,
                   std::span<double> sizes) const;

    std::size_t count_;
    Image image_;
    std::vector<Swing> swings_;
    std::vector<std::optional<SwingPart>> parts_;  // of each swing, where it is alone
    std::map<int, Octave> octaves_;
    int last_exponent_ = 0;
    const Octave* last_ = nullptr;
};

}  // namespace drive
