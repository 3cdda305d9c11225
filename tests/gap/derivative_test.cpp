// The weights of a fractional derivative on increments: near ones as the generating function has them, far ones as the
// exponentials make them; and the sum over a signal's past.
#include "gap/drive/derivative.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <type_traits>
#include <vector>

namespace {

// (1 - z)^(v-1) ((3 - z)/2)^v, term by term.
std::vector<double> weights(double v, std::size_t count) {
    std::vector<long double> plain{1.0L};
    std::vector<long double> factor{std::pow(1.5L, static_cast<long double>(v))};
    for (std::size_t k = 1; k < count; ++k) {
        const auto n = static_cast<long double>(k);
        plain.push_back(plain.back() * (n - static_cast<long double>(v)) / n);
        factor.push_back(factor.back() * (n - 1.0L - static_cast<long double>(v)) / (3.0L * n));
    }
    std::vector<double> all;
    for (std::size_t k = 0; k < count; ++k) {
        long double sum = 0.0L;
        for (std::size_t j = 0; j <= std::min<std::size_t>(k, 80); ++j) {
            sum += factor[j] * plain[k - j];
        }
        all.push_back(static_cast<double>(sum));
    }
    return all;
}

constexpr std::size_t near_count = static_cast<std::size_t>(gap::Exponentials::near_count);

double at(const gap::Exponentials& exponentials, const gap::Table& table, std::size_t k) {
    if (k < near_count) {
        return table.near(static_cast<Eigen::Index>(k));
    }
    return (table.far.array() * exponentials.ratios().pow(static_cast<double>(k - near_count))).sum();
}

TEST(Derivative, HasTheWeightsOfItsGeneratingFunction) {
    const gap::Exponentials exponentials(4000);
    EXPECT_EQ(exponentials.horizon(), 4000U);
    EXPECT_GT(exponentials.ratios().minCoeff(), 0.0);
    EXPECT_LT(exponentials.ratios().maxCoeff(), 1.0);
    for (const double order : {0.3, 0.98319, 1.5, 1.9909, 2.6}) {
        const gap::Table table = exponentials.table(order);
        const std::vector<double> wanted = weights(order, 4001);
        for (std::size_t k = 0; k < near_count; ++k) {
            EXPECT_NEAR(at(exponentials, table, k), wanted[k], 1e-13) << order << " " << k;
        }
        for (std::size_t k = near_count; k <= 4000; k += 7) {
            EXPECT_NEAR(at(exponentials, table, k), wanted[k], 2e-5 * std::fabs(wanted[k]) + 1e-12)
                << order << " " << k;
        }
    }
}

// Five decays a decade, evenly, from one that lasts twice the horizon to one gone in half a sample.
TEST(Derivative, DecaysAreFiveADecade) {
    const auto check = [](std::size_t horizon, Eigen::Index count) {
        const Eigen::ArrayXd lasts = -1.0 / gap::Exponentials(horizon).ratios().log();  // samples
        ASSERT_EQ(lasts.size(), count) << horizon;
        const double slowest = 2.0 * static_cast<double>(horizon);
        EXPECT_NEAR(lasts(0), slowest, 1e-9 * slowest);
        EXPECT_NEAR(lasts(count - 1), 0.5, 1e-9);
        for (Eigen::Index m = 1; m < count; ++m) {
            EXPECT_NEAR(lasts(m) / lasts(m - 1), std::pow(0.5 / slowest, 1.0 / static_cast<double>(count - 1)), 1e-9);
        }
    };
    check(250, 15);  // three decades
    check(251, 16);
    check(2500, 20);  // four
    check(2501, 21);
}

// Every sample behind the near ones, then every twentieth of the way: some hundred and eighty of a hundred thousand.
TEST(Derivative, IsFittedAtFewPlaces) {
    const gap::Exponentials exponentials(100000);
    const std::vector<std::size_t>& places = exponentials.fitted_at();
    EXPECT_EQ(places.front(), near_count);
    EXPECT_LE(places.back(), 100000U);
    EXPECT_GT(places.back(), 95000U);
    for (std::size_t i = 1; i < places.size(); ++i) {
        const double apart = static_cast<double>(places[i] - places[i - 1]);
        EXPECT_NEAR(apart, std::max(1.0, 0.05 * static_cast<double>(places[i - 1])), 1.0) << places[i];
        EXPECT_GE(apart, 1.0);
    }
    EXPECT_NEAR(static_cast<double>(places.size()), 6.0 + std::log(100000.0 / 20.0) / std::log(1.05), 2.0);
}

// Of whole orders the rest is a power of a third: nothing of it is remembered.
TEST(Derivative, OfAWholeOrderHasNoMemory) {
    const gap::Exponentials exponentials(100);
    for (const double order : {1.0, 2.0}) {
        const gap::Table table = exponentials.table(order);
        const std::vector<double> wanted = weights(order, near_count);
        for (std::size_t k = 0; k < near_count; ++k) {
            EXPECT_NEAR(at(exponentials, table, k), wanted[k], 1e-13) << order << " " << k;
        }
        EXPECT_EQ(table.far.cwiseAbs().sum(), 0.0);
    }
    EXPECT_EQ(gap::Exponentials(5).horizon(), 32U);
}

// As the weights of a table say, sample by sample.
template <class Past>
void expect_sums(const gap::Exponentials& exponentials, const gap::Table& table, Past past) {
    std::mt19937_64 engine(1);
    std::normal_distribution<double> normal;
    EXPECT_EQ(past.newest(), table.near(0));
    std::vector<double> increments;
    for (std::size_t n = 0; n < 200; ++n) {
        double sum = 0.0;
        for (std::size_t j = 1; j <= n; ++j) {
            sum += at(exponentials, table, j) * increments[n - j];
        }
        ASSERT_NEAR(past.known(), sum, 1e-9) << n;
        increments.push_back(normal(engine));
        past.push(increments.back());
    }
}

TEST(Derivative, SumsThePast) {
    const gap::Exponentials exponentials(400);
    for (const double order : {0.6, 1.0, 1.7, 2.0}) {
        const gap::Table table = exponentials.table(order);
        expect_sums(exponentials, table, gap::Past(exponentials, table));
    }
}

TEST(Derivative, OfWholeOrdersHasAShortPast) {
    const gap::Exponentials exponentials(400);
    for (const double order : {1.0, 2.0, 3.0}) {
        const gap::Table table = exponentials.table(order);
        ASSERT_TRUE(gap::ShortPast::holds(table)) << order;
        expect_sums(exponentials, table, gap::ShortPast(table));
    }
    const auto is_short = [&](const gap::Table& table) {
        return gap::with_past(exponentials, table,
                              [](const auto& past) { return std::is_same_v<decltype(past), const gap::ShortPast&>; });
    };
    EXPECT_TRUE(is_short(exponentials.table(3.0)));
    EXPECT_FALSE(is_short(exponentials.table(0.98319)));
    gap::Table one_more = exponentials.table(3.0);
    one_more.near(6) = 1e-3;
    EXPECT_FALSE(is_short(one_more));
    gap::Table far = exponentials.table(1.0);
    far.far(2) = 1e-3;
    EXPECT_FALSE(is_short(far));
}

// What came evenly: as many increments alike as there are near weights.
TEST(Derivative, MayBeginWithAnEvenPast) {
    const gap::Exponentials exponentials(400);
    const gap::Table table = exponentials.table(0.7);
    gap::Past past(exponentials, table);
    past.fill_near(0.25);
    double sum = 0.0;
    for (std::size_t k = 1; k < near_count; ++k) {
        sum += 0.25 * at(exponentials, table, k);
    }
    EXPECT_NEAR(past.known(), sum, 1e-12);
    const gap::Table third = exponentials.table(3.0);
    gap::ShortPast few(third);
    few.fill_near(0.25);
    EXPECT_NEAR(few.known(), 0.25 * (third.near.sum() - third.near(0)), 1e-12);
}

}  // namespace
