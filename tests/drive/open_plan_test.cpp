// Which blind cases make a set, counted at a size where a per cent more or less shows, and what a linear base takes up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "base/failure.hpp"
#include "drive/response.hpp"
#include "drive/stand/blind/cases.hpp"
#include "drive/stand/blind/deck.hpp"
#include "drive/stand/blind/refit.hpp"
#include "drive/stand/blind/without_model.hpp"

namespace {

namespace blind = stand::blind;
using blind::Class;
using blind::EffectSize;

// Cards of one deck come as often as another but for once.
void expect_dealt_evenly(const std::map<std::pair<std::string, EffectSize>, int>& cards, std::size_t all) {
    EXPECT_EQ(cards.size(), all);
    int least = 1'000'000;
    int most = 0;
    for (const auto& [card, times] : cards) {
        least = std::min(least, times);
        most = std::max(most, times);
    }
    EXPECT_LE(most - least, 1);
}

TEST(Plans, HoldTheirSharesOfNearlyAThousand) {
    std::map<Class, int> kinds;
    std::map<std::pair<std::string, EffectSize>, int> singles, unlisted, same;
    int new_profiles = 0;
    for (const auto& plan : blind::plan_cases(999, 3)) {
        ++kinds[plan.kind];
        new_profiles += plan.new_profile ? 1 : 0;
        EXPECT_EQ(plan.effects.size(), plan.sizes.size());
        if (plan.kind == Class::pair) {
            EXPECT_TRUE(blind::pairs_with(plan.effects[0], plan.effects[1]));
            EXPECT_NE(plan.sizes[0], EffectSize::small);
            EXPECT_NE(plan.sizes[1], EffectSize::small);
        } else if (plan.kind != Class::none) {
            ++(plan.kind == Class::single     ? singles
               : plan.kind == Class::unlisted ? unlisted
                                              : same)[{plan.effects[0], plan.sizes[0]}];
        }
        EXPECT_TRUE(!plan.new_profile || plan.kind == Class::none);
    }
    // 25, 15, 15 and 8 of a hundred, rounded up; the rest.
    EXPECT_EQ(kinds[Class::none], 250);
    EXPECT_EQ(kinds[Class::unlisted], 150);
    EXPECT_EQ(kinds[Class::pair], 150);
    EXPECT_EQ(kinds[Class::same], 80);
    EXPECT_EQ(kinds[Class::single], 369);
    EXPECT_EQ(new_profiles, 125);
    expect_dealt_evenly(singles, 3 * (blind::listed_effects().size() - 2));  // no lag alone
    expect_dealt_evenly(unlisted, 3 * blind::unlisted_effects().size());
    expect_dealt_evenly(same, 2U * 7U);
    EXPECT_EQ(blind::plan_cases(1, 1).size(), 1U);
    EXPECT_EQ(blind::name_of_case(7), "007");
}

TEST(OpenPlans, HoldTheirSharesOfNearlyAThousand) {
    std::map<Class, int> kinds;
    std::map<std::string, int> domains;
    for (const auto& plan : blind::plan_open_cases(999, 3)) {
        ++kinds[plan.plan.kind];
        ++domains[plan.family->domain];
        if (plan.plan.kind == Class::pair) {
            EXPECT_TRUE(blind::pairs_with(plan.plan.effects[0], plan.plan.effects[1]));
        }
        if (plan.plan.kind == Class::pair || plan.plan.kind == Class::taken_up) {
            for (const EffectSize size : plan.plan.sizes) {
                EXPECT_NE(size, EffectSize::small);
            }
        }
        EXPECT_FALSE(plan.plan.new_profile);
    }
    // 12, 13, 15 and 12 of a hundred, rounded up; the rest.
    EXPECT_EQ(kinds[Class::none], 120);
    EXPECT_EQ(kinds[Class::taken_up], 130);
    EXPECT_EQ(kinds[Class::unlisted], 150);
    EXPECT_EQ(kinds[Class::pair], 120);
    EXPECT_EQ(kinds[Class::single], 479);
    for (const char* domain : {"mechanical", "thermal", "hydraulic"}) {
        EXPECT_EQ(domains[domain], 333);
    }
    EXPECT_EQ(blind::plan_open_cases(1, 1).size(), 1U);
    EXPECT_THROW((void)blind::plan_open_cases(1000, 1), glsum::Failure);
    EXPECT_EQ(blind::least_left_on_validation, 5.0);
    EXPECT_EQ(blind::least_left_in_training, 3.0);
}

// What stands in the same place hides or mimics one another; all else makes pairs.
TEST(Pairs, AreOfEffectsInDifferentPlaces) {
    const std::vector<std::vector<std::string>> places{
        {"input_saturation", "input_dead_zone", "start_up_threshold", "input_curve", "supply_sag", "gain_error",
         "gain_drift", "valve_stiction", "input_hysteresis"},
        {"actuator_lag", "sensor_lag", "dead_time_error", "time_scale_error", "order_error", "rate_limit",
         "direction_asymmetry", "variable_delay"},
        {"end_stop", "sensor_saturation", "output_curve", "gravity_nonlinearity", "cubic_stiffness"},
        {"coulomb_friction", "direction_dependent_friction", "backlash", "quadratic_drag", "cogging"},
        {"sensor_offset", "sensor_drift", "load_disturbance", "missed_counts"},
        {"encoder_quantisation"},
        {"dropped_samples"},
        {"sampling_jitter"},
        {"structural_resonance"}};
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (std::size_t j = 0; j < places.size(); ++j) {
            for (const std::string& one : places[i]) {
                for (const std::string& other : places[j]) {
                    EXPECT_EQ(blind::pairs_with(one, other), i != j) << one << ' ' << other;
                }
            }
        }
    }
    EXPECT_TRUE(blind::is_lag("actuator_lag"));
    EXPECT_FALSE(blind::is_lag("rate_limit"));
    EXPECT_TRUE(blind::needs_linear_plant("order_error"));
    EXPECT_FALSE(blind::needs_linear_plant("start_up_time"));
    EXPECT_TRUE(blind::needs_linear_plant("hum"));
    EXPECT_FALSE(blind::needs_linear_plant("backlash"));
    EXPECT_STREQ(blind::name_of(EffectSize::small), "small");
    EXPECT_STREQ(blind::name_of(EffectSize::clear), "clear");
    EXPECT_STREQ(blind::name_of(EffectSize::large), "large");
}

// (b0 + b1 T s) / (T^2 s^2 + 2 zeta T s + 1) e^(-delay s) and an offset, from its exact response.
TEST(LinearBase, IsFoundAgainWithItsZeroAndADeadTimeBetweenSteps) {
    constexpr double step_s = 0.02;
    struct Truth {
        double time_s, damping, delay_s, gain, lead_gain;
    };
    for (const Truth& truth :
         {Truth{0.35, 0.45, 0.113, 3.0, 1.2}, Truth{0.5, 1.4, 0.0, -2.0, 0.0}, Truth{0.2, 0.8, 0.31, 0.5, -0.2}}) {
        drive::Model model;
        model.numerator = {{truth.lead_gain * truth.time_s, 1.0}, {truth.gain, 0.0}};
        model.denominator = {{truth.time_s * truth.time_s, 2.0}, {2.0 * truth.damping * truth.time_s, 1.0}, {1.0, 0.0}};
        model.delay_s = truth.delay_s;
        std::vector<blind::EvenRecord> records;
        for (int r = 0; r < 2; ++r) {
            blind::EvenRecord record;
            std::vector<double> time_s;
            for (int k = 0; k < 500; ++k) {
                time_s.push_back(step_s * k);
                record.input.push_back(k < 20 ? 0.0 : (k / (r == 0 ? 90 : 55)) % 2 == 0 ? 1.0 : 0.25);
            }
            record.output = drive::respond(model, drive::changes_of(time_s, record.input), time_s);
            record.from = r == 0 ? 0 : 60;
            for (std::size_t k = 0; k < record.output.size(); ++k) {
                record.output[k] = k < record.from ? 1e6 : record.output[k] + 0.7;  // what is not logged does not count
            }
            records.push_back(std::move(record));
        }
        const auto found = blind::fit_base(records, step_s, 0.5);
        EXPECT_LT(blind::misfit(found, records, step_s), 2e-4 * std::fabs(truth.gain));
        EXPECT_NEAR(found.time_s / truth.time_s, 1.0, 5e-3);
        EXPECT_NEAR(found.damping / truth.damping, 1.0, 5e-3);
        EXPECT_NEAR(found.delay_s, truth.delay_s, 2e-3);
        EXPECT_NEAR(found.gain / truth.gain, 1.0, 1e-3);
        EXPECT_NEAR(found.lead_gain, truth.lead_gain, 0.01 * std::fabs(truth.gain));
        EXPECT_NEAR(found.offset, 0.7, 1e-3 * std::fabs(truth.gain));
        // The exact base leaves nothing, by the exact step of its two poles.
        const blind::LinearBase exact{truth.time_s, truth.damping, truth.delay_s, 0.7, truth.gain, truth.lead_gain};
        EXPECT_LT(blind::misfit(exact, records, step_s), 1e-8);
        blind::LinearBase off = exact;
        off.offset = 0.2;
        EXPECT_NEAR(blind::misfit(off, records, step_s), 0.5, 1e-8);
    }
    // An input that never moves tells the offset alone, and nothing else is made of it.
    blind::EvenRecord still{std::vector<double>(100, 0.0), std::vector<double>(100, 2.0)};
    const auto rest = blind::fit_base(std::vector{still}, step_s, 0.5);
    EXPECT_NEAR(rest.offset, 2.0, 1e-9);
    EXPECT_EQ(rest.gain, 0.0);
    EXPECT_EQ(rest.lead_gain, 0.0);
}

}  // namespace
