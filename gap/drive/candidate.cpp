#include "gap/drive/candidate.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "gap/drive/released.hpp"

namespace gap {
namespace {

FreeParameter to_free(const std::string& name, double value, double lower, double upper, double scale) {
    return {name, std::clamp(value, lower, upper), lower, upper, scale};
}

bool is_fitted(const drive::Parameter& parameter) { return !parameter.fixed && parameter.name != "offset"; }

std::size_t free_count(const std::vector<FreeParameter>& list) {
    return static_cast<std::size_t>(
        std::count_if(list.begin(), list.end(), [](const FreeParameter& parameter) { return !parameter.fixed; }));
}

// Those of all records, and those that a record has for itself. \param lasting  null: of an event
std::vector<double> values_in(const std::vector<FreeParameter>& own, const Effect& effect,
                              const std::vector<FreeParameter>* lasting) {
    std::vector<double> values = lasting != nullptr ? values_of(*lasting) : std::vector<double>();
    for (const FreeParameter& parameter : own) {
        if (!parameter.name.starts_with(effect.name + ".")) {
            continue;
        }
        if (lasting == nullptr) {
            values.push_back(parameter.value);
            continue;
        }
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = (*lasting)[i].name == parameter.name ? parameter.value : values[i];
        }
    }
    return values;
}

}  // namespace

std::vector<double> values_of(const std::vector<FreeParameter>& numbers) {
    std::vector<double> values;
    std::ranges::transform(numbers, std::back_inserter(values), &FreeParameter::value);
    return values;
}

std::string Candidate::name() const {
    std::string joined;
    for (const Effect* effect : effects) {
        joined += (joined.empty() ? "" : " + ") + effect->name;
    }
    return joined.empty() ? "none" : joined;
}

bool Candidate::has(const std::string& effect) const {
    return std::any_of(effects.begin(), effects.end(), [&](const Effect* mine) { return mine->name == effect; });
}

bool Candidate::any(bool Effect::*trait) const {
    return std::any_of(effects.begin(), effects.end(), [&](const Effect* mine) { return mine->*trait; });
}

bool Candidate::has_events() const {
    return std::any_of(effects.begin(), effects.end(),
                       [](const Effect* effect) { return effect->kind == Kind::event; });
}

const std::vector<FreeParameter>* Candidate::numbers_of(const Effect* effect) const {
    std::size_t at = 0;
    for (const Effect* mine : effects) {
        if (mine == effect && mine->kind == Kind::lasting) {
            return &lasting[at];
        }
        at += mine->kind == Kind::lasting ? 1 : 0;
    }
    return nullptr;
}

std::optional<Special> Candidate::only(const Effect* effect) const {
    const std::vector<FreeParameter>* numbers = numbers_of(effect);
    if (numbers == nullptr || effect->is_only == nullptr) {
        return std::nullopt;
    }
    return effect->is_only(values_of(*numbers));
}

std::size_t Candidate::effect_parameters() const {
    const std::size_t of_events = event_parameters();
    return effect_parameters_in_all() - of_events + (own.empty() ? 0 : of_events / own.size());
}

std::size_t Candidate::effect_parameters_in_all() const {
    std::size_t count = event_parameters();
    for (const auto& list : lasting) {
        count += free_count(list);
    }
    return count;
}

std::size_t Candidate::event_parameters() const {
    std::size_t count = 0;
    for (const auto& list : own) {
        for (const FreeParameter& parameter : list) {
            count += !parameter.fixed && parameter.name.find('.') != std::string::npos ? 1 : 0;
        }
    }
    return count;
}

std::vector<FreeParameter> base_of(const Study& study) {
    std::vector<FreeParameter> free;
    if (!study.base.refit) {
        return free;
    }
    for (const drive::Parameter& parameter : study.base.form.parameters()) {
        if (!is_fitted(parameter)) {
            continue;
        }
        const bool delay = parameter.name == "delay_s";
        const double size = parameter.value != 0.0 ? std::fabs(parameter.value) : 1e-3;
        // Far enough to reach any sensible value, not so far that a step leaves all sense. A dead time of a large part
        // of the record is told by little of it: of what is bent or drifts it makes anything.
        const double lower =
            delay ? std::max(0.0, parameter.lower) : std::max(parameter.lower, parameter.value - 30.0 * size);
        const double upper = delay ? std::min(parameter.upper, 0.2 * study.scales.length_s)
                                   : std::min(parameter.upper, parameter.value + 30.0 * size);
        const double scale = delay ? std::max(size, study.scales.time_constant_s) : size;
        free.push_back(to_free(parameter.name, parameter.value, lower, std::max(upper, lower + 1e-9), scale));
    }
    return free;
}

drive::Form with_values(const drive::Form& form, const Candidate& candidate) {
    drive::Form filled = form;
    for (drive::Parameter& parameter : filled.parameters()) {
        const auto mine = std::find_if(candidate.base.begin(), candidate.base.end(),
                                       [&](const FreeParameter& free) { return free.name == parameter.name; });
        parameter.value = mine == candidate.base.end() ? parameter.value : mine->value;
    }
    return filled;
}

// Where nothing was put in at first and the readings stayed, they are the operating point: an effect must not hide in a
// free one.
struct Rest {
    double level;
    double known_to;
};

std::optional<Rest> rest_of(const Study& study, const Record& record) {
    constexpr std::size_t enough = 8;
    std::size_t count = 0;
    while (count < record.size() && record.input[count] == 0.0) {
        ++count;
    }
    if (!study.scales.steady || count < enough || count == record.size()) {
        return std::nullopt;
    }
    const auto [low, high] =
        std::minmax_element(record.output.begin(), record.output.begin() + static_cast<std::ptrdiff_t>(count));
    const double noise = std::max(study.noise, study.least_deviation);
    if (*high - *low > 8.0 * noise + study.scales.quantum) {
        return std::nullopt;
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        sum += record.output[i];
    }
    const auto number = static_cast<double>(count);
    return Rest{sum / number, std::max(3.0 * noise / std::sqrt(number), 0.5 * study.scales.quantum)};
}

std::vector<FreeParameter> state_of(const Study& study, const Record& record) {
    if (!study.base.refit) {
        return {};
    }
    const double span = study.scales.output_span;
    const double first = record.output.front();
    const double speed = study.scales.speed_max;
    const double far = 1e3 * span + std::fabs(first);
    const double force = study.scales.force;
    // Where it would rest without input; what does not rest has a force in its place, a ramp of its own in each record.
    const double rests_at = !study.scales.driven ? level_at_rest(record) : record.input.front() == 0.0 ? first : 0.0;
    std::vector<FreeParameter> state = {
        study.scales.steady ? to_free("offset", rests_at, -far, far, span)
                            : to_free("bias", 0.0, -force, force, 0.1 * force),
        to_free("initial_output", first, first - 3.0 * span, first + 3.0 * span, span),
        to_free("initial_velocity", 0.0, -3.0 * speed, 3.0 * speed, speed),
        to_free("input_before",
                study.base.from_no_input
                    ? 0.0
                    : std::clamp(record.input.front(), -study.scales.input_max, study.scales.input_max),
                -study.scales.input_max, study.scales.input_max, std::max(study.scales.input_max, 1e-300))};
    state[3].fixed = !study.scales.driven;
    if (const auto rest = rest_of(study, record)) {
        for (const std::size_t i : {0, 1}) {
            state[i] =
                to_free(state[i].name, rest->level, rest->level - rest->known_to, rest->level + rest->known_to, span);
        }
        state[2].fixed = state[3].fixed = true;
    }
    return state;
}

std::vector<FreeParameter> parameters_of(const Effect& effect, const Scales& scales, std::size_t start) {
    std::vector<FreeParameter> all;
    for (const EffectParameter& parameter : effect.parameters(scales)) {
        const double value = parameter.starts[start % parameter.starts.size()];
        all.push_back(to_free(effect.name + "." + parameter.name, value, parameter.lower, parameter.upper,
                              std::max(std::fabs(value - parameter.none), 0.02 * (parameter.upper - parameter.lower))));
        all.back().fixed = parameter.discrete || start >= parameter.free_starts ||
                           (parameter.of_record && effect.kind == Kind::lasting);
        all.back().unit = parameter.unit;
    }
    return all;
}

std::vector<FreeParameter> own_parameters_of(const Effect& effect, const Scales& scales) {
    const std::vector<FreeParameter> all = parameters_of(effect, scales, 0);
    if (effect.kind == Kind::event) {
        return all;
    }
    std::vector<FreeParameter> own;
    const std::vector<EffectParameter> named = effect.parameters(scales);
    for (std::size_t i = 0; i < named.size(); ++i) {
        if (named[i].of_record) {
            own.push_back(all[i]);
            own.back().fixed = named[i].discrete;
        }
    }
    return own;
}

std::size_t starts_of(const Effect& effect, const Scales& scales) {
    std::size_t most = 1;
    for (const EffectParameter& parameter : effect.parameters(scales)) {
        most = std::max(most, parameter.of_record ? 1 : parameter.starts.size());
    }
    return most;
}

bool applies(const Effect& effect, const Scales& scales) { return !effect.parameters(scales).empty(); }

std::vector<FreeParameter*> free_numbers(Candidate& candidate, bool own_only) {
    std::vector<FreeParameter*> all;
    const auto add = [&](std::vector<FreeParameter>& list) {
        for (FreeParameter& parameter : list) {
            if (!parameter.fixed) {
                all.push_back(&parameter);
            }
        }
    };
    if (!own_only) {
        add(candidate.base);
        for (auto& list : candidate.lasting) {
            add(list);
        }
    }
    for (auto& list : candidate.own) {
        add(list);
    }
    return all;
}

Scenario scenario_of(const Study& study, const Candidate& candidate, std::size_t record) {
    std::vector<double> values;
    const FreeParameter* next_base = candidate.base.data();
    for (const drive::Parameter& parameter : study.base.form.parameters()) {
        values.push_back(study.base.refit && is_fitted(parameter) ? (next_base++)->value : parameter.value);
    }
    Scenario scenario;
    scenario.model = study.base.form.to_model(values);
    const FreeParameter* own = candidate.own[record].data();
    scenario.operating_output = study.base.operating_output;
    if (study.base.refit) {
        (study.scales.steady ? scenario.operating_output : scenario.forces.bias) = (own++)->value;
        // The first reading is where it rests, whatever the operating point is.
        scenario.initial_output = (own++)->value - scenario.operating_output;
        scenario.initial_velocity = (own++)->value;
        scenario.input_before = (own++)->value;
    }
    std::size_t next_lasting = 0;
    for (const Effect* effect : candidate.effects) {
        const std::vector<FreeParameter>* lasting =
            effect->kind == Kind::lasting ? &candidate.lasting[next_lasting++] : nullptr;
        effect->add_to(scenario, values_in(candidate.own[record], *effect, lasting));
    }
    return scenario;
}

std::vector<double> residuals_of(const Study& study, const Candidate& candidate, std::size_t record) {
    const Course& course = study.courses[record];
    std::vector<double> residuals = simulate(scenario_of(study, candidate, record), course);
    for (std::size_t i = 0; i < residuals.size(); ++i) {
        residuals[i] = course.record().output[i] - residuals[i];
    }
    if (study.horizon > 0) {
        // The simulation goes on from the reading a horizon ago: what it missed until then is no longer missed.
        for (std::size_t i = residuals.size(); i-- > 0;) {
            residuals[i] -= residuals[i > study.horizon ? i - study.horizon : 0];
        }
    }
    return residuals;
}

std::vector<std::vector<double>> all_residuals(const Study& study, const Candidate& candidate) {
    std::vector<std::vector<double>> all;
    for (std::size_t r = 0; r < study.courses.size(); ++r) {
        all.push_back(residuals_of(study, candidate, r));
    }
    return all;
}

}  // namespace gap
