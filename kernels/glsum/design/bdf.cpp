#include "glsum/design/bdf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "glsum/double_double.hpp"

namespace glsum::design {
namespace {

// P(z), times what makes its coefficients whole.
struct Formula {
    std::array<double, most_bdf_steps + 1> coefficients;
    double divisor;
};

const Formula& formula_of(unsigned steps) {
    static constexpr Formula formulas[] = {
        {{3, -4, 1, 0, 0}, 2}, {{11, -18, 9, -2, 0}, 6}, {{25, -48, 36, -16, 3}, 12}};
    if (steps < fewest_bdf_steps || steps > most_bdf_steps) {
        throw std::out_of_range("expected a formula of 2 to 4 steps, found " + std::to_string(steps));
    }
    return formulas[steps - fewest_bdf_steps];
}

DoubleDouble sum(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = two_sum(a.high, b.high);
    const DoubleDouble low = two_sum(a.low, b.low);
    const DoubleDouble joined = two_sum(high.high, high.low + low.high);
    return two_sum(joined.high, joined.low + low.low);
}

DoubleDouble product(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = two_product(a.high, b.high);
    return two_sum(high.high, high.low + (a.high * b.low + a.low * b.high));
}

DoubleDouble quotient(const DoubleDouble& a, double divisor) {
    const double first = a.high / divisor;
    const DoubleDouble back = two_product(first, divisor);
    return two_sum(first, ((a.high - back.high) - back.low + a.low) / divisor);
}

// How many weights of a whole order v >= 0 are not zero by themselves, as rounding would hide; else no limit.
std::size_t count_of_nonzero(unsigned steps, double order, std::size_t count) {
    const bool ends = order >= 0.0 && std::floor(order) == order;
    return ends ? std::min(count, steps * static_cast<std::size_t>(order) + 1) : count;
}

std::vector<DoubleDouble> walk(unsigned steps, double order, std::size_t count) {
    const Formula& formula = formula_of(steps);
    std::vector<DoubleDouble> a(count, DoubleDouble{0.0, 0.0});
    for (std::size_t n = 0; n < count_of_nonzero(steps, order, count); ++n) {
        if (n == 0) {
            a[0] = {1.0, 0.0};
            continue;
        }
        DoubleDouble total{0.0, 0.0};
        for (std::size_t m = std::min<std::size_t>(steps, n); m > 0; --m) {
            const DoubleDouble factor =
                sum(two_product(order, static_cast<double>(m)), {-static_cast<double>(n - m), 0.0});
            total = sum(total, product(factor, product({formula.coefficients[m], 0.0}, a[n - m])));
        }
        a[n] = quotient(total, static_cast<double>(n) * formula.coefficients[0]);
    }
    return a;
}

}  // namespace

double bdf_first_weight(unsigned steps, double order) {
    const Formula& formula = formula_of(steps);
    return std::pow(formula.coefficients[0] / formula.divisor, order);
}

std::vector<double> bdf_weights(unsigned steps, double order, std::size_t count) {
    std::vector<double> weights;
    weights.reserve(count);
    for (const DoubleDouble& weight : walk(steps, order, count)) {
        weights.push_back(weight.high);
    }
    return weights;
}

std::vector<double> bdf_increment_weights(unsigned steps, double order, std::size_t count) {
    // P(1) = 0: behind the last weight of a whole order v > 0 the sums are 0.
    const bool ends = order > 0.0 && std::floor(order) == order;
    const std::size_t last = ends ? steps * static_cast<std::size_t>(order) : count;
    std::vector<double> weights;
    weights.reserve(count);
    DoubleDouble running{0.0, 0.0};
    for (const DoubleDouble& weight : walk(steps, order, count)) {
        running = sum(running, weight);
        weights.push_back(weights.size() < last || weights.empty() ? running.high : 0.0);
    }
    return weights;
}

}  // namespace glsum::design
