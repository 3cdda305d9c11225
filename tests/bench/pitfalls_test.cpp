// Faults that published codes have. Each is written out here and is wrong by far where our reference is right.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bench/sweep/host_line.hpp"
#include "glsum/registry.hpp"
#include "glsum/weights.hpp"
#include "reference/derivatives.hpp"
#include "reference/sums.hpp"
#include "tests/bench/closed_forms.hpp"
#include "tests/bench/digits.hpp"

namespace {

using reference::Real;

Real sum_at(std::span<const Real> a, const std::vector<double>& x, std::size_t k) {
    const std::size_t lengths[] = {x.size()};
    const reference::Exact exact = reference::sums(a, x, lengths).front()[k];
    return Real(exact.high) + Real(exact.low);
}

// 512 ones on [0, 1], order 0.5: a product of transforms without padding wraps the record around, so that every sample
// gets what only the last one should.
TEST(Pitfalls, CircularConvolutionIsRightAtTheLastSampleOnly) {
    constexpr std::size_t samples = 512;
    const std::vector<double> x(samples, 1.0);
    const Real v("0.5");
    const auto a = reference::weights(v, samples);
    const auto circular = [&](std::size_t k) {
        Real total = 0;
        for (std::size_t j = 0; j < samples; ++j) {
            total += a[j] * x[(k + samples - j) % samples];
        }
        return total;
    };
    const Real scale = pow(Real(samples - 1), v);  // h^-v
    digits::expect_printed(circular(10) * scale, "0.564", 0.5);
    digits::expect_printed(sum_at(a, x, 10) * scale, "3.983", 0.5);
    digits::expect_thirty(sum_at(a, x, 10), closed_form::of_step(v, 10), "sum at 10");
    digits::expect_thirty(circular(samples - 1), sum_at(a, x, samples - 1), "last sample");
}

// The Horner form that stops at c_(k-1) loses a_k x_0.
TEST(Pitfalls, DroppingTheOldestSampleIsAnError) {
    const std::vector<double> x(101, 1.0);
    for (const char* order : {"0.5", "0.98319", "-0.5"}) {
        const Real v(order);
        const auto a = reference::weights(v, x.size());
        for (const unsigned k : {1U, 10U, 100U}) {
            Real nested = 0;
            for (unsigned j = k - 1; j > 0; --j) {
                nested = (1 - (1 + v) / j) * (Real(x[k - j]) + nested);
            }
            nested += x[k];
            const Real right = closed_form::of_step(v, k);
            digits::expect_thirty(sum_at(a, x, k), right, order);
            digits::expect_thirty(nested - right, -closed_form::weight(v, k), order);
            EXPECT_GT(static_cast<double>(abs(nested / right - 1)), 0.004) << order << ' ' << k;
        }
    }
}

// N samples have N - 1 intervals between them.
TEST(Pitfalls, DividingByTheSamplesInsteadOfTheIntervalsIsAnError) {
    constexpr std::size_t samples = 101;
    std::vector<double> ramp(samples);
    for (std::size_t k = 0; k < samples; ++k) {
        ramp[k] = static_cast<double>(k) / (samples - 1);
    }
    for (const char* order : {"0.5", "0.9", "1.5"}) {
        const Real v(order);
        const Real sum = sum_at(reference::weights(v, samples), ramp, samples - 1);
        const Real exact = reference::derivative_of_power(1, v, 1);
        const Real leading = -v / 2 / (samples - 1) * reference::derivative_of_power(1, v + 1, 1);
        const auto error = static_cast<double>(sum * pow(Real(samples - 1), v) - exact);
        const auto error_by_samples = static_cast<double>(sum * pow(Real(samples), v) - exact);
        EXPECT_NEAR(error / static_cast<double>(leading), 1.0, 0.03) << order;
        EXPECT_GE(std::fabs(error_by_samples), 2.0 * std::fabs(error)) << order;
    }
}

// Gamma(k + 1) leaves the range of double at k = 171; the recurrence goes on.
TEST(Pitfalls, WeightsByTheGammaFunctionEndAt170) {
    const double v = 0.5;
    const auto by_gamma = [&](unsigned k) { return std::tgamma(k - v) / (std::tgamma(-v) * std::tgamma(k + 1.0)); };
    glsum::Weights weights(v);
    while (weights.index() < 170) {
        weights.next();
    }
    EXPECT_NEAR(by_gamma(170) / weights.weight(), 1.0, 1e-12);
    weights.next();
    weights.next();
    EXPECT_FALSE(by_gamma(172) / weights.weight() > 0.5);  // 0, or not a number
    digits::expect_printed(closed_form::weight(Real(v), 600), "-1.9206126162304156e-5", 0.5);
    while (weights.index() < 600) {
        weights.next();
    }
    EXPECT_DOUBLE_EQ(weights.weight(), -1.9206126162304156e-5);
}

// The product of (x_i + c_(n-i)) has the look of the Horner form and is another number.
TEST(Pitfalls, TheProductOfFactorsIsNotTheHornerForm) {
    const std::vector<double> x{0.5, -0.25, 0.75, 0.125, -0.5};
    const double v = 0.5;
    double product = 1.0;
    for (std::size_t j = 0; j < x.size(); ++j) {
        const double factor = j == 0 ? 1.0 : (static_cast<double>(j) - 1.0 - v) / static_cast<double>(j);
        product *= x[x.size() - 1 - j] + factor;
    }
    bench::HostLine<glsum::Sum<glsum::Ring, glsum::Horner, glsum::F64>> line({v, x.size()});
    double nested = 0.0;
    for (const double sample : x) {
        nested = line.step_real(sample);
    }
    const auto right = static_cast<double>(sum_at(reference::weights(Real(v), x.size()), x, x.size() - 1));
    EXPECT_NEAR(nested, right, 1e-15);
    EXPECT_GT(std::fabs(product - right), 0.1);
}

}  // namespace
