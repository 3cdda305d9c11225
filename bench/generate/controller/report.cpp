#include "bench/generate/controller/report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/generate/controller/certificate.hpp"

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

Json to_json(const ControllerCost& cost) {
    return {{"model_cycles", cost.cycles},       {"model_cycles_low", cost.low},    {"model_cycles_high", cost.high},
            {"instructions", cost.instructions}, {"state_bytes", cost.state_bytes}, {"table_bytes", cost.table_bytes},
            {"code_bytes", cost.code_bytes}};
}

std::string row(const std::string& name, const ControllerCost& cost) {
    return fmt::format("  {:<28} {:>8.1f} {:>17} {:>13.1f} {:>7} {:>7} {:>7}\n", name, cost.cycles,
                       fmt::format("{:.1f} to {:.1f}", cost.low, cost.high), cost.instructions, cost.state_bytes,
                       cost.table_bytes, cost.code_bytes);
}

}  // namespace

std::string cost_table(const ControllerReport& report) {
    if (!report.cost) {
        return "";
    }
    const std::string text = fmt::format("\n  {:<28} {:>8} {:>17} {:>13} {:>7} {:>7} {:>7}\n", "", "cycles", "band",
                                         "instructions", "state", "tables", "code");
    return text + row(report.controller, *report.cost) +
           (report.whole ? row("integer PID, the same gains", *report.whole) : "") +
           fmt::format(
               "\n  a step within its limits on the emulated Cortex-M7; cycles of the timing model for {}; bytes of an "
               "instance,\n  of the tables and of the step's code\n",
               report.core);
}

std::vector<std::string> to_lines(const LoopReport& loop, std::size_t samples) {
    return {fmt::format("In a loop with {}, {} samples, the set point 1, then 0.4:", loop.plant_text, samples),
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
    json["max_error"] = spec.max_error;
    json["samples"] = spec.horizon;
    json["integral"] = to_json(integral_sum(spec), integral_kernel);
    if (spec.controller.gains.kd != 0.0) {
        json["derivative"] = to_json(derivative_sum(spec), derivative_kernel);
    }
    if (report.loop) {
        json["loop"] = to_json(*report.loop);
    }
    for (const CheckedBits& checked : report.checked) {
        json["checked"].push_back({{"where", checked.where},
                                   {"steps", checked.steps},
                                   {"first_wrong", checked.first_wrong},
                                   {"good", checked.good()}});
    }
    if (report.cost) {
        json["core"] = report.core;
        json["cost"] = to_json(*report.cost);
    }
    if (report.whole) {
        json["cost_of_integer_pid"] = to_json(*report.whole);
    }
    return json.dump(2) + "\n";
}

}  // namespace generate
