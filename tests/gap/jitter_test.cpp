// Jitter: what shifts of a stamp by up to a half width make of a speed.
#include "gap/drive/jitter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "gap/drive/candidate.hpp"
#include "gap/drive/fit.hpp"
#include "gap/drive/start.hpp"
#include "tests/gap/stepped_study.hpp"

namespace {

using gap_test::lag;
using gap_test::Made;
using gap_test::stepped;

TEST(Jitter, SpreadsReadingsByTheirSpeed) {
    Made made(lag(), {stepped()}, false);
    gap::Candidate candidate;
    candidate.effects = {&gap::effect_named("sampling_jitter")};
    candidate.own.resize(1);
    candidate.lasting = {gap::parameters_of(*candidate.effects[0], made.study.scales, 0)};
    candidate.lasting[0][0].value = 0.2;   // s
    candidate.lasting[0][1].value = 0.25;  // of the variance is noise
    gap::Whitener whitener;
    whitener.deviation = whitener.stationary_deviation = 0.1;
    whitener.coefficients = {0.5};
    const auto left = gap::residuals_of(made.study, candidate, 0);
    const auto& z = made.records[0].output;
    const auto simulated = [&](std::size_t i) { return z[i] - left[i]; };
    const auto spread = gap::spread_of(made.study, candidate, 0, left, whitener);
    for (std::size_t i = 1; i + 1 < z.size(); ++i) {
        const double speed = (simulated(i + 1) - simulated(i - 1)) / 1.0;
        const double by = 0.2 * speed / 0.1;
        EXPECT_NEAR(spread[i], std::sqrt(0.25 + 1.25 * by * by / 3.0), 1e-9) << i;
    }
    EXPECT_NEAR(spread[0], std::sqrt(0.25 + 1.25 * std::pow(0.2 * (simulated(1) - simulated(0)) / 0.5 / 0.1, 2) / 3.0),
                1e-9);
    // What a likely shift explains is taken off: as much of it as is jitter's, and no more than the half width.
    const auto without = gap::without_jitter(made.study, candidate, 0, left, whitener);
    for (std::size_t i = 1; i + 1 < z.size(); ++i) {
        const double speed = (simulated(i + 1) - simulated(i - 1)) / 1.0;
        const double moved = speed * speed * 0.04 / 3.0;
        const double noise = 0.01 * 0.25;
        const double shift = speed == 0.0 ? 0.0 : std::clamp(left[i] / speed * moved / (moved + noise), -0.2, 0.2);
        EXPECT_NEAR(without[i], left[i] - speed * shift, 1e-9) << i;
    }
    // Of the first reading, too, by its one neighbour.
    std::vector<double> off = left;
    off[0] = 0.05;
    const double speed = (z[1] - off[1] - (z[0] - off[0])) / 0.5;
    const double moved = speed * speed * 0.04 / 3.0;
    ASSERT_NE(speed, 0.0);
    EXPECT_NEAR(gap::without_jitter(made.study, candidate, 0, off, whitener)[0],
                off[0] - speed * std::clamp(off[0] / speed * moved / (moved + 0.0025), -0.2, 0.2), 1e-9);
    // What a sensor's end holds has no noise whenever it is read.
    gap::Record& held = made.records[0];
    std::fill_n(held.output.begin() + 10, 12, 9.0);
    for (std::size_t i = 25; i < held.output.size(); ++i) {
        held.output[i] += 1e-6 * static_cast<double>(i * i % 7);
    }
    const auto at_end = gap::spread_of(made.study, candidate, 0, left, whitener);
    EXPECT_EQ(at_end[15], 1.0);
    EXPECT_NE(at_end[30], 1.0);
    candidate.lasting[0][0].value = 0.0;
    EXPECT_EQ(gap::without_jitter(made.study, candidate, 0, left, whitener), left);
    candidate.effects.clear();
    EXPECT_TRUE(gap::spread_of(made.study, candidate, 0, left, whitener).empty());
    EXPECT_EQ(gap::without_jitter(made.study, candidate, 0, left, whitener), left);
}

// A plant that always moves, read at other times than its stamps say.
struct Shifted {
    Made made;
    gap::Candidate candidate;
    gap::Whitener whitener;
    std::vector<double> left;
    Shifted(double half_width_s, double noise, double coloured)
        : made(lag(), {[] {
                   gap::Record record;
                   record.name = "moves";
                   record.usual_interval_s = 0.5;
                   for (int i = 0; i < 800; ++i) {
                       record.time_s.push_back(0.5 * i);
                       record.input.push_back(2.0 * std::sin(0.31 * i) + std::sin(0.173 * i));
                       record.output.push_back(0.0);
                   }
                   return record;
               }()},
               false) {
        gap::Candidate none;
        none.own.resize(1);
        const auto simulated = gap::simulate(gap::scenario_of(made.study, none, 0), made.study.courses[0]);
        std::mt19937_64 engine(5);
        std::uniform_real_distribution<double> even(-1.0, 1.0);
        std::normal_distribution<double> normal(0.0, noise);
        double squares = 0.0;
        double shift = 0.0;
        for (std::size_t i = 0; i < simulated.size(); ++i) {
            const std::size_t from = i == 0 ? 0 : i - 1;
            const std::size_t to = std::min(simulated.size() - 1, i + 1);
            const double speed = (simulated[to] - simulated[from]) / (0.5 * static_cast<double>(to - from));
            shift = coloured * shift + (1.0 - coloured) * half_width_s * even(engine);
            const double off = shift * speed + normal(engine);
            made.records[0].output[i] = simulated[i] + off;
            squares += off * off;
        }
        whitener.deviation = whitener.stationary_deviation = std::sqrt(squares / 800.0);
        candidate.effects = {&gap::effect_named("sampling_jitter")};
        candidate.own.resize(1);
        candidate.lasting = {gap::parameters_of(*candidate.effects[0], made.study.scales, 0)};
        left = gap::residuals_of(made.study, candidate, 0);
        gap::fit_jitter(made.study, candidate, whitener);
    }
    [[nodiscard]] double width() const { return candidate.lasting[0][0].value; }
    [[nodiscard]] double noise_share() const { return candidate.lasting[0][1].value; }
};

TEST(Jitter, IsFoundByTheSpreadOfReadings) {
    const Shifted jitters(0.2, 0.01, 0.0);
    EXPECT_NEAR(jitters.width(), 0.2, 0.02);
    const double noise = std::sqrt(jitters.noise_share()) * jitters.whitener.deviation;
    EXPECT_NEAR(noise, 0.01, 0.004);
    // Of 800 second moments of even shifts a width is known to some per cent.
    EXPECT_GT(jitters.candidate.lasting[0][0].deviation, 0.002);
    EXPECT_LT(jitters.candidate.lasting[0][0].deviation, 0.015);
}

// Of normal residuals that spread by both.
double likelihood_of(const Shifted& of, double half_width_s, double noise_share) {
    gap::Candidate candidate = of.candidate;
    candidate.lasting[0][0].value = half_width_s;
    candidate.lasting[0][1].value = noise_share;
    const auto spread = gap::spread_of(of.made.study, candidate, 0, of.left, of.whitener);
    const auto white = of.whitener.apply(of.left);
    double sum = 0.0;
    for (std::size_t i = 0; i < white.size(); ++i) {
        sum -= 0.5 * std::pow(white[i] / spread[i], 2) + std::log(spread[i]);
    }
    return sum;
}

// The most likely width, to a hundredth, with the deviation that its likelihood tells: fallen by 1.92 at 1.96 of them.
TEST(Jitter, IsAsWideAsIsMostLikely) {
    for (const double noise : {0.01, 0.05}) {
        const Shifted jitters(0.2, noise, 0.0);
        const double best = likelihood_of(jitters, jitters.width(), jitters.noise_share());
        for (double factor = 0.5; factor < 2.0; factor *= 1.004) {
            EXPECT_LT(likelihood_of(jitters, factor * jitters.width(), jitters.noise_share()), best + 0.02) << factor;
        }
        const auto falls = [&](double by) {
            double factor = 1.0;
            while (likelihood_of(jitters, factor * jitters.width(), jitters.noise_share()) > best - 1.92) {
                factor *= by;
            }
            return factor;
        };
        const double expected = 0.5 * (falls(1.001) - falls(0.999)) * jitters.width() / 1.96;
        const gap::FreeParameter& width = jitters.candidate.lasting[0][0];
        EXPECT_NEAR(width.deviation, expected, 0.2 * expected) << noise;
        EXPECT_NEAR(width.low, falls(0.999) * width.value, 0.02 * width.value) << noise;
        EXPECT_NEAR(width.high, falls(1.001) * width.value, 0.02 * width.value) << noise;
        const gap::FreeParameter& share = jitters.candidate.lasting[0][1];
        EXPECT_GT(share.low, 0.0) << noise;
        EXPECT_LE(share.low, share.value) << noise;
        EXPECT_GE(share.high, share.value) << noise;
        EXPECT_GT(likelihood_of(jitters, width.value, share.low), best - 1.92) << noise;
        EXPECT_GT(likelihood_of(jitters, width.value, share.high), best - 1.92) << noise;
    }
}

// Four units of likelihood, or there is none.
TEST(Jitter, IsNoneThatIsHardlyKnown) {
    std::size_t found = 0;
    std::size_t none = 0;
    for (double half_width_s = 0.004; half_width_s < 0.02; half_width_s *= 1.04) {
        const Shifted jitters(half_width_s, 0.02, 0.0);
        double best = -1e9;
        for (double width = 4e-3; width < 0.1; width *= 1.05) {
            for (const double share : {0.5, 0.7, 0.85, 1.0}) {
                best = std::max(best, likelihood_of(jitters, width, share));
            }
        }
        const double gain = best - likelihood_of(jitters, 0.0, 1.0);
        if (std::fabs(gain - 4.0) > 0.03) {
            EXPECT_EQ(jitters.width() > 0.0, gain > 4.0) << half_width_s << " " << gain;
            EXPECT_EQ(jitters.noise_share() < 1.0, gain > 4.0) << half_width_s << " " << gain;
        }
        (gain > 4.0 ? found : none) += 1;
    }
    EXPECT_GT(found, 5U);
    EXPECT_GT(none, 5U);
}

// Beside it noise is one of eleven shares of the variance: the nearest to what there is.
TEST(Jitter, LeavesNoiseOneOfElevenShares) {
    const std::vector<double> shares{0.003, 0.01, 0.03, 0.06, 0.1, 0.2, 0.3, 0.5, 0.7, 0.85, 1.0};
    std::set<double> seen;
    for (double noise = 0.004; noise < 0.5; noise *= 1.15) {
        const Shifted jitters(0.2, noise, 0.0);
        seen.insert(jitters.noise_share());
        EXPECT_TRUE(std::find(shares.begin(), shares.end(), jitters.noise_share()) != shares.end())
            << noise << " " << jitters.noise_share();
        if (jitters.width() > 0.0) {
            const double share = noise * noise / (jitters.whitener.deviation * jitters.whitener.deviation);
            EXPECT_LT(jitters.noise_share(), 2.0 * share) << noise;
            EXPECT_GT(jitters.noise_share(), 0.5 * share) << noise;
        }
    }
    EXPECT_EQ(seen, std::set<double>(shares.begin(), shares.end()));
}

TEST(Jitter, IsNoneOfEvenNoiseAndOfWhatIsColoured) {
    const Shifted quiet(0.0, 0.02, 0.0);
    EXPECT_EQ(quiet.width(), 0.0);
    EXPECT_EQ(quiet.noise_share(), 1.0);
    const Shifted slow(0.2, 1e-4, 0.9);
    EXPECT_EQ(slow.width(), 0.0);
    EXPECT_EQ(slow.noise_share(), 1.0);
    const Shifted little(0.2, 1e-4, 0.1);  // a tenth of the shift stays
    EXPECT_GT(little.width(), 0.1);
}

}  // namespace
