#include "reference/bdf.hpp"

#include <algorithm>
#include <stdexcept>

#include "reference/sums.hpp"

namespace reference {
namespace {

// A quadratic factor of P: its roots are r and its conjugate.
struct RootPair {
    Real radius;
    Real angle;
};

struct Roots {
    std::vector<Real> real;
    std::vector<RootPair> pairs;
};

// The roots z = 1 - u of u^2 a + u b + c, which are no real ones.
RootPair pair_of(const Real& a, const Real& b, const Real& c) {
    const Real real = 1 + b / (2 * a);
    const Real imaginary = sqrt(4 * a * c - b * b) / (2 * a);
    return {sqrt(real * real + imaginary * imaginary), atan2(imaginary, real)};
}

// Of P(z) / (1 - z) = 1 + u/2 + ... + u^(p-1)/p, u = 1 - z.
Roots roots_of(unsigned steps) {
    const Real half = Real(1) / 2;
    const Real third = Real(1) / 3;
    switch (steps) {
        case 2:
            return {{Real(3)}, {}};
        case 3:
            return {{}, {pair_of(third, half, 1)}};
        case 4: {
            const Real quarter = Real(1) / 4;
            Real u = -2;  // Newton: the cubic rises throughout
            for (int i = 0; i < 12; ++i) {
                u -= (((quarter * u + third) * u + half) * u + 1) / ((3 * quarter * u + 2 * third) * u + half);
            }
            const Real middle = third + quarter * u;
            return {{1 - u}, {pair_of(quarter, middle, half + middle * u)}};
        }
        default:
            throw std::domain_error("a formula of 2 to 4 steps");
    }
}

// So many terms of a series that falls as radius^-n, or more, until nothing is left of 50 digits.
std::size_t terms_of(const Real& radius, std::size_t count) {
    const Real terms = 60 * log(Real(10)) / log(radius);
    return std::min(count, static_cast<std::size_t>(terms) + 1);
}

std::vector<Real> times(const std::vector<Real>& series, const std::vector<Real>& shorter) {
    std::vector<Real> all(series.size(), Real(0));
    for (std::size_t n = 0; n < all.size(); ++n) {
        for (std::size_t k = 0; k < std::min(n + 1, shorter.size()); ++k) {
            all[n] += shorter[k] * series[n - k];
        }
    }
    return all;
}

// (1 - z)^(first_order) times the other factors to the power `order`.
std::vector<Real> product(unsigned steps, const Real& first_order, const Real& order, std::size_t count) {
    free_constants_with_thread();
    std::vector<Real> all = weights(first_order, count);
    const Roots roots = roots_of(steps);
    for (const Real& root : roots.real) {
        std::vector<Real> of_root = weights(order, terms_of(root, count));
        Real power = 1;
        for (Real& term : of_root) {
            term *= power;
            power /= root;
        }
        all = times(all, of_root);
    }
    for (const RootPair& pair : roots.pairs) {
        const std::size_t terms = terms_of(pair.radius, count);
        const std::vector<Real> a = weights(order, terms);
        std::vector<Real> of_pair;
        Real power = 1;
        for (std::size_t n = 0; n < terms; ++n, power /= pair.radius) {
            Real sum = 0;
            for (std::size_t k = 0; k <= n; ++k) {
                sum += a[k] * a[n - k] * cos((Real(n) - 2 * Real(k)) * pair.angle);
            }
            of_pair.push_back(power * sum);
        }
        all = times(all, of_pair);
    }
    return all;
}

}  // namespace

Real bdf_first_weight(unsigned steps, const Real& order) {
    free_constants_with_thread();
    Real first = 0;
    for (unsigned i = 1; i <= steps; ++i) {
        first += Real(1) / i;
    }
    return pow(first, order);
}

std::vector<Real> bdf_weights(unsigned steps, const Real& order, std::size_t count) {
    return product(steps, order, order, count);
}

std::vector<Real> bdf_increment_weights(unsigned steps, const Real& order, std::size_t count) {
    return product(steps, order - 1, order, count);
}

}  // namespace reference
