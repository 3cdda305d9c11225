// How designs of modes and blocks are found: by the rules that their headers state, at the edges of these.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "glsum/design/bdf.hpp"
#include "glsum/design/blocks.hpp"
#include "glsum/design/fitted.hpp"
#include "glsum/design/integral.hpp"
#include "glsum/design/modes.hpp"
#include "glsum/design/projection.hpp"
#include "glsum/logmemory/nested.hpp"

namespace {

using glsum::Blocks;
using glsum::Mode;
using glsum::design::Approximation;
using glsum::design::BlockDesign;
using glsum::design::Node;
using glsum::design::Projection;
using glsum::design::weights_to;

// |a_j| as a mixture of exponentials: the sum over j of what it misses stays below what it was made for.
TEST(TailNodes, AreTheWeightsWithinTheErrorThatIsAskedFor) {
    for (const double order :
         {-0.99, -0.95, -0.9, -0.6, -0.5, -0.1, 0.2, 0.5, 0.75, 0.76, 0.98319, 1.5, 1.74, 1.9909}) {
        const std::size_t least = glsum::design::least_near_taps(order);
        for (const std::size_t near_taps : {least, least + 1, least + 7}) {
            for (const std::size_t horizon : {20U, 600U, 1500U}) {
                const std::vector<double> weights = weights_to(order, horizon);
                for (const double error : {1e-3, 1e-6, 1e-9}) {
                    double missed = 0.0;
                    const std::vector<Node> nodes = glsum::design::tail_nodes(order, near_taps, horizon, error);
                    std::vector<double> terms;
                    for (const Node& node : nodes) {
                        EXPECT_GT(node.rate, 0.0);
                        terms.push_back(node.root * node.root);
                    }
                    for (std::size_t j = near_taps; j <= horizon; ++j) {
                        double sum = 0.0;
                        for (std::size_t m = 0; m < terms.size(); ++m) {
                            sum += terms[m];
                            terms[m] *= std::exp(-nodes[m].rate);
                        }
                        missed += std::fabs(std::fabs(weights[j]) - sum);
                    }
                    EXPECT_LE(missed, error) << order << ' ' << near_taps << ' ' << horizon << ' ' << error;
                }
            }
        }
    }
}

// A tap more than the order, by a quarter at least.
TEST(TailNodes, BeginAQuarterBehindTheOrder) {
    using glsum::design::least_near_taps;
    EXPECT_EQ(least_near_taps(-0.9), 1U);
    EXPECT_EQ(least_near_taps(-0.1), 1U);
    EXPECT_EQ(least_near_taps(0.5), 1U);
    EXPECT_EQ(least_near_taps(0.75), 1U);
    EXPECT_EQ(least_near_taps(0.7501), 2U);
    EXPECT_EQ(least_near_taps(1.2), 2U);
    EXPECT_EQ(least_near_taps(1.75), 2U);
    EXPECT_EQ(least_near_taps(1.7501), 3U);
    EXPECT_EQ(glsum::design::most_taps(0.5), 1 + 1 + 2 * glsum::design::most_modes);
    EXPECT_TRUE(glsum::design::has_tail(-0.999));
    EXPECT_FALSE(glsum::design::has_tail(-1.0));
    EXPECT_FALSE(glsum::design::has_tail(-1.005));
    EXPECT_FALSE(glsum::design::has_tail(1.0));
}

// What a projection drops is about its error: a third of it at least, and not many times less.
TEST(ProjectionOf, SaysAboutWhatItsModesMiss) {
    for (const double order : {-0.5, 0.5, 0.9, 1.5}) {
        constexpr std::size_t horizon = 2000;
        const std::size_t near_taps = glsum::design::least_near_taps(order);
        std::vector<double> weights = weights_to(order, horizon);
        for (double& weight : weights) {
            weight = std::fabs(weight);
        }
        const Projection projection(glsum::design::tail_nodes(order, near_taps, horizon, 1e-10), horizon);
        double before = INFINITY;
        for (std::size_t count = 0; count <= 9; ++count) {
            const auto modes = projection.modes(count);
            EXPECT_EQ(modes.size(), count);
            const double error = glsum::design::error_of(weights, near_taps, modes, INFINITY);
            const double dropped = projection.dropped(count);
            EXPECT_LT(dropped, before);
            before = dropped;
            EXPECT_LE(dropped, 3.0 * error) << order << ' ' << count;
            EXPECT_GE(dropped, 0.2 * error) << order << ' ' << count;
            for (std::size_t m = 1; m < modes.size(); ++m) {
                EXPECT_LT(modes[m - 1].decay, modes[m].decay);
                EXPECT_GE(modes[m].weight, 0.0);
            }
        }
        EXPECT_EQ(projection.dropped(projection.size()), 0.0);
    }
}

// No shorter length with the modes that it holds keeps the error.
TEST(Modes, AreAsFewAsKeepTheError) {
    for (const double order : {-0.5, 0.5, 0.98319, 1.5}) {
        for (const double error : {1e-2, 1e-4, 1e-7}) {
            const auto found = glsum::design::design_modes({order, 800}, error);
            ASSERT_TRUE(found);
            for (std::size_t taps = 1; taps < found->length(); ++taps) {
                const std::size_t modes = glsum::design::modes_within(order, taps);
                EXPECT_GT(glsum::design::approximate({order, 800}, taps - 2 * modes, modes).error, error)
                    << order << ' ' << taps;
            }
        }
    }
}

TEST(Modes, ErrorsAreSummedUpToEnough) {
    const std::vector<double> ones(11, 1.0);
    EXPECT_EQ(glsum::design::error_of(ones, 0, {}, INFINITY), 11.0);
    EXPECT_EQ(glsum::design::error_of(ones, 4, {}, INFINITY), 7.0);
    EXPECT_EQ(glsum::design::error_of(ones, 0, {}, 2.5), 3.0);  // enough is enough
    EXPECT_EQ(glsum::design::error_of(ones, 0, {}, 3.0), 4.0);
    // One that halves from 1 on: misses 0, 1/2, 3/4, ...
    EXPECT_EQ(glsum::design::error_of(ones, 8, {{0.5, 1.0}}, INFINITY), 0.5 + 0.75);
    EXPECT_EQ(weights_to(1.0, 3), (std::vector<double>{1.0, -1.0, 0.0, 0.0}));
    EXPECT_EQ(weights_to(0.5, 0), std::vector<double>{1.0});
}

// A level takes 3 taps; orders between -1 and 0 what their modes take; others have none.
TEST(IntegralModes, AreThoseOfTheirOrder) {
    using glsum::design::integral_modes_within;
    using glsum::design::is_integral;
    EXPECT_TRUE(is_integral(-1.0));
    EXPECT_TRUE(is_integral(-1e-9));
    EXPECT_FALSE(is_integral(0.0));
    EXPECT_FALSE(is_integral(std::nextafter(-1.0, -2.0)));
    for (const std::size_t taps : {0U, 1U, 2U}) {
        EXPECT_EQ(integral_modes_within(-1.0, taps), 0U);
    }
    for (const std::size_t taps : {3U, 4U, 100U}) {
        EXPECT_EQ(integral_modes_within(-1.0, taps), 1U);
    }
    for (const std::size_t taps : {1U, 2U, 3U, 4U, 16U, 33U, 400U}) {
        EXPECT_EQ(integral_modes_within(-0.5, taps), glsum::design::modes_within(-0.5, taps));
        EXPECT_EQ(integral_modes_within(0.5, taps), 0U);
        EXPECT_EQ(integral_modes_within(-1.5, taps), 0U);
        EXPECT_EQ(integral_modes_within(0.0, taps), 0U);
    }
}

TEST(IntegralModes, AreRefusedWhereNoneKeepTheError) {
    EXPECT_FALSE(glsum::design::design_integral(weights_to(-0.5, 600), -0.5, 1e-15));
    // Of order -1 weights that end higher than they stand: every tap but the last is needed.
    const std::vector<double> steps = {1.0, 2.0, 3.0, 4.0};
    const auto found = glsum::design::design_integral(steps, -1.0, 0.5);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->near_taps, 3U);
    EXPECT_EQ(found->modes.front().weight, 4.0);
    EXPECT_FALSE(glsum::design::design_integral(steps, -1.0, -1.0));
    // A little error is cheap: as few modes as keep it.
    const auto weights = weights_to(-0.5, 600);
    for (const double error : {1e-1, 1e-3}) {
        const auto design = glsum::design::design_integral(weights, -0.5, error);
        ASSERT_TRUE(design);
        if (design->modes.size() > 1) {
            EXPECT_GT(
                glsum::design::approximate_integral(weights, -0.5, design->near_taps, design->modes.size() - 1).error,
                error);
        }
    }
}

// sum |a_j - weight| by definition.
double by_definition(const std::vector<double>& weights, std::size_t near_taps, const Blocks& blocks,
                     std::size_t horizon) {
    std::vector<double> kept(weights.size(), 0.0);
    std::size_t from = near_taps;
    for (std::size_t b = 0; b < blocks.count && from <= horizon; ++b) {
        const std::size_t width = std::size_t{2} << (b / blocks.per_level);
        double mean = 0.0;
        for (std::size_t j = from; j < from + width; ++j) {
            mean += weights.at(j) / static_cast<double>(width);
        }
        for (std::size_t j = from; j < from + width; ++j) {
            kept[j] = mean;
        }
        from += width;
    }
    double error = 0.0;
    for (std::size_t j = near_taps; j <= horizon; ++j) {
        error += std::fabs(weights[j] - kept[j]);
    }
    return error;
}

// The rule, tried out: for each number of blocks a level, 1 to 16 and then each an eighth larger, the fewest that reach
// the horizon; of one a level also fewer.
BlockDesign by_the_rule(double order, std::size_t horizon, std::size_t taps) {
    const std::vector<double> weights = weights_to(order, 8 * (horizon + taps));
    BlockDesign best{taps, {}, by_definition(weights, taps, {}, horizon)};
    std::vector<Blocks> tried;
    for (std::size_t per_level = 1; per_level < taps; per_level += per_level < 16 ? 1 : per_level / 8) {
        std::size_t fewest = 0;
        while (fewest < taps && (taps == fewest ? 0 : glsum::reach_of(taps - fewest, {fewest, per_level})) <= horizon) {
            ++fewest;
        }
        for (std::size_t count = 1; per_level == 1 && count < std::min(fewest, taps); ++count) {
            tried.push_back({count, 1});
        }
        if (fewest > 0 && fewest < taps) {
            tried.push_back({fewest, per_level});
        }
    }
    for (const Blocks& blocks : tried) {
        const double error = by_definition(weights, taps - blocks.count, blocks, horizon);
        if (error < best.error * (1.0 - 1e-12)) {
            best = {taps - blocks.count, blocks, error};
        }
    }
    return best;
}

TEST(Blocks, AreFoundByTheRule) {
    for (const double order : {0.5, 1.5, -0.5, -1.9}) {
        // Of -1.9, 46 and 24 it would be another one with as many blocks a level as there are coefficients.
        for (const std::size_t horizon : {1U, 2U, 9U, 46U, 60U, 700U}) {
            for (const std::size_t taps : {1U, 2U, 3U, 5U, 8U, 20U, 24U, 33U, 90U, 150U}) {
                const BlockDesign found = glsum::design::design_blocks({order, horizon}, taps);
                const BlockDesign expected = by_the_rule(order, horizon, taps);
                EXPECT_NEAR(found.error, expected.error, 1e-12) << order << ' ' << horizon << ' ' << taps;
                EXPECT_EQ(found.near_taps, expected.near_taps) << order << ' ' << horizon << ' ' << taps;
                EXPECT_EQ(found.blocks, expected.blocks) << order << ' ' << horizon << ' ' << taps;
            }
        }
    }
}

// First order costs 12, 21 and 30 for these errors; more steps a few more. No cheaper pair of the ladder keeps them.
TEST(FittedModes, CostNextToWhatFirstOrderDoes) {
    constexpr double errors[] = {1e-2, 1e-4, 1e-6};
    constexpr std::size_t most[3][3] = {{14, 24, 34}, {14, 24, 36}, {14, 26, 44}};
    for (unsigned steps = 2; steps <= 4; ++steps) {
        const auto weights = glsum::design::bdf_weights(steps, 0.5, 2001);
        for (std::size_t i = 0; i < 3; ++i) {
            const double error = errors[i];
            const auto found = glsum::design::design_fitted(weights, 0.5, error);
            ASSERT_TRUE(found);
            EXPECT_LE(found->length(), most[steps - 2][i]) << steps << ' ' << errors[i];
            for (const std::size_t near_taps : {4U, 6U, 8U, 12U, 16U, 24U, 32U}) {
                for (std::size_t modes = 1; near_taps + 2 * modes < found->length(); ++modes) {
                    EXPECT_GT(glsum::design::approximate_fitted(weights, 0.5, near_taps, modes).error, error)
                        << steps << ' ' << near_taps << ' ' << modes;
                }
            }
        }
    }
}

}  // namespace
