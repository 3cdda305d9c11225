#include "drive/stand/blind/judge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/failure.hpp"

namespace stand::blind {
namespace {

using OpenJson = nlohmann::ordered_json;
using Names = std::set<std::string>;

double in_common(const Names& a, const Names& b) {
    const auto shared =
        static_cast<double>(std::count_if(a.begin(), a.end(), [&](const auto& x) { return b.contains(x); }));
    return shared / (static_cast<double>(a.size() + b.size()) - shared);
}

std::string percent_of(const Share& share) {
    return share.all == 0 ? std::string("none to count")
                          : fmt::format("{:5.1f} %  {:>3} of {:<3} [{:4.1f}, {:5.1f}]", 100.0 * share.value(),
                                        share.hits, share.all, 100.0 * share.low(), 100.0 * share.high());
}

std::string percent_of(const Earned& earned) {
    return earned.all == 0 ? std::string("none to count")
                           : fmt::format("{:5.1f} %  {:.2f} of {}", 100.0 * earned.value(), earned.points, earned.all);
}

OpenJson json_of(const Share& share) {
    return {
        {"hits", share.hits}, {"of", share.all}, {"share", share.value()}, {"interval", {share.low(), share.high()}}};
}

OpenJson json_of(const Earned& earned) {
    return {{"points", earned.points}, {"of", earned.all}, {"share", earned.value()}};
}

std::string title_of(const SealedCase& truth) {
    return truth.effects.empty() || truth.kind == "single"
               ? row_of(truth)
               : fmt::format("{}: {}", truth.kind, fmt::join(truth.effects, "+"));
}

std::string said_by(const Answer& answer) {
    return answer.verdict == "ambiguous" ? fmt::format("{}", fmt::join(answer.effects, " or ")) : column_of(answer);
}

}  // namespace

Judgement judge(const SealedCase& truth, const Answer& answer) {
    const Names true_ones(truth.effects.begin(), truth.effects.end());
    const Names named(answer.effects.begin(), answer.effects.end());
    const bool listed = truth.kind == "single" || truth.kind == "pair";
    Judgement judged;
    if (answer.verdict == "attributed") {
        // An unlisted effect has a name in the sealed file alone; whoever names one names another.
        const double common = truth.kind == "unlisted" || truth.kind == "none" ? 0.0 : in_common(true_ones, named);
        judged.wrong = common == 0.0;
        judged.points = listed ? common : 0.0;
    } else if (answer.verdict == "ambiguous") {
        for (const std::string& effect : named) {
            const bool counts = listed && named.size() <= most_alternatives;
            judged.points += counts ? in_common(true_ones, {effect}) / static_cast<double>(named.size()) : 0.0;
        }
    } else if (answer.verdict == "unknown") {
        judged.points = truth.kind == "unlisted" ? 1.0 : 0.0;
    } else {
        judged.points = truth.kind == "none" || truth.kind == "taken_up" ? 1.0 : 0.0;
    }
    return judged;
}

OpenScore score_open(std::span<const SealedCase> truths, std::span<const Answer> answers) {
    if (answers.size() != truths.size()) {
        throw glsum::Failure(
            glsum::Exit::bad_input,
            fmt::format("score: expected one verdict for each of {} cases, found {}", truths.size(), answers.size()));
    }
    OpenScore total;
    const auto earn = [](Earned& earned, double points) {
        earned.points += points;
        ++earned.all;
    };
    for (std::size_t i = 0; i < truths.size(); ++i) {
        const SealedCase& truth = truths[i];
        const Answer& answer = answers[i];
        const Judgement judged = judge(truth, answer);
        total.wrong.count(judged.wrong);
        total.cases.push_back({truth, answer, judged});
        ++total.confusion[title_of(truth)][said_by(answer)];
        if (truth.kind == "single") {
            earn(total.singles, judged.points);
            earn(total.by_effect[truth.effects.front()], judged.points);
            earn(total.by_domain[truth.domain], judged.points);
            earn(total.by_size[truth.size], judged.points);
        } else if (truth.kind == "pair") {
            earn(total.pairs, judged.points);
        } else {
            (truth.kind == "unlisted" ? total.unlisted : total.nothing).count(judged.points == 1.0);
        }
        if (answer.verdict == "attributed") {
            total.claims.push_back({answer.confidence, judged.points == 1.0});
        } else if (answer.verdict == "ambiguous") {
            const bool listed = truth.kind == "single" || truth.kind == "pair";
            total.ambiguous_without.count(
                !listed || std::none_of(truth.effects.begin(), truth.effects.end(), [&](const std::string& effect) {
                    return std::find(answer.effects.begin(), answer.effects.end(), effect) != answer.effects.end();
                }));
        }
    }
    return total;
}

std::string to_text(const OpenScore& score) {
    std::string text;
    const auto line = [&](const std::string& what, const std::string& value) {
        text += fmt::format("{:<46} {}\n", what, value);
    };
    const auto table = [&](const char* title, const std::map<std::string, Earned>& rows) {
        text += fmt::format("\n{}\n", title);
        for (const auto& [name, earned] : rows) {
            line("  " + name, percent_of(earned));
        }
    };
    line("", "reached  counted, with Wilson's 95 % interval");
    line("single causes, points (>= 80 %)", percent_of(score.singles));
    line("pairs, points", percent_of(score.pairs));
    line("wrong, of all cases (<= 3 %)", percent_of(score.wrong));
    line("unlisted effects called unknown (>= 85 %)", percent_of(score.unlisted));
    line("nothing to find or taken up: no_gap (>= 95 %)", percent_of(score.nothing));
    line("answers at 0.9 and above, right (>= 90 %)", percent_of(right_of_the_sure(score.claims)));
    line("right answers, at 0.9 and above (>= 60 %)", percent_of(sure_of_the_right(score.claims)));
    line("Brier score of the attributed",
         score.claims.empty() ? "none to count"
                              : fmt::format("{:.3f}    {} answers", brier_score(score.claims), score.claims.size()));
    line("ambiguous without the truth, of the ambiguous", percent_of(score.ambiguous_without));
    table("single causes, by domain", score.by_domain);
    table("single causes, by effect", score.by_effect);
    table("single causes, by size", score.by_size);
    text += "\nconfidence of the attributed\n";
    for (const Confidence& bin : calibrate(score.claims)) {
        if (bin.right.all > 0) {
            line(fmt::format("  {:.2f} to {:.2f}, mean {:.3f}", bin.from, std::min(bin.to, 1.0), bin.claimed),
                 percent_of(bin.right));
        }
    }
    text += "\ntruth: answers\n";
    for (const auto& [truth, answers] : score.confusion) {
        text += fmt::format("  {:<44}", truth);
        const char* between = "";
        for (const auto& [answer, count] : answers) {
            text += fmt::format("{} {} {}", between, count, answer);
            between = ";";
        }
        text += '\n';
    }
    return text;
}

std::string to_json(const OpenScore& score) {
    OpenJson file{{"schema", "glsum-open-score-1"},
                  {"single_points", json_of(score.singles)},
                  {"pair_points", json_of(score.pairs)},
                  {"wrong", json_of(score.wrong)},
                  {"unlisted_unknown", json_of(score.unlisted)},
                  {"nothing_no_gap", json_of(score.nothing)},
                  {"right_of_the_sure", json_of(right_of_the_sure(score.claims))},
                  {"sure_of_the_right", json_of(sure_of_the_right(score.claims))},
                  {"brier_score", brier_score(score.claims)},
                  {"ambiguous_without_the_truth", json_of(score.ambiguous_without)}};
    for (const auto& [key, rows] : {std::pair("by_domain", &score.by_domain), std::pair("by_effect", &score.by_effect),
                                    std::pair("by_size", &score.by_size)}) {
        file[key] = OpenJson::object();
        for (const auto& [name, earned] : *rows) {
            file[key][name] = json_of(earned);
        }
    }
    file["calibration"] = OpenJson::array();
    for (const Confidence& bin : calibrate(score.claims)) {
        file["calibration"].push_back({{"from", bin.from},
                                       {"to", std::min(bin.to, 1.0)},
                                       {"claimed", bin.claimed},
                                       {"right", json_of(bin.right)}});
    }
    file["confusion"] = score.confusion;
    file["cases"] = OpenJson::array();
    for (const JudgedCase& one : score.cases) {
        file["cases"].push_back({{"case", one.truth.name},
                                 {"domain", one.truth.domain},
                                 {"class", one.truth.kind},
                                 {"truth", one.truth.effects},
                                 {"verdict", one.answer.verdict},
                                 {"named", one.answer.effects},
                                 {"confidence", one.answer.confidence},
                                 {"points", one.judged.points},
                                 {"wrong", one.judged.wrong}});
    }
    return file.dump(2) + "\n";
}

std::vector<std::string> missed_goals(const OpenScore& score) {
    std::vector<std::string> missed;
    const auto need = [&](const char* what, std::size_t counted, double found, double least) {
        if (counted > 0 && found < least) {
            missed.push_back(
                fmt::format("{}: expected at least {:.0f} %, found {:.1f} %", what, 100.0 * least, 100.0 * found));
        }
    };
    need("points for single causes", score.singles.all, score.singles.value(), 0.8);
    if (score.wrong.all > 0 && score.wrong.value() > 0.03) {
        missed.push_back(
            fmt::format("wrong: expected at most 3 % of all cases, found {:.1f} %", 100.0 * score.wrong.value()));
    }
    need("unlisted effects called unknown", score.unlisted.all, score.unlisted.value(), 0.85);
    need("no_gap where there is nothing to find", score.nothing.all, score.nothing.value(), 0.95);
    const Share right = right_of_the_sure(score.claims);
    const Share certain = sure_of_the_right(score.claims);
    need("right of the answers at 0.9 and above", right.all, right.value(), 0.9);
    need("of the right answers at 0.9 and above", certain.all, certain.value(), 0.6);
    return missed;
}

}  // namespace stand::blind
