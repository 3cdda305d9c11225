// The linear plant of blind cases at the edges of its effects, mostly without a memory of its own: it is at once where
// its input puts it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/failure.hpp"
#include "drive/stand/blind/effects.hpp"
#include "drive/stand/blind/plant.hpp"

namespace {

namespace blind = stand::blind;
using blind::Held;
using blind::Plant;
using stand::Stand;

constexpr double step_s = 0.01;

Plant at_once(double gain = 1.0) {
    Plant plant;
    plant.gain = gain;
    plant.terms = {{1.0, 0.0}};
    return plant;
}
double reading(const Plant& plant, const Stand& effects, const blind::Unlisted& unlisted, const Held& held,
               double at_s) {
    return blind::respond(plant, effects, unlisted, held, std::vector{at_s}, step_s).front();
}

TEST(BlindPlantEdges, OneWithoutAMemoryIsItsGain) {
    const Held steps{{0.0, 1.0}, {0.5, 0.25}};
    EXPECT_NEAR(reading(at_once(3.0), blind::no_effects(), {}, steps, 0.5), 1.5, 1e-12);
    EXPECT_NEAR(reading(at_once(3.0), blind::no_effects(), {}, steps, 1.5), 0.75, 1e-12);
}

// At half of the full input half of the delay at rest is left, at the full one and above nothing.
TEST(BlindPlantEdges, TheDelayAtRestIsAShareOfTheFullInput) {
    Plant plant = at_once();
    plant.full_input = 4.0;
    std::vector<double> at_s;
    for (int k = 0; k < 200; ++k) {
        at_s.push_back(step_s * k);
    }
    const auto jumps_at = [&](double input) {
        const auto z = blind::respond(plant, blind::no_effects(), {.delay_at_rest_s = 1.0},
                                      {{0.0, 2.0}, {input, input}}, at_s, step_s);
        return at_s[static_cast<std::size_t>(
            std::find_if(z.begin(), z.end() - 1, [](double value) { return value > 1e-9; }) - z.begin())];
    };
    EXPECT_NEAR(jumps_at(2.0), 0.5, 0.6 * step_s);
    EXPECT_NEAR(jumps_at(3.0), 0.25, 0.6 * step_s);
    EXPECT_NEAR(jumps_at(4.0), 0.0, 0.6 * step_s);
    EXPECT_NEAR(jumps_at(8.0), 0.0, 0.6 * step_s);
}

TEST(BlindPlantEdges, BacklashFollowsByHalfItsGapOnEitherSide) {
    Stand effects = blind::no_effects();
    effects.backlash_rad = 0.25;
    const Held there_and_back{{0.0, 1.0, 2.0, 3.0}, {1.0, 0.2, 0.3, 0.8}};
    for (const auto& [t, z] :
         {std::pair(0.5, 0.875), std::pair(1.5, 0.325), std::pair(2.5, 0.325), std::pair(3.5, 0.675)}) {
        EXPECT_NEAR(reading(at_once(), effects, {}, there_and_back, t), z, 1e-12) << t;
    }
}

TEST(BlindPlantEdges, RunsAwayBeyondAMillionTimesItsFullOutput) {
    const auto moves_to = [](double output) {
        Plant plant = at_once(output);
        plant.full_output = 2.0;
        return reading(plant, blind::no_effects(), {}, {{0.0, 1.0}, {1.0, 1.0}}, 0.5);
    };
    EXPECT_NEAR(moves_to(0.995 * 2e6), 0.995 * 2e6, 1e-6);
    EXPECT_THROW((void)moves_to(2e6), glsum::Failure);
    EXPECT_THROW((void)moves_to(-2e6), glsum::Failure);
}

// As long as it is pressed by more than what the stop's place holds, it lies there, whatever the speed it came with.
TEST(BlindPlantEdges, LiesOnItsStopWhileItIsPressed) {
    Plant plant;
    plant.terms = {{0.05, 2.0}, {0.2, 1.0}, {2.0, 0.0}};
    Stand effects = blind::no_effects();
    effects.upper_stop_rad = 0.25;
    std::vector<double> at_s;
    for (double t = 0.0; t < 3.0; t += step_s) {
        at_s.push_back(t);
    }
    const auto z = blind::respond(plant, effects, {}, {{0.0, 2.0}, {0.6, 0.4}}, at_s, step_s);
    bool there = false;
    for (std::size_t k = 0; k < z.size() && at_s[k] < 2.0 - step_s; ++k) {
        there = there || z[k] > 0.25 - 1e-12;
        EXPECT_NEAR(z[k], there ? 0.25 : z[k], 1e-12) << at_s[k];
    }
    EXPECT_TRUE(there);
    // 0.4 hold 0.2.
    EXPECT_LT(z.back(), 0.24);
}

// The sign of what may go either way is the second draw, behind the one that varies the size.
TEST(BlindPlantEdges, TheSignOfAnEffectIsTheSecondDraw) {
    const blind::Scale scale{3.0, 7.0, 11.0, 0.5, 0.01, 40.0, 60.0};
    std::size_t near = 0;
    for (std::uint64_t seed = 1; near < 3; ++seed) {
        stand::Chance same(seed, 2);
        const double vary = same.between(0.85, 1.15);
        const double share = same.share();
        if (share < 0.4975 || share > 0.5049) {
            continue;
        }
        near += share >= 0.5 ? 1 : 0;
        stand::Chance chance(seed, 2);
        const auto drawn = blind::draw_parameters("gain_error", blind::EffectSize::clear, scale, false, chance);
        EXPECT_NEAR(drawn.at("gain"), 1.0 + (share < 0.5 ? 1.0 : -1.0) * 0.08 * vary, 1e-12) << seed;
    }
    blind::Setup setup;
    EXPECT_THROW(blind::apply("backlash", {{"width", 1.0}}, setup), glsum::Failure);
    EXPECT_THROW(blind::apply("slack", {{"gap", 1.0}}, setup), glsum::Failure);
}

}  // namespace
