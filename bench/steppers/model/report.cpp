#include "bench/steppers/model/report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/rounded_up.hpp"
#include "bench/steppers/model/stepped_q31.hpp"
#include "bench/steppers/stepper/json.hpp"

namespace generate {

std::vector<std::string> to_lines(const ModelChoice& choice) {
    const ModelSpec& spec = choice.spec;
    const double seconds = static_cast<double>(spec.samples) * spec.step_s;
    std::vector<std::string> lines = {
        fmt::format("{} with {}: as parts of the largest output{},", drive::realtime_name(spec.kernel(), spec.writing),
                    spec.memory.text(),
                    spec.input_full_scale ? fmt::format(", for inputs of {} of full scale", fixed_level) : ""),
        fmt::format("{} from the exact response to a unit step over {:g} s (the sampling alone: {});",
                    base::rounded_up(choice.errors.step), seconds, base::rounded_up(choice.scheme)),
        fmt::format("{} from the same scheme in double with full memory, for an input that jumps at random.",
                    base::rounded_up(choice.errors.random))};
    if (spec.memory.modes > 0) {
        lines.push_back(
            fmt::format("What its modes leave of the past is fed back with a loop gain of at most {}: stable as "
                        "the exact scheme is.",
                        base::rounded_up(choice.loop_gain)));
    }
    return lines;
}

std::string to_json(const ModelReport& report) {
    const ModelChoice& choice = report.choice;
    nlohmann::ordered_json json{{"schema", "glsum-model-1"},
                                {"model", report.model},
                                {"header", report.header},
                                {"sample_time_s", choice.spec.step_s},
                                {"format", choice.spec.format()},
                                {"max_error", report.max_error},
                                {"samples", choice.spec.samples},
                                {"kernel", drive::realtime_name(choice.spec.kernel(), choice.spec.writing)},
                                {"taps", choice.spec.memory.text()},
                                {"step_error", choice.errors.step},
                                {"sampling_error", choice.scheme},
                                {"random_error", choice.errors.random},
                                {"loop_gain", choice.loop_gain}};
    if (choice.spec.input_full_scale) {
        const FixedModel stepped(choice.spec, swing_of(choice.spec));
        json["input_full_scale"] = *choice.spec.input_full_scale;
        json["output_full_scale"] = stepped.output_full_scale();
        json["rounding_error"] = stepped.error();
    }
    add_checks(json, report.checked);
    if (report.cost) {
        json["core"] = report.core;
        json["cost"] = cost_json(*report.cost);
    }
    return json.dump(2) + "\n";
}

}  // namespace generate
