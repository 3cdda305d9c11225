// The approximated tail: real poles, one sign, the certificate against 50-digit weights, and what it costs.
#include <gtest/gtest.h>

#include <cmath>

#include "glsum/design/modes.hpp"
#include "reference/sums.hpp"

namespace {

using glsum::design::Approximation;
using glsum::design::design_modes;
using glsum::design::Tail;

// sum_{j=K..N} |a_j - approximation| in 50 digits, from the definition.
double error_by_definition(const Tail& target, const Approximation& found) {
    const auto weights = reference::weights(reference::Real(target.order), target.horizon + 1);
    reference::Real error = 0;
    std::vector<reference::Real> terms;
    for (const auto& mode : found.modes) {
        terms.emplace_back(mode.weight);
    }
    for (std::size_t j = found.near_taps; j <= target.horizon; ++j) {
        reference::Real sum = 0;
        for (std::size_t m = 0; m < terms.size(); ++m) {
            sum += terms[m];
            terms[m] *= 1 - reference::Real(found.modes[m].decay);
        }
        error += abs(weights[j] - sum);
    }
    return static_cast<double>(error);
}

TEST(Modes, PolesAreRealAndStableAndTheTailHasOneSign) {
    for (const double order :
         {-0.99, -0.9, -0.5, -0.1, 0.001, 0.2, 0.5, 0.9, 0.98319, 0.999, 1.001, 1.5, 1.9909, 1.999}) {
        const auto found = design_modes({order, 5000}, 1e-5);
        ASSERT_TRUE(found) << order;
        for (const auto& mode : found->modes) {
            EXPECT_GT(mode.decay, 0.0) << order;
            EXPECT_LT(mode.decay, 1.0) << order;
            EXPECT_GE(mode.weight * (std::sin(M_PI * order) > 0 ? -1 : 1), 0.0) << order;
        }
    }
}

TEST(Modes, TheCertificateIsTheErrorByDefinition) {
    for (const double order : {-0.5, 0.2, 0.5, 0.98319, 1.5, 1.9909}) {
        for (const double error : {1e-3, 1e-6, 1e-8}) {
            const Tail target{order, 1000};
            const auto found = design_modes(target, error);
            ASSERT_TRUE(found) << order << " " << error;
            EXPECT_LE(found->error, error);
            EXPECT_NEAR(found->error, error_by_definition(target, *found), 1e-3 * error + 1e-13)
                << order << " " << error;
        }
    }
}

// Published with the construction, found there by search: nobody who repeats it should need more.
TEST(Modes, CostNoMoreThanPublished) {
    struct Row {
        double order;
        std::size_t horizon;
        std::size_t cost[4];  // for 1e-3, 1e-4, 1e-6, 1e-8
    };
    for (const Row& row :
         {Row{-0.5, 600, {20, 24, 32, 40}}, Row{-0.5, 5000, {26, 31, 41, 51}}, Row{0.2, 600, {15, 19, 27, 35}},
          Row{0.2, 5000, {19, 24, 34, 44}}, Row{0.5, 600, {15, 19, 27, 35}}, Row{0.5, 5000, {18, 23, 33, 43}},
          Row{0.9, 600, {11, 15, 23, 31}}, Row{0.9, 5000, {12, 17, 27, 37}}, Row{0.98319, 600, {7, 12, 19, 27}},
          Row{0.98319, 5000, {7, 12, 22, 32}}, Row{1.5, 600, {10, 15, 22, 30}}, Row{1.5, 5000, {10, 15, 25, 35}},
          Row{1.9909, 600, {5, 7, 14, 22}}, Row{1.9909, 5000, {5, 7, 14, 24}}, Row{0.5, 1'000'000, {24, 31, 46, 62}},
          Row{0.9, 1'000'000, {12, 18, 34, 49}}, Row{1.5, 1'000'000, {10, 15, 26, 41}}}) {
        const double errors[] = {1e-3, 1e-4, 1e-6, 1e-8};
        for (std::size_t i = 0; i < 4; ++i) {
            const auto found = design_modes({row.order, row.horizon}, errors[i]);
            ASSERT_TRUE(found) << row.order << " " << row.horizon << " " << errors[i];
            EXPECT_LE(found->length(), row.cost[i]) << row.order << " " << row.horizon << " " << errors[i];
        }
    }
}

TEST(Modes, ALengthHasTheModesThatLeaveTheFewestTapsOrOneMore) {
    using glsum::design::modes_within;
    EXPECT_EQ(modes_within(0.5, 1), 0U);
    EXPECT_EQ(modes_within(0.5, 2), 0U);
    EXPECT_EQ(modes_within(0.5, 3), 1U);
    EXPECT_EQ(modes_within(0.5, 16), 7U);
    EXPECT_EQ(modes_within(1.9909, 16), 6U);  // three taps at least
    EXPECT_EQ(modes_within(0.5, 1000), glsum::design::most_modes);
    for (const double whole : {-1.0, 0.0, 1.0, 2.0, -1.5}) {
        EXPECT_EQ(modes_within(whole, 50), 0U);
    }
    // As many as a length has are there, whatever the horizon.
    for (const std::size_t horizon : {2U, 40U, 5000U}) {
        EXPECT_EQ(glsum::design::approximate({0.5, horizon}, 1, glsum::design::most_modes).modes.size(),
                  glsum::design::most_modes);
    }
}

TEST(Modes, WholeOrdersNeedTheTapsThatTheyHave) {
    EXPECT_EQ(design_modes({1.0, 5000}, 1e-12)->length(), 2U);
    EXPECT_EQ(design_modes({1.0, 5000}, 1e-12)->multiplications(), 1U);  // a_0 = 1 needs none
    EXPECT_EQ(design_modes({2.0, 5000}, 1e-12)->length(), 3U);
    EXPECT_FALSE(design_modes({-1.5, 5000}, 1e-3));
}

TEST(Modes, AHorizonThatTheNearTapsReachNeedsNoModes) {
    const auto found = design_modes({0.5, 1}, 1e-6);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->modes.empty());
    EXPECT_EQ(found->error, 0.0);
}

}  // namespace
