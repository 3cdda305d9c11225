#include "drive/exact_step_response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/multiprecision/complex_adaptor.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <cmath>
#include <optional>
#include <utility>

#include "base/failure.hpp"
#include "drive/swings.hpp"

namespace drive {
namespace {

namespace mp = boost::multiprecision;

template <unsigned digits>
struct Numbers {
    using Backend = mp::mpfr_float_backend<digits>;
    using Real = mp::number<Backend, mp::et_off>;
    using Complex = mp::number<mp::complex_adaptor<Backend>, mp::et_off>;
};

using Widest = Numbers<400>::Real;

template <class Complex>
Complex sum_of(const std::vector<Term>& terms, const Complex& logarithm) {
    Complex sum(0);
    for (const Term& term : terms) {
        sum += Complex(term.coefficient) * exp(logarithm * Complex(term.order));
    }
    return sum;
}

// t > 0: f(t) = r/M ( e^(rt) F(r)/2 + sum Re[ e^(t s_k) F(s_k) (1 + i sigma_k) ] ), r = 2M/(5t), s = r theta (cot theta
// + i)
template <unsigned nodes>
Widest talbot(const Model& model, double t_s) {
    using Real = typename Numbers<nodes>::Real;
    using Complex = typename Numbers<nodes>::Complex;
    const Real t = Real(t_s) - Real(model.delay_s);
    const Real radius = Real(2 * nodes) / (5 * t);
    const auto image = [&](const Complex& s) {
        const Complex logarithm = log(s);
        return Complex(Complex(model.gain) * sum_of(model.numerator, logarithm) /
                       (s * sum_of(model.denominator, logarithm)));
    };
    Real sum = exp(Real(radius * t)) * Real(real(image(Complex(radius)))) / 2;
    const Real pi = acos(Real(-1));
    for (unsigned k = 1; k < nodes; ++k) {
        const Real theta = pi * k / nodes;
        const Real cotangent = cos(theta) / sin(theta);
        const Complex s(Real(radius * theta * cotangent), Real(radius * theta));
        const Real sigma = theta + (theta * cotangent - 1) * cotangent;
        const Complex value = exp(s * Complex(t)) * image(s) * Complex(Real(1), sigma);
        sum += Real(real(value));
    }
    return Widest(Real(sum * radius / nodes));
}

struct Contour {
    unsigned nodes;
    Widest (*run)(const Model& model, double t_s);
};
template <unsigned nodes>
constexpr Contour with_nodes{nodes, &talbot<nodes>};

int agreement(const Widest& a, const Widest& b) {
    if (a == b) {
        return 40;
    }
    if (b == 0) {
        return 0;
    }
    const Widest relative = abs(Widest((a - b) / b));
    return std::clamp(static_cast<int>(std::floor(-static_cast<double>(log10(relative)))), 0, 40);
}

}  // namespace

ExactValue exact_step_response(const Model& model, double t_s, int wanted_digits) {
    if (!std::isfinite(t_s)) {
        throw glsum::Failure(glsum::Exit::bad_input, fmt::format("expected a finite time, found {}", t_s));
    }
    if (!(t_s > model.delay_s)) {
        return {0.0, "0", 40};
    }
    // The contour leaves out swings above 0.6 nodes / t, in two runs alike.
    const double t = t_s - model.delay_s;
    const double needed_nodes =
        2.0 * t * fastest_left(swings_of(model.denominator), t, std::pow(10.0, -wanted_digits - 1));
    std::optional<Widest> before;
    for (const Contour& contour : {with_nodes<48>, with_nodes<96>, with_nodes<192>, with_nodes<384>}) {
        if (contour.nodes < needed_nodes) {
            continue;
        }
        const Widest now = contour.run(model, t_s);
        if (const int digits = before ? agreement(*before, now) : 0; digits >= wanted_digits) {
            return {static_cast<double>(now), now.str(std::min(digits, 40)), digits};
        }
        before = now;
    }
    throw glsum::Failure(glsum::Exit::check_failed,
                         fmt::format("{}: no {} digits at {} s: too lightly damped, or unstable, for so late a time",
                                     to_text(model), wanted_digits, t_s));
}

}  // namespace drive
