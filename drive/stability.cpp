#include "drive/stability.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace drive {
namespace {

using Complex = std::complex<double>;

constexpr double on_the_limit_rad = 1e-7;

struct Horner {
    Complex value = 0.0;
    Complex slope = 0.0;
    double magnitude = 0.0;
};

// P, P' and sum |a_i sigma^i|; outside the unit circle all of them divided by sigma^n, which would overflow.
Horner evaluate_polynomial(const std::vector<double>& coefficients, Complex sigma) {
    const std::size_t degree = coefficients.size() - 1;
    Horner at;
    if (std::abs(sigma) <= 1.0) {
        for (std::size_t i = degree + 1; i-- > 0;) {
            at.slope = at.slope * sigma + at.value;
            at.value = at.value * sigma + coefficients[i];
            at.magnitude = at.magnitude * std::abs(sigma) + std::fabs(coefficients[i]);
        }
        return at;
    }
    const Complex inverse = 1.0 / sigma;
    for (std::size_t i = 0; i <= degree; ++i) {
        at.slope = at.slope * inverse + static_cast<double>(i) * coefficients[i] * inverse;
        at.value = at.value * inverse + coefficients[i];
        at.magnitude = at.magnitude / std::abs(sigma) + std::fabs(coefficients[i]);
    }
    return at;
}

std::vector<Complex> roots_of(std::vector<double> coefficients, double& largest_residual) {
    largest_residual = 0.0;
    std::vector<Complex> roots;
    while (coefficients.size() > 1 && coefficients.front() == 0.0) {
        roots.emplace_back(0.0);
        coefficients.erase(coefficients.begin());
    }
    const auto degree = static_cast<Eigen::Index>(coefficients.size()) - 1;
    if (degree < 1) {
        return roots;
    }
    // sigma = unit x, so that the roots' geometric mean is 1.
    const double unit =
        std::pow(std::fabs(coefficients.front() / coefficients.back()), 1.0 / static_cast<double>(degree));
    Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(degree, degree);
    companion.diagonal(-1).setOnes();
    for (Eigen::Index i = 0; i < degree; ++i) {
        companion(i, degree - 1) = -coefficients[static_cast<std::size_t>(i)] / coefficients.back() *
                                   std::pow(unit, static_cast<double>(i - degree));
    }
    const Eigen::VectorXcd values = companion.eigenvalues();
    for (Complex root : values) {
        root *= unit;
        Horner at = evaluate_polynomial(coefficients, root);
        for (int i = 0; i < 3 && at.slope != 0.0; ++i) {
            const Complex better = root - at.value / at.slope;
            const Horner there = evaluate_polynomial(coefficients, better);
            if (!(std::abs(there.value) / there.magnitude < std::abs(at.value) / at.magnitude)) {
                break;
            }
            root = better;
            at = there;
        }
        largest_residual = std::max(largest_residual, std::abs(at.value) / at.magnitude);
        roots.push_back(root);
    }
    std::sort(roots.begin(), roots.end(), [](const Complex& a, const Complex& b) {
        return std::pair(std::fabs(std::arg(a)), std::arg(a)) < std::pair(std::fabs(std::arg(b)), std::arg(b));
    });
    return roots;
}

// P(i w) over the sum of its terms' sizes.
Complex on_axis(const std::vector<Term>& terms, double w) {
    Complex sum = 0.0;
    double magnitude = 0.0;
    for (const Term& term : terms) {
        const double size = std::fabs(term.coefficient) * std::pow(w, term.order);
        sum += std::polar(1.0, 0.5 * std::numbers::pi * term.order) * (term.coefficient < 0 ? -size : size);
        magnitude += size;
    }
    return sum / magnitude;
}

// The turn of arg P(i w) from w to w factor, halved until no piece turns by more than a tenth.
double turn(const std::vector<Term>& terms, double log_from, Complex from, double log_to, Complex to, int depth,
            bool& on_the_axis) {
    if (on_the_axis || std::abs(from) < 1e-9 || std::abs(to) < 1e-9 || depth == 0) {
        on_the_axis = true;
        return 0.0;
    }
    const double middle = 0.5 * (log_from + log_to);
    const Complex between = on_axis(terms, std::exp(middle));
    if (std::abs(between) >= 1e-9) {
        const double first = std::arg(between / from);
        const double second = std::arg(to / between);
        if (std::fabs(first) < 0.1 && std::fabs(second) < 0.1) {
            return first + second;
        }
    }
    return turn(terms, log_from, from, middle, between, depth - 1, on_the_axis) +
           turn(terms, middle, between, log_to, to, depth - 1, on_the_axis);
}

}  // namespace

int zeros_right_of_axis(const std::vector<Term>& denominator) {
    std::vector<Term> terms;
    std::copy_if(denominator.begin(), denominator.end(), std::back_inserter(terms),
                 [](const Term& term) { return term.coefficient != 0.0; });
    std::sort(terms.begin(), terms.end(), [](const Term& a, const Term& b) { return a.order < b.order; });
    if (terms.front().order > 0.0) {
        return -1;  // P(0) = 0
    }
    // Where the first and the last term are all there is, to 10^-6.
    double lowest = INFINITY;
    double highest = -INFINITY;
    for (std::size_t i = 0; i < terms.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double crossing =
                std::log(std::fabs(terms[j].coefficient / terms[i].coefficient)) / (terms[i].order - terms[j].order);
            const double reach = std::log(1e6) / (terms[i].order - terms[j].order);
            lowest = std::min(lowest, crossing - reach);
            highest = std::max(highest, crossing + reach);
        }
    }
    if (!(lowest < highest)) {
        return 0;  // one term alone
    }
    bool on_the_axis = false;
    double turned = 0.0;
    constexpr int pieces = 400;
    double from = lowest;
    Complex value = on_axis(terms, std::exp(from));
    for (int i = 1; i <= pieces; ++i) {
        const double to = lowest + (highest - lowest) * i / pieces;
        const Complex next = on_axis(terms, std::exp(to));
        turned += turn(terms, from, value, to, next, 40, on_the_axis);
        from = to;
        value = next;
    }
    if (on_the_axis) {
        return -1;
    }
    // The arc at infinity turns by alpha_n pi; the axis, run downward on both sides, by twice this.
    const double zeros = (terms.back().order * std::numbers::pi - 2.0 * turned) / (2.0 * std::numbers::pi);
    return static_cast<int>(std::lround(zeros));
}

StabilityVerdict judge_stability(const Model& model, double base_order) {
    const Commensurate form = to_commensurate(model, base_order);
    StabilityVerdict judged{};
    judged.base_order = base_order;
    judged.rounding = form.rounding;
    judged.roots = roots_of(form.denominator, judged.largest_residual);
    judged.limit_rad = 0.5 * std::numbers::pi * base_order;
    judged.smallest_angle_rad = std::numeric_limits<double>::infinity();
    bool on_the_limit = false;
    for (const Complex& root : judged.roots) {
        const double angle = root == 0.0 ? judged.limit_rad : std::fabs(std::arg(root));
        judged.smallest_angle_rad = std::min(judged.smallest_angle_rad, angle);
        on_the_limit = on_the_limit || std::fabs(angle - judged.limit_rad) <= on_the_limit_rad;
        judged.unstable_by_roots += angle < judged.limit_rad - on_the_limit_rad ? 1 : 0;
        if (root != 0.0 && std::fabs(std::arg(root)) <= std::numbers::pi * std::min(1.0, base_order) + 1e-12) {
            const Complex pole = std::polar(std::pow(std::abs(root), 1.0 / base_order), std::arg(root) / base_order);
            // A double root comes as a pair that rounding has parted.
            judged.poles.push_back(std::fabs(pole.imag()) < 1e-7 * std::abs(pole) ? Complex(pole.real()) : pole);
        }
    }
    judged.unstable_by_argument = zeros_right_of_axis(model.denominator);
    judged.verdict = judged.unstable_by_roots > 0 || judged.unstable_by_argument > 0 ? Stability::unstable
                     : on_the_limit || judged.unstable_by_argument < 0               ? Stability::borderline
                                                                                     : Stability::stable;
    return judged;
}

double usual_base_order(const Model& model) {
    for (const auto* terms : {&model.numerator, &model.denominator}) {
        for (const Term& term : *terms) {
            if (term.order != std::floor(term.order)) {
                return 0.01;
            }
        }
    }
    return 1.0;
}

const char* name_of(Stability verdict) {
    switch (verdict) {
        case Stability::stable:
            return "stable";
        case Stability::borderline:
            return "borderline";
        case Stability::unstable:
            break;
    }
    return "unstable";
}

}  // namespace drive
