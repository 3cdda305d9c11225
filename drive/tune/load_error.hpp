// A loop's error after a step of the load, without limits: fast enough to search with.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "drive/tune/loop.hpp"

namespace tune {

/// The output of the plant for a unit step that is added to its input, over a horizon.
///
/// Fourier's series of the response damped by e^(-at), from Y(a + jw) = G / (s (1 + L)): exact but for what lies above
/// its highest frequency (a thousandth of the area) and for the damped rest of the next period (10^-4). Lanczos'
/// factors average it over a 512th of the horizon on either side. Sampling enters as the hold's and the difference's
/// transforms, without aliases.
class LoadError {
public:
    LoadError(const SampledPlant& plant, double horizon_s);
    /// At `times()`.
    [[nodiscard]] Eigen::VectorXd response(const drive::Gains& gains) const;
    /// The integral of its magnitude over the horizon.
    [[nodiscard]] double iae(const drive::Gains& gains) const;
    [[nodiscard]] const Eigen::VectorXd& times() const { return times_; }

private:
    double step_s_;
    std::vector<Complex> s_;
    std::vector<Complex> plant_;       // G e^(-s delay)
    std::vector<Complex> held_;        // the same behind a hold
    std::vector<Complex> difference_;  // D
    std::vector<Complex> logarithm_;   // of it
    Eigen::VectorXd times_;
    Eigen::MatrixXd cosines_;  // e^(at) and the series' factor in them
    Eigen::MatrixXd sines_;
};

}  // namespace tune
