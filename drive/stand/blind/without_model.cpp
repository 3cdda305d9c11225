#include "drive/stand/blind/without_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/failure.hpp"
#include "base/parallel.hpp"
#include "drive/stand/blind/deck.hpp"
#include "drive/stand/blind/facts.hpp"
#include "drive/stand/blind/logger.hpp"
#include "drive/stand/blind/refit.hpp"
#include "drive/stand/blind/series.hpp"

namespace stand::blind {
namespace {

enum OpenStream : std::uint64_t {
    rig_stream = 101,
    fault_stream,
    excitation_stream,
    record_noise_stream,
    logger_stream,
    other_effect_stream
};
constexpr int attempts_each = 40;
constexpr int effects_tried = 6;

bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

// What happens at a time of one record, and not in every one: else it would be a part of the plant.
bool is_event(const std::string& effect) { return effect == "load_disturbance" || effect == "missed_counts"; }

// What the plant is given in one record, and where the logger starts.
struct Excited {
    std::string kind;
    Held held;
    std::size_t from = 0;
    bool event = false;
};

// Levels that only rise, so that nothing says how the plant comes down.
Held rising_stairs(const Clock& clock, double high, Chance& chance) {
    const double stairs = 5.0 + static_cast<double>(chance.below(4));
    const double rest_s = chance.between(0.01, 0.04) * clock.until_s;
    Held held;
    const auto count = static_cast<std::size_t>(std::floor(clock.until_s / clock.interval_s + 1e-9)) + 1;
    for (std::size_t k = 0; k < count; ++k) {
        const double t = static_cast<double>(k) * clock.interval_s;
        held.time_s.push_back(t);
        const double stair = std::floor((t - rest_s) / (clock.until_s - rest_s) * stairs) + 1.0;
        held.input.push_back(t < rest_s ? 0.0 : high * std::min(stair, stairs) / stairs);
    }
    return held;
}

// A place to start logging at: by chance, but where the input has been nearly still for half a time constant, since
// what it did before the log began and is still on its way nobody can know.
std::size_t start_in_motion(const Rig& rig, const Held& held, Chance& chance) {
    const auto count = static_cast<double>(held.input.size());
    const auto still = static_cast<std::size_t>(std::ceil(0.5 * rig.tau_s / rig.clock.interval_s));
    const auto last = static_cast<std::size_t>(0.3 * count);
    for (auto k = static_cast<std::size_t>(chance.between(0.03, 0.2) * count) + still; k < last; ++k) {
        const auto begin = held.input.begin() + static_cast<std::ptrdiff_t>(k - still);
        const auto [low, high] = std::minmax_element(begin, held.input.begin() + static_cast<std::ptrdiff_t>(k) + 1);
        if (*high - *low <= 0.05 * rig.full_input) {
            return k;
        }
    }
    return 0;
}

Excited excite(const Rig& rig, const std::string& kind, double high, bool lifts, Chance& chance) {
    Excited excited;
    excited.kind = kind;
    Clock clock = rig.clock;
    clock.until_s *= chance.happens(0.5) ? 1.0 : 0.75;
    const double pace_s = rig.tau_s * chance.scaled(0.7, 2.5);
    excited.held =
        kind == "rising" ? rising_stairs(clock, high, chance) : make_profile(kind, clock, high, pace_s, chance);
    const double low = lifts && chance.happens(0.4) ? chance.between(0.1, 0.4) * high : 0.0;
    for (double& u : excited.held.input) {
        u = digits(low + (high - low) * u / high);
    }
    // A single step comes at the beginning: a log that starts later would have nothing to say.
    if (!rig.remembers && kind != "step" && chance.happens(0.5)) {
        excited.from = start_in_motion(rig, excited.held, chance);
    }
    return excited;
}

// Training and validation: other kinds, levels and paces in each record.
struct Records {
    std::vector<Excited> train;
    std::vector<Excited> validate;
};

Records draw_records(const Rig& rig, const OpenPlan& asked, bool one_level, Chance& chance) {
    Records records;
    const bool event = std::any_of(asked.plan.effects.begin(), asked.plan.effects.end(), is_event);
    const bool lifts = asked.family != &mechanical_family() && !one_level;
    const double level = digits(rig.full_input * chance.between(0.6, 1.0));
    std::vector<std::string> used;
    const auto kind = [&](bool train) -> std::string {
        if (one_level) {
            return !train && chance.happens(0.5) ? "step" : "on_off";
        }
        std::string found;
        do {
            found = train && chance.happens(0.12) ? "rising" : profile_kinds()[chance.below(profile_kinds().size())];
        } while (has(used, found) || (train ? found == "step" : has_one_level(found) && has(used, "on_off")));
        used.push_back(found);
        return found;
    };
    const auto high = [&] { return one_level ? level : digits(rig.full_input * chance.between(0.6, 1.0)); };
    const std::size_t trained = event || chance.happens(0.35) ? 2 : 1;
    for (std::size_t i = 0; i < trained; ++i) {
        const std::string own = kind(true);
        records.train.push_back(excite(rig, own, high(), lifts, chance));
    }
    const std::size_t judged = chance.happens(0.2) ? 2 : 1;
    for (std::size_t i = 0; i < judged; ++i) {
        const std::string own = kind(false);
        records.validate.push_back(excite(rig, own, high(), lifts, chance));
    }
    records.train[chance.below(trained)].event = event;
    records.validate.front().event = event;
    return records;
}

// The faults of one record: an event has its own place there, or is not there.
std::vector<Fault> faults_of(const std::vector<Fault>& all, const Excited& record, Chance& chance) {
    std::vector<Fault> faults;
    for (Fault fault : all) {
        if (is_event(fault.effect)) {
            if (!record.event) {
                continue;
            }
            const double first_s = record.held.time_s[record.from];
            place_event(fault, first_s, record.held.time_s.back() - first_s, chance);
        }
        faults.push_back(std::move(fault));
    }
    return faults;
}

using Readings = std::vector<std::vector<double>>;

Readings read_all(const Rig& rig, const std::vector<Excited>& records, const std::vector<std::vector<Fault>>& faults,
                  std::uint64_t seed) {
    Readings readings;
    for (std::size_t i = 0; i < records.size(); ++i) {
        readings.push_back(rig.read(faults[i], records[i].held, {}, seed + i));
    }
    return readings;
}

std::vector<EvenRecord> even(const std::vector<Excited>& records, const Readings& readings) {
    std::vector<EvenRecord> all;
    for (std::size_t i = 0; i < records.size(); ++i) {
        all.push_back({records[i].held.input, readings[i], records[i].from});
    }
    return all;
}

// What a linear base leaves of records that it was fitted to, and of others.
struct Left {
    double train = 0.0;
    double validate = 0.0;
};

struct Both {
    Readings train;
    Readings validate;
};

Left left_by_a_base(const Rig& rig, const Records& records, const Both& readings) {
    const auto train = even(records.train, readings.train);
    const LinearBase base = fit_base(train, rig.clock.interval_s, rig.tau_s);
    return {misfit(base, train, rig.clock.interval_s),
            misfit(base, even(records.validate, readings.validate), rig.clock.interval_s)};
}

double beyond(double with, double without) { return std::sqrt(std::max(0.0, with * with - without * without)); }

double logged_deviation(const std::vector<Excited>& records, const Readings& readings) {
    std::vector<double> all;
    for (std::size_t i = 0; i < records.size(); ++i) {
        all.insert(all.end(), readings[i].begin() + static_cast<std::ptrdiff_t>(records[i].from), readings[i].end());
    }
    return deviation_of(all);
}

std::vector<std::vector<Fault>> place_faults(const std::vector<Fault>& faults, const std::vector<Excited>& records,
                                             std::uint64_t seed, std::uint64_t stream) {
    std::vector<std::vector<Fault>> placed;
    for (std::size_t i = 0; i < records.size(); ++i) {
        Chance chance(seed + 7919U * i, stream);  // so that a fault has the same place alone and in a pair
        placed.push_back(faults_of(faults, records[i], chance));
    }
    return placed;
}

std::optional<OpenCase> attempt_case(const OpenPlan& asked, std::uint64_t own, int attempt) {
    OpenPlan plan = asked;
    // What hardly shows becomes larger, rather than the plant chosen to suit it.
    for (EffectSize& size : plan.plan.sizes) {
        size = static_cast<EffectSize>(std::min(2, static_cast<int>(size) + attempt / 8));
    }
    const std::uint64_t seed = own + 0x9E3779B9U * static_cast<std::uint64_t>(attempt);
    Chance rigs(seed, rig_stream);
    Chance chance(seed, fault_stream);
    Chance excitations(seed, excitation_stream);
    const bool one_level = plan.plan.kind == Class::taken_up && has(plan.family->bends, plan.plan.effects.front());
    const std::unique_ptr<Rig> rig = plan.family->draw(plan.plan.effects, rigs);
    const Records records = draw_records(*rig, plan, one_level, excitations);
    std::vector<Fault> faults;
    for (std::size_t i = 0; i < plan.plan.effects.size(); ++i) {
        const std::string& effect = plan.plan.effects[i];
        faults.push_back({effect, rig->draw(effect, plan.plan.sizes[i], one_level, chance)});
    }
    enum Place : std::uint64_t { train_place = 201, validate_place };
    const auto read = [&](const std::vector<Fault>& some) {
        return Both{
            read_all(*rig, records.train, place_faults(some, records.train, seed, train_place), seed),
            read_all(*rig, records.validate, place_faults(some, records.validate, seed, validate_place), seed + 100U)};
    };

    OpenCase made;
    OpenTruth& truth = made.truth;
    truth.domain = plan.family->domain;
    truth.plan = plan.plan;
    truth.plant = rig->plant;
    const Both bare = read({});
    const Both clean = faults.empty() ? bare : read(faults);
    truth.noise = digits(logged_deviation(records.train, bare.train) * chance.scaled(0.001, 0.005));
    if (!(truth.noise > 0.0)) {
        return std::nullopt;
    }
    const Left with = left_by_a_base(*rig, records, clean);
    if (plan.plan.kind != Class::none && plan.plan.kind != Class::taken_up) {
        const Left without = left_by_a_base(*rig, records, bare);
        truth.left_on_validation = beyond(with.validate, without.validate) / truth.noise;
        truth.left_in_training = beyond(with.train, without.train) / truth.noise;
        // Each of a pair must leave as much alone.
        for (std::size_t i = 0; plan.plan.kind == Class::pair && i < faults.size(); ++i) {
            const Left alone = left_by_a_base(*rig, records, read({faults[i]}));
            truth.left_on_validation =
                std::min(truth.left_on_validation, beyond(alone.validate, without.validate) / truth.noise);
            truth.left_in_training = std::min(truth.left_in_training, beyond(alone.train, without.train) / truth.noise);
        }
        if (truth.left_on_validation < least_left_on_validation || truth.left_in_training < least_left_in_training) {
            return std::nullopt;
        }
    }

    truth.coloured = chance.happens(0.5);
    const double memory = truth.coloured ? chance.between(0.8, 0.95) : 0.0;
    Chance noises(seed, record_noise_stream);
    Chance loggers(seed, logger_stream);
    Logger logger;
    logger.input = rig->input;
    logger.output = rig->output;
    logger.stamp_step_s = rig->clock.interval_s / loggers.scaled(20.0, 2000.0);
    logger.output_step = truth.noise * loggers.scaled(0.02, 0.5);
    logger.input_jump = 0.01 * rig->full_input;
    logger.repeated_share = loggers.happens(0.25) ? loggers.between(0.002, 0.01) : 0.0;
    logger.missing_share = loggers.happens(0.3) ? loggers.between(0.002, 0.02) : 0.0;
    logger.own_clock = loggers.happens(0.7);
    const auto log_all = [&](const std::vector<Excited>& some, const char* name, std::uint64_t stream,
                             std::uint64_t read_seed, std::vector<std::string>& kinds) {
        const auto placed = place_faults(faults, some, seed, stream);
        for (std::size_t i = 0; i < some.size(); ++i) {
            const auto noise = make_noise(some[i].held.time_s.size(), truth.noise, memory, noises);
            const auto readings = rig->read(placed[i], some[i].held, noise, read_seed + i);
            kinds.push_back(some[i].kind);
            made.records.emplace_back(
                some.size() == 1 ? fmt::format("{}.csv", name) : fmt::format("{}-{}.csv", name, i + 1),
                write_log(logger, some[i].held, readings, some[i].from, loggers));
        }
        return placed;
    };
    (void)log_all(records.train, "train", train_place, seed, truth.train);
    const auto placed = log_all(records.validate, "validate", validate_place, seed + 100U, truth.validate);
    const Excited& first = records.validate.front();
    const double first_s = first.held.time_s[first.from];
    for (const Fault& fault : placed.front()) {
        truth.parameters.push_back(fault.parameters);
        if (is_event(fault.effect)) {
            const bool ends = fault.effect == "load_disturbance";
            truth.from_s = stamp_of(logger, fault.parameters.at(ends ? "from_s" : "at_s"), first_s);
            truth.to_s = stamp_of(logger, ends ? fault.parameters.at("to_s") : first.held.time_s.back(), first_s);
        }
    }
    const double deviation = logged_deviation(records.validate, clean.validate);
    truth.gap_base = std::hypot(with.validate, truth.noise) / deviation;
    truth.noise_floor = truth.noise / deviation;
    made.facts = to_json(Facts{plan.family->domain});
    return made;
}

}  // namespace

void place_event(Fault& event, double first_s, double length_s, Chance& chance) {
    const double from_s = first_s + length_s * chance.between(0.15, 0.6);
    if (event.effect == "load_disturbance") {
        event.parameters["from_s"] = from_s;
        event.parameters["to_s"] = from_s + length_s * chance.between(0.1, 0.25);
    } else {
        event.parameters["at_s"] = from_s;
    }
}

std::vector<OpenPlan> plan_open_cases(std::size_t count, std::uint64_t seed) {
    if (count < 1 || count > 999) {
        throw glsum::Failure(glsum::Exit::bad_input, fmt::format("--blind: expected 1 to 999 cases, found {}", count));
    }
    Chance chance(seed, 100);
    const std::vector<EffectSize> any_size{EffectSize::small, EffectSize::clear, EffectSize::large};
    const std::vector<EffectSize> not_small{EffectSize::clear, EffectSize::large};
    struct Decks {
        Deck singles;
        Deck pairs;
        Deck unlisted;
        Deck taken_up;
    };
    std::vector<Decks> decks;
    for (const Family* family : families()) {
        std::vector<std::string> taken_up = family->taken_up;
        taken_up.insert(taken_up.end(), family->bends.begin(), family->bends.end());
        decks.push_back({Deck(family->listed, any_size, chance), Deck(family->listed, not_small, chance),
                         Deck(family->unlisted, any_size, chance), Deck(taken_up, not_small, chance)});
    }
    const auto part = [&](double share) {
        return static_cast<std::size_t>(std::ceil(share * static_cast<double>(count) - 1e-9));
    };
    const std::size_t without = part(0.12);
    const std::size_t with_taken_up = without + part(0.13);
    const std::size_t with_unlisted = with_taken_up + part(0.15);
    const std::size_t with_two = with_unlisted + part(0.12);
    const std::size_t first = chance.below(families().size());
    std::vector<OpenPlan> plans;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t which = (first + i) % families().size();
        OpenPlan plan{families()[which], {}};
        const auto one = [&](Class kind, Deck& deck) {
            const auto [effect, size] = deck.deal();
            plan.plan = {kind, {effect}, {size}, false};
        };
        if (i < without) {
            plan.plan = {};
        } else if (i < with_taken_up) {
            one(Class::taken_up, decks[which].taken_up);
        } else if (i < with_unlisted) {
            one(Class::unlisted, decks[which].unlisted);
        } else if (i < with_two) {
            const auto [effect, size] = decks[which].pairs.deal();
            auto second = decks[which].pairs.deal();
            while (!pairs_with(effect, second.first)) {
                second = decks[which].pairs.deal();
            }
            plan.plan = {Class::pair, {effect, second.first}, {size, second.second}, false};
        } else {
            one(Class::single, decks[which].singles);
        }
        plans.push_back(std::move(plan));
    }
    chance.shuffle(plans);
    return plans;
}

OpenCase make_open_case(const OpenPlan& plan, std::uint64_t seed, std::size_t number) {
    const std::uint64_t own = seed * 1000003U + number;
    Chance others(own, other_effect_stream);
    OpenPlan asked = plan;
    for (int tried = 0; tried < effects_tried; ++tried) {
        for (int attempt = 0; attempt < attempts_each; ++attempt) {
            try {
                if (auto made = attempt_case(asked, own + 1000000007U * static_cast<std::uint64_t>(tried), attempt)) {
                    return std::move(*made);
                }
            } catch (const glsum::Failure&) {
                // A plant that runs away, or a bar beyond its stops: another one.
            }
        }
        const auto& list = plan.plan.kind == Class::unlisted ? plan.family->unlisted : plan.family->listed;
        do {
            for (std::string& effect : asked.plan.effects) {
                effect = list[others.below(list.size())];
            }
        } while (asked.plan.effects.size() == 2 && !pairs_with(asked.plan.effects[0], asked.plan.effects[1]));
    }
    throw glsum::Failure(glsum::Exit::check_failed,
                         fmt::format("blind: case {} with {} shows in no {} plant", number,
                                     fmt::join(plan.plan.effects, ", "), plan.family->domain));
}

std::vector<OpenCase> make_open_cases(std::size_t count, std::uint64_t seed, unsigned jobs,
                                      const std::function<void()>& done) {
    const std::vector<OpenPlan> plans = plan_open_cases(count, seed);
    std::vector<OpenCase> cases(plans.size());
    base::parallel_for(plans.size(), jobs, [&](std::size_t i) {
        cases[i] = make_open_case(plans[i], seed, i + 1);
        if (done) {
            done();
        }
    });
    return cases;
}

std::string seal_open(std::uint64_t seed, const std::vector<OpenTruth>& truths) {
    using Json = nlohmann::ordered_json;
    Json file{{"schema", "glsum-blind-truth-1"}, {"base", "fitted"}, {"seed", seed}};
    file["cases"] = Json::array();
    for (std::size_t i = 0; i < truths.size(); ++i) {
        const OpenTruth& truth = truths[i];
        Json row{{"case", name_of_case(i + 1)}, {"class", name_of(truth.plan.kind)}, {"domain", truth.domain}};
        row["effects"] = Json::array();
        for (std::size_t k = 0; k < truth.plan.effects.size(); ++k) {
            row["effects"].push_back({{"effect", truth.plan.effects[k]},
                                      {"size", name_of(truth.plan.sizes[k])},
                                      {"parameters", truth.parameters[k]}});
        }
        row["plant"] = truth.plant;
        row["train"] = fmt::format("{}", fmt::join(truth.train, "+"));
        row["validate"] = fmt::format("{}", fmt::join(truth.validate, "+"));
        row["noise"] = {{"deviation", truth.noise}, {"colour", truth.coloured ? "coloured" : "white"}};
        row["left_over_noise"] = {{"train", truth.left_in_training}, {"validate", truth.left_on_validation}};
        row["gap"] = {{"base", truth.gap_base}, {"noise_floor", truth.noise_floor}};
        if (truth.to_s > truth.from_s) {
            row["where"] = {{"time", {{{"from_s", truth.from_s}, {"to_s", truth.to_s}}}}};
        }
        file["cases"].push_back(row);
    }
    return file.dump(1) + "\n";
}

}  // namespace stand::blind
