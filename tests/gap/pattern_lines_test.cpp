// A line of the spectrum beside its neighbours: of waves under von Hann's window each line is known in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "gap/drive/residuals/pattern.hpp"

namespace {

constexpr int count = 256;
constexpr int last_line = count / 2;
constexpr double length_s = 4.0;

using Sines = std::map<int, double>;  // amplitudes by waves in the record

// 256 readings, a 64th of a second apart: sines of whole periods and an impulse of 1 in the middle, where the
// sines are 0 and the window is 1.
struct Made {
    Sines sines;
    gap::Record record;
    std::vector<double> values;
    explicit Made(Sines of) : sines(std::move(of)) {
        record.name = "made";
        record.usual_interval_s = length_s / count;
        for (int i = 0; i < count; ++i) {
            record.time_s.push_back(8.0 + record.usual_interval_s * i);
            values.push_back(i == count / 2 ? 1.0 : 0.0);
            for (const auto& [line, size] : sines) {
                values.back() += size * std::sin(2.0 * std::numbers::pi * line * i / count);
            }
        }
    }
    [[nodiscard]] double amplitude(int line) const { return sines.contains(line) ? sines.at(line) : 0.0; }
    // The window leaves half of a sine on its line, and half of that on either side, with the other sign. The impulse
    // is on each line; on the first one the mean that is taken off leaves a quarter of it, against it.
    [[nodiscard]] double square(int line) const {
        const double waves = 0.25 * count * (amplitude(line) - 0.5 * amplitude(line - 1) - 0.5 * amplitude(line + 1));
        const double impulse = line == 1 ? 0.75 : 1.0;
        return waves * waves + impulse * impulse;
    }
    // The middle one of the lines from the third to the fifteenth on a side, the higher one of two.
    [[nodiscard]] double usual(int line, int side) const {
        std::vector<double> squares;
        for (int away = 3; away <= 15; ++away) {
            if (const int other = line + side * away; other >= 1 && other <= last_line) {
                squares.push_back(square(other));
            }
        }
        std::ranges::sort(squares);
        return squares.empty() ? 0.0 : squares[squares.size() / 2];
    }
    [[nodiscard]] double over_neighbours(int line) const {
        return square(line) / std::max(usual(line, -1), usual(line, 1));
    }
    // Of five lines about it.
    [[nodiscard]] double share(int line) const {
        double own = 0.0;
        double all = 0.0;
        for (int other = 1; other <= last_line; ++other) {
            all += square(other);
            own += std::abs(other - line) <= 2 ? square(other) : 0.0;
        }
        return own / all;
    }
    [[nodiscard]] gap::Wave clearest() const { return gap::clearest_wave(record, values); }
    [[nodiscard]] gap::Wave at(double line) const { return gap::wave_at(record, values, line / length_s); }
    void expect(const gap::Wave& wave, int line) const {
        EXPECT_NEAR(wave.hz, line / length_s, 1e-12) << line;
        EXPECT_NEAR(wave.over_neighbours, over_neighbours(line), 1e-9 * over_neighbours(line)) << line;
        EXPECT_NEAR(wave.share, share(line), 1e-9) << line;
    }
};

// Side by side they add up where neighbours have opposite signs.
Sines with_block(int line, int from, int to) {
    Sines sines;
    for (int at = from; at <= to; ++at) {
        sines[at] = at % 2 == 0 ? 0.0625 : -0.0625;
    }
    sines[line] = 1.0;
    return sines;
}

TEST(PatternLines, StandOutOfTheImpulseBesideThem) {
    for (const double amplitude : {0.25, 1.0}) {
        const Made made(Sines{{40, amplitude}});
        // (64 a)^2 + 1 beside 1.
        ASSERT_NEAR(made.over_neighbours(40), 4096.0 * amplitude * amplitude + 1.0, 1e-9);
        made.expect(made.clearest(), 40);
        for (const double place : {40.0, 39.25, 39.75, 40.5, 40.75}) {
            made.expect(made.at(place), 40);
        }
        made.expect(made.at(39.0), 39);
    }
}

// The louder side is what it stands out of, be it below or above, and the middle of the thirteen lines there.
TEST(PatternLines, StandOutOfTheLouderSide) {
    for (const auto& [from, to] : {std::pair(4, 14), std::pair(10, 18), std::pair(4, 9), std::pair(4, 8)}) {
        const Made above(with_block(60, 60 + from, 60 + to));
        above.expect(above.at(60.0), 60);
        EXPECT_GT(above.usual(60, 1), 1.5);
        const Made below(with_block(60, 60 - to, 60 - from));
        below.expect(below.at(60.0), 60);
        EXPECT_GT(below.usual(60, -1), 1.5);
    }
}

// At either end of the spectrum there are fewer; what is constant is no neighbour.
TEST(PatternLines, HaveFewerNeighboursAtTheEnds) {
    for (const int line : {6, 7, 14, 15, 16, 17, 110, 113, 114, 120, 124}) {
        const Made made(Sines{{line, 1.0}});
        made.expect(made.clearest(), line);
    }
    // Twelve lines lie below the fifteenth but two, six of them louder than the impulse: the seventh is of those.
    const Made half(with_block(15, 8, 12));
    EXPECT_GT(half.usual(15, -1), 1.5);
    half.expect(half.at(15.0), 15);
}

// Six waves at least are asked for; at a given frequency fewer will do, but for none.
TEST(PatternLines, AreOfSixWaves) {
    const Made five(Sines{{5, 1.0}});
    EXPECT_GT(five.clearest().hz, 5.5 / length_s);
    five.expect(five.at(5.0), 5);
    const Made one(Sines{{1, 1.0}});
    one.expect(one.at(1.0), 1);
    one.expect(one.at(0.5), 1);
    EXPECT_EQ(one.at(0.0).over_neighbours, 0.0);
    // Half the sampling rate is the last one.
    one.expect(one.at(last_line), last_line);
    one.expect(one.at(last_line + 0.5), last_line);
    EXPECT_EQ(one.at(last_line + 1.0).over_neighbours, 0.0);
}

TEST(PatternLines, OfNothingAreNone) {
    Made made(Sines{});
    std::ranges::fill(made.values, 0.25);
    for (const gap::Wave& wave : {made.clearest(), made.at(40.0)}) {
        EXPECT_EQ(wave.over_neighbours, 0.0);
        EXPECT_EQ(wave.share, 0.0);
    }
}

// Of two bursts that are as loud the first is told, by its first stamp.
TEST(PatternBursts, TheFirstOfTheLoudestIsTold) {
    const Made made(Sines{});
    std::vector<double> values(count, 1.0);
    values[64] = values[79] = values[128] = values[143] = 5.0;
    const std::vector<char> counts(count, 1);
    // Stretches of 16 samples: (14 + 2 * 25) / 16 beside 1.
    const gap::Burst burst = gap::loudest_burst(made.record, values, counts, 0.25, 0.0);
    EXPECT_EQ(burst.ratio, 4.0);
    EXPECT_EQ(burst.at_s, 9.0);
    // What holds a sample that does not count is passed over, be it the first or the last.
    for (const std::size_t at : {std::size_t{64}, std::size_t{79}}) {
        std::vector<char> without = counts;
        without[at] = 0;
        EXPECT_EQ(gap::loudest_burst(made.record, values, without, 0.25, 0.0).at_s, 10.0);
    }
    // The least that each holds is a floor for all.
    EXPECT_EQ(gap::loudest_burst(made.record, values, counts, 0.25, 2.0).ratio, 2.0);
}

}  // namespace
