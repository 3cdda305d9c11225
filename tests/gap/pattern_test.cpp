// Bursts and waves stand out of noise of any colour, and noise has none.
#include "gap/drive/residuals/pattern.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <vector>

namespace {

constexpr double interval_s = 0.01;
constexpr std::size_t samples = 4000;

gap::Record record_of() {
    gap::Record record;
    for (std::size_t i = 0; i < samples; ++i) {
        record.time_s.push_back(interval_s * static_cast<double>(i));
    }
    record.usual_interval_s = interval_s;
    return record;
}

std::vector<double> noise(double colour, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    std::vector<double> values;
    double state = normal(engine);
    for (std::size_t i = 0; i < samples; ++i) {
        values.push_back(state);
        state = colour * state + std::sqrt(1.0 - colour * colour) * normal(engine);
    }
    return values;
}

const std::vector<char> all_count(samples, 1);

TEST(Pattern, NoiseOfAnyColourHasNone) {
    for (const double colour : {0.0, 0.9, 0.97}) {
        for (unsigned seed = 1; seed <= 100; ++seed) {
            const gap::Record record = record_of();
            const std::vector<double> values = noise(colour, seed);
            EXPECT_LT(gap::loudest_burst(record, values, all_count, 0.5, 0.0).ratio, 20.0) << colour << " " << seed;
            EXPECT_LT(gap::clearest_wave(record, values).over_neighbours, 50.0) << colour << " " << seed;
        }
    }
}

TEST(Pattern, ABurstIsFoundWhereItIs) {
    const gap::Record record = record_of();
    std::vector<double> values = noise(0.0, 1);
    for (std::size_t i = 2020; i < 2040; ++i) {
        values[i] += 20.0;
    }
    const gap::Burst burst = gap::loudest_burst(record, values, all_count, 0.5, 0.0);
    EXPECT_NEAR(burst.ratio, 1.0 + 400.0 * 20.0 / 50.0, 40.0);
    EXPECT_DOUBLE_EQ(burst.at_s, 20.0);
    // What each stretch holds at least is no burst's due; a stretch that does not count whole is not looked at.
    EXPECT_NEAR(gap::loudest_burst(record, values, all_count, 0.5, 100.0).ratio, 1.61, 0.4);
    std::vector<char> counts = all_count;
    counts[2000] = 0;
    EXPECT_LT(gap::loudest_burst(record, values, counts, 0.5, 0.0).ratio, 3.0);
    // Seven stretches have no usual one.
    EXPECT_EQ(gap::loudest_burst(record, values, all_count, 5.1, 0.0).ratio, 0.0);
    values[10] = std::nan("");
    EXPECT_GT(gap::loudest_burst(record, values, all_count, 0.5, 0.0).ratio, 100.0);
}

TEST(Pattern, AWaveIsFoundByItsFrequencyAndShare) {
    const gap::Record record = record_of();
    for (const double hz : {0.3, 1.37, 20.01}) {
        std::vector<double> values = noise(0.9, 3);
        for (std::size_t i = 0; i < samples; ++i) {
            values[i] += 7.0 + 2.0 * std::sin(2.0 * std::numbers::pi * hz * record.time_s[i]);
        }
        const gap::Wave wave = gap::clearest_wave(record, values);
        EXPECT_NEAR(wave.hz, hz, 1.0 / (interval_s * samples)) << hz;
        EXPECT_NEAR(wave.share, 2.0 / 3.0, 0.07) << hz;
        EXPECT_GT(wave.over_neighbours, 300.0) << hz;
        // Elsewhere there is none; a frequency between two lines finds the nearer one.
        EXPECT_LT(gap::wave_at(record, values, hz + 0.5).over_neighbours, 50.0) << hz;
        EXPECT_EQ(gap::wave_at(record, values, hz + 0.01).over_neighbours, wave.over_neighbours) << hz;
    }
    // Half way between two lines it is as loud on both. Under von Hann's window a wave d lines away shows as
    // sin(pi d) / (pi d (1 - d^2)): five lines about it hold all but half a thousandth of its squares.
    std::vector<double> pure;
    for (const double t : record.time_s) {
        pure.push_back(std::sin(2.0 * std::numbers::pi * 100.5 / (interval_s * samples) * t));
    }
    EXPECT_NEAR(gap::clearest_wave(record, pure).share, 1.0 - 5e-4, 1e-4);
    EXPECT_EQ(gap::wave_at(record, noise(0.0, 1), 51.0).over_neighbours, 0.0);  // beyond half the sampling rate
    gap::Record brief = record;
    brief.time_s.resize(30);
    EXPECT_EQ(gap::clearest_wave(brief, std::vector<double>(30, 1.0)).over_neighbours, 0.0);
    // Six waves at least, and 15 lines beside: 22 lines are half of 42 samples.
    const auto found_in = [&](std::size_t count) {
        brief = record;
        brief.time_s.resize(count);
        return gap::clearest_wave(brief, std::span(pure).first(count)).over_neighbours > 0.0;
    };
    EXPECT_TRUE(found_in(42));
    EXPECT_FALSE(found_in(41));
}

}  // namespace
