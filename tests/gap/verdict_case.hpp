// A verdict of a drive, made by hand.
#pragma once

#include <utility>

#include "gap/verdict/verdict.hpp"

namespace verdict_test {

inline gap::OfDrive of_drive() {
    gap::OfDrive of{};
    of.chosen = "backlash";
    of.where.time = {{0.0, 2.0, 0.95, "start"}, {2.0, 4.0, 0.05, ""}};
    of.where.frequency = {{0.0, 0.5, 0.9, ""}, {0.5, 5.0, 0.1, ""}};
    of.where.input_level = {{0.1, 0.1, 0.9, ""}, {0.2, 0.3, 0.1, ""}};
    of.where.output_level = {{-1.0, 1.0, 1.0, ""}};
    of.where.rising = 0.5;
    of.where.falling = 0.3;
    of.where.still = 0.2;
    of.base.form = "second_order";
    of.base.model = "1 / (1.23456 s + 1)";
    of.base.in_short = "1 / (1.235 s + 1)";
    of.base.linear_share = 0.75;
    of.base.parameters = {{"gain", 1.5, {{1.25, 1.75}}}};
    of.confidence = 0.875;
    return of;
}

inline gap::Verdict verdict_of(gap::OfDrive of) {
    return {gap::Outcome::attributed,
            {"simulation", 0.5, 0.1, 0.05},
            {{"backlash", 0.1, 60.0}, {"none", 0.5, -40.0}},
            std::move(of),
            "rest",
            {}};
}

inline gap::Cause backlash() { return {"backlash", {{"gap", 0.25, {{0.2, 0.3}}}}, 0.5, 0.1, 0.8, 0.875}; }

}  // namespace verdict_test
