#include "bench/steppers/controller/report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/steppers/controller/certificate.hpp"
#include "bench/steppers/controller/stepped_q31.hpp"
#include "bench/steppers/stepper/json.hpp"

namespace generate {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const SumOfController& sum, const char* kernel) {
    return {{"kernel", kernel}, {"order", sum.order}, {"taps", sum.taps}};
}

Json to_json(const LoopReport& loop) {
    const tune::Margins& margins = loop.margins;
    Json json{{"plant", loop.plant},
              {"deviation", loop.deviation.header},
              {"sampling_error", loop.deviation.sampling},
              {"unstable_poles", margins.unstable_poles}};
    if (std::isfinite(margins.gain)) {
        json["gain_margin"] = margins.gain;
        json["phase_crossover_rad_s"] = margins.phase_crossover;
    }
    if (margins.crossings > 0) {
        json["phase_margin_deg"] = margins.phase_deg;
        json["crossover_rad_s"] = margins.crossover;
    }
    json["sensitivity"] = margins.sensitivity;
    json["sensitivity_rad_s"] = margins.sensitivity_at;
    json["complementary_sensitivity"] = margins.complementary;
    return json;
}

}  // namespace

std::string cost_table(const ControllerReport& report) {
    if (!report.cost) {
        return "";
    }
    std::vector<std::pair<std::string, StepCost>> rows{{report.controller, *report.cost}};
    if (report.whole) {
        rows.emplace_back("integer PID, the same gains", *report.whole);
    }
    return cost_table(rows, report.core);
}

std::vector<std::string> to_lines(const LoopReport& loop, const ControllerSpec& spec) {
    const double level = first_level(spec);
    return {fmt::format("In a loop with {}, {} samples, the set point {:g}, then {:g}:", loop.plant_text, spec.horizon,
                        level, second_level * level),
            fmt::format("within {:.2g} of the same loop in double with full memory, as a part of the largest output;",
                        loop.deviation.header),
            fmt::format("the sampling's own error, by halving the step: {:.2g}.", loop.deviation.sampling),
            "The sampled loop, hold and dead time in it, is stable by the argument principle where no limit is met;",
            "its controller is taken with tables and gains as they are written here:",
            margins_text(loop.margins) + "."};
}

std::string to_json(const ControllerReport& report, const ControllerSpec& spec) {
    Json json{{"schema", "glsum-controller-1"}, {"controller", report.controller}, {"header", report.header}};
    json["sample_time_s"] = spec.controller.sample_time_s;
    json["format"] = spec.format();
    if (spec.input_full_scale) {
        const FixedController stepped(spec);
        json["input_full_scale"] = stepped.numbers().input_full_scale;
        json["output_full_scale"] = stepped.numbers().output_full_scale;
        json["rounding_error"] = stepped.error().direct;
        json["rounding_error_per_sample"] = stepped.error().per_sample;
    }
    json["max_error"] = spec.max_error;
    json["samples"] = spec.horizon;
    json["integral"] = to_json(integral_sum(spec), integral_kernel(spec));
    if (spec.controller.gains.kd != 0.0) {
        json["derivative"] = to_json(derivative_sum(spec), derivative_kernel(spec));
    }
    if (report.loop) {
        json["loop"] = to_json(*report.loop);
    }
    add_checks(json, report.checked);
    if (report.cost) {
        json["core"] = report.core;
        json["cost"] = cost_json(*report.cost);
    }
    if (report.whole) {
        json["cost_of_integer_pid"] = cost_json(*report.whole);
    }
    return json.dump(2) + "\n";
}

}  // namespace generate
