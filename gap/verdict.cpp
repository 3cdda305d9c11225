#include "gap/verdict.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace gap {
namespace {

using Json = nlohmann::ordered_json;

double shrink_of(const Answer& answer, double after) {
    const double most = answer.base_gap - answer.noise_floor;
    return most > 0.0 ? std::clamp((answer.base_gap - after) / most, -1.0, 1.0) : 0.0;
}

// "input_dead_zone.width" -> "width"
std::string own_name(const std::string& name) { return name.substr(name.find('.') + 1); }

Json shares(const std::vector<Share>& list, const char* from, const char* to) {
    Json array = Json::array();
    for (const Share& share : list) {
        Json one{{from, share.from}, {to, share.to}, {"share", share.share}};
        if (!share.what.empty()) {
            one["after"] = share.what;
        }
        array.push_back(one);
    }
    return array;
}

// One entry for each effect of a candidate.
void add_effects(Json& array, const Answer& answer, const Ranked& ranked) {
    std::size_t lasting = 0;
    for (const Effect* effect : ranked.candidate.effects) {
        Json parameters = Json::object();
        Json interval = Json::object();
        const auto add = [&](const FreeParameter& parameter) {
            parameters[own_name(parameter.name)] = parameter.value;
            if (std::isfinite(parameter.deviation) && parameter.deviation > 0.0) {
                interval[own_name(parameter.name)] = {parameter.value - 1.96 * parameter.deviation,
                                                      parameter.value + 1.96 * parameter.deviation};
            } else {
                interval[own_name(parameter.name)] = {parameter.lower, parameter.upper};
            }
        };
        if (effect->kind == Kind::lasting) {
            for (const FreeParameter& parameter : ranked.candidate.lasting[lasting++]) {
                add(parameter);
            }
        } else {
            for (const FreeParameter& parameter : ranked.candidate.own.front()) {
                if (parameter.name.starts_with(effect->name + ".")) {
                    add(parameter);
                }
            }
        }
        array.push_back({{"effect", effect->name},
                         {"parameters", parameters},
                         {"interval", interval},
                         {"gap_before", answer.base_gap},
                         {"gap_after", ranked.gap_after},
                         {"shrink", shrink_of(answer, ranked.gap_after)},
                         {"confidence", answer.confidence}});
    }
}

}  // namespace

const char* name_of(Outcome outcome) {
    switch (outcome) {
        case Outcome::attributed:
            return "attributed";
        case Outcome::ambiguous:
            return "ambiguous";
        case Outcome::unknown:
            return "unknown";
        case Outcome::no_gap:
            return "no_gap";
    }
    return "unknown";
}

std::string to_json(const Answer& answer) {
    Json verdict;
    verdict["schema"] = "glsum-gap-1";
    verdict["verdict"] = name_of(answer.outcome);
    verdict["effects"] = Json::array();
    for (const std::size_t i : answer.effects) {
        add_effects(verdict["effects"], answer, answer.ranking[i]);
    }
    verdict["ranking"] = Json::array();
    for (const Ranked& ranked : answer.ranking) {
        verdict["ranking"].push_back(
            {{"effect", ranked.candidate.name()}, {"gap_after", ranked.gap_after}, {"score", ranked.score}});
    }
    const double after = answer.effects.empty() ? answer.base_gap : answer.ranking[answer.effects.front()].gap_after;
    verdict["gap"] = {
        {"metric", "simulation"}, {"base", answer.base_gap}, {"after", after}, {"noise_floor", answer.noise_floor}};
    verdict["where"] = {
        {"time", shares(answer.where.time, "from_s", "to_s")},
        {"frequency", shares(answer.where.frequency, "from_hz", "to_hz")},
        {"input_level", shares(answer.where.input_level, "from", "to")},
        {"output_level", shares(answer.where.output_level, "from", "to")},
        {"direction",
         {{"rising", answer.where.rising}, {"falling", answer.where.falling}, {"still", answer.where.still}}}};
    verdict["next_experiment"] = answer.next_experiment;
    verdict["confidence"] = answer.confidence;
    verdict["notes"] = answer.notes;
    return verdict.dump(2) + "\n";
}

std::string to_text(const Answer& answer) {
    std::string text = fmt::format("verdict: {}", name_of(answer.outcome));
    for (std::size_t i = 0; i < answer.effects.size(); ++i) {
        text += fmt::format("{}{}", i == 0 ? ": " : " or ", answer.ranking[answer.effects[i]].candidate.name());
    }
    text += fmt::format(" (confidence {:.2f})\n\n", answer.confidence);
    const double after = answer.effects.empty() ? answer.base_gap : answer.ranking[answer.effects.front()].gap_after;
    text += fmt::format("gap, rms over the output's deviation: {:.4f} before, {:.4f} after, {:.4f} at best\n",
                        answer.base_gap, after, answer.noise_floor);
    if (answer.split) {
        text += "no validation record: parts of the training record were kept aside for it\n";
    }
    for (const std::size_t i : answer.effects) {
        for (const auto& list : answer.ranking[i].candidate.lasting) {
            for (const FreeParameter& parameter : list) {
                text += fmt::format("  {} = {:.4g} +- {:.2g}\n", parameter.name, parameter.value,
                                    1.96 * parameter.deviation);
            }
        }
    }
    text += "\n  candidate                                       gap left   score over none\n";
    double none = 0.0;
    for (const Ranked& ranked : answer.ranking) {
        none = ranked.candidate.effects.empty() ? ranked.score : none;
    }
    std::size_t shown = 0;
    for (const Ranked& ranked : answer.ranking) {
        if (shown++ < 10 || ranked.candidate.effects.empty()) {
            text += fmt::format("  {:<46} {:>9.4f} {:>17.1f}\n", ranked.candidate.name(), ranked.gap_after,
                                ranked.score - none);
        }
    }
    text += "\nwhere the base's squared gap lies\n";
    for (const Share& share : answer.where.time) {
        if (share.share >= 0.05) {
            text += fmt::format("  {:8.3f} to {:8.3f} s  {:5.1f} %  {}\n", share.from, share.to, 100.0 * share.share,
                                share.what);
        }
    }
    text += fmt::format("  rising {:.1f} %, falling {:.1f} %, still {:.1f} %\n", 100.0 * answer.where.rising,
                        100.0 * answer.where.falling, 100.0 * answer.where.still);
    return text + "\nnext: " + answer.next_experiment + "\n";
}

}  // namespace gap
