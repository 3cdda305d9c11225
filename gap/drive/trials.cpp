#include "gap/drive/trials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

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

}  // namespace

std::vector<Trial> trials_of(const Study& study) {
    const Scales& scales = study.scales;
    std::vector<Trial> trials;
    if (!scales.driven) {
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

NextRecord drawn_of(const Study& study, const Trial& trial) {
    NextRecord drawn{trial.text, trial.record.time_s, trial.record.input, {}};
    for (double& u : drawn.input) {
        u += study.base.idle_input;
    }
    return drawn;
}

}  // namespace gap
