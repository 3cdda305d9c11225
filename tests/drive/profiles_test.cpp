// Excitations of blind cases by the closed form of their kind, and the stamps of their clock.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "drive/stand/blind/profile.hpp"
#include "tests/drive/seen.hpp"

namespace {

namespace blind = stand::blind;
using stand::Chance;
using test::expect_between;
using test::Seen;

constexpr blind::Clock clock{.interval_s = 0.01, .spread_s = 0.0, .until_s = 40.0};
constexpr double tau_s = 0.4;
constexpr double high = 2.0;

struct Excitation {
    std::vector<double> u;  // over the highest, from the end of the rest on
    double rest_s = 0.0;
    double length_s = 0.0;
};

Excitation excited(const char* kind, std::uint64_t seed) {
    Chance chance(seed, 3);
    const auto held = blind::make_profile(kind, clock, high, tau_s, chance);
    EXPECT_EQ(held.time_s.size(), 4001U);
    Excitation found;
    std::size_t k = 0;
    // The rest ends where the input begins; a chirp of the widest swing and a ramp begin at 0 themselves.
    while (k < held.input.size() && held.input[k] == 0.0) {
        ++k;
    }
    found.rest_s = 0.01 * static_cast<double>(k);
    found.length_s = clock.until_s - found.rest_s;
    for (; k < held.input.size(); ++k) {
        found.u.push_back(held.input[k] / high);
    }
    return found;
}

// Where a sequence changes, in samples.
std::vector<double> holds_of(const std::vector<double>& u) {
    std::vector<double> holds;
    std::size_t from = 0;
    for (std::size_t k = 1; k < u.size(); ++k) {
        if (u[k] != u[k - 1]) {
            holds.push_back(static_cast<double>(k - from));
            from = k;
        }
    }
    return holds;
}

TEST(Profiles, RestAndThenStep) {
    Seen rest;
    for (std::uint64_t seed = 1; seed <= 800; ++seed) {
        const Excitation step = excited("step", seed);
        rest(step.rest_s / clock.until_s);
        EXPECT_EQ(step.u, std::vector<double>(step.u.size(), 1.0));
    }
    EXPECT_NEAR(rest.least, 0.01, 3e-4);
    EXPECT_NEAR(rest.most, 0.04, 3e-4);
    EXPECT_TRUE(blind::has_one_level("step"));
    EXPECT_TRUE(blind::has_one_level("on_off"));
    EXPECT_FALSE(blind::has_one_level("prbs"));
}

TEST(Profiles, SwitchOnAndOff) {
    Seen on;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        const Excitation found = excited("on_off", seed);
        const auto holds = holds_of(found.u);
        ASSERT_GE(holds.size(), 3U);
        for (std::size_t i = 0; i < holds.size(); ++i) {
            EXPECT_NEAR(holds[i], holds[0], 1.0);
        }
        on(holds[0] * 0.01 / tau_s);
        for (const double u : found.u) {
            EXPECT_TRUE(u == 0.0 || u == 1.0);
        }
    }
    EXPECT_NEAR(on.least, 6.0, 0.05);
    EXPECT_NEAR(on.most, 14.0, 0.05);
    // Of a slow plant at most two fifths of the record.
    Chance chance(1, 3);
    const auto slow = blind::make_profile("on_off", clock, 1.0, 100.0, chance);
    const auto first = std::find(slow.input.begin(), slow.input.end(), 1.0) - slow.input.begin();
    const auto last = std::find(slow.input.begin() + first, slow.input.end(), 0.0) - slow.input.begin();
    EXPECT_NEAR(static_cast<double>(last - first), 0.4 * static_cast<double>(4001 - first), 2.0);
}

TEST(Profiles, ClimbStairs) {
    std::set<double> stairs;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const Excitation found = excited("staircase", seed);
        const double n = std::round(1.0 / found.u.front());
        stairs.insert(n);
        const double hold = std::min(found.length_s / (2.0 * n), std::max(8.0 * tau_s, found.length_s / (6.0 * n)));
        for (std::size_t k = 0; k < found.u.size(); ++k) {
            const double along = static_cast<double>(k) * 0.01 / hold;
            if (std::fabs(along - std::round(along)) * hold > 0.025) {  // beside a step
                const int place = static_cast<int>(along) % static_cast<int>(2.0 * n) + 1;
                ASSERT_NEAR(found.u[k], std::min<double>(place, 2.0 * n - place) / n, 5.1e-5) << seed << ' ' << k;
            }
        }
    }
    EXPECT_THAT(stairs, testing::ElementsAre(4.0, 5.0, 6.0));
}

TEST(Profiles, HoldLevelsAtRandom) {
    Seen level, hold;
    std::size_t none = 0;
    std::size_t all = 0;
    for (std::uint64_t seed = 1; seed <= 500; ++seed) {
        const Excitation found = excited("levels", seed);
        for (const double u : found.u) {
            if (u != 0.0) {
                level(u);
                ASSERT_NEAR(100.0 * u, std::round(100.0 * u), 1e-9);
            }
        }
        double at = 0.0;
        for (const double samples : holds_of(found.u)) {
            ++all;
            none += found.u[static_cast<std::size_t>(at)] == 0.0 ? 1 : 0;
            at += samples;
            hold(samples * 0.01 / tau_s);
        }
    }
    EXPECT_NEAR(level.least, 0.15, 1e-9);
    EXPECT_NEAR(level.most, 1.0, 1e-9);
    EXPECT_NEAR(hold.least, 3.0, 0.06);
    EXPECT_GT(hold.most, 7.97);  // two equal levels in a row hold longer
    // One in seven is 0: as runs of such holds, 0.15 0.85 of them beside 0.85 others.
    EXPECT_NEAR(static_cast<double>(none) / static_cast<double>(all), 0.1275 / 0.9775, 0.01);
}

TEST(Profiles, AreRandomBinarySignals) {
    Seen low, bit;
    for (std::uint64_t seed = 1; seed <= 500; ++seed) {
        const Excitation found = excited("prbs", seed);
        std::set<double> levels(found.u.begin(), found.u.end());
        ASSERT_EQ(levels.size(), 2U);
        EXPECT_EQ(*levels.rbegin(), 1.0);
        low(*levels.begin());
        const auto holds = holds_of(found.u);
        bit(*std::min_element(holds.begin() + 1, holds.end()) * 0.01 / tau_s);
    }
    EXPECT_NEAR(low.least, 0.2, 2e-3);
    EXPECT_NEAR(low.most, 0.5, 2e-3);
    EXPECT_NEAR(bit.least, 0.7, 0.03);
    EXPECT_NEAR(bit.most, 2.0, 0.03);
}

// Up and down as straight lines, one to three times.
TEST(Profiles, RampUpAndDown) {
    std::set<int> turns;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const Excitation found = excited("ramp", seed);
        EXPECT_NEAR(*std::max_element(found.u.begin(), found.u.end()), 1.0, 2e-3);
        const double slope = (found.u[101] - found.u[1]) / 1.0;
        const double ups = 0.5 * slope * found.length_s;
        turns.insert(static_cast<int>(std::lround(ups)));
        EXPECT_NEAR(ups, std::round(ups), 0.01);
        std::size_t falls = 0;
        for (std::size_t k = 1; k < found.u.size(); ++k) {
            EXPECT_NEAR(std::fabs(found.u[k] - found.u[k - 1]), 0.01 * slope, 0.02 * slope + 2e-4);
            falls += found.u[k] < found.u[k - 1] ? 1 : 0;
        }
        EXPECT_NEAR(static_cast<double>(falls), 0.5 * static_cast<double>(found.u.size()), 10.0);
    }
    EXPECT_THAT(turns, testing::ElementsAre(1, 2, 3));
}

// From 0.02 over the time constant on, 8 to 20 times faster at the end: the phase is f (e^(r t) - 1) / r.
TEST(Profiles, ChirpFromSlowToFast) {
    Seen swing, faster;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        const Excitation found = excited("chirp", seed);
        const double least = *std::min_element(found.u.begin(), found.u.end());
        EXPECT_NEAR(*std::max_element(found.u.begin(), found.u.end()), 1.0, 1e-3);
        const double own = 0.5 * (1.0 - least);
        swing(own);
        std::vector<double> crossings_s;  // of the middle: quarter, three quarters, ... of a turn
        for (std::size_t k = 1; k < found.u.size(); ++k) {
            const double a = found.u[k - 1] - (1.0 - own);
            const double b = found.u[k] - (1.0 - own);
            if ((a < 0.0) != (b < 0.0)) {
                crossings_s.push_back(0.01 * (static_cast<double>(k - 1) + a / (a - b)));
            }
        }
        ASSERT_GE(crossings_s.size(), 4U);
        // Five times the phase of the first crossing at the third.
        double low = 1e-6;
        double top = 1.0;
        for (int i = 0; i < 60; ++i) {
            const double r = 0.5 * (low + top);
            (std::expm1(r * crossings_s[2]) < 5.0 * std::expm1(r * crossings_s[0]) ? low : top) = r;
        }
        if (own < 0.49) {  // where it begins is seen
            EXPECT_NEAR(0.25 * low / std::expm1(low * crossings_s[0]), 0.02 / tau_s, 2.5e-3);
            faster(std::exp(low * found.length_s));
        }
    }
    EXPECT_NEAR(swing.least, 0.3, 2e-3);
    EXPECT_NEAR(swing.most, 0.5, 2e-3);
    EXPECT_NEAR(faster.least, 8.0, 0.5);
    EXPECT_NEAR(faster.most, 20.0, 1.5);
}

// Stamps are whole microseconds beside the even ones, the first is 0.
TEST(Profiles, StampAsTheirClockDoes) {
    Chance chance(1, 3);
    const auto held =
        blind::make_profile("step", {.interval_s = 0.01, .spread_s = 0.001, .until_s = 40.0}, 1.0, 0.4, chance);
    Seen beside;
    ASSERT_EQ(held.time_s.size(), 4001U);
    EXPECT_EQ(held.time_s[0], 0.0);
    for (std::size_t k = 1; k < held.time_s.size(); ++k) {
        beside(held.time_s[k] - 0.01 * static_cast<double>(k));
        EXPECT_NEAR(held.time_s[k] * 1e6, std::round(held.time_s[k] * 1e6), 1e-4);
    }
    expect_between(beside, -0.001, 0.001, "spread");
}

}  // namespace
