#include "gap/exam/score.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "gap/exam/fields.hpp"
#include "gap/exam/manifest.hpp"

namespace gap::exam {
namespace {

using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

constexpr std::size_t most_alternatives = 3;
constexpr double sure = 0.9;

bool contains(const Names& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

const Cause* cause_of(const Truth& truth, const std::string& effect) {
    const auto found = std::find_if(truth.causes.begin(), truth.causes.end(),
                                    [&](const Cause& cause) { return contains(cause.any_of, effect); });
    return found == truth.causes.end() ? nullptr : &*found;
}

// Of effects that are named together.
Mark mark_of(const Truth& truth, const Names& named) {
    bool main = false;
    bool spurious = false;
    for (const std::string& effect : named) {
        const Cause* cause = cause_of(truth, effect);
        main = main || (cause != nullptr && cause->main);
        spurious = spurious || cause == nullptr;
    }
    return !main ? Mark::wrong : spurious ? Mark::spurious : Mark::right;
}

std::pair<Mark, double> ambiguous(const Truth& truth, const Reply& reply) {
    std::size_t right = 0;
    bool partly = false;
    for (const Names& named : reply.named) {
        const Mark mark = mark_of(truth, named);
        right += mark == Mark::right ? 1 : 0;
        partly = partly || mark == Mark::spurious;
    }
    const std::size_t count = reply.named.size();
    if (right == 0) {
        return {partly ? Mark::ambiguous : Mark::wrong, 0.0};
    }
    if (right == count && count <= most_alternatives) {
        return {Mark::right, 1.0};
    }
    return {Mark::ambiguous, count > most_alternatives ? 0.0 : 1.0 / static_cast<double>(count - right + 1)};
}

std::pair<Mark, double> judged(const Truth& truth, const Reply& reply) {
    if (reply.verdict == "refused") {
        return {Mark::refused, 0.0};
    }
    if (reply.verdict == "no_gap") {
        const bool right = truth.known == Known::nothing;
        return {right ? Mark::right : Mark::wrong, right ? 1.0 : 0.0};
    }
    if (reply.verdict == "unknown") {
        const bool honest = truth.known == Known::not_listed;
        return {honest ? Mark::honest_unknown : Mark::missed, honest ? 1.0 : 0.0};
    }
    if (reply.verdict == "ambiguous") {
        return ambiguous(truth, reply);
    }
    const Mark mark = mark_of(truth, reply.named.front());
    return {mark, mark == Mark::right ? 1.0 : mark == Mark::spurious ? 0.5 : 0.0};
}

std::optional<double> number_in(const Json& object, const char* key) {
    return object.is_object() && object.contains(key) && object[key].is_number()
               ? std::optional(object[key].get<double>())
               : std::nullopt;
}

// The named effects by alternative: entries that say which they belong to, or each for itself in an ambiguity.
void take_named(Reply& reply, Fields& fields) {
    std::map<std::size_t, Names> by_alternative;
    std::size_t row = 0;
    for (Json& value : fields.list("effects", 1000, true)) {
        const std::string place = fmt::format("{}: effects[{}]", fields.name(), row);
        const std::optional<double> which = number_in(value, "alternative");
        Fields own(std::move(value), place);
        const std::size_t alternative = reply.verdict == "attributed" ? 0
                                        : which ? static_cast<std::size_t>(std::clamp(*which, 0.0, 1e6))
                                                : row;
        by_alternative[alternative].push_back(own.text("effect"));
        const Json confidence = own.take("confidence");
        if (!confidence.is_number() || confidence.get<double>() < 0.0 || confidence.get<double>() > 1.0) {
            own.refuse("confidence", "0 to 1", confidence.dump().substr(0, 60));
        }
        reply.confidence = row == 0 ? confidence.get<double>() : std::min(reply.confidence, confidence.get<double>());
        ++row;
    }
    for (auto& [which, names] : by_alternative) {
        reply.named.push_back(std::move(names));
    }
    if (reply.named.empty() && (reply.verdict == "attributed" || reply.verdict == "ambiguous")) {
        fields.refuse("effects", "at least one beside " + reply.verdict, "none");
    }
}

std::string shown(const std::optional<double>& value) { return value ? fmt::format("{:.3f}", *value) : "-"; }

std::string shown(const Reply& reply) {
    if (reply.verdict == "refused") {
        return "refused: " + reply.reason;
    }
    std::vector<std::string> alternatives;
    for (const Names& named : reply.named) {
        alternatives.push_back(fmt::format("{}", fmt::join(named, " + ")));
    }
    if (!alternatives.empty() && reply.verdict != "unknown") {
        return fmt::format("{} ({:.2f})", fmt::join(alternatives, " or "), reply.confidence);
    }
    return reply.suspect.empty() ? reply.verdict
                                 : fmt::format("{}, suspect {}", reply.verdict, fmt::join(reply.suspect, " + "));
}

std::string shown(const Truth& truth) {
    std::vector<std::string> causes;
    for (const Cause& cause : truth.causes) {
        causes.push_back(cause.main ? cause.any_of.front() : "(" + cause.any_of.front() + ")");
    }
    const std::string listed = fmt::format("{}", fmt::join(causes, ", "));
    switch (truth.known) {
        case Known::listed:
            return listed;
        case Known::nothing:
            return "nothing large";
        case Known::not_listed:
            break;
    }
    return causes.empty() ? "not listed" : "not listed, or " + listed;
}

struct Sums {
    std::map<Mark, std::size_t> marks;
    double points = 0.0;
    double closed = 0.0;
    std::size_t with_attainable = 0;
    std::size_t surely = 0;  // named with a confidence of 0.9 and more
    std::size_t surely_right = 0;
    double brier = 0.0;
    std::size_t named = 0;
};

Sums sums_of(std::span<const Scored> all) {
    Sums sums;
    for (const Scored& one : all) {
        ++sums.marks[one.mark];
        sums.points += one.points;
        if (one.closed) {
            sums.closed += *one.closed;
            ++sums.with_attainable;
        }
        if (one.reply.verdict == "attributed") {
            const bool right = one.mark == Mark::right;
            sums.surely += one.reply.confidence >= sure ? 1 : 0;
            sums.surely_right += one.reply.confidence >= sure && right ? 1 : 0;
            sums.brier += std::pow(one.reply.confidence - (right ? 1.0 : 0.0), 2.0);
            ++sums.named;
        }
    }
    return sums;
}

}  // namespace

const char* name_of(Mark mark) {
    switch (mark) {
        case Mark::right:
            return "right";
        case Mark::spurious:
            return "right, and a spurious one";
        case Mark::ambiguous:
            return "ambiguous with the right one";
        case Mark::honest_unknown:
            return "honestly unknown";
        case Mark::missed:
            return "unknown, though known";
        case Mark::wrong:
            return "WRONG";
        case Mark::refused:
            return "refused";
    }
    return "refused";
}

Reply refusal(const std::string& reason) {
    Reply reply;
    reply.verdict = "refused";
    reply.reason = reason;
    return reply;
}

Reply parse_reply(const std::string& text, const std::string& name) {
    Fields fields = object_in(text, name);
    (void)fields.one_of("schema", {"glsum-gap-1"});
    Reply reply;
    reply.verdict = fields.one_of("verdict", {"attributed", "ambiguous", "unknown", "no_gap"});
    take_named(reply, fields);
    const Json gap = fields.take("gap");
    reply.gap_before = number_in(gap, "base");
    reply.gap_after = number_in(gap, "after");
    if (fields.has("suspect")) {
        const Json suspect = fields.take("suspect");
        if (suspect.is_object() && suspect.contains("effects")) {
            Fields own(suspect, name + ": suspect");
            for (Json& effect : own.list("effects", Limits::list, true)) {
                reply.suspect.push_back(Fields(std::move(effect), own.name() + ": effects").text("effect"));
            }
        }
    }
    return reply;
}

Scored score(const Truth& truth, const Reply& reply) {
    Scored scored{truth, reply, Mark::wrong, 0.0, std::nullopt, std::nullopt};
    std::tie(scored.mark, scored.points) = judged(truth, reply);
    scored.attainable_gap = truth.attainable_gap;
    if (truth.attainable_of_base && reply.gap_before) {
        scored.attainable_gap = *truth.attainable_of_base * *reply.gap_before;
    }
    if (scored.attainable_gap && reply.gap_before && reply.gap_after && *reply.gap_before > *scored.attainable_gap) {
        const bool names = reply.verdict == "attributed" || reply.verdict == "ambiguous";
        const double by = names ? *reply.gap_before - *reply.gap_after : 0.0;
        scored.closed = std::min(1.0, by / (*reply.gap_before - *scored.attainable_gap));
    }
    return scored;
}

std::string to_text(std::span<const Scored> all) {
    std::string text = fmt::format("{:<18} {:<29} {:>6} {:>7} {:>7} {:>10}  {}\n", "question", "", "points", "before",
                                   "after", "attainable", "answer | known");
    for (const Scored& one : all) {
        text += fmt::format("{:<18} {:<29} {:>6.2f} {:>7} {:>7} {:>10}  {} | {}\n", one.truth.name, name_of(one.mark),
                            one.points, shown(one.reply.gap_before), shown(one.reply.gap_after),
                            shown(one.attainable_gap), shown(one.reply), shown(one.truth));
    }
    const Sums sums = sums_of(all);
    text += '\n';
    for (const Mark mark : all_marks) {
        const auto found = sums.marks.find(mark);
        text += fmt::format("{:<29} {:>3}\n", name_of(mark), found == sums.marks.end() ? 0 : found->second);
    }
    text += fmt::format("\n{:.2f} points of {}\n", sums.points, all.size());
    if (sums.with_attainable > 0) {
        text += fmt::format("{:.0f} % of the attainable closed, mean of {} questions where it is known\n",
                            100.0 * sums.closed / static_cast<double>(sums.with_attainable), sums.with_attainable);
    }
    if (sums.named > 0) {
        text +=
            fmt::format("attributed with a confidence of {} and more: {}, of them right {}; Brier score {:.3f} of {}\n",
                        sure, sums.surely, sums.surely_right, sums.brier / static_cast<double>(sums.named), sums.named);
    }
    return text;
}

std::string to_json(std::span<const Scored> all) {
    Json file{{"schema", "glsum-exam-score-1"}};
    file["questions"] = Json::array();
    const auto add = [](Json& row, const char* key, const std::optional<double>& value) {
        if (value && std::isfinite(*value)) {
            row[key] = *value;
        }
    };
    for (const Scored& one : all) {
        Json row{{"name", one.truth.name},       {"mark", name_of(one.mark)}, {"points", one.points},
                 {"verdict", one.reply.verdict}, {"named", one.reply.named},  {"confidence", one.reply.confidence},
                 {"known", shown(one.truth)}};
        add(row, "gap_before", one.reply.gap_before);
        add(row, "gap_after", one.reply.gap_after);
        add(row, "attainable_gap", one.attainable_gap);
        add(row, "closed", one.closed);
        if (!one.reply.reason.empty()) {
            row["reason"] = one.reply.reason;
        }
        if (!one.reply.suspect.empty()) {
            row["suspect"] = one.reply.suspect;
        }
        file["questions"].push_back(std::move(row));
    }
    const Sums sums = sums_of(all);
    file["marks"] = Json::object();
    for (const Mark mark : all_marks) {
        const auto found = sums.marks.find(mark);
        file["marks"][name_of(mark)] = found == sums.marks.end() ? 0 : found->second;
    }
    file["points"] = sums.points;
    if (sums.with_attainable > 0) {
        file["closed"] = sums.closed / static_cast<double>(sums.with_attainable);
    }
    if (sums.named > 0) {
        file["surely"] = sums.surely;
        file["surely_right"] = sums.surely_right;
        file["brier"] = sums.brier / static_cast<double>(sums.named);
    }
    return file.dump(2) + "\n";
}

}  // namespace gap::exam
