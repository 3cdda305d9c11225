// Nelder and Mead's rules: where a simplex asks next, by what it was answered.
#include "drive/stand/blind/simplex.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace {

using stand::blind::along;
using stand::blind::descend_simplex;
using stand::blind::Point3;
using testing::DoubleNear;
using testing::ElementsAre;

/// The points that are asked for, the n-th of them answered by answer(n). Not to be told apart at first, then all
/// alike: so the search ends behind the answers that are given.
std::vector<Point3> asked(const std::vector<double>& answers, const Point3& first = {0.0, 0.0, 0.0}) {
    std::vector<Point3> points;
    descend_simplex(
        first, 0.5,
        [&](const Point3& point) {
            points.push_back(point);
            return points.size() <= answers.size() ? answers[points.size() - 1] : 1e3;
        },
        1);
    return points;
}

auto at(double x, double y, double z) {
    return ElementsAre(DoubleNear(x, 1e-12), DoubleNear(y, 1e-12), DoubleNear(z, 1e-12));
}

// Corners at 0 and 0.5 in each direction, the last the worst: the middle of the others is (1, 1, 0) / 6.
TEST(Simplex, BeginsBesideItsFirstPoint) {
    const auto points = asked({1.0, 2.0, 3.0, 4.0, 2.5}, {0.25, -1.0, 4.0});
    ASSERT_EQ(points.size(), 5U);
    EXPECT_THAT(points[0], at(0.25, -1.0, 4.0));
    EXPECT_THAT(points[1], at(0.75, -1.0, 4.0));
    EXPECT_THAT(points[2], at(0.25, -0.5, 4.0));
    EXPECT_THAT(points[3], at(0.25, -1.0, 4.5));
    EXPECT_THAT(points[4], at(0.25 + 1.0 / 3.0, -1.0 + 1.0 / 3.0, 3.5));
}

TEST(Simplex, MirrorsItsWorstCorner) {
    // Whichever is the worst.
    EXPECT_THAT(asked({4.0, 1.0, 2.0, 3.0, 2.5}).back(), at(1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0));
    // Better than the second worst is enough; better than the best asks for twice as far; as good as either is not.
    EXPECT_EQ(asked({1.0, 2.0, 3.0, 4.0, 2.9}).size(), 5U);
    EXPECT_EQ(asked({1.0, 2.0, 3.0, 4.0, 1.0}).size(), 5U);
    const auto further = asked({1.0, 2.0, 3.0, 4.0, 0.5, 0.25});
    ASSERT_EQ(further.size(), 6U);
    EXPECT_THAT(further[5], at(0.5, 0.5, -1.0));
    // As bad as the second worst: nearer, on its side; as bad as the worst: nearer on the side of that.
    EXPECT_THAT(asked({1.0, 2.0, 3.0, 4.0, 3.0, 2.0}).back(), at(0.25, 0.25, -0.25));
    EXPECT_THAT(asked({1.0, 2.0, 3.0, 4.0, 4.0, 2.0}).back(), at(1.0 / 12.0, 1.0 / 12.0, 0.25));
}

// Where nearer is no better than both, all move halfway to the best.
TEST(Simplex, ShrinksTowardsItsBestCorner) {
    for (const auto& [mirrored, nearer] : {std::pair(3.5, 3.5), std::pair(5.0, 4.0)}) {
        const auto points = asked({1.0, 2.0, 3.0, 4.0, mirrored, nearer});
        ASSERT_EQ(points.size(), 9U);
        EXPECT_THAT(points[6], at(0.25, 0.0, 0.0));
        EXPECT_THAT(points[7], at(0.0, 0.25, 0.0));
        EXPECT_THAT(points[8], at(0.0, 0.0, 0.25));
    }
    EXPECT_EQ(asked({1.0, 2.0, 3.0, 4.0, 3.5, 3.4}).size(), 6U);
}

/// How often it asks.
std::size_t questions(const std::function<double(std::size_t)>& answer) {
    std::size_t count = 0;
    descend_simplex({0.0, 0.0, 0.0}, 1.0, [&](const Point3&) { return answer(count++); });
    return count;
}

TEST(Simplex, EndsWhereItsCornersAreAlike) {
    EXPECT_EQ(questions([](std::size_t) { return 1.0; }), 4U);
    EXPECT_EQ(questions([](std::size_t n) { return n == 3 ? 1.0000999 : 1.0; }), 4U);
    EXPECT_GT(questions([](std::size_t n) { return n == 3 ? 1.0001001 : 1.0; }), 4U);
    EXPECT_EQ(questions([](std::size_t) { return 0.0; }), 4U);
    // What becomes better for ever takes 120 steps, each with a point mirrored and one further.
    EXPECT_EQ(questions([](std::size_t n) { return std::pow(0.9, static_cast<double>(n)); }), 4U + 2U * 120U);
}

// What takes over: the better of a mirrored point and one further on. Seen by where the next step mirrors.
TEST(Simplex, KeepsTheBetterOfTwo) {
    const auto second_mirror = [](double mirrored, double further) {
        std::vector<double> answers{1.0, 2.0, 3.0, 4.0, mirrored, further};
        std::vector<Point3> points;
        descend_simplex(
            {0.0, 0.0, 0.0}, 0.5,
            [&](const Point3& point) {
                points.push_back(point);
                return points.size() <= answers.size() ? answers[points.size() - 1] : 1.5;
            },
            2);
        return points.at(6);
    };
    // Now (0, 0.5, 0) is the worst, and the middle that of 0, (0.5, 0, 0) and what took over.
    EXPECT_THAT(second_mirror(0.5, 0.25), at(2.0 / 3.0, 1.0 / 3.0 - 0.5, -2.0 / 3.0));
    EXPECT_THAT(second_mirror(0.5, 0.5), at(5.0 / 9.0, 2.0 / 9.0 - 0.5, -1.0 / 3.0));
}

TEST(Simplex, FindsTheBottomOfAValley) {
    Point3 best{};
    double least = 1e9;
    descend_simplex({0.0, 0.0, 0.0}, 0.3, [&](const Point3& p) {
        const double cost =
            1.0 + std::pow(p[0] - 0.7, 2) + 4.0 * std::pow(p[1] + 0.2 - p[0], 2) + std::pow(p[2] - 1.1, 2);
        if (cost < least) {
            least = cost;
            best = p;
        }
        return cost;
    });
    EXPECT_THAT(best, ElementsAre(DoubleNear(0.7, 0.02), DoubleNear(0.5, 0.02), DoubleNear(1.1, 0.02)));
    EXPECT_THAT(along({1.0, 2.0, 3.0}, {2.0, 2.0, 7.0}, -2.0), ElementsAre(-1.0, 2.0, -5.0));
}

}  // namespace
