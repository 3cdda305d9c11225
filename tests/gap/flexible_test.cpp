// What a model without physics foresees: anything that one of its features makes, and of noise nothing.
#include "gap/drive/residuals/flexible.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace {

constexpr double interval_s = 0.05;
constexpr double delay_s = 0.4;
constexpr double time_constant_s = 1.0;
constexpr std::size_t samples = 2400;

// Levels drawn at random, held for half a second to three; the output a lag of them.
struct Made {
    gap::Record record;
    std::vector<double> simulated;
    // As features have them: of unit size.
    std::vector<double> u, y, v, t;

    explicit Made(unsigned seed = 1) {
        std::mt19937_64 engine(seed);
        std::uniform_real_distribution<double> level(-3.0, 5.0);
        std::uniform_int_distribution<int> hold(10, 60);
        record.name = "made";
        record.usual_interval_s = interval_s;
        double now = 0.0;
        double lag = 1.0;
        int left = 0;
        for (std::size_t i = 0; i < samples; ++i) {
            if (left-- == 0) {
                now = level(engine);
                left = hold(engine);
            }
            record.time_s.push_back(7.0 + interval_s * static_cast<double>(i));
            record.input.push_back(now);
            simulated.push_back(lag);
            lag += (now - lag) * -std::expm1(-interval_s / 0.8);
        }
        record.output = simulated;
        double input = 0.0;
        double low = simulated[0];
        double high = low;
        double speed = 0.0;
        for (std::size_t i = 0; i < samples; ++i) {
            const std::size_t from = i == 0 ? 0 : i - 1;
            const std::size_t to = std::min(samples - 1, i + 1);
            v.push_back((simulated[to] - simulated[from]) / (record.time_s[to] - record.time_s[from]));
            speed = std::max(speed, std::fabs(v.back()));
            input = std::max(input, std::fabs(record.input[i]));
            low = std::min(low, simulated[i]);
            high = std::max(high, simulated[i]);
        }
        for (std::size_t i = 0; i < samples; ++i) {
            u.push_back(record.input[i] / input);
            y.push_back((simulated[i] - low) / (high - low) * 2.0 - 1.0);
            v[i] /= speed;
            t.push_back(static_cast<double>(i) / static_cast<double>(samples - 1));
        }
    }
    // What was there some time before; nothing before the record.
    static double late(const std::vector<double>& values, std::size_t i, double by_s) {
        const auto whole = static_cast<std::size_t>(std::lround(by_s / interval_s));
        return i < whole ? 0.0 : values[i - whole];
    }
    gap::Remainder leaving(const std::function<double(std::size_t)>& residual, double noise, unsigned seed = 2) const {
        std::mt19937_64 engine(seed);
        std::normal_distribution<double> normal(0.0, noise);
        gap::Remainder one{&record, simulated, {}, std::vector<char>(samples, 1)};
        for (std::size_t i = 0; i < samples; ++i) {
            one.residuals.push_back(residual(i) + normal(engine));
        }
        return one;
    }
};

const Made& made() {
    static const Made one;
    return one;
}

// How much is left of what a feature makes, over its squares.
double left_of(const std::function<double(std::size_t)>& feature) {
    return 1.0 - gap::explain({made().leaving(feature, 1e-6)}, {}, delay_s, time_constant_s).explained;
}

TEST(Flexible, ForeseesWhatTheInputDidBefore) {
    const Made& m = made();
    for (const double lag : {0.0, 0.15, 0.4, 0.8, 1.5, 3.0}) {
        const double by_s = delay_s + lag * time_constant_s;
        EXPECT_LT(left_of([&](std::size_t i) { return Made::late(m.u, i, by_s); }), 2e-3) << lag;
        EXPECT_LT(
            left_of([&](std::size_t i) { return Made::late(m.u, i, by_s) * std::fabs(Made::late(m.u, i, by_s)); }),
            4e-3)
            << lag;
        EXPECT_LT(left_of([&](std::size_t i) { return Made::late(m.u, i, by_s) * m.y[i]; }), 2e-3) << lag;
    }
}

TEST(Flexible, ForeseesWhatTheOutputMakes) {
    const Made& m = made();
    for (const double lag : {0.0, 0.3, 0.8, 2.0}) {
        EXPECT_LT(left_of([&](std::size_t i) { return Made::late(m.y, i, lag); }), 2e-3) << lag;
        EXPECT_LT(left_of([&](std::size_t i) { return std::pow(Made::late(m.y, i, lag), 2); }), 4e-3) << lag;
    }
    EXPECT_LT(left_of([&](std::size_t i) { return m.y[i] * m.y[i] * m.y[i]; }), 2e-3);
    EXPECT_LT(left_of([&](std::size_t i) { return std::max(0.0, m.y[i] - 0.6); }), 0.02);
    for (const double waves : {1.0, 2.0, 3.0, 5.0, 8.0}) {
        EXPECT_LT(left_of([&](std::size_t i) { return std::sin(std::numbers::pi * waves * m.y[i]); }), 2e-3) << waves;
        EXPECT_LT(left_of([&](std::size_t i) { return std::cos(std::numbers::pi * waves * m.y[i]); }), 2e-3) << waves;
    }
}

TEST(Flexible, ForeseesWhatTheSpeedAndTheTimeMake) {
    const Made& m = made();
    EXPECT_LT(left_of([&](std::size_t i) { return m.v[i]; }), 5e-3);
    EXPECT_LT(left_of([&](std::size_t i) { return m.v[i] * std::fabs(m.v[i]); }), 0.02);
    EXPECT_LT(left_of([&](std::size_t i) { return std::fabs(m.v[i]); }), 0.02);
    EXPECT_LT(left_of([&](std::size_t i) { return std::tanh(20.0 * m.v[i]); }), 2e-3);
    EXPECT_LT(left_of([&](std::size_t i) { return m.v[i] * m.y[i]; }), 0.02);
    for (const double lag : {0.3, 1.0}) {
        EXPECT_LT(left_of([&](std::size_t i) { return std::tanh(20.0 * Made::late(m.v, i, lag)); }), 2e-3) << lag;
        EXPECT_LT(left_of([&](std::size_t i) { return Made::late(m.v, i, lag); }), 5e-3) << lag;
    }
    EXPECT_LT(left_of([&](std::size_t i) { return m.t[i]; }), 2e-3);
    EXPECT_LT(left_of([&](std::size_t i) { return m.u[i] * m.t[i]; }), 5e-3);
    EXPECT_LT(left_of([](std::size_t) { return 1.0; }), 1e-3);
}

TEST(Flexible, ForeseesNothingOfNoise) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const gap::Flexible found =
            gap::explain({made().leaving([](std::size_t) { return 0.0; }, 1.0, seed)}, {}, delay_s, time_constant_s);
        EXPECT_FALSE(found.certain) << seed;
        EXPECT_LT(found.explained, 0.02) << seed;
    }
}

// Half of the squares can be foreseen: the other half is left, sample by sample.
TEST(Flexible, SaysHowMuchItTakesOff) {
    const Made& m = made();
    double squares = 0.0;
    for (const double y : m.y) {
        squares += y * y / static_cast<double>(samples);
    }
    const gap::Remainder remainder = m.leaving([&](std::size_t i) { return m.y[i]; }, std::sqrt(squares));
    const gap::Flexible found = gap::explain({remainder}, {}, delay_s, time_constant_s);
    EXPECT_TRUE(found.certain);
    EXPECT_NEAR(found.explained, 0.5, 0.05);
    ASSERT_EQ(found.left.size(), 1U);
    double before = 0.0;
    double after = 0.0;
    for (std::size_t i = 0; i < samples; ++i) {
        before += remainder.residuals[i] * remainder.residuals[i];
        after += found.left[0][i] * found.left[0][i];
    }
    EXPECT_NEAR(found.explained, 1.0 - after / before, 1e-9);
}

// What does not count is neither fitted nor judged: it may be anything.
TEST(Flexible, PassesOverWhatDoesNotCount) {
    const Made& m = made();
    gap::Remainder remainder = m.leaving([&](std::size_t i) { return m.y[i]; }, 0.2);
    const gap::Flexible whole = gap::explain({remainder}, {}, delay_s, time_constant_s);
    for (std::size_t i = 3; i < samples; i += 10) {
        remainder.counts[i] = 0;
        remainder.residuals[i] = 1e3;
    }
    const gap::Flexible part = gap::explain({remainder}, {}, delay_s, time_constant_s);
    EXPECT_NEAR(part.explained, whole.explained, 0.02);
    EXPECT_TRUE(part.certain);
}

// Further records are fitted, too: what a short one hardly tells they do.
TEST(Flexible, LearnsFromFurtherRecords) {
    const Made& m = made();
    const Made other(5);
    const auto cube = [](const Made& of) { return [&of](std::size_t i) { return of.y[i] * of.y[i] * of.y[i]; }; };
    gap::Remainder judged = m.leaving(cube(m), 1.0, 3);
    std::fill(judged.counts.begin() + 400, judged.counts.end(), char{0});
    std::vector<gap::Remainder> also = {other.leaving(cube(other), 0.01, 4)};
    EXPECT_GT(gap::explain({judged}, also, delay_s, time_constant_s).explained,
              gap::explain({judged}, {}, delay_s, time_constant_s).explained + 0.01);
}

TEST(Flexible, HasNothingToGoByWhereNothingMoves) {
    const Made& m = made();
    gap::Record still = m.record;
    gap::Remainder one = m.leaving([&](std::size_t i) { return m.y[i]; }, 0.1);
    const auto explained = [&] { return gap::explain({one}, {}, delay_s, time_constant_s); };
    std::fill(still.input.begin(), still.input.end(), 0.0);
    one.record = &still;
    EXPECT_EQ(explained().explained, 0.0);
    EXPECT_EQ(explained().left.front(), one.residuals);
    one.record = &m.record;
    std::fill(one.simulated.begin(), one.simulated.end(), 2.0);
    EXPECT_EQ(explained().explained, 0.0);
    EXPECT_FALSE(explained().certain);
}

// Of 24 blocks each fourth is foreseen by the others alone: where they leave what the output makes and these nothing,
// it is taken off these, too, in whole.
TEST(Flexible, ForeseesEachFourthOf24BlocksByTheOthers) {
    const Made& m = made();
    constexpr std::size_t block = samples / 24;
    for (std::size_t fold = 0; fold < 4; ++fold) {
        const auto of_fold = [fold](std::size_t i) { return i / block % 4 == fold; };
        const auto found = gap::explain({m.leaving([&](std::size_t i) { return of_fold(i) ? 0.0 : m.y[i]; }, 1e-6)}, {},
                                        delay_s, time_constant_s);
        EXPECT_GT(found.explained, 0.0);
        double along = 0.0;
        double square = 0.0;
        for (std::size_t i = 0; i < samples; ++i) {
            along += of_fold(i) ? found.left[0][i] * m.y[i] : 0.0;
            square += of_fold(i) ? m.y[i] * m.y[i] : 0.0;
        }
        EXPECT_NEAR(along / square, -1.0, 0.06) << fold;
    }
}

// Sizes are those of the whole record, its first sample's, too: an impulse there is an input.
TEST(Flexible, SizesCountTheFirstSample) {
    Made made;
    made.record.input.assign(samples, 0.0);
    made.record.input[0] = 1.0;
    const gap::Remainder left = made.leaving([&](std::size_t i) { return made.y[i]; }, 0.01);
    EXPECT_GT(gap::explain({left}, {}, delay_s, time_constant_s).explained, 0.9);
    made.record.input[0] = 0.0;  // no input at all: nothing is asked
    EXPECT_EQ(gap::explain({left}, {}, delay_s, time_constant_s).explained, 0.0);
}

// Blocks that do not count are no evidence: four that all gain as much are certain, three are too few.
TEST(Flexible, IsCertainByTheBlocksThatCount) {
    const Made& m = made();
    const Made other(5);
    const auto one = [](std::size_t) { return 1.0; };
    gap::Remainder judged = m.leaving(one, 0.01, 3);
    const std::vector<gap::Remainder> also{other.leaving(one, 0.01, 4)};
    const auto by_blocks = [&](const std::vector<std::size_t>& blocks) {
        std::ranges::fill(judged.counts, char{0});
        for (const std::size_t block : blocks) {
            std::fill_n(judged.counts.begin() + static_cast<std::ptrdiff_t>(block * samples / 24), samples / 24,
                        char{1});
        }
        return gap::explain({judged}, also, delay_s, time_constant_s);
    };
    const gap::Flexible four = by_blocks({0, 5, 10, 15});
    EXPECT_GT(four.explained, 0.99);
    EXPECT_TRUE(four.certain);
    const gap::Flexible three = by_blocks({0, 5, 10});
    EXPECT_EQ(three.explained, 0.0);
    EXPECT_FALSE(three.certain);
    EXPECT_EQ(three.left.front(), judged.residuals);
}

}  // namespace
