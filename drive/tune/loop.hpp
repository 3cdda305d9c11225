// The open loop of a sampled controller around a continuous plant, on the frequency axis.
//
//   L(jw) = C(D) P*(jw),   D = (1 - e^(-jwh)) / h,   C = kp + ki D^-lambda + kd D^mu / (filter_s D + 1)
//
// C is what Grünwald-Letnikov's weights make of the controller, all of the past in memory. P* is the plant behind a
// zero-order hold as its samples show it: hold, dead time and aliases included, so half a sample of delay is in it.
// What the controller computes is put out at once; a latency of its own belongs to the plant's dead time.
#pragma once

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "drive/controller.hpp"
#include "drive/model.hpp"

namespace tune {

using Complex = std::complex<double>;
inline constexpr double pi = std::numbers::pi;

/// A strictly proper plant that is sampled each `step_s`.
class SampledPlant {
public:
    /// \throws glsum::Failure (bad input) for a plant that answers its input at once, one that is unstable, or a step
    /// that is not above 0. \param name  begins the message
    SampledPlant(const drive::Model& plant, double step_s, const std::string& name);

    /// P* at 0 < w <= pi / step_s, in rad/s.
    [[nodiscard]] Complex operator()(double w) const;
    /// G(s) with its dead time, without hold and aliases; Re s >= 0, s other than 0.
    [[nodiscard]] Complex continuous(Complex s) const;

    [[nodiscard]] const drive::Model& model() const { return plant_; }
    [[nodiscard]] double step_s() const { return step_s_; }
    [[nodiscard]] double nyquist() const;  ///< rad/s
    /// The frequency that decides how fast a loop can be: the highest at which the plant's phase is above -135 degrees,
    /// or for a plant that never is, 45 degrees below where it begins. rad/s, at most half of `nyquist`.
    [[nodiscard]] double scale() const { return scale_; }
    /// Of s in the limit s -> 0: 1 for an integrator, 0 for a plant that rests.
    [[nodiscard]] double integrations() const;
    /// +1, or -1 where a positive input moves the output down.
    [[nodiscard]] double sign() const;

private:
    drive::Model plant_;
    double step_s_;
    double scale_ = 0.0;
};

/// The three parts that kp, ki and kd weigh, and how they change with ln w.
struct Parts {
    Complex value[3];
    Complex slope[3];  ///< d value / d ln w
};
[[nodiscard]] Parts controller_parts(const drive::Gains& orders, double step_s, double w);

struct Loop {
    const SampledPlant* plant;
    drive::Gains gains;
    [[nodiscard]] Complex controller(double w) const;  ///< C
    [[nodiscard]] Complex operator()(double w) const;
};

/// A sampled controller of any make, by what it makes of sines.
struct Response {
    std::function<Complex(double)> at;  ///< C at 0 < w <= pi / step_s, in rad/s
    double integrations;                ///< of s in the limit s -> 0
    double from = INFINITY;             ///< rad/s: below, its phase is that of the limit; infinite: the plant decides
};

}  // namespace tune
