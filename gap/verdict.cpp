#include "gap/verdict.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "drive/model_file.hpp"

namespace gap {
namespace {

using Json = nlohmann::ordered_json;

double shrink_of(const Decision& decision, double after) {
    const double most = decision.base_gap - decision.noise_floor;
    return most > 0.0 ? std::clamp((decision.base_gap - after) / most, -1.0, 1.0) : 0.0;
}

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

// Numbers with 4 digits.
std::string shown(const Json& value) {
    if (value.is_array()) {
        std::string all;
        for (const Json& one : value) {
            all += (all.empty() ? "" : ", ") + shown(one);
        }
        return all;
    }
    return value.is_number() ? fmt::format("{:.4g}", value.get<double>()) : value.get<std::string>();
}

Fitted fitted_of(const FreeParameter& parameter) {
    if (parameter.fixed && parameter.deviation == 0.0) {
        return {parameter.value, parameter.value, parameter.value};
    }
    return {parameter.value, std::min(parameter.low, parameter.value), std::max(parameter.high, parameter.value)};
}

Json to_json(const ContractValue& value) {
    return std::visit([](const auto& held) { return Json(held); }, value);
}

// The parameters of one of a candidate's effects as the contract has them, and their intervals.
void fill(const Ranked& ranked, const Effect& effect, Json& parameters, Json& interval) {
    std::vector<Fitted> fitted;
    const auto add = [&](const std::vector<FreeParameter>& list) {
        for (const FreeParameter& parameter : list) {
            if (parameter.name.starts_with(effect.name + ".")) {
                fitted.push_back(fitted_of(parameter));
            }
        }
    };
    if (effect.kind == Kind::event) {
        add(ranked.candidate.own.front());
    } else {
        for (const auto& list : ranked.trained.lasting) {
            add(list);
        }
    }
    parameters = Json::object();
    interval = Json::object();
    for (const Written& written : effect.to_contract(effect, fitted)) {
        parameters[written.name] = to_json(written.value);
        if (std::holds_alternative<double>(written.value)) {
            interval[written.name] = {written.intervals.front().first, written.intervals.front().second};
        } else if (std::holds_alternative<std::vector<double>>(written.value)) {
            interval[written.name] = Json::array();
            for (const auto& [low, high] : written.intervals) {
                interval[written.name].push_back({low, high});
            }
        }
    }
}

// Of the base's squared gap, what stays.
double unexplained_share(const Answer& answer, const Ranked& ranked) {
    const double base = answer.decision.base_gap;
    return base > 0.0 ? std::clamp(ranked.gap_after * ranked.gap_after / (base * base), 0.0, 1.0) : 0.0;
}

// One entry for each effect of a candidate. \param alternative  which of an ambiguity it is; entries of one belong
// together
void add_effects(Json& array, const Answer& answer, const Ranked& ranked, std::size_t alternative) {
    for (const Effect* effect : ranked.trained.effects) {
        Json parameters;
        Json interval;
        fill(ranked, *effect, parameters, interval);
        array.push_back({{"effect", effect->name},
                         {"alternative", alternative},
                         {"parameters", parameters},
                         {"interval", interval},
                         {"gap_before", answer.decision.base_gap},
                         {"gap_after", ranked.gap_after},
                         {"shrink", shrink_of(answer.decision, ranked.gap_after)},
                         {"confidence", answer.decision.confidence}});
    }
}

// Levels that hold a tenth of the residual's squares or more.
std::string levels_text(const char* signal, const std::vector<Share>& parts) {
    std::string text;
    for (const Share& share : parts) {
        if (share.share >= 0.1 && parts.size() > 1) {
            const std::string level = share.from == share.to ? fmt::format("at {:.4g}", share.from)
                                                             : fmt::format("{:.4g} to {:.4g}", share.from, share.to);
            text += fmt::format("  {} {:<22} {:5.1f} %\n", signal, level, 100.0 * share.share);
        }
    }
    return text;
}

std::string where_text(const Where& where) {
    std::string text =
        "\nwhere the residual (measured - simulated) of the base lies, in shares of its sum of squares\n";
    for (const Share& share : where.time) {
        if (share.share >= 0.05) {
            text += fmt::format("  {:8.3f} to {:8.3f} s  {:5.1f} %  {}\n", share.from, share.to, 100.0 * share.share,
                                share.what);
        }
    }
    for (const Share& share : where.frequency) {
        if (share.share >= 0.1) {
            text += share.from == 0.0
                        ? fmt::format("  constant                {:5.1f} %\n", 100.0 * share.share)
                        : fmt::format("  {:8.4g} to {:8.4g} Hz {:5.1f} %\n", share.from, share.to, 100.0 * share.share);
        }
    }
    text += levels_text("input", where.input_level);
    text += levels_text("output", where.output_level);
    return text + fmt::format("  output rising {:.1f} %, falling {:.1f} %, still {:.1f} %\n", 100.0 * where.rising,
                              100.0 * where.falling, 100.0 * where.still);
}

// Four digits of each number, for people.
drive::Model rounded(drive::Model model) {
    const auto round = [](double& value) { value = std::stod(fmt::format("{:.4g}", value)); };
    round(model.gain);
    round(model.delay_s);
    for (auto* terms : {&model.numerator, &model.denominator}) {
        for (drive::Term& term : *terms) {
            round(term.coefficient);
            round(term.order);
        }
    }
    return model;
}

// The base with the numbers that it has beside what was found, and each record's own.
Json base_json(const Answer& answer) {
    const Candidate& chosen = answer.chosen().trained;
    Json parameters = Json::object();
    Json interval = Json::object();
    for (const FreeParameter& parameter : chosen.base) {
        parameters[parameter.name] = parameter.value;
        const Fitted fitted = fitted_of(parameter);
        interval[parameter.name] = {fitted.low, fitted.high};
    }
    Json base{{"form", answer.base_name.empty() ? "given" : answer.base_name},
              {"model", drive::to_text(answer.model_of(chosen))},
              {"parameters", parameters},
              {"interval", interval},
              {"linear_share", answer.linear_share}};
    // Each record's operating point, state and events, which are its own.
    const std::vector<std::vector<FreeParameter>>& own = answer.chosen().candidate.own;
    for (std::size_t r = 0; r < own.size() && r < answer.records.size() && !own[r].empty(); ++r) {
        Json numbers = Json::object();
        for (const FreeParameter& parameter : own[r]) {
            numbers[parameter.name] = parameter.value;
        }
        base["records"].push_back({{"record", answer.records[r].name}, {"numbers", numbers}});
    }
    for (const Described& one : answer.descriptions) {
        base["descriptions"].push_back({{"form", one.name}, {"gap_aside", one.aside}, {"gap", one.validation}});
    }
    return base;
}

Json suspect_json(const Answer& answer, const Ranked& suspect) {
    Json effects = Json::array();
    for (const Effect* effect : suspect.trained.effects) {
        Json parameters;
        Json interval;
        fill(suspect, *effect, parameters, interval);
        effects.push_back({{"effect", effect->name}, {"parameters", parameters}, {"interval", interval}});
    }
    return {
        {"effects", effects}, {"gap_after", suspect.gap_after}, {"unexplained", unexplained_share(answer, suspect)}};
}

// How much of the measured output's variance is explained where a gap is left.
double explained_percent(double gap) { return 100.0 * std::max(0.0, 1.0 - gap * gap); }

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
    const Decision& decision = answer.decision;
    Json verdict;
    verdict["schema"] = "glsum-gap-1";
    verdict["verdict"] = name_of(decision.outcome);
    verdict["effects"] = Json::array();
    for (std::size_t i = 0; i < decision.effects.size(); ++i) {
        add_effects(verdict["effects"], answer, answer.ranking[decision.effects[i]], i);
    }
    verdict["ranking"] = Json::array();
    for (const Ranked& ranked : answer.ranking) {
        verdict["ranking"].push_back(
            {{"effect", ranked.trained.name()}, {"gap_after", ranked.gap_after}, {"score", ranked.score()}});
    }
    verdict["gap"] = {{"metric", answer.metric},
                      {"base", decision.base_gap},
                      {"after", answer.chosen().gap_after},
                      {"noise_floor", decision.noise_floor}};
    verdict["where"] = {
        {"time", shares(answer.where.time, "from_s", "to_s")},
        {"frequency", shares(answer.where.frequency, "from_hz", "to_hz")},
        {"input_level", shares(answer.where.input_level, "from", "to")},
        {"output_level", shares(answer.where.output_level, "from", "to")},
        {"direction",
         {{"rising", answer.where.rising}, {"falling", answer.where.falling}, {"still", answer.where.still}}}};
    verdict["extrapolated"] = answer.extrapolated;
    verdict["base"] = base_json(answer);
    if (decision.suspect) {
        verdict["suspect"] = suspect_json(answer, answer.ranking[*decision.suspect]);
    }
    verdict["next_experiment"] = answer.next_experiment;
    verdict["confidence"] = decision.confidence;
    verdict["split"] = answer.split;
    verdict["notes"] = answer.notes;
    return verdict.dump(2) + "\n";
}

std::string improved_model(const Answer& answer) {
    const Ranked& chosen = answer.chosen();
    Json model = Json::parse(drive::to_json(answer.model_of(chosen.trained)));
    Json list = Json::array();
    for (const Effect* effect : chosen.trained.effects) {
        if (effect->kind != Kind::event) {
            Json parameters;
            Json interval;
            fill(chosen, *effect, parameters, interval);
            list.push_back({{"effect", effect->name}, {"parameters", parameters}});
        }
    }
    model["effects"] = list;
    if (const auto events = events_of(answer); !events.empty()) {
        model["left_out"] = events;
    }
    if (answer.refit) {
        model["operating_output"] = chosen.candidate.own.front().front().value;
    }
    return model.dump(2) + "\n";
}

std::vector<std::string> events_of(const Answer& answer) {
    std::vector<std::string> names;
    for (const Effect* effect : answer.chosen().trained.effects) {
        if (effect->kind == Kind::event) {
            names.push_back(effect->name);
        }
    }
    return names;
}

std::string base_line(const Answer& answer) {
    if (answer.base_name.empty()) {
        return "";
    }
    std::string line =
        fmt::format("base: {}, {}; the best linear description explains {:.1f} % of the variance", answer.base_name,
                    drive::to_text(rounded(answer.model_of(answer.chosen().trained))), 100.0 * answer.linear_share);
    const std::vector<std::vector<FreeParameter>>& own = answer.chosen().candidate.own;
    for (std::size_t r = 0; r < own.size() && !own[r].empty(); ++r) {
        line += fmt::format("{} {} {:.4g}", r == 0 ? "; of the records judged:" : ",", own[r].front().name,
                            own[r].front().value);
    }
    return line;
}

std::string suspect_line(const Answer& answer) {
    if (!answer.decision.suspect) {
        return "";
    }
    const Ranked& suspect = answer.ranking[*answer.decision.suspect];
    return fmt::format("suspect: {} brings the gap from {:.4f} to {:.4f}; {:.0f} % of its square stay unexplained",
                       suspect.trained.name(), answer.decision.base_gap, suspect.gap_after,
                       100.0 * unexplained_share(answer, suspect));
}

std::string to_text(const Answer& answer) {
    const Decision& decision = answer.decision;
    std::string text = fmt::format("verdict: {}", name_of(decision.outcome));
    for (std::size_t i = 0; i < decision.effects.size(); ++i) {
        text += fmt::format("{}{}", i == 0 ? ": " : " or ", answer.ranking[decision.effects[i]].trained.name());
    }
    text += fmt::format(" (confidence {:.2f})\n\n", decision.confidence);
    text += fmt::format("gap, rms over the output's deviation, {}: {:.4f} before, {:.4f} after, {:.4f} at best\n",
                        answer.metric, decision.base_gap, answer.chosen().gap_after, decision.noise_floor);
    for (const std::string& line : {base_line(answer), suspect_line(answer)}) {
        text += line.empty() ? "" : line + "\n";
    }
    text += fmt::format("variance explained: {:.1f} % by the simulation, {:.1f} % by the best candidate\n",
                        explained_percent(decision.base_gap), explained_percent(answer.chosen().gap_after));
    if (answer.split) {
        text += "no validation record: parts of the training record were kept aside for it\n";
    }
    for (const std::size_t i : decision.effects) {
        for (const Effect* effect : answer.ranking[i].trained.effects) {
            Json parameters;
            Json interval;
            fill(answer.ranking[i], *effect, parameters, interval);
            for (const auto& [name, value] : parameters.items()) {
                text += fmt::format("  {}.{} = {}", effect->name, name, shown(value));
                text += interval.contains(name) ? fmt::format("  [{}]\n", shown(interval[name])) : "\n";
            }
        }
    }
    text += "\n  candidate                                                gap left   score over none\n";
    std::size_t rows = 0;
    for (const Ranked& ranked : answer.ranking) {
        if (rows++ < 10 || ranked.trained.effects.empty()) {
            text += fmt::format("  {:<55} {:>9.4f} {:>17.1f}\n", ranked.trained.name(), ranked.gap_after,
                                ranked.score() - answer.none().score());
        }
    }
    text += where_text(answer.where);
    if (!answer.extrapolated.empty()) {
        text += fmt::format("\nextrapolated, as training has none of it: {}\n", fmt::join(answer.extrapolated, ", "));
    }
    for (const std::string& note : answer.notes) {
        text += fmt::format("\nnote: {}", note);
    }
    return text + (answer.notes.empty() ? "" : "\n") + "\nnext: " + answer.next_experiment + "\n";
}

}  // namespace gap
