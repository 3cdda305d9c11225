#include "gap/drive/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace gap {
namespace {

struct Excitation {
    std::string text;
    double length_s;
    std::function<double(double share, double time_s)> level;  ///< of the record's length; in 0 to 1
};

std::vector<Excitation> excitations(double time_constant_s, double record_s) {
    const double hold_s = 5.0 * time_constant_s;
    const double bit_s = 0.3 * time_constant_s;
    return {
        {fmt::format("a staircase of 5 levels up and down, {:.3g} s each", hold_s), 10.0 * hold_s,
         [](double share, double) {
             return (std::min(std::floor(share * 10.0), 9.0 - std::floor(share * 10.0)) + 1.0) / 5.0;
         }},
        {fmt::format("a pseudo-random sequence of bits of {:.3g} s between two fifths and four fifths", bit_s),
         60.0 * time_constant_s,
         [bit_s](double, double time_s) {
             const auto bit = static_cast<std::uint64_t>(time_s / bit_s) * 0x9E3779B97F4A7C15U;
             return (bit >> 40U) % 2 == 0 ? 0.4 : 0.8;
         }},
        {fmt::format("a sine swept from {:.3g} to {:.3g} Hz", 0.02 / time_constant_s, 1.0 / time_constant_s),
         60.0 * time_constant_s,
         [time_constant_s](double share, double) {
             const double octaves = std::log(50.0);
             const double turns = 0.02 * 60.0 / octaves * std::expm1(octaves * share);
             return 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * turns);
         }},
        {fmt::format("three pulses of a third, two thirds and all, {:.3g} s on and off", hold_s), 6.0 * hold_s,
         [](double share, double) {
             const int part = std::min(5, static_cast<int>(share * 6.0));
             return part % 2 == 0 ? static_cast<double>(part / 2 + 1) / 3.0 : 0.0;
         }},
        {fmt::format("three fifths, held for {:.3g} s", 3.0 * record_s), 3.0 * record_s,
         [](double, double) { return 0.6; }},
    };
}

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
        if (effect->kind == Kind::event) {
            for (const FreeParameter& parameter : parameters_of(*effect, study.scales, 0)) {
                rest.own[0].push_back(parameter);
                rest.own[0].back().value = 0.0;
            }
        }
    }
    return rest;
}

Record record_of(const Excitation& excitation, const Scales& scales, double low) {
    constexpr double most_samples = 3000.0;
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
    return record;
}

double lowest_input(const Study& study) {
    double low = 0.0;
    for (const Course& course : study.courses) {
        low = std::min(low, *std::min_element(course.record().input.begin(), course.record().input.end()));
    }
    return low;
}

}  // namespace

Proposal part(const Study& study, const std::vector<const Candidate*>& alternatives, double noise) {
    for (const Candidate* alternative : alternatives) {
        if (alternative->event_parameters() > 0) {
            return {"the same record once more: what comes again at the same place is no event from outside", 0.0};
        }
    }
    constexpr std::size_t most_alternatives = 5;
    Proposal best{"", -1.0};
    std::string hardest;
    const double low = lowest_input(study);
    const double record_s = study.scales.length_s;
    for (const Excitation& excitation : excitations(study.scales.time_constant_s, record_s)) {
        Record record = record_of(excitation, study.scales, low);
        if (record.size() < 32) {
            continue;
        }
        Study trial{study.base, study.scales, {}, all_count({record}), study.noise, study.least_deviation, 0};
        trial.courses.emplace_back(record, 1);
        const Candidate truth = resting(trial, *alternatives.front(), record);
        record.output = simulate(scenario_of(trial, truth, 0), trial.courses[0]);
        if (!std::all_of(record.output.begin(), record.output.end(), [](double z) { return std::isfinite(z); })) {
            continue;
        }
        double nearest = std::numeric_limits<double>::infinity();
        std::string which;
        for (std::size_t i = 1; i < std::min(alternatives.size(), most_alternatives); ++i) {
            Candidate start = resting(trial, *alternatives[i], record);
            const Candidate refitted = fit(trial, alternatives[i]->effects, start, nullptr, {6, 1, 12});
            const double apart = rms_of(trial, all_residuals(trial, refitted)) / noise;
            if (apart < nearest) {
                nearest = apart;
                which = alternatives[i]->name();
            }
        }
        if (nearest > best.apart) {
            best = {excitation.text, nearest};
            hardest = which;
        }
    }
    constexpr double visible = 0.3;
    if (best.apart < visible) {
        return {fmt::format(
                    "no input parts them: of five excitations simulated, the best ({}) leaves {} within {:.2g} of the "
                    "noise of {} once refitted. Log a signal between command and reading (motor speed, current, "
                    "supply), or measure one part alone",
                    best.text, hardest, std::max(0.0, best.apart), alternatives.front()->name()),
                best.apart};
    }
    return {
        fmt::format("{} from {:.4g} to {:.4g}: simulated, {} once refitted to {} still misses it by {:.2g} times the "
                    "noise, and the others by more",
                    best.text, low, study.scales.input_max, hardest, alternatives.front()->name(), best.apart),
        best.apart};
}

}  // namespace gap
