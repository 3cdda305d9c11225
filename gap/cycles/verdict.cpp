#include "gap/cycles/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace gap::cycles {
namespace {

using Json = nlohmann::ordered_json;

double shrink_of(const Explanation& found, const Step& step) {
    const double most = found.base_gap - found.floor;
    return most > 0.0 ? (step.gap_before - step.gap_after) / most : 0.0;
}

Json to_json(const Explanation& found, const Step& step) {
    Json parameters = Json::object();
    for (const auto& [name, value] : step.parameters) {
        parameters[name] = value;
    }
    Json interval = Json::object();
    for (const auto& [name, range] : step.interval) {
        interval[name] = {range.low, range.high};
    }
    return {{"effect", step.effect},         {"parameters", parameters},    {"interval", interval},
            {"gap_before", step.gap_before}, {"gap_after", step.gap_after}, {"shrink", shrink_of(found, step)},
            {"confidence", step.confidence}};
}

Json to_json(const std::vector<Share>& shares, const char* key) {
    Json list = Json::array();
    for (const Share& one : shares) {
        list.push_back({{key, one.name}, {"share", one.share}});
    }
    return list;
}

double share_of(const std::vector<Share>& shares, const std::string& name) {
    const auto found = std::find_if(shares.begin(), shares.end(), [&](const Share& one) { return one.name == name; });
    return found != shares.end() ? found->share : 0.0;
}

}  // namespace

std::string to_json(const Explanation& found) {
    Json effects = Json::array();
    std::vector<Step> ranked = found.steps;
    for (const Step& step : found.steps) {
        effects.push_back(to_json(found, step));
    }
    for (const Step& step : found.alternatives) {
        effects.push_back(to_json(found, step));
        ranked.push_back(step);
    }
    std::stable_sort(ranked.begin(), ranked.end(), [](const Step& a, const Step& b) {
        return a.gap_before - a.gap_after > b.gap_before - b.gap_after;
    });
    Json ranking = Json::array();
    for (const Step& step : ranked) {
        ranking.push_back(
            {{"effect", step.effect}, {"gap_after", step.gap_after}, {"score", step.gap_before - step.gap_after}});
    }
    Json alternatives = Json::array();
    for (const Step& step : found.alternatives) {
        alternatives.push_back(step.effect);
    }
    const Json json{{"schema", "glsum-gap-1"},
                    {"verdict", found.verdict},
                    {"effects", effects},
                    {"alternatives", alternatives},
                    {"ranking", ranking},
                    {"gap",
                     {{"metric", "sum of absolute differences over the sum of measured cycles"},
                      {"base", found.base_gap},
                      {"after", found.after_gap},
                      {"noise_floor", found.floor}}},
                    {"where",
                     {{"kernel", to_json(found.kernels, "kernel")},
                      {"slope", share_of(found.lines, "slope")},
                      {"constant", share_of(found.lines, "constant")},
                      {"placement", to_json(found.placements, "placement")},
                      {"call", {{"first", 0.0}, {"warm", 1.0}}}}},
                    {"reference", found.reference},
                    {"notes", found.notes},
                    {"next_experiment", found.next_experiment}};
    return json.dump(2) + "\n";
}

std::string to_text(const Explanation& found, const std::string& base) {
    std::string text = fmt::format(
        "{}: the gap to {} is {:.1f} % of the measured cycles, {:.2f} % with what follows "
        "(noise {:.2f} %)\n\n",
        found.verdict, base, 100 * found.base_gap, 100 * found.after_gap, 100 * found.floor);
    text += "where it lies\n";
    for (const auto& [title, shares] : {std::pair("kernel", &found.kernels), std::pair("placement", &found.placements),
                                        std::pair("along the length", &found.lines)}) {
        for (const Share& one : *shares) {
            text += fmt::format("  {:<18} {:<44} {:>5.1f} %\n", title, one.name, 100 * one.share);
        }
    }
    if (!found.steps.empty() || !found.alternatives.empty()) {
        text += fmt::format("\n{:<24} {:>18} {:>18} {:>10} {:>10}\n", "effect, in turn", "parameter", "95 %",
                            "gap before", "after");
    }
    const auto line = [&](const Step& step) {
        const auto first = step.parameters.begin();
        const auto interval = first != step.parameters.end() ? step.interval.find(first->first) : step.interval.end();
        text += fmt::format("{:<24} {:>18} {:>18} {:>9.1f}% {:>9.1f}%\n", step.effect,
                            first != step.parameters.end() ? fmt::format("{:.4g} {}", first->second,
                                                                         first->first.substr(0, first->first.find(' ')))
                                                           : "",
                            interval != step.interval.end()
                                ? fmt::format("{:.1f} to {:.1f}", interval->second.low, interval->second.high)
                                : "",
                            100 * step.gap_before, 100 * step.gap_after);
    };
    for (const Step& step : found.steps) {
        line(step);
    }
    if (!found.alternatives.empty()) {
        text += fmt::format("\nwhat these rows cannot part ({}), each explains it as well:\n", found.apart);
        for (const Step& step : found.alternatives) {
            line(step);
        }
    }
    for (const std::string& note : found.notes) {
        text += fmt::format("\nnote: {}\n", note);
    }
    if (!found.next_experiment.empty()) {
        text += fmt::format("\nnext experiment: {}\n", found.next_experiment);
    }
    return text;
}

}  // namespace gap::cycles
