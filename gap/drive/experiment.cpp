#include "gap/drive/experiment.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "gap/drive/information.hpp"
#include "gap/drive/trials.hpp"

namespace gap {
namespace {

// What an excitation would tell, and what is simulated there.
struct After {
    Told told;
    std::vector<double> output;
};

// Nothing where the rig would go far beyond where it has been.
std::optional<After> told_after(const Study& study, const Candidate& named, const Whitener& whitener,
                                const Trial& trial) {
    const Record& record = trial.record;
    Study then{study.base, study.scales, {}, all_count({record}), study.noise, study.least_deviation, 0};
    if (study.horizon > 0) {
        const double horizon_s = static_cast<double>(study.horizon) * study.scales.interval_s;
        then.horizon =
            std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(horizon_s / record.usual_interval_s)));
    }
    then.courses.emplace_back(record, 1);
    const Candidate start = begun(then, named, trial);
    const double beyond = 0.5 * study.scales.output_span;
    std::vector<double> output = simulate(scenario_of(then, start, 0), then.courses[0]);
    for (const double z : output) {
        if (!(z > study.scales.output_low - beyond && z < study.scales.output_high + beyond)) {
            return std::nullopt;
        }
    }
    std::optional<Told> told = told_by(then, start, whitener);
    return told ? std::optional(After{std::move(*told), std::move(output)}) : std::nullopt;
}

// What a simulation reads where `left` is what a record's output has over it.
std::vector<double> read_off(std::vector<double> output, const std::vector<double>& left) {
    for (std::size_t i = 0; i < output.size() && i < left.size(); ++i) {
        output[i] -= left[i];
    }
    return output;
}

// By how much a number's interval shrinks.
struct Narrower {
    const FreeParameter* number;
    double factor;
    double before;  ///< standard deviations
    double after;
};

std::string to_text(std::vector<Narrower> all) {
    std::stable_sort(all.begin(), all.end(), [](const Narrower& a, const Narrower& b) { return a.factor > b.factor; });
    constexpr double of_95_percent = 1.96;
    constexpr double visible = 1.1;
    std::vector<std::string> words;
    for (const Narrower& one : all) {
        words.push_back(one.factor < visible
                            ? fmt::format("no narrower for {}", one.number->name)
                            : fmt::format("{:.3g} times narrower for {} (within {:.2g} instead of {:.2g})", one.factor,
                                          one.number->name, of_95_percent * one.after, of_95_percent * one.before));
    }
    return fmt::format("{}", fmt::join(words, ", "));
}

const char* const other_record = "a record at other levels and speeds, as a test of the size found here";
const char* const same_record =
    "the same record once more: what comes again at the same place is no event from outside";

}  // namespace

Proposal part(const Study& study, const std::vector<const Candidate*>& alternatives, double noise) {
    for (const Candidate* alternative : alternatives) {
        if (alternative->event_parameters() > 0) {
            return {same_record};
        }
    }
    constexpr std::size_t most_alternatives = 5;
    Proposal best{"", -1.0};
    std::string hardest;
    for (const Trial& trial : trials_of(study)) {
        Record record = trial.record;
        Study then{study.base, study.scales, {}, all_count({record}), study.noise, study.least_deviation, 0};
        then.courses.emplace_back(record, 1);
        const Candidate truth = begun(then, *alternatives.front(), trial);
        record.output = simulate(scenario_of(then, truth, 0), then.courses[0]);
        if (!std::all_of(record.output.begin(), record.output.end(), [](double z) { return std::isfinite(z); })) {
            continue;
        }
        double nearest = std::numeric_limits<double>::infinity();
        std::string which;
        NextRecord next = drawn_of(study, trial);
        next.outputs.emplace_back(alternatives.front()->name(), record.output);
        for (std::size_t i = 1; i < std::min(alternatives.size(), most_alternatives); ++i) {
            const Candidate start = begun(then, *alternatives[i], trial);
            const Candidate refitted = fit(then, alternatives[i]->effects, start, nullptr, {6, 1, 12});
            const std::vector<std::vector<double>> left = all_residuals(then, refitted);
            const double apart = rms_of(then, left) / noise;
            next.outputs.emplace_back(alternatives[i]->name() + ", refitted", read_off(record.output, left.front()));
            if (apart < nearest) {
                nearest = apart;
                which = alternatives[i]->name();
            }
        }
        // Where the others run away, however they are refitted, nothing was simulated that would tell how far apart.
        if (std::isfinite(nearest) && nearest > best.apart) {
            best = {trial.text, nearest, std::move(next)};
            hardest = which;
        }
    }
    if (best.text.empty()) {
        return {other_record};
    }
    constexpr double visible = 0.3;
    if (best.apart < visible) {
        return {fmt::format(
                    "no input parts them: of the excitations simulated, the best ({}) leaves {} within {:.2g} of the "
                    "noise of {} once refitted. Log a signal between command and reading (motor speed, current, "
                    "supply), or measure one part alone",
                    best.text, hardest, std::max(0.0, best.apart), alternatives.front()->name()),
                best.apart,
                {}};
    }
    return {fmt::format("{}: simulated, {} once refitted to {} still misses it by {:.2g} times the "
                        "noise, and the others by more",
                        best.text, hardest, alternatives.front()->name(), best.apart),
            best.apart, std::move(best.record)};
}

Proposal sharpen(const Study& study, const Candidate& named, const Whitener& whitener) {
    if (named.event_parameters() > 0) {
        return {same_record};
    }
    Candidate fitted = named;
    const std::vector<FreeParameter*> free = free_numbers(fitted, false);
    std::vector<std::size_t> mine;  // those of the lasting effects
    for (std::size_t p = 0; p < free.size() - free_numbers(fitted, true).size(); ++p) {
        if (free[p]->name.find('.') != std::string::npos) {
            mine.push_back(p);
        }
    }
    const std::optional<Told> now = mine.empty() ? std::nullopt : told_by(study, named, whitener);
    if (!now) {
        return {other_record};
    }
    const std::vector<double> before = deviations_from(*now, now->information, named);
    constexpr double worth_it = 1.2;
    double best = worth_it;
    Proposal proposal{other_record};
    for (const Trial& trial : trials_of(study)) {
        std::optional<After> then = told_after(study, named, whitener, trial);
        if (!then) {
            continue;
        }
        const std::vector<double> after = deviations_from(*now, now->information + then->told.information, named);
        double factor = 1.0;
        std::vector<Narrower> all;
        for (const std::size_t p : mine) {
            const double ratio = after[p] > 0.0 ? before[p] / after[p] : 1.0;
            factor *= std::pow(ratio, 1.0 / static_cast<double>(mine.size()));
            all.push_back({free[p], ratio, before[p] * free[p]->scale, after[p] * free[p]->scale});
        }
        if (factor > best) {
            best = factor;
            proposal.text = fmt::format("{}, beside what there is: {}; by the slopes of what is simulated", trial.text,
                                        to_text(all));
            proposal.record = drawn_of(study, trial);
            proposal.record->outputs.emplace_back(named.name(), then->output);
        }
    }
    return proposal;
}

Proposal next_experiment(const Finding& finding) {
    const std::string lacking = fmt::format("train on records that have these, too, as validation has: {}",
                                            fmt::join(finding.extrapolated, "; "));
    switch (finding.outcome) {
        case Outcome::no_gap:
            return {finding.extrapolated.empty()
                        ? "none for this gap; another operating profile would tell whether the model holds there"
                        : fmt::format("none for this gap, though validation alone has these: {}",
                                      fmt::join(finding.extrapolated, "; "))};
        case Outcome::attributed: {
            Proposal sharper = sharpen(finding.study, *finding.named.front(), finding.whitener);
            sharper.text = (finding.extrapolated.empty() ? "" : lacking + ". Then ") + sharper.text;
            return sharper;
        }
        case Outcome::ambiguous:
            return part(finding.study, finding.named, finding.noise);
        case Outcome::unknown:
            break;
    }
    if (!finding.extrapolated.empty()) {
        return {lacking + ". Training never went there, so that whatever is fitted is a guess there"};
    }
    return {
        finding.input_levels <= 3
            ? "a staircase up and down with at least 5 levels, then a pseudo-random sequence about one of them: the "
              "first shows what depends on level and direction, the second what depends on frequency"
            : "the same record twice more: what repeats is of the drive, what does not came from outside; and one "
              "more signal (speed, current, supply) at the same time"};
}

}  // namespace gap
