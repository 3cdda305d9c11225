// Oustaloup's and Charef's filters: roots by their rules, mappings by closed forms, tuned no worse than by hand.
#include "glsum/design/rational.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace {

using glsum::design::Mapping;
using glsum::design::RationalRule;
using glsum::design::response_of;
using glsum::design::Roots;
using glsum::design::roots_of;

TEST(RationalFilter, RootsAreEvenInTheLogarithm) {
    // Of s^0.5 over a decade with one pole: zero at 10^0.25, pole at 10^0.75.
    const Roots one = roots_of(RationalRule::oustaloup, 0.5, 1, {1.0, 10.0});
    ASSERT_EQ(one.zeros.size(), 1U);
    EXPECT_DOUBLE_EQ(one.zeros[0], std::pow(10.0, 0.25));
    EXPECT_DOUBLE_EQ(one.poles[0], std::pow(10.0, 0.75));
    const Roots many = roots_of(RationalRule::oustaloup, -0.3, 4, {1.0, 1e4});
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(std::log10(many.poles[k]), static_cast<double>(k) + 0.35, 1e-12) << k;
        EXPECT_NEAR(std::log10(many.zeros[k]), static_cast<double>(k) + 0.65, 1e-12) << k;
    }
    // The singularity function of an integrator ends with a pole; of a derivative it is Oustaloup's.
    EXPECT_EQ(roots_of(RationalRule::charef, -0.3, 4, {1.0, 1e4}).zeros.size(), 3U);
    EXPECT_EQ(roots_of(RationalRule::charef, 0.3, 4, {1.0, 1e4}).zeros,
              roots_of(RationalRule::oustaloup, 0.3, 4, {1.0, 1e4}).zeros);
}

TEST(RationalFilter, MappingsAreTheTextbooks) {
    // 1 / (s + 2), h = 0.1, at w h = 0.3.
    const Roots lag{{}, {2.0}};
    const double angle = 0.3;
    const std::complex<double> delay = std::polar(1.0, -angle);
    const std::complex<double> exact = 1.0 / std::complex<double>(2.0, 3.0);
    EXPECT_LT(std::abs(response_of(lag, Mapping::matched, 0.1, angle) - 1.0 / (1.0 - std::exp(-0.2) * delay)), 1e-14);
    const std::complex<double> tustin = 1.0 / (2.0 + std::complex<double>(0.0, 20.0 * std::tan(0.15)));
    EXPECT_LT(std::abs(response_of(lag, Mapping::tustin, 0.1, angle) - tustin), 1e-14);
    EXPECT_LT(std::abs(response_of(lag, Mapping::impulse_invariant, 0.1, angle) - exact), 0.02 * std::abs(exact));
    // (s + 1)/(s + 2) = 1 - 1/(s + 2), sampled.
    const std::complex<double> sampled = 1.0 - 0.1 * (1.0 / (1.0 - std::exp(-0.2) * delay) - 0.5);
    EXPECT_LT(std::abs(response_of({{1.0}, {2.0}}, Mapping::impulse_invariant, 0.1, angle) - sampled), 1e-14);
}

TEST(RationalFilter, ItsParallelFormHasItsResponse) {
    for (const RationalRule rule : {RationalRule::oustaloup, RationalRule::charef}) {
        for (const double order : {0.7, -0.7, 1.4}) {
            for (const Mapping mapping : {Mapping::matched, Mapping::tustin, Mapping::impulse_invariant}) {
                const glsum::design::DerivativeGoal goal{order, 0.001, glsum::design::Band{0.8, 80.0}, {}};
                // Its fastest pole is beyond 2/h: Tustin's mapping turns it negative.
                const glsum::design::TunedRational tuned{{5.0, 9000.0}, mapping, 3.0, 0.0};
                const auto filter = as_modes(rule, goal, 5, tuned).filter();
                const double v = order > 1.0 ? order - 1.0 : order;
                const Roots roots = roots_of(rule, v, 5, tuned.edges);
                for (const double angle : {0.005, 0.1, 0.5, 2.0, 3.0}) {
                    std::complex<double> expected = 3.0 * response_of(roots, mapping, 0.001, angle);
                    if (order > 1.0) {
                        expected *= (1.0 - std::polar(1.0, -angle)) / 0.001;
                    }
                    EXPECT_LT(std::abs(frequency_response(filter, angle) / expected - 1.0), 1e-9)
                        << order << " " << static_cast<int>(mapping) << " " << angle;
                }
            }
        }
    }
}

TEST(RationalFilter, TunedIsNoWorseThanTheBandItself) {
    for (const double order : {0.5, -0.5, 1.5}) {
        const glsum::design::DerivativeGoal goal{order, 0.001, glsum::design::Band{0.8, 80.0}, {}};
        double before = INFINITY;
        for (const std::size_t poles : {2U, 4U, 6U}) {
            const auto tuned = tune_rational(RationalRule::oustaloup, goal, poles);
            EXPECT_LT(tuned.error, before) << order << ", " << poles;
            before = tuned.error;
            // What it says is what it is.
            const double v = order > 1.0 ? order - 1.0 : order;
            const Roots roots = roots_of(RationalRule::oustaloup, v, poles, tuned.edges);
            double largest = 0.0;
            for (const double hz : frequencies_of(goal)) {
                const double angle = 2.0 * std::numbers::pi * hz * 0.001;
                std::complex<double> response = tuned.gain * response_of(roots, tuned.mapping, 0.001, angle);
                if (order > 1.0) {
                    response *= (1.0 - std::polar(1.0, -angle)) / 0.001;
                }
                const auto exact = glsum::design::exact_response(order, hz);
                largest = std::max(largest, std::abs(response - exact) / std::abs(exact));
            }
            EXPECT_NEAR(largest, tuned.error, 1e-6 * tuned.error);
        }
        // Above order 1 the difference before the filter errs, by its half sample, 15 % at 80 Hz.
        EXPECT_LT(before, order > 1.0 ? 0.2 : 0.05) << order;
    }
}

TEST(RationalFilter, HasOrdersBetweenMinusOneAndTwoThatAreNotWhole) {
    for (const double order : {-0.995, -0.5, 0.5, 0.995, 1.005, 1.995}) {
        EXPECT_TRUE(glsum::design::has_rational(order)) << order;
    }
    for (const double order : {-1.5, -1.005, -1.0, 0.0, 1.0, 2.0, 2.005, 2.5}) {
        EXPECT_FALSE(glsum::design::has_rational(order)) << order;
    }
}

// From just above order 1 on a difference goes before the filter of one order less, in the tuning as in the modes.
TEST(RationalFilter, ADifferenceGoesBeforeFromOrderOneOn) {
    for (const double order : {0.995, 1.005}) {
        const glsum::design::DerivativeGoal goal{order, 0.001, glsum::design::Band{8.0, 80.0}, {}};
        const auto tuned = tune_rational(RationalRule::oustaloup, goal, 1);
        const auto filter = as_modes(RationalRule::oustaloup, goal, 1, tuned);
        EXPECT_EQ(filter.kind,
                  order > 1.0 ? glsum::design::FilterKind::increments : glsum::design::FilterKind::samples);
        EXPECT_NEAR(filter.error.band, tuned.error, 1e-6 * tuned.error) << order;
    }
}

// Of v towards 1 Tustin's mapping errs least of the three, with fast poles that turn negative: where none may, another
// mapping is tuned.
TEST(RationalFilter, TustinsMappingIsTakenWhereAPoleMaySwing) {
    const glsum::design::DerivativeGoal goal{0.9, 0.001, glsum::design::Band{8.0, 80.0}, {}};
    const auto swinging = tune_rational(RationalRule::oustaloup, goal, 2);
    const auto decaying = tune_rational(RationalRule::oustaloup, goal, 2, glsum::design::Poles::decaying);
    EXPECT_EQ(swinging.mapping, Mapping::tustin);
    EXPECT_NE(decaying.mapping, Mapping::tustin);
    EXPECT_LT(swinging.error, decaying.error);
}

TEST(RationalFilter, AFittedOneOfAsManyPolesErrsLess) {
    // Near half a decade a pole the rules come within 0.2 % of what is best.
    for (const double order : {0.2, 0.5, -0.5}) {
        for (const std::size_t poles : {2U, 3U, 4U}) {
            const glsum::design::DerivativeGoal goal{order, 0.001, glsum::design::Band{0.8, 80.0}, {}};
            const double fitted = fit_filter(goal, 1, poles, glsum::design::FilterKind::samples).error.band;
            for (const RationalRule rule : {RationalRule::oustaloup, RationalRule::charef}) {
                EXPECT_LT(fitted, tune_rational(rule, goal, poles).error) << order << ", " << poles;
            }
        }
    }
}

// The largest error over the band with the best gain, which a search by thirds finds: it falls, then rises.
double least_error(RationalRule rule, const glsum::design::DerivativeGoal& goal, std::size_t poles,
                   const glsum::design::Edges& edges, Mapping mapping, double near_gain) {
    const Roots roots = roots_of(rule, goal.order, poles, edges);
    std::vector<std::complex<double>> ratios;
    for (const double hz : frequencies_of(goal)) {
        const double angle = 2.0 * std::numbers::pi * hz * goal.step_s;
        ratios.push_back(response_of(roots, mapping, goal.step_s, angle) /
                         glsum::design::exact_response(goal.order, hz));
    }
    const auto error = [&](double gain) {
        double largest = 0.0;
        for (const auto& ratio : ratios) {
            largest = std::max(largest, std::abs(gain * ratio - 1.0));
        }
        return largest;
    };
    double low = 0.8 * near_gain;
    double high = 1.25 * near_gain;
    for (int i = 0; i < 90; ++i) {
        const double third = (high - low) / 3.0;
        error(low + third) < error(high - third) ? high -= third : low += third;
    }
    return error(0.5 * (low + high));
}

// At the last step, a thousandth of a decade, no edge moves alone, with the other or against it, and errs less.
TEST(RationalFilter, NoSmallMoveOfItsEdgesErrsLess) {
    constexpr double step = 0.125 / 128.0;
    for (const RationalRule rule : {RationalRule::oustaloup, RationalRule::charef}) {
        for (const double order : {0.2, 0.5, 0.8, -0.5}) {
            for (const std::size_t poles : {2U, 3U, 4U}) {
                const glsum::design::DerivativeGoal goal{order, 0.001, glsum::design::Band{0.8, 80.0}, {}};
                const auto tuned = tune_rational(rule, goal, poles);
                const auto moved = [&](int low, int high) {
                    return least_error(rule, goal, poles,
                                       {tuned.edges.low_rad_s * std::pow(10.0, low * step),
                                        tuned.edges.high_rad_s * std::pow(10.0, high * step)},
                                       tuned.mapping, tuned.gain);
                };
                EXPECT_NEAR(moved(0, 0), tuned.error, 1e-6 * tuned.error) << order << ", " << poles;
                for (const int low : {-1, 0, 1}) {
                    for (const int high : {-1, 0, 1}) {
                        EXPECT_GT(moved(low, high), (1.0 - 1e-6) * tuned.error)
                            << order << ", " << poles << " by " << low << ", " << high;
                    }
                }
            }
        }
    }
}

}  // namespace
