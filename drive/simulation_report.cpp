#include "drive/simulation_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/failure.hpp"
#include "drive/response.hpp"

namespace drive {
namespace {

struct Distance {
    double largest = 0.0;
    double of_largest = 0.0;  // over the largest exact output
};

Distance distance_of(const SimulationReport& report) {
    double largest = 0.0;
    double size = 0.0;
    for (std::size_t k = 0; k < report.exact.size(); ++k) {
        largest = std::max(largest, std::fabs(report.record.output[k] - report.exact[k]));
        size = std::max(size, std::fabs(report.exact[k]));
    }
    return {largest, size > 0.0 ? largest / size : 0.0};
}

std::vector<double> exact_response(const Model& model, const Log& record) {
    return respond(model, changes_of(record.time_s, record.input), record.time_s);
}

}  // namespace

std::string in_words(const Scheme& scheme) {
    return fmt::format("{}{}{}, {} taps, h = {} s", scheme.kernel.empty() ? "double" : scheme.kernel,
                       scheme.increments ? ", increments" : "",
                       scheme.merged || scheme.kernel.empty() ? ", one merged table" : "",
                       scheme.taps ? std::to_string(*scheme.taps) : "full", scheme.step_s);
}

SimulationReport simulate_exactly(const Model& model, Log record) {
    record.output = exact_response(model, record);
    SimulationReport report;
    report.method = "exact, by numerical inverse Laplace";
    report.record = std::move(record);
    return report;
}

SimulationReport simulate(const Model& model, const Scheme& scheme, Log record, bool compare) {
    SimulationReport report;
    report.method = in_words(scheme);
    if (compare) {
        try {
            report.exact = exact_response(model, record);
        } catch (const glsum::Failure& failure) {
            report.why_not = failure.what();
        }
    }
    Simulated simulated = simulate(model, scheme, record.input);
    report.record = std::move(record);
    report.record.output = std::move(simulated.output);
    report.saturations = simulated.saturations;
    report.full_scale = simulated.full_scale;
    return report;
}

std::string to_text(const SimulationReport& report, const Model& model) {
    const Log& record = report.record;
    std::string text =
        fmt::format("{}\n{}, input {}: {} samples, at {:.6g} s the output is {:.10g}\n", to_text(model), report.method,
                    record.name, record.output.size(), record.time_s.back(), record.output.back());
    if (!report.exact.empty()) {
        const Distance distance = distance_of(report);
        text +=
            fmt::format("exact there: {:.10g}; largest error over the record {:.4g} ({:.3g} % of the largest output)\n",
                        report.exact.back(), distance.largest, 100.0 * distance.of_largest);
    }
    if (!report.why_not.empty()) {
        text += fmt::format("not compared with the exact response: {}\n", report.why_not);
    }
    if (report.full_scale > 0.0) {
        text += fmt::format("full scale {}, {} saturations\n", report.full_scale, report.saturations);
    }
    return text;
}

std::string to_json(const SimulationReport& report, const std::string& model) {
    const Log& record = report.record;
    nlohmann::ordered_json json{{"model", model},
                                {"method", report.method},
                                {"input", record.name},
                                {"samples", record.output.size()},
                                {"final_time_s", record.time_s.back()},
                                {"saturations", report.saturations}};
    json["final_output"] = record.output.back();
    if (!report.exact.empty()) {
        json["exact_final_output"] = report.exact.back();
        json["error_max"] = distance_of(report).largest;
    }
    return json.dump(2) + "\n";
}

std::string to_text(const std::vector<ExactPoint>& points) {
    std::string text;
    for (const auto& [time_s, value] : points) {
        text += fmt::format("{} s  {}  ({} digits agree)\n", time_s, value.digits, value.agreed_digits);
    }
    return text;
}

std::string to_json(const std::vector<ExactPoint>& points) {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const auto& [time_s, value] : points) {
        all.push_back({{"time_s", time_s},
                       {"value", value.value},
                       {"digits", value.digits},
                       {"agreed_digits", value.agreed_digits}});
    }
    return all.dump(2) + "\n";
}

}  // namespace drive
