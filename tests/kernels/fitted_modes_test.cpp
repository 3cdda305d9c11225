// Modes for weights of higher order: the certificate, and what an error costs.
#include "glsum/design/fitted.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <set>
#include <vector>

#include "glsum/design/bdf.hpp"
#include "glsum/design/modes.hpp"

namespace {

using glsum::design::approximate_fitted;
using glsum::design::bdf_increment_weights;
using glsum::design::bdf_weights;
using glsum::design::design_fitted;

TEST(FittedModes, KeepTheErrorThatTheyAreDesignedFor) {
    for (unsigned steps = 2; steps <= 4; ++steps) {
        for (const double order : {0.2, 0.5, 0.98319, 1.5, 1.9909, -0.5}) {
            for (const bool increments : {false, true}) {
                const double of_weights = increments ? order - 1.0 : order;
                if (!glsum::design::has_tail(of_weights)) {
                    continue;
                }
                const auto weights =
                    increments ? bdf_increment_weights(steps, order, 2001) : bdf_weights(steps, order, 2001);
                std::size_t before = 0;
                for (const double wanted : {1e-2, 1e-4, 1e-6}) {
                    const auto found = design_fitted(weights, of_weights, wanted);
                    ASSERT_TRUE(found) << steps << " steps, order " << order << ", error " << wanted;
                    // By hand: the recurrence of each exponential.
                    double error = 0.0;
                    std::vector<double> terms;
                    for (const auto& mode : found->modes) {
                        ASSERT_GT(mode.decay, 0.0);
                        ASSERT_LE(mode.decay, 1.0);
                        terms.push_back(mode.weight);
                    }
                    for (std::size_t j = found->near_taps; j < weights.size(); ++j) {
                        double sum = 0.0;
                        for (std::size_t m = 0; m < terms.size(); ++m) {
                            sum += terms[m];
                            terms[m] *= 1.0 - found->modes[m].decay;
                        }
                        error += std::fabs(weights[j] - sum);
                    }
                    EXPECT_LE(error, wanted * (1.0 + 1e-6)) << steps << ", " << order;
                    EXPECT_NEAR(found->error, error, 1e-6 * wanted) << steps << ", " << order;
                    EXPECT_GE(found->length(), before);
                    before = found->length();
                }
            }
        }
    }
}

TEST(FittedModes, OfFirstOrderCostNoMoreThanAFewMore) {
    // The poles are those of the tail; least squares on each decade alike can only spoil the sum of magnitudes a
    // little.
    const auto half = bdf_weights(2, 0.5, 5001);
    const auto own = glsum::design::design_modes({0.5, 5000}, 1e-4);
    const auto found = design_fitted(half, 0.5, 1e-4);
    ASSERT_TRUE(own && found);
    EXPECT_LE(found->length(), own->length() + 6);
    EXPECT_FALSE(design_fitted(half, 0.5, 1e-15));
    EXPECT_TRUE(approximate_fitted(half, 0.5, 4, 0).modes.empty());
    EXPECT_EQ(approximate_fitted(half, 0.5, 4, 7).modes.size(), 7U);
}

// Of a ladder of near taps the cheapest, and of several the one of the fewest.
TEST(FittedModes, AreTheCheapestOfTheirLadder) {
    std::set<std::size_t> met;
    for (const unsigned steps : {2U, 4U}) {
        for (const double order : {0.1, 0.5, 0.9, 1.5, 1.9, -0.5}) {
            const auto weights = bdf_weights(steps, order, 401);
            for (const double wanted : {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10}) {
                std::optional<glsum::design::Approximation> best;
                for (const std::size_t near_taps : {4U, 6U, 8U, 12U, 16U, 24U, 32U}) {
                    for (std::size_t modes = 1; modes <= glsum::design::most_modes; ++modes) {
                        if (best && near_taps + 2 * modes > best->length()) {
                            break;
                        }
                        auto one = approximate_fitted(weights, order, near_taps, modes);
                        if (one.modes.size() < modes) {
                            break;  // the tail has no more in it
                        }
                        if (one.error <= wanted) {
                            best = !best || one.length() < best->length() ? std::optional(std::move(one)) : best;
                            break;
                        }
                    }
                }
                const auto found = design_fitted(weights, order, wanted);
                ASSERT_EQ(found.has_value(), best.has_value()) << steps << ' ' << order << ' ' << wanted;
                if (found) {
                    EXPECT_EQ(found->near_taps, best->near_taps) << steps << ' ' << order << ' ' << wanted;
                    EXPECT_EQ(found->modes.size(), best->modes.size()) << steps << ' ' << order << ' ' << wanted;
                    met.insert(found->near_taps);
                }
            }
        }
    }
    EXPECT_EQ(met.size(), 7U);  // no step of the ladder is for nothing
}

}  // namespace
