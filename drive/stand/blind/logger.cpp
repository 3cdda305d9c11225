#include "drive/stand/blind/logger.hpp"

#include <fmt/format.h>

#include <cmath>

namespace stand::blind {
namespace {

// A decimal step, so that shortest numbers are short.
double decimal_below(double step) { return std::pow(10.0, std::floor(std::log10(step))); }

double rounded(double value, double step) {
    const double decimal = decimal_below(step);
    // Divided by the whole number of steps in 1: 0.3, not 0.30000000000000004.
    return decimal < 1.0 ? std::round(value / decimal) / std::round(1.0 / decimal)
                         : decimal * std::round(value / decimal);
}

}  // namespace

double stamp_of(const Logger& logger, double time_s, double first_s) {
    return rounded(time_s - (logger.own_clock ? first_s : 0.0), logger.stamp_step_s);
}

std::string write_log(const Logger& logger, const Held& held, const std::vector<double>& readings, std::size_t from,
                      Chance& chance) {
    std::string text = fmt::format("time_s,{},{}\n", logger.input, logger.output);
    std::size_t missing = 0;
    for (std::size_t k = from; k < readings.size(); ++k) {
        const bool draws_missing = chance.happens(logger.missing_share / 2.5);
        const bool twice = chance.happens(logger.repeated_share);
        if (draws_missing && missing == 0) {
            missing = 1 + chance.below(4);
        }
        const bool jumps = k == from || std::fabs(held.input[k] - held.input[k - 1]) > logger.input_jump;
        if (missing > 0) {
            --missing;
            if (!jumps) {
                continue;
            }
        }
        const std::string row = fmt::format("{},{:.6g},{}\n", stamp_of(logger, held.time_s[k], held.time_s[from]),
                                            held.input[k], rounded(readings[k], logger.output_step));
        text += twice ? row + row : row;
    }
    return text;
}

}  // namespace stand::blind
