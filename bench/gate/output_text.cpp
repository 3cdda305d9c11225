// The outputs that people read: table, Markdown, annotations.
#include <fmt/format.h>

#include <algorithm>

#include "bench/gate/group.hpp"
#include "bench/gate/outputs.hpp"

namespace bench::gate {
namespace {

constexpr Level levels[] = {Level::fail, Level::warn, Level::improvement, Level::note};

std::string_view plural_of(Level level) {
    switch (level) {
        case Level::fail:
            return "Failures";
        case Level::warn:
            return "Warnings";
        case Level::improvement:
            return "Improvements";
        case Level::note:
            return "Notes";
    }
    return "";
}

std::string colour_of(Level level) {
    switch (level) {
        case Level::fail:
            return "\033[31m";
        case Level::warn:
            return "\033[33m";
        case Level::improvement:
            return "\033[32m";
        case Level::note:
            return "\033[2m";
    }
    return "";
}

std::string state_of(const LayerCount& count) {
    if (count.failed > 0) {
        return "FAIL";
    }
    if (count.warned > 0) {
        return "warn";
    }
    return count.compared > 0 ? "ok" : "-";
}

// How many there are, and of how many kernels, targets and counters where that is fewer.
std::string title_of(const Verdict& verdict, Level level) {
    const std::size_t all = verdict.with(level);
    const std::size_t groups = groups_of(verdict, level).size();
    return groups == all ? fmt::format("{} ({})", plural_of(level), all)
                         : fmt::format("{} ({} in {} lines)", plural_of(level), all, groups);
}

std::string effect_text(Effect effect) {
    switch (effect) {
        case Effect::incomparable:
            return "not comparable";
        case Effect::advisory:
            return "host times only warn";
        case Effect::note:
            return "for your information";
    }
    return "";
}

std::string escape_markdown(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '|' || c == '\\' || c == '*' || c == '_' || c == '`' || c == '<' || c == '[') {
            escaped += '\\';
        }
        escaped += c == '\n' ? ' ' : c;
    }
    return escaped;
}

// What GitHub's workflow commands cannot hold as it is; properties need more than messages.
std::string escape_annotation(const std::string& text, bool property) {
    std::string escaped;
    for (const char c : text) {
        switch (c) {
            case '%':
                escaped += "%25";
                break;
            case '\r':
                escaped += "%0D";
                break;
            case '\n':
                escaped += "%0A";
                break;
            case ':':
                escaped += property ? "%3A" : ":";
                break;
            case ',':
                escaped += property ? "%2C" : ",";
                break;
            default:
                escaped += c;
        }
    }
    return escaped;
}

std::string annotation(const char* command, const Place& place, const std::string& title, const std::string& text) {
    const std::string where =
        place.file.empty() ? "" : fmt::format("file={},line={},", escape_annotation(place.file, true), place.line);
    return fmt::format("::{} {}title={}::{}\n", command, where, escape_annotation(title, true),
                       escape_annotation(text, false));
}

}  // namespace

std::string to_table(const Verdict& verdict, bool colour) {
    const auto paint = [&](const std::string& code, const std::string& text) {
        return colour ? code + text + "\033[0m" : text;
    };
    std::string text =
        fmt::format("gate: {} against {}{}\n", verdict.current_name, verdict.baseline_name, verdict.besides());
    for (const Difference& difference : verdict.differences) {
        text += fmt::format("  {}: {} in the baseline, {} now: {}\n", difference.field, difference.baseline,
                            difference.current, effect_text(difference.effect));
    }
    if (verdict.refusal.empty() && verdict.status != glsum::Exit::not_comparable) {
        text += fmt::format("\n  {:<24} {:>9} {:>7} {:>7} {:>7} {:>7} {:>11}\n", "layer", "compared", "fail", "warn",
                            "better", "moot", "not judged");
        for (const Layer layer : layers) {
            const LayerCount& count = verdict.count(layer);
            const std::string state = state_of(count);
            const std::string line =
                fmt::format("  {:<24} {:>9} {:>7} {:>7} {:>7} {:>7} {:>11}  {}", name_of(layer), count.compared,
                            count.failed, count.warned, count.better, count.moot, count.not_judged, state);
            text += (state == "FAIL" ? paint(colour_of(Level::fail), line) : line) + "\n";
        }
    }
    constexpr std::size_t shown = 20;
    for (const Level level : levels) {
        const auto found = groups_of(verdict, level);
        if (found.empty()) {
            continue;
        }
        text += fmt::format("\n{}\n", paint(colour_of(level), title_of(verdict, level)));
        for (std::size_t i = 0; i < std::min(shown, found.size()); ++i) {
            text +=
                fmt::format("  {:<22} {}: {}\n", name_of(found[i].first().layer), found[i].subject(), found[i].what());
        }
        if (found.size() > shown) {
            text += fmt::format("  ... and {} more; --json has them all\n", found.size() - shown);
        }
    }
    const std::string last = fmt::format("\n{}: {}\n", verdict.word(), verdict.headline());
    const Level level = verdict.status == glsum::Exit::good ? Level::improvement : Level::fail;
    return text + paint(colour_of(level), last);
}

std::string to_markdown(const Verdict& verdict) {
    const bool good = verdict.status == glsum::Exit::good;
    std::string text = fmt::format("## {} glsum gate: {}\n\n{}\n\n`{}` against `{}`{}\n", good ? "✅" : "❌",
                                   verdict.word(), escape_markdown(verdict.headline()), verdict.current_name,
                                   verdict.baseline_name, escape_markdown(verdict.besides()));
    if (!verdict.differences.empty()) {
        text += "\n| condition | baseline | now | effect |\n|---|---|---|---|\n";
        for (const Difference& difference : verdict.differences) {
            text += fmt::format("| {} | {} | {} | {} |\n", escape_markdown(difference.field),
                                escape_markdown(difference.baseline), escape_markdown(difference.current),
                                effect_text(difference.effect));
        }
    }
    if (verdict.refusal.empty() && verdict.status != glsum::Exit::not_comparable) {
        text += "\n| layer | compared | fail | warn | better | |\n|---|--:|--:|--:|--:|---|\n";
        for (const Layer layer : layers) {
            const LayerCount& count = verdict.count(layer);
            text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", escape_markdown(std::string(name_of(layer))),
                                count.compared, count.failed, count.warned, count.better, state_of(count));
        }
    }
    constexpr std::size_t shown = 100;
    for (const Level level : levels) {
        const auto found = groups_of(verdict, level);
        if (found.empty()) {
            continue;
        }
        text += fmt::format(
            "\n<details{}><summary>{}</summary>\n\n| layer | row | counter | change | why |\n"
            "|---|---|---|---|---|\n",
            level == Level::fail ? " open" : "", title_of(verdict, level));
        for (std::size_t i = 0; i < std::min(shown, found.size()); ++i) {
            const Finding& first = found[i].first();
            text += fmt::format("| {} | {} | {} | {} | {} |\n", escape_markdown(std::string(name_of(first.layer))),
                                escape_markdown(found[i].rows()), escape_markdown(first.counter),
                                escape_markdown(found[i].what()), escape_markdown(first.reason));
        }
        if (found.size() > shown) {
            text += fmt::format("\n... and {} more\n", found.size() - shown);
        }
        text += "\n</details>\n";
    }
    return text;
}

std::string to_annotations(const Verdict& verdict) {
    constexpr std::size_t shown = 10;
    if (verdict.status != glsum::Exit::good && verdict.status != glsum::Exit::check_failed) {
        return annotation("error", {}, "glsum gate: " + verdict.word(), verdict.headline());
    }
    std::string text;
    for (const auto& [level, command] : {std::pair(Level::fail, "error"), std::pair(Level::warn, "warning")}) {
        const auto found = groups_of(verdict, level);
        for (std::size_t i = 0; i < std::min(shown, found.size()); ++i) {
            // The last place tells how many there are.
            const std::size_t left = i + 1 == shown ? found.size() - shown : 0;
            const std::string more = left > 0 ? fmt::format("\nand {} more", left) : "";
            text += annotation(command, place_of(found[i].first().row),
                               fmt::format("glsum gate: {}", name_of(found[i].first().layer)),
                               fmt::format("{}: {}{}", found[i].subject(), found[i].what(), more));
        }
    }
    return text;
}

}  // namespace bench::gate
