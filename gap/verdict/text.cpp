#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "gap/verdict/verdict.hpp"

namespace gap {
namespace {

std::string four_digits(double value) { return fmt::format("{:.4g}", value); }

std::string shown(const ContractValue& value) {
    if (const auto* list = std::get_if<std::vector<double>>(&value)) {
        std::string all;
        for (const double one : *list) {
            all += (all.empty() ? "" : ", ") + four_digits(one);
        }
        return all;
    }
    const auto* word = std::get_if<std::string>(&value);
    return word != nullptr ? *word : four_digits(std::get<double>(value));
}

std::string shown_intervals(const Written& number) {
    if (number.intervals.empty() && !std::holds_alternative<std::vector<double>>(number.value)) {
        return "";
    }
    std::string all;
    for (const auto& [low, high] : number.intervals) {
        all += fmt::format("{}{:.4g}, {:.4g}", all.empty() ? "" : ", ", low, high);
    }
    return fmt::format("  [{}]", all);
}

std::string shown_unit(const Written& number) {
    return number.unit.empty() || number.unit == "1" ? "" : "  " + number.unit;
}

// What a cause takes of the squared gap, beside the others that are named with it.
std::string share_text(const Cause& cause, std::size_t named) {
    if (!cause.gap_without || !(cause.gap_before > 0.0)) {
        return "";
    }
    const auto squared = [](double gap) { return gap * gap; };
    const double share = (squared(*cause.gap_without) - squared(cause.gap_after)) / squared(cause.gap_before);
    return fmt::format("{} takes {:.0f} % of the squared gap{}", cause.effect, 100.0 * std::max(0.0, share),
                       named > 1 ? fmt::format("; without it {:.4f} is left", *cause.gap_without) : "");
}

// How much of the measured output's variance is explained where a gap is left.
double explained_percent(double gap) { return 100.0 * std::max(0.0, 1.0 - gap * gap); }

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

std::string where_text(const WhereInRows& where) {
    std::string text = "where it lies\n";
    for (const auto& [title, shares] : {std::pair("kernel", &where.kernels), std::pair("placement", &where.placements),
                                        std::pair("along the length", &where.lines)}) {
        for (const NamedShare& one : *shares) {
            text += fmt::format("  {:<18} {:<44} {:>5.1f} %\n", title, one.name, 100 * one.share);
        }
    }
    return text;
}

std::string ranking_text(const std::vector<Rank>& ranking) {
    constexpr std::size_t most_rows = 10;
    std::string text = "\n  candidate                                                gap left   score over none\n";
    std::size_t rows = 0;
    for (const Rank& rank : ranking) {
        if (rows++ < most_rows || rank.effects == no_effect) {
            text += fmt::format("  {:<55} {:>9.4f} {:>17.1f}\n", rank.effects, rank.gap_after,
                                rank.score - score_of_no_effect(ranking));
        }
    }
    return text;
}

std::string text_of(const Verdict& verdict, const OfDrive& of) {
    const Gap& gap = verdict.gap;
    std::string text = fmt::format("verdict: {}", name_of(verdict.outcome));
    for (std::size_t i = 0; i < of.alternatives.size(); ++i) {
        text += fmt::format("{}{}", i == 0 ? ": " : " or ", joined(of.alternatives[i]));
    }
    text += fmt::format(" (confidence {:.2f})\n\n", of.confidence);
    text += fmt::format("gap, rms over the output's deviation, {}: {:.4f} before, {:.4f} after, {:.4f} at best\n",
                        gap.metric, gap.base, gap.after, gap.noise_floor);
    for (const std::string& line : {base_line(of), suspect_line(verdict, of)}) {
        text += line.empty() ? "" : line + "\n";
    }
    text += fmt::format("variance explained: {:.1f} % by the simulation, {:.1f} % by the best candidate\n",
                        explained_percent(gap.base), explained_percent(gap.after));
    if (of.split) {
        text += "judged by parts of the training record, which were kept aside\n";
    }
    for (const std::vector<Cause>& causes : of.alternatives) {
        for (const std::string& line : cause_lines(causes)) {
            text += fmt::format("  {}\n", line);
        }
    }
    text += ranking_text(verdict.ranking) + where_text(of.where);
    if (!of.extrapolated.empty()) {
        text += fmt::format("\nextrapolated, as training has none of it: {}\n", fmt::join(of.extrapolated, ", "));
    }
    for (const std::string& note : verdict.notes) {
        text += fmt::format("\nnote: {}", note);
    }
    return text + (verdict.notes.empty() ? "" : "\n") + "\nnext: " + verdict.next_experiment + "\n";
}

// One line of a cause by its first number, whose name may say in what it counts: "cycles_per_tap f32 ...".
std::string line_of(const Cause& cause) {
    const Written* first = cause.parameters.empty() ? nullptr : &cause.parameters.front();
    const std::string number = first == nullptr ? ""
                                                : fmt::format("{:.4g} {}", std::get<double>(first->value),
                                                              first->name.substr(0, first->name.find(' ')));
    const std::string interval =
        first == nullptr || first->intervals.empty()
            ? ""
            : fmt::format("{:.1f} to {:.1f}", first->intervals.front().first, first->intervals.front().second);
    return fmt::format("{:<24} {:>18} {:>18} {:>9.1f}% {:>9.1f}%\n", cause.effect, number, interval,
                       100 * cause.gap_before, 100 * cause.gap_after);
}

std::string text_of(const Verdict& verdict, const OfCycles& of) {
    std::string text = fmt::format(
        "{}: the gap to {} is {:.1f} % of the measured cycles, {:.2f} % with what follows "
        "(noise {:.2f} %)\n\n",
        name_of(verdict.outcome), of.judged, 100 * verdict.gap.base, 100 * verdict.gap.after,
        100 * verdict.gap.noise_floor);
    text += where_text(of.where);
    if (!of.steps.empty() || !of.alternatives.empty()) {
        text += fmt::format("\n{:<24} {:>18} {:>18} {:>10} {:>10}\n", "effect, in turn", "parameter", "95 %",
                            "gap before", "after");
    }
    for (const Cause& step : of.steps) {
        text += line_of(step);
    }
    if (!of.alternatives.empty()) {
        text += fmt::format("\nwhat these rows cannot part ({}), each explains it as well:\n", of.apart);
        for (const Cause& one : of.alternatives) {
            text += line_of(one);
        }
    }
    for (const std::string& note : verdict.notes) {
        text += fmt::format("\nnote: {}\n", note);
    }
    if (!verdict.next_experiment.empty()) {
        text += fmt::format("\nnext experiment: {}\n", verdict.next_experiment);
    }
    return text;
}

}  // namespace

double score_of_no_effect(const std::vector<Rank>& ranking) {
    for (const Rank& rank : ranking) {
        if (rank.effects == no_effect) {
            return rank.score;
        }
    }
    return 0.0;
}

std::string joined(const std::vector<Cause>& causes) {
    std::vector<std::string> names;
    for (const Cause& cause : causes) {
        names.push_back(cause.effect);
    }
    return fmt::format("{}", fmt::join(names, " + "));
}

std::vector<std::string> cause_lines(const std::vector<Cause>& causes) {
    std::vector<std::string> lines;
    for (const Cause& cause : causes) {
        for (const Written& number : cause.parameters) {
            lines.push_back(fmt::format("{}.{} = {}{}{}", cause.effect, number.name, shown(number.value),
                                        shown_intervals(number), shown_unit(number)));
        }
        if (std::string share = share_text(cause, causes.size()); !share.empty()) {
            lines.push_back(std::move(share));
        }
    }
    return lines;
}

std::string base_line(const OfDrive& of) {
    const BaseOfDrive& base = of.base;
    if (base.form.empty()) {
        return "";
    }
    std::string line = fmt::format("base: {}, {}; the best linear description explains {:.1f} % of the variance",
                                   base.form, base.in_short, 100.0 * base.linear_share);
    if (base.idle_input != 0.0) {
        line += fmt::format("; inputs, those of causes too, are counted from {:.6g}", base.idle_input);
    }
    for (std::size_t r = 0; r < base.records.size(); ++r) {
        const auto& [name, value] = base.records[r].numbers.front();
        line += fmt::format("{} {} {:.4g}", r == 0 ? "; of the records judged:" : ",", name, value);
    }
    return line;
}

std::string suspect_line(const Verdict& verdict, const OfDrive& of) {
    if (!of.suspect) {
        return "";
    }
    return fmt::format("suspect: {} brings the gap from {:.4f} to {:.4f}; {:.0f} % of its square stay unexplained",
                       of.suspect->name, verdict.gap.base, of.suspect->gap_after, 100.0 * of.suspect->unexplained);
}

std::string to_text(const Verdict& verdict) {
    return std::visit([&](const auto& of) { return text_of(verdict, of); }, verdict.of);
}

}  // namespace gap
