// Where residuals say that an effect was: starts of its numbers, and guesses of an event.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "gap/drive/effect.hpp"
#include "gap/drive/simulate.hpp"
#include "tests/gap/effect_scales.hpp"

namespace {

using scales_test::far;
using scales_test::force;
using scales_test::scales;
using scales_test::span;
using scales_test::tc;
using scales_test::u;
using Values = std::vector<double>;

gap::Record flat(std::size_t count, double interval_s) {
    gap::Record record;
    record.name = "flat";
    record.usual_interval_s = interval_s;
    for (std::size_t k = 0; k < count; ++k) {
        record.time_s.push_back(5.0 + interval_s * static_cast<double>(k));
        record.input.push_back(0.0);
        record.output.push_back(0.0);
    }
    return record;
}

// 10 s; the places that are tried are a fortieth apart.
TEST(EventGuess, OfADisturbanceIsWhatThePlantMakesOfIt) {
    const gap::Record record = flat(1001, 0.01);
    const gap::Course course(record, 1);
    gap::Scenario plant;
    plant.model.gain = 3.0;
    plant.model.denominator = {{0.4, 1.0}, {2.0, 0.0}};
    gap::Scenario pushed = plant;
    pushed.forces.pushes.push_back({2.5, 7.25, -0.8});
    const Values residuals = gap::simulate(pushed, course);
    gap::Scales scale = scales();
    scale.force = 5.0;
    const Values found = gap::effect_named("load_disturbance").guess({course, plant, residuals, scale});
    ASSERT_EQ(found.size(), 3U);
    EXPECT_NEAR(found[0], 2.5, 1e-9);
    EXPECT_NEAR(found[1], 7.25, 1e-9);
    EXPECT_NEAR(found[2], -0.8, 0.01);
    // Nothing is left: nothing happened.
    const Values none = gap::effect_named("load_disturbance").guess({course, plant, Values(record.size(), 0.0), scale});
    EXPECT_NEAR(none[0], 3.5, 1e-9);
    EXPECT_NEAR(none[1], 5.0, 1e-9);
    EXPECT_EQ(none[2], 0.0);
}

// Starts that residuals tell: those of a simulation with the effect less one without it.
class ToldStart : public testing::Test {
protected:
    ToldStart() {
        record_.name = "told";
        record_.usual_interval_s = 0.05;
        for (std::size_t i = 0; i < 400; ++i) {
            const double t = 0.05 * static_cast<double>(i);
            record_.time_s.push_back(t);
            record_.input.push_back(std::sin(0.9 * t) + 0.6 * std::sin(2.3 * t + 1.0));
            record_.output.push_back(0.0);
        }
        plant_.model.denominator = {{0.3, 2.0}, {0.6, 1.0}, {1.0, 0.0}};
        plant_.model.delay_s = 0.1;
        scales_ = scales();
        scales_.length_s = 20.0;
        scales_.interval_s = 0.05;
    }
    Values start_of(const std::string& name, const Values& truth) const {
        const gap::Effect& effect = gap::effect_named(name);
        const gap::Course course(record_, 1);
        gap::Scenario with = plant_;
        effect.add_to(with, truth);
        Values residuals = gap::simulate(with, course);
        const Values without = gap::simulate(plant_, course);
        for (std::size_t i = 0; i < residuals.size(); ++i) {
            residuals[i] -= without[i];
        }
        return effect.start({course, plant_, residuals, scales_});
    }
    gap::Record record_;
    gap::Scenario plant_;
    gap::Scales scales_{};
};

// Of bands from a hundredth of the range to all of it, each a quarter wider, and jumps of fifths of them.
TEST_F(ToldStart, OfAStickingValveIsItsBandAndJump) {
    for (const bool two_signs : {false, true}) {
        scales_.two_signs = two_signs;
        const double range = two_signs ? 2.0 * u : u;
        for (const auto& [power, share] :
             {std::pair(4, 0.6), std::pair(9, 1.0), std::pair(11, 0.2), std::pair(14, 0.4)}) {
            const double band = 0.01 * std::pow(1.25, power) * range;
            const Values found = start_of("valve_stiction", {band, share * band, 0.004 * u});
            EXPECT_NEAR(found.at(0), band, 1e-9) << power;
            EXPECT_NEAR(found.at(1), share * band, 1e-9) << power;
            EXPECT_NEAR(found.at(2), 0.004 * u, 1e-12);
        }
    }
}

// Half, one, ... forty waves in the record; size and phase by least squares.
TEST_F(ToldStart, OfASwingingDelayIsItsWave) {
    EXPECT_NEAR(start_of("variable_delay", {0.01 * tc, 20.0 / 40.0, 0.7}).at(1), 20.0 / 40.0, 1e-9);
    for (const double waves : {0.5, 7.5, 24.0}) {
        const Values found = start_of("variable_delay", {0.01 * tc, 20.0 / waves, 0.7});
        EXPECT_NEAR(found.at(0), 0.01 * tc, 4e-4 * tc) << waves;
        EXPECT_NEAR(found.at(1), 20.0 / waves, 1e-9) << waves;
        EXPECT_NEAR(found.at(2), 0.7, 0.05) << waves;
    }
    // In whatever unit the output is read.
    for (const double gain : {1e-6, 1e6}) {
        plant_.model.gain = gain;
        const Values found = start_of("variable_delay", {0.01 * tc, 20.0 / 7.5, 0.7});
        EXPECT_NEAR(found.at(0), 0.01 * tc, 4e-4 * tc) << gain;
        EXPECT_NEAR(found.at(1), 20.0 / 7.5, 1e-9) << gain;
        EXPECT_NEAR(found.at(2), 0.7, 0.05) << gain;
    }
    // Nothing is left: as long as the record.
    EXPECT_EQ(start_of("variable_delay", {0.0, 1.0, 0.0}), (Values{0.0, 20.0, 0.0}));
}

TEST_F(ToldStart, OfCoggingIsItsWaveAlongTheWay) {
    for (const bool of_speed : {false, true}) {
        scales_.maybe_speed = of_speed;
        const double unit = of_speed ? 1.0 / (0.5 * far * 20.0) : 1.0 / span;
        for (const double waves : {3.5, 12.0}) {
            const Values found = start_of("cogging", {2e-4 * force, waves * unit, -0.9, of_speed ? 1.0 : 0.0});
            EXPECT_NEAR(found.at(0), 2e-4 * force, 4e-6 * force) << waves;
            EXPECT_NEAR(found.at(1), waves * unit, 1e-12) << waves;
            EXPECT_NEAR(found.at(2), -0.9, 0.02) << waves;
            EXPECT_EQ(found.at(3), of_speed ? 1.0 : 0.0);
        }
    }
}

}  // namespace
