// One case: a plant, two records, an effect that shows in both.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "drive/stand/blind/cases.hpp"
#include "drive/stand/motion.hpp"
#include "qemu/failure.hpp"

namespace stand::blind {
namespace {

enum Stream : std::uint64_t {
    plant_stream = 1,
    effect_stream,
    profile_stream,
    noise_stream,
    jitter_stream,
    drop_stream
};
constexpr int most_attempts = 60;

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

double rms(const std::vector<double>& a, const std::vector<double>& b) {
    double square = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        square += (a[i] - b[i]) * (a[i] - b[i]);
    }
    return std::sqrt(square / static_cast<double>(a.size()));
}

double deviation_of(const std::vector<double>& values) {
    double mean = 0.0;
    for (const double value : values) {
        mean += value / static_cast<double>(values.size());
    }
    return rms(values, std::vector<double>(values.size(), mean));
}

// A plant without effects, the grid it is stepped on, and how it is written down.
struct Base {
    Setup setup;
    std::string kind;  // stand, whole, fractional
    std::string model;
    double tau_s = 1.0;
    double step_s = 0.001;
    Clock clock;
};

std::string fotf_json(const Plant& plant, double interval_s) {
    nlohmann::ordered_json json{{"kind", "fotf"}, {"gain", plant.gain}};
    json["denominator"] = nlohmann::ordered_json::array();
    for (const PlantTerm& term : plant.terms) {
        json["denominator"].push_back({{"coefficient", term.coefficient}, {"order", term.order}});
    }
    json["delay_s"] = plant.delay_s;
    json["sample_time_s"] = interval_s;
    return json.dump(2) + "\n";
}

double digits(double value) { return std::stod(fmt::format("{:.4g}", value)); }

Base draw_base(bool physical, bool fractional, Chance& chance) {
    Base base;
    base.setup.stand = no_effects();
    base.setup.physical = physical;
    // Mostly 40 s at 100 Hz; some plants slower or faster, with about as many samples.
    const double pace = physical || chance.happens(0.75) ? 1.0 : digits(chance.scaled(0.5, 6.0));
    base.clock.interval_s = 0.01 * pace;
    const double samples = chance.happens(0.7) ? 4000.0 : 250.0 * std::round(chance.between(8.0, 22.0));
    base.clock.until_s = samples * base.clock.interval_s;
    base.clock.spread_s = chance.happens(0.5) ? 0.1 * base.clock.interval_s : 0.0;
    if (physical) {
        Stand& stand = base.setup.stand;
        stand.inertia_kg_m2 = digits(chance.scaled(0.02, 0.08));
        stand.full_thrust_n = digits(chance.between(5.0, 9.0));
        stand.gravity_n_m = digits(chance.scaled(0.4, 1.2));
        const double own = std::sqrt(stand.gravity_n_m / stand.inertia_kg_m2);
        stand.damping_n_m_s = digits(2.0 * chance.between(0.35, 1.2) * own * stand.inertia_kg_m2);
        stand.delay_s = digits(chance.between(0.0, 0.15));
        stand.interval_s = base.clock.interval_s;
        stand.spread_s = base.clock.spread_s;
        base.kind = "stand";
        base.model = linear_model_json(stand);
        base.tau_s = std::max(1.0 / own, stand.damping_n_m_s / stand.gravity_n_m);
        base.setup.plant.gain = 1.0;
        base.setup.plant.terms = {{stand.gravity_n_m / stand.full_torque_n_m(), 0.0}};
        // So that the bar stays below about a radian.
        base.setup.plant.full_input =
            digits(std::min(0.95, chance.between(0.4, 0.95) * stand.gravity_n_m / stand.full_torque_n_m()));
    } else {
        Plant& plant = base.setup.plant;
        base.tau_s = digits(pace * chance.scaled(0.15, 0.9));
        const double gain = digits(chance.scaled(0.2, 20.0));
        plant.full_input = chance.happens(0.5) ? digits(chance.between(0.3, 1.0)) : digits(chance.between(1.0, 12.0));
        plant.delay_s = chance.happens(0.3) ? 0.0 : digits(base.tau_s * chance.between(0.05, 1.0));
        const double t = base.tau_s;
        const std::size_t shape = chance.below(3);
        if (fractional) {
            plant.gain = 1.0;
            const double high = shape == 0 ? chance.between(0.55, 0.95) : chance.between(1.5, 1.95);
            plant.terms = {{digits(std::pow(t, high) / gain), digits(high)}};
            if (shape != 0) {
                const double low = high * chance.between(0.45, 0.55);
                plant.terms.push_back({digits(chance.between(1.2, 2.2) * std::pow(t, low) / gain), digits(low)});
            }
            plant.terms.push_back({digits(1.0 / gain), 0.0});
        } else {
            plant.gain = gain;
            const double damping = chance.between(0.4, 1.3);
            plant.terms = shape == 0   ? std::vector<PlantTerm>{{t, 1.0}, {1.0, 0.0}}
                          : shape == 1 ? std::vector<PlantTerm>{{0.25 * t * t, 2.0}, {t, 1.0}, {1.0, 0.0}}
                                       : std::vector<PlantTerm>{
                                             {digits(t * t), 2.0}, {digits(2.0 * damping * t), 1.0}, {1.0, 0.0}};
        }
        base.kind = fractional ? "fractional" : "whole";
        base.model = fotf_json(plant, base.clock.interval_s);
        // The plant's weights of whole orders end by themselves; fractional ones cost the square of their number.
        base.step_s = base.clock.interval_s / (fractional ? 5.0 : 10.0);
    }
    base.setup.plant.full_output = static_output(base.setup.plant, base.setup.plant.full_input);
    return base;
}

// The reading before the sensor's own faults.
std::vector<double> move_and_read(const Base& base, const Setup& setup, const Held& held,
                                  const std::vector<double>& at_s) {
    if (!setup.physical) {
        return respond(setup.plant, setup.stand, setup.unlisted, held, at_s, base.step_s);
    }
    std::vector<Command> commands;
    for (std::size_t k = 0; k < held.time_s.size(); ++k) {
        if (commands.empty() || commands.back().duty != held.input[k]) {
            commands.push_back({held.time_s[k], held.input[k]});
        }
    }
    std::vector<double> sorted = at_s;
    std::sort(sorted.begin(), sorted.end());
    const Motion motion = stand::move(setup.stand, drive_motor(setup.stand, commands), {}, sorted);
    std::vector<double> readings;
    for (const double t : at_s) {
        const auto at = std::lower_bound(sorted.begin(), sorted.end(), t) - sorted.begin();
        readings.push_back(motion.points[static_cast<std::size_t>(at)].reading_rad);
    }
    return readings;
}

// A record before the sensor's own faults: when its samples were taken, and what there was to read.
struct Moved {
    std::vector<double> at_s;
    std::vector<double> z;
};

Moved move_record(const Base& base, const Setup& setup, const Held& held, std::uint64_t seed) {
    Chance jitter(seed, jitter_stream);
    Moved moved{held.time_s, {}};
    if (setup.stand.jitter_s > 0.0) {
        for (double& t : moved.at_s) {
            t = std::max(0.0, t + jitter.around(setup.stand.jitter_s));
        }
    }
    moved.z = move_and_read(base, setup, held, moved.at_s);
    return moved;
}

// What the acquisition makes of it. \param noise  empty: none
std::vector<double> read(const Setup& setup, const Moved& moved, const std::vector<double>& noise, std::uint64_t seed) {
    Chance drops(seed, drop_stream);
    const std::vector<double>& at_s = moved.at_s;
    std::vector<double> z = moved.z;
    // Stretches of 5 to 25 samples; as many of them as make up the share.
    const double begins = setup.stand.dropped_rate / (15.0 * (1.0 - setup.stand.dropped_rate));
    std::size_t held_for = 0;
    for (std::size_t k = 0; k < z.size(); ++k) {
        z[k] += setup.stand.offset_rad + setup.stand.drift_rad_per_s * at_s[k] + (noise.empty() ? 0.0 : noise[k]);
        z[k] = std::clamp(z[k], -setup.stand.sensor_limit_rad, setup.stand.sensor_limit_rad);
        const double step = setup.stand.encoder_step_rad;
        z[k] = step > 0.0 ? step * std::round(z[k] / step) : z[k];
        z[k] += setup.missed_size != 0.0 && at_s[k] >= setup.missed_at_s ? setup.missed_size : 0.0;
        if (held_for == 0 && drops.share() < begins) {
            held_for = 5 + drops.below(21);
        }
        if (held_for > 0) {
            --held_for;
            z[k] = k > 0 ? z[k - 1] : z[k];
        }
    }
    return z;
}

std::vector<double> make_noise(std::size_t count, double deviation, double memory, Chance& chance) {
    std::vector<double> noise;
    double state = deviation * chance.normal();
    for (std::size_t k = 0; k < count; ++k) {
        noise.push_back(state);
        state = memory * state + deviation * std::sqrt(1.0 - memory * memory) * chance.normal();
    }
    return noise;
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
        for (Size3& size : plan.sizes) {
            size = static_cast<Size3>(std::min(2, static_cast<int>(size) + attempt / 10));
        }
        bool linear = false;
        for (const std::string& effect : plan.effects) {
            linear = linear || needs_linear_plant(effect);
        }
        const bool only_stand = contains(plan.effects, "start_up_time");
        const double which = plants.share();
        const bool physical = only_stand || (!linear && which < 0.3);
        const bool fractional = !physical && which > 0.65;
        const Base base = draw_base(physical, fractional, plants);
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
            base_train = read(base.setup, train_base, {}, own);
            base_validate = read(base.setup, validate_base, {}, own + 1);
            train_moved = plan.effects.empty() ? train_base : move_record(base, in_training, train, own);
            validate_moved = plan.effects.empty() ? validate_base : move_record(base, in_validation, validate, own + 1);
            truth.noise = digits(deviation_of(base_train) * effects.scaled(0.002, 0.01));
            // Each effect is to be seen, in a pair also beside the other.
            const std::vector<double> both = read(in_validation, validate_moved, {}, own + 1);
            for (std::size_t i = 0; plan.kind == Class::pair && i < each.size(); ++i) {
                const Setup& other = each[1 - i];
                const Moved moved = move_record(base, other, validate, own + 1);
                shows = shows && rms(both, read(other, moved, {}, own + 1)) > 2.0 * truth.noise;
            }
        } catch (const glsum::Failure&) {
            continue;  // a plant that runs away, or a bar beyond its stops: another one
        }
        const std::vector<double> clean_train = read(in_training, train_moved, {}, own);
        const std::vector<double> clean_validate = read(in_validation, validate_moved, {}, own + 1);
        truth.train_deviation = rms(clean_train, base_train) / truth.noise;
        truth.validate_deviation = rms(clean_validate, base_validate) / truth.noise;
        const double least = plan.kind == Class::unlisted ? 3.0 : 1.0;
        if (plan.kind != Class::none && (!shows || truth.train_deviation < least || truth.validate_deviation < least)) {
            continue;
        }
        Chance noise(own, noise_stream);
        const std::vector<double> train_z =
            read(in_training, train_moved, make_noise(train.time_s.size(), truth.noise, memory, noise), own);
        const std::vector<double> validate_z = read(
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
