#include "gap/drive/improved.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/failure.hpp"
#include "gap/drive/effect.hpp"
#include "gap/drive/simulate.hpp"

namespace gap {
namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse(const std::string& what) { throw glsum::Failure(glsum::Exit::bad_input, what); }

Contracted contracted_of(const Json& parameters, const std::string& name) {
    Contracted contracted;
    for (const auto& [key, value] : parameters.items()) {
        if (value.is_number()) {
            contracted[key] = value.get<double>();
        } else if (value.is_string()) {
            contracted[key] = value.get<std::string>();
        } else if (value.is_array() &&
                   std::all_of(value.begin(), value.end(), [](const Json& one) { return one.is_number(); })) {
            contracted[key] = value.get<std::vector<double>>();
        } else {
            refuse(fmt::format("{}: effects: {}: expected a number, a word or a list of numbers, found {}", name, key,
                               value.dump().substr(0, 60)));
        }
    }
    return contracted;
}

double number_or_zero(const Json& notes, const char* field, const std::string& name) {
    if (!notes.contains(field)) {
        return 0.0;
    }
    if (!notes[field].is_number()) {
        refuse(fmt::format("{}: {}: expected a number", name, field));
    }
    return notes[field].get<double>();
}

std::vector<double> values_of(const Effect& effect, const Json& parameters, const std::string& name) {
    const Contracted contracted = contracted_of(parameters, name);
    try {
        return effect.from_contract(effect, contracted);
    } catch (const glsum::Failure& failure) {
        refuse(fmt::format("{}: effects: {}", name, failure.what()));
    }
}

}  // namespace

Improved simulate_improved(const drive::Model& model, Record record, const std::string& name) {
    Improved result;
    const Json notes = model.notes.empty() ? Json::object() : Json::parse(model.notes);
    if (!notes.contains("effects")) {
        return result;
    }
    if (!notes["effects"].is_array()) {
        refuse(fmt::format("{}: effects: expected an array", name));
    }
    if (notes["effects"].empty() && !notes.contains("operating_output") && !notes.contains("idle_input")) {
        return result;
    }
    Scenario scenario;
    scenario.model = model;
    scenario.operating_output = number_or_zero(notes, "operating_output", name);
    Scenario plain = scenario;
    for (const Json& one : notes["effects"]) {
        if (!one.is_object() || !one.contains("effect") || !one["effect"].is_string() || !one.contains("parameters") ||
            !one["parameters"].is_object()) {
            refuse(fmt::format("{}: effects: expected {{\"effect\", \"parameters\"}}, found {}", name,
                               one.dump().substr(0, 60)));
        }
        const Effect& effect = effect_named(one["effect"].get<std::string>());
        effect.add_to(scenario, values_of(effect, one["parameters"], name));
        result.effects.push_back(effect.name);
    }
    const double idle_input = number_or_zero(notes, "idle_input", name);
    for (double& u : record.input) {
        u -= idle_input;
    }
    const auto [low, high] = std::minmax_element(record.input.begin(), record.input.end());
    const double size = std::max(std::abs(*low), std::abs(*high)) * std::abs(model.gain);
    result.output = simulate(scenario, make_course(record, plain, 1e-5 * std::max(size, 1e-300)));
    return result;
}

}  // namespace gap
