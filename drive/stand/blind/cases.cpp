#include "drive/stand/blind/cases.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/failure.hpp"
#include "base/parallel.hpp"
#include "drive/stand/blind/deck.hpp"

namespace stand::blind {

const char* name_of(Class kind) {
    switch (kind) {
        case Class::none:
            return "none";
        case Class::single:
            return "single";
        case Class::pair:
            return "pair";
        case Class::unlisted:
            return "unlisted";
        case Class::same:
            return "same";
        case Class::taken_up:
            return "taken_up";
    }
    return "";
}

std::vector<Plan> plan_cases(std::size_t count, std::uint64_t seed) {
    if (count < 1 || count > 999) {
        throw glsum::Failure(glsum::Exit::bad_input, fmt::format("--blind: expected 1 to 999 cases, found {}", count));
    }
    Chance chance(seed, 0);
    std::vector<std::string> alone;
    for (const std::string& effect : listed_effects()) {
        if (!is_lag(effect)) {
            alone.push_back(effect);
        }
    }
    Deck singles(alone, {EffectSize::small, EffectSize::clear, EffectSize::large}, chance);
    Deck of_pairs(alone, {EffectSize::clear, EffectSize::large}, chance);
    Deck others(unlisted_effects(), {EffectSize::small, EffectSize::clear, EffectSize::large}, chance);
    Deck same({"actuator_lag", "sensor_lag", "gain_error", "input_dead_zone", "input_saturation", "input_curve",
               "supply_sag"},
              {EffectSize::clear, EffectSize::large}, chance);
    const auto part = [&](double share) {
        return static_cast<std::size_t>(std::ceil(share * static_cast<double>(count) - 1e-9));
    };
    const std::size_t without = part(0.25);
    const std::size_t with_unlisted = part(0.15);
    const std::size_t with_two = part(0.15);
    const std::size_t alike = part(0.08);
    std::vector<Plan> plans;
    for (std::size_t i = 0; plans.size() < count; ++i) {
        Plan plan;
        if (i < without) {
            plan.kind = Class::none;
            plan.new_profile = i % 2 == 0;
        } else if (i < without + with_unlisted) {
            const auto [effect, size] = others.deal();
            plan = {Class::unlisted, {effect}, {size}, false};
        } else if (i < without + with_unlisted + with_two) {
            const auto [first, first_size] = of_pairs.deal();
            auto second = of_pairs.deal();
            while (!pairs_with(first, second.first)) {
                second = of_pairs.deal();
            }
            plan = {Class::pair, {first, second.first}, {first_size, second.second}, false};
        } else if (i < without + with_unlisted + with_two + alike) {
            const auto [effect, size] = same.deal();
            plan = {Class::same, {effect}, {size}, false};
        } else {
            const auto [effect, size] = singles.deal();
            plan = {Class::single, {effect}, {size}, false};
        }
        plans.push_back(std::move(plan));
    }
    chance.shuffle(plans);
    return plans;
}

std::string name_of_case(std::size_t number) { return fmt::format("{:03}", number); }

std::string seal(std::uint64_t seed, const std::vector<Truth>& truths) {
    nlohmann::ordered_json file{{"schema", "glsum-blind-truth-1"}, {"seed", seed}};
    file["cases"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < truths.size(); ++i) {
        const Truth& truth = truths[i];
        nlohmann::ordered_json row{{"case", name_of_case(i + 1)}, {"class", name_of(truth.plan.kind)}};
        row["effects"] = nlohmann::ordered_json::array();
        for (std::size_t k = 0; k < truth.plan.effects.size(); ++k) {
            row["effects"].push_back({{"effect", truth.plan.effects[k]},
                                      {"size", name_of(truth.plan.sizes[k])},
                                      {"parameters", truth.parameters[k]}});
        }
        if (truth.plan.kind == Class::same) {
            row["required"] = truth.required;
            row["allowed"] = truth.allowed;
        }
        row["plant"] = truth.plant;
        row["train"] = truth.train;
        row["validate"] = truth.validate;
        row["new_profile"] = truth.plan.new_profile;
        row["noise"] = {{"deviation", truth.noise}, {"colour", truth.coloured ? "coloured" : "white"}};
        row["deviation_over_noise"] = {{"train", truth.train_deviation}, {"validate", truth.validate_deviation}};
        row["gap"] = {{"base", truth.gap_base}, {"noise_floor", truth.noise_floor}};
        if (truth.to_s > truth.from_s) {
            row["where"] = {{"time", {{{"from_s", truth.from_s}, {"to_s", truth.to_s}}}}};
        }
        file["cases"].push_back(row);
    }
    return file.dump(1) + "\n";
}

std::vector<Case> make_cases(std::size_t count, std::uint64_t seed, unsigned jobs, const std::function<void()>& done) {
    const std::vector<Plan> plans = plan_cases(count, seed);
    std::vector<Case> cases(plans.size());
    base::parallel_for(plans.size(), jobs, [&](std::size_t i) {
        cases[i] = make_case(plans[i], seed, i + 1);
        if (done) {
            done();
        }
    });
    return cases;
}

}  // namespace stand::blind
