// The oracle against closed forms (30 digits) and published values (every printed digit).
#include "reference/sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "reference/bdf.hpp"
#include "reference/dropped.hpp"
#include "reference/full_sums.hpp"
#include "reference/modes.hpp"
#include "tests/bench/closed_forms.hpp"
#include "tests/bench/digits.hpp"

namespace {

using reference::Real;

constexpr const char* order_texts[] = {"0.3", "0.5", "0.9", "0.98319", "1.9909", "-0.5", "1.5", "-1.3"};
constexpr std::size_t samples = 650;

Real to_real(const reference::Exact& exact) { return Real(exact.high) + Real(exact.low); }

// S_k of a record with full memory, for an order in decimals.
reference::Sums full_sums(const char* order, const std::vector<double>& record) {
    const std::size_t lengths[] = {record.size()};
    return reference::sums(reference::weights(Real(order), record.size()), record, lengths).front();
}

TEST(Reference, WeightsAreTheBinomialCoefficients) {
    for (const char* order : order_texts) {
        const auto a = reference::weights(Real(order), samples);
        for (unsigned k = 0; k < samples; k += k < 10 ? 1 : 80) {
            digits::expect_thirty(a[k], closed_form::weight(Real(order), k), std::string(order) + " weight");
        }
    }
}

TEST(Reference, OneProductHasTheSumsOfTheDefinition) {
    std::vector<double> record;
    for (std::size_t k = 0; k < samples; ++k) {
        record.push_back((k % 7 < 3 ? -1.0 : 0.3) * std::pow(1e-3, static_cast<double>(k % 4)));
    }
    for (const char* order : {"0.5", "-1.3", "1.9909"}) {
        for (const double sign : {1.0, -1.0}) {
            std::vector<double> signed_record = record;
            std::ranges::transform(record, signed_record.begin(), [&](double x) { return sign * x; });
            const auto expected = full_sums(order, signed_record);
            const auto found = reference::full_sums(reference::weights(Real(order), samples), signed_record);
            ASSERT_EQ(found.size(), expected.size());
            for (std::size_t k = 0; k < samples; ++k) {
                EXPECT_LE(abs(to_real(found[k]) - to_real(expected[k])), abs(to_real(expected[k])) * 1e-31 + 1e-43)
                    << order << " " << k;
            }
        }
    }
    EXPECT_TRUE(reference::full_sums(reference::weights(Real(0.5), 3), {}).empty());
    // One product holds all sums side by side, so a negative one borrows from the next: here from a sum of exactly 0.
    const std::vector<double> negative(2, -1.0);
    const auto differences = reference::full_sums(reference::weights(Real(1.0), 2), negative);
    EXPECT_EQ(differences[0].high, -1.0);
    EXPECT_EQ(to_real(differences[1]), Real(0.0));
    EXPECT_THROW((void)reference::full_sums(reference::weights(Real(0.5), 3), std::vector<double>{1e20}),
                 std::invalid_argument);
}

// Order 1 has the weights 1, -1: by hand what one tap, and of increments two, make of the rest.
TEST(Reference, WhatIsDroppedStandsForWhatItsHistorySays) {
    using reference::Dropped;
    const auto expect = [](Dropped dropped, const glsum::Design& design, const std::vector<double>& weights) {
        const auto found = reference::weights_of(dropped, design, weights.size());
        ASSERT_EQ(found.size(), weights.size());
        for (std::size_t j = 0; j < weights.size(); ++j) {
            EXPECT_EQ(found[j], Real(weights[j])) << static_cast<int>(dropped) << " " << j;
        }
    };
    expect(Dropped::zero, {1.0, 1}, {1.0, 0.0, 0.0});
    expect(Dropped::held, {1.0, 1}, {0.0, 0.0, 0.0});
    expect(Dropped::line, {1.0, 1}, {0.5, 0.0, -0.5});
    expect(Dropped::line, {1.0, 1}, {0.25, 0.0, 0.0, 0.0, -0.25});
    expect(Dropped::increments, {1.0, 1}, {1.0, -1.0, 0.0});
    expect(Dropped::increments, {2.0, 2}, {1.0, -2.0, 1.0, 0.0});
    expect(Dropped::increments, {0.0, 2}, {1.0, 0.0, -1.0, 0.0});
    expect(Dropped::held, {-1.0, 2}, {1.0, 3.0, 0.0, 0.0});
    expect(Dropped::line, {-1.0, 2}, {1.0, 1.5, 0.0, 1.5});
}

// The sums of a record are those of its weights, however they were come by.
TEST(Reference, SumsOfWhatIsDroppedAreThoseOfItsWeights) {
    using reference::Dropped;
    const std::vector<glsum::Mode> modes = {{0.01, -0.01}, {0.25, -0.125}};
    std::vector<double> record(60);
    for (std::size_t k = 0; k < record.size(); ++k) {
        record[k] = (static_cast<double>(k * k * 7 % 31) - 15.0) / 16.0;
    }
    for (const Dropped dropped : {Dropped::zero, Dropped::increments, Dropped::held, Dropped::line}) {
        for (const double order : {0.5, 0.2, -0.5, 1.5}) {
            std::vector<glsum::Design> designs = {{order, 1}, {order, 5}, {order, 80}};
            if (dropped == Dropped::zero || dropped == Dropped::increments) {
                designs.push_back({order, 7, modes});
            }
            for (const glsum::Design& design : designs) {
                const auto sums = reference::sums_of(dropped, design, record);
                for (std::size_t k = 0; k < record.size(); ++k) {
                    const auto weights = reference::weights_of(dropped, design, k + 1);
                    Real sum = 0;
                    for (std::size_t j = 0; j <= k; ++j) {
                        sum += weights[j] * Real(record[k - j]);
                    }
                    EXPECT_NEAR(static_cast<double>(Real(sum - to_real(sums[k]))), 0.0, 1e-29)
                        << static_cast<int>(dropped) << " order " << order << ", taps " << design.taps << ", k " << k;
                }
            }
        }
    }
}

// In one pass for all lengths, or one at a time.
TEST(Reference, SumsOfWindowsAreThoseOfEachLength) {
    using reference::Dropped;
    const std::vector<std::size_t> lengths = {1, 5, 17, 60};
    std::vector<double> record(60);
    for (std::size_t k = 0; k < record.size(); ++k) {
        record[k] = (static_cast<double>(k * k * 7 % 31) - 15.0) / 16.0;
    }
    for (const double order : {0.5, 1.5}) {
        const auto ended = reference::sums(reference::weights(Real(order), record.size()), record, lengths);
        for (const Dropped dropped : {Dropped::zero, Dropped::increments, Dropped::held, Dropped::line}) {
            const auto windows = reference::sums_of_windows(dropped, order, record, lengths, ended);
            for (std::size_t i = 0; i < lengths.size(); ++i) {
                for (std::size_t k = 0; k < record.size(); ++k) {
                    const auto weights = reference::weights_of(dropped, {order, lengths[i]}, k + 1);
                    Real sum = 0;
                    for (std::size_t j = 0; j <= k; ++j) {
                        sum += weights[j] * Real(record[k - j]);
                    }
                    EXPECT_NEAR(static_cast<double>(Real(sum - to_real(windows.at(i).at(k)))), 0.0, 1e-29)
                        << static_cast<int>(dropped) << " order " << order << ", taps " << lengths[i] << ", k " << k;
                }
            }
        }
    }
}

TEST(Reference, StepRampAndBinomialsHaveTheirClosedForms) {
    std::vector<double> ones(samples, 1.0);
    std::vector<double> ramp(samples);
    std::iota(ramp.begin(), ramp.end(), 0.0);
    std::vector<double> binomial(samples);
    for (std::size_t k = 0; k < samples; ++k) {
        binomial[k] = static_cast<double>((k + 1) * (k + 2) * (k + 3) / 6);
    }
    for (const char* order : order_texts) {
        const Real v(order);
        const auto of_step = full_sums(order, ones);
        const auto of_ramp = full_sums(order, ramp);
        const auto of_binomial = full_sums(order, binomial);
        for (unsigned k = 1; k < samples; k += k < 10 ? 1 : 80) {
            digits::expect_thirty(to_real(of_step[k]), closed_form::of_step(v, k), std::string(order) + " step");
            digits::expect_thirty(to_real(of_ramp[k]), closed_form::of_ramp(v, k), std::string(order) + " ramp");
            digits::expect_thirty(to_real(of_binomial[k]), closed_form::of_binomial(v, 3, k),
                                  std::string(order) + " binomial");
        }
    }
}

TEST(Reference, TruncatedWindowsHaveTheirClosedForm) {
    const std::vector<double> ones(samples, 1.0);
    const std::size_t lengths[] = {1, 50, 100, 600};
    for (const char* order : order_texts) {
        const auto sums = reference::sums(reference::weights(Real(order), samples), ones, lengths);
        for (std::size_t i = 0; i < std::size(lengths); ++i) {
            const auto last = static_cast<unsigned>(lengths[i] - 1);
            digits::expect_thirty(to_real(sums[i][samples - 1]), closed_form::of_step(Real(order), last), order);
            digits::expect_thirty(to_real(sums[i][20]), closed_form::of_step(Real(order), std::min(last, 20U)), order);
        }
    }
}

TEST(Reference, GrowingExponentialsHaveTheirGain) {
    // x_k = 2^k: S_k -> (1 - 1/2)^v 2^k; the start has died out after 150 samples.
    // x_k = Re (2i)^k: the same with q = 2i, 1 - 1/q = 1 + i/2.
    std::vector<double> real(160);
    std::vector<double> turning(160);
    for (std::size_t k = 0; k < real.size(); ++k) {
        real[k] = std::ldexp(1.0, static_cast<int>(k));
        turning[k] = k % 2 == 1 ? 0.0 : (k % 4 == 0 ? real[k] : -real[k]);
    }
    for (const char* order : order_texts) {
        const Real v(order);
        const unsigned k = 159;
        const Real scale = pow(Real(2), k);
        digits::expect_thirty(to_real(full_sums(order, real)[k]), pow(Real(0.5), v) * scale, order);
        const Real pi = acos(Real(-1));
        const Real gain = pow(Real(1.25), v / 2);
        const Real angle = v * atan(Real(0.5)) + pi / 2 * k;
        digits::expect_thirty(to_real(full_sums(order, turning)[k]), gain * cos(angle) * scale, order);
    }
}

TEST(Reference, OrdersAddUp) {
    const auto a = reference::weights(Real("0.3"), samples);
    const auto b = reference::weights(Real("0.9"), samples);
    const auto both = reference::weights(Real("1.2"), samples);
    for (std::size_t k = 0; k < samples; k += 31) {
        Real sum = 0;
        for (std::size_t j = 0; j <= k; ++j) {
            sum += a[j] * b[k - j];
        }
        digits::expect_thirty(sum, both[k], "semi-group");
    }
}

struct Printed {
    const char* order;
    const char* a_600;
    const char* sum_600;
};

TEST(Reference, ReproducesPrintedValues) {
    const Printed table[] = {
        {"0.3", "-5.6542190829677256e-5", "0.11302783946852484"},
        {"0.5", "-1.9206126162304156e-5", "0.023028145268602683"},
        {"0.9", "-4.9892332872996943e-7", "3.3211662915791632e-4"},
        {"0.98319", "-5.1692017855140139e-8", "3.1493798388967634e-5"},
        {"1.9909", "8.8993414407474164e-11", "-2.6731062160701521e-8"},
        {"-0.5", "0.023028145268602683", "27.656802467591822"},
    };
    for (const Printed& row : table) {
        const auto a = reference::weights(Real(row.order), 601);
        digits::expect_printed(a[600], row.a_600, 0.5);
        digits::expect_printed(std::accumulate(a.begin(), a.end(), Real(0)), row.sum_600, 0.5);
    }
    // Ramp x = t, v = 0.5, h = 0.01, at t = 1 (FractionalCalculus.jl documents 1.1269695801851276).
    std::vector<double> ramp(101);
    std::iota(ramp.begin(), ramp.end(), 0.0);
    const Real derivative = to_real(full_sums("0.5", ramp)[100]) * Real("0.01") / sqrt(Real("0.01"));
    digits::expect_printed(derivative, "1.1269695801851284449", 0.5);
}

std::vector<Real> product_of(const std::vector<Real>& one, const std::vector<Real>& other) {
    std::vector<Real> all(one.size(), Real(0));
    for (std::size_t n = 0; n < all.size(); ++n) {
        for (std::size_t k = 0; k <= n; ++k) {
            all[n] += one[k] * other[n - k];
        }
    }
    return all;
}

void expect_same(const std::vector<Real>& found, const std::vector<Real>& expected, const std::string& what) {
    ASSERT_EQ(found.size(), expected.size()) << what;
    for (std::size_t j = 0; j < found.size(); ++j) {
        EXPECT_LT(static_cast<double>(abs(found[j] - expected[j])), 1e-44) << what << ' ' << j;
    }
}

// Of order 1 the backward differences of 2 to 4 steps, by their first; orders add up; increments sum once.
TEST(Reference, WeightsOfHigherOrderAreThePowersOfBackwardDifferences) {
    constexpr std::size_t count = 260;
    const std::vector<std::vector<Real>> differences = {
        {Real(3) / 2, -2, Real(1) / 2},
        {Real(11) / 6, -3, Real(3) / 2, -Real(1) / 3},
        {Real(25) / 12, -4, 3, -Real(4) / 3, Real(1) / 4},
    };
    std::vector<Real> unit(count, Real(0));
    unit[0] = 1;
    for (unsigned steps = 2; steps <= 4; ++steps) {
        const std::string name = std::to_string(steps) + " steps";
        const std::vector<Real>& known = differences[steps - 2];
        std::vector<Real> whole(count, Real(0));
        std::transform(known.begin(), known.end(), whole.begin(), [&](const Real& a) { return Real(a / known[0]); });
        expect_same(reference::bdf_weights(steps, 1, count), whole, name);
        const std::vector<Real> a = reference::bdf_weights(steps, Real("0.3"), count);
        expect_same(product_of(a, reference::bdf_weights(steps, Real("0.7"), count)), whole, name);
        expect_same(product_of(a, reference::bdf_weights(steps, Real("-0.3"), count)), unit, name);
        std::vector<Real> sums(count);
        std::partial_sum(a.begin(), a.end(), sums.begin());
        expect_same(reference::bdf_increment_weights(steps, Real("0.3"), count), sums, name);
        EXPECT_LT(
            static_cast<double>(abs(pow(known[0], Real("0.3")) - reference::bdf_first_weight(steps, Real("0.3")))),
            1e-48);
        expect_same(reference::bdf_weights(steps, Real("0.3"), 2), {a[0], a[1]}, name);
    }
    for (const unsigned steps : {0U, 1U, 5U}) {
        EXPECT_THROW((void)reference::bdf_weights(steps, 1, 3), std::domain_error);
    }
}

// Numbers below 2^64 are taken, the largest too, and a sum of their products stays its own.
TEST(Reference, OneProductHasRoomForTheLargestNumbers) {
    const double largest = std::nextafter(0x1p64, 0.0);
    const std::vector<Real> a(3, Real(largest));
    const auto sums = reference::full_sums(a, std::vector<double>{largest, largest, -largest});
    const Real square = Real(largest) * Real(largest);
    ASSERT_EQ(sums.size(), 3U);
    EXPECT_EQ(to_real(sums[0]), square);
    EXPECT_EQ(to_real(sums[1]), 2 * square);
    EXPECT_EQ(to_real(sums[2]), square);
    for (const double beyond : {0x1p64, -0x1p64}) {
        EXPECT_THROW((void)reference::full_sums(a, std::vector<double>{beyond}), std::invalid_argument) << beyond;
        EXPECT_THROW((void)reference::full_sums(std::vector<Real>{Real(beyond)}, std::vector<double>{1.0}),
                     std::invalid_argument)
            << beyond;
    }
}

// Near taps 1 and -1/2, then 1/4 halved from lag to lag, and 1/8 that stays: of a step their running sum.
TEST(Reference, NearTapsAndModesAreTheirTermsOneByOne) {
    const std::vector<Real> near = {Real(1), Real(-0.5)};
    const std::vector<glsum::Mode> modes = {{0.5, 0.25}, {0.0, 0.125}};
    const std::vector<double> known = {1.0, -0.5, 0.375, 0.25, 0.1875, 0.15625};
    const auto weights = reference::weights_of(near, modes, known.size());
    const auto sums = reference::sums_of(near, modes, std::vector<double>(known.size(), 1.0));
    double sum = 0.0;
    for (std::size_t j = 0; j < known.size(); ++j) {
        sum += known[j];
        EXPECT_EQ(weights.at(j), Real(known[j])) << j;
        EXPECT_EQ(to_real(sums.at(j)), Real(sum)) << j;
    }
    EXPECT_EQ(reference::weights_of(near, modes, 1), std::vector<Real>{Real(1)});
    EXPECT_EQ(reference::weights_of(near, {}, 3), (std::vector<Real>{Real(1), Real(-0.5), Real(0)}));
}

// Those that a design names, as far as it names them; behind them those of its order, here 1/2.
TEST(Reference, NamedWeightsStandInPlaceOfTheOrders) {
    const std::vector<double> named = {0.75, 0.25};
    const auto weights = reference::weights(glsum::Design{0.5, 4, {}, named}, 4);
    EXPECT_EQ(weights, (std::vector<Real>{Real(1), Real(0.75), Real(0.25), Real(-0.0625)}));
    EXPECT_EQ(reference::weights(glsum::Design{0.5, 4, {}, named}, 2), (std::vector<Real>{Real(1), Real(0.75)}));
    EXPECT_EQ(reference::weights(glsum::Design{0.5, 4}, Real(1), 3), (std::vector<Real>{Real(1), Real(-1), Real(0)}));
}

// What is summed is as long as the shorter of both.
TEST(Reference, OneSumTakesAsManyAsBothHave) {
    const std::vector<Real> a = {Real(1), Real(-0.5), Real(0.25)};
    EXPECT_EQ(reference::sum(a, std::vector<double>{2.0, 3.0}), Real(0.5));
    EXPECT_EQ(reference::sum(a, std::vector<double>{2.0, 3.0, 4.0, 5.0}), Real(1.5));
    EXPECT_EQ(reference::sum(a, {}), Real(0));
}

}  // namespace
