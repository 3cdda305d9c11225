#include "cli/form_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/failure.hpp"
#include "cli/name_value.hpp"

namespace cli {
namespace {

using glsum::Exit;
using glsum::Failure;

double number_in(const std::string& text, const std::string& option) {
    const auto value = to_number<double>(text);
    if (!value || !std::isfinite(*value)) {
        throw Failure(Exit::bad_input, fmt::format("{}: expected a finite number, found '{}'", option, text));
    }
    return *value;
}

}  // namespace

void add_form_options(Command& command, FormOptions& options) {
    command.add_option("--fix", options.fix, "NAME or NAME=VALUE: a parameter that is not fitted").delimiter(',');
    command.add_option("--free", options.free, "NAME: fit a parameter that usually is fixed, such as offset")
        .delimiter(',');
    command.add_option("--set", options.set, "NAME=VALUE: its start").delimiter(',');
    command.add_option("--bound", options.bounds, "NAME=LOW:HIGH").delimiter(',');
}

void apply(const FormOptions& options, drive::Form& form) {
    for (const std::string& word : options.set) {
        const auto [name, value] = split_at_equals(word);
        form.parameter(name).value = number_in(value, "--set " + name);
    }
    for (const std::string& word : options.fix) {
        const auto [name, value] = split_at_equals(word);
        drive::Parameter& parameter = form.parameter(name);
        parameter.fixed = true;
        if (!value.empty()) {
            parameter.value = number_in(value, "--fix " + name);
        }
    }
    for (const std::string& name : options.free) {
        form.parameter(name).fixed = false;
    }
    for (const std::string& word : options.bounds) {
        const auto [name, range] = split_at_equals(word);
        const auto colon = range.find(':');
        if (colon == std::string::npos) {
            throw Failure(Exit::bad_input, fmt::format("--bound: expected NAME=LOW:HIGH, found {}", word));
        }
        drive::Parameter& parameter = form.parameter(name);
        parameter.lower = number_in(range.substr(0, colon), "--bound " + name);
        parameter.upper = number_in(range.substr(colon + 1), "--bound " + name);
        if (!(parameter.lower < parameter.upper)) {
            throw Failure(Exit::bad_input,
                          fmt::format("--bound {}: expected the lower bound below the upper, found {}", name, range));
        }
        parameter.value = std::clamp(parameter.value, parameter.lower, parameter.upper);
        parameter.bounds_are_given = true;
    }
}

}  // namespace cli
