// Where a gap lies, counted by hand: samples of parts, lines of bands, readings of levels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "gap/drive/residuals/locate.hpp"

namespace {

using Of = std::function<double(std::size_t sample)>;

gap::Record record_of(std::size_t count, double interval_s, const Of& input, const Of& output = nullptr,
                      double first_s = 0.0) {
    gap::Record record;
    record.name = "made";
    record.usual_interval_s = interval_s;
    for (std::size_t i = 0; i < count; ++i) {
        record.time_s.push_back(first_s + interval_s * static_cast<double>(i));
        record.input.push_back(input(i));
        record.output.push_back(output ? output(i) : static_cast<double>(i));
    }
    return record;
}

double none(std::size_t) { return 0.0; }

std::vector<double> ones(const gap::Record& record) { return std::vector<double>(record.size(), 1.0); }

std::vector<double> wave(std::size_t count, double periods, double amplitude) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
        values.push_back(amplitude * std::sin(2.0 * std::numbers::pi * periods * static_cast<double>(i) /
                                              static_cast<double>(count)));
    }
    return values;
}

void expect_parts(const std::vector<gap::Share>& parts, const std::vector<double>& edges_s,
                  const std::vector<int>& samples, const std::vector<std::string>& what) {
    ASSERT_EQ(parts.size(), samples.size());
    double all = 0.0;
    for (const int part : samples) {
        all += part;
    }
    for (std::size_t p = 0; p < parts.size(); ++p) {
        EXPECT_NEAR(parts[p].from, edges_s[p], 1e-9) << p;
        EXPECT_NEAR(parts[p].to, edges_s[p + 1], 1e-9) << p;
        EXPECT_NEAR(parts[p].share, samples[p] / all, 1e-12) << p;
        EXPECT_EQ(parts[p].what, what[p]) << p;
    }
}

// 100 s in eighths of a second, from 4 s on. A stretch of a fifth of it is one part, a longer one is two.
TEST(LocateByHand, PartsAreOfStretchesInFifths) {
    // 0 for 20 s, then 1 for 40.125 s, a half for 20.125 s and a quarter for 19.75 s.
    const gap::Record record = record_of(
        801, 0.125, [](std::size_t i) { return i < 160   ? 0.0
                                               : i < 481 ? 1.0
                                               : i < 642 ? 0.5
                                                         : 0.25; }, nullptr, 4.0);
    const gap::Where where = gap::locate({record}, {ones(record)});
    const std::string up = "input 0 -> 1";
    const std::string down = "input 1 -> 0.5";
    expect_parts(where.time, {4.0, 24.0, 37.375, 50.75, 64.125, 74.1875, 84.25, 104.0},
                 {160, 107, 107, 107, 81, 80, 159}, {"start", up, up, up, down, down, "input 0.5 -> 0.25"});
}

// What moves with the last sample is a part of that sample.
TEST(LocateByHand, AMoveAtTheEndIsItsSamplesPart) {
    const gap::Record record = record_of(201, 0.5, [](std::size_t i) { return i < 200 ? 0.0 : 1.0; });
    const gap::Where where = gap::locate({record}, {ones(record)});
    ASSERT_EQ(where.time.size(), 6U);
    EXPECT_EQ(where.time.back().what, "input leaves 0");
    EXPECT_EQ(where.time.back().from, 100.0);
    EXPECT_EQ(where.time.back().to, 100.0);
    EXPECT_NEAR(where.time.back().share, 1.0 / 201.0, 1e-12);
    EXPECT_NEAR(where.time[4].share, 40.0 / 201.0, 1e-12);
}

// Tenths, whatever is rounded, where nothing moves: the last one has the last stamp, too.
TEST(LocateByHand, TenthsAreTenWhateverTheLength) {
    for (const double interval_s : {0.5, 0.01, 0.07, 0.3, 0.7, 1.1}) {
        const gap::Record record = record_of(201, interval_s, none);
        const gap::Where where = gap::locate({record}, {ones(record)});
        ASSERT_EQ(where.time.size(), 10U) << interval_s;
        for (std::size_t p = 0; p < 10; ++p) {
            EXPECT_NEAR(where.time[p].from, 20.0 * interval_s * static_cast<double>(p), 1e-9);
            // A stamp that is an edge is on either side of it, as it is rounded.
            EXPECT_NEAR(where.time[p].share, 20.0 / 201.0, 1.01 / 201.0);
        }
        EXPECT_EQ(where.time.back().to, record.time_s.back());
    }
}

// A rest is three samples, or a two-hundredth of the record: three of 799, four of 800.
TEST(LocateByHand, ARestIsATwoHundredth) {
    const auto moves = [](std::size_t count, std::size_t at_one) {
        const gap::Record record = record_of(count, 1.0, [&](std::size_t i) {
            return i < 100 ? 0.0 : i < 100 + at_one ? 1.0 : 0.5;
        });
        return gap::locate({record}, {ones(record)}).time;
    };
    const auto has = [](const std::vector<gap::Share>& parts, const std::string& what) {
        for (const gap::Share& part : parts) {
            if (part.what == what) {
                return true;
            }
        }
        return false;
    };
    for (const auto& [count, fewest] :
         {std::pair(std::size_t{300}, std::size_t{3}), std::pair(std::size_t{799}, std::size_t{3}),
          std::pair(std::size_t{800}, std::size_t{4}), std::pair(std::size_t{1000}, std::size_t{5})}) {
        EXPECT_TRUE(has(moves(count, fewest), "input 1 -> 0.5")) << count;
        EXPECT_TRUE(has(moves(count, fewest - 1), "input 0 -> 0.5")) << count;
        EXPECT_FALSE(has(moves(count, fewest - 1), "input 1 -> 0.5")) << count;
    }
}

// A fiftieth of the span is a move, wherever the input lies.
TEST(LocateByHand, AMoveIsAFiftiethOfTheSpan) {
    const auto last = [](double step) {
        const gap::Record record = record_of(400, 1.0, [&](std::size_t i) {
            return i < 100 ? 0.5 : i < 200 ? -0.5 : i < 300 ? 0.0 : step;
        });
        return gap::locate({record}, {ones(record)}).time.back().what;
    };
    EXPECT_EQ(last(0.02), "input 0 -> 0.02");
    EXPECT_EQ(last(0.0201), "input 0 -> 0.0201");
    EXPECT_EQ(last(0.0199), "input -0.5 -> 0");
    EXPECT_EQ(last(-0.0201), "input 0 -> -0.0201");
    EXPECT_EQ(last(-0.0199), "input -0.5 -> 0");
}

// --- Bands.

// From a period in the record to half the rate, the edges evenly spaced by their logarithms.
void expect_edges(const std::vector<gap::Record>& records, double lowest_hz, double highest_hz, std::size_t bands) {
    std::vector<std::vector<double>> residuals;
    for (const gap::Record& record : records) {
        residuals.push_back(ones(record));
    }
    const auto found = gap::locate(records, residuals).frequency;
    ASSERT_EQ(found.size(), bands + 1);
    EXPECT_EQ(found[0].from, 0.0);
    for (std::size_t b = 0; b <= bands; ++b) {
        const double edge_hz =
            lowest_hz * std::pow(highest_hz / lowest_hz, static_cast<double>(b) / static_cast<double>(bands));
        EXPECT_NEAR(found[b].to, edge_hz, 1e-6 * edge_hz) << b;
        if (b > 0) {
            EXPECT_EQ(found[b].from, found[b - 1].to);
        }
    }
}

TEST(LocateByHand, BandsAreAboutHalfDecades) {
    // Twice the logarithm of 55.5 is 3.49, that of 56.5 is 3.50.
    expect_edges({record_of(111, 0.25, none)}, 4.0 / 111.0, 2.0, 3);
    expect_edges({record_of(113, 0.25, none, nullptr, 5.0)}, 4.0 / 113.0, 2.0, 4);
    // Of several the lowest of the one and the highest of the other: twice the logarithm of 5000 is 7.4.
    const std::vector<gap::Record> both{record_of(200, 0.01, none), record_of(100, 1.0, none)};
    expect_edges(both, 0.01, 50.0, 7);
    expect_edges({both[1], both[0]}, 0.01, 50.0, 7);
}

// Lines of 200 samples: 0, 1 to 3, 4 to 9, 10 to 31 and 32 to 100. All but the first and the last stand there twice.
TEST(LocateByHand, NoGapHasAsMuchOfEachFrequency) {
    const gap::Record record = record_of(200, 0.01, none);
    const auto bands = gap::locate({record}, {std::vector<double>(200, 0.0)}).frequency;
    ASSERT_EQ(bands.size(), 5U);
    const double lines[] = {1.0, 6.0, 12.0, 44.0, 137.0};
    for (std::size_t b = 0; b < 5; ++b) {
        EXPECT_NEAR(bands[b].share, lines[b] / 200.0, 1e-9) << b;
    }
}

// The constant has one line of 200 samples and one of 100.
TEST(LocateByHand, NoGapOfSeveralRecordsIsSharedOutBySamples) {
    const std::vector<gap::Record> both{record_of(200, 0.01, none), record_of(100, 0.01, none)};
    const gap::Where where = gap::locate(both, {std::vector<double>(200, 0.0), std::vector<double>(100, 0.0)});
    EXPECT_NEAR(where.frequency.front().share, 2.0 / 300.0, 1e-12);
    EXPECT_EQ(where.time.front().what, "made");
    EXPECT_NEAR(where.time.front().share, 20.0 / 300.0, 1e-12);
}

// All of a gap is in the record that has it, however small it is in the readings' units.
TEST(LocateByHand, ARecordWithoutAGapAddsNothingToThatOfAnother) {
    const std::vector<gap::Record> both{record_of(200, 0.01, none), record_of(100, 0.01, none)};
    for (const double amplitude : {1e-6, 1.0, 1e3}) {
        const gap::Where where = gap::locate(both, {wave(200, 40.0, amplitude), std::vector<double>(100, 0.0)});
        double at_its_frequency = 0.0;
        for (const gap::Share& band : where.frequency) {
            at_its_frequency += band.from <= 20.0 && 20.0 < band.to ? band.share : 0.0;
        }
        EXPECT_NEAR(at_its_frequency, 1.0, 1e-9) << amplitude;
    }
}

// What turns from sample to sample is of the highest band, at its end.
TEST(LocateByHand, HalfTheRateIsOfTheHighestBand) {
    const gap::Record record = record_of(200, 0.01, none);
    std::vector<double> turning;
    for (int i = 0; i < 200; ++i) {
        turning.push_back(i % 2 == 0 ? 0.5 : -0.5);
    }
    EXPECT_NEAR(gap::locate({record}, {turning}).frequency.back().share, 1.0, 1e-12);
}

// Of several records squares add up, whatever their rates: 100 of the one at 20 Hz, 200 of the other at 0.1 Hz.
TEST(LocateByHand, RecordsHaveTheSharesOfTheirSquares) {
    const std::vector<gap::Record> both{record_of(200, 0.01, none), record_of(100, 1.0, none)};
    const auto bands = gap::locate(both, {wave(200, 40.0, 1.0), wave(100, 10.0, 2.0)}).frequency;
    double slow = 0.0;
    double fast = 0.0;
    for (const gap::Share& band : bands) {
        slow += band.from <= 0.1 && 0.1 < band.to ? band.share : 0.0;
        fast += band.from <= 20.0 && 20.0 < band.to ? band.share : 0.0;
    }
    EXPECT_NEAR(slow, 2.0 / 3.0, 1e-9);
    EXPECT_NEAR(fast, 1.0 / 3.0, 1e-9);
}

// --- Levels.

// Within a two-hundredth of the span readings are at one level, which goes as far as they do.
TEST(LocateByHand, ReadingsWithinATwoHundredthAreOneLevel) {
    const auto levels = [](double second) {
        const gap::Record record = record_of(40, 1.0, [&](std::size_t i) {
            return i < 10 ? -1.0 : i < 20 ? second : i < 35 ? 99.0 : 50.0;
        });
        return gap::locate({record}, {ones(record)}).input_level;
    };
    const auto one = levels(-0.5);  // a half of 100, and no more
    ASSERT_EQ(one.size(), 3U);
    EXPECT_EQ(one[0].from, -1.0);
    EXPECT_EQ(one[0].to, -0.5);
    EXPECT_NEAR(one[0].share, 20.0 / 40.0, 1e-12);
    EXPECT_NEAR(one[1].share, 5.0 / 40.0, 1e-12);
    EXPECT_EQ(levels(-0.5025).size(), 3U);
    const auto two = levels(-0.4975);
    ASSERT_EQ(two.size(), 4U);
    EXPECT_EQ(two[0].to, -1.0);
    EXPECT_EQ(two[1].from, -0.4975);
    EXPECT_NEAR(two[1].share, 10.0 / 40.0, 1e-12);
}

// 21 levels from 10 to 30: four to a fifth, and the last of them has its end.
TEST(LocateByHand, ManyLevelsAreFifthsOfTheSpan) {
    const gap::Record record = record_of(210, 1.0, [](std::size_t i) { return 10.0 + static_cast<double>(i % 21); });
    const auto fifths = gap::locate({record}, {ones(record)}).input_level;
    ASSERT_EQ(fifths.size(), 5U);
    for (std::size_t f = 0; f < 5; ++f) {
        EXPECT_EQ(fifths[f].from, 10.0 + 4.0 * static_cast<double>(f));
        EXPECT_EQ(fifths[f].to, 14.0 + 4.0 * static_cast<double>(f));
        EXPECT_NEAR(fifths[f].share, (f == 4 ? 5.0 : 4.0) / 21.0, 1e-12) << f;
    }
}

TEST(LocateByHand, WhatNeverMovesIsOneLevel) {
    const gap::Record record = record_of(
        40, 1.0, [](std::size_t) { return 0.75; }, [](std::size_t) { return -2.0; });
    const gap::Where where = gap::locate({record}, {ones(record)});
    ASSERT_EQ(where.input_level.size(), 1U);
    EXPECT_EQ(where.input_level[0].from, 0.75);
    EXPECT_EQ(where.input_level[0].to, 0.75);
    ASSERT_EQ(where.output_level.size(), 1U);
    EXPECT_EQ(where.output_level[0].from, -2.0);
    EXPECT_EQ(where.output_level[0].share, 1.0);
}

// --- Directions.

// Up by one a sample to 199 and down again: over four samples to either side the output comes back about the top.
TEST(LocateByHand, DirectionsAreCountedSampleBySample) {
    for (const double level : {-50.0, 0.0, 50.0}) {
        const gap::Record record = record_of(
            400, 1.0, none, [&](std::size_t i) { return level + static_cast<double>(i < 200 ? i : 399 - i); });
        const gap::Where where = gap::locate({record}, {ones(record)});
        EXPECT_NEAR(where.rising, 199.0 / 400.0, 1e-12);
        EXPECT_NEAR(where.still, 2.0 / 400.0, 1e-12);
        EXPECT_NEAR(where.falling, 199.0 / 400.0, 1e-12);
    }
}

TEST(LocateByHand, WhatNeverMovesIsStill) {
    const auto rests = [](std::size_t i) { return i < 20 ? static_cast<double>(i) : 19.0; };
    for (const gap::Record& record :
         {record_of(40, 1.0, none, [](std::size_t) { return -2.0; }), record_of(60, 1.0, none, rests)}) {
        std::vector<char> counts(record.size(), 0);
        std::fill(counts.end() - 40, counts.end(), char{1});
        const gap::Where where = gap::locate({record}, {ones(record)}, {counts});
        EXPECT_EQ(where.still, 1.0);
        EXPECT_EQ(where.rising, 0.0);
        EXPECT_EQ(where.falling, 0.0);
    }
}

// In a record of less than 200 samples it is one to either side. The output moves evenly, and at last jumps to 100.
TEST(LocateByHand, ShortRecordsLookASampleToEitherSide) {
    for (const std::size_t count : {std::size_t{50}, std::size_t{99}, std::size_t{150}, std::size_t{199}}) {
        for (const double sign : {1.0, -1.0}) {
            const auto still_at = [&](std::size_t at, double by_sample) {
                const gap::Record record = record_of(count, 1.0, none, [&](std::size_t i) {
                    return sign * (i + 1 == count ? 100.0 : by_sample * static_cast<double>(i));
                });
                std::vector<double> residuals(count, 0.0);
                residuals[at] = 2.0;
                const gap::Where where = gap::locate({record}, {residuals});
                EXPECT_EQ(where.still + (sign > 0.0 ? where.rising : where.falling), 1.0) << count << ' ' << at;
                return where.still == 1.0;
            };
            EXPECT_TRUE(still_at(20, 0.4)) << count;
            EXPECT_FALSE(still_at(20, 0.51)) << count;
            // At the ends it is what lies on one side.
            EXPECT_TRUE(still_at(0, 0.5)) << count;
            EXPECT_FALSE(still_at(count - 1, 0.0)) << count;
            EXPECT_FALSE(still_at(count - 2, 0.0)) << count;
            EXPECT_TRUE(still_at(count - 3, 0.0)) << count;
        }
    }
}

// --- What counts, and names.

// One stretch of 32 samples is cut out; one of 31 stays in its record, where the rest is nothing.
TEST(LocateByHand, AStretchIsCutOutFromThirtyTwoSamples) {
    const gap::Record record = record_of(40, 1.0, [](std::size_t i) { return i < 20 ? 0.0 : 1.0; });
    for (const std::size_t length : {std::size_t{31}, std::size_t{32}}) {
        std::vector<char> counts(40, 0);
        std::fill_n(counts.begin() + 4, length, char{1});
        const gap::Where where = gap::locate({record}, {ones(record)}, {counts});
        EXPECT_EQ(where.time.front().from, length == 32 ? 4.0 : 0.0);
        EXPECT_EQ(where.time.back().to, length == 32 ? 35.0 : 39.0);
        EXPECT_NEAR(where.input_level.front().share, 16.0 / static_cast<double>(length), 1e-12);
        // The line is cut with it: its levels begin where it does.
        EXPECT_EQ(where.output_level.front().from, length == 32 ? 4.0 : 0.0);
    }
    // Of two stretches none is.
    std::vector<char> two(40, 1);
    two[36] = 0;
    EXPECT_EQ(gap::locate({record}, {ones(record)}, {two}).time.back().to, 39.0);
}

TEST(LocateByHand, SeveralRecordsAreNamedWithoutTheirFolders) {
    gap::Record first = record_of(50, 1.0, none);
    gap::Record second = record_of(60, 1.0, [](std::size_t i) { return i < 30 ? 0.0 : 1.0; });
    first.name = "logs/of/first.csv";
    second.name = "second.csv";
    const auto parts = gap::locate({first, second}, {ones(first), ones(second)}).time;
    ASSERT_GT(parts.size(), 12U);
    EXPECT_EQ(parts[0].what, "first.csv");
    EXPECT_EQ(parts[9].what, "first.csv");
    EXPECT_EQ(parts[10].what, "second.csv: start");
    EXPECT_EQ(parts.back().what, "second.csv: input 0 -> 1");
    // Alone it has no name.
    EXPECT_EQ(gap::locate({second}, {ones(second)}).time[0].what, "start");
}

}  // namespace
