// Which layout of near taps and blocks is the best, and how good it is.
#include "glsum/design/blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "glsum/logmemory/nested.hpp"
#include "glsum/weights.hpp"
#include "reference/modes.hpp"

namespace {

using glsum::Blocks;

TEST(Blocks, AreLaidOutForTheLeastError) {
    const auto of_step = [](const glsum::design::BlockDesign& found) {
        constexpr std::size_t samples = 5000;
        const glsum::Design design = glsum::Design{0.5, found.near_taps + found.blocks.count, {}, {}, found.blocks};
        const auto full = reference::weights(reference::Real(0.5), samples);
        const auto kept = reference::weights_of(design, samples);
        reference::Real off = 0;
        double largest = 0.0;
        for (std::size_t k = 0; k < samples; ++k) {
            off += full[k] - kept[k];
            largest = std::max(largest, std::fabs(static_cast<double>(off)));
        }
        return largest;
    };
    const struct {
        std::size_t taps, near_taps, blocks, per_level;
        double error, step;
    } known[] = {{16, 7, 9, 1, 5.01e-2, 9.62e-3},
                 {24, 13, 11, 1, 2.86e-2, 2.24e-3},
                 {32, 11, 21, 2, 1.77e-2, 9.75e-4},
                 {128, 55, 73, 9, 1.55e-3, 2.79e-5}};
    for (const auto& one : known) {
        const auto found = glsum::design::design_blocks({0.5, 5000}, one.taps);
        EXPECT_EQ(found.near_taps, one.near_taps) << one.taps;
        EXPECT_EQ(found.blocks, (Blocks{one.blocks, one.per_level})) << one.taps;
        EXPECT_NEAR(found.error, one.error, 0.005 * one.error);
        EXPECT_NEAR(of_step(found), one.step, 0.005 * one.step);
    }
    // One block a level that reaches all: better for a step, worse for the worst record.
    EXPECT_NEAR(of_step({4, {12, 1}, 0.0}), 6.3e-3, 0.1e-3);
    EXPECT_NEAR(of_step({12, {12, 1}, 0.0}), 2.3e-3, 0.1e-3);
    // Nothing is left to gain where the weights end, and no block where the window holds all of them.
    EXPECT_EQ(glsum::design::design_blocks({2.0, 5000}, 8).blocks.count, 0U);
    EXPECT_EQ(glsum::design::design_blocks({0.5, 50}, 51).error, 0.0);
    EXPECT_EQ(glsum::design::design_blocks({0.5, 50}, 60).near_taps, 60U);
}

// Of order 1/2: 1, -1/2, -1/8, then the mean of -1/16 and -5/128 twice, then nothing.
TEST(Blocks, OfOneBlockTheOracleHasItsMean) {
    const glsum::Design design{0.5, 4, {}, {}, {1, 1}};
    const std::vector<double> known = {1.0, -0.5, -0.125, -13.0 / 256.0, -13.0 / 256.0, 0.0, 0.0};
    const auto weights = reference::weights_of(design, known.size());
    std::vector<double> impulse(known.size());
    impulse.front() = 1.0;
    const auto sums = reference::sums_of(design, impulse);
    for (std::size_t j = 0; j < known.size(); ++j) {
        EXPECT_EQ(static_cast<double>(weights[j]), known[j]) << j;
        EXPECT_EQ(sums[j].error_of(known[j]), 0.0) << j;
    }
}

// Of order 1/2 the weights are 1, -1/2, -1/8, -1/16, -5/128, -7/256, -21/1024, -33/2048, -429/32768. Behind near taps
// come means of two, of two again where a level has two blocks, and of four.
TEST(Blocks, OfSeveralLevelsTheOracleHasTheMeanOfEach) {
    const double two = -3.0 / 32.0;           // of a_2 and a_3
    const double four = -211.0 / 8192.0;      // of a_4 to a_7
    const double first = -5.0 / 16.0;         // of a_1 and a_2
    const double second = -13.0 / 256.0;      // of a_3 and a_4
    const double third = -2525.0 / 131072.0;  // of a_5 to a_8
    const struct {
        glsum::Design design;
        std::vector<double> weights;
    } known[] = {
        {{0.5, 4, {}, {}, {2, 1}}, {1.0, -0.5, two, two, four, four, four, four, 0.0, 0.0}},
        {{0.5, 4, {}, {}, {3, 2}}, {1.0, first, first, second, second, third, third, third, third, 0.0}},
    };
    for (const auto& [design, expected] : known) {
        const auto weights = reference::weights_of(design, expected.size());
        const auto sums = reference::sums_of(design, std::vector<double>(expected.size(), 1.0));
        double sum = 0.0;
        for (std::size_t j = 0; j < expected.size(); ++j) {
            sum += expected[j];
            EXPECT_EQ(static_cast<double>(weights.at(j)), expected[j]) << j;
            EXPECT_NEAR(sums.at(j).error_of(sum), 0.0, 1e-30) << j;
        }
        EXPECT_EQ(reference::weights_of(design, 3).size(), 3U);
    }
}

// Against every layout that there is: the rule's few candidates lose next to nothing.
TEST(Blocks, TheLayoutsThatAreTriedHoldTheBest) {
    constexpr std::size_t horizon = 300;
    for (const double order : {0.5, 0.9, 1.5, -0.5}) {
        std::vector<double> weights = {1.0};
        for (glsum::Weights walk(order); weights.size() < 1U << 14;) {
            walk.next();
            weights.push_back(walk.weight());
        }
        for (const std::size_t taps : {3U, 6U, 10U, 14U, 20U}) {
            double best = glsum::design::error_of(weights, taps, {}, horizon);
            for (std::size_t count = 1; count < taps; ++count) {
                for (std::size_t per_level = 1; per_level <= count; ++per_level) {
                    const Blocks blocks{count, per_level};
                    if (glsum::reach_of(taps - count, blocks) < weights.size()) {
                        best = std::min(best, glsum::design::error_of(weights, taps - count, blocks, horizon));
                    }
                }
            }
            EXPECT_LE(glsum::design::design_blocks({order, horizon}, taps).error, 1.05 * best) << order << " " << taps;
        }
    }
}

}  // namespace
