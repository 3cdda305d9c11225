#include "drive/stand/blind/score.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/failure.hpp"

namespace stand::blind {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> sorted(std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

Json parse(const std::string& text, const std::string& name) {
    try {
        Json file = Json::parse(text, [&](int depth, Json::parse_event_t, const Json&) {
            if (depth > 16) {
                refuse(fmt::format("{}: expected a JSON object, found values nested {} deep", name, depth));
            }
            return true;
        });
        if (file.is_object()) {
            return file;
        }
    } catch (const Json::exception&) {
    }
    refuse(fmt::format("{}: expected a JSON object", name));
}

// A field of the type that is asked for.
template <class Type>
Type take(const Json& object, const char* key, const std::string& name) {
    try {
        return object.at(key).get<Type>();
    } catch (const Json::exception&) {
        refuse(
            fmt::format("{}: {}: expected {}, found {}", name, key,
                        std::is_same_v<Type, std::string> ? "a text"
                        : std::is_same_v<Type, double>    ? "a number"
                                                          : "a list",
                        object.is_object() && object.contains(key) ? object.at(key).dump().substr(0, 60) : "nothing"));
    }
}

Json take_list(const Json& object, const char* key, const std::string& name) {
    Json list = take<Json>(object, key, name);
    if (!list.is_array()) {
        refuse(fmt::format("{}: {}: expected a list, found {}", name, key, list.dump().substr(0, 60)));
    }
    return list;
}

std::vector<std::string> names_in(const Json& list, const std::string& name) {
    std::vector<std::string> names;
    for (const Json& row : list) {
        names.push_back(take<std::string>(row, "effect", name));
    }
    return names;
}

std::vector<Stretch> stretches_in(const Json& file, const std::string& name) {
    std::vector<Stretch> stretches;
    if (file.contains("where") && file["where"].is_object() && file["where"].contains("time")) {
        for (const Json& row : take_list(file["where"], "time", name)) {
            stretches.push_back({take<double>(row, "from_s", name), take<double>(row, "to_s", name),
                                 row.contains("share") ? take<double>(row, "share", name) : 0.0});
        }
    }
    return stretches;
}

// The share of what a verdict locates that lies in the true stretches; a located stretch counts as even in itself.
std::optional<double> share_inside(const std::vector<Stretch>& truth, const std::vector<Stretch>& located) {
    double inside = 0.0;
    double all = 0.0;
    for (const Stretch& cell : located) {
        all += cell.share;
        for (const Stretch& stretch : truth) {
            const double common = std::min(cell.to_s, stretch.to_s) - std::max(cell.from_s, stretch.from_s);
            inside += cell.to_s > cell.from_s ? cell.share * std::max(0.0, common) / (cell.to_s - cell.from_s) : 0.0;
        }
    }
    return all > 0.0 ? std::optional(inside / all) : std::nullopt;
}

double median(const std::vector<double>& sorted_values) {
    const std::size_t n = sorted_values.size();
    return n % 2 == 1 ? sorted_values[n / 2] : 0.5 * (sorted_values[n / 2 - 1] + sorted_values[n / 2]);
}

std::string shown(const Share& share) {
    return share.all == 0 ? std::string("none to count")
                          : fmt::format("{:>3}/{:<3} {:5.1f} %  [{:4.1f}, {:5.1f}]", share.hits, share.all,
                                        100.0 * share.value(), 100.0 * share.low(), 100.0 * share.high());
}

Json to_json(const Share& share) {
    return {
        {"hits", share.hits}, {"of", share.all}, {"share", share.value()}, {"interval", {share.low(), share.high()}}};
}

std::string table(const char* title, const std::map<std::string, Share>& shares) {
    std::string text = fmt::format("\n{}\n", title);
    for (const auto& [name, share] : shares) {
        text += fmt::format("  {:<30} {}\n", name, shown(share));
    }
    return text;
}

}  // namespace

std::string row_of(const SealedCase& truth) { return truth.kind == "single" ? truth.effects.front() : truth.kind; }

std::string column_of(const Answer& answer) {
    return answer.verdict == "attributed" ? fmt::format("{}", fmt::join(sorted(answer.effects), "+")) : answer.verdict;
}

std::vector<SealedCase> parse_sealed(const std::string& text, const std::string& name) {
    const Json file = parse(text, name);
    const std::string schema = take<std::string>(file, "schema", name);
    if (schema != "glsum-blind-truth-1") {
        refuse(fmt::format("{}: schema: expected glsum-blind-truth-1, found {}", name, schema));
    }
    const bool fitted = file.contains("base");
    if (fitted && file["base"] != "fitted") {
        refuse(fmt::format("{}: base: expected fitted, found {}", name, file["base"].dump().substr(0, 60)));
    }
    const std::vector<std::string> kinds{"none", "single", "pair", "unlisted", fitted ? "taken_up" : "same"};
    std::vector<SealedCase> cases;
    for (const Json& row : take_list(file, "cases", name)) {
        SealedCase truth;
        truth.fitted_base = fitted;
        truth.name = take<std::string>(row, "case", name);
        const std::string where = fmt::format("{}: case {}", name, truth.name);
        truth.kind = take<std::string>(row, "class", where);
        if (!contains(kinds, truth.kind)) {
            refuse(fmt::format("{}: class: expected one of {}, found {}", where, fmt::join(kinds, ", "), truth.kind));
        }
        if (fitted) {
            truth.domain = take<std::string>(row, "domain", where);
        }
        const Json effects = take_list(row, "effects", where);
        truth.effects = names_in(effects, where);
        const std::size_t expected = truth.kind == "none" ? 0 : truth.kind == "pair" ? 2 : 1;
        if (truth.effects.size() != expected) {
            refuse(fmt::format("{}: effects: expected {} for the class {}, found {}", where, expected, truth.kind,
                               truth.effects.size()));
        }
        if (!truth.effects.empty() && effects[0].contains("size")) {
            truth.size = take<std::string>(effects[0], "size", where);
        }
        if (truth.kind == "same") {
            truth.required = take<std::vector<std::string>>(row, "required", where);
            truth.allowed = take<std::vector<std::string>>(row, "allowed", where);
        }
        truth.train = take<std::string>(row, "train", where);
        truth.validate = take<std::string>(row, "validate", where);
        truth.new_profile = row.contains("new_profile") && row["new_profile"] == true;
        const Json gap = take<Json>(row, "gap", where);
        truth.gap_base = take<double>(gap, "base", where);
        truth.noise_floor = take<double>(gap, "noise_floor", where);
        truth.where = stretches_in(row, where);
        cases.push_back(std::move(truth));
    }
    if (cases.empty()) {
        refuse(fmt::format("{}: cases: expected at least one", name));
    }
    return cases;
}

Answer parse_answer(const std::string& text, const std::string& name) {
    const Json file = parse(text, name);
    const std::string schema = take<std::string>(file, "schema", name);
    if (schema != "glsum-gap-1") {
        refuse(fmt::format("{}: schema: expected glsum-gap-1, found {}", name, schema));
    }
    Answer answer;
    answer.verdict = take<std::string>(file, "verdict", name);
    if (!contains({"attributed", "ambiguous", "unknown", "no_gap"}, answer.verdict)) {
        refuse(fmt::format("{}: verdict: expected attributed, ambiguous, unknown or no_gap, found {}", name,
                           answer.verdict));
    }
    const Json effects = take_list(file, "effects", name);
    answer.effects = names_in(effects, name);
    if (answer.effects.empty() && (answer.verdict == "attributed" || answer.verdict == "ambiguous")) {
        refuse(fmt::format("{}: effects: expected at least one beside the verdict {}", name, answer.verdict));
    }
    answer.confidence = answer.effects.empty() ? 0.0 : 1.0;
    for (const Json& row : effects) {
        const double confidence = take<double>(row, "confidence", name);
        if (!(confidence >= 0.0 && confidence <= 1.0)) {
            refuse(fmt::format("{}: confidence: expected 0 to 1, found {}", name, confidence));
        }
        answer.confidence = std::min(answer.confidence, confidence);
    }
    std::vector<std::pair<double, std::string>> ranking;
    for (const Json& row : take_list(file, "ranking", name)) {
        ranking.emplace_back(take<double>(row, "score", name), take<std::string>(row, "effect", name));
    }
    std::stable_sort(ranking.begin(), ranking.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    for (auto& [points, effect] : ranking) {
        answer.ranking.push_back(std::move(effect));
    }
    const Json gap = take<Json>(file, "gap", name);
    if (gap.is_object() && gap.contains("after") && gap["after"].is_number()) {
        answer.gap_after = gap["after"].get<double>();
    }
    answer.where = stretches_in(file, name);
    return answer;
}

bool is_right(const SealedCase& truth, const Answer& answer) {
    if (truth.kind == "none") {
        return answer.verdict == "no_gap";
    }
    if (truth.kind == "unlisted") {
        return answer.verdict == "unknown";
    }
    if (truth.kind == "same") {
        return answer.verdict == "ambiguous" &&
               std::all_of(truth.required.begin(), truth.required.end(),
                           [&](const std::string& effect) { return contains(answer.effects, effect); }) &&
               std::all_of(answer.effects.begin(), answer.effects.end(),
                           [&](const std::string& effect) { return contains(truth.allowed, effect); });
    }
    return answer.verdict == "attributed" && sorted(answer.effects) == sorted(truth.effects);
}

Score score(std::span<const SealedCase> truths, std::span<const Answer> answers,
            std::span<const std::optional<Oracle>> oracle) {
    if (answers.size() != truths.size() || (!oracle.empty() && oracle.size() != truths.size())) {
        refuse(
            fmt::format("score: expected one verdict for each of {} cases, found {}", truths.size(), answers.size()));
    }
    Score total;
    for (std::size_t i = 0; i < truths.size(); ++i) {
        const SealedCase& truth = truths[i];
        const Answer& answer = answers[i];
        const bool right = is_right(truth, answer);
        const bool says_gap = answer.verdict != "no_gap";
        total.top_one.count(right);
        total.by_class[truth.kind].count(right);
        ++total.confusion[row_of(truth)][column_of(answer)];
        if (truth.kind == "none") {
            total.false_alarms.count(says_gap);
            if (truth.new_profile) {
                total.false_alarms_new_profile.count(says_gap);
            }
        } else {
            total.detection.count(says_gap);
        }
        if (truth.kind == "single") {
            total.by_effect[truth.effects.front()].count(right);
            total.by_size[truth.size].count(right);
            total.by_training[truth.train].count(right);
        }
        if (truth.kind == "single" || truth.kind == "pair" || truth.kind == "same") {
            const std::size_t places = std::min<std::size_t>(truth.kind == "pair" ? 4 : 2, answer.ranking.size());
            const std::vector<std::string> first(answer.ranking.begin(),
                                                 answer.ranking.begin() + static_cast<std::ptrdiff_t>(places));
            const bool near = says_gap && std::all_of(truth.effects.begin(), truth.effects.end(),
                                                      [&](const auto& effect) { return contains(first, effect); });
            total.top_two.count(right || near);
        }
        if (answer.verdict == "attributed") {
            total.wrong_claims.count(!right);
            total.claims.push_back({answer.confidence, right});
        }
        const double room = truth.gap_base - truth.noise_floor;
        const bool listed = truth.kind == "single" || truth.kind == "pair";
        if (right && listed && answer.gap_after && room > 0.0) {
            total.shrinks.push_back((truth.gap_base - *answer.gap_after) / room);
        }
        if (listed && !oracle.empty() && oracle[i] && oracle[i]->gap_after < oracle[i]->gap_base) {
            const double after =
                answer.effects.empty() ? oracle[i]->gap_base : answer.gap_after.value_or(oracle[i]->gap_base);
            total.of_the_oracle.push_back((oracle[i]->gap_base - after) / (oracle[i]->gap_base - oracle[i]->gap_after));
        }
        if (!oracle.empty() && oracle[i] && oracle[i]->identifiable && truth.kind == "single") {
            total.identifiable.count(right);
        }
        if (const auto inside = truth.where.empty() ? std::nullopt : share_inside(truth.where, answer.where)) {
            total.in_the_stretch.push_back(*inside);
        }
    }
    total.calibration = calibrate(total.claims);
    for (auto* values : {&total.shrinks, &total.of_the_oracle, &total.in_the_stretch}) {
        std::sort(values->begin(), values->end());
    }
    return total;
}

Answer answer_naming(const std::string& effect) {
    Answer answer;
    answer.verdict = effect == "none" ? "no_gap" : "attributed";
    if (effect != "none") {
        answer.effects = answer.ranking = {effect};
    }
    return answer;
}

std::vector<Answer> constant_guess(std::size_t cases) { return std::vector<Answer>(cases, answer_naming("none")); }

std::vector<std::string> missed_goals(const Score& score) {
    std::vector<std::string> missed;
    const auto need = [&](const char* what, const Share& share, double least) {
        if (share.all > 0 && share.value() < least) {
            missed.push_back(fmt::format("{}: expected at least {:.0f} %, found {:.1f} %", what, 100.0 * least,
                                         100.0 * share.value()));
        }
    };
    const auto of_class = [&](const char* kind) {
        const auto found = score.by_class.find(kind);
        return found == score.by_class.end() ? Share{} : found->second;
    };
    need("the identifiable named", score.identifiable, 0.9);
    need("unlisted effects called unknown", of_class("unlisted"), 0.8);
    need("pairs named", of_class("pair"), 0.7);
    if (score.false_alarms.all > 0 && score.false_alarms.value() > 0.05) {
        missed.push_back(
            fmt::format("false alarms: expected at most 5 %, found {:.1f} %", 100.0 * score.false_alarms.value()));
    }
    if (!score.of_the_oracle.empty() && median(score.of_the_oracle) < 0.9) {
        missed.push_back(fmt::format("shrink: expected at least 0.9 of the oracle's in the median, found {:.2f}",
                                     median(score.of_the_oracle)));
    }
    return missed;
}

std::string to_text(std::span<const Scored> scored) {
    const Score& own = scored.front().score;
    std::string text = fmt::format("{:<32} {:<14} Wilson's 95 % interval\n", "", "right");
    const auto line = [&](const char* what, const Share& share) {
        text += fmt::format("{:<32} {}\n", what, shown(share));
    };
    line("top-1, all cases", own.top_one);
    line("top-1, the identifiable", own.identifiable);
    line("top-2, listed effects", own.top_two);
    line("detection", own.detection);
    line("false alarms", own.false_alarms);
    line("  on a new profile", own.false_alarms_new_profile);
    line("wrong among the attributed", own.wrong_claims);
    text += table("by class", own.by_class);
    text += table("single effects", own.by_effect);
    text += table("single effects, by size", own.by_size);
    text += table("single effects, by the training's excitation", own.by_training);
    text += "\nconfidence of the attributed\n";
    for (const Confidence& bin : own.calibration) {
        if (bin.right.all > 0) {
            text += fmt::format("  {:.2f} to {:.2f}, mean {:.3f}       {}\n", bin.from, std::min(bin.to, 1.0),
                                bin.claimed, shown(bin.right));
        }
    }
    text += "\ntruth: answers\n";
    for (const auto& [truth, answers] : own.confusion) {
        std::vector<std::pair<std::size_t, std::string>> most;
        for (const auto& [answer, count] : answers) {
            most.emplace_back(count, answer);
        }
        std::stable_sort(most.begin(), most.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
        text += fmt::format("  {:<30}", truth);
        for (const auto& [count, answer] : most) {
            text += fmt::format(" {} {};", count, answer);
        }
        text.back() = '\n';
    }
    text += '\n';
    const auto spread = [&](const char* what, const std::vector<double>& values) {
        if (!values.empty()) {
            text += fmt::format("{:<32} median {:.3f}, a tenth below {:.3f} ({} cases)\n", what, median(values),
                                values[values.size() / 10], values.size());
        }
    };
    spread("shrink of the rightly named", own.shrinks);
    spread("shrink over the oracle's", own.of_the_oracle);
    spread("located gap in the true stretch", own.in_the_stretch);
    text += fmt::format("\n{:<24} {:>8} {:>13} {:>10} {:>13} {:>9} {:>9}\n", "beside others", "top-1", "identifiable",
                        "detection", "false alarms", "unlisted", "pairs");
    for (const Scored& other : scored) {
        const auto percent = [&](const Share& share) {
            return share.all == 0 ? std::string("-") : fmt::format("{:.1f} %", 100.0 * share.value());
        };
        const auto of_class = [&](const char* kind) {
            const auto found = other.score.by_class.find(kind);
            return percent(found == other.score.by_class.end() ? Share{} : found->second);
        };
        text += fmt::format("{:<24} {:>8} {:>13} {:>10} {:>13} {:>9} {:>9}\n", other.name, percent(other.score.top_one),
                            percent(other.score.identifiable), percent(other.score.detection),
                            percent(other.score.false_alarms), of_class("unlisted"), of_class("pair"));
    }
    return text;
}

std::string to_json(std::span<const Scored> scored) {
    Json file{{"schema", "glsum-blind-score-1"}};
    file["scores"] = Json::array();
    for (const Scored& one : scored) {
        const Score& s = one.score;
        Json row{{"name", one.name},
                 {"top_one", to_json(s.top_one)},
                 {"identifiable", to_json(s.identifiable)},
                 {"top_two", to_json(s.top_two)},
                 {"detection", to_json(s.detection)},
                 {"false_alarms", to_json(s.false_alarms)},
                 {"false_alarms_new_profile", to_json(s.false_alarms_new_profile)},
                 {"wrong_claims", to_json(s.wrong_claims)}};
        for (const auto& [key, shares] : {std::pair("by_class", &s.by_class), std::pair("by_effect", &s.by_effect),
                                          std::pair("by_size", &s.by_size), std::pair("by_training", &s.by_training)}) {
            row[key] = Json::object();
            for (const auto& [name, share] : *shares) {
                row[key][name] = to_json(share);
            }
        }
        row["calibration"] = Json::array();
        for (const Confidence& bin : s.calibration) {
            row["calibration"].push_back({{"from", bin.from},
                                          {"to", std::min(bin.to, 1.0)},
                                          {"claimed", bin.claimed},
                                          {"right", to_json(bin.right)}});
        }
        row["confusion"] = s.confusion;
        row["shrink"] = s.shrinks;
        row["shrink_of_the_oracle"] = s.of_the_oracle;
        row["located_in_the_true_stretch"] = s.in_the_stretch;
        file["scores"].push_back(std::move(row));
    }
    return file.dump(2) + "\n";
}

}  // namespace stand::blind
