// One case: a plant, two records, an effect that shows in both.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/failure.hpp"
#include "drive/stand/blind/cases.hpp"
#include "drive/stand/blind/mechanical.hpp"
#include "drive/stand/blind/series.hpp"

namespace stand::blind {
namespace {

enum Stream : std::uint64_t { plant_stream = 1, effect_stream, profile_stream, noise_stream };
constexpr int most_attempts = 60;

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::string to_csv(const Held& held, const std::vector<double>& z, bool physical, const std::string& output) {
    std::string text = fmt::format("time_s,{},{}\n", physical ? "duty" : "input", output);
    for (std::size_t k = 0; k < z.size(); ++k) {
        text += fmt::format("{},{:.8g},{:.8g}\n", held.time_s[k], held.input[k], z[k]);
    }
    return text;
}

bool one_level(const Held& train, const Held& validate) {
    std::set<double> levels(train.input.begin(), train.input.end());
    levels.insert(validate.input.begin(), validate.input.end());
    levels.erase(0.0);
    return levels.size() < 2;
}

struct Kinds {
    std::string train;
    std::string validate;
};

Kinds draw_kinds(const Plan& plan, Chance& chance) {
    const auto any = [&](bool one_level_too) {
        std::string kind;
        do {
            kind = profile_kinds()[chance.below(profile_kinds().size())];
        } while (has_one_level(kind) && !one_level_too);
        return kind;
    };
    const bool at_one_level = plan.kind == Class::same && !is_lag(plan.effects.front());
    if (at_one_level) {
        return chance.happens(0.5) ? Kinds{"step", "on_off"} : Kinds{"on_off", "step"};
    }
    bool bends = false;
    for (const std::string& effect : plan.effects) {
        bends = bends || bends_the_input(effect) || effect == "input_step";
    }
    // What bends the input shows at several levels; a random binary signal has two, which a gain and an offset meet.
    Kinds kinds;
    do {
        kinds = {any(!bends), any(!bends)};
    } while (kinds.train == kinds.validate || (has_one_level(kinds.train) && has_one_level(kinds.validate)) ||
             (bends && (kinds.train == "prbs" || kinds.validate == "prbs")));
    return kinds;
}

// What else an effect at one level, or a lag, cannot be told from.
void name_alternatives(Truth& truth) {
    if (truth.plan.kind != Class::same) {
        return;
    }
    const std::string& effect = truth.plan.effects.front();
    if (is_lag(effect)) {
        truth.required = {"actuator_lag", "sensor_lag"};
        truth.allowed = truth.required;
        return;
    }
    truth.required = {"gain_error"};
    if (effect != "gain_error") {
        truth.required.push_back(effect);
    }
    truth.allowed = {"gain_error",  "input_saturation", "input_dead_zone",
                     "input_curve", "supply_sag",       "start_up_threshold"};
}

}  // namespace

Case make_case(const Plan& asked, std::uint64_t seed, std::size_t number) {
    const std::uint64_t own = seed * 1000003U + number;
    Chance plants(own, plant_stream);
    Chance effects(own, effect_stream);
    Chance profiles(own, profile_stream);
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
        Plan plan = asked;
        // What hardly shows becomes larger, rather than the plant chosen to suit it.
        for (EffectSize& size : plan.sizes) {
            size = static_cast<EffectSize>(std::min(2, static_cast<int>(size) + attempt / 10));
        }
        bool linear = false;
        for (const std::string& effect : plan.effects) {
            linear = linear || needs_linear_plant(effect);
        }
        const bool only_stand = contains(plan.effects, "start_up_time");
        const double which = plants.share();
        const bool physical = only_stand || (!linear && which < 0.3);
        const bool fractional = !physical && which > 0.65;
        const Mechanical base = draw_mechanical(physical, fractional, plants);
        const Plant& plant = base.setup.plant;
        const Kinds kinds = draw_kinds(plan, profiles);
        const double full = plant.full_input;
        const bool at_one_level = has_one_level(kinds.train) && has_one_level(kinds.validate);
        const double train_high = plan.new_profile ? digits(0.5 * full) : full;
        const double validate_high =
            at_one_level || plan.new_profile ? full : digits(full * profiles.between(0.75, 1.0));
        Clock validate_clock = base.clock;
        validate_clock.until_s *= profiles.happens(0.5) ? 1.0 : 0.75;
        const Held train = make_profile(kinds.train, base.clock, train_high, base.tau_s, profiles);
        const Held validate = make_profile(kinds.validate, validate_clock, validate_high, base.tau_s, profiles);
        if (plan.kind == Class::same && at_one_level && !one_level(train, validate)) {
            continue;
        }
        double charge = 0.0;
        for (const double u : train.input) {
            charge += u * base.clock.interval_s;
        }
        Scale scale{full,
                    plant.full_output,
                    plant.gain * full,
                    base.tau_s,
                    base.clock.interval_s,
                    base.clock.until_s,
                    std::max(charge, 1e-9)};

        Case made;
        Truth& truth = made.truth;
        truth.plan = plan;
        truth.plant = base.kind;
        truth.train = kinds.train;
        truth.validate = kinds.validate;
        truth.coloured = effects.happens(0.5);
        const double memory = truth.coloured ? effects.between(0.8, 0.95) : 0.0;
        Setup in_training = base.setup;
        Setup in_validation = base.setup;
        std::vector<Setup> each(plan.effects.size(), base.setup);  // the effects one by one, in validation
        for (std::size_t i = 0; i < plan.effects.size(); ++i) {
            const std::string& effect = plan.effects[i];
            Parameters parameters = draw_parameters(effect, plan.sizes[i], scale, at_one_level, effects);
            draw_event(effect, parameters, scale, effects);
            apply(effect, parameters, in_training);
            Scale validation_scale = scale;
            validation_scale.until_s = validate_clock.until_s;
            draw_event(effect, parameters, validation_scale, effects);
            apply(effect, parameters, in_validation);
            apply(effect, parameters, each[i]);
            truth.parameters.push_back(parameters);
            if (parameters.contains("from_s")) {
                truth.from_s = parameters.at("from_s");
                truth.to_s = parameters.at("to_s");
            } else if (parameters.contains("at_s")) {
                truth.from_s = parameters.at("at_s");
                truth.to_s = validate_clock.until_s;
            }
        }
        Moved train_moved;
        Moved validate_moved;
        std::vector<double> base_train;
        std::vector<double> base_validate;
        bool shows = true;
        try {
            const Moved train_base = move_record(base, base.setup, train, own);
            const Moved validate_base = move_record(base, base.setup, validate, own + 1);
            base_train = acquire(base.setup, train_base, {}, own);
            base_validate = acquire(base.setup, validate_base, {}, own + 1);
            train_moved = plan.effects.empty() ? train_base : move_record(base, in_training, train, own);
            validate_moved = plan.effects.empty() ? validate_base : move_record(base, in_validation, validate, own + 1);
            truth.noise = digits(deviation_of(base_train) * effects.scaled(0.002, 0.01));
            // Each effect is to be seen, in a pair also beside the other.
            const std::vector<double> both = acquire(in_validation, validate_moved, {}, own + 1);
            for (std::size_t i = 0; plan.kind == Class::pair && i < each.size(); ++i) {
                const Setup& other = each[1 - i];
                const Moved moved = move_record(base, other, validate, own + 1);
                shows = shows && stands_out(both, acquire(other, moved, {}, own + 1), truth.noise);
            }
        } catch (const glsum::Failure&) {
            continue;  // a plant that runs away, or a bar beyond its stops: another one
        }
        const std::vector<double> clean_train = acquire(in_training, train_moved, {}, own);
        const std::vector<double> clean_validate = acquire(in_validation, validate_moved, {}, own + 1);
        truth.train_deviation = rms(clean_train, base_train) / truth.noise;
        truth.validate_deviation = rms(clean_validate, base_validate) / truth.noise;
        const double least = plan.kind == Class::unlisted ? 3.0 : 1.0;
        if (plan.kind != Class::none && (!shows || truth.train_deviation < least || truth.validate_deviation < least)) {
            continue;
        }
        Chance noise(own, noise_stream);
        const std::vector<double> train_z =
            acquire(in_training, train_moved, make_noise(train.time_s.size(), truth.noise, memory, noise), own);
        const std::vector<double> validate_z = acquire(
            in_validation, validate_moved, make_noise(validate.time_s.size(), truth.noise, memory, noise), own + 1);
        truth.gap_base = rms(validate_z, base_validate) / deviation_of(validate_z);
        truth.noise_floor = rms(validate_z, clean_validate) / deviation_of(validate_z);
        name_alternatives(truth);
        made.model = base.model;
        const std::string output = physical ? "angle_rad" : effects.happens(0.5) ? "output" : "y";
        made.train = to_csv(train, train_z, physical, output);
        made.validate = to_csv(validate, validate_z, physical, output);
        return made;
    }
    throw glsum::Failure(glsum::Exit::check_failed, fmt::format("blind: case {} with {} shows in no plant", number,
                                                                fmt::join(asked.effects, ", ")));
}

}  // namespace stand::blind
