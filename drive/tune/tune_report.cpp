#include "drive/tune/tune_report.hpp"

#include <fmt/format.h>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

namespace tune {
namespace {

using Json = nlohmann::ordered_json;

std::string row(const Tuned& tuned, const std::string& words, const std::function<std::string(const Design&)>& value) {
    std::string line = fmt::format("  {:<44}", words);
    for (const auto* design : {&tuned.fractional, &tuned.integer, &tuned.steep}) {
        if (design == &tuned.steep && !tuned.steep) {
            break;
        }
        line += fmt::format("{:>14}", *design ? value(**design) : std::string("-"));
    }
    return line + '\n';
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.4g}", value) : "none"; }

Json to_json(const Design& design) {
    Json json;
    json["controller"] = Json::parse(drive::to_json(design.controller));
    const Margins& margins = design.margins;
    json["flat_phase"] = design.flat;
    json["phase_margin_deg"] = margins.phase_deg;
    json["phase_margin_deg_at_gain_0.8"] = design.weak_deg;
    json["phase_margin_deg_at_gain_1.25"] = design.strong_deg;
    json["crossover_rad_s"] = margins.crossover;
    if (std::isfinite(margins.gain)) {
        json["gain_margin"] = margins.gain;
        json["phase_crossover_rad_s"] = margins.phase_crossover;
    }
    json["sensitivity"] = margins.sensitivity;
    json["complementary_sensitivity"] = margins.complementary;
    json["load_iae"] = design.course.load_iae;
    json["setpoint_iae"] = design.course.setpoint_iae;
    json["overshoot"] = design.course.overshoot;
    json["met_a_limit"] = design.course.limited;
    json["tries"] = design.tries;
    return json;
}

std::string saving_text(const Tuned& tuned) {
    if (!tuned.integer) {
        return "No integer PID with a stable loop was found for this; a fractional one was.";
    }
    if (!tuned.fractional) {
        return "No fractional PID was found; the integer one meets this.";
    }
    const auto tenths = [](double part) { return std::round(1000.0 * part) / 10.0 + 0.0; };  // no -0.0
    const double percent = tenths(tuned.saving());
    const double setpoint = tenths(1.0 - tuned.fractional->course.setpoint_iae / tuned.integer->course.setpoint_iae);
    const std::string flat =
        tuned.fractional->flat && !tuned.integer->flat
            ? " It has a flat phase, which no integer PID within this wish has: its margin holds when the gain changes."
            : "";
    if (tuned.saving() >= worthwhile_saving) {
        return fmt::format("The fraction saves {:.1f} % of the load's error ({:+.1f} % of the set point's).{}", percent,
                           setpoint, flat);
    }
    if (!flat.empty()) {
        return fmt::format("The fraction costs {:.1f} % of the load's error.{}", -percent, flat);
    }
    return fmt::format(
        "The fraction buys nothing against a load: {:.1f} % of its error ({:.1f} % of the set point's); below {:.0f} % "
        "take the integer PID (--integer).",
        percent, setpoint, 100.0 * worthwhile_saving);
}

}  // namespace

std::string wish_text(const Tuned& tuned) {
    const Request& request = tuned.request;
    return fmt::format(
        "{}|S| at most {:.3g}",
        request.crossover ? fmt::format("a margin of {} degrees at {} rad/s, ", *request.margin_deg, *request.crossover)
                          : "",
        tuned.wish.sensitivity);
}

std::string conclusion(const Tuned& tuned) {
    std::string text = saving_text(tuned);
    if (tuned.steep) {
        text += fmt::format(" An integer PID whose phase need not be flat (steep) errs {:.2f} times the flat one's.",
                            tuned.steep->course.load_iae / tuned.integer->course.load_iae);
    }
    return text;
}

std::string to_text(const Tuned& tuned, const std::string& name) {
    const Trial& trial = tuned.trial;
    std::string text = fmt::format("{}: {}\nwished: {}\n", name, drive::to_text(tuned.plant), wish_text(tuned));
    text += fmt::format(
        "sampled each {} s, with hold and aliases in every number below; filter {:.4g} s; what is computed is put out "
        "at once\n\n  {:<44}{:>14}{:>14}{}\n",
        tuned.request.sample_time_s, *tuned.request.filter_s, "", "fractional", "integer",
        tuned.steep ? " integer, steep" : "");
    const auto gains = [](const Design& design) { return design.controller.gains; };
    text += row(tuned, "kp", [&](const Design& d) { return number(gains(d).kp); });
    text += row(tuned, "ki", [&](const Design& d) { return number(gains(d).ki); });
    text += row(tuned, "kd", [&](const Design& d) { return number(gains(d).kd); });
    text += row(tuned, "integral order", [&](const Design& d) { return number(gains(d).integral_order); });
    text += row(tuned, "derivative order", [&](const Design& d) { return number(gains(d).derivative_order); });
    text += row(tuned, "unstable poles of the loop (by the argument)",
                [](const Design& d) { return fmt::format("{}", d.margins.unstable_poles); });
    text += row(tuned, "crossover, rad/s", [](const Design& d) { return number(d.margins.crossover); });
    text +=
        row(tuned, "phase margin, degrees", [](const Design& d) { return fmt::format("{:.2f}", d.margins.phase_deg); });
    text +=
        row(tuned, "  with 0.8 of the plant's gain", [](const Design& d) { return fmt::format("{:.1f}", d.weak_deg); });
    text += row(tuned, "  with 1.25 of it", [](const Design& d) { return fmt::format("{:.1f}", d.strong_deg); });
    text += row(tuned, "slope of the phase there, degrees an octave", [](const Design& d) {
        return fmt::format("{:.1f}", d.margins.phase_slope * std::log(2.0) * 57.29577951308232);
    });
    text += row(tuned, "gain margin", [](const Design& d) { return number(d.margins.gain); });
    text += row(tuned, "largest |S|", [](const Design& d) { return fmt::format("{:.3f}", d.margins.sensitivity); });
    text += row(tuned, "largest |T|", [](const Design& d) { return fmt::format("{:.3f}", d.margins.complementary); });
    text += row(tuned, fmt::format("IAE of a load of {:.4g}, {:.4g} s", trial.load, trial.until_s),
                [](const Design& d) { return number(d.course.load_iae); });
    text += row(tuned, fmt::format("IAE of a set point of {:.4g}, {:.4g} s", trial.setpoint, trial.until_s),
                [](const Design& d) { return number(d.course.setpoint_iae); });
    text +=
        row(tuned, "overshoot, %", [](const Design& d) { return fmt::format("{:.1f}", 100.0 * d.course.overshoot); });
    text += row(tuned, "met a limit", [](const Design& d) { return std::string(d.course.limited ? "yes" : "no"); });
    text += row(tuned, "tries", [](const Design& d) { return fmt::format("{}", d.tries); });
    return text + "\n" + conclusion(tuned) + "\n";
}

std::string to_json(const Tuned& tuned, const std::string& model) {
    Json json{{"schema", "glsum-tune-1"}, {"model", model}};
    json["sample_time_s"] = tuned.request.sample_time_s;
    json["sensitivity_at_most"] = tuned.wish.sensitivity;
    if (tuned.request.crossover) {
        json["margin_deg"] = *tuned.request.margin_deg;
        json["crossover_rad_s"] = *tuned.request.crossover;
    }
    json["setpoint"] = tuned.trial.setpoint;
    json["load"] = tuned.trial.load;
    json["until_s"] = tuned.trial.until_s;
    if (tuned.fractional) {
        json["fractional"] = to_json(*tuned.fractional);
    }
    if (tuned.integer) {
        json["integer"] = to_json(*tuned.integer);
    }
    if (tuned.steep) {
        json["integer_steep"] = to_json(*tuned.steep);
    }
    json["conclusion"] = conclusion(tuned);
    return json.dump(2) + "\n";
}

}  // namespace tune
