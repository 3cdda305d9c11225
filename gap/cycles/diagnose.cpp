#include "gap/cycles/diagnose.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "base/failure.hpp"
#include "gap/cycles/evidence.hpp"
#include "qemu/emulate/silicon_loops.hpp"

namespace gap::cycles {
namespace {

std::vector<std::string> names_of(const timing::Effects& effects) {
    std::vector<std::string> names;
    for (std::size_t e = 0; e < timing::effect_count; ++e) {
        if (effects[e]) {
            names.emplace_back(timing::effect_names[e]);
        }
    }
    return names;
}

std::optional<std::string> other_program(const std::vector<qemu::MeasuredCycles>& rows,
                                         const std::vector<qemu::PredictedCycles>& predicted) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto ours = static_cast<double>(predicted[i].instructions);
        if (rows[i].instructions && std::fabs(*rows[i].instructions - ours) > 0.5) {
            return fmt::format("{} at {} taps: {} instructions a call were measured, this build has {}", rows[i].kernel,
                               rows[i].taps, *rows[i].instructions, ours);
        }
    }
    return std::nullopt;
}

Explanation different_binary(const Question& question, const std::vector<qemu::PredictedCycles>& predicted,
                             const std::string& why) {
    Cycles measured;
    Cycles nominal;
    for (std::size_t i = 0; i < question.rows.size(); ++i) {
        measured.push_back(question.rows[i].cycles);
        nominal.push_back(predicted[i].nominal);
    }
    Rows all(question.rows.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    Explanation found;
    found.outcome = Outcome::attributed;
    found.base_gap = found.after_gap = gap_of(measured, nominal, all);
    found.steps.push_back({"different_binary", {}, {}, found.base_gap, found.base_gap, 0.99});
    found.notes.push_back(why);
    found.next_experiment = "measure the ELF that is predicted: the core is judged once the instructions are equal";
    return found;
}

// The micro-loops whose cycles a turn differ between the rule sets that fit: what a board would decide with.
std::string loops_that_part(const std::string& core, const std::vector<std::string>& sets, const PredictRows& predict) {
    std::vector<qemu::MeasuredCycles> rows;
    for (const qemu::SiliconLoop& loop : qemu::rival_loops()) {
        for (const std::uint32_t turns : {100U, 200U}) {
            rows.push_back({std::string(loop.name), "itcm", "dtcm", false, turns, 1.0, 0});
        }
    }
    std::vector<qemu::CoreVariant> variants;
    for (const std::string& set : sets) {
        variants.push_back({core, set});
    }
    const auto predicted = predict(rows, variants);
    std::string text;
    for (std::size_t i = 0; i < rows.size(); i += 2) {
        std::string turns;
        double least = std::numeric_limits<double>::infinity();
        double most = 0.0;
        for (std::size_t s = 0; s < sets.size(); ++s) {
            const double turn = (predicted[s][i + 1].nominal - predicted[s][i].nominal) / 100.0;
            least = std::min(least, turn);
            most = std::max(most, turn);
            turns += fmt::format("{}{} {:.2f}", turns.empty() ? "" : ", ", sets[s], turn);
        }
        if (most > 1.1 * least) {
            text += fmt::format("{}{} ({})", text.empty() ? "" : "; ", rows[i].kernel, turns);
        }
    }
    return "run these loops on the board with targets/nucleo-f746zg; cycles a turn under each rule set: " + text;
}

}  // namespace

std::string name_of_cores(const std::vector<std::string>& cores) {
    return fmt::format("{}", fmt::join(cores, " and "));
}

Question question_about(std::vector<qemu::MeasuredCycles> rows, const std::vector<std::string>& cores,
                        const std::filesystem::path& cores_folder) {
    Question question;
    question.rows = std::move(rows);
    question.base = name_of_cores(cores);
    question.base_off = names_of(timing::read_named_core(cores_folder, cores.front()).off);
    for (const std::string& core : cores) {
        if (names_of(timing::read_named_core(cores_folder, core).off) != question.base_off) {
            throw glsum::Failure(glsum::Exit::bad_input,
                                 fmt::format("{}: expected cores that pay for the same effects; --core names one for "
                                             "all rows",
                                             question.base));
        }
    }
    std::map<std::string, std::vector<std::string>> references{{question.base, cores}};
    question.references = {question.base};
    if (!question.base_off.empty()) {
        question.references = {"stm32h747-dtcm", "stm32f746-itcm"};
        references = {{"stm32h747-dtcm", {"stm32h747-dtcm"}}, {"stm32f746-itcm", {"stm32f746-itcm"}}};
    }
    // Sets that all cores of a reference have.
    for (const auto& [name, of] : references) {
        std::map<std::string, std::size_t> have;
        std::vector<timing::CoreFile> files;
        for (const std::string& core : of) {
            files.push_back(timing::read_named_core(cores_folder, core));
            for (const timing::RuleSet& set : files.back().sets) {
                ++have[set.name];
            }
        }
        for (const timing::RuleSet& set : files.front().sets) {
            if (have[set.name] == of.size()) {
                question.sets[name].push_back(set.name);
                if (set.fits) {
                    question.fitting[name].push_back(set.name);
                }
            }
        }
    }
    return question;
}

Explanation diagnose(const Question& question, const PredictRows& predict) {
    const auto as_it_is = predict(question.rows, {{question.base}}).front();
    if (const auto other = other_program(question.rows, as_it_is)) {
        return different_binary(question, as_it_is, *other);
    }
    Explanation found = explain(question, [&](const auto& variants) { return predict(question.rows, variants); });
    if (found.outcome == Outcome::ambiguous && found.next_experiment.empty()) {
        found.next_experiment = loops_that_part(found.reference, question.fitting.at(found.reference), predict);
    }
    return found;
}

}  // namespace gap::cycles
