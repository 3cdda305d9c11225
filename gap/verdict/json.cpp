#include <optional>

#include "gap/verdict/verdict.hpp"
#include "gap/verdict/written_json.hpp"

namespace gap {
namespace {

using Json = nlohmann::ordered_json;

Json intervals_of(const std::vector<Written>& numbers) {
    Json intervals = Json::object();
    for (const Written& number : numbers) {
        if (std::holds_alternative<std::vector<double>>(number.value)) {
            intervals[number.name] = Json::array();
            for (const auto& [low, high] : number.intervals) {
                intervals[number.name].push_back({low, high});
            }
        } else if (!number.intervals.empty()) {
            intervals[number.name] = {number.intervals.front().first, number.intervals.front().second};
        }
    }
    return intervals;
}

// \param alternative  which of several, that stand for each other; none: it stands beside the others
Json json_of(const Cause& cause, std::optional<std::size_t> alternative) {
    Json one{{"effect", cause.effect}};
    if (alternative) {
        one["alternative"] = *alternative;
    }
    one["parameters"] = values_json(cause.parameters);
    one["interval"] = intervals_of(cause.parameters);
    one["gap_before"] = cause.gap_before;
    one["gap_after"] = cause.gap_after;
    one["shrink"] = cause.shrink;
    one["confidence"] = cause.confidence;
    if (cause.gap_without) {
        one["gap_without"] = *cause.gap_without;
    }
    return one;
}

Json effects_of(const OfDrive& of) {
    Json effects = Json::array();
    for (std::size_t i = 0; i < of.alternatives.size(); ++i) {
        for (const Cause& cause : of.alternatives[i]) {
            effects.push_back(json_of(cause, i));
        }
    }
    return effects;
}

Json effects_of(const OfCycles& of) {
    Json effects = Json::array();
    for (const auto* causes : {&of.steps, &of.alternatives}) {
        for (const Cause& cause : *causes) {
            effects.push_back(json_of(cause, std::nullopt));
        }
    }
    return effects;
}

Json shares_of(const std::vector<Share>& list, const char* from, const char* to) {
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

Json shares_of(const std::vector<NamedShare>& shares, const char* key) {
    Json list = Json::array();
    for (const NamedShare& one : shares) {
        list.push_back({{key, one.name}, {"share", one.share}});
    }
    return list;
}

double share_of(const std::vector<NamedShare>& shares, const char* name) {
    for (const NamedShare& one : shares) {
        if (one.name == name) {
            return one.share;
        }
    }
    return 0.0;
}

Json json_of(const Where& where) {
    return {{"time", shares_of(where.time, "from_s", "to_s")},
            {"frequency", shares_of(where.frequency, "from_hz", "to_hz")},
            {"input_level", shares_of(where.input_level, "from", "to")},
            {"output_level", shares_of(where.output_level, "from", "to")},
            {"direction", {{"rising", where.rising}, {"falling", where.falling}, {"still", where.still}}}};
}

Json json_of(const WhereInRows& where) {
    return {{"kernel", shares_of(where.kernels, "kernel")},
            {"slope", share_of(where.lines, "slope")},
            {"constant", share_of(where.lines, "constant")},
            {"placement", shares_of(where.placements, "placement")},
            {"call", {{"first", 0.0}, {"warm", 1.0}}}};
}

Json json_of(const BaseOfDrive& base) {
    Json json{{"form", base.form.empty() ? "given" : base.form},
              {"model", base.model},
              {"parameters", values_json(base.parameters)},
              {"interval", intervals_of(base.parameters)},
              {"linear_share", base.linear_share}};
    if (base.idle_input != 0.0) {
        json["idle_input"] = base.idle_input;
    }
    for (const auto& record : base.records) {
        Json numbers = Json::object();
        for (const auto& [name, value] : record.numbers) {
            numbers[name] = value;
        }
        json["records"].push_back({{"record", record.name}, {"numbers", numbers}});
    }
    for (const auto& one : base.descriptions) {
        json["descriptions"].push_back({{"form", one.form}, {"gap_aside", one.gap_aside}, {"gap", one.gap}});
    }
    return json;
}

Json json_of(const Suspect& suspect) {
    Json effects = Json::array();
    for (const auto& [effect, numbers] : suspect.effects) {
        effects.push_back(
            {{"effect", effect}, {"parameters", values_json(numbers)}, {"interval", intervals_of(numbers)}});
    }
    return {{"effects", effects}, {"gap_after", suspect.gap_after}, {"unexplained", suspect.unexplained}};
}

// What one use has beside the other's, and what both end with: readers may know the order.
void add_rest(Json& json, const Verdict& verdict, const OfDrive& of) {
    json["where"] = json_of(of.where);
    json["extrapolated"] = of.extrapolated;
    json["base"] = json_of(of.base);
    if (of.suspect) {
        json["suspect"] = json_of(*of.suspect);
    }
    json["next_experiment"] = verdict.next_experiment;
    json["confidence"] = of.confidence;
    json["split"] = of.split;
    json["notes"] = verdict.notes;
}

void add_rest(Json& json, const Verdict& verdict, const OfCycles& of) {
    json["where"] = json_of(of.where);
    json["reference"] = of.reference;
    json["notes"] = verdict.notes;
    json["next_experiment"] = verdict.next_experiment;
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

nlohmann::ordered_json values_json(const std::vector<Written>& numbers) {
    Json values = Json::object();
    for (const Written& number : numbers) {
        values[number.name] = std::visit([](const auto& value) { return Json(value); }, number.value);
    }
    return values;
}

std::string to_json(const Verdict& verdict) {
    Json json;
    json["schema"] = "glsum-gap-1";
    json["verdict"] = name_of(verdict.outcome);
    json["effects"] = std::visit([](const auto& of) { return effects_of(of); }, verdict.of);
    if (const auto* cycles = std::get_if<OfCycles>(&verdict.of)) {
        json["alternatives"] = Json::array();
        for (const Cause& cause : cycles->alternatives) {
            json["alternatives"].push_back(cause.effect);
        }
    }
    json["ranking"] = Json::array();
    for (const Rank& rank : verdict.ranking) {
        json["ranking"].push_back({{"effect", rank.effects}, {"gap_after", rank.gap_after}, {"score", rank.score}});
    }
    json["gap"] = {{"metric", verdict.gap.metric},
                   {"base", verdict.gap.base},
                   {"after", verdict.gap.after},
                   {"noise_floor", verdict.gap.noise_floor}};
    std::visit([&](const auto& of) { add_rest(json, verdict, of); }, verdict.of);
    return json.dump(2) + "\n";
}

}  // namespace gap
