// Filters fitted to a derivative: what they keep, and that rules of others with as many coefficients do not come near.
#include "glsum/design/band.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "glsum/design/modes.hpp"

namespace {

using namespace glsum::design;

DerivativeGoal goal_of(double order, double low_hz, double high_hz, double step_until_s) {
    DerivativeGoal goal{order, 0.001, Band{low_hz, high_hz}};
    if (step_until_s > 0.0) {
        goal.step_until_s = step_until_s;
    }
    return goal;
}

// Oustaloup's filter [Oustaloup2000], its poles and zeros mapped by e^(-w h), the gain set at the middle of its band;
// the best of a grid of bands. (The same number of coefficients as 1 + P modes: 2 P + 1.)
double tuned_oustaloup(const DerivativeGoal& goal, int poles) {
    double best = INFINITY;
    for (double low = goal.band->low_hz / 30.0; low < goal.band->low_hz * 2.0; low *= 1.25) {
        for (double high = goal.band->high_hz / 3.0; high < 500.0; high *= 1.1) {
            const double ratio = high / low;
            double error = 0.0;
            const auto response = [&](double hz) {
                std::complex<double> product = 1.0;
                const auto delay = std::polar(1.0, -2.0 * std::numbers::pi * hz * goal.step_s);
                for (int k = 0; k < poles; ++k) {
                    const auto at = [&](double sign) {
                        const double here = low * std::pow(ratio, (k + 0.5 + sign * 0.5 * goal.order) / poles);
                        return 1.0 - std::exp(-2.0 * std::numbers::pi * here * goal.step_s) * delay;
                    };
                    product *= at(-1.0) / at(1.0);
                }
                return product;
            };
            const double middle = std::sqrt(low * high);
            const double gain = std::abs(exact_response(goal.order, middle)) / std::abs(response(middle));
            for (const double hz : frequencies_of(goal)) {
                error = std::max(error, std::abs(gain * response(hz) / exact_response(goal.order, hz) - 1.0));
            }
            best = std::min(best, error);
        }
    }
    return best;
}

TEST(FittedFilter, ErrsLessThanTunedOustaloupWithAsManyCoefficients) {
    std::vector<double> ratios;
    for (const double order : {0.2, 0.5, 0.9}) {
        for (const double low_hz : {8.0, 0.8, 0.08}) {
            for (const std::size_t poles : {3U, 5U}) {
                const DerivativeGoal goal = goal_of(order, low_hz, 80.0, 0.0);
                ratios.push_back(tuned_oustaloup(goal, static_cast<int>(poles)) /
                                 fit_filter(goal, 1, poles, FilterKind::samples).error.band);
            }
        }
    }
    std::sort(ratios.begin(), ratios.end());
    EXPECT_GT(ratios.front(), 1.0);
    EXPECT_GT(ratios[ratios.size() / 2], 3.0);
}

// Of v towards 1 Tustin's mapping of Oustaloup's filter has negative poles, and errs less than any with decaying ones.
TEST(FittedFilter, OnePoleThatSwingsIsWorthSeveral) {
    for (const double low_hz : {8.0, 0.8}) {
        const DerivativeGoal goal = goal_of(0.9, low_hz, 80.0, 0.0);
        double before = INFINITY;
        for (const std::size_t modes : {1U, 2U, 3U, 4U}) {
            const FittedFilter swinging = fit_filter(goal, 1, modes, FilterKind::samples, Poles::one_may_swing);
            const FittedFilter decaying = fit_filter(goal, 1, modes, FilterKind::samples);
            EXPECT_LT(swinging.error.band, 0.999 * before) << low_hz << " " << modes;
            EXPECT_LE(swinging.error.band, decaying.error.band) << low_hz << " " << modes;
            before = swinging.error.band;
            for (std::size_t m = 0; m < modes; ++m) {
                EXPECT_LE(decaying.modes[m].decay, 1.0);
                EXPECT_LT(swinging.modes[m].decay, m + 1 < modes ? 1.0 : 1.9) << low_hz << " " << modes;
            }
            if (modes == 2 || modes == 3) {
                EXPECT_LT(swinging.error.band, decaying.error.band / 2.0) << low_hz << " " << modes;
            }
        }
    }
}

// A pole lies at most 0.9 beyond 0; where coefficients would be too large, 0.75, 0.6 or 0.4. These end there.
TEST(FittedFilter, APoleSwingsAsFarAsCoefficientsStaySmall) {
    const struct {
        double order, low_hz;
        FilterKind kind;
        std::size_t near_taps;
        double swing;
    } ends[] = {{-0.9, 1.0, FilterKind::samples, 1, 0.9},
                {0.7, 10.0, FilterKind::samples, 2, 0.75},
                {-0.5, 50.0, FilterKind::samples, 2, 0.6},
                {0.7, 50.0, FilterKind::increments, 1, 0.4}};
    for (const auto& end : ends) {
        const FittedFilter found =
            fit_filter(goal_of(end.order, end.low_hz, 400.0, 0.0), end.near_taps, 3, end.kind, Poles::one_swings);
        EXPECT_NEAR(found.modes.back().decay, 1.0 + end.swing, 1e-5) << end.order << " " << end.low_hz;
        EXPECT_LE(found.amplification, 8.0) << end.order << " " << end.low_hz;
    }
}

TEST(FittedFilter, WhatAmplifiesTooMuchIsNotTheBetterOne) {
    FittedFilter calm{1.0, {}, {}, {0.1, 1.0, 0.0, 0.0}, FilterKind::samples, 2.0};
    FittedFilter loud{1.0, {}, {}, {0.01, 1.0, 0.0, 0.0}, FilterKind::samples, 9.0};
    EXPECT_EQ(&better_of(calm, loud), &calm);
    loud.amplification = 7.0;
    EXPECT_EQ(&better_of(calm, loud), &loud);
    EXPECT_EQ(&better_of(loud, calm), &loud);
    const FittedFilter fitted = fit_filter(goal_of(0.5, 0.8, 80.0, 0.0), 1, 4, FilterKind::samples);
    EXPECT_GT(fitted.amplification, 0.5);
    EXPECT_LE(fitted.amplification, 8.0);
}

// Of one mode, too, the pole may swing: near order 1, up to 80 Hz at 1 kHz, it halves the error and more.
// What has no pole to move, a window or a running sum alone, is fitted as it is.
TEST(FittedFilter, TheOnlyPoleMaySwingAndNoneNeedBeThere) {
    const DerivativeGoal steep = goal_of(0.95, 8.0, 80.0, 0.0);
    const FittedFilter swinging = fit_filter(steep, 1, 1, FilterKind::samples, Poles::one_may_swing);
    ASSERT_EQ(swinging.modes.size(), 1U);
    EXPECT_GT(swinging.modes[0].decay, 1.0);
    EXPECT_LT(swinging.error.band, 0.5 * fit_filter(steep, 1, 1, FilterKind::samples).error.band);
    const DerivativeGoal goal = goal_of(-0.5, 10.0, 100.0, 0.0);
    for (const auto& [kind, modes] : {std::pair(FilterKind::samples, 0U), std::pair(FilterKind::integrator, 1U)}) {
        const FittedFilter found = fit_filter(goal, 3, modes, kind, Poles::one_may_swing);
        ASSERT_EQ(found.modes.size(), modes);
        EXPECT_EQ(found.error.band, fit_filter(goal, 3, modes, kind).error.band);
        EXPECT_TRUE(modes == 0 || found.modes[0].decay == 0.0);
    }
}

// Eight times the magnitudes of the order's own weights are the most.
TEST(FittedFilter, EightTimesTheOwnWeightsAreTooMuch) {
    const FittedFilter calm{1.0, {}, {}, {0.1, 1.0, 0.0, 0.0}, FilterKind::samples, 2.0};
    FittedFilter loud{1.0, {}, {}, {0.01, 1.0, 0.0, 0.0}, FilterKind::samples, 8.04};
    EXPECT_EQ(&better_of(calm, loud), &calm);
    loud.amplification = 7.96;
    EXPECT_EQ(&better_of(calm, loud), &loud);
}

// What rounding is multiplied by: the magnitudes of all coefficients over those of the order's own weights. A mode's
// counts by its average's range, w/(1 - |1 - d|), a running sum's as it is.
TEST(FittedFilter, ItsAmplificationIsThatOfItsCoefficients) {
    const struct {
        FilterKind kind;
        double order, of_weights;  // of the derivative, and of what the weights sum
        Poles poles;
    } known[] = {{FilterKind::samples, 0.5, 0.5, Poles::decaying},
                 {FilterKind::samples, 0.9, 0.9, Poles::one_swings},
                 {FilterKind::increments, 0.5, -0.5, Poles::decaying},
                 {FilterKind::integrator, -0.5, -0.5, Poles::decaying}};
    for (const auto& one : known) {
        const DerivativeGoal goal = goal_of(one.order, 8.0, 80.0, 0.0);
        const FittedFilter fitted = fit_filter(goal, 2, 2, one.kind, one.poles);
        double sum = 1.0;
        for (const double weight : fitted.weights) {
            sum += std::fabs(weight);
        }
        for (const Mode& mode : fitted.modes) {
            sum += std::fabs(mode.weight) / (mode.decay == 0.0 ? 1.0 : 1.0 - std::fabs(1.0 - mode.decay));
        }
        double own = 1.0;
        double weight = 1.0;
        for (std::size_t j = 1; j <= goal.horizon(); ++j) {
            weight *= 1.0 - (one.of_weights + 1.0) / static_cast<double>(j);
            own += std::fabs(weight);
        }
        EXPECT_NEAR(fitted.amplification * own / sum, 1.0, 1e-9) << one.order << " " << static_cast<int>(one.kind);
    }
}

TEST(DesignedFilter, IsTheShortestOfWhatKeepsTheError) {
    // As the header's example asks.
    const DerivativeGoal goal{.order = 0.5, .step_s = 1e-3, .band = Band{0.05, 80}, .step_until_s = 60};
    const auto found = design_filter(goal, 0.05);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->length(), 1 + found->weights.size() + 2 * found->modes.size());
    EXPECT_LE(certified_error(found->filter(), goal).largest(), 0.05);
    const std::size_t shorter = found->length() - 1;
    const std::size_t near_taps = shorter % 2 == 1 ? 1 : 2;
    const FittedFilter before = fit_filter(goal, near_taps, (shorter - near_taps) / 2, FilterKind::samples);
    EXPECT_GT(certified_error(before.filter(), goal).largest(), 0.05);
    EXPECT_FALSE(design_filter(goal, 1e-9));
    const auto integral = design_filter(goal_of(-0.5, 0.5, 80.0, 0.0), 0.05, FilterKind::integrator);
    ASSERT_TRUE(integral);
    EXPECT_EQ(integral->modes.front().decay, 0.0);
}

TEST(FittedFilter, IsWhatItsErrorSays) {
    const DerivativeGoal goal = goal_of(0.5, 0.05, 80.0, 60.0);
    const FittedFilter fitted = fit_filter(goal, 1, 5, FilterKind::samples);
    EXPECT_LT(fitted.error.largest(), 0.05);
    EXPECT_EQ(error_at_points(fitted.filter(), goal).largest(), fitted.error.largest());
    EXPECT_EQ(fitted.weights.size(), 0U);
    EXPECT_EQ(fitted.modes.size(), 5U);
    EXPECT_GT(fitted.factor, 0.0);
    double before = 0.0;
    for (const Mode& mode : fitted.modes) {
        EXPECT_GT(mode.decay, before);
        EXPECT_LE(mode.decay, 0.951);
        before = mode.decay;
    }
    // The sum's own modes, as many of them, are far from the derivative over a minute.
    const Approximation own = approximate({0.5, goal.horizon()}, 1, 5);
    Filter of_sum{{std::pow(0.001, -0.5)}, own.modes};
    for (Mode& mode : of_sum.modes) {
        mode.weight *= std::pow(0.001, -0.5);
    }
    EXPECT_GT(error_at_points(of_sum, goal).largest(), 10.0 * fitted.error.largest());
}

TEST(FittedFilter, AnIntegratorsSlowestModeDoesNotDecay) {
    const DerivativeGoal goal = goal_of(-0.5, 0.05, 80.0, 60.0);
    const FittedFilter fitted = fit_filter(goal, 1, 6, FilterKind::integrator);
    EXPECT_EQ(fitted.modes.front().decay, 0.0);
    EXPECT_GT(fitted.modes[1].decay, 0.0);
    EXPECT_LT(fitted.error.largest(), 0.03);
}

TEST(FittedFilter, OfIncrementsLeavesNothingOfALevel) {
    const DerivativeGoal goal = goal_of(0.5, 0.5, 80.0, 0.0);
    const FittedFilter fitted = fit_filter(goal, 2, 4, FilterKind::increments);
    EXPECT_LT(fitted.error.band, 0.02);
    EXPECT_NEAR(error_at_points(fitted.filter(), goal).band, fitted.error.band, 1e-12);
    EXPECT_LT(std::fabs(step_response(fitted.filter(), 10'000'000)), 1e-9);
    EXPECT_GT(std::fabs(step_response(fit_filter(goal, 2, 4, FilterKind::samples).filter(), 10'000'000)), 1e-3);
}

TEST(FittedFilter, ATapThatNoPointShowsIsTheOrdersOwn) {
    // Of increments behind a step a tap shows at its own sample alone, and the first ten samples do not count.
    DerivativeGoal goal{0.5, 0.001};
    goal.step_until_s = 2.0;
    const FittedFilter fitted = fit_filter(goal, 3, 4, FilterKind::increments);
    EXPECT_DOUBLE_EQ(fitted.factor, std::sqrt(1000.0));
    EXPECT_DOUBLE_EQ(fitted.weights[0], 0.5);
    EXPECT_DOUBLE_EQ(fitted.weights[1], 0.375);
    EXPECT_LT(fitted.error.step, 0.05);
}

TEST(FittedFilter, OfAWholeOrderIsItsFirstOrderDifferenceOrBetter) {
    const FittedFilter fitted = fit_filter(goal_of(1.0, 0.1, 50.0, 0.0), 2, 0, FilterKind::samples);
    const DerivativeError plain = error_at_points({{1000.0, -1000.0}, {}}, goal_of(1.0, 0.1, 50.0, 0.0));
    EXPECT_LE(fitted.error.band, plain.band);
    EXPECT_EQ(fitted.weights.size(), 1U);
}

TEST(FittedFilter, AWindowIsFittedToo) {
    const DerivativeGoal goal = goal_of(0.5, 10.0, 100.0, 0.0);
    EXPECT_LT(fit_filter(goal, 24, 0, FilterKind::samples).error.band, 0.05);
}

TEST(FittedFilter, LargerOnesDoNotErrMore) {
    const DerivativeGoal goal = goal_of(0.5, 0.5, 100.0, 0.0);
    double before = INFINITY;
    for (const std::size_t modes : {1U, 2U, 3U, 4U, 5U}) {
        const double error = fit_filter(goal, 2, modes, FilterKind::samples).error.largest();
        EXPECT_LT(error, before) << modes;
        before = error;
    }
    // Four poles of these crowd at the fast end; from poles spread evenly the search stops at 1 %.
    EXPECT_LT(fit_filter(goal_of(0.5, 0.8, 80.0, 0.0), 1, 6, FilterKind::samples).error.band, 0.005);
}

TEST(FittedFilter, IsTheSameEachTime) {
    const DerivativeGoal goal = goal_of(0.9, 1.0, 100.0, 0.0);
    const FittedFilter one = fit_filter(goal, 2, 3, FilterKind::samples);
    const FittedFilter other = fit_filter(goal, 2, 3, FilterKind::samples);
    EXPECT_EQ(one.factor, other.factor);
    for (std::size_t m = 0; m < one.modes.size(); ++m) {
        EXPECT_EQ(one.modes[m].decay, other.modes[m].decay);
        EXPECT_EQ(one.modes[m].weight, other.modes[m].weight);
    }
}

TEST(FittedFilter, AtTheEndTheLargestErrorIsTheLeast) {
    // Weights that follow the error come to 0.06626 in sixty rounds, Oustaloup's two poles, tuned, to 0.06620.
    EXPECT_LT(fit_filter(goal_of(0.2, 0.8, 80.0, 0.0), 1, 2, FilterKind::samples).error.band, 0.06618);
    // Powers to 4096 come within a part in ten thousand of the least, which ever higher ones tend to.
    EXPECT_NEAR(fit_filter(goal_of(0.9, 0.8, 80.0, 0.0), 1, 2, FilterKind::samples).error.band, 0.135381, 1.35e-5);
}

// A near tap more contains the filter without it. From a start in the middle the search for one pole finds so much;
// from the fast end it stops at 0.392 of an integral of half an order, where without that tap 0.389 are reached.
TEST(FittedFilter, ANearTapBesideOnePoleDoesNotErrMore) {
    const auto error = [](const DerivativeGoal& goal, std::size_t near_taps) {
        return fit_filter(goal, near_taps, 1, FilterKind::samples, Poles::decaying).error.largest();
    };
    for (const DerivativeGoal& goal :
         {goal_of(-0.5, 1.0, 50.0, 0.0), goal_of(-0.5, 1.0, 150.0, 0.0), goal_of(0.2, 1.0, 50.0, 0.0),
          goal_of(0.5, 0.1, 50.0, 0.0), goal_of(0.5, 1.0, 150.0, 0.0), goal_of(0.9, 10.0, 400.0, 0.0)}) {
        EXPECT_LT(error(goal, 2), error(goal, 1)) << goal.order << " " << goal.band->low_hz;
    }
}

}  // namespace
