// Blind cases without a model: each family against closed forms, what a base takes up, what a case tells and what not.
#include "drive/stand/blind/without_model.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/failure.hpp"
#include "drive/log.hpp"
#include "drive/stand/blind/facts.hpp"
#include "drive/stand/blind/hydraulic/tanks.hpp"
#include "drive/stand/blind/logger.hpp"
#include "drive/stand/blind/refit.hpp"
#include "drive/stand/blind/score.hpp"
#include "drive/stand/blind/thermal/oven.hpp"

namespace {

namespace blind = stand::blind;
using blind::Class;
using blind::Held;
using stand::hydraulic::Tanks;
using stand::thermal::Oven;
using testing::HasSubstr;

Held held_at(double level, double until_s, double step_s = 0.1) {
    Held held;
    for (int k = 0; k * step_s <= until_s + 1e-9; ++k) {
        held.time_s.push_back(k * step_s);
        held.input.push_back(level);
    }
    return held;
}

double warmed(const Oven& oven, double level, double at_s) {
    return stand::thermal::measure(oven, held_at(level, at_s), std::vector<double>{at_s}, 0.01).front();
}

double filled(const Tanks& tanks, double level, double at_s) {
    return stand::hydraulic::gauge(tanks, held_at(level, at_s), std::vector<double>{at_s}, 0.005).front();
}

TEST(Oven, WithoutAWallWarmsByItsExponential) {
    const Oven oven{.body_j_per_k = 50.0, .body_loss_w_per_k = 5.0, .power_w_per_unit = 100.0, .ambient_c = 20.0};
    EXPECT_NEAR(warmed(oven, 0.5, 15.0), 20.0 + 10.0 * (1.0 - std::exp(-1.5)), 1e-8);
    EXPECT_DOUBLE_EQ(stand::thermal::static_loss_w_per_k(oven), 5.0);
}

// Its only loss radiation into emptiness: T' = -k T^4, so T = (T0^-3 + 3 k t)^(-1/3).
TEST(Oven, RadiatesByStefanAndBoltzmann) {
    const Oven oven{.body_j_per_k = 10.0,
                    .body_loss_w_per_k = 0.0,
                    .ambient_c = -273.15,
                    .start_c = 500.0,
                    .radiation_w_per_k4 = 2e-9};
    const double start_k = 773.15;
    EXPECT_NEAR(warmed(oven, 0.0, 20.0), std::pow(std::pow(start_k, -3) + 3.0 * 2e-10 * 20.0, -1.0 / 3.0) - 273.15,
                1e-6);
}

// Body and wall: the two exponentials of their matrix. With a closed outside both end at the mean of their heat.
TEST(Oven, SharesItsHeatWithTheWall) {
    Oven oven{.body_j_per_k = 40.0,
              .body_loss_w_per_k = 0.0,
              .wall_j_per_k = 60.0,
              .coupling_w_per_k = 8.0,
              .power_w_per_unit = 100.0};
    // Under constant power both warm by P t / (C1 + C2); the body is ahead of that by an exponential.
    const double tau_s = 1.0 / (8.0 / 40.0 + 8.0 / 60.0);
    const double t = 5.0;
    const double mean = 100.0 * t / 100.0;
    const double difference = 100.0 / 40.0 * tau_s * (1.0 - std::exp(-t / tau_s));
    EXPECT_NEAR(warmed(oven, 1.0, t), 20.0 + mean + 0.6 * difference, 1e-8);
    oven.wall_loss_w_per_k = 8.0;
    EXPECT_DOUBLE_EQ(stand::thermal::static_loss_w_per_k(oven), 4.0);
    EXPECT_NEAR(warmed(oven, 1.0, 400.0), 20.0 + 25.0, 1e-6);
}

TEST(Oven, ItsEffectsMeanWhatTheTableSays) {
    const auto rests_at = [](const std::function<void(Oven&)>& change, double level = 0.8) {
        Oven oven{
            .body_j_per_k = 1.0, .body_loss_w_per_k = 1.0, .power_w_per_unit = 100.0, .ambient_c = 0.0, .start_c = 0.0};
        change(oven);
        return warmed(oven, level, 30.0);
    };
    EXPECT_NEAR(rests_at([](Oven&) {}), 80.0, 1e-6);
    EXPECT_NEAR(rests_at([](Oven& o) { o.input_limit = 0.5; }), 50.0, 1e-6);
    EXPECT_NEAR(rests_at([](Oven& o) { o.dead_zone = 0.1; }), 70.0, 1e-6);
    EXPECT_NEAR(rests_at([](Oven& o) { o.threshold = 0.9; }), 0.0, 1e-6);
    EXPECT_NEAR(rests_at([](Oven& o) { o.threshold = 0.7; }), 80.0, 1e-6);
    EXPECT_NEAR(rests_at([](Oven& o) { o.curvature = 0.5; }), 80.0 * (0.5 + 0.5 * 0.8), 1e-6);
    EXPECT_NEAR(rests_at([](Oven& o) { o.gain_growth_per_s = 0.01; }), 80.0 * (1.0 + 0.01 * 29.0), 1e-6);
    EXPECT_NEAR(rests_at([](Oven& o) { o.ambient_drift_k_per_s = 0.1; }), 80.0 + 2.9, 1e-6);
    EXPECT_NEAR(rests_at([](Oven& o) { o.sensor_tau_s = 0.5; }), 80.0, 1e-6);
    EXPECT_NEAR(rests_at([](Oven& o) {
                    o.disturbance_w = 15.0;
                    o.disturbance_to_s = 100.0;
                }),
                65.0, 1e-6);
    EXPECT_NEAR(rests_at([](Oven& o) {
                    o.fan_share = 1.0;
                    o.fan_on_c = 60.0;
                    o.fan_off_c = 20.0;
                }),
                40.0, 1e-6);
    // Melting takes time and no place in the long run.
    EXPECT_NEAR(rests_at([](Oven& o) {
                    o.melting_share = 3.0;
                    o.melting_c = 40.0;
                    o.melting_width_k = 5.0;
                }),
                80.0, 1e-5);
}

TEST(Oven, ItsEffectsTakeTheirTime) {
    const Oven plain{
        .body_j_per_k = 2.0, .body_loss_w_per_k = 1.0, .power_w_per_unit = 1.0, .ambient_c = 0.0, .start_c = 0.0};
    const auto first = [](double t) { return 1.0 - std::exp(-t / 2.0); };
    const double two = 1.0 - (2.0 * std::exp(-1.0 / 2.0) - 0.5 * std::exp(-1.0 / 0.5)) / 1.5;
    Oven oven = plain;
    oven.delay_s = 0.4;
    EXPECT_NEAR(warmed(oven, 1.0, 1.0), first(0.6), 1e-6);
    oven = plain;
    oven.sensor_tau_s = 0.5;
    EXPECT_NEAR(warmed(oven, 1.0, 1.0), two, 1e-8);
    oven.falling_tau_s = 5.0;  // it only rises
    EXPECT_NEAR(warmed(oven, 1.0, 1.0), two, 1e-8);
    oven = plain;
    oven.heater_tau_s = 0.5;
    EXPECT_NEAR(warmed(oven, 1.0, 1.0), two, 1e-8);
    oven = plain;
    oven.rate_per_s = 0.5;
    EXPECT_NEAR(warmed(oven, 1.0, 1.0), 0.5 * (1.0 - 2.0 * first(1.0)), 5e-3);
}

// A hole: sqrt(h) falls evenly, by k sqrt(H) / (2 A) a second, and the tank is empty in finite time.
TEST(Tanks, EmptyByTorricelli) {
    const Tanks tanks{
        .area_cm2 = 80.0, .outflow_cm2_per_s = 4.0, .reference_cm = 25.0, .start_cm = 36.0, .root_share = 1.0};
    const double per_s = 4.0 * 5.0 / (2.0 * 80.0);
    EXPECT_NEAR(filled(tanks, 0.0, 20.0), std::pow(6.0 - per_s * 20.0, 2), 1e-5);
    EXPECT_NEAR(filled(tanks, 0.0, 60.0), 0.0, 1e-6);
}

TEST(Tanks, FillByTheirExponentials) {
    Tanks tanks{.area_cm2 = 40.0, .outflow_cm2_per_s = 4.0, .reference_cm = 25.0, .inflow_per_unit = 10.0};
    EXPECT_NEAR(filled(tanks, 10.0, 15.0), 25.0 * (1.0 - std::exp(-1.5)), 1e-6);
    tanks.two = true;
    tanks.first_area_cm2 = 20.0;
    tanks.first_outflow_cm2_per_s = 4.0;
    // Two lags of 5 and 10 s.
    EXPECT_NEAR(filled(tanks, 10.0, 15.0), 25.0 * (1.0 - (10.0 * std::exp(-1.5) - 5.0 * std::exp(-3.0)) / 5.0), 1e-5);
}

TEST(Tanks, TheirEffectsMeanWhatTheTableSays) {
    const auto rests_at = [](const std::function<void(Tanks&)>& change) {
        Tanks tanks{.area_cm2 = 4.0, .outflow_cm2_per_s = 4.0, .reference_cm = 25.0, .inflow_per_unit = 100.0};
        change(tanks);
        return filled(tanks, 0.8, 30.0);
    };
    EXPECT_NEAR(rests_at([](Tanks&) {}), 20.0, 1e-6);
    EXPECT_NEAR(rests_at([](Tanks& t) { t.root_share = 1.0; }), 25.0 * 0.64, 1e-6);
    EXPECT_NEAR(rests_at([](Tanks& t) { t.overflow_cm = 12.0; }), 12.0, 1e-12);
    EXPECT_NEAR(rests_at([](Tanks& t) { t.input_limit = 0.5; }), 12.5, 1e-6);
    EXPECT_NEAR(rests_at([](Tanks& t) { t.dead_zone = 0.2; }), 15.0, 1e-6);
    EXPECT_NEAR(rests_at([](Tanks& t) { t.threshold = 0.9; }), 0.0, 1e-12);
    EXPECT_NEAR(rests_at([](Tanks& t) { t.curvature = 0.5; }), 20.0 * (0.5 + 0.5 * 0.8), 1e-6);
    EXPECT_NEAR(rests_at([](Tanks& t) { t.stiction_band = 0.9; }), 0.0, 1e-12);
    EXPECT_NEAR(rests_at([](Tanks& t) {
                    t.play_width = 0.2;
                    t.play_share = 1.0;
                }),
                17.5, 1e-6);
    EXPECT_NEAR(rests_at([](Tanks& t) { t.gain_growth_per_s = 0.01; }), 20.0 * (1.0 + 0.01 * 29.0), 1e-5);
    EXPECT_NEAR(rests_at([](Tanks& t) { t.delay_s = 40.0; }), 0.0, 1e-12);
    EXPECT_NEAR(rests_at([](Tanks& t) {
                    t.disturbance_cm3_per_s = 20.0;
                    t.disturbance_to_s = 99.0;
                }),
                15.0, 1e-6);
    EXPECT_NEAR(rests_at([](Tanks& t) {
                    t.siphon_cm3_per_s = 40.0;
                    t.siphon_on_cm = 15.0;
                    t.siphon_off_cm = 5.0;
                }),
                10.0, 1e-6);
    EXPECT_NEAR(rests_at([](Tanks& t) { t.priming_s = 29.0; }), 20.0 * (1.0 - std::exp(-1.0)), 0.1);
    EXPECT_NEAR(rests_at([](Tanks& t) {
                    t.upper_area_share = 2.0;
                    t.wider_from_cm = 10.0;
                }),
                20.0, 1e-3);
}

// A first order with a dead time and an offset is one of the base's forms; what else is there is missed by as much.
TEST(LinearBase, IsFoundAgain) {
    blind::EvenRecord record;
    for (int k = 0; k < 1500; ++k) {
        record.input.push_back(std::sin(0.004 * k * (1.0 + 0.004 * k)) + (k % 400 < 150 ? 1.0 : 0.0));
    }
    record.output.assign(1500, 0.0);
    blind::EvenRecord first = record;
    double y = 0.0;
    for (std::size_t k = 0; k < 1500; ++k) {
        first.output[k] = 2.0 + 3.0 * y;
        const double u = k >= 10 ? record.input[k - 10] : 0.0;
        y += (1.0 - std::exp(-0.02 / 0.9)) * (u - y);
    }
    const std::vector<blind::EvenRecord> exact{first};
    const auto found = blind::fit_base(exact, 0.02, 1.5);
    EXPECT_LT(blind::misfit(found, exact, 0.02), 1e-5);
    EXPECT_NEAR(found.gain, 3.0, 1e-4);
    EXPECT_NEAR(found.offset, 2.0, 1e-4);
    blind::EvenRecord shifted = first;
    for (double& value : shifted.output) {
        value += 0.25;
    }
    EXPECT_NEAR(blind::misfit(found, std::vector{shifted}, 0.02), 0.25, 1e-4);
}

// Two integrators of which neither knows the other, and both the exact base: a body with its thermometer, a tank with
// its pump are of second order, and a base that was fitted to one record leaves nothing of another.
TEST(LinearBase, TakesUpAPlantOfSecondOrder) {
    int seen = 0;
    for (const blind::Family* family : {&blind::thermal_family(), &blind::hydraulic_family()}) {
        for (std::uint64_t seed = 1; seed <= 6; ++seed) {
            stand::Chance chance(seed, 77);
            const auto rig = family->draw({}, chance);
            if (rig->plant != "body" && rig->plant != "one tank") {
                continue;
            }
            ++seen;
            std::vector<blind::EvenRecord> records;
            for (const char* kind : {"levels", "prbs"}) {
                const Held held = blind::make_profile(kind, rig->clock, rig->full_input, rig->tau_s, chance);
                records.push_back({held.input, rig->read({}, held, {}, seed), 0});
            }
            const auto fitted = blind::fit_base(std::vector{records[0]}, rig->clock.interval_s, rig->tau_s);
            const auto [low, high] = std::minmax_element(records[1].output.begin(), records[1].output.end());
            EXPECT_LT(blind::misfit(fitted, std::vector{records[1]}, rig->clock.interval_s), 1e-4 * (*high - *low))
                << family->domain << ' ' << seed;
        }
    }
    EXPECT_GE(seen, 4);
}

TEST(Logger, HasItsHabits) {
    blind::Logger logger{.input = "input", .output = "y", .stamp_step_s = 0.05, .output_step = 0.2, .own_clock = true};
    Held held;
    for (int k = 0; k < 400; ++k) {
        held.time_s.push_back(0.123 * k);
        held.input.push_back(k < 200 ? 0.0 : 1.0);
    }
    std::vector<double> readings(400, 1.26);
    stand::Chance chance(3, 1);
    const std::string plain = blind::write_log(logger, held, readings, 100, chance);
    EXPECT_EQ(plain.substr(0, 36), "time_s,input,y\n0,0,1.3\n0.12,0,1.3\n0.");
    EXPECT_EQ(std::count(plain.begin(), plain.end(), '\n'), 301);
    EXPECT_DOUBLE_EQ(blind::stamp_of(logger, 12.3456, 12.3), 0.05);
    logger.repeated_share = 0.1;
    logger.missing_share = 0.2;
    logger.own_clock = false;
    const std::string odd = blind::write_log(logger, held, readings, 100, chance);
    EXPECT_THAT(odd, HasSubstr("\n12.3,0,1.3\n"));
    drive::Log log = drive::parse_log(odd, "odd.csv");
    const drive::StampReport stamps = drive::order_stamps(log);
    EXPECT_GT(stamps.repeated, 5U);
    EXPECT_GT(stamps.missing, 15U);
    EXPECT_EQ(stamps.backward, 0U);
    // Every row where the input moves is there, whatever else is missing.
    for (std::size_t k = 0; k < held.input.size(); ++k) {
        held.input[k] = k / 10 % 2 == 0 ? 0.0 : 1.0;
    }
    const std::string moving = blind::write_log(logger, held, readings, 100, chance);
    for (std::size_t k = 110; k < 400; k += 10) {
        const double stamp_s = blind::stamp_of(logger, held.time_s[k], held.time_s[100]);
        EXPECT_THAT(moving, HasSubstr(fmt::format("\n{},{},", stamp_s, held.input[k])));
    }
}

TEST(OpenPlans, HoldTheirShares) {
    const auto plans = blind::plan_open_cases(100, 4);
    std::map<Class, int> kinds;
    std::map<std::string, int> domains;
    for (const auto& plan : plans) {
        ++kinds[plan.plan.kind];
        ++domains[plan.family->domain];
        const auto& list = plan.plan.kind == Class::unlisted ? plan.family->unlisted : plan.family->listed;
        if (plan.plan.kind == Class::single || plan.plan.kind == Class::pair || plan.plan.kind == Class::unlisted) {
            for (const std::string& effect : plan.plan.effects) {
                EXPECT_THAT(list, testing::Contains(effect));
            }
        }
    }
    EXPECT_EQ(kinds[Class::none], 12);
    EXPECT_EQ(kinds[Class::taken_up], 13);
    EXPECT_EQ(kinds[Class::unlisted], 15);
    EXPECT_EQ(kinds[Class::pair], 12);
    EXPECT_EQ(kinds[Class::single], 48);
    for (const char* domain : {"mechanical", "thermal", "hydraulic"}) {
        EXPECT_NEAR(domains[domain], 33, 1);
    }
    EXPECT_THROW((void)blind::plan_open_cases(0, 1), glsum::Failure);
}

// What a linear base takes up is on no list of what is to be named, and no unlisted effect has a listed name.
TEST(Families, KeepTheirListsApart) {
    for (const blind::Family* family : blind::families()) {
        std::set<std::string> all(family->listed.begin(), family->listed.end());
        const std::size_t listed = all.size();
        all.insert(family->unlisted.begin(), family->unlisted.end());
        all.insert(family->taken_up.begin(), family->taken_up.end());
        EXPECT_EQ(all.size(), listed + family->unlisted.size() + family->taken_up.size()) << family->domain;
        for (const std::string& effect : family->bends) {
            EXPECT_THAT(family->listed, testing::Contains(effect));
        }
    }
}

// Every effect of every family has sizes, a place, and changes what is read.
TEST(Families, KnowTheirEffects) {
    for (const blind::Family* family : blind::families()) {
        for (const auto* list : {&family->listed, &family->unlisted, &family->taken_up}) {
            for (const std::string& effect : *list) {
                bool shows = false;
                for (std::uint64_t seed = 1; seed <= 4 && !shows; ++seed) {
                    stand::Chance chance(seed, 9);
                    const auto rig = family->draw({effect}, chance);
                    rig->clock.until_s /= 4.0;
                    blind::Fault fault{effect, rig->draw(effect, blind::EffectSize::large, false, chance)};
                    if (effect == "load_disturbance") {
                        fault.parameters["from_s"] = 0.2 * rig->clock.until_s;
                        fault.parameters["to_s"] = 0.5 * rig->clock.until_s;
                    } else if (effect == "missed_counts") {
                        fault.parameters["at_s"] = 0.2 * rig->clock.until_s;
                    }
                    const Held held = blind::make_profile(effect == "valve_stiction" ? "ramp" : "levels", rig->clock,
                                                          rig->full_input, rig->tau_s, chance);
                    try {
                        shows = rig->read(std::vector{fault}, held, {}, seed) != rig->read({}, held, {}, seed);
                    } catch (const glsum::Failure& failure) {
                        ASSERT_THAT(failure.what(), testing::Not(HasSubstr("blind: no ")));
                    }
                }
                EXPECT_TRUE(shows) << family->domain << ' ' << effect;
            }
        }
    }
}

blind::OpenPlan plan_of(const blind::Family& family, Class kind, std::vector<std::string> effects = {}) {
    const std::vector<blind::EffectSize> sizes(effects.size(), blind::EffectSize::clear);
    return {&family, {kind, std::move(effects), sizes, false}};
}

TEST(OpenCases, AreFixedByTheirSeed) {
    const auto plan = plan_of(blind::thermal_family(), Class::single, {"output_curve"});
    const auto once = blind::make_open_case(plan, 3, 7);
    EXPECT_EQ(once.records, blind::make_open_case(plan, 3, 7).records);
    EXPECT_NE(once.records, blind::make_open_case(plan, 3, 8).records);
    EXPECT_NE(once.records, blind::make_open_case(plan, 4, 7).records);
    const auto two = blind::make_open_cases(2, 6, 2);
    const auto again = blind::make_open_cases(2, 6, 1);
    EXPECT_EQ(two[1].records, again[1].records);
    EXPECT_EQ(blind::seal_open(6, {two[0].truth, two[1].truth}), blind::seal_open(6, {again[0].truth, again[1].truth}));
}

// Each effect leaves more than a linear base takes up; logs are read, and nothing in them names what is there.
TEST(OpenCases, ShowTheirEffectsAndNameNone) {
    std::size_t number = 0;
    for (const auto& [family, effects] :
         {std::pair(&blind::mechanical_family(), std::vector<std::string>{"coulomb_friction"}),
          std::pair(&blind::mechanical_family(), std::vector<std::string>{"cogging"}),
          std::pair(&blind::thermal_family(), std::vector<std::string>{"input_dead_zone"}),
          std::pair(&blind::thermal_family(), std::vector<std::string>{"output_curve", "rate_limit"}),
          std::pair(&blind::hydraulic_family(), std::vector<std::string>{"valve_stiction"}),
          std::pair(&blind::hydraulic_family(), std::vector<std::string>{"end_stop"})}) {
        const auto made = blind::make_open_case(
            plan_of(*family, effects.size() == 2 ? Class::pair : Class::single, effects), 12, ++number);
        EXPECT_EQ(made.truth.plan.effects, effects);
        EXPECT_EQ(made.truth.parameters.size(), effects.size());
        EXPECT_GE(made.truth.left_on_validation, blind::least_left_on_validation);
        EXPECT_GE(made.truth.left_in_training, blind::least_left_in_training);
        EXPECT_GT(made.truth.gap_base, made.truth.noise_floor);
        EXPECT_EQ(blind::parse_facts(made.facts, "case.json").domain, family->domain);
        bool train = false;
        bool validate = false;
        for (const auto& [file, text] : made.records) {
            train = train || file.starts_with("train");
            validate = validate || file.starts_with("validate");
            drive::Log log = drive::parse_log(text, file);
            (void)drive::order_stamps(log);
            EXPECT_GT(log.time_s.size(), 700U);
            for (const std::string& effect : effects) {
                EXPECT_EQ(text.find(effect), std::string::npos);
            }
        }
        EXPECT_TRUE(train && validate);
    }
}

// Samples that are held seldom and shortly hide in noise: such a case is drawn again until they do not.
TEST(OpenCases, AreDrawnAgainWhereLittleShows) {
    for (std::size_t number = 1; number <= 12; ++number) {
        blind::OpenPlan plan = plan_of(blind::thermal_family(), Class::single, {"dropped_samples"});
        plan.plan.sizes = {blind::EffectSize::small};
        const auto made = blind::make_open_case(plan, 31, number);
        EXPECT_GE(made.truth.left_on_validation, blind::least_left_on_validation) << number;
        EXPECT_GE(made.truth.left_in_training, blind::least_left_in_training) << number;
        // It is what the base leaves less what it leaves without the effect, and the gap is what it leaves beside
        // noise.
        const double over_floor = made.truth.gap_base / made.truth.noise_floor;
        EXPECT_LT(made.truth.left_on_validation, std::sqrt(over_floor * over_floor - 1.0) * (1.0 + 1e-9)) << number;
    }
}

// An event has its place in the judged record and in one of two that are fitted: not in all, and not in one alone.
TEST(OpenCases, HoldEventsInSomeRecords) {
    const auto made =
        blind::make_open_case(plan_of(blind::hydraulic_family(), Class::single, {"load_disturbance"}), 5, 1);
    EXPECT_EQ(made.truth.train.size(), 2U);
    EXPECT_LT(made.truth.from_s, made.truth.to_s);
    EXPECT_GT(made.truth.left_in_training, blind::least_left_in_training);
}

TEST(OpenCases, ThatABaseTakesUpLeaveIt) {
    std::size_t number = 0;
    for (const char* effect : {"gain_error", "dead_time_error", "sensor_lag", "input_dead_zone", "input_saturation"}) {
        for (const blind::Family* family : blind::families()) {
            const auto made = blind::make_open_case(plan_of(*family, Class::taken_up, {effect}), 8, ++number);
            // Body, wall, heater and thermometer are more than two poles, fractional orders none of them; with those
            // out of the way a second order leaves nothing.
            if (made.truth.plant != "fractional") {
                EXPECT_LT(made.truth.gap_base, 4.0 * made.truth.noise_floor) << family->domain << ' ' << effect;
            }
        }
    }
}

TEST(OpenCases, AreSealedAsTheyAreOpened) {
    const std::vector<blind::OpenTruth> truths{
        blind::make_open_case(plan_of(blind::hydraulic_family(), Class::none), 2, 1).truth,
        blind::make_open_case(plan_of(blind::thermal_family(), Class::single, {"load_disturbance"}), 2, 2).truth,
        blind::make_open_case(plan_of(blind::thermal_family(), Class::taken_up, {"gain_error"}), 2, 3).truth};
    const auto opened = blind::parse_sealed(blind::seal_open(2, truths), "truth.sealed.json");
    ASSERT_EQ(opened.size(), 3U);
    EXPECT_TRUE(opened[0].fitted_base);
    EXPECT_EQ(opened[0].domain, "hydraulic");
    EXPECT_EQ(opened[1].effects, std::vector<std::string>{"load_disturbance"});
    EXPECT_EQ(opened[2].kind, "taken_up");
    ASSERT_EQ(opened[1].where.size(), 1U);
    EXPECT_LT(opened[1].where[0].from_s, opened[1].where[0].to_s);
}

std::string refusal_of(const std::string& text) {
    try {
        (void)blind::parse_facts(text, "case.json");
    } catch (const glsum::Failure& failure) {
        return failure.what();
    }
    return "accepted";
}

TEST(Facts, AreReadOrRefused) {
    EXPECT_EQ(blind::parse_facts(blind::to_json({"thermal"}), "case.json").domain, "thermal");
    EXPECT_EQ(refusal_of("[]"), "case.json: expected a JSON object, found []");
    EXPECT_EQ(refusal_of("{"), "case.json: expected a JSON object, found {");
    EXPECT_EQ(refusal_of(R"({"schema": "glsum-case-2"})"),
              "case.json: expected the schema glsum-case-1, found glsum-case-2");
    EXPECT_THAT(refusal_of(R"({"schema": "glsum-case-1", "domain": "acoustic"})"),
                HasSubstr("expected one of the domains mechanical, thermal, hydraulic, electric, found acoustic"));
}

}  // namespace
