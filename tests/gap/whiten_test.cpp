// Coloured residuals made white: the recursion, its likelihood and its order by hand; and sums drawn again.
#include "gap/drive/residuals/whiten.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace {

using Values = std::vector<double>;

Values noise(std::size_t count, unsigned seed, double first = 0.0, double second = 0.0) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    Values values;
    double one = 0.0;
    double two = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        values.push_back(first * one + second * two + normal(engine));
        two = one;
        one = values.back();
    }
    return values;
}

gap::Whitener second_order() {
    gap::Whitener whitener;
    whitener.coefficients = {0.5, -0.25};
    whitener.deviation = 2.0;
    whitener.stationary_deviation = 4.0;
    return whitener;
}

TEST(Whitener, TakesOffWhatThePastForesees) {
    const Values white = second_order().apply(Values{8.0, 4.0, 6.0, -2.0});
    // The first two have no past of two.
    EXPECT_EQ(white, (Values{2.0, 1.0, (6.0 - 0.5 * 4.0 + 0.25 * 8.0) / 2.0, (-2.0 - 0.5 * 6.0 + 0.25 * 4.0) / 2.0}));
}

// Student's density of five degrees, scaled to unit variance, but for its constant.
double student(double size) { return -3.0 * std::log(1.0 + size * size / 3.0); }

TEST(Whitener, HasTheLikelihoodOfHeavyTails) {
    const Values residuals{8.0, 4.0, 6.0, -2.0};
    const Values logs = second_order().log_likelihood(residuals);
    EXPECT_NEAR(logs[0], student(2.0) - std::log(4.0), 1e-12);
    EXPECT_NEAR(logs[1], student(1.0) - std::log(4.0), 1e-12);
    EXPECT_NEAR(logs[2], student(3.0) - std::log(2.0), 1e-12);
    EXPECT_NEAR(logs[3], student(-2.0) - std::log(2.0), 1e-12);
    // Where readings are spread twice as far, half as far off is as far.
    const Values spread = second_order().log_likelihood(residuals, Values{1.0, 2.0, 1.0, 2.0});
    EXPECT_NEAR(spread[1], student(0.5) - std::log(8.0), 1e-12);
    EXPECT_NEAR(spread[2], logs[2], 1e-12);
    EXPECT_NEAR(spread[3], student(-1.0) - std::log(4.0), 1e-12);
}

// Yule and Walker's equations of second order, solved by hand; of several records no product reaches from one into
// another.
TEST(Whitener, IsYuleAndWalkers) {
    const Values values = noise(3000, 4, 1.2, -0.7);
    const Values half(values.begin(), values.begin() + 1500);
    const Values rest(values.begin() + 1500, values.end());
    for (const std::vector<Values>& records : {std::vector<Values>{values}, std::vector<Values>{half, rest}}) {
        Values c(3, 0.0);
        for (const Values& record : records) {
            for (std::size_t lag = 0; lag < 3; ++lag) {
                for (std::size_t k = lag; k < record.size(); ++k) {
                    c[lag] += record[k] * record[k - lag];
                }
            }
        }
        const gap::Whitener found = gap::fit_whitener(records, 2, 1e-6);
        ASSERT_EQ(found.coefficients.size(), 2U);
        const double determinant = c[0] * c[0] - c[1] * c[1];
        const double first = (c[0] * c[1] - c[1] * c[2]) / determinant;
        const double second = (c[0] * c[2] - c[1] * c[1]) / determinant;
        EXPECT_NEAR(found.coefficients[0], first, 1e-6);
        EXPECT_NEAR(found.coefficients[1], second, 1e-6);
        EXPECT_NEAR(found.deviation, std::sqrt((c[0] - first * c[1] - second * c[2]) / 3000.0), 1e-6);
        EXPECT_NEAR(found.stationary_deviation, std::sqrt(c[0] / 3000.0), 1e-6);
    }
}

TEST(Whitener, HasNoHigherOrderThanTheRecordAsksFor) {
    EXPECT_TRUE(gap::fit_whitener({noise(3000, 5)}, 8, 1e-6).coefficients.empty());
    EXPECT_EQ(gap::fit_whitener({noise(3000, 6, 0.8)}, 8, 1e-6).coefficients.size(), 1U);
    EXPECT_EQ(gap::fit_whitener({noise(3000, 7, 1.2, -0.7)}, 8, 1e-6).coefficients.size(), 2U);
    EXPECT_EQ(gap::fit_whitener({noise(3000, 7, 1.2, -0.7)}, 1, 1e-6).coefficients.size(), 1U);
}

// A perfect simulation of rounded readings leaves nothing: they are as far off as their step says, at least.
TEST(Whitener, IsAtLeastAsWideAsTheQuantum) {
    const gap::Whitener found = gap::fit_whitener({Values(100, 0.0)}, 4, 0.25);
    EXPECT_EQ(found.deviation, 0.25);
    EXPECT_EQ(found.stationary_deviation, 0.25);
    const gap::Whitener small = gap::fit_whitener({noise(1000, 8, 0.9)}, 4, 1.5);
    EXPECT_EQ(small.deviation, 1.5);
    EXPECT_GT(small.stationary_deviation, 1.5);
}

// Another coefficient is worth log n units of likelihood: of n samples with a correlation r it gains -n log(1 - r^2).
TEST(Whitener, PaysForEachCoefficientByBic) {
    // 100 samples: pairs of ones, `apart` from each other, and single ones, so far off that nothing else correlates.
    const auto order = [](std::size_t pairs, std::size_t singles, std::size_t apart) {
        Values values;
        for (std::size_t i = 0; i < pairs; ++i) {
            values.push_back(1.0);
            values.resize(values.size() + apart - 1, 0.0);
            values.push_back(1.0);
            values.resize(values.size() + 2, 0.0);
        }
        for (std::size_t i = 0; i < singles; ++i) {
            values.push_back(1.0);
            values.resize(values.size() + 2, 0.0);
        }
        values.resize(100, 0.0);
        return gap::fit_whitener({values}, 2, 1e-9).coefficients.size();
    };
    // r of 3/15 and 4/18: that of log 100 / 100 is 0.2120.
    EXPECT_EQ(order(3, 9, 1), 0U);
    EXPECT_EQ(order(4, 10, 1), 1U);
    // Of two lags at once twice as much: 0.2966, between 5/17 and 4/13.
    EXPECT_EQ(order(5, 7, 2), 0U);
    EXPECT_EQ(order(4, 5, 2), 2U);
}

// What rounding and a quantum leave is added to the variance, so that what is foreseen wholly has a solution.
TEST(Whitener, OfWhatIsForeseenWhollyHasASolution) {
    Values powers{1.0};
    for (int i = 0; i < 99; ++i) {
        powers.push_back(0.5 * powers.back());
    }
    const double squares = 1.0 / (1.0 - 0.25);
    const double expected = 0.5 * squares / (squares * (1.0 + 1e-9) + 100.0 * 1e-6 * 0.0025);
    EXPECT_NEAR(gap::fit_whitener({powers}, 1, 0.05).coefficients.at(0), expected, 1e-10);
    const double exact = 0.5 * squares / (squares * (1.0 + 1e-9) + 100.0 * 1e-6 * 1e-24);
    EXPECT_NEAR(gap::fit_whitener({powers}, 1, 1e-12).coefficients.at(0), exact, 1e-13);
}

TEST(Whitener, SaysHowFarApartSamplesAreNew) {
    // 1, 1, 1, ...: 1 + 2 (7/8 + 6/8), as far as a quarter of the record.
    EXPECT_NEAR(gap::fit_whitener({Values(8, 1.0)}, 1, 1e-9).samples_apart, 1.0 + 2.0 * (7.0 + 6.0) / 8.0, 1e-12);
    // What turns from sample to sample is new each time.
    EXPECT_EQ(gap::fit_whitener({Values{1, -1, 1, -1, 1, -1, 1, -1}}, 1, 1e-9).samples_apart, 1.0);
    // Two alike, then their opposites: 1 + 2 (4 - 3) / 8, up to the lag that is not positive.
    EXPECT_NEAR(gap::fit_whitener({Values{1, 1, -1, -1, 1, 1, -1, -1}}, 1, 1e-9).samples_apart, 1.25, 1e-12);
    EXPECT_NEAR(gap::fit_whitener({Values(8, 1.0), Values(8, 1.0)}, 1, 1e-9).samples_apart, 1.0 + 2.0 * 13.0 / 8.0,
                1e-12);
}

TEST(Whitener, IsSlowWhereTheNewIsAQuarterOfAll) {
    gap::Whitener whitener;
    whitener.deviation = 0.5;
    whitener.stationary_deviation = 2.0;
    EXPECT_FALSE(whitener.is_slow());
    whitener.stationary_deviation = 2.01;
    EXPECT_TRUE(whitener.is_slow());
}

TEST(BootstrapSum, OfWhatIsAlikeIsItsSum) {
    for (const std::size_t block : {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{100}}) {
        const gap::Interval over = gap::bootstrap_sum(Values(101, 0.5), block);
        EXPECT_NEAR(over.mean, 50.5, 1e-9) << block;
        EXPECT_NEAR(over.low, 50.5, 1e-9) << block;
        EXPECT_NEAR(over.high, 50.5, 1e-9) << block;
    }
}

// 5 % of a normal sum lie 1.645 deviations below it, and 5 % as far above.
TEST(BootstrapSum, HasTheSpreadOfIndependentBlocks) {
    const Values values = noise(500, 9);
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    const gap::Interval single = gap::bootstrap_sum(values, 1, 2000);
    EXPECT_NEAR(single.mean, sum, 1e-9);
    EXPECT_NEAR(single.mean - single.low, 1.645 * std::sqrt(500.0), 3.5);
    EXPECT_NEAR(single.high - single.mean, 1.645 * std::sqrt(500.0), 3.5);
    // Blocks keep what belongs together: of values in tens alike the spread is the square root of ten times as large.
    Values tens;
    for (const double value : values) {
        tens.insert(tens.end(), 10, value);
    }
    const gap::Interval blocks = gap::bootstrap_sum(tens, 100, 800);
    EXPECT_NEAR(blocks.high - blocks.low, 2.0 * 1.645 * 10.0 * std::sqrt(500.0), 110.0);
    const gap::Interval torn = gap::bootstrap_sum(tens, 1, 800);
    EXPECT_LT(torn.high - torn.low, 0.5 * (blocks.high - blocks.low));
}

// The bounds leave as many sums below as above: of the opposite values they change sides.
TEST(BootstrapSum, OfTheOppositeIsTheOpposite) {
    const Values values = noise(300, 11);
    Values opposite;
    for (const double value : values) {
        opposite.push_back(-value);
    }
    for (const std::size_t block : {std::size_t{1}, std::size_t{7}}) {
        const gap::Interval one = gap::bootstrap_sum(values, block);
        const gap::Interval other = gap::bootstrap_sum(opposite, block);
        EXPECT_NEAR(other.low, -one.high, 1e-9) << block;
        EXPECT_NEAR(other.high, -one.low, 1e-9) << block;
        EXPECT_NEAR(other.mean, -one.mean, 1e-9) << block;
    }
}

// Of powers of ten each sum tells which were drawn, and how often.
TEST(BootstrapSum, DrawsBlocksOfAQuarterOfTheValuesAtMost) {
    const auto powers = [](std::size_t count) {
        Values values{1.0};
        while (values.size() < count) {
            values.push_back(10.0 * values.back());
        }
        return values;
    };
    for (std::size_t draws = 2; draws < 12; ++draws) {
        // Eight values in blocks of two, whatever is asked for: of each two that stand together.
        for (const std::size_t asked : {std::size_t{2}, std::size_t{100}}) {
            const gap::Interval pairs = gap::bootstrap_sum(powers(8), asked, draws);
            EXPECT_EQ(std::fmod(pairs.low, 11.0), 0.0) << draws;
            EXPECT_EQ(std::fmod(pairs.high, 11.0), 0.0) << draws;
            EXPECT_EQ(std::fmod(pairs.high, 9.0), 8.0) << draws;  // eight of them
        }
        // Of eleven six blocks of two are twelve: taken for eleven.
        const gap::Interval eleven = gap::bootstrap_sum(powers(11), 2, draws);
        EXPECT_EQ(std::fmod(std::round(eleven.high * 12.0 / 11.0), 9.0), 12.0 - 9.0) << draws;
        // Three values are too few for a quarter: one by one.
        const gap::Interval three = gap::bootstrap_sum(powers(3), 100, draws);
        EXPECT_EQ(std::fmod(three.high, 9.0), 3.0) << draws;
        EXPECT_EQ(three.high, gap::bootstrap_sum(powers(3), 0, draws).high) << draws;
        EXPECT_EQ(three.high, std::round(three.high)) << draws;
    }
    // The last value is drawn as often as the first.
    EXPECT_GE(gap::bootstrap_sum(powers(11), 2, 19).high, 1e10);
    EXPECT_EQ(gap::bootstrap_sum(powers(4), 1, 2000).high, gap::bootstrap_sum(powers(4), 100, 2000).high);
}

// A twentieth of the draws lies below the lower bound: none of nineteen, one of twenty.
TEST(BootstrapSum, LeavesATwentiethOutAtEitherEnd) {
    const Values values = noise(100, 10);
    const gap::Interval nineteen = gap::bootstrap_sum(values, 5, 19);
    const gap::Interval twenty = gap::bootstrap_sum(values, 5, 20);
    EXPECT_GT(twenty.low, nineteen.low);
    EXPECT_LT(twenty.high, nineteen.high);
    const gap::Interval most = gap::bootstrap_sum(values, 5, 39);
    EXPECT_LE(most.low, twenty.low);  // still one of them
    EXPECT_GE(most.high, twenty.high);
    EXPECT_GE(gap::bootstrap_sum(values, 5, 40).low, most.low);
}

// Of two draws the one is the lower bound and the other the upper.
TEST(BootstrapSum, OfFewDrawsIsTheirRange) {
    const Values values = noise(100, 10);
    const gap::Interval two = gap::bootstrap_sum(values, 5, 2);
    EXPECT_LT(two.low, two.high);
    const gap::Interval many = gap::bootstrap_sum(values, 5, 39);  // the second of them from either end
    EXPECT_LT(many.low, many.high);
}

}  // namespace
