// A fan's drag beside a fitted base: what a linear fit has of its slope is taken out of the base first.
#include "gap/drive/kept_slope.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "gap/drive/fit.hpp"
#include "gap/drive/start.hpp"

namespace {

// m v' = k u - b v - d v^2 in units of b: 5.5 u = 7.5 v' + v + 0.03 v^2, at about 80; slope at rest 1, there 5.8.
constexpr double gain = 5.5;
constexpr double lag_s = 7.5;
constexpr double drag = 0.03;

double input_at(double t) { return 45.0 + 30.0 * std::sin(0.7 * t) + (std::fmod(t, 9.0) < 4.0 ? 15.0 : -15.0); }

gap::Record fan() {
    gap::Record record;
    record.name = "fan";
    record.usual_interval_s = 0.05;
    constexpr int fine = 50;
    double v = 75.0;
    for (int i = 0; i < 1200; ++i) {
        record.time_s.push_back(0.05 * i);
        record.input.push_back(input_at(record.time_s.back()));
        record.output.push_back(v);
        for (int k = 0; k < fine; ++k) {
            v += 0.05 / fine * (gain * record.input.back() - v - drag * v * v) / lag_s;
        }
    }
    return record;
}

const gap::Effect& quadratic_drag() { return gap::effect_named("quadratic_drag"); }

struct Fan {
    gap::Record record = fan();
    gap::Study study{{gap::form_of(drive::make_fopdt(1.0, 1.4, 0.1)), true}, {}, {}, {}, 0.05, 0.01, 0};
    Fan() {
        study.scales = gap::scales_of(gap::model_of(study.base.form), {record}, {});
        study.counts = gap::all_count({record});
        study.courses.emplace_back(record, 2);
    }
    [[nodiscard]] gap::Candidate with(double coefficient, double of_speed) const {
        gap::Candidate candidate = gap::fit(study, {}, {}, nullptr);
        candidate.effects = {&quadratic_drag()};
        candidate.lasting = {gap::parameters_of(quadratic_drag(), study.scales, 0)};
        candidate.lasting[0][0].value = coefficient;
        candidate.lasting[0][1].value = of_speed;
        return candidate;
    }
};

TEST(KeptSlope, IsTakenOutOfGainAndLag) {
    Fan of;
    const gap::Candidate candidate = of.with(0.02, 1.0);
    double mean = 0.0;
    for (const double v : of.record.output) {
        mean += v / static_cast<double>(of.record.size());
    }
    const double slope = 1.0 + 2.0 * 0.02 * mean;
    const std::optional<gap::Candidate> kept = gap::with_slope_kept(of.study, candidate, {});
    ASSERT_TRUE(kept);
    ASSERT_EQ(kept->base.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        const gap::FreeParameter& was = candidate.base[i];
        EXPECT_NEAR(kept->base[i].value, was.value * (was.name == "delay_s" ? 1.0 : slope), 1e-9) << was.name;
    }
    // A lag's coefficient likewise, by any power of it; an order never.
    gap::Candidate other = candidate;
    other.base[1].name = "a2";
    EXPECT_NEAR(gap::with_slope_kept(of.study, other, {})->base[1].value, slope * other.base[1].value, 1e-9);
    other.base[1].name = "alpha1";
    EXPECT_EQ(gap::with_slope_kept(of.study, other, {})->base[1].value, other.base[1].value);
    // No further than the fit may go.
    gap::Candidate narrow = candidate;
    narrow.base[0].upper = 1.5 * narrow.base[0].value;
    EXPECT_EQ(gap::with_slope_kept(of.study, narrow, {})->base[0].value, narrow.base[0].upper);
}

TEST(KeptSlope, IsOfNewEffectsThatHaveOneBesideAFittedBase) {
    Fan of;
    EXPECT_FALSE(gap::with_slope_kept(of.study, of.with(0.02, 0.0), {}));  // a brake on a position's speed
    EXPECT_FALSE(gap::with_slope_kept(of.study, of.with(0.02, 1.0), of.with(0.01, 1.0)));
    EXPECT_FALSE(gap::with_slope_kept(of.study, gap::fit(of.study, {}, {}, nullptr), {}));
    gap::Candidate stiff = of.with(0.02, 1.0);
    stiff.base[1].name = "a0";
    EXPECT_FALSE(gap::with_slope_kept(of.study, stiff, {}));
    of.study.base.refit = false;
    EXPECT_FALSE(gap::with_slope_kept(of.study, of.with(0.02, 1.0), {}));
}

TEST(KeptSlope, LeadsToTheDragFromALinearFit) {
    Fan of;
    const gap::Candidate linear = gap::fit(of.study, {}, {}, nullptr);
    EXPECT_LT(linear.base[1].value, 2.5);  // about a fifth of the lag at rest
    const gap::Candidate found = gap::fit(of.study, {&quadratic_drag()}, linear, nullptr);
    EXPECT_NEAR(found.lasting[0][0].value, drag, 0.02 * drag);
    EXPECT_NEAR(found.base[0].value, gain, 0.02 * gain);
    EXPECT_NEAR(found.base[1].value, lag_s, 0.02 * lag_s);
}

// What counts from an empty tank begins with the operating point there; the gain keeps the mean.
TEST(CountedFromZero, IsOfNewLawsThatCountFromThere) {
    Fan of;
    const gap::Effect& curve = gap::effect_named("output_curve");
    gap::Candidate candidate = gap::fit(of.study, {}, {}, nullptr);
    gap::Candidate start = candidate;
    candidate.effects = {&curve};
    candidate.lasting = {gap::parameters_of(curve, of.study.scales, 0)};
    candidate.lasting[0][2].value = 1.0;  // an outflow
    ASSERT_EQ(candidate.own[0][0].name, "offset");
    candidate.own[0][0].value = -20.0;
    double mean = 0.0;
    for (const double v : of.record.output) {
        mean += v / static_cast<double>(of.record.size());
    }
    const std::optional<gap::Candidate> counted = gap::counted_from_zero(of.study, candidate, start);
    ASSERT_TRUE(counted);
    EXPECT_EQ(counted->own[0][0].value, 0.0);
    EXPECT_NEAR(counted->base[0].value, candidate.base[0].value * mean / (mean + 20.0), 1e-12);
    EXPECT_EQ(counted->base[1].value, candidate.base[1].value);
    gap::Candidate narrow = candidate;
    narrow.base[0].lower = 0.99 * narrow.base[0].value;
    EXPECT_EQ(gap::counted_from_zero(of.study, narrow, start)->base[0].value, narrow.base[0].lower);
    EXPECT_FALSE(gap::counted_from_zero(of.study, candidate, candidate));  // not new
    gap::Candidate sensor = candidate;
    sensor.lasting[0][2].value = 0.0;
    EXPECT_FALSE(gap::counted_from_zero(of.study, sensor, start));
    gap::Candidate there = candidate;
    there.own[0][0].value = 0.0;
    EXPECT_FALSE(gap::counted_from_zero(of.study, there, start));
    gap::Candidate beyond = candidate;
    beyond.own[0][0].value = 1.01 * mean;  // no gain keeps its sign
    EXPECT_FALSE(gap::counted_from_zero(of.study, beyond, start));
    of.study.base.refit = false;
    EXPECT_FALSE(gap::counted_from_zero(of.study, candidate, start));
}

}  // namespace
