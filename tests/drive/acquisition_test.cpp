// What the acquisition of blind cases makes of a reading, its noise, and the draws of chance.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "drive/stand/blind/family.hpp"
#include "drive/stand/blind/mechanical.hpp"
#include "drive/stand/blind/series.hpp"
#include "tests/drive/seen.hpp"

namespace {

namespace blind = stand::blind;
using stand::Chance;
using test::expect_between;
using test::Seen;

blind::Moved readings(std::size_t count) {
    blind::Moved moved;
    for (std::size_t k = 0; k < count; ++k) {
        moved.at_s.push_back(0.01 * static_cast<double>(k));
        moved.z.push_back(0.001 * static_cast<double>(k) - 1.0);
    }
    return moved;
}

TEST(Acquisition, AddsWhatItsSensorDoes) {
    const blind::Moved moved = readings(2001);
    const auto acquired = [&](const std::function<void(blind::Setup&)>& change, const std::vector<double>& noise = {}) {
        blind::Setup setup;
        setup.stand = blind::no_effects();
        change(setup);
        return blind::acquire(setup, moved, noise, 1);
    };
    const auto plain = acquired([](blind::Setup&) {});
    EXPECT_EQ(plain, moved.z);
    const auto shifted = acquired(
        [](blind::Setup& s) {
            s.stand.offset_rad = 0.25;
            s.stand.drift_rad_per_s = 0.125;
        },
        std::vector<double>(2001, 0.5));
    const auto limited = acquired([](blind::Setup& s) { s.stand.sensor_limit_rad = 0.7; });
    const auto counted = acquired([](blind::Setup& s) { s.stand.encoder_step_rad = 0.05; });
    const auto missed = acquired([](blind::Setup& s) {
        s.missed_at_s = 10.0;
        s.missed_size = -0.3;
    });
    for (std::size_t k = 0; k < moved.z.size(); ++k) {
        EXPECT_NEAR(shifted[k], moved.z[k] + 0.75 + 0.125 * moved.at_s[k], 1e-12);
        EXPECT_EQ(limited[k], std::clamp(moved.z[k], -0.7, 0.7));
        EXPECT_NEAR(counted[k], 0.05 * std::round(moved.z[k] / 0.05), 1e-12);
        EXPECT_NEAR(missed[k], moved.z[k] - (moved.at_s[k] >= 10.0 ? 0.3 : 0.0), 1e-12);
    }
}

// Lengths of stretches in which a reading that never rests is held.
std::vector<std::size_t> stretches_of(const std::vector<double>& z) {
    std::vector<std::size_t> lengths;
    std::size_t length = 0;
    for (std::size_t k = 1; k < z.size(); ++k) {
        if (z[k] == z[k - 1]) {
            ++length;
        } else if (length > 0) {
            lengths.push_back(std::exchange(length, 0));
        }
    }
    return lengths;
}

void expect_stretches(const std::vector<double>& z, double rate, double within) {
    const auto lengths = stretches_of(z);
    std::size_t held = 0;
    std::size_t single = 0;  // of 5 to 25; two may follow one another
    std::size_t longest = 0;
    for (const std::size_t length : lengths) {
        held += length;
        EXPECT_GE(length, 5U);
        single += length <= 25 ? 1 : 0;
        longest = std::max(longest, length <= 25 ? length : 0);
    }
    EXPECT_EQ(*std::min_element(lengths.begin(), lengths.end()), 5U);
    EXPECT_EQ(longest, 25U);
    EXPECT_GE(10 * single, 9 * lengths.size());
    EXPECT_NEAR(static_cast<double>(held) / static_cast<double>(z.size()), rate, within);
}

TEST(Acquisition, HoldsSamplesInStretches) {
    const blind::Moved moved = readings(200'000);
    for (const double rate : {0.1, 0.3}) {
        blind::Setup setup;
        setup.stand = blind::no_effects();
        setup.stand.dropped_rate = rate;
        expect_stretches(blind::acquire(setup, moved, {}, 3), rate, 0.01);
    }
}

TEST(Acquisition, OfOvensAndTanksIsTheSame) {
    for (const blind::Family* family : {&blind::thermal_family(), &blind::hydraulic_family()}) {
        Chance chance(3, 7);
        const auto rig = family->draw({}, chance);
        blind::Held held;
        std::vector<double> noise;  // never twice the same
        for (int k = 0; k < 40'000; ++k) {
            held.time_s.push_back(1e-3 * k * rig->clock.interval_s);
            held.input.push_back(0.0);
            noise.push_back(0.01 * k);
        }
        const auto plain = rig->read({}, held, noise, 1);
        EXPECT_NEAR(plain[5000] - plain[0], 50.0, 1e-6);
        const auto with = [&](const char* effect, blind::Parameters parameters) {
            return rig->read(std::vector{blind::Fault{effect, std::move(parameters)}}, held, noise, 1);
        };
        const auto drifts = with("sensor_drift", {{"per_s", 0.25}});
        const auto shifted = with("sensor_offset", {{"offset", -3.0}});
        const auto limited = with("sensor_saturation", {{"limit", plain[0] + 60.0}});
        const auto counted = with("encoder_quantisation", {{"step", 0.75}});
        for (std::size_t k = 0; k < plain.size(); k += 97) {
            // The thermometer's bend has no part in it.
            EXPECT_NEAR(drifts[k], plain[k] + 0.25 * held.time_s[k], 1e-9);
            EXPECT_NEAR(shifted[k], plain[k] - 3.0, 1e-9);
            EXPECT_NEAR(limited[k], std::min(plain[k], plain[0] + 60.0), 1e-9);
            EXPECT_NEAR(counted[k], 0.75 * std::round(plain[k] / 0.75), 1e-9);
        }
        expect_stretches(with("dropped_samples", {{"rate", 0.3}}), 0.3, 0.03);
        // Bend is none at rest nor at the full input, and c / 4 of the rise below in the middle.
        if (family == &blind::thermal_family()) {
            blind::Held warm;
            for (int k = 0; k < 3000; ++k) {
                warm.time_s.push_back(k * rig->clock.interval_s);
                warm.input.push_back(0.5 * rig->full_input);
            }
            const double half = rig->read({}, warm, {}, 1).back() - plain[0];
            const double bent =
                rig->read(std::vector{blind::Fault{"output_curve", {{"curvature", 0.4}}}}, warm, {}, 1).back() -
                plain[0];
            EXPECT_NEAR(bent / half, 1.0 + 0.4 * (0.5 - 1.0), 1e-3);
        }
    }
}

TEST(Noise, HasItsDeviationAndItsMemory) {
    for (const double memory : {0.0, 0.9}) {
        Chance chance(1, 9);
        const auto noise = blind::make_noise(100'000, 0.5, memory, chance);
        EXPECT_NEAR(blind::deviation_of(noise), 0.5, memory == 0.0 ? 0.005 : 0.02);
        double product = 0.0;
        for (std::size_t k = 1; k < noise.size(); ++k) {
            product += noise[k] * noise[k - 1] / static_cast<double>(noise.size());
        }
        EXPECT_NEAR(product / 0.25, memory, memory == 0.0 ? 0.015 : 0.08);
    }
    EXPECT_EQ(blind::digits(123456.0), 123500.0);
    EXPECT_EQ(blind::digits(0.00123456), 0.001235);
    EXPECT_DOUBLE_EQ(blind::rms({1.0, 2.0}, {1.0, 4.0}), std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(blind::deviation_of({1.0, 3.0}), 1.0);
}

TEST(Noise, HidesWhatIsLessThanTwiceAsLarge) {
    const std::vector<double> zero(3, 0.0);
    EXPECT_FALSE(blind::stands_out({0.5, -0.5, 0.5}, zero, 0.25));
    EXPECT_TRUE(blind::stands_out({0.501, -0.501, 0.501}, zero, 0.25));
    EXPECT_TRUE(blind::stands_out({0.25, 0.25, 1.0}, zero, 0.3));
}

TEST(Chance, IsEvenBetweenItsBounds) {
    Chance chance(1, 1);
    Seen between, around, scaled;
    double logarithm = 0.0;
    std::set<std::size_t> below;
    for (int k = 0; k < 4000; ++k) {
        between(chance.between(2.0, 5.0));
        around(chance.around(0.5));
        const double s = chance.scaled(1.0, 100.0);
        scaled(s);
        logarithm += std::log10(s) / 4000.0;
        below.insert(chance.below(3));
    }
    expect_between(between, 2.0, 5.0, "between");
    expect_between(around, -0.5, 0.5, "around");
    EXPECT_NEAR(scaled.least, 1.0, 0.01);
    EXPECT_NEAR(scaled.most, 100.0, 0.5);
    EXPECT_NEAR(logarithm, 1.0, 0.03);
    EXPECT_THAT(below, testing::ElementsAre(0U, 1U, 2U));
}

}  // namespace
