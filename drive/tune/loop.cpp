#include "drive/tune/loop.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "drive/refusal.hpp"
#include "drive/stability.hpp"

namespace tune {
namespace {

// Aliases on each side. The rest of a plant of first order is at most 2e-4 of it where few do, and 0.3 % at Nyquist's.
constexpr int few = 20;
constexpr int many = 200;

double lowest_order(const std::vector<drive::Term>& terms) {
    double lowest = INFINITY;
    for (const drive::Term& term : terms) {
        lowest = term.coefficient != 0.0 ? std::min(lowest, term.order) : lowest;
    }
    return lowest;
}

double lowest_coefficient(const std::vector<drive::Term>& terms) {
    const double order = lowest_order(terms);
    return std::find_if(terms.begin(), terms.end(),
                        [&](const auto& term) { return term.coefficient != 0.0 && term.order == order; })
        ->coefficient;
}

// The phase of the held plant, followed from low frequencies.
double find_scale(const drive::Model& plant, double step_s, double begins_rad, double sign) {
    const double top = 0.5 * pi / step_s;
    double w = 1e-7 * top;
    double before = begins_rad;
    double above = 0.0;
    double below = 0.0;  // 45 degrees below its beginning
    for (; w < top; w *= 1.02) {
        const double turned = std::arg(sign * drive::evaluate_without_delay(plant, {0.0, w}));
        before += std::remainder(turned - before, 2.0 * pi);
        const double phase = before - w * (plant.delay_s + 0.5 * step_s);
        above = phase > -0.75 * pi ? w : above;
        below = phase > begins_rad - 0.25 * pi ? w : below;
    }
    return above > 0.0 ? above : below > 0.0 ? below : top;
}

}  // namespace

SampledPlant::SampledPlant(const drive::Model& plant, double step_s, const std::string& name)
    : plant_(plant), step_s_(step_s) {
    if (!(step_s > 0.0 && std::isfinite(step_s))) {
        drive::refuse(fmt::format("{}: expected a sample time above 0 s, found {}", name, step_s));
    }
    if (!(drive::highest_order(plant.numerator) < drive::highest_order(plant.denominator))) {
        drive::refuse(
            fmt::format("{}: expected a plant that does not answer its input at once: a numerator of lower order "
                        "than {}, found {}",
                        name, drive::highest_order(plant.denominator), drive::highest_order(plant.numerator)));
    }
    std::vector<drive::Term> without_integrator = plant.denominator;
    const double integrator = lowest_order(plant.denominator);
    for (drive::Term& term : without_integrator) {
        term.order -= integrator;
    }
    if (const int right = drive::zeros_right_of_axis(without_integrator); right != 0) {
        drive::refuse(fmt::format("{}: expected a plant that is stable or integrates, found {}", name,
                                  right < 0 ? std::string("poles on the imaginary axis")
                                            : fmt::format("{} poles with a positive real part", right)));
    }
    scale_ = find_scale(plant, step_s, -0.5 * pi * integrations(), sign());
}

double SampledPlant::nyquist() const { return pi / step_s_; }

double SampledPlant::integrations() const { return lowest_order(plant_.denominator) - lowest_order(plant_.numerator); }

double SampledPlant::sign() const {
    return std::copysign(1.0,
                         plant_.gain * lowest_coefficient(plant_.numerator) * lowest_coefficient(plant_.denominator));
}

Complex SampledPlant::continuous(Complex s) const {
    return drive::evaluate_without_delay(plant_, s) * std::exp(-plant_.delay_s * s);
}

Complex SampledPlant::operator()(double w) const {
    const Complex held = (1.0 - std::polar(1.0, -w * step_s_)) / step_s_;
    Complex sum = continuous({0.0, w}) / Complex(0.0, w);
    if (w * step_s_ > 0.01) {  // below, the aliases are a millionth
        for (int k = 1; k <= (w * step_s_ < 0.3 ? few : many); ++k) {
            for (const double there : {w + 2.0 * pi * k / step_s_, w - 2.0 * pi * k / step_s_}) {
                sum += continuous({0.0, there}) / Complex(0.0, there);
            }
        }
    }
    return held * sum;
}

Parts controller_parts(const drive::Gains& orders, double step_s, double w) {
    const Complex lag = std::polar(1.0, -w * step_s);
    const Complex d = (1.0 - lag) / step_s;
    const Complex turn = Complex(0.0, w) * lag / d;  // d ln D / d ln w
    const Complex logarithm = std::log(d);
    const Complex integral = std::exp(-orders.integral_order * logarithm);
    const Complex derivative = std::exp(orders.derivative_order * logarithm) / (orders.filter_s * d + 1.0);
    return {{1.0, integral, derivative},
            {0.0, -orders.integral_order * turn * integral,
             (orders.derivative_order - orders.filter_s * d / (orders.filter_s * d + 1.0)) * turn * derivative}};
}

Complex Loop::controller(double w) const {
    const Parts parts = controller_parts(gains, plant->step_s(), w);
    return gains.kp + gains.ki * parts.value[1] + gains.kd * parts.value[2];
}

Complex Loop::operator()(double w) const { return controller(w) * (*plant)(w); }

}  // namespace tune
