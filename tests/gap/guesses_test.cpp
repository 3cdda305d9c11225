// What guesses are made of: evenly spaced readings, sums about means, the best of a list, the wave that takes most.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "gap/drive/base/even.hpp"
#include "gap/drive/moments.hpp"
#include "gap/drive/scan.hpp"
#include "gap/drive/simulate.hpp"
#include "gap/drive/start.hpp"
#include "gap/drive/study.hpp"
#include "gap/drive/wave_guess.hpp"
#include "tests/gap/made_records.hpp"

namespace {

using testing::ElementsAre;
using Values = std::vector<double>;

TEST(Moments, AreAboutTheMeans) {
    const gap::Moments sums = gap::moments_of(Values{1.0, 2.0, 4.0}, Values{3.0, 0.0, 0.0});
    EXPECT_NEAR(sums.xx, 14.0 / 3.0, 1e-12);
    EXPECT_NEAR(sums.xy, -4.0, 1e-12);
    EXPECT_NEAR(sums.yy, 6.0, 1e-12);
}

// --- Even readings.

// A reading a second but for one that is missing, of a square: on straight lines between.
TEST(Even, IsReadByStraightLinesToItsLastStamp) {
    gap::Record record;
    record.name = "made";
    record.usual_interval_s = 1.0;
    for (int t = 10; t < 50; ++t) {
        if (t != 12) {
            record.time_s.push_back(t);
            record.output.push_back((t - 10.0) * (t - 10.0));
            record.input.push_back(t < 20 ? 1.0 : -2.0);
        }
    }
    const gap::Even even = gap::even_of(record);
    EXPECT_EQ(even.step_s, 1.0);
    EXPECT_EQ(even.length_s, 39.0);
    ASSERT_EQ(even.output.size(), 41);
    ASSERT_EQ(even.input.size(), 41);
    for (Eigen::Index k = 0; k <= 40; ++k) {
        const double at = std::min(39.0, static_cast<double>(k));
        EXPECT_NEAR(even.output(k), k == 2 ? 5.0 : at * at, 1e-9) << k;
        EXPECT_NEAR(even.input(k), k < 10 ? 1.0 : -2.0, 1e-9) << k;
    }
}

TEST(Even, OfADenseRecordHasFifteenHundredNodes) {
    const gap::Record record = gap_test::record_of(3000, gap_test::levels);
    const gap::Even even = gap::even_of(record);
    EXPECT_NEAR(even.step_s, 2.0 * gap_test::h, 1e-12);
    EXPECT_EQ(even.output.size(), 1502);  // and two behind the last stamp
}

TEST(Even, IsLateBySamples) {
    const Eigen::Vector4d values(1.0, 2.0, 3.0, 4.0);
    EXPECT_EQ(gap::late(values, 2), Eigen::Vector4d(1.0, 1.0, 1.0, 2.0));
    EXPECT_EQ(gap::late(values, 0), values);
}

// --- Guesses, of what a logger adds to the readings.

class Guesses : public testing::Test {
protected:
    Guesses() : record_(gap_test::record_of(400, [](double) { return 1.0; })), course_(record_, 1) {
        scenario_.model = gap::model_of(gap::form_of(drive::make_fopdt(2.0, 1.0, 0.0)));
    }
    gap::Clue leaving(const std::function<double(double)>& residual) {
        residuals_.clear();
        for (const double t : record_.time_s) {
            residuals_.push_back(residual(t));
        }
        return {course_, scenario_, residuals_, scales_};
    }
    static void add(gap::Scenario& scenario, const std::function<double(double)>& to_reading) {
        scenario.logger.emplace_back([to_reading](std::span<double> reading, const gap::Record& record) {
            for (std::size_t i = 0; i < reading.size(); ++i) {
                reading[i] += to_reading(record.time_s[i]);
            }
        });
    }
    static void add_waves(gap::Scenario& scenario, const gap::WaveGuess& wave) {
        add(scenario, [wave](double t) { return wave.size * std::sin(wave.rate * t + wave.phase_rad); });
    }

    gap::Record record_;
    gap::Course course_;
    gap::Scenario scenario_;
    gap::Scales scales_{};
    Values residuals_;
};

TEST_F(Guesses, OfAWaveAreItsSizeRateAndPhase) {
    for (const double phase : {0.4, -2.0, 3.0}) {
        const gap::Clue clue =
            leaving([&](double t) { return 0.7 * std::sin(2.0 * t + phase) + 0.2 * std::sin(5.0 * t); });
        const gap::WaveGuess wave = gap::guess_wave(clue, Values{0.9, 2.0, 5.0}, 1e-3, add_waves);
        EXPECT_EQ(wave.rate, 2.0);
        EXPECT_NEAR(wave.size, 0.7, 0.02);
        EXPECT_NEAR(wave.phase_rad, phase, 0.03);
    }
    // As far as the readings go with the size: exact of one wave alone, whatever else the scenario has.
    add(scenario_, [](double) { return 3.0; });
    const gap::WaveGuess alone =
        gap::guess_wave(leaving([](double t) { return 0.7 * std::sin(2.0 * t + 1.0); }), Values{2.0}, 1e-3, add_waves);
    EXPECT_NEAR(alone.size, 0.7, 1e-9);
    EXPECT_NEAR(alone.phase_rad, 1.0, 1e-9);
}

// A wave of which sine and cosine do the same has no phase: a rate of 0, whose sine is none.
TEST_F(Guesses, OfAWaveLeaveOutWhatHasNoPhase) {
    const gap::WaveGuess none = gap::guess_wave(leaving([](double) { return 1.0; }), Values{0.0}, 1e-3, add_waves);
    EXPECT_EQ(none.size, 0.0);
    EXPECT_EQ(none.rate, 0.0);
}

TEST_F(Guesses, OfAListAreTheOneThatLeavesLeast) {
    const auto offset = [](gap::Scenario& scenario, std::span<const double> values) {
        add(scenario, [by = values[0]](double) { return by; });
    };
    const std::vector<Values> list{{0.1}, {0.3}, {-0.3}, {0.5}};
    EXPECT_THAT(gap::best_of(leaving([](double) { return 0.32; }), list, offset), ElementsAre(0.3));
    EXPECT_THAT(gap::best_of(leaving([](double) { return -9.0; }), list, offset), ElementsAre(-0.3));
    // Beside what the scenario has already.
    add(scenario_, [](double) { return 3.0; });
    EXPECT_THAT(gap::best_of(leaving([](double) { return 0.12; }), list, offset), ElementsAre(0.1));
    // The first where nothing tells.
    EXPECT_THAT(gap::best_of(leaving([](double) { return std::numeric_limits<double>::quiet_NaN(); }), list, offset),
                ElementsAre(0.1));
}

}  // namespace
