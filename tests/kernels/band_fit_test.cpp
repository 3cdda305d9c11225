// The fit of a filter, step by step: what its least squares are of, where its poles may lie, whose weights grow, and
// where Newton's steps end.
#include "glsum/design/band_fit_body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <tuple>
#include <vector>

namespace {

using namespace glsum::design;

const std::vector<FilterKind> kinds{FilterKind::samples, FilterKind::integrator, FilterKind::increments};

// A band and a step, of a derivative or an integral.
DerivativeGoal goal_of(FilterKind kind) {
    return {.order = kind == FilterKind::integrator ? -0.5 : 0.4,
            .step_s = 0.001,
            .band = Band{1.0, 200.0},
            .step_until_s = 0.5};
}

Vector logs(const std::vector<double>& decays) {
    Vector all(static_cast<Eigen::Index>(decays.size()));
    for (Eigen::Index m = 0; m < all.size(); ++m) {
        all(m) = std::log(decays[static_cast<std::size_t>(m)]);
    }
    return all;
}

// Relative errors at the points: a complex number for each frequency, a real one for each sample of the step.
std::vector<std::complex<double>> errors_of(const Filter& filter, const DerivativeGoal& goal, FilterKind kind) {
    const Filter whole = kind == FilterKind::increments ? of_samples(filter) : filter;
    std::vector<std::complex<double>> errors;
    for (const double hz : frequencies_of(goal)) {
        errors.push_back(frequency_response(whole, 2.0 * std::numbers::pi * hz * goal.step_s) /
                             exact_response(goal.order, hz) -
                         1.0);
    }
    for (const std::size_t k : samples_of(goal)) {
        errors.push_back(step_response(whole, k) / exact_step(goal.order, static_cast<double>(k) * goal.step_s) - 1.0);
    }
    return errors;
}

// What one of its coefficients, taps and then modes, adds to them.
std::vector<std::complex<double>> added_by(std::size_t coefficient, Filter filter, const DerivativeGoal& goal,
                                           FilterKind kind) {
    for (std::size_t j = 0; j < filter.taps.size() + filter.modes.size(); ++j) {
        double& here = j < filter.taps.size() ? filter.taps[j] : filter.modes[j - filter.taps.size()].weight;
        here = j == coefficient ? 1.0 : 0.0;
    }
    std::vector<std::complex<double>> errors = errors_of(filter, goal, kind);
    for (std::complex<double>& error : errors) {
        error += 1.0;
    }
    return errors;
}

double product(const std::vector<std::complex<double>>& a, const std::vector<std::complex<double>>& b,
               const std::vector<double>& weights) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += weights[i] * (std::conj(a[i]) * b[i]).real();
    }
    return sum;
}

// Of least squares the gradient is 0 along each coefficient; each costs its own size, in units of its column's, times
// the ridge.
void expect_least_squares(const Fit& fit, const DerivativeGoal& goal, FilterKind kind,
                          const std::vector<double>& weights, double ridge = 0.0) {
    const Filter filter = fit.filter();
    const auto errors = errors_of(filter, goal, kind);
    const std::vector<double> ones(errors.size(), 1.0);
    for (std::size_t j = 0; j < filter.taps.size() + filter.modes.size(); ++j) {
        const auto column = added_by(j, filter, goal, kind);
        const double coefficient =
            j < filter.taps.size() ? filter.taps[j] : filter.modes[j - filter.taps.size()].weight;
        const double norm = std::sqrt(product(column, column, ones));
        const double gradient = product(column, errors, weights) + ridge * ridge * norm * norm * coefficient;
        EXPECT_NEAR(gradient, 0.0, 1e-8 * norm * std::sqrt(product(errors, errors, ones))) << j;
    }
}

std::vector<double> sizes_of(const Fit& fit, const DerivativeGoal& goal, FilterKind kind) {
    std::vector<double> sizes;
    for (const std::complex<double>& error : errors_of(fit.filter(), goal, kind)) {
        sizes.push_back(std::abs(error));
    }
    return sizes;
}

TEST(BandFit, IsTheLeastSquaresOfItsPoles) {
    for (const FilterKind kind : kinds) {
        const DerivativeGoal goal = goal_of(kind);
        for (const double ridge : {0.0, 0.01}) {
            Fit fit(goal, 2, kind, 0.0, ridge);
            fit.set(logs({0.02, 0.3}));
            const Filter filter = fit.filter();
            ASSERT_EQ(filter.taps.size(), 2U);
            ASSERT_EQ(filter.modes.size(), kind == FilterKind::integrator ? 3U : 2U);
            if (kind == FilterKind::integrator) {
                EXPECT_EQ(filter.modes.front().decay, 0.0);
            }
            EXPECT_DOUBLE_EQ(filter.modes.back().decay, 0.3);
            const std::vector<double> sizes = sizes_of(fit, goal, kind);
            EXPECT_NEAR(fit.error(), *std::max_element(sizes.begin(), sizes.end()), 1e-9);
            expect_least_squares(fit, goal, kind, std::vector<double>(sizes.size(), 1.0), ridge);
        }
    }
}

// Rising, three tenths of a logarithm apart, at most 0.95; none so slow that the horizon shows a millionth of it.
TEST(BandFit, KeepsItsPolesApart) {
    const DerivativeGoal goal = goal_of(FilterKind::samples);
    const auto set = [&](const Vector& log_decays, double swing = 0.0) {
        Fit fit(goal, 1, FilterKind::samples, swing, 0.0);
        fit.set(log_decays);
        return fit.log_decays();
    };
    const auto expect = [](const Vector& found, const std::vector<double>& wanted) {
        ASSERT_EQ(found.size(), static_cast<Eigen::Index>(wanted.size()));
        for (Eigen::Index m = 0; m < found.size(); ++m) {
            EXPECT_NEAR(found(m), wanted[static_cast<std::size_t>(m)], 1e-12) << m;
        }
    };
    const double top = std::log(0.95);
    const double slowest = std::log(1e-6 / static_cast<double>(goal.horizon()));
    expect(set(logs({0.9, 0.1, 0.3})), {std::log(0.1), std::log(0.3), std::log(0.9)});
    expect(set(logs({1.0, 0.9, 0.94})), {top - 0.6, top - 0.3, top});
    expect(set(logs({0.1, 0.29, 0.3})), {std::log(0.1), std::log(0.3) - 0.3, std::log(0.3)});
    expect(set(Vector::Constant(3, -100.0)), {slowest, slowest + 0.3, slowest + 0.6});
    // One that swings stays the last, wherever it is: half of the way at 0.
    Vector swinging = logs({0.9, 0.1, 1.0});
    expect(set(swinging, 0.6), {std::log(0.1), std::log(0.9), 0.0});
    Fit fit(goal, 1, FilterKind::samples, 0.6, 0.0);
    fit.set(swinging);
    EXPECT_DOUBLE_EQ(fit.filter().modes.back().decay, 1.3);
    swinging(2) = std::log(2.0);  // two thirds
    fit.set(swinging);
    EXPECT_DOUBLE_EQ(fit.filter().modes.back().decay, 1.4);
}

// A point's weight is multiplied by its error over the mean one, from a fifth to five times; then the fit is the least
// squares of these [Lawson1961].
TEST(BandFit, WeighsPointsByTheirErrors) {
    bool some_are_met = false;
    bool some_are_far = false;
    // Up to half the sample's rate, where no sum follows, a few points are far off.
    const DerivativeGoal to_the_end{.order = 0.4, .step_s = 0.001, .band = Band{1.0, 499.9}};
    for (const auto& [kind, goal, begin] :
         {std::tuple(FilterKind::samples, goal_of(FilterKind::samples), logs({0.02, 0.9})),
          std::tuple(FilterKind::integrator, goal_of(FilterKind::integrator), logs({0.02, 0.9})),
          std::tuple(FilterKind::increments, goal_of(FilterKind::increments), logs({0.02, 0.9})),
          std::tuple(FilterKind::samples, to_the_end, logs({0.02, 0.3}))}) {
        Fit fit(goal, 2, kind, 0.0, 0.0);
        fit.set(begin);
        std::vector<double> weights(frequencies_of(goal).size() + samples_of(goal).size(), 1.0);
        for (int round = 0; round < 4; ++round) {
            const std::vector<double> sizes = sizes_of(fit, goal, kind);
            double sum = 0.0;
            double mean = 0.0;
            for (std::size_t i = 0; i < sizes.size(); ++i) {
                sum += weights[i];
                mean += weights[i] * sizes[i];
            }
            mean /= sum;
            for (std::size_t i = 0; i < sizes.size(); ++i) {
                some_are_met = some_are_met || sizes[i] < 0.19 * mean;
                some_are_far = some_are_far || sizes[i] > 5.1 * mean;
                weights[i] *= std::clamp(sizes[i] / mean, 0.2, 5.0);
            }
            fit.improve(false);
            EXPECT_NEAR(fit.log_decays()(0), std::log(0.02), 1e-12);  // poles stay
            expect_least_squares(fit, goal, kind, weights);
            const std::vector<double> now = sizes_of(fit, goal, kind);
            EXPECT_NEAR(fit.error(), *std::max_element(now.begin(), now.end()), 1e-9);
        }
    }
    EXPECT_TRUE(some_are_met);
    EXPECT_TRUE(some_are_far);
}

// The first step of the poles is Levenberg and Marquardt's, damped by a hundredth, of what their own least squares
// leave [GolubPereyra1973].
TEST(BandFit, MovesItsPolesByGaussNewtonSteps) {
    const FilterKind kind = FilterKind::samples;
    const DerivativeGoal goal = goal_of(kind);
    const auto left = [&](const Vector& log_decays) {
        Fit fit(goal, 1, kind, 0.0, 0.0);
        fit.set(log_decays);
        const auto errors = errors_of(fit.filter(), goal, kind);
        Vector all(2 * static_cast<Eigen::Index>(errors.size()));
        for (std::size_t i = 0; i < errors.size(); ++i) {
            all(2 * static_cast<Eigen::Index>(i)) = errors[i].real();
            all(2 * static_cast<Eigen::Index>(i) + 1) = errors[i].imag();
        }
        return all;
    };
    const Vector begin = logs({0.01, 0.1, 0.4});
    Fit fit(goal, 1, kind, 0.0, 0.0);
    fit.set(begin);
    fit.improve(true);
    const Vector now = left(begin);
    Matrix slopes(now.size(), begin.size());
    for (Eigen::Index m = 0; m < begin.size(); ++m) {
        Vector above = begin;
        Vector below = begin;
        above(m) += 1e-4;
        below(m) -= 1e-4;
        slopes.col(m) = (left(above) - left(below)) / 2e-4;
    }
    const Matrix normal = slopes.transpose() * slopes;
    const Matrix damped = normal + 0.01 * Matrix(normal.diagonal().asDiagonal());
    const Vector step = damped.ldlt().solve(slopes.transpose() * now);
    ASSERT_LT(step.cwiseAbs().maxCoeff(), 1.0);
    EXPECT_LT(left(fit.log_decays()).squaredNorm(), 0.9 * now.squaredNorm());
    for (Eigen::Index m = 0; m < begin.size(); ++m) {
        EXPECT_NEAR(fit.log_decays()(m), begin(m) - step(m), 2e-3 * step.cwiseAbs().maxCoeff()) << m;
    }
}

// From far below, where a step would lead beyond all bounds, a pole moves by a factor of e at once, and not more.
TEST(BandFit, MovesAPoleByOneLogarithmAtMost) {
    const DerivativeGoal goal{.order = 0.4, .step_s = 0.001, .band = Band{1.0, 200.0}};
    Fit fit(goal, 1, FilterKind::samples, 0.0, 0.0);
    fit.set(logs({1e-4}));
    for (int round = 1; round <= 2; ++round) {
        fit.improve(true);
        EXPECT_NEAR(fit.log_decays()(0), std::log(1e-4) + round, 1e-9);
    }
}

// Newton's steps of all unknowns end where the sum of a power of the errors is least, of coefficients and poles: in a
// few steps, as their number of digits doubles.
TEST(BandFit, SharpensToTheLeastSumOfAPower) {
    for (const auto& [kind, p] : {std::pair(FilterKind::samples, 2.0), std::pair(FilterKind::samples, 4.0),
                                  std::pair(FilterKind::integrator, 4.0), std::pair(FilterKind::increments, 4.0)}) {
        DerivativeGoal goal = goal_of(kind);
        goal.step_until_s.reset();
        Fit fit(goal, 1, kind, 0.0, 0.0);
        fit.set(logs({0.02, 0.3}));
        for (int round = 0; round < 10; ++round) {
            fit.improve(true);
        }
        for (int step = 0; step < 12; ++step) {
            fit.sharpen(p);
        }
        const Filter filter = fit.filter();
        const auto power_of = [&](const Filter& of) {
            double sum = 0.0;
            for (const std::complex<double>& error : errors_of(of, goal, kind)) {
                sum += std::pow(std::abs(error) / fit.error(), 2.0 * p);
            }
            return sum;
        };
        const double least = power_of(filter);
        const auto slope = [&](const std::function<void(Filter&, double)>& move) {
            Filter above = filter;
            Filter below = filter;
            move(above, 1e-6);
            move(below, -1e-6);
            return (power_of(above) - power_of(below)) / 2e-6 / least;
        };
        for (std::size_t j = 0; j < filter.taps.size(); ++j) {
            EXPECT_NEAR(slope([&](Filter& of, double by) { of.taps[j] *= 1.0 + by; }), 0.0, 2e-3) << j;
        }
        for (std::size_t m = 0; m < filter.modes.size(); ++m) {
            EXPECT_NEAR(slope([&](Filter& of, double by) { of.modes[m].weight *= 1.0 + by; }), 0.0, 2e-3) << m;
            if (filter.modes[m].decay > 0.0) {
                EXPECT_NEAR(slope([&](Filter& of, double by) { of.modes[m].decay *= 1.0 + by; }), 0.0, 2e-3) << m;
            }
        }
    }
}

}  // namespace
