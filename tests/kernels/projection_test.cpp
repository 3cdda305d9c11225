// The nodes of the tail's integral, their projection, and how fits and merged tables choose poles by them: each against
// the formula that its header names.
#include "glsum/design/projection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "glsum/design/bdf.hpp"
#include "glsum/design/fitted.hpp"
#include "glsum/design/merged.hpp"

namespace {

using glsum::Mode;
using glsum::design::Node;
using glsum::design::Projection;
using glsum::design::tail_nodes;

// The trapezoid's step: pi^2 / log(10^4 / error), 0.3 to 0.6.
double step_of(const std::vector<Node>& nodes) { return std::log(nodes[2].rate / nodes[1].rate); }

TEST(TailNodes, LieEvenlyInTheLogarithmOfTheirRates) {
    const double squared = std::numbers::pi * std::numbers::pi;
    EXPECT_NEAR(step_of(tail_nodes(0.5, 2, 1000, 1e-6)), squared / std::log(1e10), 1e-12);
    EXPECT_NEAR(step_of(tail_nodes(0.5, 2, 1000, 1e-2)), 0.6, 1e-12);
    EXPECT_NEAR(step_of(tail_nodes(0.5, 2, 1000, 1e-11)), 0.3, 1e-12);
    for (const double order : {0.5, 1.5, -0.5, 0.98}) {
        for (const std::size_t near_taps : {2U, 5U}) {
            const double error = 1e-8;
            const std::size_t horizon = 5000;
            const std::vector<Node> nodes = tail_nodes(order, near_taps, horizon, error);
            const double step = squared / std::log(1e12);
            const double first = std::sqrt(error * 1e-4) / 5000.0;
            const double room = static_cast<double>(near_taps) - order;
            const double density = step * std::fabs(std::sin(std::numbers::pi * order)) / std::numbers::pi;
            for (std::size_t i = 1; i < nodes.size(); ++i) {
                const double s = first * std::exp(step * static_cast<double>(i - 1));
                EXPECT_NEAR(nodes[i].rate / s, 1.0, 1e-11);
                const double integrand = density * s * std::exp(-s * room) * std::pow(-std::expm1(-s), order);
                EXPECT_NEAR(nodes[i].root * nodes[i].root / integrand, 1.0, 1e-9) << i;
            }
            // To where e^-x is below a double's last bit.
            EXPECT_LT(nodes.back().rate, 38.0 / room);
            EXPECT_GE(nodes.back().rate * std::exp(step), 38.0 / room);
            // All nodes to the left, where 1 - e^-s is s, as one with their weight and their mean rate.
            double total = 0.0;
            double moment = 0.0;
            for (int i = 1; i < 400; ++i) {
                const double s = first * std::exp(-step * i);
                total += density * std::pow(s, 1.0 + order);
                moment += density * std::pow(s, 2.0 + order);
            }
            EXPECT_NEAR(nodes[0].root * nodes[0].root / total, 1.0, 1e-9) << order;
            EXPECT_NEAR(nodes[0].rate / (moment / total), 1.0, 1e-9) << order;
        }
    }
}

// A factor e^-38 is below every double's last bit: of order 0.5 and two taps s ends at 38/1.5. With these horizons the
// node 68 steps on lies half a percent before that, and half a percent beyond.
TEST(TailNodes, EndWhereEveryDoubleHasFaded) {
    for (const std::size_t horizon : {1403U, 1389U}) {
        const std::vector<Node> nodes = tail_nodes(0.5, 2, horizon, 1e-8);
        const double first = std::sqrt(1e-12) / static_cast<double>(horizon);
        const double step = std::numbers::pi * std::numbers::pi / std::log(1e12);
        const double next = first * std::exp(68.0 * step) / (38.0 / 1.5);
        EXPECT_NEAR(next, horizon == 1403 ? 0.995 : 1.005, 5e-4);
        // The one that stands for all slower ones, then those from `first` on.
        EXPECT_EQ(nodes.size(), horizon == 1403 ? 1U + 69U : 1U + 68U);
    }
}

TEST(TailNodes, NeedTapsBeyondTheOrder) {
    EXPECT_EQ(glsum::design::least_near_taps(0.5), 1U);
    EXPECT_EQ(glsum::design::least_near_taps(0.75), 1U);  // a quarter above
    EXPECT_EQ(glsum::design::least_near_taps(0.76), 2U);
    EXPECT_EQ(glsum::design::least_near_taps(1.75), 2U);
    EXPECT_EQ(glsum::design::least_near_taps(1.76), 3U);
    EXPECT_EQ(glsum::design::least_near_taps(-0.5), 1U);
    EXPECT_EQ(glsum::design::least_near_taps(-0.9), 1U);
}

// Two exponentials: the eigenvalues of two by two.
TEST(Projection, OfTwoNodesIsByHand) {
    const std::vector<Node> nodes{{0.1, 0.5}, {0.7, 0.8}};
    const Projection projection(nodes, 100);
    EXPECT_EQ(projection.size(), 2U);
    const auto gram = [](const Node& a, const Node& b) {
        return a.root * b.root / (1.0 - std::exp(-(a.rate + b.rate + 0.02)));  // discounted by two over the horizon
    };
    const double p = gram(nodes[0], nodes[0]);
    const double q = gram(nodes[1], nodes[1]);
    const double r = gram(nodes[0], nodes[1]);
    const double large = 0.5 * (p + q) + std::sqrt(0.25 * (p - q) * (p - q) + r * r);
    const double small = p + q - large;
    EXPECT_NEAR(projection.dropped(0), 2.0 * (p + q), 1e-12);
    EXPECT_NEAR(projection.dropped(1), 2.0 * small, 1e-12);
    EXPECT_EQ(projection.dropped(2), 0.0);
    // On both nothing is lost: the nodes themselves, slowest first.
    const std::vector<Mode> both = projection.modes(2);
    ASSERT_EQ(both.size(), 2U);
    EXPECT_NEAR(both[0].decay, 1.0 - std::exp(-0.1), 1e-12);
    EXPECT_NEAR(both[0].weight, 0.25, 1e-12);
    EXPECT_NEAR(both[1].decay, 1.0 - std::exp(-0.7), 1e-12);
    EXPECT_NEAR(both[1].weight, 0.64, 1e-12);
    // On the first eigenvector (r, large - p), normed.
    const double norm = std::hypot(r, large - p);
    const double x = r / norm;
    const double y = (large - p) / norm;
    const std::vector<Mode> one = projection.modes(1);
    ASSERT_EQ(one.size(), 1U);
    EXPECT_NEAR(one[0].decay, x * x * (1.0 - std::exp(-0.1)) + y * y * (1.0 - std::exp(-0.7)), 1e-12);
    EXPECT_NEAR(one[0].weight, std::pow(x * 0.5 + y * 0.8, 2.0), 1e-12);
    EXPECT_TRUE(projection.modes(0).empty());
}

// Weights of two poles by the normal equations, over each index at first, then those 4 % apart; each has the weight j
// times the root of its share of the logarithm.
std::vector<double> least_squares(const std::vector<Mode>& modes, const std::vector<double>& weights,
                                  std::size_t near_taps) {
    std::vector<std::size_t> indices;
    for (double at = static_cast<double>(near_taps); at <= static_cast<double>(weights.size() - 1);) {
        indices.push_back(static_cast<std::size_t>(at + 0.5));
        at = at < 25.0 ? at + 1.0 : 1.04 * at;
    }
    double pp = 0.0, pq = 0.0, qq = 0.0, pw = 0.0, qw = 0.0;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const std::size_t j = indices[i];
        const bool last = i + 1 == indices.size();
        const std::size_t width = indices.size() == 1 ? 1 : last ? j - indices[i - 1] : indices[i + 1] - j;
        const double weight = static_cast<double>(j * width);
        const double p = std::pow(1.0 - modes[0].decay, static_cast<double>(j - near_taps));
        const double q = std::pow(1.0 - modes[1].decay, static_cast<double>(j - near_taps));
        pp += weight * p * p;
        pq += weight * p * q;
        qq += weight * q * q;
        pw += weight * p * weights[j];
        qw += weight * q * weights[j];
    }
    const double determinant = pp * qq - pq * pq;
    return {(pw * qq - qw * pq) / determinant, (qw * pp - pw * pq) / determinant};
}

TEST(FittedModes, WeightsAreLeastSquaresThatSeeEachDecadeAlike) {
    const std::vector<double> weights = glsum::design::bdf_weights(2, 0.5, 1200);
    for (const std::size_t near_taps : {1U, 4U, 12U, 40U}) {
        std::vector<Mode> modes{{0.004, 0.0}, {0.15, 0.0}};
        glsum::design::fit_weights(modes, weights, near_taps);
        const std::vector<double> expected = least_squares(modes, weights, near_taps);
        EXPECT_NEAR(modes[0].weight / expected[0], 1.0, 1e-9) << near_taps;
        EXPECT_NEAR(modes[1].weight / expected[1], 1.0, 1e-9) << near_taps;
        EXPECT_EQ(modes[0].decay, 0.004);
    }
    // A single index is met as it is.
    std::vector<Mode> one{{0.5, 0.0}};
    glsum::design::fit_weights(one, {1.0, -0.5, 0.125}, 2);
    EXPECT_NEAR(one[0].weight, 0.125, 1e-15);
}

void expect_poles(const std::vector<Mode>& found, const std::vector<Mode>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t m = 0; m < found.size(); ++m) {
        EXPECT_NEAR(found[m].decay / expected[m].decay, 1.0, 1e-12) << m;
    }
}

// Poles are those of the order's own tail, from two taps before, where it has one.
TEST(FittedModes, HaveThePolesOfTheOrdersTail) {
    for (const double order : {0.5, 0.9, 1.9}) {
        const std::vector<double> weights = glsum::design::bdf_weights(2, order, 801);
        for (const std::size_t near_taps : {1U, 2U, 3U, 4U, 9U}) {
            const std::size_t least = glsum::design::least_near_taps(order);
            if (near_taps < least) {
                continue;
            }
            const std::size_t from = near_taps < least + 2 ? least : near_taps - 2;
            const Projection projection(tail_nodes(order, from, weights.size() - 1, 1e-10), weights.size() - 1);
            expect_poles(glsum::design::approximate_fitted(weights, order, near_taps, 6).modes, projection.modes(6));
        }
    }
}

// Of a merged table: those of all its terms' tails together, each weighed by the root of what it counts.
TEST(MergedModes, HaveThePolesOfAllTheirTails) {
    using glsum::design::Discretisation;
    const glsum::design::Term terms[] = {{-0.2, 1.9}, {0.7, 0.6}, {3.0, 1.0}};
    for (const auto& [scheme, near_taps, from] :
         {std::tuple(Discretisation::grunwald_letnikov, 2U, 2U), std::tuple(Discretisation::grunwald_letnikov, 7U, 7U),
          std::tuple(Discretisation::bdf2, 2U, 2U), std::tuple(Discretisation::bdf2, 4U, 2U),
          std::tuple(Discretisation::bdf2, 5U, 3U), std::tuple(Discretisation::bdf2, 9U, 7U)}) {
        std::vector<Node> nodes;
        for (const auto& [coefficient, order] : {std::pair(0.2, 1.9), std::pair(0.7, 0.6)}) {
            for (Node node : tail_nodes(order - 1.0, from, 3000, 1e-9)) {
                node.root *= std::sqrt(coefficient / std::pow(0.01, order));
                nodes.push_back(node);
            }
        }
        const Projection projection(nodes, 3000);
        const auto found = glsum::design::approximate_merged(terms, 0.01, scheme, 3000, near_taps, 5);
        EXPECT_EQ(found.near_taps, near_taps);
        expect_poles(found.modes, projection.modes(5));
        // Their weights are the least squares of the merged table, and the error what is left.
        std::vector<Mode> again = found.modes;
        const auto weights = glsum::design::merged_weights(terms, 0.01, scheme, 3000);
        glsum::design::fit_weights(again, weights, near_taps);
        double error = 0.0;
        for (std::size_t j = near_taps; j <= 3000; ++j) {
            double sum = 0.0;
            for (const Mode& mode : again) {
                sum += mode.weight * std::pow(1.0 - mode.decay, static_cast<double>(j - near_taps));
            }
            error += std::fabs(weights[j] - sum);
        }
        for (std::size_t m = 0; m < again.size(); ++m) {
            EXPECT_EQ(found.modes[m].weight, again[m].weight);
        }
        EXPECT_NEAR(found.error / error, 1.0, 1e-6);
    }
}

}  // namespace
