// A blind case from what its seed draws, number by number: plant, excitations, effect, noise. A published score names
// its seed, so a seed keeps its cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "drive/log.hpp"
#include "drive/stand/blind/cases.hpp"
#include "drive/stand/blind/mechanical.hpp"
#include "drive/stand/blind/series.hpp"

namespace {

namespace blind = stand::blind;
using blind::Class;
using blind::digits;
using stand::Chance;

constexpr std::uint64_t set_seed = 5;

void expect_record(const std::string& csv, const blind::Held& held, const std::vector<double>& z,
                   const std::string& output) {
    EXPECT_EQ(csv.substr(0, csv.find('\n')),
              std::string(output == "angle_rad" ? "time_s,duty," : "time_s,input,") + output);
    const drive::Log log = drive::parse_log(csv, "record.csv", {});
    ASSERT_EQ(log.time_s.size(), held.time_s.size());
    for (std::size_t k = 0; k < z.size(); ++k) {
        ASSERT_EQ(log.time_s[k], held.time_s[k]);
        // Eight digits are written.
        ASSERT_NEAR(log.input[k], held.input[k], 1e-7 * std::fabs(held.input[k])) << k;
        ASSERT_NEAR(log.output[k], z[k], 1e-7 * std::fabs(z[k])) << k;
    }
}

// \param plan  without an effect, or with one that is seen in any record and bends nothing.
// \return whether the case was followed: fractional plants are not, since they take long.
bool follows_its_draws(const blind::Plan& plan, std::size_t number) {
    const std::uint64_t own = set_seed * 1000003U + number;
    Chance plants(own, 1);
    Chance effects(own, 2);
    Chance profiles(own, 3);
    Chance noises(own, 4);
    const double which = plants.share();
    if (which > 0.65) {
        return false;
    }
    const bool physical = which < 0.3;
    const blind::Mechanical base = blind::draw_mechanical(physical, false, plants);
    // Two kinds, not the same, nor both with one level.
    std::string train_kind;
    std::string validate_kind;
    do {
        train_kind = blind::profile_kinds()[profiles.below(7)];
        validate_kind = blind::profile_kinds()[profiles.below(7)];
    } while (train_kind == validate_kind || (blind::has_one_level(train_kind) && blind::has_one_level(validate_kind)));
    // On a new profile training goes half as high; else validation goes to three fourths and more.
    const double full = base.setup.plant.full_input;
    const double train_high = plan.new_profile ? digits(0.5 * full) : full;
    const double validate_high = plan.new_profile ? full : digits(full * profiles.between(0.75, 1.0));
    blind::Clock validate_clock = base.clock;
    validate_clock.until_s *= profiles.happens(0.5) ? 1.0 : 0.75;
    const blind::Held train = blind::make_profile(train_kind, base.clock, train_high, base.tau_s, profiles);
    const blind::Held validate =
        blind::make_profile(validate_kind, validate_clock, validate_high, base.tau_s, profiles);
    double charge = 0.0;
    for (const double u : train.input) {
        charge += u * base.clock.interval_s;
    }

    const bool coloured = effects.happens(0.5);
    const double memory = coloured ? effects.between(0.8, 0.95) : 0.0;
    blind::Setup with = base.setup;
    std::vector<blind::Parameters> parameters;
    for (std::size_t i = 0; i < plan.effects.size(); ++i) {
        const blind::Scale scale{full,
                                 base.setup.plant.full_output,
                                 base.setup.plant.gain * full,
                                 base.tau_s,
                                 base.clock.interval_s,
                                 base.clock.until_s,
                                 std::max(charge, 1e-9)};
        parameters.push_back(blind::draw_parameters(plan.effects[i], plan.sizes[i], scale, false, effects));
        blind::apply(plan.effects[i], parameters.back(), with);
    }
    const blind::Moved train_base = blind::move_record(base, base.setup, train, own);
    const blind::Moved validate_base = blind::move_record(base, base.setup, validate, own + 1);
    const std::vector<double> bare_train = blind::acquire(base.setup, train_base, {}, own);
    const std::vector<double> bare_validate = blind::acquire(base.setup, validate_base, {}, own + 1);
    const double deviation = digits(blind::deviation_of(bare_train) * effects.scaled(0.002, 0.01));
    const blind::Moved train_moved = blind::move_record(base, with, train, own);
    const blind::Moved validate_moved = blind::move_record(base, with, validate, own + 1);
    const std::vector<double> clean_train = blind::acquire(with, train_moved, {}, own);
    const std::vector<double> clean_validate = blind::acquire(with, validate_moved, {}, own + 1);
    const std::vector<double> train_noise = blind::make_noise(train.time_s.size(), deviation, memory, noises);
    const std::vector<double> train_z = blind::acquire(with, train_moved, train_noise, own);
    const std::vector<double> validate_noise = blind::make_noise(validate.time_s.size(), deviation, memory, noises);
    const std::vector<double> validate_z = blind::acquire(with, validate_moved, validate_noise, own + 1);

    const blind::Case made = blind::make_case(plan, set_seed, number);
    EXPECT_EQ(made.truth.plant, physical ? "stand" : "whole");
    EXPECT_EQ(made.truth.train, train_kind);
    EXPECT_EQ(made.truth.validate, validate_kind);
    EXPECT_EQ(made.truth.coloured, coloured);
    EXPECT_EQ(made.truth.noise, deviation);
    EXPECT_EQ(made.truth.parameters, parameters);
    EXPECT_EQ(made.model, base.model);
    EXPECT_NEAR(made.truth.train_deviation, blind::rms(clean_train, bare_train) / deviation, 1e-9);
    EXPECT_NEAR(made.truth.validate_deviation, blind::rms(clean_validate, bare_validate) / deviation, 1e-9);
    const double spread = blind::deviation_of(validate_z);
    EXPECT_NEAR(made.truth.gap_base, blind::rms(validate_z, bare_validate) / spread, 1e-9);
    EXPECT_NEAR(made.truth.noise_floor, blind::rms(validate_z, clean_validate) / spread, 1e-9);
    const std::string output = physical ? "angle_rad" : effects.happens(0.5) ? "output" : "y";
    expect_record(made.train, train, train_z, output);
    expect_record(made.validate, validate, validate_z, output);
    return true;
}

// Three of each that can be followed, among the first eight: about a third is of fractional order.
void expect_draws(const blind::Plan& plan) {
    int followed = 0;
    for (std::size_t number = 1; number <= 8 && followed < 3; ++number) {
        SCOPED_TRACE(number);
        followed += follows_its_draws(plan, number) ? 1 : 0;
    }
    EXPECT_GT(followed, 0);
}

TEST(BlindDraws, MakeACaseWithoutAnEffect) { expect_draws({Class::none, {}, {}, false}); }

TEST(BlindDraws, MakeACaseOnANewProfile) { expect_draws({Class::none, {}, {}, true}); }

TEST(BlindDraws, MakeACaseWithAnEffect) {
    expect_draws({Class::single, {"sensor_offset"}, {blind::EffectSize::large}, false});
}

}  // namespace
