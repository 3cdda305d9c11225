// Where a gap lies and what training lacks, at the edges of what both say: exactly there, and beside it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "gap/drive/coverage.hpp"
#include "gap/drive/decide/rule.hpp"
#include "gap/drive/effect.hpp"
#include "gap/drive/outside.hpp"
#include "gap/drive/residuals/locate.hpp"
#include "gap/drive/residuals/pattern.hpp"

namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

using Function = std::function<double(double)>;

gap::Record record_of(std::size_t count, double interval_s, const Function& input, const Function& output) {
    gap::Record record;
    record.name = "made";
    record.usual_interval_s = interval_s;
    for (std::size_t i = 0; i < count; ++i) {
        const double t = interval_s * static_cast<double>(i);
        record.time_s.push_back(t);
        record.input.push_back(input(t));
        record.output.push_back(output(t));
    }
    return record;
}

double line(double t) { return t; }
std::vector<std::string> events_of(const std::vector<gap::Share>& shares) {
    std::vector<std::string> all;
    for (const gap::Share& share : shares) {
        if (all.empty() || all.back() != share.what) {
            all.push_back(share.what);
        }
    }
    return all;
}

std::vector<gap::Share> times_of(const gap::Record& record) {
    return gap::locate({record}, {std::vector<double>(record.size(), 1.0)}).time;
}

// A fiftieth of the span is a move, less is none; a rest is three samples.
TEST(LocateEdges, AMoveIsAFiftiethBetweenTwoRests) {
    const auto with_step = [](double step) {
        return times_of(record_of(
            200, 0.1, [=](double t) { return t < 5.0    ? 0.0
                                             : t < 10.0 ? 1.0
                                                        : 1.0 - step; }, line));
    };
    EXPECT_THAT(events_of(with_step(0.02)), ElementsAre("start", "input 0 -> 1", "input 1 -> 0.98"));
    EXPECT_THAT(events_of(with_step(0.0199)), ElementsAre("start", "input 0 -> 1"));
    // What jumps for two samples and comes back was no rest there.
    const auto with_pulse = [](double until) {
        return events_of(times_of(record_of(
            200, 0.1, [=](double t) { return t > 4.95 && t < until ? 1.0 : 0.0; }, line)));
    };
    EXPECT_THAT(with_pulse(5.25), ElementsAre("start", "input 0 -> 1", "input 1 -> 0"));
    EXPECT_THAT(with_pulse(5.15), ElementsAre("start", "input leaves 0"));
}

// Sixteen parts are told one by one; of more the record is cut evenly.
TEST(LocateEdges, ManyMovesAreCutEvenly) {
    const auto stairs = [](double width_s) {
        return times_of(record_of(
            1600, 0.1, [=](double t) { return std::floor((t + 1e-9) / width_s); }, line));
    };
    EXPECT_EQ(stairs(10.0).size(), 16U);
    EXPECT_EQ(stairs(10.0)[3].what, "input 2 -> 3");
    EXPECT_EQ(stairs(9.4).size(), 10U);
    EXPECT_EQ(stairs(9.4)[3].what, "");
    EXPECT_NEAR(stairs(9.4)[3].to - stairs(9.4)[3].from, 15.99, 1e-9);
}

TEST(LocateEdges, APartIsAFifthOfTheRecordAtMost) {
    // 100 s: 40 s before a step are two parts, 60 behind it three.
    const auto parts = times_of(record_of(
        1001, 0.1, [](double t) { return t < 40.0 - 1e-9 ? 0.0 : 1.0; }, line));
    ASSERT_EQ(parts.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(parts[i].from, 20.0 * static_cast<double>(i), 1e-9);
        EXPECT_NEAR(parts[i].to, 20.0 * static_cast<double>(i + 1), 1e-9);
        EXPECT_NEAR(parts[i].share, i == 4 ? 201.0 / 1001.0 : 200.0 / 1001.0, 1e-9) << i;
        EXPECT_EQ(parts[i].what, i < 2 ? "start" : "input 0 -> 1");
    }
}

// Twelve levels stand for themselves, thirteen are fifths. Those within a two-hundredth of the span are one.
TEST(LocateEdges, LevelsAreFewOrFifths) {
    const auto levels = [](int count, double jitter) {
        const gap::Record record = record_of(
            390, 0.1,
            [=](double t) {
                const int step = static_cast<int>(std::lround(t / 0.1));
                return static_cast<double>(step % count) + jitter * (step / count % 2);
            },
            line);
        return gap::locate({record}, {std::vector<double>(record.size(), 1.0)}).input_level;
    };
    EXPECT_EQ(levels(12, 0.0).size(), 12U);
    EXPECT_EQ(levels(13, 0.0).size(), 5U);
    const auto near = levels(5, 0.019);  // of a span of 4.019
    ASSERT_EQ(near.size(), 5U);
    EXPECT_EQ(near[1].from, 1.0);
    EXPECT_NEAR(near[1].to, 1.019, 1e-12);
    EXPECT_NEAR(near[1].share, 0.2, 1e-12);
    EXPECT_EQ(levels(5, 0.03).size(), 10U);
    EXPECT_EQ(levels(1, 0.0).size(), 1U);
    EXPECT_EQ(levels(1, 0.0)[0].share, 1.0);
    const auto fifths = levels(13, 0.0);
    EXPECT_NEAR(fifths[1].from, 2.4, 1e-12);
    EXPECT_NEAR(fifths[1].to, 4.8, 1e-12);
    EXPECT_NEAR(fifths[1].share, 2.0 / 13.0, 1e-12);  // 3 and 4
}

// Over a fiftieth of the record the output moves by a hundredth of its range, or it is still.
TEST(LocateEdges, StillIsAHundredthOfTheRange) {
    // 1000 samples: ten to either side. Up by 1, then by `slope` per sample.
    const auto where = [](double slope, double level = 0.0) {
        const gap::Record record = record_of(
            1000, 1.0, [](double) { return 0.0; },
            [=](double t) {
                return level + (t < 200.0 ? t / 200.0 : t < 700.0 ? 1.0 - slope * (t - 200.0) : 1.0 - slope * 500.0);
            });
        return gap::locate({record}, {std::vector<double>(record.size(), 1.0)});
    };
    const gap::Where falls = where(0.000505);
    EXPECT_NEAR(falls.rising, 0.2, 0.02);
    EXPECT_NEAR(falls.falling, 0.5, 0.02);
    EXPECT_NEAR(falls.still, 0.3, 0.03);
    EXPECT_NEAR(where(0.000505, 5.0).falling, 0.5, 0.02);  // wherever it lies
    EXPECT_NEAR(where(0.000495).falling, 0.0, 1e-12);
    EXPECT_NEAR(where(0.000495).still, 0.8, 0.03);
}

// --- What is left.

// A fifth of the squared gap that can be closed is a rest; what is less is minor.
TEST(RemainderEdges, AFifthIsNotMinor) {
    gap::Foreseeable rest;
    rest.of_closable = 0.2;
    EXPECT_FALSE(rest.is_minor());
    rest.of_closable = 0.1999;
    EXPECT_TRUE(rest.is_minor());
}

// --- What training lacks.

std::vector<std::string> lacks(const Function& known, const Function& asked) {
    const Function held = [](double) { return 1.0; };
    return gap::extrapolated({record_of(1000, 0.1, held, known)}, {record_of(1000, 0.1, held, asked)});
}

// Readings that were lost for once are no motion, two in a row neither: medians of five.
TEST(CoverageEdges, WhatAReadingWasLostForIsNoDirection) {
    const Function rises = [](double t) { return t / 100.0; };
    const auto spoilt = [&](double by, int readings, double sign) {
        return [=](double t) { return sign * (t > 49.95 && t < 49.95 + 0.1 * readings ? t / 100.0 + by : t / 100.0); };
    };
    for (const double by : {0.8, -0.8}) {
        for (const int readings : {1, 2}) {
            EXPECT_THAT(lacks(rises, spoilt(by, readings, 1.0)), Not(Contains("falling output"))) << by << readings;
            EXPECT_THAT(lacks(spoilt(0.0, 0, -1.0), spoilt(by, readings, -1.0)), Not(Contains("rising output")))
                << by << readings;
        }
        EXPECT_THAT(lacks(rises, spoilt(by, 3, 1.0)), Contains("falling output")) << by;
    }
}

TEST(CoverageEdges, AStretchIsThirtyTwoSamples) {
    const gap::Record record = record_of(100, 0.1, line, line);
    std::vector<char> counts(100, 0);
    std::fill(counts.begin() + 5, counts.begin() + 37, char{1});
    std::fill(counts.begin() + 50, counts.begin() + 81, char{1});
    const auto stretches = gap::counted_stretches({record}, {counts});
    ASSERT_EQ(stretches.size(), 1U);
    EXPECT_EQ(stretches[0].size(), 32U);
    EXPECT_EQ(stretches[0].input.front(), record.input[5]);
    EXPECT_EQ(stretches[0].output.back(), record.output[36]);
    EXPECT_EQ(stretches[0].usual_interval_s, 0.1);
    EXPECT_EQ(stretches[0].name, "made");
}

// A band holds a fiftieth of the variance to be there, and lacks where training has a twentieth of that.
TEST(CoverageEdges, ABandIsThereOrLacks) {
    const auto waves = [](double fast) {
        return [=](double t) {
            return std::sin(2.0 * std::numbers::pi * 0.05 * t) + fast * std::sin(2.0 * std::numbers::pi * 2.0 * t);
        };
    };
    const double there = std::sqrt(0.02 / 0.98);
    EXPECT_THAT(lacks(waves(0.0), waves(1.003 * there)), Contains(StartsWith("faster than ")));
    EXPECT_THAT(lacks(waves(0.0), waves(0.997 * there)), Not(Contains(StartsWith("faster than "))));
    // The level that an output rests at is no part of its variance.
    const auto raised = [&](double fast) { return [=](double t) { return 100.0 + waves(fast)(t); }; };
    EXPECT_THAT(lacks(raised(0.0), raised(1.003 * there)), Contains(StartsWith("faster than ")));
    EXPECT_THAT(lacks(waves(std::sqrt(0.0502)), waves(1.0)), Not(Contains(StartsWith("faster than "))));
    EXPECT_THAT(lacks(waves(std::sqrt(0.0498)), waves(1.0)), Contains(StartsWith("faster than ")));
    // Bands are half-decades above 0.9 periods in the record: the fourth edge lies at 0.9009 Hz.
    const auto two = [](double slow, double fast) {
        return [=](double t) {
            return std::sin(2.0 * std::numbers::pi * slow * t) + std::sin(2.0 * std::numbers::pi * fast * t);
        };
    };
    EXPECT_THAT(lacks(two(0.5, 0.5), two(0.5, 0.91)), Contains("faster than 0.9 Hz"));
    EXPECT_THAT(lacks(two(0.5, 0.5), two(0.5, 0.88)), Not(Contains(StartsWith("faster than "))));
}

// --- Events.

TEST(OutsideEdges, AMoveIsThreeHundredthsOfTheGreatestInput) {
    const auto chance = [](double step) {
        const gap::Record record = record_of(
            1001, 0.01, [=](double t) { return t < 2.0 - 1e-9   ? 1.0
                                               : t < 7.0 - 1e-9 ? 1.0 - step
                                                                : 0.0; }, line);
        return gap::chance_of_meeting(record, 2.1, 0.0);
    };
    // Moves at 0, 2 and 7: within 0.1 of them lie 0.1 + 0.2 + 0.2 of 10 s.
    EXPECT_NEAR(chance(0.031), 0.05, 1e-9);
    // Without that at 2: 2.1 from the first.
    EXPECT_NEAR(chance(0.029), (2.1 + 4.2) / 10.0, 1e-9);
}

TEST(OutsideEdges, TheEndIsTheLastFiftieth) {
    const gap::Record record = record_of(
        1001, 0.01, [](double t) { return t < 2.0 - 1e-9 ? 0.0 : 1.0; }, line);
    EXPECT_TRUE(gap::lasts_throughout(record, {2.0, 9.81}, 1.0));
    EXPECT_FALSE(gap::lasts_throughout(record, {2.0, 9.79}, 1.0));
    EXPECT_TRUE(gap::lasts_throughout(record, {2.99, 10.0}, 1.0));
    EXPECT_FALSE(gap::lasts_throughout(record, {3.01, 10.0}, 1.0));
    const gap::Record still = record_of(
        1001, 0.01, [](double) { return 0.0; }, line);
    EXPECT_TRUE(gap::lasts_throughout(still, {0.9, 10.0}, 1.0));  // from the begin, where nothing moves
    EXPECT_FALSE(gap::lasts_throughout(still, {1.0, 10.0}, 1.0));
    EXPECT_FALSE(gap::lasts_throughout(still, {1.1, 10.0}, 1.0));
}

// --- Patterns.

// Ten samples at least; eight stretches.
TEST(PatternEdges, AStretchHasTenSamplesAndThereAreEight) {
    const auto ratio = [](std::size_t count, double stretch_s) {
        const gap::Record record = record_of(count, 0.1, line, line);
        std::vector<double> residuals(count, 1.0);
        for (std::size_t i = 20; i < 30; ++i) {
            residuals[i] = 10.0;
        }
        return gap::loudest_burst(record, residuals, std::vector<char>(count, 1), stretch_s, 0.0).ratio;
    };
    EXPECT_NEAR(ratio(80, 0.1), 100.0, 1e-9);
    EXPECT_EQ(ratio(79, 0.1), 0.0);
    EXPECT_NEAR(ratio(240, 3.0), 1.0 + 99.0 / 3.0, 1e-9);  // ten of thirty
}

// Whenever it was sent, before the record or beyond its last interval, an input that never moves arrives as it is.
TEST(EffectInputs, ThatNeverMoveArriveAsTheyAreAtWhateverDelay) {
    for (const double depth_s : {0.4, -0.4}) {
        gap::Scenario scenario;
        scenario.model.delay_s = 0.5;
        scenario.input_before = 0.75;
        gap::effect_named("variable_delay").add_to(scenario, std::vector{depth_s, 0.7, 0.3});
        std::vector<double> held(40, 0.75);
        scenario.input.at(0)(held, gap::Grid{0.0, 0.1, 40});
        for (std::size_t k = 0; k < held.size(); ++k) {
            EXPECT_NEAR(held[k], 0.75, 1e-9) << depth_s << ' ' << k;
        }
    }
}

}  // namespace
