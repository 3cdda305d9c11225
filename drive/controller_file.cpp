#include "drive/controller_file.hpp"

#include <fmt/format.h>

#include <cmath>

#include "drive/json_fields.hpp"
#include "drive/refusal.hpp"

namespace drive {

void check_fopid(const Fopid& controller, const std::string& name) {
    const auto expect = [&](bool good, const char* field, const char* expected, double found) {
        if (!good) {
            refuse(fmt::format("{}: {}: expected {}, found {}", name, field, expected, found));
        }
    };
    const Gains& gains = controller.gains;
    for (const auto& [field, gain] :
         {std::pair("kp", gains.kp), std::pair("ki", gains.ki), std::pair("kd", gains.kd)}) {
        expect(std::isfinite(gain), field, "a finite number", gain);
    }
    if (gains.kp == 0.0 && gains.ki == 0.0 && gains.kd == 0.0) {
        refuse(fmt::format("{}: expected kp, ki or kd other than 0", name));
    }
    for (const auto& [field, order] :
         {std::pair("integral_order", gains.integral_order), std::pair("derivative_order", gains.derivative_order)}) {
        expect(order > 0.0 && order <= 1.0, field, "an order above 0 and at most 1", order);
    }
    expect(gains.filter_s >= 0.0 && std::isfinite(gains.filter_s), "filter_s", "0 s or more", gains.filter_s);
    expect(controller.sample_time_s > 0.0 && std::isfinite(controller.sample_time_s), "sample_time_s",
           "a time above 0 s", controller.sample_time_s);
    expect(!std::isnan(controller.low) && controller.low < controller.high, "low", "a limit below high",
           controller.low);
    expect(controller.setpoint_weight >= 0.0 && controller.setpoint_weight <= 1.0, "setpoint_weight",
           "a weight of 0 to 1", controller.setpoint_weight);
}

Fopid parse_fopid(const std::string& text, const std::string& name) {
    Fields fields(parse_json(text, name, "a controller"), name);
    const Json kind = fields.take("kind");
    if (kind != "fopid") {
        refuse(fmt::format("{}: kind: expected fopid, found {}", name, shortened(kind)));
    }
    Fopid controller;
    controller.gains = {.kp = fields.number_or("kp", 0.0),
                        .ki = fields.number_or("ki", 0.0),
                        .kd = fields.number_or("kd", 0.0),
                        .filter_s = fields.number_or("filter_s", 0.0),
                        .integral_order = fields.number_or("integral_order", 1.0),
                        .derivative_order = fields.number_or("derivative_order", 1.0)};
    controller.sample_time_s = fields.number("sample_time_s");
    controller.low = fields.number_or("low", controller.low);
    controller.high = fields.number_or("high", controller.high);
    controller.setpoint_weight = fields.number_or("setpoint_weight", 1.0);
    controller.notes = fields.rest();
    check_fopid(controller, name);
    return controller;
}

std::string to_json(const Fopid& controller) {
    Json file;
    file["kind"] = "fopid";
    file["kp"] = controller.gains.kp;
    file["ki"] = controller.gains.ki;
    file["kd"] = controller.gains.kd;
    file["integral_order"] = controller.gains.integral_order;
    file["derivative_order"] = controller.gains.derivative_order;
    file["filter_s"] = controller.gains.filter_s;
    file["sample_time_s"] = controller.sample_time_s;
    // JSON has no infinity: a limit that is none is left out.
    if (std::isfinite(controller.low)) {
        file["low"] = controller.low;
    }
    if (std::isfinite(controller.high)) {
        file["high"] = controller.high;
    }
    file["setpoint_weight"] = controller.setpoint_weight;
    if (!controller.notes.empty()) {
        file.update(Json::parse(controller.notes));
    }
    return file.dump(2) + "\n";
}

}  // namespace drive
