#include "drive/controller.hpp"

#include <fmt/format.h>

#include <map>

#include "base/failure.hpp"

namespace drive {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw glsum::Failure(glsum::Exit::bad_input, message); }

}  // namespace

Model to_model(const Gains& gains, const std::string& name) {
    if (gains.kp == 0.0 && gains.ki == 0.0 && gains.kd == 0.0) {
        refuse(fmt::format("{}: expected kp, ki or kd other than 0", name));
    }
    if (gains.filter_s < 0.0 || (gains.kd != 0.0 && gains.filter_s == 0.0)) {
        refuse(fmt::format("{}: filter_s: expected a time above 0 beside kd, found {}", name, gains.filter_s));
    }
    if (!(gains.integral_order > 0.0 && gains.integral_order < 2.0 && gains.derivative_order > 0.0 &&
          gains.derivative_order <= 1.0)) {
        refuse(
            fmt::format("{}: expected an integral_order above 0 and below 2 and a derivative_order above 0 and at "
                        "most 1, found {} and {}",
                        name, gains.integral_order, gains.derivative_order));
    }
    const double filter_s = gains.kd != 0.0 ? gains.filter_s : 0.0;
    const double integral = gains.ki != 0.0 ? gains.integral_order : 0.0;
    std::map<double, double> above;
    std::map<double, double> below;
    for (const auto& [order, share] : {std::pair(0.0, 1.0), std::pair(1.0, filter_s)}) {
        if (share != 0.0) {
            above[order + integral] += share * gains.kp;
            above[order] += share * gains.ki;
            below[order + integral] += share;
        }
    }
    above[gains.derivative_order + integral] += gains.kd;
    Model model;
    model.numerator.clear();
    for (const auto& [terms, sums] : {std::pair(&model.numerator, &above), std::pair(&model.denominator, &below)}) {
        for (const auto& [order, coefficient] : *sums) {
            if (coefficient != 0.0) {
                terms->push_back({coefficient, order});
            }
        }
    }
    check_model(model, name);
    return model;
}

double direct_gain(const Model& controller) {
    const bool at_once = highest_order(controller.numerator) == highest_order(controller.denominator);
    return at_once && controller.delay_s == 0.0 ? controller.gain * leading_coefficient(controller.numerator) /
                                                      leading_coefficient(controller.denominator)
                                                : 0.0;
}

}  // namespace drive
