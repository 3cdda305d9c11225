#include "gap/drive/experiment.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "gap/drive/excitation.hpp"

namespace gap {
namespace {

// At rest before the record, nothing happening to it.
Candidate resting(const Study& study, const Candidate& fitted, const Record& record) {
    Candidate rest = fitted;
    rest.own.resize(1);
    rest.own[0] = state_of(study, record);
    if (study.base.refit) {
        const double offset = fitted.own[0][0].value;
        rest.own[0][0].value = offset;
        rest.own[0][1].lower = -1e300;
        rest.own[0][1].upper = 1e300;
        rest.own[0][1].value = offset;
    }
    for (const Effect* effect : fitted.effects) {
        for (const FreeParameter& parameter : own_parameters_of(*effect, study.scales)) {
            rest.own[0].push_back(parameter);
            rest.own[0].back().value = 0.0;
        }
    }
    return rest;
}

Record record_of(const Excitation& excitation, const Study& study, double low) {
    constexpr double most_samples = 3000.0;
    const Scales& scales = study.scales;
    Record record;
    record.name = excitation.text;
    record.usual_interval_s = std::max(scales.interval_s, excitation.length_s / most_samples);
    const auto count = static_cast<std::size_t>(excitation.length_s / record.usual_interval_s);
    for (std::size_t k = 0; k < count; ++k) {
        const double t = static_cast<double>(k) * record.usual_interval_s;
        record.time_s.push_back(t);
        record.input.push_back(low + (scales.input_max - low) * excitation.level(t / excitation.length_s, t));
    }
    record.output.assign(count, 0.0);
    // Further inputs rest where they were when the first record began: one thing is moved at a time.
    for (const std::vector<double>& levels : study.courses.front().record().more_inputs) {
        record.more_inputs.emplace_back(count, levels.front());
    }
    return record;
}

double lowest_input(const Study& study) {
    double low = 0.0;
    for (const Course& course : study.courses) {
        low = std::min(low, *std::min_element(course.record().input.begin(), course.record().input.end()));
    }
    return low;
}

// A record that could be taken.
struct Trial {
    std::string text;
    Record record;
    double released_at = 0.0;  ///< where nothing is put in: from here, in parts of the furthest that it has been
};

bool is_free(const Study& study) {
    return std::all_of(study.courses.begin(), study.courses.end(), [](const Course& course) {
        const std::vector<double>& input = course.record().input;
        return std::all_of(input.begin(), input.end(), [](double u) { return u == 0.0; });
    });
}

// Without an input it is let go, never from further out than it has been.
std::vector<Trial> releases(const Study& study) {
    const Scales& scales = study.scales;
    std::vector<Trial> trials;
    for (const auto& [text, part] :
         {std::pair("from as far out as it has been", 1.0), std::pair("from half as far out", 0.5),
          std::pair("from a fifth as far out", 0.2)}) {
        const Excitation nothing{fmt::format("let go {}, for {:.3g} s", text, scales.length_s), scales.length_s,
                                 [](double, double) { return 0.0; }};
        trials.push_back({nothing.text, record_of(nothing, study, 0.0), part});
    }
    return trials;
}

// Of 32 samples and more.
std::vector<Trial> trials_of(const Study& study) {
    const Scales& scales = study.scales;
    std::vector<Trial> trials;
    if (is_free(study)) {
        trials = releases(study);
    } else {
        const double low = lowest_input(study);
        for (const Excitation& excitation : excitations(scales.time_constant_s, scales.length_s)) {
            const double idle = study.base.idle_input;
            trials.push_back(
                {fmt::format("{} from {:.4g} to {:.4g}", excitation.text, low + idle, scales.input_max + idle),
                 record_of(excitation, study, low)});
        }
    }
    std::erase_if(trials, [](const Trial& trial) { return trial.record.size() < 32; });
    return trials;
}

// As it begins.
Candidate begun(const Study& study, const Candidate& fitted, const Trial& trial) {
    Candidate candidate = resting(study, fitted, trial.record);
    for (FreeParameter& parameter : candidate.own[0]) {
        if (parameter.name == "initial_output") {
            const double up = study.scales.output_high - parameter.value;
            const double down = study.scales.output_low - parameter.value;
            parameter.value += trial.released_at * (up > -down ? up : down);
        }
    }
    return candidate;
}

// What records tell of the numbers that all share (base, then lasting effects), each in units of its scale and over the
// readings' noise; the records' own numbers are fitted beside them.
struct Told {
    Eigen::MatrixXd information;
    double variance = 1.0;  ///< of the whitened residuals, at least 1: misfit makes intervals wide, too
};

std::optional<Told> told_by(const Study& study, Candidate candidate, const Whitener& whitener) {
    const auto all = [&](const Candidate& of) {
        std::vector<double> values;
        for (std::size_t r = 0; r < study.courses.size(); ++r) {
            std::vector<double> residuals = whitener.apply(residuals_of(study, of, r));
            for (std::size_t i = 0; i < residuals.size(); ++i) {
                values.push_back(study.counts[r][i] != 0 ? residuals[i] : 0.0);
            }
        }
        return values;
    };
    const std::vector<double> now = all(candidate);
    const auto rows = static_cast<Eigen::Index>(now.size());
    const std::vector<FreeParameter*> free = free_numbers(candidate, false);
    const auto own = static_cast<Eigen::Index>(free_numbers(candidate, true).size());
    const auto shared = static_cast<Eigen::Index>(free.size()) - own;
    Eigen::MatrixXd slopes(rows, shared + own);
    for (Eigen::Index p = 0; p < shared + own; ++p) {
        FreeParameter& parameter = *free[static_cast<std::size_t>(p)];
        const double value = parameter.value;
        constexpr double step = 3e-4;
        const double by = value + step * parameter.scale > parameter.upper ? -step : step;
        parameter.value = value + by * parameter.scale;
        const std::vector<double> moved = all(candidate);
        parameter.value = value;
        for (Eigen::Index i = 0; i < rows; ++i) {
            const auto at = static_cast<std::size_t>(i);
            slopes(i, p) = (moved[at] - now[at]) / by;
        }
    }
    if (!slopes.allFinite()) {
        return std::nullopt;
    }
    const Eigen::MatrixXd whole = slopes.transpose() * slopes;
    Told told{whole.topLeftCorner(shared, shared), 1.0};
    if (own > 0) {
        // What moves nothing here takes nothing from the others.
        Eigen::MatrixXd theirs = whole.bottomRightCorner(own, own);
        theirs.diagonal().array() += 1e-9 * theirs.trace() + 1e-300;
        told.information -=
            whole.topRightCorner(shared, own) * theirs.ldlt().solve(whole.bottomLeftCorner(own, shared));
    }
    double squares = 0.0;
    for (const double value : now) {
        squares += value * value;
    }
    told.variance = std::max(1.0, squares / static_cast<double>(std::max<Eigen::Index>(1, rows - shared - own)));
    return told;
}

// Standard deviations of the shared numbers in units of their scales. A number cannot be further off than its bounds.
std::vector<double> deviations_from(const Told& told, const Eigen::MatrixXd& information, Candidate candidate) {
    const std::vector<FreeParameter*> free = free_numbers(candidate, false);
    Eigen::MatrixXd known = information / told.variance;
    for (Eigen::Index p = 0; p < known.rows(); ++p) {
        const FreeParameter& parameter = *free[static_cast<std::size_t>(p)];
        const double half = 0.5 * (parameter.upper - parameter.lower) / parameter.scale;
        known(p, p) += 3.0 / (half * half);  // as of values that are spread evenly over them
    }
    const Eigen::MatrixXd inverse = known.ldlt().solve(Eigen::MatrixXd::Identity(known.rows(), known.rows()));
    std::vector<double> deviations;
    for (Eigen::Index p = 0; p < known.rows(); ++p) {
        deviations.push_back(std::sqrt(std::max(0.0, inverse(p, p))));
    }
    return deviations;
}

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

NextRecord drawn_of(const Study& study, const Trial& trial) {
    NextRecord drawn{trial.text, trial.record.time_s, trial.record.input, {}};
    for (double& u : drawn.input) {
        u += study.base.idle_input;
    }
    return drawn;
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
