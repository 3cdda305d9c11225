// Each excitation of blind cases from what its seed draws: the rest at the beginning first, then what its shape needs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "drive/stand/blind/profile.hpp"

namespace {

namespace blind = stand::blind;
using stand::Chance;

constexpr double until_s = 16.0;
constexpr double tau_s = 0.3;
constexpr double high = 4.0;

using Shape = std::function<double(double t)>;

// Compares with the shape that `draw` makes of the same chance and of what is left behind the rest.
void expect_shape(const char* kind, double lag_s, const std::function<Shape(Chance& same, double left_s)>& draw) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        Chance chance(seed, 3);
        const auto held =
            blind::make_profile(kind, {.interval_s = 0.01, .spread_s = 0.0, .until_s = until_s}, high, lag_s, chance);
        ASSERT_EQ(held.input.size(), 1601U);
        Chance same(seed, 3);
        const double rest_s = same.between(0.01, 0.04) * until_s;
        const Shape shape = draw(same, until_s - rest_s);
        // The end itself is an edge of stairs: rounding puts it on either side.
        for (std::size_t k = 0; k + 1 < held.input.size(); ++k) {
            const double t = 0.01 * static_cast<double>(k);
            // Duties are written to 1e-4 of the highest.
            ASSERT_NEAR(held.input[k], t < rest_s ? 0.0 : high * shape(t - rest_s), 0.5001e-4 * high)
                << kind << ' ' << seed << ' ' << t;
        }
    }
}

TEST(ProfileEdges, AChirpIsSweptFromAFiftiethOfTheLagsRateToEightToTwentyTimes) {
    expect_shape("chirp", tau_s, [](Chance& same, double left_s) -> Shape {
        const double faster = same.between(8.0, 20.0);
        const double swing = same.between(0.3, 0.5);
        return [=](double t) {
            const double turns = 0.02 / tau_s * left_s / std::log(faster) * (std::pow(faster, t / left_s) - 1.0);
            return 1.0 - swing * (1.0 + std::cos(2.0 * std::numbers::pi * turns));
        };
    });
}

TEST(ProfileEdges, AStepGoesToItsHeightBehindTheRest) {
    expect_shape("step", tau_s, [](Chance&, double) -> Shape { return [](double) { return 1.0; }; });
}

TEST(ProfileEdges, ARampGoesUpAndDownOneToThreeTimes) {
    expect_shape("ramp", tau_s, [](Chance& same, double left_s) -> Shape {
        const double turns = 1.0 + static_cast<double>(same.below(3));
        return [=](double t) {
            const double place = turns * t / left_s - std::floor(turns * t / left_s);
            return place < 0.5 ? 2.0 * place : 2.0 - 2.0 * place;
        };
    });
}

// What holds levels draws the time of a bit and the number of stairs, too, whether it has them or not.
TEST(ProfileEdges, SwitchesAndStairsHoldTheirTimes) {
    for (const double lag_s : {0.03, tau_s, 0.6}) {
        expect_shape("on_off", lag_s, [lag_s](Chance& same, double left_s) -> Shape {
            (void)same.between(0.7, 2.0);
            (void)same.below(3);
            const double on_s = std::min(lag_s * same.between(6.0, 14.0), 0.4 * left_s);
            return [=](double t) { return std::fmod(std::floor(t / on_s), 2.0) == 0.0 ? 1.0 : 0.0; };
        });
        expect_shape("staircase", lag_s, [lag_s](Chance& same, double left_s) -> Shape {
            (void)same.between(0.7, 2.0);
            const double stairs = 4.0 + static_cast<double>(same.below(3));
            // Long enough to settle, as far as one way up and down allows, and not more than three of those.
            const double hold_s = std::min(left_s / (2.0 * stairs), std::max(8.0 * lag_s, left_s / (6.0 * stairs)));
            return [=](double t) {
                const double place = std::fmod(std::floor(t / hold_s), 2.0 * stairs) + 1.0;
                return std::min(place, 2.0 * stairs - place) / stairs;
            };
        });
    }
}

// The record's last sample lies at its end, where that is a whole number of intervals but for rounding.
TEST(ProfileEdges, TheLastSampleLiesAtTheEnd) {
    Chance chance(1, 3);
    const auto count = [&](double seconds) {
        return blind::make_profile("step", {.interval_s = 0.01, .spread_s = 0.0, .until_s = seconds}, 1.0, tau_s,
                                   chance)
            .time_s.size();
    };
    EXPECT_EQ(count(1.0 - 0.995e-11), 101U);
    EXPECT_EQ(count(1.0 - 1.005e-11), 100U);
    EXPECT_EQ(count(1.009), 101U);
}

}  // namespace
