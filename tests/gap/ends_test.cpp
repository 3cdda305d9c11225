// Where the input goes further and the readings stay, something is at its end.
#include "gap/drive/ends.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "gap/drive/audit.hpp"

namespace {

using testing::Each;

struct Asked {
    std::function<double(double t)> input;
    double limit = 1e9;  // of the input
    double gain = 2.0;
    double noise = 2e-3;
    double delay_s = 0.0;
    double floor = -1e9;  // of the output
};

// A lag of 1 s, by its own differential equation: 60 s at 10 Hz.
gap::Record logged(const Asked& asked) {
    std::mt19937_64 engine(3);
    std::normal_distribution<double> noise(0.0, asked.noise);
    gap::Record record;
    record.name = "made";
    record.usual_interval_s = 0.1;
    double y = asked.gain * std::min(asked.input(0.0), asked.limit);
    for (int i = 0; i < 600; ++i) {
        const double t = 0.1 * i;
        record.time_s.push_back(t);
        record.input.push_back(asked.input(t));
        record.output.push_back(std::max(y, asked.floor) + noise(engine));
        for (int k = 0; k < 20; ++k) {
            const double u = asked.input(std::max(0.0, t + 0.005 * k - asked.delay_s));
            y += 0.005 * (asked.gain * std::clamp(u, -asked.limit, asked.limit) - y);
        }
    }
    return record;
}

// Six steps up, ten seconds each.
double rising(double t) { return 1.0 + std::floor(t / 10.0); }

std::size_t first_of(const std::vector<char>& held) {
    return static_cast<std::size_t>(std::ranges::find(held, 1) - held.begin());
}

TEST(Ends, AreWhereTheReadingsStayAndTheInputGoesOn) {
    // Reached on the way to the fourth level: the readings come within a hundredth of the end and stay.
    const std::vector<char> held = gap::readings_at_an_end(logged({.input = rising, .limit = 3.5}));
    const std::size_t first = first_of(held);
    EXPECT_NEAR(0.1 * static_cast<double>(first), 32.9, 0.8);
    EXPECT_TRUE(
        std::all_of(held.begin() + static_cast<std::ptrdiff_t>(first), held.end(), [](char one) { return one == 1; }));
    // Likewise where more input makes less output, and downwards.
    const auto falling = [](double t) { return -rising(t); };
    for (const Asked& asked :
         {Asked{.input = rising, .limit = 3.5, .gain = -2.0}, Asked{.input = falling, .limit = 3.5},
          Asked{.input = falling, .limit = 3.5, .gain = -2.0}}) {
        const std::vector<char> other = gap::readings_at_an_end(logged(asked));
        EXPECT_NEAR(static_cast<double>(first_of(other)), static_cast<double>(first), 2.0);
        EXPECT_EQ(other.back(), 1);
    }
    // A ramp's, too.
    const auto ramp = [](double t) { return 0.1 * t; };
    EXPECT_NEAR(static_cast<double>(first_of(gap::readings_at_an_end(logged({.input = ramp, .limit = 4.0})))), 400.0,
                20.0);
}

TEST(Ends, AreWhereATankIsEmpty) {
    const auto wave = [](double t) { return 3.0 * std::cos(0.2 * t); };
    const gap::Record record = logged({.input = wave, .floor = 0.0});
    const std::vector<char> held = gap::readings_at_an_end(record);
    ASSERT_LT(first_of(held), held.size());
    for (std::size_t i = 0; i < held.size(); ++i) {
        if (held[i] != 0) {
            EXPECT_LT(record.output[i], 0.1);
        }
    }
}

TEST(Ends, AreNoneOfALinearPlant) {
    const auto none = [](const Asked& asked) { EXPECT_THAT(gap::readings_at_an_end(logged(asked)), Each(0)); };
    none({.input = rising});
    none({.input = rising, .gain = -2.0});
    none({.input = [](double t) { return std::sin(0.3 * t); }});
    none({.input = [](double t) { return std::fmod(t, 13.0) < 6.0 ? 1.0 : -1.0; }});
    none({.input = [](double t) { return std::fmod(t, 13.0) < 6.0 ? 1.0 : 0.0; }, .delay_s = 1.5});
    none({.input = [](double) { return 1.0; }});
}

// A last step within a thirtieth of the record has not come through yet.
TEST(Ends, AreNoDeadTime) {
    const auto last_at = [](double at_s) { return [at_s](double t) { return t < at_s ? 1.0 : 2.0; }; };
    EXPECT_THAT(gap::readings_at_an_end(logged({.input = last_at(58.5), .limit = 1.0})), Each(0));
    // Moved before, so that there is a swing.
    const auto moved = [&](double at_s) { return [at_s](double t) { return t < 5.0 ? 0.0 : t < at_s ? 1.0 : 2.0; }; };
    EXPECT_THAT(gap::readings_at_an_end(logged({.input = moved(58.5), .limit = 1.0})), Each(0));
    EXPECT_LT(first_of(gap::readings_at_an_end(logged({.input = moved(57.0), .limit = 1.0}))), 600U);
}

TEST(Ends, AreNotToldInNoise) {
    const Asked asked{.input = rising, .limit = 3.5};
    for (const double noise : {0.05, 0.2}) {
        Asked noisy = asked;
        noisy.noise = noise;  // an eighth of a tenth of the swing of 5 is 0.0625
        EXPECT_EQ(first_of(gap::readings_at_an_end(logged(noisy))) < 600U, noise < 0.0625) << noise;
    }
}

// The median of every second difference: of five readings there are three.
TEST(Ends, AreToldByTheNoiseOfAllReadings) {
    gap::Record record;
    record.time_s = {0.0, 1.0, 2.0, 3.0, 4.0};
    record.input = {0.0, 1.0, 2.0, 3.0, 4.0};
    record.output = {0.0, 0.5, 1.0, 1.0, 1.0};  // 0, 0.5 and 0: the middle one is 0
    EXPECT_THAT(gap::readings_at_an_end(record), testing::ElementsAre(0, 0, 1, 1, 1));
    record.output = {0.0, 0.2, 1.0, 1.0, 1.0};  // 0.6, 0.8 and 0
    EXPECT_THAT(gap::readings_at_an_end(record), Each(0));
}

TEST(Ends, DoNotCountWhereFiftyOthersDo) {
    const gap::Record record = logged({.input = rising, .limit = 3.5});
    const auto held = static_cast<std::ptrdiff_t>(std::ranges::count(gap::readings_at_an_end(record), 1));
    const auto counts = gap::without_ends({std::vector<char>(600, 1)}, {record});
    EXPECT_EQ(std::ranges::count(counts[0], 1), 600 - held);
    std::vector<char> few(600, 0);
    std::fill_n(few.begin() + 300, 300, 1);
    EXPECT_EQ(std::ranges::count(gap::without_ends({few}, {record})[0], 1), 300);
    // It is said.
    EXPECT_THAT(gap::audit({record}).notes,
                testing::Contains(testing::HasSubstr("stay where they are while the input goes further")));
}

}  // namespace
