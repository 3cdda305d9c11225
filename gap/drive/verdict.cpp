#include "gap/drive/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "drive/model_file.hpp"
#include "gap/verdict/written_json.hpp"

namespace gap {
namespace {

Fitted fitted_of(const FreeParameter& parameter) {
    if (parameter.fixed && parameter.deviation == 0.0) {
        return {parameter.value, parameter.value, parameter.value, parameter.unit};
    }
    return {parameter.value, std::min(parameter.low, parameter.value), std::max(parameter.high, parameter.value),
            parameter.unit};
}

// The numbers of one of a candidate's effects, as the contract has them.
std::vector<Written> written_of(const Ranked& ranked, const Effect& effect) {
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
    return effect.to_contract(effect, fitted);
}

double shrink_of(const Decision& decision, double after) {
    const double most = decision.base_gap - decision.noise_floor;
    return most > 0.0 ? std::clamp((decision.base_gap - after) / most, -1.0, 1.0) : 0.0;
}

// What the others leave without one of them; nothing: they were not tried by themselves.
std::optional<double> gap_without(const std::vector<Ranked>& ranking, const Effect* left_out,
                                  std::vector<const Effect*> others) {
    std::erase(others, left_out);
    for (const Ranked& ranked : ranking) {
        if (std::ranges::is_permutation(ranked.trained.effects, others)) {
            return ranked.gap_after;
        }
    }
    return std::nullopt;
}

std::vector<Cause> causes_in(const Answer& answer, const Ranked& ranked) {
    const Decision& decision = answer.decision;
    std::vector<Cause> causes;
    for (const Effect* effect : ranked.trained.effects) {
        causes.push_back({effect->name, written_of(ranked, *effect), decision.base_gap, ranked.gap_after,
                          shrink_of(decision, ranked.gap_after), decision.confidence,
                          gap_without(answer.ranking, effect, ranked.trained.effects)});
    }
    return causes;
}

Suspect suspect_of(const Decision& decision, const Ranked& ranked) {
    Suspect suspect{ranked.trained.name(), {}, ranked.gap_after, 0.0};
    for (const Effect* effect : ranked.trained.effects) {
        suspect.effects.emplace_back(effect->name, written_of(ranked, *effect));
    }
    const double base = decision.base_gap;
    suspect.unexplained = base > 0.0 ? std::clamp(ranked.gap_after * ranked.gap_after / (base * base), 0.0, 1.0) : 0.0;
    return suspect;
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
BaseOfDrive told_base(const Answer& answer) {
    const Candidate& chosen = answer.chosen().trained;
    const drive::Model model = answer.model_of(chosen);
    BaseOfDrive base{answer.base_name,
                     drive::to_text(model),
                     drive::to_text(rounded(model)),
                     answer.linear_share,
                     answer.idle_input,
                     {},
                     {},
                     {}};
    for (const FreeParameter& parameter : chosen.base) {
        const Fitted fitted = fitted_of(parameter);
        base.parameters.push_back({parameter.name, parameter.value, {{fitted.low, fitted.high}}});
    }
    const std::vector<std::vector<FreeParameter>>& own = answer.chosen().candidate.own;
    for (std::size_t r = 0; r < own.size() && r < answer.records.size() && !own[r].empty(); ++r) {
        base.records.push_back({answer.records[r].name, {}});
        for (const FreeParameter& parameter : own[r]) {
            const double from = parameter.name == "input_before" ? answer.idle_input : 0.0;
            base.records.back().numbers.emplace_back(parameter.name, parameter.value + from);
        }
    }
    for (const Described& one : answer.descriptions) {
        base.descriptions.push_back({one.name, one.aside, one.validation});
    }
    return base;
}

std::vector<Curve> curves_of(const Answer& answer) {
    std::vector<Curve> curves;
    const Ranked& base = answer.none();
    const Ranked& chosen = answer.chosen();
    for (std::size_t r = 0; r < answer.records.size(); ++r) {
        const Record& record = answer.records[r];
        curves.push_back({record.name, record.time_s, record.output, base.residuals[r],
                          &chosen == &base ? std::vector<double>{} : chosen.residuals[r], record.input});
    }
    return curves;
}

OfDrive of_drive(const Answer& answer) {
    const Decision& decision = answer.decision;
    OfDrive of{.alternatives = {},
               .chosen = answer.chosen().trained.name(),
               .where = answer.where,
               .base = told_base(answer),
               .extrapolated = answer.extrapolated,
               .confidence = decision.confidence,
               .split = answer.split};
    for (const std::size_t i : decision.effects) {
        of.alternatives.push_back(causes_in(answer, answer.ranking[i]));
    }
    if (decision.suspect) {
        of.suspect = suspect_of(decision, answer.ranking[*decision.suspect]);
    }
    return of;
}

}  // namespace

Verdict verdict_of(const Answer& answer) {
    const Decision& decision = answer.decision;
    Verdict verdict{decision.outcome,
                    {answer.metric, decision.base_gap, answer.chosen().gap_after, decision.noise_floor},
                    {},
                    of_drive(answer),
                    answer.next_experiment,
                    answer.notes};
    for (const Ranked& ranked : answer.ranking) {
        verdict.ranking.push_back({ranked.trained.name(), ranked.gap_after, ranked.score()});
    }
    return verdict;
}

std::string to_json(const Answer& answer) { return to_json(verdict_of(answer)); }
std::string to_text(const Answer& answer) { return to_text(verdict_of(answer)); }
std::string to_html(const Answer& answer, const std::string& command) {
    const Verdict verdict = verdict_of(answer);
    return to_html(verdict, std::get<OfDrive>(verdict.of), {curves_of(answer), answer.next_record, command});
}

std::string improved_model(const Answer& answer) {
    using Json = nlohmann::ordered_json;
    const Ranked& chosen = answer.chosen();
    Json model = Json::parse(drive::to_json(answer.model_of(chosen.trained)));
    model["effects"] = Json::array();
    for (const Effect* effect : chosen.trained.effects) {
        if (effect->kind != Kind::event) {
            model["effects"].push_back(
                {{"effect", effect->name}, {"parameters", values_json(written_of(chosen, *effect))}});
        }
    }
    if (const auto events = events_of(answer); !events.empty()) {
        model["left_out"] = events;
    }
    if (answer.refit) {
        model["operating_output"] = chosen.candidate.own.front().front().value;
        if (answer.idle_input != 0.0) {
            model["idle_input"] = answer.idle_input;
        }
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

}  // namespace gap
